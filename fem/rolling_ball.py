"""Ball bearings, deep groove and angular contact: Hertz point contact between groove and ball, any contact angle.

In the meridian plane of a ball the vector v leads from the outer to the inner groove's centre of curvature.
Unloaded and touching its length is A = r_i + r_e − D; what it is longer, the two contacts are compressed
(ISO/TS 16281; Harris, Rolling Bearing Analysis, 7).  The contact angle is that of v and turns with the load.
Forces act at the inner groove's centre circle, whose centre is the bearing centre here: the moments are about
it, and the tilts' lever is the circle's radius.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from trochoid.fem.hertz_point import EXACT, PointContact, contact_modulus, point_contact
from trochoid.fem.material import Material
from trochoid.fem.rolling import RollingState, element_angles, meridian, symmetric
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, BoolArray, frozen

STEEL = Material(206e9, 0.3, 7800.0)


@dataclass(frozen=True)
class BallBearing:
    """One row of balls; lengths in m, angles in rad.

    `contact_angle`: of the unloaded bearing that just touches, 0 for deep groove bearings.  `clearance`: radial
    internal clearance of ISO 5753, the whole play across the bearing at that angle; negative is a press fit.
    A deep groove bearing's z is counted from the middle of its axial play, an angular contact bearing's from
    where it touches, so that its preload is a displacement in z (or a load).  `hertz_factor`: see
    `hertz_point` for ISO/TS 16281's rounded 1.48.
    """

    balls: int
    ball_diameter: float
    pitch_diameter: float
    inner_groove_radius: float
    outer_groove_radius: float
    contact_angle: float = 0.0
    clearance: float = 0.0
    ring: Material = STEEL
    ball: Material = STEEL
    hertz_factor: float = EXACT

    def __post_init__(self) -> None:
        """Refuse what cannot be built."""
        _fail_if_impossible(self)

    @property
    def gamma(self) -> float:
        """Return γ = D cos α / D_pw."""
        return float(self.ball_diameter * np.cos(self.contact_angle) / self.pitch_diameter)

    @property
    def groove_distance(self) -> float:
        """Return A, the distance of the grooves' centres of curvature when a ball just touches both, m."""
        return self.inner_groove_radius + self.outer_groove_radius - self.ball_diameter

    @property
    def free_contact_angle(self) -> float:
        """Contact angle α₀ at which the unloaded rings touch when pushed along the axis, rad."""
        radial = self.groove_distance * np.cos(self.contact_angle) - 0.5 * self.clearance
        return float(np.arccos(min(1.0, radial / self.groove_distance)))

    @property
    def lever(self) -> float:
        """Radius of the inner groove's centre circle, m."""
        offset = self.inner_groove_radius - 0.5 * self.ball_diameter
        return float(0.5 * self.pitch_diameter + offset * np.cos(self.contact_angle))

    @property
    def play(self) -> float:
        """Displacement within which the bearing may be open: half the axial play or more, m."""
        return self.groove_distance * float(np.sin(self.free_contact_angle)) if self.clearance > 0.0 else 0.0

    @property
    def bend(self) -> float:
        """Length over which a displacement across a contact turns it: A, m."""
        return self.groove_distance

    @cached_property
    def contacts(self) -> tuple[PointContact, PointContact]:
        """Contacts at the inner and the outer raceway (ISO/TS 16281, curvatures at the nominal contact angle)."""
        modulus = contact_modulus(self.ring, self.ball)
        round_ball, g = 2.0 / self.ball_diameter, self.gamma
        inner = (round_ball / (1.0 - g), round_ball - 1.0 / self.inner_groove_radius)
        outer = (round_ball / (1.0 + g), round_ball - 1.0 / self.outer_groove_radius)
        return point_contact(inner, modulus), point_contact(outer, modulus)

    @cached_property
    def constants(self) -> tuple[float, float, float]:
        """Load constants c of Q = c δ^(3/2) in N/m^1.5: inner contact, outer contact, both in series (c_p)."""
        one, two = (c.softness(self.hertz_factor) for c in self.contacts)
        return one**-1.5, two**-1.5, (one + two) ** -1.5

    def deflection(self, force: float) -> float:
        """Return the ball's approach in m under Stribeck's share 5F/Z of a force."""
        return float((5.0 * force / (self.balls * self.constants[2])) ** (2.0 / 3.0))

    def arms(self, angles: Array) -> Array:
        """Return (n, 2, 5): what a displacement adds to v at balls at `angles`."""
        return meridian(angles, self.lever)

    def stretch(self, shift: Array) -> tuple[Array, Array]:
        """Return v (…, 2) after shifts (…, 2) of the inner groove's centre, and how much longer than A it is (…,).

        |v| − A = (|v|² − A²)/(|v| + A), so that small deflections keep their digits.
        """
        rest = self.groove_distance * np.array([np.cos(self.contact_angle), np.sin(self.contact_angle)])
        moved = shift - np.array([0.5 * self.clearance, 0.0])
        vector = rest + moved
        excess = 2.0 * moved @ rest + (moved * moved).sum(axis=-1)
        length = np.hypot(vector[..., 0], vector[..., 1])
        return vector, excess / (length + self.groove_distance)

    def respond(self, displacement: Array, turn: float) -> RollingState:
        """Return the state of resting balls: both contacts in series on one line."""
        angles = element_angles(self.balls, turn)
        arms = self.arms(angles)
        vector, deflection = self.stretch(np.einsum("nai,...i->...na", arms, displacement))
        pressed = np.maximum(deflection, 0.0)
        root = np.sqrt(pressed)
        loads = self.constants[2] * pressed * root
        force, hessian = spring(vector, loads, 1.5 * self.constants[2] * root)
        contact = np.where(loads > 0.0, np.arctan2(vector[..., 1], vector[..., 0]), 0.0)
        energy = 0.4 * (loads * pressed).sum(axis=-1)
        return gathered(
            displacement, angles, arms, (loads, loads), (contact, contact), force, hessian, energy
        )

    def overreached(self, state: RollingState) -> BoolArray:
        """Return where (…,) a loaded ball has left the side of the groove that is meant to carry."""
        angle = np.where(state.inner_loads > 0.0, state.inner_angles, self.contact_angle)
        low = 1e-9 if self.contact_angle > 0.0 else -0.5 * np.pi
        return np.asarray(((angle <= low) | (angle >= 0.5 * np.pi)).any(axis=-1))

    def refusal(self, load: Array, free: BoolArray) -> str:
        """Say why an angular contact bearing does not pass a load on all of its free components, or nothing."""
        if self.contact_angle > 0.0 and free[2] and load[2] <= 0.0 and load.any():
            return (
                f"an angular contact bearing passes axial force towards +z only, given F_z = {load[2]:.6g} N; "
                f"give a positive axial load (or hold z, as its partner bearing does)"
            )
        return ""


def spring(vector: Array, force: Array, rate: Array) -> tuple[Array, Array]:
    """Return force (…, 2) and stiffness (…, 2, 2) of springs along `vector` (…, 2): along it `rate`, across F/|v|."""
    length = np.hypot(vector[..., 0], vector[..., 1])
    unit = vector / np.where(length > 0.0, length, 1.0)[..., None]
    across = np.divide(force, length, out=np.zeros_like(force), where=length > 0.0)
    along = unit[..., :, None] * unit[..., None, :]
    hessian = (rate - across)[..., None, None] * along + across[..., None, None] * np.eye(2)
    return force[..., None] * unit, hessian


def gathered(
    displacement: Array,
    angles: Array,
    arms: Array,
    loads: tuple[Array, Array],
    contact: tuple[Array, Array],
    force: Array,
    hessian: Array,
    energy: Array,
) -> RollingState:
    """Return the bearing's state from forces (…, n, 2) and stiffnesses (…, n, 2, 2) of its balls' meridian planes."""
    flat = arms.reshape(-1, 5)
    whole = flat.T @ (hessian @ arms).reshape(*hessian.shape[:-3], -1, 5)
    return RollingState(
        displacement=frozen(displacement),
        angles=frozen(angles),
        inner_loads=frozen(loads[0]),
        outer_loads=frozen(loads[1]),
        inner_angles=frozen(contact[0]),
        outer_angles=frozen(contact[1]),
        slice_loads=frozen(loads[0][..., None]),
        load=frozen(force.reshape(*force.shape[:-2], -1) @ flat),
        stiffness=frozen(symmetric(whole)),
        energy=frozen(energy),
    )


def _fail_if_impossible(bearing: BallBearing) -> None:
    d, pitch = bearing.ball_diameter, bearing.pitch_diameter
    grooves = (bearing.inner_groove_radius, bearing.outer_groove_radius)
    sizes = (d, pitch, *grooves)
    if not all(np.isfinite(s) and s > 0.0 for s in sizes) or not np.isfinite(bearing.clearance):
        raise Infeasible(
            f"ball bearing: ball diameter, pitch diameter and groove radii must be positive and finite, given "
            f"{sizes} m with clearance {bearing.clearance} m"
        )
    if bearing.balls < 3:
        raise Infeasible(f"ball bearing: at least 3 balls are needed, given {bearing.balls}")
    if not 0.0 <= bearing.contact_angle < 0.5 * np.pi:
        raise Infeasible(
            f"ball bearing: contact angle must lie in [0°, 90°), given {np.degrees(bearing.contact_angle):.6g}°; "
            f"turn the z axis for a bearing that carries the other way"
        )
    limit = pitch * np.sin(np.pi / bearing.balls)
    if d >= limit:
        most = int(np.ceil(np.pi / np.arcsin(min(1.0, d / pitch)))) - 1
        raise Infeasible(
            f"ball bearing: balls overlap: diameter {d:.6g} m, must be below pitch_diameter·sin(π/balls) = "
            f"{limit:.6g} m; nearest feasible number of balls is {most}"
        )
    if min(grooves) <= 0.5 * d:
        raise Infeasible(
            f"ball bearing: groove radii {grooves} m must exceed half the ball diameter, {0.5 * d:.6g} m; "
            f"usual are 0.52 and 0.53 of the ball diameter"
        )
    radial = bearing.groove_distance * np.cos(bearing.contact_angle)
    if 0.5 * bearing.clearance >= radial:
        raise Infeasible(
            f"ball bearing: clearance {bearing.clearance:.6g} m must be below 2A cos α = {2.0 * radial:.6g} m, "
            f"above which the balls leave the grooves"
        )

"""Cylindrical, needle and tapered roller bearings: ISO/TS 16281 line contact in slices, any contact angle.

The law is that of `bearing` (a cylindrical roller on a ring that moves without axial shift), with a contact
angle and with roller profiles.  A tapered roller's two contacts are taken as parallel, at the contact angle of
the outer raceway; the roller's own tilt is half the rings', as in ISO/TS 16281; rib contacts are left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from trochoid.fem.bearing import RollerBearing, iso16281_constant, line_contact
from trochoid.fem.rolling import RollingState, element_angles, meridian, symmetric
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, BoolArray, frozen


@dataclass(frozen=True)
class RollerRow:
    """One row of rollers: cylindrical or needle at contact angle 0, else tapered; lengths in m, angles in rad.

    `pitch_diameter` at the middle of the rollers, where the bearing centre is; `length`: effective length L_we.
    `clearance`: radial internal clearance of ISO 5753, the whole play across the bearing; negative is preload.
    A tapered bearing's z is counted from where it touches at no clearance.  `drop` (slices,): how much the
    profile of the roller falls back at each slice, m, or () for straight rollers.  `factor` on c_L of
    ISO/TS 16281, which is that of steel on steel.
    """

    rollers: int
    roller_diameter: float
    pitch_diameter: float
    length: float
    contact_angle: float = 0.0
    clearance: float = 0.0
    slices: int = 30
    drop: tuple[float, ...] = ()
    factor: float = 1.0

    def __post_init__(self) -> None:
        """Refuse what cannot be built."""
        _fail_if_impossible(self)

    @property
    def gamma(self) -> float:
        """Return γ = D cos α / D_pw."""
        return float(self.roller_diameter * np.cos(self.contact_angle) / self.pitch_diameter)

    @property
    def slice_positions(self) -> Array:
        """Positions (slices,) of the slices along the roller, from its middle, m."""
        return slice_positions(self.length, self.slices)

    @property
    def slice_constant(self) -> float:
        """Load constant of one slice, N/m^(10/9)."""
        return self.factor * iso16281_constant(self.length) / self.slices

    @property
    def lever(self) -> float:
        """Radius at which tilts press the rollers together: their half length or what their contact angle adds, m."""
        slope = float(np.sin(self.contact_angle))
        return max(0.5 * self.length, 0.5 * self.pitch_diameter * slope)

    @property
    def play(self) -> float:
        """Displacement within which the bearing may be open, m."""
        slope = float(np.sin(self.contact_angle))
        radial = 0.5 * max(self.clearance, 0.0) * float(np.cos(self.contact_angle))
        return (radial + 2.0 * min(self.drop, default=0.0)) / (slope if slope > 0.02 else 1.0)

    @property
    def bend(self) -> float:
        """Return 0: the contact angle does not turn."""
        return 0.0

    @cached_property
    def gaps(self) -> Array:
        """What a slice must approach before it touches, (slices,) in m: s/2 cos α + 2P(x)."""
        radial = 0.5 * self.clearance * np.cos(self.contact_angle)
        return frozen(radial + 2.0 * np.array(self.drop if self.drop else (0.0,) * self.slices))

    def deflection(self, force: float) -> float:
        """Return the roller's approach in m under Stribeck's share 4.08F/Z of a force."""
        share = 4.08 * force / self.rollers / (self.factor * iso16281_constant(self.length))
        return float(share**0.9)

    def arms(self, angles: Array) -> Array:
        """Return (n, slices, 5): what a displacement adds to the slices' deflections."""
        c, s = np.cos(self.contact_angle), np.sin(self.contact_angle)
        along = self.slice_positions
        points = meridian(angles, 0.5 * self.pitch_diameter - along * s, along * c)
        return np.asarray(points[..., 0, :] * c + points[..., 1, :] * s)

    def respond(self, displacement: Array, turn: float) -> RollingState:
        """Return the state; the contact angle is the nominal one."""
        angles = element_angles(self.rollers, turn)
        arms = self.arms(angles).reshape(-1, 5)
        gaps = np.tile(self.gaps, self.rollers)
        deflection = displacement @ arms.T - gaps
        flat, rate = line_contact(deflection, self.slice_constant)
        loads = flat.reshape(*flat.shape[:-1], self.rollers, self.slices)
        totals = loads.sum(axis=-1)
        contact = np.where(totals > 0.0, self.contact_angle, 0.0)
        work = (9.0 / 19.0) * (flat * np.maximum(deflection, 0.0)).sum(axis=-1)
        return RollingState(
            displacement=frozen(displacement),
            angles=frozen(angles),
            inner_loads=frozen(totals),
            outer_loads=frozen(totals),
            inner_angles=frozen(contact),
            outer_angles=frozen(contact),
            slice_loads=frozen(loads),
            load=frozen(flat @ arms),
            stiffness=frozen(symmetric(arms.T @ (rate[..., None] * arms))),
            energy=frozen(work),
        )

    def overreached(self, state: RollingState) -> BoolArray:
        """Return where (…,) the law does not hold: nowhere."""
        return np.zeros(state.energy.shape, dtype=bool)

    def refusal(self, load: Array, free: BoolArray) -> str:
        """Say which part of a load the rollers cannot pass, or nothing.

        What they pass are sums of pushes along their ends' normals; the nearest of these is found by
        non-negative least squares.
        """
        if not (load * free).any():
            return ""
        from scipy.optimize import nnls

        size = np.array([1.0, 1.0, 1.0, self.lever, self.lever])
        ends = self.arms(np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False))[:, [0, -1]].reshape(-1, 5)
        target = load / size
        pushes, rest = nnls((ends / size)[:, free].T, target[free], maxiter=10000)
        if rest <= 1e-3 * float(np.linalg.norm(target[free])):
            return ""
        nearest = np.where(free, pushes @ ends, load)
        nearest[np.abs(nearest / size) < 1e-9 * float(np.linalg.norm(target))] = 0.0
        given, could = (", ".join(f"{v + 0.0:.6g}" for v in values) for values in (load, nearest))
        return (
            f"rollers at a contact angle of {np.degrees(self.contact_angle):.6g}° cannot pass the load "
            f"(F_x, F_y, F_z, M_x, M_y) = ({given}); the nearest that they can is ({could}); "
            f"give that, or hold the motions that the rollers leave free"
        )


def slice_positions(length: float, slices: int) -> Array:
    """Return the positions (slices,) of slices along a roller, from its middle, m."""
    return frozen(length * ((np.arange(slices) + 0.5) / slices - 0.5))


def logarithmic(
    diameter: float, length: float, slices: int = 30, factor: float | None = None
) -> tuple[float, ...]:
    """Return the profile P(x) of ISO/TS 16281 at the slices, m: `factor`·D·ln(1/(1−(2x/L)²)).

    `factor` is 0.00035 if not given; 0.00045 is that of tapered rollers.  Rollers longer than 2.5 D (needles)
    are straight in the middle and have 0.0005 and (2|x| − (L − 2.5D))/(2.5D) at their ends.
    """
    x = np.abs(slice_positions(length, slices))
    bent = min(length, 2.5 * diameter)
    usual = 0.00035 if length <= 2.5 * diameter else 0.0005
    part = np.maximum(2.0 * x - (length - bent), 0.0) / bent
    return tuple(float(p) for p in -(usual if factor is None else factor) * diameter * np.log1p(-(part**2)))


def crowned(length: float, radius: float, slices: int = 30) -> tuple[float, ...]:
    """Return the profile x²/2R of a roller whose contour is a circle of this radius, at the slices, m."""
    return tuple(float(p) for p in slice_positions(length, slices) ** 2 / (2.0 * radius))


def row_of(bearing: RollerBearing, drop: tuple[float, ...] = ()) -> RollerRow:
    """Return the row of a cylindrical roller bearing."""
    return RollerRow(
        bearing.rollers,
        2.0 * bearing.roller_radius,
        2.0 * bearing.pitch_radius,
        bearing.length,
        clearance=bearing.clearance,
        slices=bearing.slices,
        drop=drop,
    )


def _fail_if_impossible(row: RollerRow) -> None:
    if not 0.0 <= row.contact_angle < 0.5 * np.pi:
        raise Infeasible(
            f"roller bearing: contact angle must lie in [0°, 90°), given {np.degrees(row.contact_angle):.6g}°; "
            f"turn the z axis for a bearing that carries the other way"
        )
    RollerBearing(
        row.rollers,
        0.5 * row.roller_diameter,
        0.5 * row.pitch_diameter,
        row.length,
        row.clearance,
        row.slices,
    )
    if len(row.drop) not in (0, row.slices) or not all(np.isfinite(p) and p >= 0.0 for p in row.drop):
        raise Infeasible(
            f"roller bearing: the profile needs one finite drop ≥ 0 for each of {row.slices} slices, given "
            f"{len(row.drop)} values; write () for straight rollers"
        )
    if not (np.isfinite(row.factor) and row.factor > 0.0):
        raise Infeasible(f"roller bearing: the factor on c_L must be positive and finite, given {row.factor}")

"""Cylindrical roller bearing with rigid rings: ISO/TS 16281 line contact in slices, with its exact Jacobian.

The outer ring stands still, the inner one is moved by `(x, y, tilt_x, tilt_y)`: metres, and radians about the
x and y axes through the bearing centre, right-handed.  A load is what the inner ring passes to the outer one:
`(F_x, F_y, M_x, M_y)`, the gradient of the elastic energy, so the stiffness is symmetric and positive
semi-definite by construction.  A cylindrical bearing passes neither axial force nor torque.  Roller profile,
roller tilt on its own, cage and centrifugal force of the rollers are not in the model.  Axial shift, contact angles and
profiles are in `rolling_roller`, with this law.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen

EXPONENT = 10.0 / 9.0


def iso16281_constant(length: float) -> float:
    """Return c_L of `Q = c_L·δ^(10/9)` for both contacts of a steel roller, in N/m^(10/9).

    `length` is the effective roller length in m.  ISO/TS 16281: c_L = 35 948·L^(8/9) in N and mm; both powers
    together are 2, so the factor to SI is 10⁶.
    """
    return float(35948.0e6 * float(length) ** (8.0 / 9.0))


def line_contact(deflection: Array, constant: float) -> tuple[Array, Array]:
    """Return loads (…,) and their derivatives of `Q = c·δ^(10/9)` at deflections (…,); open where negative."""
    pressed = np.maximum(deflection, 0.0)
    return constant * pressed**EXPONENT, EXPONENT * constant * pressed ** (EXPONENT - 1.0)


@dataclass(frozen=True)
class RollerBearing:
    """One row of `rollers` cylindrical rollers; lengths in m.

    `clearance` is the radial internal clearance of ISO 5753 and ISO/TS 16281: the whole play across the
    bearing, of which each side has half; negative means preload.  `slices` laminae per roller (ISO/TS 16281:
    at least 30).
    """

    rollers: int
    roller_radius: float
    pitch_radius: float
    length: float
    clearance: float = 0.0
    slices: int = 30

    def __post_init__(self) -> None:
        """Refuse what cannot be built."""
        _fail_if_impossible(self)

    @cached_property
    def slice_positions(self) -> Array:
        """Axial positions (slices,) of the slice centres about the bearing centre."""
        return frozen(self.length * ((np.arange(self.slices) + 0.5) / self.slices - 0.5))

    @property
    def slice_constant(self) -> float:
        """Load constant of one slice, N/m^(10/9)."""
        return iso16281_constant(self.length) / self.slices


@dataclass(frozen=True, slots=True)
class BearingState:
    """Roller bearing at one displacement of its inner ring.

    `angles` (rollers,); `deflections` and `slice_loads` (rollers, slices), deflections negative where open;
    `load` (4,) passed from the inner to the outer ring; `stiffness` (4, 4), its exact derivative.
    """

    displacement: Array
    angles: Array
    deflections: Array
    slice_loads: Array
    load: Array
    stiffness: Array

    @property
    def roller_loads(self) -> Array:
        """Normal force of each roller (rollers,), N."""
        loads: Array = self.slice_loads.sum(axis=1)
        return loads

    @property
    def touching(self) -> int:
        """Return the number of rollers that carry."""
        return int(np.count_nonzero(self.slice_loads.any(axis=1)))

    @property
    def note(self) -> str:
        """Say in words what a reader of the stiffness must know, or nothing."""
        return carrying_note(self.touching)


def carrying_note(touching: int) -> str:
    """Say what it means for the stiffness that so many rollers carry, or nothing."""
    if touching == 0:
        return "no roller carries: the bearing is open and its stiffness is zero"
    if touching == 1:
        return "a single roller carries: there is no stiffness across its line of action"
    return ""


def load_distribution(
    bearing: RollerBearing, displacement: Array, roller_angle0: float = 0.0
) -> BearingState:
    """Return rollers' loads and stiffness for a displacement (4,) of the inner ring.

    Deflection of slice k of roller j: `(x + tilt_y z_k) cos φ_j + (y − tilt_x z_k) sin φ_j − s/2`
    (ISO/TS 16281 for small tilts, unprofiled); `roller_angle0` is the angle of roller 0.
    """
    arms = _arms(bearing, roller_angle0)
    q = np.asarray(displacement, dtype=np.float64)
    deflection = arms @ q - 0.5 * bearing.clearance
    loads, rate = line_contact(deflection, bearing.slice_constant)
    shape = (bearing.rollers, bearing.slices)
    return BearingState(
        displacement=frozen(q),
        angles=frozen(_angles(bearing, roller_angle0)),
        deflections=frozen(deflection.reshape(shape)),
        slice_loads=frozen(loads.reshape(shape)),
        load=frozen(arms.T @ loads),
        stiffness=frozen(_gram(arms, rate)),
    )


def stiffness(bearing: RollerBearing, displacement: Array, roller_angle0: float = 0.0) -> Array:
    """Return the exact Jacobian ∂load/∂displacement (4, 4) in N/m, N and N·m/rad."""
    return load_distribution(bearing, displacement, roller_angle0).stiffness


def seated_stiffness(
    bearing: RollerBearing, slice_loads: Array, seat_compliance: Array, roller_angle0: float = 0.0
) -> Array:
    """Return the tangent stiffness (4, 4) of rollers in series with an elastic seat, e.g. the bore of a disc.

    `slice_loads` (rollers,) or (rollers, slices), N, at the state in question.  `seat_compliance` S (rollers,
    rollers): radial deflection of the seat at each roller per unit force on each roller, m/N, relative to the
    seat's rigid motion.  With k_j the tangent stiffness of roller j, G_j its first moments, K the matrix on
    a rigid seat: `K − Gᵀ S (1 + diag(k) S)⁻¹ G`, which treats loaded and open rollers alike.
    """
    loads = np.asarray(slice_loads, dtype=np.float64)
    if loads.ndim == 1:
        loads = np.repeat(loads[:, None] / bearing.slices, bearing.slices, axis=1)
    constant = bearing.slice_constant
    rate = EXPONENT * constant * (np.maximum(loads, 0.0) / constant) ** 0.1
    arms = _arms(bearing, roller_angle0)
    compliance = np.asarray(seat_compliance, dtype=np.float64)
    moments = np.einsum("jk,jki->ji", rate, arms.reshape(*rate.shape, 4))
    series = np.eye(bearing.rollers) + rate.sum(axis=1)[:, None] * compliance
    reduced = _gram(arms, rate.ravel()) - moments.T @ compliance @ np.linalg.solve(series, moments)
    return frozen(0.5 * (reduced + reduced.T))


def six_by_six(plane: Array) -> Array:
    """Return a stiffness as (6, 6) on (x, y, z, tilt_x, tilt_y, spin): given (4, 4) without z, or (5, 5) with it."""
    full = np.zeros((6, 6))
    held = (0, 1, 3, 4) if len(plane) == 4 else (0, 1, 2, 3, 4)
    full[np.ix_(held, held)] = plane
    return frozen(full)


def _angles(bearing: RollerBearing, roller_angle0: float) -> Array:
    return roller_angle0 + 2.0 * np.pi * np.arange(bearing.rollers) / bearing.rollers


def _arms(bearing: RollerBearing, roller_angle0: float) -> Array:
    """Return ∂deflection/∂displacement (rollers·slices, 4)."""
    angles = _angles(bearing, roller_angle0)[:, None]
    z = bearing.slice_positions[None, :]
    cosine, sine = np.cos(angles), np.sin(angles)
    ones = np.ones_like(z)
    columns = (cosine * ones, sine * ones, -sine * z, cosine * z)
    return np.stack(columns, axis=-1).reshape(-1, 4)


def _gram(arms: Array, rate: Array) -> Array:
    root = np.sqrt(rate)[:, None] * arms
    return root.T @ root


def _fail_if_impossible(bearing: RollerBearing) -> None:
    sizes = (bearing.roller_radius, bearing.pitch_radius, bearing.length)
    if not all(np.isfinite(s) and s > 0.0 for s in sizes) or not np.isfinite(bearing.clearance):
        raise Infeasible(
            f"roller bearing: roller radius, pitch radius and length must be positive and finite, "
            f"given {sizes} m with clearance {bearing.clearance} m"
        )
    if bearing.rollers < 3 or bearing.slices < 2:
        raise Infeasible(
            f"roller bearing: at least 3 rollers and 2 slices are needed to hold a shaft, "
            f"given {bearing.rollers} rollers and {bearing.slices} slices"
        )
    limit = bearing.pitch_radius * np.sin(np.pi / bearing.rollers)
    if bearing.roller_radius >= limit:
        raise Infeasible(
            f"roller bearing: rollers overlap: radius {bearing.roller_radius:.6g} m, must be below "
            f"pitch_radius·sin(π/rollers) = {limit:.6g} m; nearest feasible number of rollers is "
            f"{int(np.ceil(np.pi / np.arcsin(min(1.0, bearing.roller_radius / bearing.pitch_radius)))) - 1}"
        )

"""Load ratings and equivalent loads of one bearing row: ISO 281 (dynamic, basic life) and ISO 76 (static).

Not offered: thrust bearings, several rows and pairs, angular contact below 20° (use `bearing_life`), the fatigue
load limit C_u (its maker's), and the factor e_C for contamination.  Lengths in m, loads in N.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from trochoid.fem.hertz_point import contact_modulus, point_contact
from trochoid.fem.material import Material
from trochoid.fem.rolling import RollingState
from trochoid.fem.rolling_ball import STEEL, BallBearing
from trochoid.fem.rolling_roller import RollerRow
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

Row: TypeAlias = BallBearing | RollerRow

PERMISSIBLE = 4.2e9  # Pa, ISO 76: ball bearings; sinks the raceway by 1e-4 of the ball diameter
ISO76_STEEL = Material(207e9, 0.3)  # of the table of f_0 (ISO/TR 10657)
BALL_STATIC = (  # ISO 76: angle in degrees, Y_0; X_0 = 0.5
    (5.0, 0.52),
    (10.0, 0.50),
    (15.0, 0.46),
    (20.0, 0.42),
    (25.0, 0.38),
    (30.0, 0.33),
    (35.0, 0.29),
    (40.0, 0.26),
    (45.0, 0.22),
)
GROOVE_DYNAMIC = (  # ISO 281: f_0 F_a/C_0r, e, Y; X = 0.56
    (0.172, 0.19, 2.30),
    (0.345, 0.22, 1.99),
    (0.689, 0.26, 1.71),
    (1.03, 0.28, 1.55),
    (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31),
    (3.45, 0.38, 1.15),
    (5.17, 0.42, 1.04),
    (6.89, 0.44, 1.00),
)
ANGULAR_DYNAMIC = (  # ISO 281: angle in degrees, e, X, Y
    (20.0, 0.57, 0.43, 1.00),
    (25.0, 0.68, 0.41, 0.87),
    (30.0, 0.80, 0.39, 0.76),
    (35.0, 0.95, 0.37, 0.66),
    (40.0, 1.14, 0.35, 0.57),
    (45.0, 1.34, 0.33, 0.50),
)


def dynamic_rating(row: Row, manufacture: float | None = None) -> float:
    """Return the basic dynamic radial load rating C_r (ISO 281), N.

    `manufacture`: b_m, 1.3 for balls and 1.1 for rollers if not given (1.0 for drawn cups).
    """
    cosine = float(np.cos(row.contact_angle))
    if isinstance(row, RollerRow):
        length, diameter = 1e3 * row.length, 1e3 * row.roller_diameter
        shape = (length * cosine) ** (7.0 / 9.0) * row.rollers**0.75 * diameter ** (29.0 / 27.0)
        return float((1.1 if manufacture is None else manufacture) * roller_factor(row.gamma) * shape)
    diameter = 1e3 * row.ball_diameter
    power = diameter**1.8 if diameter <= 25.4 else 3.647 * diameter**1.4
    shape = cosine**0.7 * row.balls ** (2.0 / 3.0) * power
    grooves = (row.inner_groove_radius / row.ball_diameter, row.outer_groove_radius / row.ball_diameter)
    return float((1.3 if manufacture is None else manufacture) * ball_factor(row.gamma, grooves) * shape)


def ball_factor(gamma: float, grooves: tuple[float, float] = (0.52, 0.53)) -> float:
    """Return f_c of radial ball bearings (N and mm), the formula behind the table of ISO 281 (Lundberg–Palmgren).

    `grooves`: radii over the ball diameter; only wider ones than 0.52 and 0.53 change the rating.
    """
    if not 0.0 < gamma < 1.0:
        raise Infeasible(f"f_c needs D cos α/D_pw between 0 and 1, given {gamma:.6g}")
    wide = max(grooves[0], 0.52), max(grooves[1], 0.53)
    whole = 38.2 * _ball_shape(gamma, 0.52, 0.52)  # the table holds for equal grooves
    return whole * _ball_shape(gamma, *wide) / _ball_shape(gamma, 0.52, 0.53)


def _ball_shape(gamma: float, inner: float, outer: float) -> float:
    ratio = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72
    ratio *= (inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)) ** 0.41
    shape = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)
    return float((1.0 + ratio ** (10.0 / 3.0)) ** -0.3 * shape * (2.0 * inner / (2.0 * inner - 1.0)) ** 0.41)


def roller_factor(gamma: float) -> float:
    """Return f_c of radial roller bearings (N and mm), the formula behind the table of ISO 281."""
    if not 0.0 < gamma < 1.0:
        raise Infeasible(f"f_c needs D cos α/D_pw between 0 and 1, given {gamma:.6g}")
    ratio = 1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return float(0.83 * 207.9 * (1.0 + ratio**4.5) ** (-2.0 / 9.0) * shape)


def static_rating(row: Row) -> float:
    """Return the basic static radial load rating C_0r (ISO 76), N."""
    cosine = float(np.cos(row.contact_angle))
    if isinstance(row, RollerRow):
        area = row.length * row.roller_diameter * 1e6
        return 44.0 * (1.0 - row.gamma) * row.rollers * area * cosine
    return static_factor(row) * row.balls * (1e3 * row.ball_diameter) ** 2 * cosine


def static_factor(row: BallBearing) -> float:
    """Return f_0 (N and mm): a fifth of the load that presses a ball of 1 mm with 4200 MPa, by Hertz exactly.

    That reproduces the table of ISO 76 (grooves 0.52 and 0.53 of the ball diameter); wider grooves lower it.
    """
    modulus = contact_modulus(ISO76_STEEL, ISO76_STEEL)
    d = 1e-3
    loads = []
    for radius, least, sign in (
        (row.inner_groove_radius, 0.52, -1.0),
        (row.outer_groove_radius, 0.53, 1.0),
    ):
        groove = max(radius / row.ball_diameter, least)
        across = 2.0 / d / (1.0 + sign * row.gamma)
        loads.append(point_contact((across, 2.0 / d - 1.0 / (groove * d)), modulus).load_at(PERMISSIBLE))
    return 0.2 * min(loads)


def static_load(row: Row, radial: float, axial: float) -> float:
    """Return the equivalent static load P_0r = max(X_0 F_r + Y_0 F_a, F_r) (ISO 76, one row), N."""
    _fail_if_negative(radial, axial)
    angle = float(np.degrees(row.contact_angle))
    if isinstance(row, RollerRow):
        _fail_if_pushed(row, axial)
        thrust = 0.22 / np.tan(row.contact_angle) if angle > 0.0 else 0.0
        return max(0.5 * radial + float(thrust) * axial, radial)
    if angle == 0.0:
        return max(0.6 * radial + 0.5 * axial, radial)
    angles, thrusts = np.array(BALL_STATIC).T
    _fail_if_outside("angular contact ball bearing: P_0", angle, (5.0, 45.0))
    return max(0.5 * radial + float(np.interp(angle, angles, thrusts)) * axial, radial)


def static_safety(row: Row, radial: float, axial: float) -> float:
    """Return S_0 = C_0r/P_0r; infinite without load."""
    load = static_load(row, radial, axial)
    return static_rating(row) / load if load > 0.0 else float("inf")


def dynamic_load(row: Row, radial: float, axial: float) -> float:
    """Return the equivalent dynamic load P_r = X F_r + Y F_a (ISO 281, one row, inner or outer ring turning), N."""
    _fail_if_negative(radial, axial)
    angle = float(np.degrees(row.contact_angle))
    if isinstance(row, RollerRow):
        _fail_if_pushed(row, axial)
        if angle == 0.0:
            return radial
        tangent = float(np.tan(row.contact_angle))
        limit, share, thrust = 1.5 * tangent, 0.4, 0.4 / tangent
    elif angle == 0.0:
        relative, limits, thrusts = np.array(GROOVE_DYNAMIC).T
        at = static_factor(row) * axial / static_rating(row)
        limit, thrust = float(np.interp(at, relative, limits)), float(np.interp(at, relative, thrusts))
        share = 0.56
    else:
        _fail_if_outside("angular contact ball bearing: P", angle, (20.0, 45.0))
        angles, *columns = np.array(ANGULAR_DYNAMIC).T
        limit, share, thrust = (float(np.interp(angle, angles, c)) for c in columns)
    return share * radial + thrust * axial if axial > limit * radial else radial


def basic_life(row: Row, load: float, rating: float | None = None) -> float:
    """Return L_10 = (C/P)^p (ISO 281) in revolutions; p = 3 for balls, 10/3 for rollers; `rating` C if not C_r."""
    if not load > 0.0:
        raise Infeasible(f"bearing life needs an equivalent load > 0, given {load} N")
    capacity = dynamic_rating(row) if rating is None else rating
    return float(1e6 * (capacity / load) ** exponent(row))


def exponent(row: Row) -> float:
    """Return the life exponent p."""
    return 10.0 / 3.0 if isinstance(row, RollerRow) else 3.0


def pressures(row: Row, state: RollingState, steel: Material = STEEL) -> tuple[Array, Array]:
    """Return the largest Hertz pressures (…, n) at the inner and the outer raceway, Pa.

    Rollers are of `steel` and pressed as slices, without what happens at sharp edges.
    """
    if isinstance(row, BallBearing):
        inner, outer = row.contacts
        return inner.pressure(state.inner_loads), outer.pressure(state.outer_loads)
    line = state.slice_loads.max(axis=-1) * row.slices / row.length
    modulus = contact_modulus(steel, steel)
    curvatures = (2.0 / row.roller_diameter / (1.0 + s * row.gamma) for s in (-1.0, 1.0))
    inside, outside = (np.sqrt(line * modulus * c / np.pi) for c in curvatures)
    return inside, outside


def _fail_if_negative(radial: float, axial: float) -> None:
    if not (radial >= 0.0 and axial >= 0.0 and np.isfinite(radial + axial)):
        raise Infeasible(f"equivalent loads need amounts ≥ 0 of F_r and F_a, given {radial} N and {axial} N")


def _fail_if_pushed(row: RollerRow, axial: float) -> None:
    if row.contact_angle == 0.0 and axial > 0.0:
        raise Infeasible(
            f"a cylindrical roller bearing's equivalent load has no axial part, given F_a = {axial:.6g} N; "
            f"the load on ribs is rated by its maker"
        )


def _fail_if_outside(what: str, angle: float, span: tuple[float, float]) -> None:
    if not span[0] <= angle <= span[1] + 1e-9:
        raise Infeasible(
            f"{what} is tabulated for contact angles from {span[0]:g}° to {span[1]:g}°, given {angle:.6g}°; use the "
            f"rolling elements' own loads (reference_life, pressures)"
        )

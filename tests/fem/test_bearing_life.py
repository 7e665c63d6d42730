"""Ratings and lives against the tables of ISO 76 and ISO 281 and a public comparison with MASTA."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.fem.rolling_cases import ANGULAR_218, CYLINDRICAL, DEEP, LOOSE, TAPERED, iso16281_ball_bearing
from trochoid.fem.bearing_life import (
    RELIABILITY,
    edge_factors,
    life_modification,
    raceway_ratings,
    reference_life,
)
from trochoid.fem.bearing_rating import (
    ball_factor,
    basic_life,
    dynamic_load,
    dynamic_rating,
    pressures,
    roller_factor,
    static_factor,
    static_load,
    static_rating,
    static_safety,
)
from trochoid.fem.rolling_assumed import (
    assumed_ball_bearing,
    assumed_needle_bearing,
    assumed_roller_bearing,
    assumed_tapered_bearing,
)
from trochoid.fem.rolling_ball import BallBearing
from trochoid.fem.rolling_equilibrium import solve
from trochoid.fem.rolling_roller import RollerRow
from trochoid.kinematics.errors import Infeasible


@pytest.mark.published
@pytest.mark.parametrize(
    ("clearance", "load", "printed"),
    [
        (0.0, (1e3, 0.0, 0.0, 0.0, 0.0), 13163.019),
        (0.0, (0.0, 0.0, 1e3, 0.0, 0.0), 2222.7318),
        (10e-6, (1e3, 0.0, 0.0, 0.0, 0.0), 10795.7948),
        (10e-6, (0.0, 0.0, 1e3, 0.0, 0.0), 3115.8781),
        (10e-6, (1e3, 0.0, 1e3, 0.0, 0.0), 1630.5367),
    ],
)
def test_reference_life(clearance: float, load: tuple[float, ...], printed: float) -> None:
    """ISO/TS 16281 by MASTA (minzhun/ISO16281), C = 23.4 kN: L_10r in 10⁶ revolutions, to 1e-4."""
    bearing = iso16281_ball_bearing(clearance)
    life = reference_life(bearing, solve(bearing, np.array(load)), 23400.0)
    assert float(life.revolutions) / 1e6 == pytest.approx(printed, rel=1e-4)
    assert float(life.equivalent) == pytest.approx(23400.0 * printed ** (-1 / 3), rel=1e-4)


@pytest.mark.published
def test_table_of_ball_factors() -> None:
    """ISO 281, table of f_c of radial ball bearings: to its rounding."""
    gammas = [0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.12, 0.14, 0.16, 0.18, 0.20, 0.22, 0.24, 0.26, 0.28, 0.30]
    printed = [46.7, 49.1, 51.1, 52.8, 54.3, 55.5, 57.5, 58.8, 59.6, 59.9, 59.9, 59.6, 59.0, 58.2, 57.1, 56.0]
    assert [ball_factor(g) for g in gammas] == pytest.approx(printed, abs=0.06)


@pytest.mark.published
def test_table_of_roller_factors() -> None:
    """ISO 281, table of f_c of radial roller bearings: to its rounding."""
    gammas = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.12, 0.14, 0.16, 0.18, 0.20, 0.22]
    printed = [52.1, 60.8, 66.5, 70.7, 74.1, 76.9, 79.2, 81.2, 82.8, 84.2, 86.4, 87.7, 88.5, 88.8, 88.7, 88.2]
    assert [roller_factor(g) for g in gammas] == pytest.approx(printed, abs=0.1)


@pytest.mark.published
def test_table_of_static_factors() -> None:
    """ISO 76, table of f_0 of radial ball bearings: from exact Hertz at 4200 MPa, to its rounding."""
    printed = {0.01: 14.9, 0.02: 15.1, 0.05: 15.7, 0.09: 16.5, 0.10: 16.4, 0.11: 16.1, 0.12: 15.9, 0.20: 14.0}
    for gamma, factor in printed.items():
        bearing = BallBearing(9, 1e-3, 1e-3 / gamma, 0.52e-3, 0.53e-3)
        assert static_factor(bearing) == pytest.approx(factor, abs=0.06)


@pytest.mark.published
def test_a_catalogue_bearing() -> None:
    """6305 (Z = 7, D = 11.5, D_pw = 43.5 mm): makers print C = 22.5 … 23.4 kN and C_0 = 11.6 kN."""
    bearing = iso16281_ball_bearing()
    assert dynamic_rating(bearing) == pytest.approx(22.5e3, rel=0.01)
    assert static_rating(bearing) == pytest.approx(11.6e3, rel=0.01)


@pytest.mark.independent
@pytest.mark.parametrize("balls", [40, 120])
def test_reference_life_of_half_the_balls_loaded_is_the_basic_life(balls: int) -> None:
    """A bearing without clearance under radial load is what ISO 281 stands on: P_ref = F_r to 0.2 %."""
    d = 0.9 * 60e-3 * np.sin(np.pi / balls)
    bearing = BallBearing(balls, d, 60e-3, 0.52 * d, 0.53 * d)
    life = reference_life(bearing, solve(bearing, np.array([50.0, 0.0, 0.0, 0.0, 0.0])))
    assert float(life.equivalent) == pytest.approx(50.0, rel=2e-3)
    assert float(life.revolutions) == pytest.approx(basic_life(bearing, 50.0), rel=6e-3)


@pytest.mark.independent
def test_reference_life_of_rollers() -> None:
    """Half of straight rollers loaded, no edges: L_10r = (C/(0.83 F))⁴, as C holds the factor 0.83 for edges."""
    row = RollerRow(60, 2.8e-3, 60e-3, 12e-3)
    state = solve(row, np.array([2000.0, 0.0, 0.0, 0.0, 0.0]))
    life = reference_life(row, state, edges=False)
    expected = 1e6 * (dynamic_rating(row) / (0.83 * 2000.0)) ** 4
    assert float(life.revolutions) == pytest.approx(expected, rel=2e-2)
    more = reference_life(replace(row, slices=60), solve(replace(row, slices=60), state.load), edges=False)
    assert float(more.revolutions) == pytest.approx(float(life.revolutions), rel=1e-6)
    assert reference_life(row, state).revolutions < life.revolutions


@pytest.mark.exact
def test_lives_add_up() -> None:
    """Both raceways survive: L^(−10/9) = L_i^(−10/9) + L_e^(−10/9); a turning outer ring is worse for the inner."""
    state = solve(DEEP, np.array([3000.0, 0.0, 0.0, 0.0, 0.0]))
    life = reference_life(DEEP, state)
    both = life.inner ** (-10 / 9) + life.outer ** (-10 / 9)
    assert float(life.revolutions) == pytest.approx(float(both**-0.9), rel=1e-12)
    assert reference_life(DEEP, state, inner_turns=False).inner < life.inner
    assert float(life.hours(2 * np.pi * 25)) == pytest.approx(float(life.revolutions) / 25 / 3600, rel=1e-12)


@pytest.mark.exact
def test_life_without_load_has_no_end() -> None:
    """An open bearing lives for ever; many states keep their axis."""
    states = solve(LOOSE, np.array([[0.0] * 5, [1000.0, 0.0, 0.0, 0.0, 0.0]]))
    life = reference_life(LOOSE, states)
    assert np.isinf(life.revolutions[0])
    assert np.isfinite(life.revolutions[1])
    assert life.equivalent[0] == 0.0


@pytest.mark.exact
def test_equivalent_loads() -> None:
    """ISO 281 and ISO 76: the factors as tabulated, at their nodes and either side of e."""
    c0, f0 = static_rating(DEEP), static_factor(DEEP)
    axial = 1.03 * c0 / f0
    assert dynamic_load(DEEP, 2.0 * axial, axial) == pytest.approx(0.56 * 2.0 * axial + 1.55 * axial)
    assert dynamic_load(DEEP, 5.0 * axial, axial) == 5.0 * axial
    assert static_load(DEEP, 1000.0, 4000.0) == pytest.approx(0.6 * 1000.0 + 0.5 * 4000.0)
    assert static_load(DEEP, 1000.0, 100.0) == 1000.0
    assert dynamic_load(ANGULAR_218, 1000.0, 2000.0) == pytest.approx(350.0 + 0.57 * 2000.0)
    assert static_load(ANGULAR_218, 1000.0, 9000.0) == pytest.approx(500.0 + 0.26 * 9000.0)
    cotangent = 1.0 / np.tan(TAPERED.contact_angle)
    assert dynamic_load(TAPERED, 1000.0, 500.0) == pytest.approx(400.0 + 0.4 * cotangent * 500.0)
    assert static_load(TAPERED, 1000.0, 900.0) == pytest.approx(500.0 + 0.22 * cotangent * 900.0)
    assert dynamic_load(CYLINDRICAL, 700.0, 0.0) == 700.0
    assert static_safety(CYLINDRICAL, 700.0, 0.0) == pytest.approx(static_rating(CYLINDRICAL) / 700.0)
    assert static_safety(CYLINDRICAL, 0.0, 0.0) == np.inf
    area = 12.0 * 11.0 * 14
    assert static_rating(CYLINDRICAL) == pytest.approx(44.0 * (1.0 - 11.0 / 60.0) * area)


@pytest.mark.exact
def test_what_is_not_offered_is_refused() -> None:
    """Angles outside of the tables, axial load on cylindrical rollers, negative loads, no load."""
    flat = replace(ANGULAR_218, contact_angle=np.radians(15.0))
    with pytest.raises(Infeasible, match="from 20° to 45°"):
        dynamic_load(flat, 1000.0, 1000.0)
    with pytest.raises(Infeasible, match="ribs"):
        dynamic_load(CYLINDRICAL, 1000.0, 1.0)
    with pytest.raises(Infeasible, match="amounts"):
        static_load(DEEP, -1.0, 0.0)
    with pytest.raises(Infeasible, match="> 0"):
        basic_life(DEEP, 0.0)
    with pytest.raises(Infeasible, match="κ"):
        life_modification(DEEP, 0.05, 0.1)
    with pytest.raises(Infeasible, match="rating > 0"):
        reference_life(DEEP, solve(DEEP, np.zeros(5)), 0.0)


@pytest.mark.property
@pytest.mark.parametrize("row", [DEEP, CYLINDRICAL])
def test_modification_factor(row: BallBearing | RollerRow) -> None:
    """ISO 281:2007: a_ISO joins at κ = 0.4 and 1, grows with κ and with the fatigue limit, lies in 0.1 … 50."""
    for kappa in (0.4, 1.0):
        below, above = (life_modification(row, k, 0.2) for k in (kappa - 1e-9, kappa))
        assert below == pytest.approx(above, rel=1e-3)
    values = [life_modification(row, k, 0.3) for k in (0.1, 0.3, 0.7, 2.0, 4.0)]
    assert (np.diff(values) > 0.0).all()
    assert life_modification(row, 0.1, 0.0) == 0.1
    assert life_modification(row, 4.0, 5.0) == 50.0
    assert life_modification(row, 9.0, 0.1) == life_modification(row, 4.0, 0.1)
    assert RELIABILITY[90] == 1.0


@pytest.mark.exact
def test_edge_factors() -> None:
    """ISO/TS 16281: symmetric, 1 in the middle, 1 − 0.01/ln(1.985/2) at the ends."""
    f = edge_factors(31)
    assert f == pytest.approx(f[::-1])
    assert f[15] == 1.0
    assert f[0] == pytest.approx(1.0 - 0.01 / np.log(0.9925))


@pytest.mark.exact
def test_pressures() -> None:
    """Balls: Hertz' ellipse; rollers: p² = qE*/(πR) of the slice pressed most."""
    state = solve(ANGULAR_218, np.array([0.0, 0.0, 17800.0, 0.0, 0.0]))
    inner, outer = pressures(ANGULAR_218, state)
    long, short = ANGULAR_218.contacts[0].semi_axes(state.inner_loads)
    assert inner == pytest.approx(1.5 * state.inner_loads / (np.pi * long * short), rel=1e-12)
    assert (outer < inner).all()
    row = replace(CYLINDRICAL, drop=(), clearance=0.0)
    state = solve(row, np.array([5000.0, 0.0, 0.0, 0.0, 0.0]))
    inner, outer = pressures(row, state)
    radius = 0.5 * 11e-3 * (1.0 - 11.0 / 60.0)
    modulus = 206e9 / (2.0 * 0.91)
    assert inner[0] == pytest.approx(
        np.sqrt(state.inner_loads[0] / 12e-3 * modulus / (np.pi * radius)), rel=1e-9
    )
    assert outer[0] < inner[0]


@pytest.mark.exact
def test_raceway_ratings_share() -> None:
    """ISO/TS 16281: with equal powers inside, (Q_ci·0.407)^(−10/3) + (Q_ce·0.389)^(−10/3) = (C/Z)^(−10/3)."""
    inner, outer = raceway_ratings(DEEP, 30e3)
    whole = (0.407 * inner) ** (-10 / 3) + (0.389 * outer) ** (-10 / 3)
    assert whole == pytest.approx((30e3 / 9) ** (-10 / 3), rel=1e-12)


@pytest.mark.published
@pytest.mark.parametrize(
    ("size", "balls", "diameter", "rating"),
    [((30, 62, 16), 9, 9.525, 19.5), ((20, 47, 14), 8, 7.938, 12.8), ((25, 62, 17), 7, 11.5, 22.5)],
)
def test_assumed_ball_bearings(
    size: tuple[float, float, float], balls: int, diameter: float, rating: float
) -> None:
    """6206, 6204, 6305 of makers' catalogues: number of balls, diameter within 5 %, C in kN within 7 %."""
    d, outside, width = (1e-3 * s for s in size)
    bearing = assumed_ball_bearing(d, outside, width)
    assert bearing.balls == balls
    assert 1e3 * bearing.ball_diameter == pytest.approx(diameter, rel=0.05)
    assert dynamic_rating(bearing) == pytest.approx(1e3 * rating, rel=0.07)


@pytest.mark.published
def test_assumed_roller_bearings() -> None:
    """NU 206, NU 208 and 30206 of makers' catalogues: C_0 = 36.5, 53 and 44 … 50 kN, within 15 %."""
    for size, printed in (((30, 62, 16), 36.5), ((40, 80, 18), 53.0)):
        d, outside, width = (1e-3 * s for s in size)
        assert static_rating(assumed_roller_bearing(d, outside, width)) == pytest.approx(
            1e3 * printed, rel=0.15
        )
    assert static_rating(assumed_tapered_bearing(30e-3, 62e-3, 17.25e-3)) == pytest.approx(47e3, rel=0.15)


@pytest.mark.property
def test_assumed_bearings_fit_in_their_rings() -> None:
    """Over sizes: elements stay between bore and outside diameter, and do not overlap; nonsense is refused."""
    for bore, outside, width in ((10, 26, 8), (50, 110, 27), (90, 160, 30), (200, 250, 24)):
        d, o, w = 1e-3 * bore, 1e-3 * outside, 1e-3 * width
        ball = assumed_ball_bearing(d, o, w, np.radians(25.0))
        for element, pitch in (
            (ball.ball_diameter, ball.pitch_diameter),
            *(
                (r.roller_diameter, r.pitch_diameter)
                for r in (assumed_roller_bearing(d, o, w), assumed_tapered_bearing(d, o, w))
            ),
        ):
            assert pitch - element > d
            assert pitch + element < o
        needle = assumed_needle_bearing(d, d + 8e-3, w)
        assert needle.pitch_diameter - needle.roller_diameter == pytest.approx(d)
    with pytest.raises(Infeasible, match="bore"):
        assumed_ball_bearing(0.05, 0.04, 0.01)

"""Roller bearings in slices against the cylindrical law, closed forms and integrals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.fem.rolling_cases import CYLINDRICAL, TAPERED
from trochoid.fem import bearing, bearing_equilibrium
from trochoid.fem.bearing import RollerBearing, iso16281_constant
from trochoid.fem.rolling import load_distribution
from trochoid.fem.rolling_equilibrium import solve
from trochoid.fem.rolling_roller import RollerRow, crowned, logarithmic, row_of, slice_positions
from trochoid.kinematics.errors import Infeasible

HELD = [0, 1, 3, 4]


@pytest.mark.published
def test_constant_of_a_row() -> None:
    """ISO/TS 16281: a straight roller pressed evenly follows Q = 35 948·L^(8/9)·δ^(10/9) in N and mm."""
    row = RollerRow(12, 5e-3, 40e-3, 10e-3)
    state = load_distribution(row, np.array([10e-6, 0.0, 0.0, 0.0, 0.0]))
    assert state.inner_loads[0] == pytest.approx(35948.0 * 10.0 ** (8 / 9) * 0.01 ** (10 / 9), rel=1e-12)


@pytest.mark.independent
def test_a_straight_row_is_the_cylindrical_bearing() -> None:
    """Contact angle 0 and no profile: the law of `bearing`, which knows neither, at a displacement and under a load."""
    old = RollerBearing(13, 2.5e-3, 20e-3, 10e-3, clearance=12e-6)
    q = np.array([3e-5, -1e-5, 1e-3, -5e-4])
    first = bearing.load_distribution(old, q, 0.07)
    second = load_distribution(row_of(old), np.insert(q, 2, 0.0), 0.07)
    assert second.slice_loads == pytest.approx(first.slice_loads, rel=1e-11, abs=1e-9)
    assert second.load[HELD] == pytest.approx(first.load, rel=1e-11)
    assert second.stiffness[np.ix_(HELD, HELD)] == pytest.approx(first.stiffness, rel=1e-11, abs=1e-6)
    assert not second.stiffness[2].any()
    load = np.array([900.0, -200.0, 2.0, 0.5])
    solved = solve(row_of(old), np.insert(load, 2, 0.0))
    reference = bearing_equilibrium.solve(old, load)
    assert solved.displacement[HELD] == pytest.approx(reference.displacement, rel=1e-6, abs=1e-12)


@pytest.mark.exact
def test_axially_pushed_tapered_row() -> None:
    """Every roller carries F/(Z sin α) and approaches z sin α evenly; the axial stiffness is Z sin²α dQ/dδ."""
    row, force = replace(TAPERED, drop=()), 8000.0
    state = solve(row, np.array([0.0, 0.0, force, 0.0, 0.0]))
    sine = np.sin(row.contact_angle)
    load = force / (row.rollers * sine)
    approach = (load / iso16281_constant(row.length)) ** 0.9
    assert state.inner_loads == pytest.approx(np.full(17, load), rel=1e-9)
    assert state.displacement[2] == pytest.approx(approach / sine, rel=1e-9)
    assert state.stiffness[2, 2] == pytest.approx(row.rollers * sine**2 * load / (0.9 * approach), rel=1e-9)


@pytest.mark.exact
def test_tilt_lever_of_a_tapered_row() -> None:
    """The line of action meets the axis R tan α before the centre.

    A tilt about the pressure centre moves the rollers' middles along their contact lines only.
    """
    row = replace(TAPERED, drop=(), slices=31)
    height = -0.5 * row.pitch_diameter * np.tan(row.contact_angle)
    tilt = 1e-4
    shift = np.array([-tilt * height, 0.0, 0.0, 0.0, tilt])  # the point at (0, 0, height) stays
    middle = row.arms(np.linspace(0.0, 6.0, 7))[:, 15] @ shift
    assert middle == pytest.approx(np.zeros(7), abs=1e-18)


@pytest.mark.exact
def test_rigid_limit_of_rollers() -> None:
    """c_L → ∞: under an axial load all displacements vanish as c^(−0.9), the loads stay."""
    loads, shifts = [], []
    for factor in (1.0, 1e5, 1e10):
        state = solve(replace(TAPERED, drop=(), factor=factor), np.array([500.0, 0.0, 8000.0, 0.0, 0.0]))
        loads.append(state.inner_loads)
        shifts.append(state.displacement)
    assert loads[1] == pytest.approx(loads[0], rel=1e-7)
    assert shifts[2] == pytest.approx(shifts[1] * 10.0**-4.5, rel=1e-6, abs=1e-20)


@pytest.mark.published
def test_profile_of_iso16281() -> None:
    """ISO/TS 16281: P(x) = 0.00035 D ln(1/(1−(2x/L)²)), and for long rollers only outside of (L − 2.5 D)/2."""
    d, length, n = 10e-3, 12e-3, 24
    x = slice_positions(length, n)
    expected = 0.00035 * d * np.log(1.0 / (1.0 - (2.0 * x / length) ** 2))
    assert logarithmic(d, length, n) == pytest.approx(expected, rel=1e-12)
    d, length = 2e-3, 16e-3
    x = np.abs(slice_positions(length, n))
    drops = np.array(logarithmic(d, length, n))
    straight = x <= 0.5 * (length - 2.5 * d)
    outside = 2.0 * x[~straight] - (length - 2.5 * d)
    bent = 0.0005 * d * np.log(1.0 / (1.0 - (outside / (2.5 * d)) ** 2))
    assert not drops[straight].any()
    assert drops[~straight] == pytest.approx(bent, rel=1e-9)


@pytest.mark.exact
def test_crowned_roller_against_its_integral() -> None:
    """One crowned roller pressed by δ: Q = c/L ∫(δ − x²/R)^(10/9) dx, a beta function; slices converge."""
    from scipy.special import beta

    length, radius, approach = 10e-3, 0.4, 30e-6
    half = np.sqrt(approach * radius)
    assert half < 0.5 * length
    density = iso16281_constant(length) / length
    exact = density * approach ** (10 / 9) * half * beta(0.5, 10 / 9 + 1)
    errors = []
    for n in (30, 120, 480):
        row = RollerRow(3, 1e-3, 20e-3, length, slices=n, drop=crowned(length, radius, n))
        state = load_distribution(row, np.array([approach, 0.0, 0.0, 0.0, 0.0]))
        errors.append(abs(state.inner_loads[0] / exact - 1.0))
    assert errors[0] < 5e-3
    assert errors[2] < 5e-5


@pytest.mark.property
def test_profile_takes_load_off_the_ends() -> None:
    """Under tilt a profiled roller's ends are pressed less than a straight one's."""
    load, tilted = np.array([4000.0, 0.0, 0.0, 0.0, 0.0]), {"tilt_y": 2e-3}
    straight = solve(replace(CYLINDRICAL, drop=()), load, tilted).slice_loads.max()
    assert solve(CYLINDRICAL, load, tilted).slice_loads.max() < 0.9 * straight


@pytest.mark.exact
@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"rollers": 2}, "at least 3"),
        ({"roller_diameter": 20e-3}, "rollers overlap"),
        ({"contact_angle": 2.0}, "contact angle"),
        ({"drop": (1e-6,)}, "profile"),
        ({"factor": 0.0}, "factor"),
    ],
)
def test_impossible_rows_are_refused(changes: dict[str, float], said: str) -> None:
    """Every refusal names what was given and what is allowed."""
    with pytest.raises(Infeasible, match=said):
        replace(CYLINDRICAL, **changes)  # type: ignore[arg-type]

"""Rolling bearings under the loads of a turn: published lives and matrices, sums over loads, invariants, refusals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fem.rolling_cases import (
    ANGULAR_218,
    BEARINGS,
    CYLINDRICAL,
    DEEP,
    LOOSE,
    STRAIGHT,
    iso16281_ball_bearing,
    passable,
)
from trochoid.fem.bearing_duty import Lubrication, duty, elements, endurance, fail_if_loose, row_of
from trochoid.fem.rolling_equilibrium import solve
from trochoid.kinematics.errors import Infeasible

UPRIGHT = {"tilt_x": 0.0, "tilt_y": 0.0}
PLAIN = {**UPRIGHT, "z": 0.0}
parts = st.tuples(*[st.floats(-1.0, 1.0).filter(lambda v: abs(v) > 1e-3)] * 5).map(np.array)


@pytest.mark.published
@pytest.mark.parametrize(
    ("clearance", "load", "printed"),
    [(0.0, (1e3, 0, 0, 0, 0), 13163.019), (10e-6, (1e3, 0, 1e3, 0, 0), 1630.5367)],
)
def test_life_of_one_load(clearance: float, load: tuple[float, ...], printed: float) -> None:
    """ISO/TS 16281 by MASTA (minzhun/ISO16281), C = 23.4 kN: L_10r in 10⁶ revolutions, to 1e-4."""
    found = endurance(duty(iso16281_ball_bearing(clearance), np.array(load), {}, places=1), 23400.0)
    assert 1e-6 * found.reference == pytest.approx(printed, rel=1e-4)
    assert found.equivalent == pytest.approx(23400.0 * printed ** (-1 / 3), rel=1e-4)


@pytest.mark.published
def test_load_along_the_axis_alone() -> None:
    """218 under 17.8 kN (verification, Lim–Singh): k_xx and k_zz; the balls carry alike wherever they stand."""
    found = duty(ANGULAR_218, np.array([0, 0, 17.8e3, 0, 0]), {})
    assert found.mean[0, 0] == pytest.approx(4.85257e8, rel=2e-4)
    assert found.mean[2, 2] == pytest.approx(7.65376e8, rel=2e-4)
    assert found.element_load == pytest.approx(1678.8, rel=1e-4)
    assert found.carrying == (16, 16)
    lasting = endurance(found)
    assert lasting.static is not None
    assert lasting.basic is not None
    alone = duty(ANGULAR_218, np.array([0, 0, 17.8e3, 0, 0]), {}, 1).mean
    np.testing.assert_allclose(alone, found.mean, rtol=1e-9, atol=1e-9 * found.mean[0, 0])


@pytest.mark.exact
def test_wear_adds_up_over_the_loads() -> None:
    """Palmgren–Miner: the share of life that each load takes, each for the same revolutions; the worst one sinks in."""
    light, heavy = np.array([800.0, 0, 0, 0, 0]), np.array([0, 3000.0, 0, 0, 0])
    one, two, both = (
        endurance(duty(DEEP, load, UPRIGHT)) for load in (light, heavy, np.stack([light, heavy]))
    )
    assert 2.0 / both.reference == pytest.approx(1.0 / one.reference + 1.0 / two.reference, rel=1e-12)
    assert both.basic is not None
    assert one.basic is not None
    assert two.basic is not None
    assert 2.0 / both.basic == pytest.approx(1.0 / one.basic + 1.0 / two.basic, rel=1e-9)
    assert both.static == two.static
    assert both.permissible == two.permissible


@pytest.mark.exact
def test_permissible_load_presses_as_the_standard_says() -> None:
    """A deep groove's most loaded ball at P_0r = C_0r: Stribeck's 5 F/Z (ISO 76): a ratio near 1; it goes with 1/F."""
    from trochoid.fem.bearing_rating import static_rating

    full = duty(DEEP, np.array([static_rating(DEEP), 0, 0, 0, 0]), UPRIGHT)
    found = endurance(full)
    assert found.static == pytest.approx(1.0, rel=1e-12)
    assert found.permissible == pytest.approx(
        1.0, rel=0.2
    )  # 4.37 F/Z without clearance, 5 F/Z in the standard
    # pressure³ is the load of one ball, pressure² that of one slice
    half = duty(DEEP, 0.5 * full.loads, UPRIGHT)
    ratio = full.element_load / half.element_load
    assert endurance(half).permissible == pytest.approx(found.permissible * ratio, rel=1e-9)


@pytest.mark.property
@settings(max_examples=25, deadline=None)
@given(st.sampled_from(sorted(BEARINGS)), parts, st.integers(1, 5))
def test_mean_stiffness_is_one_of_an_energy(name: str, part: np.ndarray, turn: int) -> None:
    """Symmetric and positive semi-definite; loads turned by pitches of the elements turn the matrix with them."""
    bearing = BEARINGS[name]
    load = passable(name, part, 2000.0)
    held = {"z": 0.0} if name in STRAIGHT else {}
    found = duty(bearing, load, held, 2).mean
    lever = bearing.lever
    unit = np.array([1.0, 1.0, 1.0, lever, lever])
    scaled = found / np.outer(unit, unit)
    size = float(np.abs(scaled).max())
    np.testing.assert_allclose(scaled, scaled.T, atol=1e-12 * size)
    assert np.linalg.eigvalsh(scaled).min() > -1e-12 * size
    angle = 2.0 * np.pi * turn / elements(row_of(bearing))
    c, s = np.cos(angle), np.sin(angle)
    spin = np.eye(5)
    spin[:2, :2] = spin[3:, 3:] = [[c, -s], [s, c]]
    turned = duty(bearing, spin @ load, held, 2).mean
    np.testing.assert_allclose(
        turned / np.outer(unit, unit), spin @ scaled @ spin.T, atol=2e-6 * size
    )  # Newton's tolerance on a stiffness that goes with a root of the load


@pytest.mark.property
def test_more_load_is_stiffer_and_lasts_less() -> None:
    """Balls and rollers, radial loads over three decades; clearance shortens the life and softens the bearing."""
    for bearing, held in ((DEEP, UPRIGHT), (CYLINDRICAL, PLAIN)):
        found = [duty(bearing, np.array([f, 0, 0, 0, 0]), held) for f in (50.0, 500.0, 5000.0, 50000.0)]
        along = [float(x.along[0]) for x in found]
        lives = [endurance(x).reference for x in found]
        assert along == sorted(along)
        assert lives == sorted(lives, reverse=True)
    load = np.array([1000.0, 0, 0, 0, 0])
    tight, loose = duty(DEEP, load, UPRIGHT), duty(LOOSE, load, UPRIGHT)
    assert tight.along[0] > loose.along[0]
    assert endurance(tight).reference > endurance(loose).reference


@pytest.mark.property
def test_oil_makes_a_life_longer_or_shorter() -> None:
    """a_ISO multiplies the reference life: poor lubrication shortens it, clean and thick oil lengthens it."""
    found = duty(DEEP, np.array([1000.0, 0, 0, 0, 0]), UPRIGHT)
    plain = endurance(found)
    poor, good = (endurance(found, lubrication=Lubrication(k, 500.0, 0.8)).modified for k in (0.15, 4.0))
    assert plain.modified is None
    assert poor is not None
    assert good is not None
    assert poor < plain.reference < good


@pytest.mark.exact
def test_open_bearing_is_said_to_hold_nothing() -> None:
    """Clearance and no load: zero stiffness, no life to end, and refused where a member would stand on it."""
    found = duty(LOOSE, np.zeros(5), UPRIGHT)
    assert not found.mean.any()
    assert found.carrying == (0, 0)
    lasting = endurance(found)
    assert lasting.reference == lasting.static == lasting.basic == lasting.permissible == np.inf
    with pytest.raises(
        Infeasible, match=r"bearing X resists nothing in one of its directions.*; give a load"
    ):
        fail_if_loose("bearing X", found.mean[:2, :2], np.ones(2), "give a load")
    assert found.states[0].note.startswith("no element carries")


@pytest.mark.exact
def test_one_element_that_carries_holds_nothing_across() -> None:
    """A singular preload: one ball on the line of the load and no other; across it there is no stiffness."""
    wide = replace(LOOSE, clearance=400e-6)
    found = duty(wide, np.array([20.0, 0, 0, 0, 0]), {**UPRIGHT, "z": 0.0}, places=1)
    assert found.carrying == (1, 1)
    matrix = found.mean[:2, :2]
    assert matrix[0, 0] > 0.0
    if (
        matrix[1, 1] > 1e-9 * matrix[0, 0]
    ):  # what the load itself gives a ball that rolls off its line is no elasticity
        assert matrix[1, 1] < 0.01 * matrix[0, 0]
    straight = replace(CYLINDRICAL, clearance=400e-6)
    alone = duty(straight, np.array([20.0, 0, 0, 0, 0]), PLAIN, places=1)
    assert alone.carrying == (1, 1)
    with pytest.raises(Infeasible, match="too few elements carry"):
        fail_if_loose("bearing X", alone.mean[:2, :2], np.ones(2), "give a preload")


@pytest.mark.property
def test_stiffness_by_the_places_of_the_elements() -> None:
    """Four places of a pitch: as sixteen to 1e-3 along the load, to 5e-3 of that elsewhere; one is the library's."""
    load = np.array([2000.0, 500.0, 0, 0, 0])
    few, many = (duty(DEEP, load, UPRIGHT, n).mean for n in (4, 16))
    along = load[:2] / np.linalg.norm(load[:2])
    stiff = float(along @ many[:2, :2] @ along)
    assert float(along @ few[:2, :2] @ along) == pytest.approx(stiff, rel=1e-3)
    np.testing.assert_allclose(few[:2, :2], many[:2, :2], rtol=0.0, atol=5e-3 * stiff)
    alone = solve(DEEP, load, UPRIGHT).stiffness
    np.testing.assert_array_equal(duty(DEEP, load, UPRIGHT, 1).mean, alone)

"""All rolling bearings: their laws are gradients, their solver finds any load they can pass and refuses others."""

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
    FAST,
    LOOSE,
    TAPERED,
    TIGHT,
    displacement,
    passable,
)
from trochoid.fem.material import Material
from trochoid.fem.rolling import load_distribution
from trochoid.fem.rolling_equilibrium import solve
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.kinematics.types import Array

names = st.sampled_from(sorted(BEARINGS))
part = st.integers(-1000, 1000).map(lambda v: v / 1000.0)
parts = st.tuples(part, part, part, part, part).map(np.array)
STEPS = np.array([1e-9, 1e-9, 1e-9, 3e-8, 3e-8])
LEVER = np.array([1.0, 1.0, 1.0, 0.03, 0.03])


@pytest.mark.independent
@pytest.mark.parametrize("name", sorted(BEARINGS))
def test_jacobian_against_differences(name: str) -> None:
    """Fourth-order central differences of the load: the matrix is their limit, to 1e-6 of its scaled size."""
    b = BEARINGS[name]
    q = displacement(name, np.array([0.9, -0.4, 0.3, 0.4, -0.7]))
    exact = load_distribution(b, q, 0.05).stiffness
    for column in range(5):
        step = np.zeros(5)
        step[column] = STEPS[column]
        at = [load_distribution(b, q + k * step, 0.05).load for k in (-2, -1, 1, 2)]
        difference = (at[0] - 8.0 * at[1] + 8.0 * at[2] - at[3]) / (12.0 * STEPS[column])
        size = np.abs(exact / np.outer(LEVER, LEVER)).max() * LEVER * LEVER[column]
        assert (np.abs(difference - exact[:, column]) / size).max() <= 1e-6


@pytest.mark.independent
@pytest.mark.parametrize("name", sorted(BEARINGS))
def test_load_is_the_gradient_of_the_energy(name: str) -> None:
    """Fourth-order central differences of the energy (of the resting and of the spinning balls alike)."""
    b = BEARINGS[name]
    q = displacement(name, np.array([0.8, 0.3, 0.5, -0.4, 0.6]))
    load = load_distribution(b, q).load
    difference = np.zeros(5)
    for column in range(5):
        step = np.zeros(5)
        step[column] = 100.0 * STEPS[column]
        at = [float(load_distribution(b, q + k * step).energy) for k in (-2, -1, 1, 2)]
        difference[column] = (at[0] - 8.0 * at[1] + 8.0 * at[2] - at[3]) / (12.0 * step[column])
    assert difference / LEVER == pytest.approx(load / LEVER, abs=1e-6 * np.abs(load / LEVER).max())


@pytest.mark.property
@settings(max_examples=100, deadline=None)
@given(names, parts, st.floats(0.0, 0.5))
def test_stiffness_is_symmetric_and_positive(name: str, u: Array, turn: float) -> None:
    """The load is the gradient of a convex energy, also with centrifugal force."""
    matrix = load_distribution(BEARINGS[name], displacement(name, u), turn).stiffness
    scaled = matrix / np.outer(LEVER, LEVER)
    assert (matrix == matrix.T).all()
    assert np.linalg.eigvalsh(scaled).min() >= -1e-9 * np.abs(scaled).max()


@pytest.mark.property
@settings(max_examples=60, deadline=None)
@given(names, parts, st.integers(-5, 5))
def test_turning_by_pitches_changes_nothing(name: str, u: Array, pitches: int) -> None:
    """Rolling elements are alike: turned by whole pitches the bearing is the same."""
    b, q = BEARINGS[name], displacement(name, u)
    first = load_distribution(b, q, 0.1)
    second = load_distribution(b, q, 0.1 + 2.0 * np.pi * pitches / len(first.angles))
    size = max(float(first.outer_loads.sum()), 1e-9)
    assert second.load == pytest.approx(first.load, abs=1e-9 * size)
    assert np.roll(second.inner_loads, pitches) == pytest.approx(first.inner_loads, abs=1e-9 * size)


@pytest.mark.property
@settings(max_examples=60, deadline=None)
@given(names, parts, st.floats(-3.0, 3.0))
def test_turning_the_axes(name: str, u: Array, turn: float) -> None:
    """Loads are vectors: displacement and elements turned together turn the load."""
    c, s = np.cos(turn), np.sin(turn)
    matrix = np.zeros((5, 5))
    matrix[:2, :2] = matrix[3:, 3:] = [[c, -s], [s, c]]
    matrix[2, 2] = 1.0
    q = displacement(name, u)
    first = load_distribution(BEARINGS[name], q, 0.1)
    second = load_distribution(BEARINGS[name], matrix @ q, 0.1 + turn)
    size = max(float(first.outer_loads.sum()), 1e-9)
    assert second.load == pytest.approx(matrix @ first.load, abs=1e-9 * size)


@pytest.mark.property
@settings(max_examples=30, deadline=None)
@given(parts, st.floats(1e-3, 1e3))
def test_scaling_lengths(u: Array, factor: float) -> None:
    """A bearing λ times as large under λ² times the force is the same in its proportions: units do not matter."""
    q = displacement("tapered", u)
    scale = np.array([factor] * 3 + [1.0] * 2)
    for small, large in (
        (
            LOOSE,
            replace(
                LOOSE,
                ball_diameter=factor * LOOSE.ball_diameter,
                pitch_diameter=factor * LOOSE.pitch_diameter,
                inner_groove_radius=factor * LOOSE.inner_groove_radius,
                outer_groove_radius=factor * LOOSE.outer_groove_radius,
                clearance=factor * LOOSE.clearance,
            ),
        ),
        (
            TAPERED,
            replace(
                TAPERED,
                roller_diameter=factor * TAPERED.roller_diameter,
                pitch_diameter=factor * TAPERED.pitch_diameter,
                length=factor * TAPERED.length,
                drop=tuple(factor * p for p in TAPERED.drop),
            ),
        ),
    ):
        first, second = load_distribution(small, q), load_distribution(large, q * scale)
        size = max(float(first.inner_loads.sum()), 1e-6)
        expected = first.load * factor**2 * np.array([1.0, 1.0, 1.0, factor, factor])
        unit = factor**2 * np.array([1.0, 1.0, 1.0, factor, factor])
        assert second.load / unit == pytest.approx(expected / unit, abs=1e-8 * size)


@pytest.mark.property
@settings(max_examples=100, deadline=None)
@given(names, parts, st.floats(-6.0, 4.5))
def test_solver_balances_any_load(name: str, u: Array, decade: float) -> None:
    """Loads over ten decades, clearance, preload, profile and speed: the load passed is the load given."""
    load = passable(name, u, 10.0**decade)
    state = solve(BEARINGS[name], load)
    error = np.linalg.norm((state.load - load) / LEVER)
    assert error <= 1e-5 * np.linalg.norm(load / LEVER) + 1e-11 * state.outer_loads.sum()


@pytest.mark.property
@pytest.mark.parametrize("name", sorted(BEARINGS))
def test_same_again(name: str) -> None:
    """Solved twice: bit-equal."""
    load = passable(name, np.array([0.5, -0.3, 0.8, 0.2, 0.1]), 3000.0)
    first, second = (solve(BEARINGS[name], load) for _ in range(2))
    assert (first.displacement == second.displacement).all()
    assert (first.stiffness == second.stiffness).all()


@pytest.mark.property
@pytest.mark.parametrize("name", sorted(BEARINGS))
def test_many_loads_at_once(name: str) -> None:
    """Rows of loads give what each gives by itself, from no load to much."""
    loads = np.array(
        [passable(name, np.array([0.5, -0.3, 0.8, 0.2, 0.1]), size) for size in (0.0, 1e-3, 30.0, 8000.0)]
    )
    together = solve(BEARINGS[name], loads)
    for row, load in enumerate(loads):
        alone = solve(BEARINGS[name], load)
        assert together.at(row).load == pytest.approx(alone.load, rel=1e-6, abs=1e-6)
        assert together.at(row).inner_loads == pytest.approx(
            alone.inner_loads, rel=1e-5, abs=1e-6 * max(load.max(), 1e-9)
        )


@pytest.mark.exact
def test_held_displacements() -> None:
    """Held tilts and a held axial preload: the given motions are kept and their reactions are the state's load."""
    held = {"z": 2e-5, "tilt_x": 1e-4, "tilt_y": 0.0}
    state = solve(ANGULAR_218, np.array([1000.0, 0.0, 77.0, 0.0, 0.0]), held)
    assert state.displacement[2:] == pytest.approx([2e-5, 1e-4, 0.0], rel=1e-12)
    assert state.load[:2] == pytest.approx([1000.0, 0.0], abs=1e-6)
    assert state.load[2] > 1000.0
    everything = {"x": 1e-5, "y": 0.0, "z": 0.0, "tilt_x": 0.0, "tilt_y": 0.0}
    state = solve(DEEP, np.zeros(5), everything)
    assert (state.load == load_distribution(DEEP, np.array([1e-5, 0.0, 0.0, 0.0, 0.0])).load).all()


@pytest.mark.exact
@pytest.mark.parametrize("name", ["loose", "cylindrical", "needle", "deep", "tapered"])
def test_without_load(name: str) -> None:
    """No load, no preload: at rest, open, no stiffness, and the state says so."""
    state = solve(BEARINGS[name], np.zeros(5))
    assert not state.displacement.any()
    assert not state.stiffness.any()
    assert "open" in state.note


@pytest.mark.exact
def test_preload_alone_is_stiff() -> None:
    """A press fit of s: every ball carries c (s/2)^1.5, radial stiffness Z/2·1.5 c (s/2)^½ and nothing to note."""
    state = solve(TIGHT, np.zeros(5))
    c = TIGHT.constants[2]
    assert state.inner_loads == pytest.approx(np.full(9, c * 2.5e-6**1.5), rel=1e-9)
    assert state.stiffness[0, 0] == pytest.approx(4.5 * 1.5 * c * 2.5e-6**0.5, rel=1e-9)
    assert state.note == ""


@pytest.mark.exact
def test_one_element_carries_alone() -> None:
    """A tiny load on a loose bearing: one ball, δ = s/2 + (F/c)^(2/3), and the note says it."""
    state = solve(LOOSE, np.array([1e-6, 0.0, 0.0, 0.0, 0.0]))
    assert state.touching == 1
    assert state.displacement[0] == pytest.approx(5e-6 + (1e-6 / LOOSE.constants[2]) ** (2 / 3), rel=1e-9)
    assert "single element" in state.note


@pytest.mark.exact
@pytest.mark.parametrize("bearing", [DEEP, LOOSE, CYLINDRICAL])
def test_pure_moment(bearing: object) -> None:
    """A pure moment is passed by a couple: no net force."""
    state = solve(bearing, np.array([0.0, 0.0, 0.0, 2.0, 0.0]))  # type: ignore[arg-type]
    assert state.load == pytest.approx([0.0, 0.0, 0.0, 2.0, 0.0], abs=1e-7)
    assert state.displacement[3] > 0.0


@pytest.mark.exact
def test_stiff_bearings_move_less() -> None:
    """Young's modulus × 1e9: the displacements of a bearing without clearance fall by 1e6 (Hertz: E^(−2/3))."""
    load = np.array([800.0, 300.0, 0.0, 0.0, 0.0])
    hard = Material(206e18, 0.3)
    soft, rigid = solve(DEEP, load), solve(replace(DEEP, ring=hard, ball=hard), load)
    assert rigid.displacement[:2] * 1e6 == pytest.approx(soft.displacement[:2], rel=2e-3)
    assert rigid.inner_loads == pytest.approx(soft.inner_loads, abs=2.0)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("bearing", "load", "said"),
    [
        (TAPERED, (1000.0, 0.0, 0.0, 0.0, 0.0), "nearest that they can is"),
        (TAPERED, (0.0, 0.0, -100.0, 0.0, 0.0), "nearest that they can is"),
        (TAPERED, (0.0, 0.0, 0.0, 1.0, 0.0), "nearest that they can is"),
        (CYLINDRICAL, (100.0, 0.0, 5.0, 0.0, 0.0), r"nearest that they can is \(100, 0, 0, 0, 0\)"),
        (ANGULAR_218, (1000.0, 0.0, 0.0, 0.0, 0.0), "positive axial load"),
        (ANGULAR_218, (0.0, 0.0, -10.0, 0.0, 0.0), "positive axial load"),
        (ANGULAR_218, (0.0, 0.0, 0.0, 1.0, 0.0), "positive axial load"),
        (ANGULAR_218, (50000.0, 0.0, 100.0, 0.0, 0.0), "more axial load"),
        (FAST, (1000.0, 0.0, 0.0, 0.0, 0.0), "positive axial load"),
    ],
)
def test_loads_that_cannot_be_passed(bearing: object, load: tuple[float, ...], said: str) -> None:
    """Refused with what the bearing could pass and what to do."""
    with pytest.raises(Infeasible, match=said):
        solve(bearing, np.array(load), max_iterations=60)  # type: ignore[arg-type]


@pytest.mark.exact
def test_failures_say_what_to_try() -> None:
    """No load, unknown motions, too few iterations: an error that says so, never a wrong state."""
    with pytest.raises(TrochoidError, match="five finite numbers"):
        solve(DEEP, np.array([np.nan, 0.0, 0.0, 0.0, 0.0]))
    with pytest.raises(TrochoidError, match="five finite numbers"):
        solve(DEEP, np.zeros(4))
    with pytest.raises(TrochoidError, match="x, y, z, tilt_x, tilt_y"):
        solve(DEEP, np.zeros(5), {"spin": 0.0})
    with pytest.raises(NotConverged, match="max_iterations"):
        solve(CYLINDRICAL, np.array([500.0, 200.0, 0.0, 1.0, 0.0]), max_iterations=1)
    loads = np.array([[0.0] * 5, [500.0, 200.0, 0.0, 1.0, 0.0]])
    with pytest.raises(NotConverged) as caught:
        solve(CYLINDRICAL, loads, max_iterations=1)
    assert caught.value.row == 1

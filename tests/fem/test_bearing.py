"""Roller bearing with rigid rings against closed forms, published load factors and finite differences."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import root
from scipy.special import gamma

from trochoid.fem.bearing import (
    RollerBearing,
    iso16281_constant,
    load_distribution,
    seated_stiffness,
    six_by_six,
    stiffness,
)
from trochoid.fem.bearing_equilibrium import solve
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.kinematics.types import Array

PLAIN = RollerBearing(rollers=20, roller_radius=2.5e-3, pitch_radius=20e-3, length=10e-3)
LOOSE = RollerBearing(rollers=20, roller_radius=2.5e-3, pitch_radius=20e-3, length=10e-3, clearance=20e-6)
TIGHT = RollerBearing(rollers=13, roller_radius=2.5e-3, pitch_radius=20e-3, length=10e-3, clearance=-8e-6)

# Harris, Rolling Bearing Analysis: J_r of line contact for ε = 0.1, 0.2 … 1.0
PRINTED = (0.1268, 0.1737, 0.2055, 0.2286, 0.2453, 0.2568, 0.2636, 0.2658, 0.2628, 0.2523)

parts = st.integers(-1000, 1000).map(lambda v: v / 1000.0)
displacements = st.tuples(parts, parts, parts, parts).map(
    lambda u: np.array(u) * np.array([5e-5, 5e-5, 5e-3, 5e-3])
)
bearings = st.sampled_from([PLAIN, LOOSE, TIGHT])


def _rotation(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    plane = np.array([[c, -s], [s, c]])
    return np.kron(np.eye(2), plane)


@pytest.mark.published
def test_constant_of_iso16281() -> None:
    """ISO/TS 16281: Q = 35 948·L^(8/9)·δ^(10/9) in N and mm; here L = 10 mm, δ = 10 µm."""
    newton = 35948.0 * 10.0 ** (8.0 / 9.0) * 0.01 ** (10.0 / 9.0)
    assert iso16281_constant(0.010) * (10e-6) ** (10.0 / 9.0) == pytest.approx(newton, rel=1e-13)


@pytest.mark.exact
@pytest.mark.parametrize("angle0", [0.0, 0.01])
def test_largest_roller_load_without_clearance(angle0: float) -> None:
    """Sjövall's integral in closed form: Q_max Z/F = 2√π Γ((n+3)/2)/Γ((n+2)/2) = 4.0850 (Harris: 4.08)."""
    n = 10.0 / 9.0
    factor = 2.0 * np.sqrt(np.pi) * gamma((n + 3.0) / 2.0) / gamma((n + 2.0) / 2.0)
    bearing = RollerBearing(rollers=600, roller_radius=1e-5, pitch_radius=20e-3, length=10e-3)
    state = solve(bearing, np.array([5000.0, 0.0, 0.0, 0.0]), angle0)
    assert factor == pytest.approx(4.0850, abs=5e-5)
    assert state.roller_loads.max() * bearing.rollers / 5000.0 == pytest.approx(factor, rel=2e-5)


@pytest.mark.published
@pytest.mark.parametrize(
    ("zone", "printed"),
    list(zip(np.arange(0.1, 1.01, 0.1), PRINTED, strict=True)),
)
def test_load_distribution_integral(zone: float, printed: float) -> None:
    """Harris, Rolling Bearing Analysis, table of J_r(ε) for line contact: F = Z Q_max J_r, ε = ½(1 − s/(2δ)).

    The printed values hold for the exponent 1.1, which the quadrature shows; the bearing must give the same
    integral with ISO's 10/9, at most 0.4 % lower.
    """
    shift = 10e-6 / zone
    play = 2.0 * shift * (1.0 - 2.0 * zone)
    bearing = RollerBearing(4000, 1e-6, 20e-3, 10e-3, clearance=play, slices=2)
    state = load_distribution(bearing, np.array([shift, 0.0, 0.0, 0.0]))
    computed = state.load[0] / (bearing.rollers * state.roller_loads.max())
    assert _sjovall(zone, 1.1) == pytest.approx(printed, abs=1e-4)
    assert computed == pytest.approx(_sjovall(zone, 10.0 / 9.0), rel=2e-5)
    assert computed == pytest.approx(printed, rel=4e-3)


def _sjovall(zone: float, n: float) -> float:
    """Return J_r(ε) by quadrature of (1 − (1 − cos ψ)/(2ε))ⁿ cos ψ / 2π over the load zone."""
    end = np.arccos(1.0 - 2.0 * zone)
    value, _ = quad(lambda a: (1.0 - (1.0 - np.cos(a)) / (2.0 * zone)) ** n * np.cos(a), 0.0, end)
    return float(value / np.pi)


@pytest.mark.exact
def test_tilted_roller_converges_to_its_integral() -> None:
    """One roller on its line of action, tilted: ∫ c/L (a + bz)^(10/9) dz exactly; slices converge as h²."""
    a, b, length, n = 30e-6, 1e-3, 10e-3, 10.0 / 9.0
    c = iso16281_constant(length) / length
    low, high = a - 0.5 * b * length, a + 0.5 * b * length
    total = c * (high ** (n + 1.0) - low ** (n + 1.0)) / (b * (n + 1.0))
    errors = []
    for slices in (15, 30, 60):
        bearing = RollerBearing(3, 1e-3, 20e-3, length, clearance=-2 * a, slices=slices)
        state = load_distribution(bearing, np.array([0.0, 0.0, 0.0, b]))
        errors.append(abs(state.roller_loads[0] / total - 1.0))
        assert (np.diff(state.slice_loads[0]) > 0.0).all()
    assert errors[1] < 1e-5
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.02)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.02)


@pytest.mark.independent
@pytest.mark.parametrize("bearing", [PLAIN, LOOSE, TIGHT])
def test_jacobian_against_finite_differences(bearing: RollerBearing) -> None:
    """Central differences of the load: the matrix must be their limit, not an approximation."""
    q = np.array([3.1e-5, 1.3e-5, 1.1e-3, -0.7e-3])
    exact = stiffness(bearing, q, 0.05)
    for column, size in enumerate((1e-10, 1e-10, 1e-8, 1e-8)):
        step = np.zeros(4)
        step[column] = size
        forward = load_distribution(bearing, q + step, 0.05).load
        back = load_distribution(bearing, q - step, 0.05).load
        difference = (forward - back) / (2.0 * size)
        assert difference == pytest.approx(exact[:, column], rel=1e-5, abs=1e-6 * np.abs(difference).max())


@pytest.mark.property
@settings(max_examples=60, deadline=None)
@given(bearings, displacements, st.floats(0.0, 0.5))
def test_stiffness_is_symmetric_and_positive(bearing: RollerBearing, q: Array, angle0: float) -> None:
    """The load is the gradient of a convex energy."""
    matrix = stiffness(bearing, q, angle0)
    unit = np.array([1.0, 1.0, 0.5 * bearing.length, 0.5 * bearing.length])
    scaled = matrix / np.outer(unit, unit)
    assert (matrix == matrix.T).all()
    assert np.linalg.eigvalsh(scaled).min() >= -1e-12 * np.abs(scaled).max()


@pytest.mark.property
@settings(max_examples=60, deadline=None)
@given(bearings, displacements, st.floats(-3.0, 3.0))
def test_turning_the_axes(bearing: RollerBearing, q: Array, turn: float) -> None:
    """Load and stiffness are a vector and a tensor when displacement and rollers are turned together."""
    matrix = _rotation(turn)
    first = load_distribution(bearing, q, 0.1)
    second = load_distribution(bearing, matrix @ q, 0.1 + turn)
    size = max(np.abs(first.load).max(), 1.0)
    assert second.load == pytest.approx(matrix @ first.load, abs=1e-9 * size)
    assert first.roller_loads == pytest.approx(second.roller_loads, abs=1e-9 * size)


@pytest.mark.property
@settings(max_examples=40, deadline=None)
@given(bearings, displacements, st.floats(0.1, 10.0))
def test_homogeneous_in_displacement_and_clearance(bearing: RollerBearing, q: Array, factor: float) -> None:
    """Scaling displacement and clearance by λ scales the loads of line contact by λ^(10/9)."""
    scaled = RollerBearing(
        bearing.rollers,
        bearing.roller_radius,
        bearing.pitch_radius,
        bearing.length,
        bearing.clearance * factor,
    )
    first, second = load_distribution(bearing, q), load_distribution(scaled, q * factor)
    expected = first.load * factor ** (10.0 / 9.0)
    assert second.load == pytest.approx(expected, abs=1e-12 * second.roller_loads.sum())


@pytest.mark.property
@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from([0.0, 1e-7, 2e-5, 1e-3, -1e-5]),
    st.integers(3, 40),
    st.tuples(parts, parts, parts, parts),
    st.floats(-3.0, 6.0),
)
def test_solve_balances_any_load(
    clearance: float, rollers: int, direction: tuple[float, ...], decade: float
) -> None:
    """Equilibrium for loads over nine decades, from preload to 1 mm of clearance."""
    bearing = RollerBearing(rollers, 1e-3, 20e-3, 10e-3, clearance)
    load = np.array(direction) * 10.0**decade * np.array([1.0, 1.0, 5e-3, 5e-3])
    state = solve(bearing, load)
    unit = np.array([1.0, 1.0, 5e-3, 5e-3])
    error = np.linalg.norm((state.load - load) / unit)
    assert error <= 1e-5 * np.linalg.norm(load / unit) + 1e-12 * state.roller_loads.sum()


@pytest.mark.exact
@pytest.mark.parametrize(("clearance", "expected"), [(0.0, 0), (20e-6, 0), (-8e-6, 20)])
def test_without_load(clearance: float, expected: int) -> None:
    """No load: centred; open and without stiffness, unless preloaded: then K_xx = Z/2·dQ/dδ."""
    bearing = RollerBearing(20, 2.5e-3, 20e-3, 10e-3, clearance)
    state = solve(bearing, np.zeros(4))
    assert state.touching == expected
    assert not state.displacement.any()
    slope = 10.0 / 9.0 * iso16281_constant(10e-3) * max(-0.5 * clearance, 0.0) ** (1.0 / 9.0)
    assert state.stiffness[0, 0] == pytest.approx(10.0 * slope, rel=1e-12)
    assert ("open" in state.note) == (expected == 0)


@pytest.mark.exact
def test_single_roller_says_so() -> None:
    """Large clearance, load through a roller: δ = s/2 + (F/c)^0.9, no stiffness across, and a note."""
    bearing = RollerBearing(8, 2e-3, 20e-3, 10e-3, clearance=1e-3)
    state = solve(bearing, np.array([100.0, 0.0, 0.0, 0.0]))
    assert state.touching == 1
    assert state.displacement[0] == pytest.approx(
        0.5e-3 + (100.0 / iso16281_constant(10e-3)) ** 0.9, rel=1e-12
    )
    assert state.stiffness[1, 1] == pytest.approx(0.0, abs=1e-6)
    assert "single roller" in state.note


@pytest.mark.independent
def test_elastic_seat_against_a_coupled_solution() -> None:
    """Rollers on an elastic seat: finite differences of the coupled problem, solved by scipy's root."""
    bearing = RollerBearing(12, 2e-3, 20e-3, 10e-3, clearance=5e-6)
    rng = np.random.default_rng(3)
    raw = rng.normal(size=(12, 12))
    seat = 2e-9 * (np.eye(12) + 0.05 * raw @ raw.T)
    constant = iso16281_constant(bearing.length)
    angles = 2.0 * np.pi * np.arange(12) / 12
    arms = np.stack([np.cos(angles), np.sin(angles)], axis=1)

    def rollers(q: Array) -> Array:
        def gap(w: Array) -> Array:
            pressed = np.maximum(arms @ q - 2.5e-6 - 1e-6 * w, 0.0)
            return np.asarray(1e-6 * w - seat @ (constant * pressed ** (10.0 / 9.0))) * 1e6

        w = 1e-6 * root(gap, np.zeros(12), tol=1e-14).x
        return np.asarray(constant * np.maximum(arms @ q - 2.5e-6 - w, 0.0) ** (10.0 / 9.0))

    q = np.array([2e-5, 0.7e-5])
    matrix = seated_stiffness(bearing, rollers(q), seat)[:2, :2]
    for column in range(2):
        step = np.zeros(2)
        step[column] = 1e-9
        difference = arms.T @ (rollers(q + step) - rollers(q - step)) / 2e-9
        assert difference == pytest.approx(matrix[:, column], rel=1e-5, abs=1e-6 * np.abs(matrix).max())
    rigid = seated_stiffness(bearing, rollers(q), np.zeros((12, 12)))
    assert np.linalg.eigvalsh(rigid[:2, :2] - matrix).min() > 0.0


@pytest.mark.exact
def test_seat_without_compliance_is_the_bare_bearing() -> None:
    """With S = 0 the series formula must give the Jacobian itself, slices included."""
    q = np.array([3e-5, 1e-5, 1e-3, -5e-4])
    state = load_distribution(LOOSE, q)
    seated = seated_stiffness(LOOSE, state.slice_loads, np.zeros((20, 20)))
    assert seated == pytest.approx(state.stiffness, rel=1e-10, abs=1e-9)
    assert six_by_six(seated)[np.ix_((0, 1, 3, 4), (0, 1, 3, 4))] == pytest.approx(seated)
    assert not six_by_six(seated)[[2, 5]].any()


@pytest.mark.exact
@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"rollers": 2}, "at least 3"),
        ({"roller_radius": 4e-3}, "rollers overlap"),
        ({"length": 0.0}, "positive"),
        ({"clearance": float("nan")}, "finite"),
        ({"slices": 1}, "slices"),
    ],
)
def test_impossible_bearings_are_refused(changes: dict[str, float], said: str) -> None:
    """Every refusal names what was given and what is allowed (contract.md)."""
    values: dict[str, float] = {"rollers": 20, "roller_radius": 2.5e-3, "pitch_radius": 20e-3, "length": 1e-2}
    with pytest.raises(Infeasible, match=said):
        RollerBearing(**(values | changes))  # type: ignore[arg-type]


@pytest.mark.exact
def test_failures_say_what_to_try() -> None:
    """A load that is no load is refused; too few iterations end in advice, not in a wrong state."""
    with pytest.raises(TrochoidError, match="four finite numbers"):
        solve(PLAIN, np.array([np.nan, 0.0, 0.0, 0.0]))
    with pytest.raises(NotConverged, match="max_iterations"):
        solve(LOOSE, np.array([500.0, 200.0, 1.0, 0.0]), max_iterations=1)

"""Strips of constant pressure and the local laws: closed forms, Hertz, and each against the other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from tests.fem.cases import STEEL, on_circle
from trochoid.fem.complementarity import Group, Problem, Solution, solve
from trochoid.fem.laws import HertzLine, Law, LinearSpring, PowerLaw
from trochoid.fem.material import Material
from trochoid.fem.strips import REACH, STRIPS, curve_compliance, strip_centres, strip_compliance
from trochoid.kinematics.types import Array

ALUMINIUM = Material(70e9, 0.3).plane("strain")
KERNEL = STEEL.kernel + ALUMINIUM.kernel  # NAFEMS R0094 case 1: a steel cylinder on a softer block
LOAD, CURVE = 35e6, 0.05  # N/m, m


def _averaged(place: Array, start: Array, end: Array) -> float:
    """Return the mean of −ln|place − y| for y on the line from `start` to `end`."""

    def integrand(share: float) -> float:
        return -float(np.log(np.linalg.norm(place - start - share * (end - start))))

    return float(quad(integrand, 0.0, 1.0, points=[0.5], epsabs=1e-13, limit=200)[0])


@pytest.mark.exact
@pytest.mark.parametrize("count", [3, 8])
def test_strip_compliance_is_the_integral_of_the_logarithm(count: int) -> None:
    """∫ −ln|x−y| dy over each strip, by adaptive quadrature."""
    width = 3e-5
    found = strip_compliance(np.array([2.0]), np.array([width]), count)[0]
    centres = np.stack([width * np.arange(count), np.zeros(count)], axis=-1)
    half = np.array([0.5 * width, 0.0])
    expected = [[2 * _averaged(x, y - half, y + half) for y in centres] for x in centres]
    assert found == pytest.approx(np.array(expected), rel=1e-10)


@pytest.mark.exact
def test_strips_along_a_line() -> None:
    """Equal strips on a line are those of the half-plane; the matrix is symmetric for unequal ones too."""
    count, width = 9, 2e-4
    line = np.stack([width * np.arange(count), np.zeros(count)], axis=-1)
    straight = curve_compliance(3.0, line, np.full(count, width))
    assert straight == pytest.approx(
        strip_compliance(np.array([3.0]), np.array([width]), count)[0], rel=1e-12
    )
    uneven = curve_compliance(3.0, line, width * np.linspace(0.5, 1.5, count))
    assert np.array_equal(uneven, uneven.T)


def _on_a_circle(count: int) -> float:
    """Return the largest error of strips round a circle, against −ln(chord) integrated over the arcs."""
    radius, pitch = 0.02, 2 * np.pi / count
    angle: Array = pitch * np.arange(count, dtype=np.float64)
    found = curve_compliance(1.0, on_circle(radius, angle), np.full(count, radius * pitch))[0]

    def integrand(a: float) -> float:
        return -float(np.log(2 * radius * abs(np.sin(a / 2))))

    exact = [2 * quad(integrand, 0.0, pitch / 2)[0]]
    exact += [quad(integrand, a - pitch / 2, a + pitch / 2)[0] for a in angle[1:]]
    return float(np.abs(found - np.array(exact) / pitch).max())


@pytest.mark.exact
def test_strips_round_a_circle() -> None:
    """The chord stands for the arc: the error falls with the square of the strips' length."""
    coarse, fine = _on_a_circle(20), _on_a_circle(40)
    assert fine < 1e-4
    assert np.log2(coarse / fine) == pytest.approx(2.0, abs=0.05)


@pytest.mark.property
@given(st.integers(2, 40))
def test_strips_are_stable(count: int) -> None:
    """One pressure per strip, seen at its centre: symmetric and positive definite on strips much shorter than 1 m."""
    matrix = strip_compliance(np.array([1.0]), np.array([1e-3 / count]), count)[0]
    assert np.array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(matrix)[0] > 0


def _hertz(count: int, load: float = LOAD) -> tuple[Solution, Array, Array]:
    """Press a cylinder on a half-plane with `count` strips; returns the solution, places and pressures."""
    law = HertzLine(np.array([KERNEL]), np.array([CURVE]))
    reach = REACH * law.half_width(np.array([load]))
    place, width = strip_centres(count) * reach[0], 2 * reach / count
    group = Group(
        strip_compliance(np.array([KERNEL]), width, count),
        place[None] ** 2 / (2 * CURVE),
        np.ones((1, count, 1)),
    )
    solution = solve(Problem((group,), np.zeros((1, 1)), np.zeros((1, 1)), np.array([load])))
    return solution, place, solution.forces[0][0] / width[0]


@pytest.mark.published
def test_nafems_cylinder_on_a_block() -> None:
    """NAFEMS R0094 case 1: a = 6.2146 mm within 0.5 %, p_max = 3585.37 MPa within 0.2 %, two half-planes."""
    solution, place, pressure = _hertz(STRIPS)
    force = solution.forces[0][0]
    assert pressure.max() == pytest.approx(3585.37e6, rel=2e-3)
    assert 2 * np.sqrt((force * place**2).sum() / force.sum()) == pytest.approx(6.2146e-3, rel=5e-3)
    law = HertzLine(np.array([KERNEL]), np.array([CURVE]))
    assert law.half_width(np.array([LOAD]))[0] == pytest.approx(6.2146e-3, rel=1e-5)


@pytest.mark.exact
def test_strips_converge_to_hertz() -> None:
    """Pressure p0 √(1 − x²/a²) and approach A F (ln(2/a) + ½), errors falling with the number of strips."""
    law = HertzLine(np.array([KERNEL]), np.array([CURVE]))
    half = law.half_width(np.array([LOAD]))[0]
    approach = law.approach(np.array([LOAD]))[0][0]
    errors = []
    for count in (27, 81, 243):
        solution, place, pressure = _hertz(count)
        exact = 2 * LOAD / (np.pi * half) * np.sqrt(np.maximum(0.0, 1 - (place / half) ** 2))
        inner = np.abs(place) < 0.8 * half
        errors.append(
            (
                np.abs(pressure - exact)[inner].max() / exact.max(),
                abs(float(solution.motion[0]) / approach - 1),
            )
        )
    pressures, approaches = np.array(errors).T
    assert pressures[0] < 1e-3
    assert pressures[2] < 1e-5
    assert approaches[0] < 2e-4
    assert np.log(approaches[:-1] / approaches[1:]) / np.log(3) == pytest.approx(2.0, abs=0.3)


@pytest.mark.exact
@pytest.mark.parametrize("load", [1.0, 1e3, 1e6, 1e8])
def test_hertz_law_agrees_with_strips(load: float) -> None:
    """Level 0 and strips are the same contact: approach within 3e-4 over eight decades of load."""
    law = HertzLine(np.array([KERNEL]), np.array([CURVE]))
    approach = law.approach(np.array([load]))[0][0]
    assert float(_hertz(STRIPS, load)[0].motion[0]) == pytest.approx(approach, rel=3e-4)


laws = st.one_of(
    st.builds(LinearSpring, st.floats(1.0, 1e12)),
    st.builds(PowerLaw, st.floats(1e3, 1e12), st.floats(1.0, 1.5)),
    st.builds(
        lambda a, r: HertzLine(np.array([a]), np.array([r])), st.floats(1e-12, 1e-9), st.floats(1e-4, 1.0)
    ),
)


@pytest.mark.property
@given(laws, st.floats(1e-3, 1e5))
def test_law_is_monotone_concave_and_knows_its_slope(law: Law, force: float) -> None:
    """The derivative is that of finite differences; more force approaches further, each newton by less."""
    around = force * np.array([0.5, 1 - 1e-4, 1.0, 1 + 1e-4, 2.0])
    found = [law.approach(np.array([f])) for f in around]
    approach, slope = np.array([a[0] for a, _ in found]), np.array([s[0] for _, s in found])
    assert (approach[3] - approach[1]) / (around[3] - around[1]) == pytest.approx(slope[2], rel=1e-6)
    assert np.all(np.diff(approach) > 0)
    assert np.all(np.diff(slope) <= 1e-12 * slope[0])


@pytest.mark.exact
def test_power_law_is_the_inverse_of_the_standard() -> None:
    """F = c δ^n with n = 10/9 (ISO/TS 16281) goes back to its force."""
    law, delta = PowerLaw(5e9, 10 / 9), np.array([1e-6, 2e-5])
    assert law.approach(5e9 * delta ** (10 / 9))[0] == pytest.approx(delta, rel=1e-13)

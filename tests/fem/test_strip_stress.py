"""Stress in a half-plane under strips of pressure and friction, and under Hertz's pressure that slides."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from scipy.integrate import quad

from trochoid.fem import complementarity as lcp
from trochoid.fem import flamant
from trochoid.fem.half_plane import below, surface_stress
from trochoid.fem.hertz import hertz_stress, max_shear
from trochoid.fem.material import Material
from trochoid.fem.strip_stress import FAR, strip_stress, triangles
from trochoid.fem.strips import REACH, STRIPS, strip_centres, strip_compliance
from trochoid.kinematics.types import Array

STEEL = Material(210e9, 0.3).plane("strain")
LOAD, RADIUS, FRICTION = 1e6, 0.01, 0.3  # N/m, m
HALF = float(np.sqrt(2 * STEEL.kernel * LOAD * RADIUS))  # on a rigid cylinder
PEAK = 2 * LOAD / (np.pi * HALF)
WIDTH = 2 * REACH * HALF / STRIPS
OFFSET = REACH * HALF * strip_centres()


@lru_cache(maxsize=8)
def hertz_strips(shift: float = 0.0) -> Array:
    """Return the forces (m,) of strips pressed on a cylinder that stands `shift` strips off their middle."""
    gap = (OFFSET - shift * WIDTH) ** 2 / (2 * RADIUS)
    local = strip_compliance(np.array([STEEL.kernel]), np.array([WIDTH]))
    group = lcp.Group(local, gap[None], np.ones((1, STRIPS, 1)))
    problem = lcp.Problem((group,), np.zeros((1, 1)), np.zeros((1, 1)), np.array([LOAD]))
    return np.asarray(lcp.solve(problem).forces[0][0])


def random_strips(seed: int = 1) -> tuple[Array, Array]:
    """Return pressures and shears that follow no Hertz contact."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.0, 1.0, STRIPS) * LOAD, rng.normal(0.0, 1.0, STRIPS) * LOAD


def region(least: float, reach: float = 2.0, deep: float = 3.0) -> Array:
    """Return points (n, 2) under a contact from a depth `least` on, in m; lengths in half widths."""
    depth = np.append(least, np.geomspace(max(least, 1e-3), deep, 60))
    return HALF * np.stack(np.meshgrid(np.linspace(-reach, reach, 161), depth), axis=-1).reshape(-1, 2)


@pytest.mark.published
@pytest.mark.parametrize("shift", [0.0, 0.2, 0.5])
def test_largest_shear_below_solved_strips(shift: float) -> None:
    """Johnson (4.47): 0.300 p0 at 0.786 a; 27 solved strips give it to half a per cent wherever they lie."""
    depth = np.linspace(0.2, 1.5, 2601) * HALF
    stress = strip_stress(
        np.stack([np.full_like(depth, shift * WIDTH), depth], axis=-1),
        OFFSET,
        hertz_strips(shift),
        0 * OFFSET,
    )
    shear = np.abs(stress[:, 0] - stress[:, 1]) / 2
    assert shear.max() == pytest.approx(0.30028 * PEAK, rel=5e-3)
    assert depth[shear.argmax()] == pytest.approx(0.786 * HALF, rel=0.01)
    np.testing.assert_allclose(max_shear(stress, STEEL)[shear.argmax()], shear.max(), rtol=1e-6)


@pytest.mark.exact
@pytest.mark.parametrize(("depth", "error"), [(0.0, 0.04), (0.02, 0.01), (0.1, 0.005), (0.3, 0.001)])
def test_field_under_solved_strips(depth: float, error: float) -> None:
    """Every component within 1 % of p0 of Hertz with friction (McEwen; Smith & Liu) from 0.02 a below the surface on.

    On the surface itself the last strip, a tenth of a wide, does not know where in it the pressure ends.
    """
    points, strips = region(depth), hertz_strips()
    found = strip_stress(points, OFFSET, strips, FRICTION * strips)
    assert np.abs(found - hertz_stress(points, HALF, LOAD, FRICTION * LOAD)).max() < error * PEAK


@pytest.mark.published
def test_tension_behind_a_sliding_contact() -> None:
    """Johnson 7.1, Smith & Liu: σx = 2µp0 at the trailing edge, −2µp0 at the leading one, to 2 % with strips."""
    edges = np.array([[-HALF, 0.0], [HALF, 0.0]])
    exact = hertz_stress(edges, HALF, LOAD, FRICTION * LOAD)
    assert exact[:, 0] == pytest.approx(2 * FRICTION * PEAK * np.array([1, -1]), rel=1e-7)
    points = np.stack([np.linspace(-1.5, 1.5, 3001) * HALF, np.zeros(3001)], axis=-1)
    along = strip_stress(points, OFFSET, hertz_strips(), FRICTION * hertz_strips())[:, 0]
    assert along.max() == pytest.approx(2 * FRICTION * PEAK, rel=0.02)
    assert points[along.argmax(), 0] == pytest.approx(-HALF, rel=0.02)


@pytest.mark.published
def test_sliding_raises_the_largest_shear_to_the_surface() -> None:
    """Johnson 7.1: with µ = 0.25 it is still below the surface, with µ = 0.5 on it, where it is µp0."""
    points = region(0.0, 1.2, 1.5)
    for friction, on_surface in ((0.25, False), (0.5, True)):
        stress = hertz_stress(points, HALF, LOAD, friction * LOAD)
        shear = np.hypot(0.5 * (stress[:, 0] - stress[:, 1]), stress[:, 2])
        assert (points[shear.argmax(), 1] < 1e-3 * HALF) == on_surface
    assert shear.max() == pytest.approx(0.5 * PEAK, rel=1e-3)


@pytest.mark.independent
def test_triangles_against_quadrature() -> None:
    """Johnson (2.23) integrated numerically over a piecewise linear pressure and shear traction."""
    offset, peaks = np.linspace(-1.0, 1.0, 5), np.random.default_rng(3).normal(size=(5, 2))
    knots, values = np.linspace(-1.5, 1.5, 7), np.pad(peaks, ((1, 1), (0, 0)))
    points = np.array([[0.3, 0.05], [-0.75, 0.4], [2.0, 0.2], [11.0, 7.0], [-9.0, 9.5]])
    found = surface_stress(below(points), *triangles(below(points), offset, peaks))
    for (x, z), stress in zip(points, found, strict=True):

        def density(s: float, i: int, x: float = x, z: float = z) -> float:
            p, q = (np.interp(s, knots, values[:, k]) for k in (0, 1))
            along = x - s
            pull = -2 / np.pi * (p * z + q * along) / (along**2 + z**2) ** 2
            return float(pull * (along**2, z**2, along * z)[i])

        sums = [
            quad(density, -1.5, 1.5, args=(i,), points=(*knots, x), epsabs=1e-13, limit=400)[0]
            for i in range(3)
        ]
        assert stress == pytest.approx(sums, abs=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize("radius", [1.5, 0.99 * FAR, 1.01 * FAR, 300.0])
def test_tractions_on_a_half_circle_carry_the_load(radius: float) -> None:
    """Forces on any half circle round the strips to 1e-10 of the load, and where it acts to 1e-3 of a strip."""
    pressed, sheared = random_strips()
    span = OFFSET[-1] + WIDTH
    nodes, weights = np.polynomial.legendre.leggauss(400)
    angle = 0.5 * np.pi * (nodes + 1)
    outward = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    sx, sz, t = strip_stress(radius * span * outward, OFFSET, pressed, sheared).T
    traction = np.stack(
        [sx * outward[:, 0] + t * outward[:, 1], t * outward[:, 0] + sz * outward[:, 1]], axis=-1
    )
    weight = 0.5 * np.pi * radius * span * weights
    total = weight @ traction
    assert total == pytest.approx([-sheared.sum(), -pressed.sum()], abs=1e-10 * pressed.sum())
    moment = weight @ (outward[:, 0] * traction[:, 1] - outward[:, 1] * traction[:, 0]) * radius * span
    assert moment == pytest.approx(-pressed @ OFFSET, abs=1e-3 * WIDTH * pressed.sum())


@pytest.mark.exact
def test_far_away_strips_are_a_point_force() -> None:
    """Flamant's field of the sums, once the distance is a thousand widths, to its dipole."""
    pressed, sheared = random_strips()
    angle = np.linspace(0.05, np.pi - 0.05, 40)
    points = 1e4 * HALF * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    exact = flamant.stress(points, np.array([sheared.sum(), pressed.sum()]))
    found = strip_stress(points, OFFSET, pressed, sheared)
    assert np.abs(found - exact).max() < 3e-4 * np.abs(exact).max()


@pytest.mark.independent
def test_field_satisfies_equilibrium_and_compatibility() -> None:
    """Difference quotients: ∂σx/∂x + ∂τ/∂z = 0, ∂τ/∂x + ∂σz/∂z = 0, and σx + σz is harmonic."""
    pressed, sheared = random_strips()
    points, h = region(0.2, 1.5, 2.0), 1e-3 * HALF

    def at(dx: float, dz: float) -> Array:
        stress = strip_stress(points + h * np.array([dx, dz]), OFFSET, pressed, sheared)
        return np.asarray(stress * h / pressed.sum())

    by_x, by_z = (at(1, 0) - at(-1, 0)) / 2, (at(0, 1) - at(0, -1)) / 2
    size = np.abs(by_x).max() + np.abs(by_z).max()
    assert np.abs(by_x[:, 0] + by_z[:, 2]).max() < 1e-4 * size
    assert np.abs(by_x[:, 2] + by_z[:, 1]).max() < 1e-4 * size
    trace = [at(*step)[:, :2].sum(axis=1) for step in ((1, 0), (-1, 0), (0, 1), (0, -1), (0, 0))]
    assert np.abs(sum(trace[:4]) - 4 * trace[4]).max() < 1e-4 * size


@pytest.mark.exact
def test_surface_carries_the_tractions() -> None:
    """At z = 0, σz and τ are minus pressure and shear traction: zero outside; finite at every centre and edge."""
    strips = hertz_strips()
    x = np.sort(np.concatenate([OFFSET, OFFSET + WIDTH / 2, [-2 * HALF, -HALF, 0.0, HALF, 2 * HALF]]))
    stress = strip_stress(np.stack([x, 0 * x], axis=-1), OFFSET, strips, FRICTION * strips)
    assert np.isfinite(stress).all()
    np.testing.assert_allclose(stress[:, 2], FRICTION * stress[:, 1], atol=1e-9 * PEAK)
    assert np.abs(stress[np.abs(x) > OFFSET[-1] + WIDTH, 1:]).max() < 1e-9 * PEAK
    middle = np.abs(x) < 0.8 * HALF
    np.testing.assert_allclose(stress[middle, 1], -PEAK * np.sqrt(1 - (x[middle] / HALF) ** 2), rtol=0.01)


@pytest.mark.property
def test_mirrored_strips() -> None:
    """Strips and shears turned round give the mirrored field."""
    pressed, sheared = random_strips()
    points = region(0.0)
    found = strip_stress(points, OFFSET, pressed, sheared)
    mirrored = strip_stress(points * [-1, 1], OFFSET, pressed[::-1], -sheared[::-1])
    np.testing.assert_allclose(mirrored * [1, 1, -1], found, atol=1e-9 * np.abs(found).max())


@pytest.mark.property
@pytest.mark.parametrize("unit", [1e3, 1e-6])
def test_units(unit: float) -> None:
    """The same contact in millimetres, or with loads of another size, has the same stress over p0."""
    pressed, sheared = random_strips()
    points = region(0.0)
    found = strip_stress(points, OFFSET, pressed, sheared)
    other = strip_stress(unit * points, unit * OFFSET, pressed * unit**2, sheared * unit**2)
    np.testing.assert_allclose(other / unit, found, atol=1e-9 * np.abs(found).max())


@pytest.mark.regression
@pytest.mark.parametrize(
    "pressed", [np.eye(STRIPS)[0], np.eye(STRIPS)[13], np.ones(STRIPS), np.zeros(STRIPS)]
)
def test_one_strip_all_strips_none(pressed: Array) -> None:
    """A pressure that ends at the last strip or sits on one strip keeps its force and moment; none has no stress."""
    far = 1e4 * HALF * np.array([[0.0, 1.0], [0.6, 0.8]])
    stress = strip_stress(np.concatenate([far, region(0.0)]), OFFSET, pressed, 0 * pressed)
    assert np.isfinite(stress).all()
    exact = flamant.stress(far, np.array([0.0, pressed.sum()]))
    np.testing.assert_allclose(stress[:2], exact, atol=1e-3 * np.abs(exact).max())

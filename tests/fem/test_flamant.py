"""Flamant's field and Hertz's stress against the equations of elasticity and their printed extremes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from trochoid.fem import flamant
from trochoid.fem.hertz import hertz_stress, hertz_stress_in_plane, von_mises
from trochoid.fem.material import Material, Plane
from trochoid.kinematics.types import Array

STEP = 1e-5  # of the distance, in central differences

planes = st.builds(
    lambda nu, strain: Material(210e9, nu).plane("strain" if strain else "stress"),
    st.floats(0.0, 0.49),
    st.booleans(),
)
angles = st.floats(-0.8 * np.pi, 0.8 * np.pi)  # off the cut along the outward normal
directions = st.floats(-np.pi, np.pi)


def _unit(angle: float) -> Array:
    return np.array([np.cos(angle), np.sin(angle)])


def _gradient(plane: Plane, place: Array, inward: Array, force: Array) -> Array:
    """Return ∂u_b/∂x_a (2, 2) by central differences."""
    step = STEP * float(np.linalg.norm(place)) * np.eye(2)
    ahead = flamant.displacement(plane, place + step, inward, force)
    behind = flamant.displacement(plane, place - step, inward, force)
    return np.asarray((ahead - behind) / (2 * step[0, 0]))


@pytest.mark.exact
@given(planes, angles, directions, directions, st.floats(1e-4, 10.0))
def test_stress_is_what_hooke_makes_of_the_displacement(
    plane: Plane, angle: float, inward: float, pull: float, distance: float
) -> None:
    """Compatibility: Flamant's stress is that of a displacement field, σ = λ tr ε + 2Gε (Johnson, 2.2)."""
    place, into, force = distance * _unit(inward + angle), _unit(inward), _unit(pull)
    strain = _gradient(plane, place, into, force)
    strain = 0.5 * (strain + strain.T)
    hooke = plane.lame * np.trace(strain) * np.eye(2) + 2 * plane.shear * strain
    xx, yy, xy = flamant.stress(place[None], force)[0]
    assert hooke == pytest.approx(np.array([[xx, xy], [xy, yy]]), abs=1e-8 / distance)


@pytest.mark.exact
@given(directions, directions, st.floats(1e-3, 1.0))
def test_stress_is_in_equilibrium(angle: float, pull: float, distance: float) -> None:
    """div σ = 0 at every point but the loaded one."""
    place, force, step = distance * _unit(angle), _unit(pull), 1e-4 * distance

    def stress(at: Array) -> Array:
        xx, yy, xy = flamant.stress(at[None], force)[0]
        return np.array([[xx, xy], [xy, yy]])

    divergence = sum(
        (stress(place + step * axis)[i] - stress(place - step * axis)[i]) / (2 * step)
        for i, axis in enumerate(np.eye(2))
    )
    assert divergence == pytest.approx(np.zeros(2), abs=1e-6 / distance**2)


@pytest.mark.exact
@pytest.mark.parametrize("tilt", [0.0, 0.3, -1.0])
def test_half_circle_carries_the_force(tilt: float) -> None:
    """The traction on any half circle round the loaded point balances the force, however the half is tilted."""
    x, w = np.polynomial.legendre.leggauss(40)
    radial = np.stack([np.cos(tilt + x * np.pi / 2), np.sin(tilt + x * np.pi / 2)], axis=-1)
    for force in np.eye(2):
        pull = flamant.traction(0.01 * radial, radial, force)
        assert 0.01 * np.pi / 2 * w @ pull == pytest.approx(-force, abs=1e-12)


@pytest.mark.exact
@given(planes, directions, st.floats(1e-6, 1e3), st.booleans())
def test_surface_moves_with_the_logarithm(
    plane: Plane, inward: float, distance: float, tangential: bool
) -> None:
    """On the surface, the displacement along the force is exactly −2/(πE') ln r (Johnson, 2.22, 2.23)."""
    into = _unit(inward)
    along = np.array([into[1], -into[0]])
    force = along if tangential else into
    places = distance * np.stack([along, -along])
    moved = flamant.displacement(plane, places, into, force) @ force
    assert moved == pytest.approx(
        np.full(2, -2 / (np.pi * plane.modulus) * np.log(distance)), abs=1e-24, rel=1e-12
    )


@pytest.mark.exact
@given(planes, directions, st.floats(1e-3, 1.0))
def test_surface_is_dragged_to_the_load_by_a_jump(plane: Plane, inward: float, distance: float) -> None:
    """Across a normal force the tangential displacement jumps by (κ−1)/(4G), each side towards it (Johnson, 2.23)."""
    into = _unit(inward)
    along = np.array([into[1], -into[0]])
    right, left = flamant.displacement(plane, distance * np.stack([along, -along]), into, into) @ along
    assert left - right == pytest.approx((plane.kolosov - 1) / (4 * plane.shear), rel=1e-12)


@pytest.mark.exact
@given(directions, directions, directions)
def test_traction_is_stress_on_the_normal(angle: float, normal: float, pull: float) -> None:
    """Cauchy: t = σ n."""
    place, n, force = _unit(angle)[None], _unit(normal)[None], _unit(pull)
    xx, yy, xy = flamant.stress(place, force)[0]
    expected = np.array([[xx, xy], [xy, yy]]) @ n[0]
    assert flamant.traction(place, n, force)[0] == pytest.approx(expected, abs=1e-14)


@pytest.mark.exact
def test_plane_moduli() -> None:
    """E' = 4G(λ+G)/(λ+2G), κ = 3−4ν in plane strain and (3−ν)/(1+ν) in plane stress (Muskhelishvili)."""
    nu, young = 0.3, 210e9
    for state, kappa in (("strain", 3 - 4 * nu), ("stress", (3 - nu) / (1 + nu))):
        plane = Material(young, nu).plane("strain" if state == "strain" else "stress")
        lame, shear = plane.lame, plane.shear
        assert plane.kolosov == pytest.approx(kappa, rel=1e-14)
        assert 4 * shear * (lame + shear) / (lame + 2 * shear) == pytest.approx(plane.modulus, rel=1e-14)
    assert Material(young, nu).plane("strain").lame == pytest.approx(young * nu / (1.3 * 0.4), rel=1e-13)


@pytest.mark.exact
def test_hertz_far_away_is_flamant() -> None:
    """Saint-Venant: the pressure's second moment is all that is left, (a/r)² of the point force's stress."""
    places = np.array([[3.0, 2.0], [-1.0, 4.0], [0.5, 0.1]])
    force = np.array([0.0, 1.0])
    point = flamant.stress(places, force)
    size = np.abs(point).max(axis=1)
    errors = [(np.abs(hertz_stress(places, a, 1.0) - point).max(axis=1) / size).max() for a in (1e-2, 1e-3)]
    assert errors[1] < 2e-5
    assert errors[0] / errors[1] == pytest.approx(100, rel=0.05)


@pytest.mark.published
def test_hertz_largest_shear_is_030_p0_at_0786_a() -> None:
    """Johnson, Contact Mechanics (4.47): τ_max = 0.30 p0 at z = 0.786 a, for any Poisson's ratio."""
    depth = np.linspace(0.0, 2.0, 20001)
    sx, sz, _ = hertz_stress(np.stack([0 * depth, depth], axis=-1), 1.0, np.pi / 2).T  # a = p0 = 1
    shear = np.abs(sx - sz) / 2
    assert shear.max() == pytest.approx(0.30, rel=0.01)
    assert shear.max() == pytest.approx(0.300283, abs=1e-6)
    assert depth[shear.argmax()] == pytest.approx(0.786, rel=0.01)


@pytest.mark.published
def test_hertz_largest_von_mises_stress() -> None:
    """Plane strain, ν = 0.3: 0.558 p0 at z = 0.70 a (Johnson 4.4; Williams, Engineering Tribology, table 3.2)."""
    depth = np.linspace(0.0, 2.0, 20001)
    stress = hertz_stress(np.stack([0 * depth, depth], axis=-1), 1.0, np.pi / 2)
    mises = von_mises(stress, Material(1.0, 0.3).plane("strain"))
    assert mises.max() == pytest.approx(0.558, abs=1e-3)
    assert depth[mises.argmax()] == pytest.approx(0.70, abs=0.01)


@pytest.mark.exact
def test_hertz_at_the_surface() -> None:
    """Johnson (4.44): σx = σz = −p(x) under the contact, nothing outside, and no shear."""
    x = np.linspace(-2.0, 2.0, 401)
    pressure = np.sqrt(np.maximum(0.0, 1 - x**2))
    stress = hertz_stress(np.stack([x, 0 * x], axis=-1), 1.0, np.pi / 2)
    assert stress == pytest.approx(np.stack([-pressure, -pressure, 0 * x], axis=-1), abs=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize("depth", [0.2, 1.0, 3.0])
def test_hertz_carries_its_load_at_every_depth(depth: float) -> None:
    """Equilibrium of a layer: ∫σz dx = −P, ∫τ dx = 0; and div σ = 0 at a point in it."""
    load = 7.0

    def part(x: float, which: int) -> float:
        return float(hertz_stress(np.array([[x, depth]]), 0.5, load)[0, which])

    assert quad(part, -np.inf, np.inf, args=(1,))[0] == pytest.approx(-load, rel=1e-6)
    h, at = 1e-4, np.array([0.3, depth])
    across, down = (
        (hertz_stress((at + h * e)[None], 0.5, load) - hertz_stress((at - h * e)[None], 0.5, load))[0]
        / (2 * h)
        for e in np.eye(2)
    )
    assert across[0] + down[2] == pytest.approx(0.0, abs=1e-5)
    assert across[2] + down[1] == pytest.approx(0.0, abs=1e-5)


@pytest.mark.property
@given(directions, st.floats(-3.0, 3.0), st.floats(0.0, 3.0))
def test_hertz_in_the_plane_is_the_same_tensor(inward: float, x: float, z: float) -> None:
    """A turned contact has turned stresses: the tensor's invariants and its normal component stay."""
    into = _unit(inward)
    along = np.array([into[1], -into[0]])
    center = np.array([3.0, -2.0])
    xx, yy, xy = hertz_stress_in_plane((center + x * along + z * into)[None], center, into, 0.7, 2.0)[0]
    sx, sz, shear = hertz_stress(np.array([[x, z]]), 0.7, 2.0)[0]
    tensor = np.array([[xx, xy], [xy, yy]])
    assert into @ tensor @ into == pytest.approx(sz, abs=1e-6)
    assert along @ tensor @ along == pytest.approx(sx, abs=1e-6)
    assert along @ tensor @ into == pytest.approx(shear, abs=1e-6)

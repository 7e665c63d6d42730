"""Slot walls and pins as elastic bodies: against tetrahedra, a beam, finer meshes, and Hertz's closed forms."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest
from scipy.sparse import hstack

from trochoid.fem.cone_body import product, read
from trochoid.fem.cone_flank import load_at
from trochoid.fem.cone_layers import integrals
from trochoid.fem.cone_slices import between
from trochoid.fem.linear_solver import factorise, installed
from trochoid.fem.material import Material
from trochoid.fem.pin_slot import Pin, Shape, press
from trochoid.fem.point_contact import MEAN, Bump, curvature_shift
from trochoid.fem.slot_contact import ElasticPair, press_elastic
from trochoid.fem.slot_pin import press_pin
from trochoid.fem.slot_wall import WallBody, WallMesh, press_stations, wall_body
from trochoid.geometry.slotted import SlottedWheel, slotted_outline
from trochoid.geometry.sphere_mesh import SphereMesh, mesh_sphere
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, IntArray

if TYPE_CHECKING:
    from skfem import MeshTet2

STEEL = Material(2.1e11, 0.3, 7850.0)
ENDS = (0.094, 0.106)
NEAREST = 0.80
WHEEL = SlottedWheel(1.10, 0.79, 0.25, 0.05, math.radians(120.0), 3)


def pin(shape: Shape = "cylinder", overhang: float = 1e-3) -> Pin:
    return Pin(shape, 5e-3, 0.1, 12e-3, overhang, 20e-3, STEEL, 0.2)


@cache
def body(facets: int = 6) -> WallBody:
    return wall_body(WHEEL, ENDS, NEAREST, STEEL, WallMesh(facets))


@cache
def pair(facets: int = 6, shape: Shape = "cylinder") -> ElasticPair:
    mesh = WallMesh(facets)
    made = press_pin(pin(shape), between(mesh.radial(ENDS).breaks), 4 * facets, mesh.parts)
    return ElasticPair(
        pin(shape), made, press_stations(body(facets), mesh.parts, 0.1 if shape == "barrel" else None)
    )


WIDE = 0.035  # rad: half width of loads that are far wider than a facet of any mesh
PLACES = (0.127, 0.272, 0.293)  # rad along the wall, the last ones beside the mouth


def tetrahedra(plane: SphereMesh, layers: int) -> MeshTet2:
    """Curved tetrahedra of second order between the two spheres; mid-edge nodes on the rays of the plane mesh."""
    from skfem import MeshTet, MeshTet2

    count = int(plane.triangles[:3].max()) + 1
    rho = np.linspace(*ENDS, layers + 1)
    points = (rho[:, None, None] * plane.points[:count]).reshape(-1, 3)
    corner = np.sort(plane.triangles[:3], axis=0)  # alike on both sides of a common face
    parts = []
    for k in range(layers):
        a, b, c = corner + k * count
        d, e, f = corner + (k + 1) * count
        parts += [np.stack(x) for x in ((a, b, c, f), (a, b, f, e), (a, e, f, d))]
    solid = MeshTet2.from_mesh(straight := MeshTet(points.T, np.concatenate(parts, axis=1)))
    triangles = plane.triangles
    middle = {(v, v): plane.points[v] for v in range(count)}
    for a, b, m in ((0, 1, 3), (1, 2, 4), (0, 2, 5)):
        low, high = np.sort(triangles[[a, b]], axis=0).tolist()
        middle |= zip(zip(low, high, strict=True), plane.points[triangles[m]], strict=True)
    ends = np.sort(straight.edges % count, axis=0).T.tolist()
    distance = rho[straight.edges // count].mean(axis=0)
    solid.doflocs[:, len(points) :] = (distance[:, None] * np.array([middle[a, b] for a, b in ends])).T
    return solid


def by_tetrahedra(facets: int, layers: int) -> Array:
    """What the wall yields (3,), m/N, at `PLACES` under half an ellipse over the thickness, on our plane mesh."""
    from skfem import Basis, ElementTetP2, ElementVector, FacetBasis, Functional, LinearForm
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    plane = body(facets).body.mesh
    solid, count = tetrahedra(plane, layers), int(plane.triangles[:3].max()) + 1
    outer = solid.boundary_facets()
    corners = solid.facets[:, outer]
    lateral = np.ptp(corners // count, axis=0) > 0

    def on(side: str) -> IntArray:
        there = np.isin(corners % count, plane.edges[side][:2]).all(axis=0)
        return np.asarray(outer[lateral & there])

    element = ElementVector(ElementTetP2())
    basis = Basis(solid, element, intorder=4)
    stiffness = linear_elasticity(*lame_parameters(2.1e11, 0.3)).assemble(basis)
    wall = FacetBasis(solid, element, facets=on("wall"), intorder=19)
    kept = np.setdiff1d(np.arange(stiffness.shape[0]), basis.get_dofs(on("hub")).all())
    loads, scale = [], math.cos(0.05)
    for place in PLACES:
        normal = -body(facets).side.normal_at(place)

        def pressure(w, place=place):  # type: ignore[no-untyped-def]
            rho = np.sqrt((w.x**2).sum(axis=0))
            off = ((np.arctan2(w.x[0], w.x[2]) - WHEEL.bottom) * scale - place) / WIDE
            return np.sqrt(np.maximum(0.0, 1.0 - off**2)) * 2.0 / (np.pi * WIDE) / rho / (ENDS[1] - ENDS[0])

        @LinearForm
        def pressed(v, w, pressure=pressure, normal=normal):  # type: ignore[no-untyped-def]
            return pressure(w) * sum(float(normal[k]) * v[k] for k in range(3))

        end = min(1.0, (body(facets).side.length - place) / WIDE)  # half an ellipse up to the mouth, exactly
        whole = 0.5 + (end * math.sqrt(1.0 - end**2) + math.asin(end)) / math.pi
        found = Functional(pressure).assemble(wall)  # by points that do not know where it ends
        loads.append(pressed.assemble(wall)[kept] * whole / found)
    answer = factorise(stiffness[kept][:, kept].tocsc(), fastest())(np.array(loads).T)
    return np.asarray(np.einsum("kn,nk->k", np.array(loads), answer))


def fastest() -> str | None:
    return "pardiso" if "pardiso" in installed() else None


def by_rays(facets: int) -> Array:
    """The same by the wheel's own elements."""
    made = body(facets)
    inner = np.flatnonzero(~made.body.held)
    columns = hstack([load_at(made.side, place, WIDE) for place in PLACES], format="csc")
    weights = integrals(made.body.radial)
    loads = product(columns, weights.sum(axis=1, keepdims=True) / weights.sum())[inner]
    return np.diag(read(made.solve, loads, loads[:, :1])[0])


@pytest.mark.independent
def test_wall_bends_as_tetrahedra_do() -> None:
    """A load over the thickness at three places of a wall: curved P2 tetrahedra by scikit-fem, extrapolated.

    Halving all facets takes the error to between a fifth and an eighth, which leaves 0.1 % of doubt; so do layers.
    """
    coarse, fine = by_tetrahedra(4, 2), by_tetrahedra(8, 2)
    layered = by_tetrahedra(4, 4)
    true = fine + (fine - coarse) / 5.5 + (layered - coarse) * 8.0 / 7.0
    found = {n: by_rays(n) for n in (4, 6, 8)}
    np.testing.assert_allclose(found[8], true, rtol=0.005)
    np.testing.assert_allclose(found[6], true, rtol=0.008)
    np.testing.assert_allclose(found[8] + (found[8] - found[4]) / 5.5, true, rtol=0.003)
    told = 0.8 * np.abs(found[6] - found[4])  # the error that a drive tells
    assert (told + 0.001 * true > np.abs(found[6] - true)).all()


@pytest.mark.property
def test_converges_with_facets() -> None:
    """Stiffness along the slot on 6 and on 8 facets over the thickness: within 0.4 %, and 4 and 6 within 0.9 %."""
    at = np.linspace(0.8, 1.1, 7)
    found = [press_elastic(pair(n), np.full(7, 1e-5), at).slope for n in (4, 6, 8)]
    np.testing.assert_allclose(found[1], found[2], rtol=0.004)
    np.testing.assert_allclose(found[0], found[1], rtol=0.009)
    assert (np.diff(found[1]) < 0.0).all()  # softer and softer towards the mouth


@pytest.mark.independent
def test_a_long_pin_is_a_beam() -> None:
    """A pin held far before its wall: Timoshenko's F L³/(3EI) + F L/(κGA), within 2 % beside the contact's own part."""
    slices = between(np.linspace(*ENDS, 5))
    long, short = (press_pin(pin(overhang=x), slices, 24, 3) for x in (0.05, 0.03))
    even = np.full(12, 1.0 / 12.0)
    found = even @ (long.own - short.own) @ even

    def beam(length: float) -> float:
        area, inertia = math.pi * 25e-6, 0.25 * math.pi * 625e-12
        return length**3 / (3 * 2.1e11 * inertia) + length / (2.1e11 / 2.6 * area * 7.8 / 8.8)

    spread = ((0.006 * 2) ** 2 / 12.0) / (2.1e11 * 0.25 * math.pi * 625e-12)  # mean over an even load
    assert found == pytest.approx(beam(0.056) - beam(0.036) + spread * 0.02, rel=0.02)


@pytest.mark.exact
def test_balance_and_hertz() -> None:
    """Moments are those of the slices' forces; pressures and widths belong to them: p = 2q/(πb), b² = 4qr/(πE*)."""
    made = pair()
    found = press_elastic(made, np.array([0.0, 1e-6, 1e-4]), np.array([0.9, 0.9, 1.0]))
    np.testing.assert_allclose(found.moment, found.force @ made.rho)
    assert found.moment[0] == 0.0
    q = found.force[1:] / made.wall.slices.length
    b = np.sqrt(4.0 * q * 5e-3 * 2 * 0.91 / (math.pi * 2.1e11))
    np.testing.assert_allclose(found.half_width[1:], b)
    np.testing.assert_allclose(found.pressure[1:], 2.0 * q / (math.pi * b))
    step = 1e-9
    near = press_elastic(made, np.array([1e-5 - step, 1e-5 + step]), np.full(2, 0.9)).moment
    slope = press_elastic(made, np.array([1e-5]), np.array([0.9])).slope[0]
    assert (near[1] - near[0]) / (2 * step) == pytest.approx(
        slope, rel=2e-3
    )  # the end term's width is frozen


@pytest.mark.property
def test_softer_than_the_half_space() -> None:
    """Everywhere below what a rigid wheel gives, a line or a point; in a barrel the wheel adds to Hertz's approach."""
    at = np.array([0.82, 0.95, 1.08])
    for shape in ("cylinder", "barrel"):
        rigid = press(pin(shape), np.full(3, 1e-5)).slope
        assert (press_elastic(pair(shape=shape), np.full(3, 1e-5), at).slope < rigid).all()


@pytest.mark.property
def test_wheels_that_cannot_be() -> None:
    """Refused with what is in the way."""
    with pytest.raises(Infeasible, match="hub must be above 0° and below"):
        SlottedWheel(1.1, 0.79, 0.75, 0.05, 1.5, 4)
    with pytest.raises(Infeasible, match="run into each other"):
        SlottedWheel(1.1, 0.79, 0.2, 0.05, 0.1, 60)
    with pytest.raises(Infeasible, match="rim must be farther"):
        SlottedWheel(0.7, 0.79, 0.2, 0.05, 1.5, 4)


@pytest.mark.property
@pytest.mark.parametrize(("swing", "slots", "rim"), [(300.0, 1, 1.0), (100.0, 3, 1.2), (45.0, 8, 2.2)])
def test_any_number_of_slots(swing: float, slots: int, rim: float) -> None:
    """One slot, swings that leave a rest, and rims beyond the equator are meshed without a fold."""
    wheel = SlottedWheel(rim, rim - 0.3, 0.3, 0.04, math.radians(swing), slots)
    mesh = mesh_sphere(slotted_outline(wheel, 0.02, 0.005, rim - 0.25), 1.8)
    a, b, c = (mesh.points[mesh.triangles[i]] for i in range(3))
    volume = np.sum(a * np.cross(b, c), axis=1)
    cosines = 1.0 + np.sum(a * b + b * c + c * a, axis=1)
    area = 2.0 * np.arctan2(volume, cosines)  # solid angles (Van Oosterom and Strackee)
    zone = 2.0 * math.pi * (math.cos(0.3) - math.cos(rim))
    cut = slots * (0.08 * 0.3 + 0.5 * math.pi * 0.04**2)
    assert float(area.sum()) == pytest.approx(zone - cut, rel=0.02)


def smooth_of_a_sphere(width: float, nu: float) -> float:
    """S·E of a unit sphere under half an ellipsoid of that half width, rad: Love's solid harmonics, summed.

    Of degree n are u = ∇(rⁿP) and r²∇(rⁿP) + α r (rⁿP); no shear on the surface gives their share.
    """
    mu = 0.5 / (1.0 + nu)
    lame = 2.0 * mu * nu / (1.0 - 2.0 * nu)
    x, weight = np.polynomial.legendre.leggauss(60)
    height = 0.5 * (x + 1.0)
    cosine, load = np.cos(width * np.sqrt(1.0 - height**2)), 1.5 * height**2 * weight
    last = int(60.0 / width)
    moment = np.empty(last + 1)
    before, now = np.ones_like(cosine), cosine
    moment[:2] = load.sum(), load @ cosine
    for k in range(2, last + 1):
        before, now = now, ((2 * k - 1) * cosine * now - (k - 1) * before) / k
        moment[k] = load @ now
    n = np.arange(2.0, last + 1.0)
    alpha = -((lame + mu) * 2 * n + mu * (4 * n + 2)) / ((lame + mu) * (n + 3) + 2 * mu)
    share = -2 * (n - 1) / (2 * n + alpha)
    stress = 2 * mu * n * (n - 1) + share * (
        lame * (2 * n + alpha * (n + 3)) + 2 * mu * (n + alpha) * (n + 1)
    )
    yields = (n + share * (n + alpha)) / stress * (2 * n + 1) / (4 * math.pi)
    return float(yields @ moment[2:] ** 2) - MEAN * 0.75 * (1.0 - nu**2) / width


@pytest.mark.exact
@pytest.mark.parametrize("nu", [0.0, 0.2, 0.3])
def test_curvature_shift_of_a_sphere(nu: float) -> None:
    """From one narrow bump on a sphere to one of half the width S grows by k ln 2: a Legendre series, within 1.5 %."""
    material = Material(2.1e11, nu, 7850.0)
    known = [smooth_of_a_sphere(w, nu) / 2.1e11 for w in (0.02, 0.01)]
    one = Bump(0.0, 1.0, 0.02, 0.02)
    found = curvature_shift(replace(body(4).body, material=material), 1.0, 0.01, one)
    assert found > 0.0
    assert found == pytest.approx(known[1] - known[0], rel=0.015)
    wide = Bump(0.0, 1.0, 0.01, 0.04)  # the geometric mean of the half axes counts
    assert curvature_shift(replace(body(4).body, material=material), 1.0, 0.01, wide) == pytest.approx(found)

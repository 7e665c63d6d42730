"""Slot walls and pins as elastic bodies: against tetrahedra, a beam, finer meshes, and Hertz's closed forms."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

from trochoid.fem.cone_body import product, read
from trochoid.fem.cone_flank import load_at
from trochoid.fem.cone_layers import integrals
from trochoid.fem.cone_slices import between
from trochoid.fem.material import Material
from trochoid.fem.pin_slot import Pin, Shape, press
from trochoid.fem.slot_contact import ElasticPair, press_elastic
from trochoid.fem.slot_pin import press_pin
from trochoid.fem.slot_wall import WallBody, WallMesh, press_stations, wall_body
from trochoid.geometry.slotted import SlottedWheel, slotted_outline
from trochoid.geometry.sphere_mesh import SphereMesh, mesh_sphere
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, IntArray

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


def tetrahedra(plane: SphereMesh, layers: int) -> tuple[Array, IntArray]:
    """Points (3, n) and tetrahedra (4, m) between the two spheres over the vertices of a plane mesh."""
    count = int(plane.triangles[:3].max()) + 1
    rho = np.linspace(*ENDS, layers + 1)
    points = (rho[:, None, None] * plane.points[:count]).reshape(-1, 3)
    corner = np.sort(plane.triangles[:3], axis=0)  # alike on both sides of a common face
    parts = []
    for k in range(layers):
        a, b, c = corner + k * count
        d, e, f = corner + (k + 1) * count
        parts += [np.stack(x) for x in ((a, b, c, f), (a, b, f, e), (a, e, f, d))]
    return points.T, np.concatenate(parts, axis=1)


@pytest.mark.independent
def test_wall_bends_as_tetrahedra_do() -> None:
    """A load over the thickness at three places of a wall: P2 tetrahedra by scikit-fem, within 2.5 %."""
    from skfem import Basis, ElementTetP2, ElementVector, FacetBasis, LinearForm, MeshTet, MeshTet2
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    made = body(4)
    mesh = mesh_sphere(slotted_outline(WHEEL, 0.02, 0.006, NEAREST), 1.6)
    points, cells = tetrahedra(mesh, 3)
    straight = MeshTet(points, cells)
    solid = MeshTet2.from_mesh(straight)
    at = solid.doflocs
    polar, length = np.arccos(at[2] / np.linalg.norm(at, axis=0)), np.linalg.norm(at, axis=0)
    inside = polar < 0.25  # middles of edges on the hub, put onto it
    stretch = length[inside] * math.sin(0.25) / np.hypot(*at[:2, inside])
    at[:2, inside] *= stretch
    at[2, inside] = length[inside] * math.cos(0.25)
    element = ElementVector(ElementTetP2())
    basis = Basis(solid, element)
    stiffness = linear_elasticity(*lame_parameters(2.1e11, 0.3)).assemble(basis)
    on_hub = straight.facets_satisfying(lambda x: np.arccos(x[2] / np.linalg.norm(x, axis=0)) < 0.26, True)
    held = basis.get_dofs(on_hub).all()

    def on_wall(x: Array) -> Array:
        y, along = x[1] / np.linalg.norm(x, axis=0), np.arctan2(x[0], x[2])
        return np.asarray(
            (np.abs(y - math.sin(0.05)) < 1e-3) & (along > 0.785) & (along < 1.2) & (x[0] > 0.0)
        )

    wall = FacetBasis(solid, element, facets=straight.facets_satisfying(on_wall, True), intorder=8)
    chosen = [1, len(made.stations) // 2, len(made.stations) - 2]
    scale, loads, columns = math.cos(0.05), [], []
    weights = integrals(made.body.radial)
    for i in chosen:
        center = float(made.side.centers[made.stations[i]])
        wide = 0.035  # rad: far wider than a facet of either mesh
        along = WHEEL.bottom + center / scale
        normal = -made.side.normal_at(center)

        @LinearForm
        def pressed(v, w, along=along, wide=wide, normal=normal):  # type: ignore[no-untyped-def]
            rho = np.sqrt((w.x**2).sum(axis=0))
            off = (np.arctan2(w.x[0], w.x[2]) - along) * scale / wide
            q = np.sqrt(np.maximum(0.0, 1.0 - off**2)) * 2.0 / (np.pi * wide) / rho / (ENDS[1] - ENDS[0])
            return q * sum(float(normal[k]) * v[k] for k in range(3))

        loads.append(pressed.assemble(wall))
        columns.append(load_at(made.side, center, wide))
    kept = np.setdiff1d(np.arange(stiffness.shape[0]), held)
    from trochoid.fem.linear_solver import factorise

    answer = factorise(stiffness[kept][:, kept].tocsc())(np.array(loads)[:, kept].T)
    by_tetrahedra = np.einsum("kn,nk->k", np.array(loads)[:, kept], answer)
    from scipy.sparse import hstack

    inner = np.flatnonzero(~made.body.held)
    even = weights.sum(axis=1, keepdims=True) / weights.sum()
    own, _ = read(
        made.solve, product(hstack(columns, format="csc"), even)[inner], product(columns[0], even)[inner]
    )
    np.testing.assert_allclose(np.diag(own), by_tetrahedra, rtol=0.025)


@pytest.mark.property
def test_converges_with_facets() -> None:
    """Stiffness along the slot on 6 and on 8 facets over the thickness: within 0.6 %, and 4 and 6 within 1.2 %."""
    at = np.linspace(0.8, 1.1, 7)
    found = [press_elastic(pair(n), np.full(7, 1e-5), at).slope for n in (4, 6, 8)]
    np.testing.assert_allclose(found[1], found[2], rtol=0.006)
    np.testing.assert_allclose(found[0], found[1], rtol=0.012)
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

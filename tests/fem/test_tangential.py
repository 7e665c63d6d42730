"""Tangential compliance against discs and holes in closed form, against plain tractions, and Betti."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.fem.cases import (
    RADIUS,
    STEEL,
    free_disc_green,
    hole_in_plate_green,
    on_circle,
    round_disc,
    round_loop,
    small_mesh,
)
from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import (
    Compliance,
    Weights,
    place_stations,
    press,
    solve_patches,
    surface_weights,
    tabulate,
)
from trochoid.fem.material import Material, Plane
from trochoid.fem.patch import Patch
from trochoid.fem.tangential import round_tangential
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray


def disc_along(plane: Plane, angle: Array) -> Array:
    """Return how far the rim of a free disc moves along a unit tangential line load `angle` behind.

    With φ = A z^(n+1), ψ = B z^(n−1) (Muskhelishvili, § 80) the shear q cos nθ gives the tangential
    displacement (R q/4G)(κ/(n+1) + 1/(n−1)) cos nθ for n ≥ 2, as pressure gives the radial one; n = 1, balanced
    by a uniform body force, gives (κ+3)/2 cos θ, and n = 0, balanced by the inertia of rotation, 1/3.
    """
    rest = 1 / 3 - (plane.kolosov - 1) / 2 + 2 * np.cos(angle)
    return np.asarray(free_disc_green(plane, angle) + rest / (4 * np.pi * plane.shear))


def disc_mixed(plane: Plane, angle: Array) -> Array:
    """Return the same for the inward displacement: (κ−1)/2 sin θ + Σ (κ/(n+1) − 1/(n−1)) sin nθ, summed; 0 at θ = 0."""
    kappa, angle = plane.kolosov, np.mod(angle, 2 * np.pi)
    same = np.minimum(angle, 2 * np.pi - angle) < 1e-9
    apart = np.where(same, 1.0, angle)
    found = 0.5 * (kappa - 1) * np.cos(apart) * (np.pi - apart) - 0.5 * np.sin(apart)
    found += (kappa + 1) * np.sin(apart) * np.log(2 * np.sin(apart / 2))
    return np.where(same, 0.0, found / (4 * np.pi * plane.shear))


def plate_mixed(plane: Plane, angle: Array) -> Array:
    """Return C_nt of a hole in an infinite plate, `angle` ahead along t (clockwise), less motions of the hole.

    φ = A z^(1−n), ψ = B z^(−n−1): Σ (κ/(n−1) − 1/(n+1)) sin nθ for n ≥ 2, summed.
    """
    kappa, angle = plane.kolosov, np.mod(angle, 2 * np.pi)
    logarithm = np.log(2 * np.sin(angle / 2))
    found = 0.5 * (kappa - 1) * np.cos(angle) * (np.pi - angle) - (kappa + 1) * np.sin(angle) * logarithm
    return np.asarray((found + 0.5 * np.sin(angle)) / (4 * np.pi * plane.shear))


def pressed_disc(facets: int, plane: Plane = STEEL) -> Compliance:
    return press(round_disc(facets, plane=plane)[0], [round_loop(facets)], tangential=True)


def _errors(facets: int, between: float, plane: Plane = STEEL) -> Array:
    """Return the largest errors of S_tt(x, x), S_tt, C_nt(x, x), C_nt in units of 2/(πE')."""
    compliance = pressed_disc(facets, plane)
    surface = compliance.surfaces["rim"]
    place = surface.positions + between * surface.length / facets
    angle, own = place / RADIUS, np.eye(facets, dtype=bool)
    found = compliance.coupled(surface_weights(surface, place), on_circle(RADIUS, angle))
    apart = angle[:, None] - angle
    along = np.where(own, round_tangential(plane, RADIUS), disc_along(plane, np.where(own, 1.0, apart)))
    tangential = np.abs(found[facets:, facets:] - along) / plane.kernel
    mixed = np.abs(found[:facets, facets:] - disc_mixed(plane, apart)) / plane.kernel
    return np.array([tangential[own].max(), tangential.max(), mixed[own].max(), mixed.max()])


@pytest.mark.exact
def test_closed_forms_of_the_disc_are_the_sums_of_their_series() -> None:
    """Muskhelishvili, § 80, 2e5 terms; S_tt(x, x) is the limit of S_tt next to the load."""
    angle, n = np.array([0.3, 1.0, 2.5, np.pi]), np.arange(2, 200_001)
    kappa, shear = STEEL.kolosov, STEEL.shear
    along = [np.sum((kappa / (n + 1) + 1 / (n - 1)) * np.cos(n * a)) for a in angle]
    along = (np.array(along) + 1 / 3 + 0.5 * (kappa + 3) * np.cos(angle)) / (4 * np.pi * shear)
    assert along == pytest.approx(disc_along(STEEL, angle), abs=1e-4 * STEEL.kernel)
    mixed = [np.sum((kappa / (n + 1) - 1 / (n - 1)) * np.sin(n * a)) for a in angle]
    mixed = (np.array(mixed) + 0.5 * (kappa - 1) * np.sin(angle)) / (4 * np.pi * shear)
    assert mixed == pytest.approx(disc_mixed(STEEL, angle), abs=1e-4 * STEEL.kernel)
    near = disc_along(STEEL, np.array([1e-7])) + STEEL.kernel * np.log(1e-7 * RADIUS)
    assert near == pytest.approx(round_tangential(STEEL, RADIUS), abs=1e-6 * STEEL.kernel)


@pytest.mark.exact
@pytest.mark.parametrize(
    "plane", [STEEL, Material(1.0, 0.45).plane("strain"), Material(70e9, 0.0).plane("stress")]
)
@pytest.mark.parametrize("between", [0.0, 0.5])
def test_circular_disc(plane: Plane, between: float) -> None:
    """48 facets round a disc: at x = y 3e-4 of the logarithm's factor at and between stations; elsewhere 1.5e-3."""
    own_along, along, own_mixed, mixed = _errors(48, between, plane)
    assert own_along < 3e-4
    assert own_mixed < 3e-4
    assert along < 1.5e-3
    assert mixed < 5e-4


@pytest.mark.exact
@pytest.mark.parametrize("between", [0.0, 0.5])
def test_circular_disc_converges(between: float) -> None:
    """12, 24, 48 facets: at least the power 1.5 at and between stations (D spans the disc, then 8 facets of it)."""
    errors = np.array([_errors(facets, between) for facets in (12, 24, 48)])
    assert (np.log2(errors[0] / errors[2]) / 2).min() > 1.5
    assert (errors[:-1] / errors[1:]).min() > 2.0


@pytest.mark.exact
def test_hole_in_a_plate() -> None:
    """A hole in a plate 40 times as wide: S_tt and C_nt but for motions of the hole; t runs clockwise round it."""
    hole = Loop("hole", Circle((0.0, 0.0), RADIUS, hole=True), 48)
    edge = Loop("edge", Circle((0.0, 0.0), 40 * RADIUS), 48)
    body = build_body(mesh_outline(Outline(edge, (hole,))), STEEL)
    compliance = press(body, [hole], tangential=True)
    surface = compliance.surfaces["hole"]
    assert surface.sense == -1.0
    place = surface.positions + 0.3 * surface.length / 48
    angle = place / RADIUS
    found = compliance.coupled(surface_weights(surface, place), on_circle(RADIUS, angle))[:, 48]
    ahead = -(angle - angle[0])[1:]
    motions = np.stack([np.ones(47), np.cos(ahead), np.sin(ahead)], axis=-1)
    for part, expected in (
        (found[48:], hole_in_plate_green(STEEL, ahead)),
        (found[:48], plate_mixed(STEEL, ahead)),
    ):
        error = part[1:] - expected
        error -= motions @ np.linalg.lstsq(motions, error, rcond=None)[0]
        assert np.abs(error).max() < 3e-3 * STEEL.kernel


@pytest.fixture(scope="module")
def drilled() -> tuple[Body, Outline, Compliance]:
    mesh, outline = small_mesh(12)
    body = build_body(mesh, STEEL)
    return body, outline, press(body, outline.loops, tangential=True)


def _rubbed(body: Body, nodes: IntArray, sense: float, tangential: bool) -> Array:
    """Return the displacement (n, 2) of all nodes under one facet's uniform traction: plain finite elements."""
    x, w = np.polynomial.legendre.leggauss(8)
    x, w = 0.5 * (x + 1), 0.5 * w
    shape = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)])
    slope = np.stack([4 * x - 3, 4 * x - 1, 4 - 8 * x])
    along = slope.T @ body.mesh.points[nodes]
    speed = np.linalg.norm(along, axis=1)
    tangent = sense * along / speed[:, None]
    pull = tangent if tangential else np.stack([-tangent[:, 1], tangent[:, 0]], axis=-1)
    values = np.einsum("aq,q,qc->ac", shape, w * speed, pull) / (w @ speed)
    dofs = np.stack([2 * nodes, 2 * nodes + 1], axis=-1)
    none = np.zeros(0, dtype=np.intp)
    patch = Patch(dofs.ravel(), values.ravel(), none, none, np.zeros((0, 6, 2)), np.zeros(3))
    return solve_patches(body, [patch])[:, 0].reshape(-1, 2)


@pytest.mark.independent
@pytest.mark.parametrize(("name", "facet"), [("flank", 10), ("flank", 13), ("hole0", 3), ("bore", 2)])
@pytest.mark.parametrize("tangential", [False, True])
def test_plain_traction_on_a_facet(
    drilled: tuple[Body, Outline, Compliance], name: str, facet: int, tangential: bool
) -> None:
    """A facet's uniform traction in plain finite elements moves stations six facets off as C summed over it: 1e-3."""
    body, outline, compliance = drilled
    loop = next(x for x in outline.loops if x.name == name)
    stations, surfaces = place_stations(body, outline.loops)
    surface = compliance.surfaces[name]
    rubbed = _rubbed(body, body.mesh.edges[name][:, facet], surface.sense, tangential)[stations.nodes]
    normals = stations.normals
    tangent = np.stack([-normals[:, 1], normals[:, 0]], axis=-1)
    direct = np.concatenate([-np.sum(normals * rubbed, axis=1), np.sum(tangent * rubbed, axis=1)])
    arc, (start, end) = ArcLength(loop.curve), body.mesh.parameters[name][:2, facet]
    x, w = np.polynomial.legendre.leggauss(8)
    place = arc.length(start) + 0.5 * (x + 1) * (arc.length(end) - arc.length(start))
    parts = [surface_weights(s, s.positions) for s in surfaces] + [surface_weights(surface, place)]
    points = np.concatenate([body.mesh.points[stations.nodes], loop.curve.point(arc.parameter(place))])
    count, total = len(stations.nodes), len(points)
    found = compliance.coupled(Weights.joined(parts), points)
    column = np.arange(count, total) + tangential * total
    rows = np.concatenate([np.arange(count), total + np.arange(count)])
    summed = found[np.ix_(rows, column)] @ (0.5 * w)
    away = np.linalg.norm(points[:count] - points[count:].mean(axis=0), axis=1) > 6 * stations.facets
    far = np.concatenate([away, away])
    assert far.sum() > count
    assert np.abs(summed - direct)[far].max() < 1e-3 * np.ptp(direct)


@pytest.mark.property
def test_reciprocal(drilled: tuple[Body, Outline, Compliance]) -> None:
    """Betti: symmetric to rounding between surfaces too; what the raw columns miss of it is reported, and small."""
    _, _, compliance = drilled
    rng = np.random.default_rng(5)
    parts = [
        surface_weights(s, rng.uniform(0, s.length, 4))
        for s in (compliance.surfaces[n] for n in ("flank", "bore", "hole0", "hole5"))
    ]
    points = rng.normal(size=(16, 2)) * 0.05
    found = compliance.coupled(Weights.joined(parts), points)
    assert np.abs(found - found.T).max() < 1e-14 * np.abs(found).max()
    assert np.array_equal(found[:16, :16], compliance.between(Weights.joined(parts), points))
    assert compliance.tangential is not None
    assert compliance.tangential.asymmetry < 0.02
    coarse, fine = pressed_disc(12).tangential, pressed_disc(24).tangential
    assert coarse is not None
    assert fine is not None
    assert fine.asymmetry < 0.5 * coarse.asymmetry < 5e-3


@pytest.mark.property
def test_positive_for_contacts(drilled: tuple[Body, Outline, Compliance]) -> None:
    """Patches 0.1 mm wide on all surfaces: the compliance with their logarithms is positive definite."""
    _, outline, compliance = drilled
    rng = np.random.default_rng(8)
    names = ["flank", "bore", "hole0", "hole3"]
    loops = {x.name: x for x in outline.loops}
    places = [np.sort(rng.uniform(0, compliance.surfaces[n].length, 6)) for n in names]
    parts = [surface_weights(compliance.surfaces[n], p) for n, p in zip(names, places, strict=True)]
    points = np.concatenate(
        [
            loops[n].curve.point(ArcLength(loops[n].curve).parameter(p))
            for n, p in zip(names, places, strict=True)
        ]
    )
    found = compliance.coupled(Weights.joined(parts), points)
    found[np.diag_indices_from(found)] += STEEL.kernel * np.log(2 / 1e-4)
    assert np.linalg.eigvalsh(found).min() > 0


@pytest.mark.property
def test_batches(drilled: tuple[Body, Outline, Compliance]) -> None:
    """Places with leading axes give what one position after the other gives."""
    compliance = drilled[2]
    surface, rng = compliance.surfaces["flank"], np.random.default_rng(9)
    place, points = rng.uniform(-1, 1, size=(3, 5)), rng.normal(size=(3, 5, 2))
    both = compliance.coupled(surface_weights(surface, place), points)
    normal = compliance.between(surface_weights(surface, place), points)
    for i in range(3):
        weights = surface_weights(surface, place[i])
        assert np.array_equal(both[i], compliance.coupled(weights, points[i]))
        assert np.array_equal(normal[i], compliance.between(weights, points[i]))


@pytest.mark.property
@pytest.mark.parametrize("angle", [1.0, -2.5])
def test_does_not_see_the_frame(angle: float) -> None:
    """A turned and moved free disc with holes has the same tables: tangents turn with the normals."""
    mesh, outline = small_mesh()
    body = build_body(mesh, STEEL)
    stations, surfaces = place_stations(body, outline.loops)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    other = build_body(replace(mesh, points=mesh.points @ turn.T + np.array([0.1, -0.2])), STEEL)
    placed = replace(stations, normals=stations.normals @ turn.T)
    one = tabulate(body, stations, surfaces, tangential=True).tangential
    two = tabulate(other, placed, surfaces, tangential=True).tangential
    assert one is not None
    assert two is not None
    assert np.abs(one.mixed_stations - two.mixed_stations).max() < 1e-10 * STEEL.kernel
    assert np.abs(one.along_stations - two.along_stations).max() < 1e-10 * STEEL.kernel


@pytest.mark.property
def test_the_normal_part_does_not_change(drilled: tuple[Body, Outline, Compliance]) -> None:
    """Pressed along normals only: bit by bit the same tables, nothing tangential, and a refusal of it."""
    body, outline, both = drilled
    normal = press(body, outline.loops)
    assert normal.tangential is None
    for name in ("table", "diagonal", "stations"):
        assert np.array_equal(getattr(normal, name), getattr(both, name))
    assert normal.asymmetry == both.asymmetry
    surface = normal.surfaces["bore"]
    place = surface_weights(surface, np.array([0.0, 0.1]))
    with pytest.raises(TrochoidError, match="tangential=True"):
        normal.coupled(place, np.eye(2))

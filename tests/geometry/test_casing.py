"""The box casing: closed forms of its mass and inertia, its named places, and measures that cannot be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.geometry.solid_cases import CASING
from trochoid.fem.material import Material
from trochoid.fem.solid import mass_properties, solid_body
from trochoid.geometry.casing_box import BoxCasing, centers, inner_face, outer_face
from trochoid.geometry.casing_limits import fail_if_edge_too_long
from trochoid.geometry.casing_mesh import mesh_casing
from trochoid.geometry.casing_surface import points_off
from trochoid.geometry.solid_places import middle, patch
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array

BORE, MOUNT = CASING.bores[0], CASING.mounts[0]
Solid = tuple[float, Array, Array]  # volume, centre, second moments ∫ x xᵀ dV about the centre


def _box(low: Array, high: Array) -> Solid:
    side = high - low
    volume = float(np.prod(side))
    return volume, 0.5 * (low + high), volume * np.diag(side**2) / 12.0


def _cylinder(center: tuple[float, float], ends: tuple[float, float], radius: float) -> Solid:
    length = abs(ends[1] - ends[0])
    volume = np.pi * radius**2 * length
    own = volume * np.diag([radius**2 / 4.0, radius**2 / 4.0, length**2 / 12.0])
    return volume, np.array([*center, 0.5 * sum(ends)]), own


def _closed_form(casing: BoxCasing) -> tuple[float, Array, Array]:
    """Return volume, centre and inertia per density by adding and taking away boxes and cylinders."""
    low, high, wall = np.array(casing.low), np.array(casing.high), casing.wall
    reach = np.array([casing.flange[0], 0.0, casing.flange[1]])
    top = np.array([high[0], low[1] + casing.plate, high[2]])
    parts: list[tuple[int, Solid]] = [
        (1, _box(low, high)),
        (-1, _box(low + np.array([wall, casing.plate, wall]), high - wall)),
        (1, _box(low - reach, top + reach)),
        (-1, _box(low, top)),
    ]
    for bore in casing.bores:
        at, out, end = (bore.x, bore.y), outer_face(casing, bore), inner_face(casing, bore)
        through = out + (wall if bore.wall == "low" else -wall)
        parts += [
            (1, _cylinder(at, (through, end), bore.boss)),
            (-1, _cylinder(at, (out, end), bore.radius)),
        ]
    volume = sum(sign * part[0] for sign, part in parts)
    center = sum(sign * part[0] * part[1] for sign, part in parts) / volume
    second = sum(sign * (own + v * np.outer(at - center, at - center)) for sign, (v, at, own) in parts)
    return float(volume), np.asarray(center), np.asarray(np.trace(second) * np.eye(3) - second)


@pytest.mark.exact
@pytest.mark.parametrize(
    "casing",
    [
        CASING,
        BoxCasing((0.2, 0.2, 0.15), 0.02, CASING.bores[:1], (), center=(0.01, -0.02, 0.3)),
        replace(CASING, bores=(), flange=(0.05, 0.02)),
    ],
    ids=["example", "no mounts", "no bores"],
)
def test_mass_and_inertia(casing: BoxCasing) -> None:
    """Mass, centre and inertia of the mesh are those of boxes and cylinders, but for quadratic facets on the bores."""
    found = mass_properties(solid_body(mesh_casing(casing, 0.05), Material(2e11, 0.3, 7000.0)))
    volume, center, inertia = _closed_form(casing)
    assert found.mass == pytest.approx(7000.0 * volume, rel=1e-5)
    assert found.center == pytest.approx(center, abs=1e-7)
    assert found.inertia == pytest.approx(7000.0 * inertia, abs=1e-5 * 7000.0 * inertia.max())


@pytest.mark.exact
def test_named_places() -> None:
    """Seats lie on their bores over their lengths, mount places on the underside within their radius."""
    mesh = mesh_casing(CASING, 0.05)
    assert set(mesh.sets) == set(centers(CASING))
    for bore in CASING.bores:
        x, y, z = mesh.points[mesh.sets[bore.name]].T
        assert np.hypot(x - bore.x, y - bore.y) == pytest.approx(bore.radius, rel=1e-9)
        ends = sorted((outer_face(CASING, bore), inner_face(CASING, bore)))
        assert (z.min(), z.max()) == pytest.approx(tuple(ends))
    for mount in CASING.mounts:
        x, y, z = mesh.points[mesh.sets[mount.name]].T
        assert y == pytest.approx(CASING.low[1])
        away = np.hypot(x - mount.x, z - mount.z)
        assert away.max() == pytest.approx(mount.radius, rel=1e-6)


@pytest.mark.exact
def test_a_boss_thinner_than_its_facets_bulge() -> None:
    """Curved elements would fold there: edges are drawn straight, which costs the bores' roundness a little mass."""
    thin = replace(BORE, boss=1.03 * BORE.radius)
    casing = replace(CASING, bores=(thin,))
    found = mass_properties(solid_body(mesh_casing(casing, 0.05), Material(2e11, 0.3, 7000.0)))
    assert found.mass == pytest.approx(7000.0 * _closed_form(casing)[0], rel=1e-3)


@pytest.mark.exact
def test_middles_of_sets() -> None:
    """The middle of the nodes of a seat or mount place is its own."""
    mesh = mesh_casing(CASING, 0.05)
    for name, center in centers(CASING).items():
        assert middle(mesh, name) == pytest.approx(center, abs=1e-6)
    with pytest.raises(TrochoidError, match="no set 'bore'; there are input"):
        middle(mesh, "bore")


@pytest.mark.exact
def test_the_same_measures_give_the_same_mesh() -> None:
    """No chance in the mesh."""
    one, two = (mesh_casing(CASING, 0.05) for _ in range(2))
    assert np.array_equal(one.points, two.points)
    assert np.array_equal(one.elements, two.elements)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("casing", "said"),
    [
        (replace(CASING, wall=0.1), "more than 200 mm, or thinner"),
        (replace(CASING, wall=0.0), "thicker than 0"),
        (replace(CASING, base=-0.01), "base must be thicker"),
        (replace(CASING, flange=(-0.01, 0.0)), "flange cannot reach -10, 0 mm"),
        (replace(CASING, bores=(replace(BORE, boss=0.03),)), "0 < radius < boss"),
        (replace(CASING, bores=(replace(BORE, length=0.005),)), "at least 10 mm"),
        (replace(CASING, bores=(replace(BORE, length=0.25),)), "less than 190 mm"),
        (replace(CASING, bores=(replace(BORE, x=0.1),)), "x must be between -85 and 85 mm"),
        (
            replace(CASING, bores=(BORE, replace(BORE, name="b", x=0.05))),
            "bosses input and b overlap: 50 mm apart",
        ),
        (replace(CASING, bores=(BORE, BORE)), "input given twice"),
        (replace(CASING, mounts=(replace(MOUNT, x=-0.3),)), "between -175 and 175 mm"),
        (replace(CASING, mounts=(replace(MOUNT, radius=0.0),)), "radius above 0"),
        (replace(CASING, mounts=(MOUNT, replace(MOUNT, name="m"))), "foot 1 and m overlap"),
        (replace(CASING, wall=1e-5), "wall of 0.01 mm is too thin .* give 1.5 mm or more"),
        (
            replace(CASING, bores=(replace(BORE, boss=1.001 * BORE.radius),)),
            "too thin round a bore of 40 mm; give 40.8",
        ),
        (
            replace(CASING, bores=(replace(BORE, boss=0.5),)),
            "at y = 0 mm, meets a wall; there its radius must be below 110 mm",
        ),
        (
            replace(CASING, bores=(replace(BORE, radius=0.4, boss=0.5),)),
            "meets a wall; between these walls its radius must be below 112.5 mm anywhere",
        ),
        (
            replace(CASING, mounts=(replace(MOUNT, radius=0.5),)),
            "the plate has room for a radius below 190 mm",
        ),
    ],
)
def test_measures_that_cannot_be(casing: BoxCasing, said: str) -> None:
    """Refused before gmsh, with the limit."""
    with pytest.raises(Infeasible, match=said):
        mesh_casing(casing)


@pytest.mark.exact
def test_edges_longer_than_walls_and_box_are_refused() -> None:
    """8 walls, or a third of the shortest side, whichever is less."""
    fail_if_edge_too_long(CASING, 0.066)
    with pytest.raises(
        Infeasible, match=r"third of the shortest side of the box; give mesh_edge = 66\.66 mm or less"
    ):
        fail_if_edge_too_long(CASING, 1.0)
    with pytest.raises(Infeasible, match="longer than 8 walls; give mesh_edge = 16 mm or less"):
        fail_if_edge_too_long(replace(CASING, wall=0.002), 0.02)


@pytest.mark.independent
def test_distance_to_the_surface_is_that_to_a_mesh() -> None:
    """A point that no mesh would take is refused before there is one; what is on a mesh is not."""
    mesh = mesh_casing(CASING, 0.05)
    nodes = mesh.points[np.unique(mesh.facets)[::80]].tolist()
    assert not points_off(CASING, {str(i): (x, y, z) for i, (x, y, z) in enumerate(nodes)})
    drawn = np.random.default_rng(3).uniform(-0.18, 0.18, (60, 3)).tolist()
    points = {f"p{i}p": (x, y, z) for i, (x, y, z) in enumerate(drawn)}
    said = points_off(CASING, points)
    taken = [name for name in points if not any(f" {name} " in each for each in said)]
    assert 5 < len(taken) < 55
    for name in taken:
        patch(mesh, points[name])
    [one] = points_off(CASING, {"p": (0.0, 0.0, -0.1)})
    assert "the point p at 0, 0, -100 mm is 40 mm off the body" in one


@pytest.mark.exact
def test_edges_must_have_a_length() -> None:
    """An edge of 0 mm is refused."""
    with pytest.raises(Infeasible, match="longer than 0"):
        mesh_casing(CASING, 0.0)

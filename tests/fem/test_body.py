"""A factored body: supports, neighbours, and a free body that does not know where its matrix was held."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.fem.cases import STEEL, small_mesh
from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import Stations, Surface, place_stations, tabulate
from trochoid.geometry.mesh import Mesh
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, BoolArray

Free = tuple[Mesh, Stations, tuple[Surface, ...], Array]


@pytest.fixture(scope="module")
def free() -> Free:
    """Return a free disc with bore and holes, stations on all its loops and S between them."""
    mesh, outline = small_mesh()
    body = build_body(mesh, STEEL)
    stations, surfaces = place_stations(body, outline.loops)
    return mesh, stations, surfaces, tabulate(body, stations, surfaces).stations


def _moved(free: Free, angle: float, shift: tuple[float, float], scale: float = 1.0) -> Array:
    """Return S of the same mesh, turned, moved and scaled."""
    mesh, stations, surfaces, _ = free
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    body = build_body(replace(mesh, points=scale * mesh.points @ turn.T + np.array(shift)), STEEL)
    placed = replace(stations, normals=stations.normals @ turn.T, facets=scale * stations.facets)
    return tabulate(body, placed, surfaces).stations


@pytest.mark.property
@pytest.mark.parametrize(("angle", "shift"), [(1.0, (0.0, 0.0)), (0.0, (0.1, -0.2)), (-2.5, (1.0, 2.0))])
def test_compliance_does_not_see_the_frame(free: Free, angle: float, shift: tuple[float, float]) -> None:
    """S of a free body is that of the turned and moved one (other nodes are held there)."""
    assert np.abs(_moved(free, angle, shift) - free[3]).max() < 1e-10 * STEEL.kernel


@pytest.mark.property
@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_compliance_sees_the_scale_through_the_logarithm_alone(free: Free, scale: float) -> None:
    """C of a plane body has no length in it: S(c·body) = S + 2/(πE') ln c; metres or millimetres are the same."""
    expected = free[3] + STEEL.kernel * np.log(scale)
    assert np.abs(_moved(free, 0.0, (0.0, 0.0), scale) - expected).max() < 1e-10 * STEEL.kernel


@pytest.mark.property
@pytest.mark.parametrize("pick", [(0, -1), (3, 40)])
def test_compliance_does_not_see_which_nodes_are_held(
    free: Free, pick: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Held at any two inner nodes, also next to the flank, a free body yields alike: the holds carry nothing."""
    mesh, stations, surfaces, truth = free

    def anywhere(mesh: Mesh) -> BoolArray:
        boundary = np.unique(np.concatenate([edge.ravel() for edge in mesh.edges.values()]))
        first, second = np.setdiff1d(np.unique(mesh.triangles[:3]), boundary)[list(pick)]
        across = np.abs(mesh.points[second] - mesh.points[first])
        fixed = np.zeros(2 * len(mesh.points), dtype=bool)
        fixed[[2 * first, 2 * first + 1, 2 * second + int(across[0] > across[1])]] = True
        return fixed

    monkeypatch.setattr("trochoid.fem.body._three_points", anywhere)
    other = tabulate(build_body(mesh, STEEL), stations, surfaces).stations
    assert np.abs(other - truth).max() < 1e-10 * STEEL.kernel


@pytest.mark.property
def test_supports_do_not_move() -> None:
    """Nodes on the named edges, mid nodes too, stay where they are; others move."""
    mesh, _ = small_mesh()
    body = build_body(mesh, STEEL, ("bore",))
    answer = body.solve(np.ones((body.size, 1))).reshape(-1, 2)
    assert not answer[np.unique(mesh.edges["bore"])].any()
    assert np.abs(answer[mesh.edges["flank"][2]]).min() > 0


@pytest.mark.property
def test_unknown_support_is_refused() -> None:
    """The message names the edge that was given and those that exist."""
    mesh, _ = small_mesh()
    with pytest.raises(TrochoidError, match=r'"rim".*flank, bore'):
        build_body(mesh, STEEL, ("rim",))


@pytest.mark.exact
def test_neighbours_are_mutual_and_the_rest_is_boundary() -> None:
    """If b lies across a side of a, a lies across a side of b; sides without neighbour are the loops' facets."""
    mesh, _ = small_mesh()
    body: Body = build_body(mesh, STEEL)
    element, side = np.nonzero(body.neighbours >= 0)
    across = body.neighbours[element, side]
    assert all(a in body.neighbours[b] for a, b in zip(element, across, strict=True))
    alone = mesh.triangles[3:].T[body.neighbours < 0]
    facets = np.concatenate([edge[2] for edge in mesh.edges.values()])
    assert np.array_equal(np.sort(alone), np.sort(facets))

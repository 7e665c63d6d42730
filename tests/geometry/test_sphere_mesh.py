"""Meshes on the unit sphere: true curves at the nodes, exact areas, cuts that fit each other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings

from tests.kinematics.sphere_cases import EXAMPLES, teeth, tooth
from trochoid.geometry.sphere_mesh import jacobians, mesh_sphere, sphere_quality
from trochoid.geometry.sphere_outline import SphereOutline, roller_outline, sector_outline
from trochoid.geometry.sphere_refined import Focus, refined_breaks
from trochoid.geometry.sphere_rim import RimShape, beyond_edge
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import rotation

TOOTH = tooth(30, 29, 65.0, 2.5, 3.0)
_WEIGHTS = np.array([3.0, 3.0, 3.0, 8.0, 8.0, 8.0, 27.0]) / 120.0  # degree 3, at nodes and middle (Strang)


def rim(flank: SphereTooth, depth: float = 0.15) -> RimShape:
    """A rim whose hub lies `depth` (rad) beyond the bottom of the tooth spaces."""
    low, high = RimShape(flank, math.pi - 1e-6 if flank.hole else 1e-6).reach
    return RimShape(flank, min(high + depth, 3.0) if flank.hole else max(low - depth, 0.2 * low))


@pytest.mark.exact
@pytest.mark.parametrize("flank", EXAMPLES[:5])
def test_solid_angle_of_a_tooth_is_the_integral_round_it(flank: SphereTooth) -> None:
    """Archimedes: the solid angle between flank and hub is ∫ Δcos(polar angle) dφ; elements lie on the curves."""
    shape = rim(flank)
    p = np.linspace(shape.start, shape.start + shape.pitch, 4001)
    point = flank.point(p)
    azimuth = np.unwrap(np.arctan2(point[:, 1], point[:, 0]))
    height = point[:, 2] - math.cos(shape.hub)
    exact = abs(float(np.sum(0.5 * (height[1:] + height[:-1]) * np.diff(azimuth))))
    mesh = mesh_sphere(sector_outline(shape, 24))
    assert float(_WEIGHTS @ jacobians(mesh).sum(axis=1)) == pytest.approx(exact, rel=2e-5)


@pytest.mark.exact
@pytest.mark.parametrize("flank", EXAMPLES[:5])
def test_nodes_lie_on_the_curve_and_cuts_fit(flank: SphereTooth) -> None:
    """All three nodes of a facet are points of the flank; the right cut is the left one turned by a pitch."""
    shape = rim(flank)
    mesh = mesh_sphere(sector_outline(shape, 16))
    assert np.abs(mesh.points[mesh.edges["flank"]] - flank.point(mesh.parameters["flank"])).max() < 1e-14
    arc = ArcLength(flank).length(mesh.parameters["flank"])
    assert np.abs(arc[2] - 0.5 * (arc[0] + arc[1])).max() < 1e-12
    left, right = (mesh.points[mesh.nodes(name)] for name in ("left", "right"))
    assert np.abs(left @ rotation(2, shape.pitch).T - right).max() < 1e-14
    assert mesh.parameters["flank"][0, 0] == shape.start
    assert np.all(np.diff(mesh.parameters["flank"][0]) > 0.0)


@pytest.mark.property
@settings(max_examples=20, deadline=None)
@given(teeth())
def test_any_tooth_that_can_be_made_is_meshed_well(flank: SphereTooth) -> None:
    """Angles of a random tooth's mesh stay above 10°, and no element folds, where a facet turns by less than 40°."""
    outline = sector_outline(rim(flank), 32)
    side = next(side for side in outline.loops[0] if side.name == "flank")
    bend = np.abs(flank.curvature(np.linspace(side.parameters[0], side.parameters[1], 9)))
    assume(np.all(bend * np.linalg.norm(np.diff(side.ends, axis=0), axis=1) < 0.7))
    quality = sphere_quality(mesh_sphere(outline))
    assert quality.min_angle > math.radians(10.0)
    assert quality.min_scaled_jacobian > 0.1


@pytest.mark.exact
@pytest.mark.parametrize("flank", EXAMPLES[:4])
def test_cut_crests(flank: SphereTooth) -> None:
    """Facets up to the edges lie on the flank, those between on the cone of the tips; edges are mirror images."""
    whole = rim(flank)
    low, high = whole.reach
    shape = RimShape(flank, whole.hub, low + 0.2 * (high - low) if flank.hole else high - 0.2 * (high - low))
    assert shape.tip is not None
    assert shape.edges is not None
    assert np.arccos(flank.point(np.array(shape.edges))[:, 2]) == pytest.approx(shape.tip, abs=1e-12)
    mesh = mesh_sphere(sector_outline(shape, 20, teeth=2))
    node, p = mesh.points[mesh.edges["flank"]], mesh.parameters["flank"]
    off = beyond_edge(shape, p)
    assert off.any(axis=1).all()
    assert np.abs(node - flank.point(p))[~off].max() < 1e-14
    assert np.arccos(node[off][:, 2]) == pytest.approx(shape.tip, abs=1e-12)
    assert sphere_quality(mesh).min_angle > math.radians(15.0)
    with pytest.raises(Infeasible, match="cut between these"):
        RimShape(flank, whole.hub, high + 0.01)


@pytest.mark.exact
def test_roller_with_a_bore() -> None:
    """Its solid angle is that of a cone less another's, and facet 0 looks towards the z axis."""
    mesh = mesh_sphere(roller_outline(0.05, 48, 0.02))
    exact = 2.0 * math.pi * (math.cos(0.02) - math.cos(0.05))
    assert float(_WEIGHTS @ jacobians(mesh).sum(axis=1)) == pytest.approx(exact, rel=1e-5)
    middle = mesh.points[mesh.edges["flank"][2, 0]]
    assert middle == pytest.approx([math.cos(0.05), 0.0, math.sin(0.05)], abs=1e-14)


@pytest.mark.exact
def test_chart_and_back() -> None:
    """Unit vectors come back from the chart."""
    outline: SphereOutline = sector_outline(rim(TOOTH), 12)
    points = outline.loops[0][0].ends
    assert outline.from_chart(outline.to_chart(points)) == pytest.approx(points, abs=1e-14)


@pytest.mark.exact
def test_refined_facets_stand_about_their_focus() -> None:
    """The window has the facets asked for, centred on the contact; the row ends at the bottoms of its spaces."""
    shape, place = rim(TOOTH), 0.71
    breaks = refined_breaks(shape, 2, 3, 12, (Focus(place, 1e-5, 10),))
    arc = ArcLength(TOOTH)
    s = arc.length(breaks) - float(arc.length(place))
    inside = np.flatnonzero(np.abs(s) < 5.0001e-5)
    assert s[inside] == pytest.approx(np.linspace(-5e-5, 5e-5, 11), abs=1e-12)
    assert breaks[[0, -1]] == pytest.approx(shape.start + np.array([2, 5]) * shape.pitch)
    with pytest.raises(Infeasible, match="overlap"):
        refined_breaks(shape, 2, 3, 12, (Focus(place, 1e-5, 10), Focus(place + 1e-6, 1e-5, 10)))


@pytest.mark.property
def test_what_cannot_be_built_is_refused() -> None:
    """Hubs on the wrong side, too few facets, too many teeth, bores wider than the roller."""
    with pytest.raises(Infeasible, match="less than that"):
        RimShape(TOOTH, math.radians(64.0))
    with pytest.raises(Infeasible, match="more than that"):
        RimShape(EXAMPLES[2], math.radians(64.0))
    with pytest.raises(Infeasible, match="at least 6"):
        sector_outline(rim(TOOTH), 3)
    with pytest.raises(Infeasible, match="1 to 28"):
        sector_outline(rim(TOOTH), 12, teeth=29)
    with pytest.raises(Infeasible, match="bore must be the smaller"):
        roller_outline(0.02, 24, 0.03)

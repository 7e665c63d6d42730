"""Displacement and stress of all elements of a rim, and contacts as strips, against the solver they come from."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import pytest

from tests.fem import cone_cases as cases
from trochoid.fem.cone_assembly import ConeContact
from trochoid.fem.cone_body import product
from trochoid.fem.cone_field import RimField, displacements, rim_field, station_forces
from trochoid.fem.cone_slices import between
from trochoid.fem.cone_stress import joined_at_cuts, nodal_stress, stress_rule, von_mises
from trochoid.fem.cone_strip import cone_strips, ellipse, flank_displacement
from trochoid.fem.cone_surface import tooth_surface
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.types import Array

TORQUE = 150.0


@lru_cache(maxsize=1)
def case() -> tuple[ConeContact, RimField, Array, Array]:
    """A loaded rim: its contacts, field, forces (teeth, stations, layers) and displacement (teeth, n, rays, 3)."""
    rim = cases.rim()
    rollers = cases.pair(rim, np.array([0.3]))
    found = cases.solved(rim, rollers, TORQUE)
    field = rim_field(rim)
    forces = station_forces(rim, found.state.place[0], found.force[0])
    (moved,) = displacements(field, forces[None])
    return found, field, forces, moved


def seen_by_loads(field: RimField, moved: Array) -> Array:
    """Displacement (teeth, stations, layers) that each station's load does work on."""
    loads, body = field.rim.sector.loads, field.rim.body
    flat = moved.transpose(1, 3, 2, 0).reshape(body.size, -1)
    raw = (product(loads.plane, loads.radial).T @ flat).T.reshape(len(moved), len(loads.station), -1)
    seen = np.zeros((len(moved), len(field.rim.compliance.centers), raw.shape[2]))
    for part, (station, shift) in enumerate(zip(loads.station, loads.shift, strict=True)):
        seen[:, station] += np.roll(raw[:, part], -int(shift), axis=0)
    return seen


@pytest.mark.exact
def test_loads_see_what_the_table_says() -> None:
    """Work of every station's load on the recovered field: the table of compliances times the forces, to rounding."""
    _, field, forces, moved = case()
    compliance = field.rim.compliance
    table = compliance.table[compliance.coupling.pair]  # (teeth, teeth, k, s, k, s)
    expected = np.einsum("mlksjt,ljt->mks", table, forces, optimize=True)
    assert np.abs(seen_by_loads(field, moved) - expected).max() < 1e-11 * np.abs(expected).max()


@pytest.mark.exact
def test_elements_are_in_balance() -> None:
    """Inside each tooth K u is the load; along cuts what two neighbours leave does no work on any displacement."""
    _, field, forces, moved = case()
    body, loads = field.rim.body, field.rim.sector.loads
    flat = moved.transpose(1, 3, 2, 0).reshape(body.size, -1)
    number = np.arange(len(forces))[:, None]
    parts = forces[(number - loads.shift) % len(forces), loads.station].reshape(len(forces), -1)
    load = product(loads.plane, loads.radial) @ parts.T
    left = body.stiffness @ flat - load
    size = np.abs(load).max()
    assert np.abs(left[field.inside]).max() < 1e-8 * size
    on_cuts = field.trace.T @ left
    t = len(on_cuts) // 2
    assert np.abs(on_cuts[:t] + np.roll(on_cuts[t:], 1, axis=1)).max() < 1e-8 * size


@pytest.mark.exact
def test_contacts_close_over_the_field() -> None:
    """Gap, the field's yielding seen by the elements' wide loads, and what a narrower contact adds: little is left.

    Left out is what elements miss of a narrow load, and that contacts between stations are loaded at four of them,
    over more width than has one: 3 % beside a station, a tenth between them.
    """
    found, field, _, moved = case()
    compliance, state = field.rim.compliance, found.state
    at = compliance.weights(state.place[0])
    seen = np.sum(at.value[..., None] * seen_by_loads(field, moved)[at.tooth, at.station], axis=1)
    load = found.force[0] / compliance.slices.length
    wide = compliance.blunt(at)[:, None] * compliance.slices.middle
    b = np.maximum(found.half_width[0], 1e-300)
    narrower = compliance.kernel * load * (np.log(wide / b) + 0.25)
    left = state.gap[0] + seen + narrower
    pressed = found.force[0] > 0.0
    assert pressed.sum() > 20
    inner = pressed & (np.arange(pressed.shape[1]) > 0) & (np.arange(pressed.shape[1]) < pressed.shape[1] - 1)
    approach = np.abs(seen + narrower)[inner].max()
    assert np.abs(left[inner]).mean() < 0.02 * approach
    assert np.abs(left[inner]).max() < 0.1 * approach
    at_station = inner & (at.value.max(axis=1) > 0.9)[:, None]
    assert at_station.any()
    assert np.abs(left[at_station]).max() < 0.03 * approach


@pytest.mark.exact
def test_linear_displacement_has_even_stress() -> None:
    """Hooke's law for a displacement G x, at all nodes."""
    body = cases.rim().body
    slope = np.array([[3.0, 1.0, -2.0], [0.5, -1.0, 4.0], [1.0, 2.0, 2.5]]) * 1e-5
    points = body.mesh.points[:, None] * body.radial.nodes[:, None]
    stress = nodal_stress(stress_rule(body), points @ slope.T)
    shear = 210e9 / 2.6
    full = shear * (slope + slope.T) + 210e9 * 0.3 / (1.3 * 0.4) * np.trace(slope) * np.eye(3)
    expected = full[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
    np.testing.assert_allclose(
        stress, np.broadcast_to(expected, stress.shape), atol=1e-9 * np.abs(full).max()
    )
    assert von_mises(np.array([5.0, 0, 0, 0, 0, 0])) == pytest.approx(5.0)
    assert von_mises(np.array([0, 0, 0, 0, 2.0, 0])) == pytest.approx(2.0 * math.sqrt(3.0))


@pytest.mark.property
def test_flanks_without_contact_are_free() -> None:
    """Behind the loaded teeth the flank is loaded by nothing; stresses agree where teeth are cut apart."""
    found, field, _, moved = case()
    body, pitch = field.rim.body, field.rim.shape.pitch
    rule = stress_rule(body)
    stress = np.array([nodal_stress(rule, one) for one in moved])
    joined = joined_at_cuts(body, pitch, stress)
    teeth = np.unique(
        (found.state.place[0][found.total[0] > 0.0] // field.rim.side.length).astype(int) % len(moved)
    )
    free = np.setdiff1d(np.arange(len(moved)), np.concatenate([teeth - 1, teeth, teeth + 1]) % len(moved))
    assert len(free) > 3
    assert np.abs(joined - stress)[free].max() < 0.01 * np.abs(stress).max()
    nodes, parameter = field.rim.side.edge[2], field.rim.side.parameters[2]
    normal = field.rim.shape.tooth.normal(parameter)
    s = joined[free][:, nodes]
    across = s[..., 0] * normal[:, None, 0] ** 2 + s[..., 1] * normal[:, None, 1] ** 2
    across += s[..., 2] * normal[:, None, 2] ** 2 + 2.0 * s[..., 3] * (normal[:, 0] * normal[:, 1])[:, None]
    across += 2.0 * s[..., 4] * (normal[:, 1] * normal[:, 2])[:, None]
    across += 2.0 * s[..., 5] * (normal[:, 0] * normal[:, 2])[:, None]
    assert np.abs(across).max() < 0.01 * von_mises(joined).max()


@pytest.mark.property
def test_surface_is_closed_but_for_the_cuts() -> None:
    """Every edge belongs to two triangles that run through it in opposite senses, or lies on a cut."""
    body = cases.rim().body
    surface = tooth_surface(body)
    corners = surface.cells[:3]
    edges = {
        (int(a), int(b)) for i in range(3) for a, b in zip(corners[i], corners[(i + 1) % 3], strict=True)
    }
    assert len(edges) == corners.size
    cut = np.isin(surface.plane, np.concatenate([body.mesh.nodes("left"), body.mesh.nodes("right")]))
    assert all(cut[a] and cut[b] for a, b in edges if (b, a) not in edges)
    p = surface.points(body)[corners]
    outward = np.cross(p[1] - p[0], p[2] - p[0])
    outer = np.linalg.norm(p, axis=-1).min(axis=0) > cases.OUTER - 1e-9
    assert (np.sum(outward * p[0], axis=-1)[outer] > 0.0).all()


@pytest.mark.exact
def test_strips_carry_their_forces() -> None:
    """Pressure over a strip's area: the force of its contact, to the error of 16 chords of a half ellipse."""
    found, field, _, moved = case()
    rim, state = field.rim, found.state
    pressed = np.flatnonzero(found.total[0] > 0.0)
    strip = cone_strips(
        rim.compliance.slices,
        state.point[0, pressed],
        state.normal[0, pressed],
        found.force[0, pressed],
        found.pressure[0, pressed],
    )
    corner = strip.points[strip.cells]
    area = 0.5 * np.linalg.norm(np.cross(corner[1] - corner[0], corner[2] - corner[0]), axis=-1)
    force = np.bincount(strip.contact[strip.cells[0]], area * strip.pressure[strip.cells].mean(axis=0))
    np.testing.assert_allclose(force, found.total[0, pressed], rtol=0.012)
    assert (force < found.total[0, pressed]).all()
    assert strip.pressure.max() == pytest.approx(found.pressure[0].max(), rel=0.05)
    place = state.place[0, pressed]
    middle = np.abs(strip.from_middle).max(axis=1) == 0.0
    here = flank_displacement(rim, moved, place[strip.contact[middle]], strip.distance[middle])
    inward = -np.sum(here * state.normal[0, pressed][strip.contact[middle]], axis=-1)
    assert (inward[strip.pressure[middle] > 0.5 * strip.pressure.max()] > 0.0).all()


@pytest.mark.exact
def test_nodes_of_the_flank_keep_their_displacement() -> None:
    """At a node's own place, on any tooth, turned with it."""
    _, field, _, moved = case()
    rim = field.rim
    tooth, facet, ray = 3, 5, 4
    for share, corner in ((0.0, 0), (0.5, 2)):
        low, high = rim.side.ends[facet : facet + 2]
        place = np.array([tooth * rim.side.length + (1 - share) * low + share * high])
        found = flank_displacement(rim, moved, place, rim.body.radial.nodes[[ray]])
        node = rim.side.edge[corner, facet]
        expected = rotation(2, tooth * rim.shape.pitch) @ moved[tooth, node, ray]
        np.testing.assert_allclose(found[0], expected, atol=1e-9 * np.abs(moved).max())


@pytest.mark.exact
def test_ellipse_carries_its_force() -> None:
    """2/3 π a b p0 (Hertz), to the error of the chords."""
    axes = np.array([[3e-4, 0.0, 0.0], [0.0, 1e-4, 0.0]])
    strip = ellipse(np.array([0.0, 0.0, 0.1]), axes, 2e9)
    corner = strip.points[strip.cells]
    area = 0.5 * np.linalg.norm(np.cross(corner[1] - corner[0], corner[2] - corner[0]), axis=-1)
    force = float(np.sum(area * strip.pressure[strip.cells].mean(axis=0)))
    assert force == pytest.approx(2.0 / 3.0 * math.pi * 3e-8 * 2e9, rel=0.02)
    assert strip.pressure.max() == 2e9


@pytest.mark.exact
def test_a_row_of_teeth_is_refused() -> None:
    """Its last tooth has no neighbour."""
    from trochoid.fem.cone_rim import RimMesh, RimSize, press_rim

    row = press_rim(cases.SHAPE, RimSize(cases.INNER, cases.OUTER, teeth=2), cases.STEEL, RimMesh(8, 3))
    with pytest.raises(TrochoidError, match="closed rim"):
        rim_field(row)


@pytest.mark.exact
def test_no_force_is_no_strip() -> None:
    """Slices that do not touch have no width."""
    slices = between(np.linspace(0.05, 0.06, 5))
    force = np.array([[0.0, 3.0, 5.0, 0.0]])
    strip = cone_strips(slices, np.eye(3)[:1], np.eye(3)[1:2], force, 1e8 * np.sqrt(force))
    assert (strip.pressure >= 0.0).all()
    assert set(np.round(strip.distance, 6)) == {0.05, 0.0525, 0.055, 0.0575, 0.06}

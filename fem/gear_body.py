"""A gear as an elastic body: one fine tooth is pressed, and symmetry makes the compliance of all teeth of it.

    tooth ──► blank ──► outline ──► mesh ──► body ──► unit forces on one flank of tooth 0 ──► S between that flank
    and all flanks (and the rim's edge) ──► turned and mirrored: tables of all teeth, `Compliance` ──► contacts

A pressed station sees all teeth: its own through the fine mesh, the others through their few facets. A gear that turns
onto its next tooth finds the same numbers, to the last bit. Flanks are open surfaces, their arc length s = ρ²/(2 r_b)
counts from the base circle up. A gear is held at its rim's edge (a bore shrunk on a stiff shaft, a ring in a stiff
casing), and displacements count from that edge; or it is free, and they count from the body's mean motion.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem import flamant
from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import Compliance, solve_patches
from trochoid.fem.gear_table import (
    all_teeth,
    flank_blocks,
    flank_surfaces,
    gear_compliance,
    rim_surface,
    with_rim,
)
from trochoid.fem.material import Plane
from trochoid.fem.patch import Patch, PointForce, patch_load
from trochoid.fem.surface import Surface
from trochoid.geometry.gear_outline import LEVEL, Blank, gear_growth, gear_outline
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.kinematics.types import Array, BoolArray, IntArray, frozen


@dataclass(frozen=True, slots=True)
class GearBody:
    """A gear as contacts see it.

    `flank` is the surface of tooth 0 at positive polar angles from space 0; that of another tooth and hand starts at
    the station `first(tooth, hand)`. `compliance` has surfaces "tooth0+", "tooth0-", … and, when pressed, "rim".
    """

    blank: Blank
    level: int
    body: Body
    compliance: Compliance
    flank: Surface
    asymmetry: float

    def first(self, number: IntArray, hand: int) -> IntArray:
        """Return the first stations of flanks next to spaces `number`, at positive (hand 1) or negative angles."""
        teeth, stations = self.blank.tooth.gear.teeth, len(self.flank.positions)
        tooth = np.mod(number if hand > 0 else number - 1, teeth)
        return (2 * tooth + (hand < 0)) * stations


@dataclass(frozen=True, slots=True)
class Places:
    """Where displacements are read: facet `nodes` (3, r) and their `shares` (3, r), `points` and inward normals (r,
    2)."""

    nodes: IntArray
    shares: Array
    points: Array
    inward: Array


def press_gear(
    blank: Blank, plane: Plane, level: int = LEVEL, held: bool = True, rim: int | None = None
) -> GearBody:
    """Mesh a gear, factor it and tabulate the compliance of its flanks, of unit thickness.

    `level` facets per flank. `held`: the rim's edge is fixed; else the body is free, and with `rim`, the facets per
    tooth there at the level 8, that edge is pressed too (rollers in a planet's bore). Raises Infeasible,
    TrochoidError.
    """
    outline = gear_outline(blank, level, rim)
    mesh = mesh_outline(outline, gear_growth(blank))
    body = build_body(mesh, plane, ("rim",) if held else ())
    flank = _flank(blank, mesh)
    facets = _on_flank(blank, mesh)
    loads = [_load(mesh, blank.boundary.normal, "teeth", int(i)) for i in facets]
    teeth, count = blank.tooth.gear.teeth, 0
    places = flank_places(blank, mesh, mesh.parameters["teeth"][2, facets], np.arange(teeth))
    if rim is not None and not held:
        loop = next(loop for loop in outline.loops if loop.name == "rim")
        count = len(mesh.edges["rim"][0]) // teeth
        loads += [_load(mesh, loop.curve.normal, "rim", i) for i in range(count)]
        places = _joined([places, _rim_places(mesh, loop.curve.normal)])
    raw = _displacements(body, places, loads)
    flanks, asymmetry = flank_blocks(raw, teeth, len(facets))
    table = all_teeth(flanks)
    surfaces = flank_surfaces(flank, teeth)
    if count:
        table = with_rim(table, raw, teeth, len(facets), count)
        surfaces.append(rim_surface(blank, plane, count, len(table) - teeth * count))
    return GearBody(
        blank,
        level,
        body,
        gear_compliance(table, surfaces, places.points, plane.kernel, count),
        flank,
        asymmetry,
    )


def _flank(blank: Blank, mesh: Mesh) -> Surface:
    tooth, t = blank.tooth, mesh.parameters["teeth"][2, _on_flank(blank, mesh)]
    base = tooth.gear.base_radius
    s = 0.5 * blank.boundary.rho(t) ** 2 / base
    low, high = sorted((0.5 * tooth.cut.start**2 / base, 0.5 * tooth.end**2 / base))
    return Surface("tooth0+", frozen(s), high - low, 0, 0.0, 1.0, 0.0, (low, high))


def _on_flank(blank: Blank, mesh: Mesh) -> IntArray:
    """Return the facets of the fine tooth's flank at positive polar angles from space 0, from the base circle up."""
    low, high = blank.boundary.plain.knots[1:]
    t = mesh.parameters["teeth"][2]
    facets = np.flatnonzero((t > low) & (t < high))
    return facets[::-1] if blank.tooth.gear.internal else facets


def _load(mesh: Mesh, normal: Callable[[Array], Array], edge: str, facet: int) -> PointForce:
    start, end, middle = mesh.edges[edge][:, facet]
    inward = -normal(mesh.parameters[edge][2, facet])
    element = int(np.flatnonzero((mesh.triangles[3:] == middle).any(axis=0))[0])
    length = float(np.linalg.norm(mesh.points[end] - mesh.points[start]))
    return PointForce(mesh.points[middle], inward, inward, element, length)


def flank_places(blank: Blank, mesh: Mesh, t: Array, teeth: IntArray) -> Places:
    """Return the stations t (n,) of tooth 0 on the flanks of `teeth`, one after the other, positive polar angles
    first."""
    number = teeth[:, None]
    every = np.stack([number + t, number + 1.0 - t], axis=1).ravel()
    edge, ends = mesh.edges["teeth"], mesh.parameters["teeth"]
    facet = np.searchsorted(ends[0], every, side="right") - 1
    low, high, middle = ends[:, facet]
    x = (every - low) / (high - low)
    for _ in range(5):  # where the quadratic through the three nodes' parameters has the station
        value = (1 - x) * (1 - 2 * x) * low + x * (2 * x - 1) * high + 4 * x * (1 - x) * middle
        x = x - (value - every) / ((4 * x - 3) * low + (4 * x - 1) * high + (4 - 8 * x) * middle)
    own = np.abs(every - middle) <= 1e-12 * blank.tooth.gear.teeth
    x = np.where(own, 0.5, x)
    shares = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)])
    return Places(edge[:, facet], shares, blank.boundary.point(every), -blank.boundary.normal(every))


def _rim_places(mesh: Mesh, normal: Callable[[Array], Array]) -> Places:
    edge, t = mesh.edges["rim"], mesh.parameters["rim"]
    shares = np.zeros(edge.shape)
    shares[2] = 1.0
    return Places(edge, shares, mesh.points[edge[2]], -normal(t[2]))


def _joined(parts: Sequence[Places]) -> Places:
    return Places(
        np.concatenate([p.nodes for p in parts], axis=1),
        np.concatenate([p.shares for p in parts], axis=1),
        np.concatenate([p.points for p in parts]),
        np.concatenate([p.inward for p in parts]),
    )


def _displacements(body: Body, places: Places, loads: Sequence[PointForce]) -> Array:
    """Return S (r, k): what the places move inwards under unit forces, without the logarithm of the distance."""
    patches = [patch_load(body, load) for load in loads]
    answer = solve_patches(body, patches).reshape(-1, 2, len(loads))
    smooth = np.einsum("ar,arik,ri->rk", places.shares, answer[places.nodes], places.inward)
    for k, (load, patch) in enumerate(zip(loads, patches, strict=True)):
        distance = np.linalg.norm(places.points - load.point, axis=1)
        elsewhere = distance > 1e-9 * load.facet
        logarithm = np.log(np.where(elsewhere, distance, 1.0))
        smooth[:, k] += body.plane.kernel * logarithm + _singular(body, places, load, patch, elsewhere)
    return np.asarray(smooth)


def _singular(body: Body, places: Places, load: PointForce, patch: Patch, elsewhere: BoolArray) -> Array:
    """Return Flamant's displacement (r,) at places whose nodes lie inside the patch; none at the load itself."""
    inside = np.isin(places.nodes, patch.nodes) & elsewhere & (places.shares != 0.0)
    result = np.zeros(len(places.points))
    node, row = np.nonzero(inside)
    at = body.mesh.points[places.nodes[node, row]] - load.point
    moved = flamant.displacement(body.plane, at, load.inward, load.force)
    np.add.at(result, row, places.shares[node, row] * np.einsum("ri,ri->r", moved, places.inward[row]))
    return result

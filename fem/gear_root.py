"""Stress in the fillets of a loaded gear, from a table of unit forces.

A fillet is free of load, so that only the stress along it is not zero: σ = E' du/ds, read from the boundary's own
nodes, where quadratic elements give the derivative in the middle of a facet one order better than elsewhere. The fine
tooth is the one that is looked at; forces on it are tabulated at every station, those on its neighbours at three,
which is enough for what comes through the rim. Stresses are of unit force per unit width; forces and width are put in
afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem import flamant
from trochoid.fem.body import Body
from trochoid.fem.compliance import solve_patches
from trochoid.fem.gear_body import GearBody, flank_places
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.pair import State
from trochoid.fem.patch import RADIUS, PointForce, patch_load
from trochoid.fem.surface import collocation, surface_weights
from trochoid.kinematics.types import Array, IntArray, frozen

NEIGHBOURS = 3  # teeth on each side whose forces count
_COARSE = 3.0  # facets of a coarse tooth in the patch round a force on it


@dataclass(frozen=True, slots=True)
class RootTable:
    """Stress along both fillets of a tooth under unit line loads on flanks at positive polar angles.

    `parameters` (k,) of the places on the gear's boundary, from the flank's own space across to the next; `own` (n,
    k) spline coefficients along the tooth's flank and `beside` (2m, 3, k) at three arc lengths `marks` (3,) on the
    teeth −m … m but itself, all in Pa per N/m.
    """

    gear: GearBody
    parameters: Array
    own: Array
    beside: Array
    marks: Array


@dataclass(frozen=True, slots=True)
class Loaded:
    """Forces on flanks of one hand of a gear at n positions: spaces (n, c), arc length there in m, force in N."""

    number: IntArray
    hand: int
    place: Array
    force: Array


def root_table(gear: GearBody, neighbours: int = NEIGHBOURS) -> RootTable:
    """Tabulate the stress in both fillets of the fine tooth."""
    mesh, teeth = gear.body.mesh, gear.blank.tooth.gear.teeth
    fillet = gear.blank.boundary.plain.knots[1]
    middle = mesh.parameters["teeth"][2]
    seen = np.flatnonzero((middle < fillet) | ((middle > 1.0 - fillet) & (middle < 1.0)))
    s = gear.flank.positions
    marks = np.linspace(s[0], s[-1], 3)
    reach = min(neighbours, (teeth - 1) // 2)
    sides = [d for d in range(-reach, reach + 1) if d]
    loads = _loads(gear, 0, s)
    for d in sides:
        loads += _loads(gear, d % teeth, marks)
    stress = _stress(gear.body, loads, mesh.edges["teeth"][:, seen], [RADIUS] * len(s))
    own = np.linalg.solve(collocation(gear.flank), stress[: len(s)])
    beside = stress[len(s) :].reshape(len(sides), 3, -1)
    return RootTable(gear, frozen(middle[seen]), frozen(own), frozen(beside), frozen(marks))


def root_stress(table: RootTable, loaded: Sequence[Loaded], tooth: IntArray, width: float) -> Array:
    """Return the stress (n, k) in Pa along the fillets of a tooth (n,), by the table's parameters; tension is positive.

    Teeth are numbered as by the space before them. Forces farther off than the table reaches are left out.
    """
    teeth = table.gear.blank.tooth.gear.teeth
    total = np.zeros((len(tooth), len(table.parameters)))
    for part in loaded:
        own = part.number if part.hand > 0 else part.number - 1
        away = part.hand * (own - tooth[:, None])  # mirrored for the other hand
        away = np.mod(away + teeth // 2, teeth) - teeth // 2
        stress = np.einsum("nc,nck->nk", part.force / width, _read(table, away, part.place))
        total += stress if part.hand > 0 else stress[:, ::-1]
    return total


def largest(stress: Array) -> Array:
    """Return the largest tension (n,) along fillets, between the places where it was read."""
    k = np.clip(stress.argmax(axis=-1), 1, stress.shape[-1] - 2)[..., None]
    low, mid, high = (np.take_along_axis(stress, k + i, -1)[..., 0] for i in (-1, 0, 1))
    bend = low - 2.0 * mid + high
    top = np.where(bend < 0.0, mid - (high - low) ** 2 / (8.0 * np.where(bend < 0.0, bend, -1.0)), mid)
    return np.asarray(np.where(np.abs(high - low) <= -2.0 * bend, top, stress.max(axis=-1)))


def pair_loads(pair: GearPair, state: State, force: Array, second: bool = False) -> Loaded:
    """Return what a mesh puts on its first (or `second`) gear, with forces (n, c) in N."""
    place = state.far if second else state.place
    assert place is not None
    hand = int(pair.flanks[1].side) * pair.hand if second else pair.hand
    return Loaded(pair.numbers[int(second)], hand, place, force)


def tooth_stress(table: RootTable, loaded: Loaded, width: float) -> Array:
    """Return the largest tension (n, c) in Pa in the fillets of each contact's tooth, under all of these contacts."""
    tooth = loaded.number if loaded.hand > 0 else loaded.number - 1
    return np.stack(
        [largest(root_stress(table, [loaded], tooth[:, c], width)) for c in range(tooth.shape[1])], axis=1
    )


def _read(table: RootTable, away: IntArray, place: Array) -> Array:
    """Return stresses (n, c, k) under unit line loads on teeth `away` (n, c) from the one looked at."""
    weights = surface_weights(table.gear.flank, place)
    columns = weights.columns - table.gear.flank.first
    own = np.einsum("nca,ncak->nck", weights.values, table.own[columns])
    reach = len(table.beside) // 2
    row = np.clip(np.where(away > 0, away - 1, away) + reach, 0, 2 * reach - 1)
    a, b, c = table.marks
    shares = np.stack(
        [
            (place - b) * (place - c) / ((a - b) * (a - c)),
            (place - a) * (place - c) / ((b - a) * (b - c)),
            (place - a) * (place - b) / ((c - a) * (c - b)),
        ],
        axis=-1,
    )
    other = np.einsum("nca,ncak->nck", shares, table.beside[row]) if reach else np.zeros(own.shape)
    other = np.where((np.abs(away) <= reach)[..., None], other, 0.0)
    return np.where((away == 0)[..., None], own, other)


def _loads(gear: GearBody, tooth: int, place: Array) -> list[PointForce]:
    """Return unit forces on the flank of a tooth at arc lengths (n,)."""
    base = gear.blank.tooth.gear.base_radius
    t = gear.blank.boundary.parameter(np.sqrt(2.0 * base * place))
    places, mesh = flank_places(gear.blank, gear.body.mesh, t, np.array([tooth])), gear.body.mesh
    loads = []
    for i in range(len(t)):  # the other hand's places follow
        nodes = places.nodes[:, i]
        element = int(np.flatnonzero((mesh.triangles[3:] == nodes[2]).any(axis=0))[0])
        length = float(np.linalg.norm(mesh.points[nodes[1]] - mesh.points[nodes[0]]))
        point = places.shares[:, i] @ mesh.points[nodes]
        loads.append(PointForce(point, places.inward[i], places.inward[i], element, length))
    return loads


def _stress(body: Body, loads: Sequence[PointForce], facets: IntArray, radii: Sequence[float]) -> Array:
    """Return E' du/ds (k, f) in the middle of facets (3, f) under each load."""
    patches = [
        patch_load(body, load, radii[i] if i < len(radii) else _COARSE) for i, load in enumerate(loads)
    ]
    moved = solve_patches(body, patches).reshape(-1, 2, len(loads))
    ends = facets[:2]
    along = body.mesh.points[ends[1]] - body.mesh.points[ends[0]]
    result = np.empty((len(loads), facets.shape[1]))
    for k, (load, patch) in enumerate(zip(loads, patches, strict=True)):
        at = moved[ends, :, k]
        inside = np.isin(ends, patch.nodes)
        offset = body.mesh.points[ends[inside]] - load.point
        at[inside] += flamant.displacement(body.plane, offset, load.inward, load.force)
        result[k] = np.einsum("fi,fi->f", at[1] - at[0], along)
    return np.asarray(body.plane.modulus * result / np.einsum("fi,fi->f", along, along))

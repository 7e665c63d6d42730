"""The linear part of an RV drive, seen from the carrier: crankshafts as beams on their bearings, planets, sun.

Each crankshaft is a stepped round beam through its two bearings, the planes of the discs and the plane of its planet.
The teeth of sun and planet are a spring along the line of action, which stands still in the carrier's frame; the sun
is held against turning and rests on a spring sideways. All that no contact touches is condensed: what is left are the
motions of the eccentrics.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.drives.rv.design import Design
from trochoid.fem.beam import Step, condensed, shaft
from trochoid.fem.material import Material
from trochoid.kinematics.types import Array, frozen

HELD = 1e9  # N/m: any number, in whose place rigid bearings stand
PARTS = ("crankshafts", "crank_bearings", "first_stage", "sun_support")


@dataclass(frozen=True, slots=True)
class Supports:
    """What the motions `names` (k) of the eccentrics work against; SI.

    `stiffness[part]` (k, k) is the share of each part, their sum the whole. Per unit motion: `bearings` (j, 2, 2, k)
    displacement x, y of crankshaft j in its bearing A, B, `meshes` (j, k) approach of the teeth, `sun` (2, k) of the
    sun; `teeth`, `bearing` (j, 2, 2, 2), `sun_spring` in N/m turn them into forces. `centers` (j, p, 2, k):
    displacement of each crankshaft's axis at the `places` (p,) m on the z axis: discs, bearings A and B, planet;
    `turns` (j, d + 1, k) its rotation at discs and planet.
    """

    names: tuple[str, ...]
    stiffness: dict[str, Array]
    bearings: Array
    meshes: Array
    sun: Array
    teeth: float
    bearing: Array
    sun_spring: float
    places: Array
    centers: Array
    turns: Array

    @property
    def total(self) -> Array:
        """Stiffness (k, k) of all parts."""
        return np.asarray(np.sum(list(self.stiffness.values()), axis=0))

    def mesh_forces(self, motion: Array) -> Array:
        """Normal force (n, j) of the teeth of each planet, N, at motions (n, k)."""
        return np.asarray(self.teeth * motion @ self.meshes.T)

    def bearing_forces(self, motion: Array) -> Array:
        """Force (n, j, 2, 2) of each crankshaft on the carrier in its bearings A and B, N."""
        moved = np.einsum("jbxk,nk->njbx", self.bearings, motion)
        return np.asarray(np.einsum("jbxy,njby->njbx", self.bearing, moved))


def material(design: Design) -> Material:
    """Return the material of all members."""
    given = design.scene.materials[design.drive.material]
    return Material(given.youngs_modulus, given.poissons_ratio, given.density)


def pressing(design: Design) -> Array:
    """Directions (j, 2) in which the sun's teeth push each planet: sun driven or loaded counter-clockwise."""
    alpha = float(design.first.pair.operating_angle)
    out = design.crank_places / design.first.arm
    across = np.stack([-out[:, 1], out[:, 0]], axis=-1)
    return math.cos(alpha) * across + math.sin(alpha) * out


def supports(design: Design, teeth: float, on_bearings: Array | None = None) -> Supports:
    """Assemble shafts, bearings, teeth (N/m along the line of action, one mesh) and sun, and condense them on the
    motions of the eccentrics.

    `on_bearings` (2, 2, 2): stiffness of the bearings A and B of a crankshaft along the line from the carrier's axis
    to it and across, N/m, where the scene gives none.
    """
    rigid = not design.scene.has("bearing_compliance")
    cranks, discs = len(design.crank_places), len(design.discs)
    table = design.drive.crankshaft
    places = [*(disc.z for disc in design.discs), *table.bearing_positions, table.planet_position]
    made = shaft(_steps(design), places, material(design))
    at = len(places)  # discs, bearing A, B, planet: x, y of each, then rotations of discs and planet
    size, twists = 2 * at + discs + 1, [*range(discs), at - 1]
    count = cranks * size + 2
    parts = {part: np.zeros((count, count)) for part in PARTS}
    centers, turns = np.zeros((cranks, at, 2, count)), np.zeros((cranks, discs + 1, count))
    meshes = np.zeros((cranks, count))
    normals, base = pressing(design), design.first.pair.second.base_radius
    held_by = _bearings(design, on_bearings, rigid)
    for j in range(cranks):
        first = j * size
        x, y = first + np.arange(at), first + at + np.arange(at)
        spin = first + 2 * at + np.arange(discs + 1)
        if not rigid:
            for line in (x, y):
                parts["crankshafts"][np.ix_(line, line)] += made.bending
            parts["crankshafts"][np.ix_(spin, spin)] += condensed(made.torsion, twists)
        centers[j, range(at), 0, x] = centers[j, range(at), 1, y] = 1.0
        turns[j, range(discs + 1), spin] = 1.0
        for b in range(2):
            one = centers[j, discs + b]
            parts["crank_bearings"] += one.T @ held_by[j, b] @ one
        meshes[j, spin[-1]] = base
        meshes[j, [x[-1], y[-1]]] = -normals[j]
        meshes[j, -2:] = normals[j]
        parts["first_stage"] += teeth * np.outer(meshes[j], meshes[j])
    held = design.drive.first_stage.sun_stiffness
    parts["sun_support"][-2, -2] = parts["sun_support"][-1, -1] = held
    names, spread = _rigid(cranks, discs, size, count) if rigid else _compliant(cranks, discs, at, count)
    k = len(names)
    whole = spread.T @ np.sum(list(parts.values()), axis=0) @ spread
    follow = -np.linalg.solve(whole[k:, k:], whole[k:, :k])
    shape = spread @ np.vstack([np.eye(k), follow])
    return Supports(
        names,
        {part: frozen(shape.T @ matrix @ shape) for part, matrix in parts.items()},
        frozen(centers[:, discs : discs + 2] @ shape),
        frozen(meshes @ shape),
        frozen(shape[-2:]),
        teeth,
        held_by,
        held,
        frozen(places),
        frozen(centers @ shape),
        frozen(turns @ shape),
    )


def _bearings(design: Design, cranks: Array | None, rigid: bool) -> Array:
    """Return the stiffness (j, 2, 2, 2) along x and y of every crankshaft in its bearings A and B, N/m."""
    count, given = len(design.crank_places), design.drive.crankshaft.bearing_stiffness
    if given is not None or rigid:  # rigid ones do not move
        return frozen(np.tile((given or HELD) * np.eye(2), (count, 2, 1, 1)))
    assert cranks is not None
    out = design.crank_places / design.first.arm
    axes = np.stack([out, np.stack([-out[:, 1], out[:, 0]], axis=-1)], axis=1)
    found = np.einsum("jax,bac,jcy->jbxy", axes, cranks, axes)
    return frozen(0.5 * (found + np.swapaxes(found, -1, -2)))


def _steps(design: Design) -> list[Step]:
    """The shaft with its eccentrics as stretches of the raceway's radius; planet and bearings sit on the shaft."""
    table, width = design.drive.crankshaft, design.drive.cycloid.face_width
    low = min(table.bearing_positions[0], table.planet_position)
    high = max(table.bearing_positions[1], table.planet_position)
    steps, at = [], low
    for disc in design.discs:
        steps.append(Step(at, disc.z - 0.5 * width, table.radius))
        at = disc.z + 0.5 * width
        steps.append(Step(at - width, at, design.race_radius))
    steps.append(Step(at, high, table.radius))
    return [step for step in steps if step.high > step.low]


def _compliant(cranks: int, discs: int, at: int, count: int) -> tuple[tuple[str, ...], Array]:
    """Motions of the eccentrics, and all coordinates from these and the others (count, count)."""
    names, kept = [], []
    size = 2 * at + discs + 1
    for j in range(cranks):
        for i in range(discs):
            first = j * size
            names += [f"crank{j}.x{i}", f"crank{j}.y{i}", f"crank{j}.rotation{i}"]
            kept += [first + i, first + at + i, first + 2 * at + i]
    rest = [i for i in range(count) if i not in set(kept)]
    return tuple(names), np.eye(count)[:, kept + rest]


def _rigid(cranks: int, discs: int, size: int, count: int) -> tuple[tuple[str, ...], Array]:
    """Rotation of each rigid crankshaft on a rigid axis; the sun alone moves sideways."""
    spread = np.zeros((count, cranks + 2))
    for j in range(cranks):
        spread[(j + 1) * size - discs - 1 : (j + 1) * size, j] = 1.0
    spread[-2:, -2:] = np.eye(2)
    return tuple(f"crank{j}.rotation" for j in range(cranks)), spread

"""How the contact of one cycloid disc converges with its mesh.

20 pins on R 80 mm, r 5, e 2.5, face width 10 mm, 200 N·m, rigid pins, the bore held, without holes and with
eight that carry nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter

import numpy as np

from benchmarks.table import Row, Table
from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.material import Material
from trochoid.fem.pair import FlankPair, Member
from trochoid.fem.position import Assembly, Contact, ElasticBody, Family, solve_positions
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.motion import khv_motions
from trochoid.kinematics.types import Array

FLANK = Cycloid(20, 19, 80e-3, 5e-3, 2.5e-3)
STEEL = Material(210e9, 0.3).plane("strain")
WIDTH, TORQUE, POSITIONS = 10e-3, 200.0, 60
LEVELS = (6, 12, 20, 40)
TARGETS = {12: 1e-3, 20: 1e-4}


@dataclass(frozen=True, slots=True)
class Turn:
    """A disc over one turn of the crank: `rotation` (n,), `stiffness` (n,), `force` (n, pins).

    `nodes` of the mesh; `setup` seconds for outline, mesh, factor and compliance, `seconds` for a position.
    """

    nodes: int
    rotation: Array
    stiffness: Array
    force: Array
    setup: float
    seconds: float


def measure() -> list[Table]:
    """Compare coarser meshes with the finest."""
    return [_convergence(holes) for holes in (0, 8)]


def _convergence(holes: int) -> Table:
    turns = {level: turn(level, holes) for level in LEVELS}
    finest = turns[LEVELS[-1]]
    rows: list[Row] = []
    for level in LEVELS:
        found, name = turns[level], f"{level} facets per lobe"
        target = None if holes else TARGETS.get(level)
        if level != LEVELS[-1]:
            rotation = np.abs(found.rotation / finest.rotation - 1).max()
            stiffness = np.abs(found.stiffness / finest.stiffness - 1).max()
            force = np.abs(found.force - finest.force).max(axis=1) / finest.force.max(axis=1)
            rows.append(Row(f"{name}: error of the rotation", float(rotation), "", target))
            rows.append(Row(f"{name}: error of the stiffness", float(stiffness), "", target))
            rows.append(Row(f"{name}: error of pin forces / the largest", float(force.max()), "", target))
        rows.append(Row(f"{name}: nodes", float(found.nodes)))
        rows.append(Row(f"{name}: set-up", found.setup, "s"))
        rows.append(Row(f"{name}: one position", 1e3 * found.seconds, "ms"))
    how = f"largest error of {POSITIONS} positions against {LEVELS[-1]} facets per lobe"
    return Table(f"convergence of a disc with {holes or 'no'} holes", how, tuple(rows))


def turn(facets: int, holes: int) -> Turn:
    """Solve a disc at all positions."""
    start = perf_counter()
    outline = disc_outline(FLANK, 25e-3, holes, 52e-3, 9e-3, 0.0, facets)
    body = build_body(mesh_outline(outline), STEEL, supports=("bore",))
    elastic = ElasticBody(press(body, [outline.outer]), WIDTH)
    built = perf_counter()
    found = positions(elastic, 2 * np.pi * np.arange(POSITIONS) / POSITIONS)
    return Turn(
        len(body.mesh.points),
        found.motion[:, 0],
        found.stiffness[:, 0, 0],
        found.touches["pins"].force,
        built - start,
        (perf_counter() - built) / POSITIONS,
    )


def positions(elastic: ElasticBody, crank: Array, resolve: bool = False) -> Contact:
    """Solve the disc at crank angles (n,) side by side: it turns, the ring with its pins stands still."""
    pose = khv_motions(FLANK, crank)["disc0"]
    disc = Member(pose.center, pose.rotation, np.array([[0.0], [0.0], [1.0]]))
    ring = Member(np.zeros(2), 0.0, np.zeros((3, 1)))
    pair = FlankPair.nominal(disc, ring, FLANK, crank, elastic.compliance.surfaces["flank"])
    family = Family("pins", pair, np.full(FLANK.pins, STEEL.kernel / WIDTH), np.zeros(FLANK.pins))
    load = np.full((len(crank), 1), TORQUE)
    return solve_positions(Assembly((family,), (elastic,), np.zeros((1, 1)), load), resolve)

"""How fast positions are solved: one disc at all crank angles of a turn, with one force per contact and with strips.

Targets are for processor time on one thread: on a machine that does nothing else, wall time is the same.
"""

from __future__ import annotations

from time import perf_counter, process_time

import numpy as np

from benchmarks.disc import FLANK, STEEL, WIDTH, positions
from benchmarks.table import Row, Table
from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.position import ElasticBody
from trochoid.fem.strips import STRIPS
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.kinematics.types import Array

POSITIONS, HOLES, FACETS, REPEATS = 600, 8, 12, 3
POSITION, COLD = 3.0, 5.0  # ms, s


def measure() -> list[Table]:
    """Time the set-up and 600 positions of the disc with eight holes."""
    cold = {name: _cold(resolve) for name, resolve in (("one force per contact", False), ("strips", True))}
    elastic, angles = _disc(), np.arange(POSITIONS) * 2 * np.pi / POSITIONS
    rows = []
    for name, resolve in (
        ("one force per contact", False),
        (f"{FLANK.pins} contacts × {STRIPS} strips", True),
    ):
        wall, processor = _best(elastic, angles, resolve)
        rows.append(Row(f"one position, {name}", 1e3 * processor, "ms", POSITION))
        rows.append(Row("the same, wall time", 1e3 * wall, "ms"))
    for name, (wall, processor) in cold.items():
        rows.append(Row(f"cold: mesh, set-up and {POSITIONS} positions, {name}", processor, "s", COLD))
        rows.append(Row("the same, wall time", wall, "s"))
    how = f"disc with {HOLES} holes, {FACETS} facets per lobe, no friction, one thread; positions: best of {REPEATS}"
    return [Table("speed of positions", how, tuple(rows))]


def _disc() -> ElasticBody:
    outline = disc_outline(FLANK, 25e-3, HOLES, 52e-3, 9e-3, 0.0, FACETS)
    body = build_body(mesh_outline(outline), STEEL, ("bore",))
    return ElasticBody(press(body, [outline.outer]), WIDTH)


def _cold(resolve: bool) -> tuple[float, float]:
    """Return wall and processor seconds of everything."""
    start = perf_counter(), process_time()
    positions(_disc(), np.arange(POSITIONS) * 2 * np.pi / POSITIONS, resolve)
    return perf_counter() - start[0], process_time() - start[1]


def _best(elastic: ElasticBody, angles: Array, resolve: bool) -> tuple[float, float]:
    """Return wall and processor seconds of a position, each the least of several turns."""
    wall, processor = [], []
    for _ in range(REPEATS):
        start = perf_counter(), process_time()
        positions(elastic, angles, resolve)
        wall.append(perf_counter() - start[0])
        processor.append(process_time() - start[1])
    return min(wall) / len(angles), min(processor) / len(angles)

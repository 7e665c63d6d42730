"""One position of the disc as a CalculiX job: deck, run, and what it says of moment and pin forces.

Plane strain, quadratic triangles refined at all contacts (`trochoid.geometry`), face-to-face penalty contact with arcs
of the pins, all of whose nodes are held: the pins are rigid. The nodes of the bore are turned by a given angle.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from benchmarks.disc import FLANK, WIDTH
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Loop, Outline, graded_breaks
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.motion import khv_motions
from trochoid.kinematics.types import Array

LIMIT = 120.0  # s, of one run
FINEST, COARSEST, SLOPE, REFINED = (
    20e-6,
    1.2e-3,
    0.3,
    0.12e-3,
)  # facets, m: length at contacts, elsewhere, growth, within
BORE, BORE_FACETS = 25e-3, 72
ARC, ARC_FACETS, DEPTH = (
    0.3,
    24,
    0.3,
)  # of a pin: half length and thickness of the rigid arc, mm, and its facets
NEAR = 0.25  # mm from the contact: flank facets that may touch


@dataclass(frozen=True, slots=True)
class Solved:
    """What a run gives: `moment` on the bore in N·m, pin forces `force` (pins,) in N, `nodes` of the disc, and wall and
    processor seconds for mesh, deck and run.
    """

    moment: float
    force: Array
    nodes: int
    wall: float
    processor: float


def solve(crank: float, turn: float, penalty: float) -> Solved:
    """Turn the bore by `turn` rad at a crank angle, with a penalty in N/mm³.

    Raises TimeoutExpired, or CalledProcessError when it does not converge.
    """
    start, busy = perf_counter(), _processor()
    contact = FLANK.contact_parameter(np.arange(FLANK.pins), crank)
    flank = Loop("flank", FLANK, breaks=graded_breaks(FLANK, contact, FINEST, COARSEST, SLOPE, REFINED))
    bore = Loop("bore", Circle((0.0, 0.0), BORE, hole=True), BORE_FACETS)
    mesh = mesh_outline(Outline(flank, (bore,)))
    deck = "\n".join(_deck(mesh, _pins(crank), 1e3 * FLANK.point(contact), turn, penalty))
    with tempfile.TemporaryDirectory() as folder:
        job = Path(folder, "job.inp")
        job.write_text(deck + "\n")
        one = {**os.environ, "OMP_NUM_THREADS": "1"}
        subprocess.run(["ccx", "job"], cwd=folder, env=one, capture_output=True, timeout=LIMIT, check=True)
        said = job.with_suffix(".dat").read_text()
    return Solved(
        _moment(mesh, said), _forces(said), len(mesh.points), perf_counter() - start, _processor() - busy
    )


def _processor() -> float:
    """Return the processor seconds of this process and of those that it has ended."""
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    return process_time() + ended.ru_utime + ended.ru_stime


def _pins(crank: float) -> Array:
    """Return the pins' centres (pins, 2) in mm in the disc's frame."""
    pose = khv_motions(FLANK, crank)["disc0"]
    c, s = np.cos(pose.rotation[0]), np.sin(pose.rotation[0])
    ring = Circle((0.0, 0.0), FLANK.pin_circle_radius).point(2 * np.pi * np.arange(FLANK.pins) / FLANK.pins)
    return np.asarray(1e3 * (ring - pose.center[0]) @ np.array([[c, -s], [s, c]]))


def _deck(mesh: Mesh, pins: Array, contact: Array, turn: float, penalty: float) -> Iterator[str]:
    yield "*NODE, NSET=DISC"
    yield from _nodes(1, 1e3 * mesh.points)
    yield "*ELEMENT, TYPE=CPE6, ELSET=DISC"
    yield from _lines(np.column_stack([1 + np.arange(mesh.triangles.shape[1]), mesh.triangles.T + 1]))
    node, element = 1 + len(mesh.points), 1 + mesh.triangles.shape[1]
    for pin, (center, point) in enumerate(zip(pins, contact, strict=True)):
        yield from _arc(pin, center, point, node, element)
        yield from _slave(mesh, pin, point)
        node, element = node + 5 * ARC_FACETS + 3, element + ARC_FACETS
    yield "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000, 0.3"
    for part in ("DISC", *(f"PIN{pin}" for pin in range(len(pins)))):
        yield f"*SOLID SECTION, ELSET={part}, MATERIAL=STEEL\n{1e3 * WIDTH:g}"
    yield "*SURFACE INTERACTION, NAME=HARD\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR"
    yield f"{penalty:g}"
    for pin in range(len(pins)):
        yield "*CONTACT PAIR, INTERACTION=HARD, TYPE=SURFACE TO SURFACE"
        yield f"SLAVE{pin}, MASTER{pin}"
    bore = np.unique(mesh.edges["bore"])
    yield "*NSET, NSET=BORE"
    yield from (f"{node + 1}," for node in bore)
    yield "*STEP, INC=100\n*STATIC\n1, 1\n*BOUNDARY"
    yield from (f"PIN{pin}, 1, 2" for pin in range(len(pins)))
    c, s = np.cos(turn) - 1.0, np.sin(turn)
    for node, (x, y) in zip(bore, 1e3 * mesh.points[bore], strict=True):
        yield f"{node + 1}, 1, 1, {c * x - s * y:.13g}\n{node + 1}, 2, 2, {s * x + c * y:.13g}"
    yield from (f"*NODE PRINT, NSET=PIN{pin}, TOTALS=ONLY\nRF" for pin in range(len(pins)))
    yield "*NODE PRINT, NSET=BORE\nRF\n*END STEP"


def _arc(pin: int, center: Array, point: Array, node: int, element: int) -> Iterator[str]:
    """One layer of eight-node quadrilaterals below the pin's surface, round its contact point."""
    toward, radius, n = point - center, 1e3 * FLANK.pin_radius, ARC_FACETS
    angle = np.arctan2(toward[1], toward[0]) + np.linspace(-ARC, ARC, 2 * n + 1) / radius
    ray = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    rows = radius * ray, (radius - DEPTH) * ray, (radius - 0.5 * DEPTH) * ray[::2]
    yield f"*NODE, NSET=PIN{pin}"
    yield from _nodes(node, center + np.concatenate(rows))
    yield f"*ELEMENT, TYPE=CPE8, ELSET=PIN{pin}"
    outer, inner, middle = node, node + 2 * n + 1, node + 4 * n + 2
    first = np.array([0, inner, outer, outer + 2, inner + 2, middle, outer + 1, middle + 1, inner + 1])
    step = np.array([1, 2, 2, 2, 2, 1, 2, 1, 2])
    first[0] = element
    yield from _lines(first + np.arange(n)[:, None] * step)
    yield f"*SURFACE, NAME=MASTER{pin}"
    yield from (f"{element + i}, S2" for i in range(n))


def _slave(mesh: Mesh, pin: int, point: Array) -> Iterator[str]:
    middle = mesh.edges["flank"][2]
    near = middle[np.linalg.norm(1e3 * mesh.points[middle] - point, axis=1) < NEAR]
    side, element = np.nonzero(np.isin(mesh.triangles[3:], near))
    yield f"*SURFACE, NAME=SLAVE{pin}"
    yield from (f"{e + 1}, S{s + 1}" for s, e in zip(side, element, strict=True))


def _nodes(first: int, points: Array) -> Iterator[str]:
    return (f"{first + i}, {x:.13g}, {y:.13g}, 0" for i, (x, y) in enumerate(points))


def _lines(rows: Iterable[Iterable[object]]) -> Iterator[str]:
    return (", ".join(map(str, row)) for row in rows)


def _forces(said: str) -> Array:
    found = re.findall(r"for set PIN\d+ .*\s+(\S+)\s+(\S+)\s+\S+", said)
    return np.asarray(np.hypot(*np.array(found, dtype=np.float64).T))


def _moment(mesh: Mesh, said: str) -> float:
    """Return the moment of the bore's reactions about the disc's centre."""
    table = re.search(r"for set BORE .*\n\s*\n((?:\s*\d+\s+\S+\s+\S+\s+\S+\n)+)", said)
    if table is None:
        raise ValueError("CalculiX printed no reactions of the bore")
    node, fx, fy, _ = np.array([line.split() for line in table[1].splitlines()], dtype=np.float64).T
    x, y = mesh.points[node.astype(int) - 1].T
    return float(x @ fy - y @ fx)

"""How time and memory of a body's set-up grow with its mesh, with each sparse solver that is installed.

The disc of `disc`, pressed at every facet of its flank. One process measures one mesh with one solver, so that its peak
memory is its own; processor time, because other programs may run.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from dataclasses import dataclass
from time import process_time

import numpy as np

from benchmarks.table import Row, Table
from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.linear_solver import installed
from trochoid.fem.material import Material
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.kinematics.cycloid import Cycloid

FLANK = Cycloid(20, 19, 80e-3, 5e-3, 2.5e-3)
STEEL = Material(210e9, 0.3).plane("strain")
LEVELS = (8, 16, 32, 64, 120)  # facets per lobe; the last has more than 100 000 degrees of freedom
ENOUGH, REPEATS = 30_000, 2  # smaller meshes are measured so often, the best counts
EXPONENT, MEMORY = 1.3, 1024.0
STAGES = {"mesh": "outline and mesh", "body": "assembly and factor", "press": "pressed at all stations"}


@dataclass(frozen=True, slots=True)
class Used:
    """Degrees of freedom, stations, seconds of the stages and peak memory in MiB of one process."""

    freedoms: int
    stations: int
    seconds: dict[str, float]
    memory: float

    @property
    def total(self) -> float:
        """Seconds of all stages."""
        return sum(self.seconds.values())


def measure() -> list[Table]:
    """Fit the exponents of growth."""
    return [_growth(solver) for solver in installed()]


def _growth(solver: str) -> Table:
    used = [_process(level, solver) for level in LEVELS]
    last = used[-1]
    rows = [Row(f"{u.freedoms} degrees of freedom, {u.stations} stations", u.total, "s") for u in used]
    for stage, name in STAGES.items():
        rows.append(Row(f"{name}: exponent", _exponent(used, [u.seconds[stage] for u in used])))
        rows.append(Row(f"{name}: the finest mesh", last.seconds[stage], "s"))
    rows.append(Row("set-up: exponent", _exponent(used, [u.total for u in used]), "", EXPONENT))
    rows.append(Row("peak memory with the finest mesh", last.memory, "MiB", MEMORY))
    how = f"processor time; exponent of the degrees of freedom, fitted to {LEVELS} facets per lobe"
    return Table(f"growth of the set-up with {solver}", how, tuple(rows))


def _exponent(used: list[Used], seconds: list[float]) -> float:
    return float(np.polyfit(np.log([u.freedoms for u in used]), np.log(seconds), 1)[0])


def _process(level: int, solver: str) -> Used:
    command = [sys.executable, "-m", "benchmarks.scaling", str(level), solver]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return Used(**json.loads(done.stdout))


def _main(level: int, solver: str) -> None:
    _stages(2, solver)  # loads what is loaded late, and counts neither in time nor in memory
    tries = [_stages(level, solver)]
    if tries[0][0] < ENOUGH:
        tries += [_stages(level, solver) for _ in range(REPEATS)]
    seconds = {stage: min(t[2][stage] for t in tries) for stage in STAGES}
    unit = 2**20 if sys.platform == "darwin" else 2**10  # of ru_maxrss, in bytes there and KiB elsewhere
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit
    print(json.dumps({"freedoms": tries[0][0], "stations": tries[0][1], "seconds": seconds, "memory": peak}))


def _stages(level: int, solver: str) -> tuple[int, int, dict[str, float]]:
    """Build one body and return its degrees of freedom, stations and seconds."""
    start = process_time()
    outline = disc_outline(FLANK, 25e-3, 0, 52e-3, 9e-3, 0.0, level)
    mesh = mesh_outline(outline)
    meshed = process_time()
    body = build_body(mesh, STEEL, ("bore",), solver)
    built = process_time()
    compliance = press(body, [outline.outer])
    pressed = process_time()
    seconds = {"mesh": meshed - start, "body": built - meshed, "press": pressed - built}
    return body.size, len(compliance.diagonal), seconds


if __name__ == "__main__":
    _main(int(sys.argv[1]), sys.argv[2])

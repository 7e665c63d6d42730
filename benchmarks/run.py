"""The whole program on the shipped example: wall time, peak memory, what one more position costs."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from benchmarks.table import Row, Table

SCENE = Path(__file__).parents[1] / "examples" / "cycloid.toml"
REPEATS = 3
FEW, MANY = 60, 120  # positions


@dataclass(frozen=True, slots=True)
class Used:
    """What a process took: wall and processor seconds, peak memory in MiB, and what it says of its stages."""

    wall: float
    processor: float
    memory: float
    stages: dict[str, float]


def measure() -> list[Table]:
    """Run the command line as a user does."""
    asked = [run("--ask", "ratio") for _ in range(REPEATS)]
    few, many = [], []
    for _ in range(REPEATS):  # in turns: what else the machine does then meets both alike
        few.append(run("--set", f"ask.positions={FEW}"))
        many.append(run("--set", f"ask.positions={MANY}"))
    busy = min(u.processor for u in few)
    more = (min(u.processor for u in many) - busy) / (MANY - FEW)
    contact = min(u.stages["contact"] for u in few) / (2 * (FEW + 1))
    rows = (
        Row(f"all answers, {FEW} positions", min(u.wall for u in few), "s", 10.0),
        Row("the same, processor time", busy, "s"),
        Row("peak memory", max(u.memory for u in few), "MiB", 1024.0),
        Row("one more position on two mesh levels, processor time", 1e3 * more, "ms", 15.0),
        Row("contacts of one position on one mesh level", 1e3 * contact, "ms"),
        Row("--ask ratio", min(u.wall for u in asked), "s", 0.5),
        Row("the same, processor time", min(u.processor for u in asked), "s"),
    )
    how = f"tolerance 1e-2, files and report written, best of {REPEATS} processes"
    return [Table("trochoid run examples/cycloid.toml", how, rows)]


def run(*options: str) -> Used:
    """Run the example in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        words = ["run", str(SCENE), "--set", "accuracy.tolerance=1e-2", "--out", folder, *options]
        start = perf_counter()
        process = subprocess.Popen([sys.executable, "-m", "trochoid", *words], stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        wall = perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"trochoid {' '.join(words)} ended with exit code {process.returncode}")
        stages = json.loads((Path(folder) / "results.json").read_text())["stages"]
    seconds = {stage["name"]: stage["seconds"] for stage in stages}
    unit = 2**20 if sys.platform == "darwin" else 2**10  # of ru_maxrss, in bytes there and KiB elsewhere
    return Used(wall, used.ru_utime + used.ru_stime, used.ru_maxrss / unit, seconds)

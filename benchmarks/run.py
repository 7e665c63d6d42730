"""The whole program on the shipped example: wall time, peak memory, what one more position costs."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter

from benchmarks.table import Row, Table

SCENE = Path(__file__).parents[1] / "examples" / "cycloid.toml"
REPEATS = 3
FEW, MANY = 60, 180  # positions


def measure() -> list[Table]:
    """Run the command line as a user does."""
    asked = [run("--ask", "ratio") for _ in range(REPEATS)]
    few = [run("--set", f"ask.positions={FEW}") for _ in range(REPEATS)]
    many = [run("--set", f"ask.positions={MANY}") for _ in range(REPEATS)]
    seconds, memory = min(s for s, _ in few), max(m for _, m in few)
    more = (min(s for s, _ in many) - seconds) / (MANY - FEW)
    rows = (
        Row(f"all answers, {FEW} positions", seconds, "s", 10.0),
        Row("peak memory", memory, "MiB", 1024.0),
        Row("one more position, on two mesh levels", 1e3 * more, "ms", 15.0),
        Row("--ask ratio", min(s for s, _ in asked), "s", 0.5),
    )
    how = f"tolerance 1e-2, files and report written, wall time of the process, best of {REPEATS}"
    return [Table("trochoid run examples/cycloid.toml", how, rows)]


def run(*options: str) -> tuple[float, float]:
    """Run the example in a process of its own; return wall seconds and peak memory in MiB."""
    with tempfile.TemporaryDirectory() as folder:
        words = ["run", str(SCENE), "--set", "accuracy.tolerance=1e-2", "--out", folder, *options]
        start = perf_counter()
        process = subprocess.Popen([sys.executable, "-m", "trochoid", *words], stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        seconds = perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise SystemExit(f"trochoid {' '.join(words)} ended with exit code {process.returncode}")
    unit = 2**20 if sys.platform == "darwin" else 2**10  # of ru_maxrss, in bytes there and KiB elsewhere
    return seconds, used.ru_maxrss / unit

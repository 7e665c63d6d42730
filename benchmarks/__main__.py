"""python -m benchmarks [--json] [run disc estimate ...]: measure all or some, beside their targets."""

from __future__ import annotations

import argparse
import importlib
import json

from benchmarks.table import Table, plain, summary, text
from trochoid.console import one_thread

# in this order: the peak memory of a child process counts what its parent has loaded, so "run" comes first
ALL = ("run", "disc", "estimate", "closed_forms")


def main() -> None:
    """Measure and print; each benchmark is a module with a function `measure`."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Measured numbers and targets.")
    parser.add_argument("names", nargs="*", help=f"any of {', '.join(ALL)} (default: all)")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    asked = parser.parse_args()
    unknown = set(asked.names) - set(ALL)
    if unknown:
        parser.error(f"no benchmark {', '.join(sorted(unknown))}; there are {', '.join(ALL)}")
    one_thread()
    tables: list[Table] = []
    for name in [name for name in ALL if name in asked.names or not asked.names]:
        for table in importlib.import_module(f"benchmarks.{name}").measure():
            tables.append(table)
            if not asked.json:
                print(text(table), end="\n\n", flush=True)
    print(json.dumps([plain(table) for table in tables], indent=2) if asked.json else summary(tables))


if __name__ == "__main__":
    main()

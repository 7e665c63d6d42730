"""python -m benchmarks [--json] [--quick] [run disc ...]: measure all or some, beside their targets."""

from __future__ import annotations

import argparse
import importlib
import json

from benchmarks.table import Table, plain, summary, text
from trochoid.console import one_thread

# in this order: the peak memory of a child process counts what its parent has loaded, so "run" and "scaling" come first
ALL = ("run", "scaling", "disc", "gear", "speed", "dynamics", "estimate", "closed_forms", "cone", "calculix")
LONG = ("choice", "effects")  # many minutes: measured only when named; `--quick` takes fewer cases


def main() -> None:
    """Measure and print; each benchmark is a module with a function `measure`."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description="Measured numbers and targets.")
    parser.add_argument("names", nargs="*", help=f"any of {', '.join(ALL)} (default: all), {', '.join(LONG)}")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    parser.add_argument("--quick", action="store_true", help=f"fewer cases of {', '.join(LONG)}")
    asked = parser.parse_args()
    unknown = set(asked.names) - {*ALL, *LONG}
    if unknown:
        parser.error(f"no benchmark {', '.join(sorted(unknown))}; there are {', '.join((*ALL, *LONG))}")
    one_thread()
    tables: list[Table] = []
    wanted = [name for name in (*ALL, *LONG) if name in asked.names or (name in ALL and not asked.names)]
    for name in wanted:
        module = importlib.import_module(f"benchmarks.{name}")
        for table in module.measure(asked.quick) if name in LONG else module.measure():
            tables.append(table)
            if not asked.json:
                print(text(table), end="\n\n", flush=True)
    print(json.dumps([plain(table) for table in tables], indent=2) if asked.json else summary(tables))


if __name__ == "__main__":
    main()

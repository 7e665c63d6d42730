"""What each effect costs: runs of the shipped scenes with and without it, in pairs, as ratios of processor time.

Both runs of a pair ask the same questions, those that have an answer without the effect. A pair of equal runs shows how
far ratios are from chance. Effects that are listed, and that no answer asks for, must cost nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from time import process_time

import numpy as np

from benchmarks.table import Row, Table
from trochoid.run import Run
from trochoid.scene import load
from trochoid.scene.needs import NEEDS

EXAMPLES = Path(__file__).parents[1] / "examples"
SCENES = {"khv": "cycloid"} | {kind: kind for kind in NEEDS if kind != "khv"}
PAIRS, FEW = 3, 1
SHORT = 15  # times as many pairs of runs that take milliseconds
NOTHING = 1.1  # a ratio that is one as far as a machine with other work to do can tell
# coarse meshes and one model, so that what is chosen does not depend on the effect
COARSE = {
    "khv": ("ask.positions=12", "accuracy.facets_per_lobe=8", "accuracy.model=level0"),
    "rv": ("ask.positions=2", "accuracy.facets_per_lobe=12", "accuracy.model=level0"),
    "planetary": ("ask.positions=12", "accuracy.facets_per_lobe=12", "accuracy.model=level0"),
    "precessional": ("ask.positions=12",),
    "indexer": ("ask.positions=12",),
}


def measure(quick: bool = False) -> list[Table]:
    """Time all effects of all scenes; `quick`: fewer pairs of them."""
    return [_table(kind, FEW if quick else PAIRS) for kind in SCENES]


def _table(kind: str, pairs: int) -> Table:
    path = EXAMPLES / f"{SCENES[kind]}.toml"
    given = load(path)
    every, asked, one = tuple(effect.type for effect in given.effects), given.ask.quantities, ("ratio",)
    _seconds(kind, every, asked)  # loads libraries
    rows = [
        Row("a scene beside itself", _ratio(kind, (every, every), asked, pairs), ""),
        Row(
            "all effects beside none, asked for the ratio",
            _ratio(kind, (every, ()), one, SHORT * pairs),
            "",
            NOTHING,
        ),
    ]
    for name in every:
        rest = tuple(x for x in every if x != name)
        possible = tuple(q for q in asked if set(NEEDS[kind][q]) <= set(rest))
        rows.append(Row(f"with {name} beside without", _ratio(kind, (every, rest), possible, pairs), ""))
    how = f"ratio of processor times, median of {pairs} pairs in turns; coarse mesh, same questions"
    return Table(f"effects of examples/{SCENES[kind]}.toml", how, tuple(rows))


def _ratio(kind: str, both: tuple[Sequence[str], Sequence[str]], asked: Sequence[str], pairs: int) -> float:
    """Return how many times as long the first effects take as the second."""
    found = [[_seconds(kind, effects, asked) for effects in both] for _ in range(pairs)]
    return float(np.median([one / other for one, other in found]))


def _seconds(kind: str, effects: Sequence[str], asked: Sequence[str]) -> float:
    """Return processor seconds of a run from the scene's file to the figures of the report."""
    wanted = "ask.quantities=[" + ",".join(f'"{name}"' for name in asked) + "]"
    start = process_time()
    scene = load(EXAMPLES / f"{SCENES[kind]}.toml", (wanted, *COARSE[kind]))
    scene = scene.model_copy(update={"effects": tuple(x for x in scene.effects if x.type in effects)})
    _ = Run(scene).outcome
    return process_time() - start

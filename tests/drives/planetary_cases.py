"""A small set with three planets, quick to mesh, and its contacts on one mesh level."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

import numpy as np

from trochoid.clock import Clock
from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.contact import angles
from trochoid.drives.planetary.series import Series, solve_series
from trochoid.drives.planetary.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.scene import read

EXAMPLE = Path(__file__).parents[2] / "examples" / "planetary.toml"
LEAN = (
    r"^(x_planet|x_ring|roller_diameter|bore_radius|outer_radius|position_errors|tip_relief|held"
    r"|bearing_stiffness|torsional_stiffness|misalignment|crown) = .*\n|^\[drive\.lead.*\n"
    r"|^\[drive\.planet\.bearing\]\n(?:\w+ = .*\n)+"
    r'|^    "(bearing_stiffness|bearing_life|natural_frequencies|vibration_velocity|vibration_zone)",\n'
)
SMALL = {"z_sun": 18, "z_planet": 18, "z_ring": 54, "planets": 3, "center_distance": 37, "x_sun": 0.25}
PHASED = SMALL | {"z_sun": 19, "z_planet": 17, "z_ring": 53}
ELASTIC, FLOATING, ERRORS, RELIEF, INERTIA = (
    f'{{type="{name}"}}'
    for name in ("elastic_contact", "bearing_compliance", "position_errors", "clearance", "inertia")
)


def text(teeth: dict[str, float]) -> str:
    """The example with other teeth, and nothing given that has a default; the cutter's tips are rounded."""
    changed = EXAMPLE.read_text(encoding="utf-8")
    for key, value in teeth.items():
        changed = re.sub(rf"^{key} = .*$", f"{key} = {value}", changed, flags=re.M)
    changed = re.sub(LEAN, "", changed, flags=re.M)
    changed = changed.replace("z = 25\nx = 0.15", "z = 20\nx = 0.1\ntip_rounding = 0.3")
    return changed.replace("output_torque = 600", "output_torque = 200")


def stages_of(*overrides: str, effects: tuple[str, ...] = (ELASTIC,), phased: bool = False) -> Stages:
    """Stages of the small set, in which nothing has run."""
    listed = f"effects=[{','.join(effects)}]"
    if ELASTIC not in effects:
        overrides = ('ask.quantities=["contact_ratio"]', *overrides)
    return Stages(read(text(PHASED if phased else SMALL), [listed, *overrides]), Clock())


@lru_cache(maxsize=4)
def level_of(held: str = "edge", relief: float = 0.0, phased: bool = False) -> Level:
    """The small set's wheels with six facets per flank; nothing but these changes them."""
    made = stages_of(
        f'drive.ring.held="{held}"',
        *(f"drive.{wheel}.tip_relief={relief}" for wheel in ("sun", "planet", "ring")),
        effects=(ELASTIC, RELIEF),
        phased=phased,
    )
    return made.level(6)


def series_of(
    *overrides: str,
    effects: tuple[str, ...] = (ELASTIC,),
    positions: int = 6,
    rung: str = "level0",
    held: str = "edge",
    relief: float = 0.0,
    phased: bool = False,
    at: Array | None = None,
) -> tuple[Stages, Series]:
    """Solve a variant of the small set over a pitch, on wheels made before."""
    s = stages_of(f'drive.ring.held="{held}"', *overrides, effects=effects, phased=phased)
    angle = angles(s.feasible, s.speeds, positions) if at is None else np.asarray(at)
    return s, solve_series(s.feasible, s.speeds, level_of(held, relief, phased), s.load, angle, rung)

"""Random scenes of K-H-V drives as plain tables: ones that can be built, by construction."""

from __future__ import annotations

import math
from copy import deepcopy
from typing import Any, TypeAlias

import numpy as np

from trochoid.kinematics.cycloid import Cycloid
from trochoid.scene import NEEDS, Override, read
from trochoid.scene.drive_khv import KhvScene
from trochoid.scene.needs import UNDER_TORQUE

Tables: TypeAlias = dict[str, Any]
RIGID = ("clearance", "pin_compliance", "inertia", "bearing_compliance", "casing_on_mounts")
INCH = 25.4


def scene_of(raw: Tables) -> KhvScene:
    """Return the scene that tables describe; raises what a file with them raises."""
    return read("", [Override((name,), value, name) for name, value in raw.items()])


def written(rng: np.random.Generator, mm: float) -> float | str:
    """Return a length as a user may write it: a bare number, or with a unit."""
    length = float(mm)
    units = {"": 1.0, "mm": 1.0, "m": 1e3, "um": 1e-3, "cm": 10.0, "in": INCH}
    unit = str(rng.choice(list(units)))
    return f"{length / units[unit]!r} {unit}" if unit else length


def drawn(
    rng: np.random.Generator, pins: int = 30, floating: bool | None = None, elastic: bool = False
) -> Tables:
    """Return a random drive that can be built: size, plays, numbers of pins, discs, holes, rollers, effects, questions.

    `floating` demands or excludes compliant bearings.
    """
    while True:
        found = _tables(rng, pins, floating, elastic)
        if found is not None:
            return found


def other_load(rng: np.random.Generator, raw: Tables) -> Tables:
    """Return the same drive under another torque, in a looser or tighter bearing."""
    found = deepcopy(raw)
    found["operation"]["output_torque"] *= float(10 ** rng.uniform(-2, 1))
    found["drive"]["eccentric_bearing"]["clearance"] = 0.0
    return found


def _tables(rng: np.random.Generator, most: int, floating: bool | None, elastic: bool) -> Tables | None:
    between, pick = rng.uniform, rng.choice
    pins = int(rng.integers(5, most + 1))
    big = 10 ** between(1, 3)  # mm
    e = between(0.4, 0.85) * big / pins
    undercut = Cycloid(pins, pins - 1, big, 1e-6 * big, e).undercut_radius
    pin = between(0.3, 0.85) * min(undercut, big * math.sin(math.pi / pins))
    root = big - e - pin
    bore = between(0.3, 0.45) * root
    circle, holes = 0.5 * (bore + root), int(rng.integers(3, 13))
    hole = between(0.4, 0.75) * min(0.5 * (root - bore), circle * math.sin(math.pi / holes))
    play = float(pick([0.0, 1e-5, 1e-4])) * big
    if hole - e - play < 0.01 * big:
        return None
    rollers = int(rng.integers(4, 25))
    pitch = math.sin(math.pi / rollers)
    needle = between(0.5, 0.9) * min(0.3 * (bore - e), bore * pitch / (1 + pitch))
    clearance = float(pick([0.0, 1e-4])) * bore
    race = bore - 2 * needle - clearance
    width = between(0.05, 0.3) * big
    load = (width / 10) * (big / 80) ** 2  # torques that load the drive as much as the example's
    effects = [name for name in RIGID if rng.random() < 0.4 and name != "bearing_compliance"]
    if floating or (floating is None and rng.random() < 0.3):
        effects.append("bearing_compliance")
    if elastic:
        effects.append("elastic_contact")
    stiff = 1e9 * (width / 10) * 10 ** between(-1, 1)  # N/m
    drive: Tables = {
        "type": "khv",
        "pins": pins,
        "pin_circle_radius": written(rng, big),
        "pin_radius": written(rng, pin),
        "eccentricity": written(rng, e),
        "discs": int(pick([1, 2, 3], p=[0.5, 0.4, 0.1])),
        "face_width": written(rng, width),
        "disc_gap": written(rng, between(0.01, 0.2) * width),
        "bore_radius": written(rng, bore),
        "fixed": str(pick(["ring", "output"])),
        "output_pins": {
            "count": holes,
            "circle_radius": written(rng, circle),
            "roller_radius": written(rng, hole - e - play),
            "hole_clearance": written(rng, play),
            "phase": float(between(0, 360)),
        },
        "eccentric_bearing": {
            "rollers": rollers,
            "roller_radius": written(rng, needle),
            "roller_length": written(rng, between(0.5, 0.99) * width),
            "clearance": written(rng, clearance),
        },
        "modification": {
            "equidistant": written(rng, float(pick([0.0, 2e-5, 2e-4])) * big),
            "radial": written(rng, float(pick([0.0, -2e-5])) * big),
            "rotation": float(pick([0.0, 1e-3])),
        },
        "ring": {"outer_radius": written(rng, 1.3 * (big + pin)), "width": written(rng, 3 * width)},
        "input_shaft": {
            "radius": written(rng, between(0.5, 0.9) * (race - e)),
            "length": written(rng, 8 * width),
            "bearing_positions": [written(rng, -2.5 * width), written(rng, between(2, 4) * width)],
            "bearing_stiffness": f"{stiff!r} N/m",
        },
        "output_flange": {
            "outer_radius": written(rng, circle),
            "thickness": written(rng, width),
            "bearing_positions": [written(rng, 3 * width), written(rng, between(4, 6) * width)],
            "bearing_stiffness": f"{2 * stiff!r} N/m",
        },
    }
    for key, value in (
        ("lobes", pins - 1),
        ("material", "steel"),
        ("plane", str(pick(["strain", "stress"]))),
    ):
        if rng.random() < 0.5:  # else the default
            drive[key] = value
    if rng.random() < 0.3:
        drive["pin_clearance"] = written(rng, 1e-5 * big)
    torque = float(10 ** between(1, 3) * load) if rng.random() < 0.98 else 0.0
    answers = [name for name, needs in NEEDS["khv"].items() if set(needs) <= set(effects)]
    answers = [name for name in answers if torque > 0 or name not in UNDER_TORQUE]
    return {
        "drive": drive,
        "operation": {
            "input_speed": float(10 ** between(2, 3.5) * min(1.0, 80 / big)),
            "output_torque": torque,
            "damping_ratio": float(between(0.005, 0.1)),
        },
        "casing": {
            "mass": 10.0,
            "inertia": [0.06, 0.06, 0.08],
            "mounts": [{"position": [0, 0, 0], "stiffness": [5000, 8000, 5000]}],
        },
        "effects": [{"type": name} for name in rng.permutation(effects).tolist()],
        "ask": {
            "quantities": rng.permutation(answers)[: int(rng.integers(1, 6))].tolist(),
            "positions": int(rng.integers(1, 100)),
        },
        "accuracy": {"tolerance": float(10 ** between(-4, -1))},
    }

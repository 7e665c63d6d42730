"""Answers from the motion of the wheel, the spherical Geneva wheel's beside each."""

from __future__ import annotations

import math

from trochoid.drives.exact import RPM
from trochoid.drives.indexer.design import GENEVA, INDEXER
from trochoid.drives.indexer.measures import Measured
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.words import FAULT_WORDS
from trochoid.kinematics.indexer_measure import dwell_within, similarity
from trochoid.kinematics.indexer_synthesis import Solution
from trochoid.results.outcome import Parts, Quantity


def ratio(s: Stages) -> Quantity:
    """Mean ratio: turns of the arm for one turn of the wheel; without sign, as the shafts cross."""
    made = s.design
    note = "mean: the wheel turns in steps" + (
        "" if made.closes else "; no whole number of swings makes a turn"
    )
    return Quantity(2.0 * math.pi / made.drive.swing_angle, "", 0.0, "exact", note=note)


def member_speeds(s: Stages) -> Quantity:
    """Speeds of arm and planet, mean and peak speed of the wheel and of the Geneva wheel in its place."""
    made, path = s.design, s.design.indexer.path
    arm, m = made.speed / RPM, path.ratio
    mean = made.turns * made.drive.swing_angle / (2.0 * math.pi) * arm
    values = {
        "arm": arm,
        "planet_on_arm": m * arm,
        "planet": math.sqrt(1.0 + m * m + 2.0 * m * math.cos(path.arm)) * arm,
        "wheel_mean_speed": mean,
    }
    for name, found in s.measured.items():
        key = "wheel_peak_speed" if name == INDEXER else f"{name}_peak_speed"
        values[key] = -found.indexer.sense * found.peaks.velocity * arm
    note = "about each member's own axis; wheel: negative where against the arm, as in an outer Geneva drive"
    return Quantity(parts={name: _exact(value, "rpm") for name, value in values.items()}, note=note)


def indexing_motion(s: Stages) -> Quantity:
    """The law of motion: peaks, constants, dwell and shocks, of the indexer, the Geneva wheel, and their ratio."""
    rows: dict[str, Parts] = {name: _motion(s, found) for name, found in s.measured.items()}
    if GENEVA in s.measured:
        ours, theirs = s.measured[INDEXER].constants, s.measured[GENEVA].constants
        rows["geneva_over_indexer"] = {
            "B": _exact(theirs.velocity / ours.velocity),
            "C": _exact(theirs.acceleration / ours.acceleration),
            "N_constant": _exact(theirs.power / ours.power),
            "soft_shock_constant": _over(theirs.start, ours.start),
        }
    note = "constants are freed of time and swing: B = ω T/ψ, C = ε T²/ψ, N = ω ε T³/ψ²"
    if GENEVA not in s.measured:
        note += "; no Geneva wheel turns by 180° or more"
    return Quantity(parts=rows, note=note)


def _motion(s: Stages, found: Measured) -> Parts:
    speed, top, constants = s.design.speed, found.peaks, found.constants
    turn = 2.0 * math.pi / speed
    share, within = found.indexer.duration, s.scene.drive.dwell_tolerance
    held = dwell_within(found.indexer, min(within, 0.25 * found.indexer.swing))
    return {
        "relative_turning_time": _exact(share),
        "index_time": _exact(share * turn, "s"),
        "dwell_time": _exact((1.0 - share) * turn, "s"),
        "dwell_angle": _degrees(found.dwell.angle),
        "dwell_within_tolerance": _degrees(held),
        "B": _exact(constants.velocity),
        "C": _exact(constants.acceleration),
        "N_constant": _exact(constants.power),
        "soft_shock_constant": _exact(_settled(constants.start, constants.acceleration)),
        "velocity_max": _exact(top.velocity * speed, "rad/s"),
        "acceleration_max": _exact(top.acceleration * speed**2, "rad/s^2"),
        "acceleration_at_start": _exact(_settled(top.start, top.acceleration) * speed**2, "rad/s^2"),
        "power_max_per_inertia": _exact(top.power * speed**3, "W/(kg*m^2)"),
        "velocity_max_at": _degrees(top.velocity_at),
        "acceleration_max_at": _degrees(top.acceleration_at),
        "power_max_at": _degrees(top.power_at),
        "hard_shock": _exact(_settled(found.shock, top.velocity) * speed, "rad/s"),
    }


def solutions(s: Stages) -> Quantity:
    """Every pin path without hard shock for the task, in both trains, and what keeps others from serving."""
    made = s.design
    rows: dict[str, Parts] = {}
    for i, found in enumerate(made.solutions, 1):
        path = found.indexer.path
        verdict = f"no, {FAULT_WORDS[found.fault]}" if found.fault else "yes"
        row: dict[str, Quantity] = {
            "train": Quantity(found.kind, model="exact"),
            "place": Quantity(found.place, model="exact"),
            "serves": Quantity("chosen" if _same(found, made.chosen) else verdict, model="exact"),
            "relative_turning_time": _exact(found.indexer.duration),
            "pin_ratio": _exact(path.pin_ratio),
            "arm_angle": _degrees(path.arm),
            "pin_angle": _degrees(path.pin),
        }
        rows[f"solution_{i}"] = row if found.fault else row | _constants(found)
    serving = sum(not found.fault for found in made.solutions)
    return Quantity(parts=rows, note=f"{serving} of {len(made.solutions)} serve")


def _constants(found: Solution) -> dict[str, Quantity]:
    constants = similarity(found.indexer)
    return {
        "B": _exact(constants.velocity),
        "C": _exact(constants.acceleration),
        "soft_shock_constant": _exact(_settled(constants.start, constants.acceleration)),
    }


def _settled(value: float, scale: float) -> float:
    """The value, 0 where it is rounding beside `scale`."""
    return value if abs(value) > 1e-12 * abs(scale) else 0.0


def _same(one: Solution, other: Solution) -> bool:
    return one.indexer.path == other.indexer.path and one.indexer.half_turn == other.indexer.half_turn


def _over(a: float, b: float) -> Quantity:
    if abs(b) < 1e-9 * abs(a):
        return Quantity("infinite", model="exact", note="the indexer starts without soft shock")
    return _exact(a / b)


def _degrees(angle: float) -> Quantity:
    return _exact(math.degrees(angle), "deg")


def _exact(value: float, unit: str = "") -> Quantity:
    return Quantity(value, unit, 0.0, "exact")

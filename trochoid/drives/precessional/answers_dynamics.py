"""Answers about reactions, balance, the casing's vibration, and masses."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from trochoid.drives.casing import casing_mass, is_elastic
from trochoid.drives.exact import exact
from trochoid.drives.mesh_error import scalar_error
from trochoid.drives.precessional.stages import Stages
from trochoid.drives.precessional.turn import FORCES, MODELS, MOMENTS
from trochoid.drives.vibration import CasingVibration
from trochoid.drives.vibration_answers import casing_note, velocity_parts, zone_answer
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Quantity

STATISTICS: dict[str, Callable[[Array], float]] = {
    "mean": lambda a: float(a.mean()),
    "min": lambda a: float(a.min()),
    "max": lambda a: float(a.max()),
}
LINES = ("couple_at_1", "couple_at_2q_minus_1", "couple_at_2q_plus_1", "couple_about_z_at_2q")  # q = z1/z2
UNITS = dict.fromkeys(FORCES, "N") | dict.fromkeys(MOMENTS, "N*m")


def reactions(s: Stages) -> Quantity:
    """Least, mean and largest of all reactions over a turn of the shaft, by model."""
    parts: dict[str, Mapping[str, Quantity]] = {
        model: {
            f"{name}_{key}": Quantity(_settled(statistic(size), size), UNITS[name], None, model)
            for name, size in turn.sizes.items()
            for key, statistic in STATISTICS.items()
        }
        for model, turn in s.reactions.items()
    }
    note = "inertia forces alone, over 0 to 360 deg by 1 deg; rigid: Newton-Euler, printed: the paper's equations"
    if s.yielding is not None:
        parts["change"] = changes(s)
        note += "; elastic: with the inertia of members that yield; change: most of elastic less rigid, as vectors"
    return Quantity(parts=parts, note=note)


def changes(s: Stages) -> dict[str, Quantity]:
    """Largest change over a turn of each reaction by the joints that yield."""
    rigid, elastic = (s.reactions[model].over for model in ("rigid", "elastic"))
    off = {name: elastic.vector(name) - rigid.vector(name) for name in UNITS}
    sizes = {name: np.linalg.norm(values.reshape(len(values), -1), axis=1) for name, values in off.items()}
    return {name: Quantity(float(size.max()), UNITS[name], None, "elastic") for name, size in sizes.items()}


def most_changed(s: Stages) -> str:
    """Say in a sentence which reaction the elastic joints change most."""
    rigid = s.reactions["rigid"].sizes
    off = {name: quantity.value for name, quantity in changes(s).items()}
    part = {
        name: value / float(np.abs(rigid[name]).max())
        for name, value in off.items()
        if isinstance(value, float) and np.abs(rigid[name]).max() > 0.0 and name != "M_3"
    }
    if not part:
        return "No reaction changes."
    name = max(part, key=lambda key: part[key])
    return f"Most changed is {name}: by up to {100.0 * part[name]:.3g} % of its largest rigid value."


def _settled(value: float, values: Array) -> float:
    """Return 0 for what is only rounding beside the largest of `values`."""
    return value if abs(value) > 1e-12 * float(np.abs(values).max(initial=0.0)) else 0.0


def balance(s: Stages) -> Quantity:
    """What the counterweight must be, what it leaves unbalanced, and what no counterweight can balance."""
    from trochoid.drives.precessional.balance import (
        balance_plane,
        couple_lines,
        mean_product,
        remaining_couple,
        static_moment,
    )
    from trochoid.drives.precessional.mechanism import mass_moments

    drive, speed = s.mechanism, s.design.speed
    needed, weight = static_moment(drive), mass_moments(drive)[2]
    force = abs(needed - weight) * speed**2
    size = max(abs(needed), abs(weight)) * speed**2
    parts: dict[str, Quantity | Mapping[str, Quantity]] = {
        "static_moment_needed": _one(1e3 * needed, "kg*mm"),
        "static_moment_given": _one(1e3 * weight, "kg*mm"),
        "unbalanced_force": _one(force if force > 1e-12 * size else 0.0, "N"),
        "mean_couple_of_satellite": {
            name: _one(-(speed**2) * mean_product(drive, model), "N*m", name)
            for name, model in MODELS.items()
        },
    }
    if drive.counterweight.mass > 0.0:
        parts["counterweight_radius_needed"] = _one(1e3 * needed / drive.counterweight.mass, "mm")
    if weight != 0.0:
        parts["plane_needed"] = {
            name: _one(1e3 * balance_plane(drive, model), "mm", name) for name, model in MODELS.items()
        }
        parts["plane_given"] = _one(1e3 * drive.counterweight.z, "mm")
    for name, line in zip(LINES, couple_lines(drive, speed), strict=True):
        how = (
            "swings about z" if line.axis == "z" else "turns forward" if line.order > 0 else "turns backward"
        )
        note = f"{how} at {abs(line.order)} of the input speed"
        parts[name] = Quantity(line.couple, "N*m", 0.0, "exact", note=note)
    parts["couple_never_balanced"] = _one(remaining_couple(drive, speed), "N*m")
    return Quantity(parts=parts, note="planes from O; couples about O in the fixed frame, amplitudes")


def _one(value: float, unit: str, model: str = "exact") -> Quantity:
    return Quantity(value, unit, 0.0, model)


def vibration_velocity(s: Stages) -> Quantity:
    """Velocity of the casing, rms 10–1000 Hz, at each point by direction; without each effect the worst beside it."""
    found = s.vibration

    def made(get: Callable[[CasingVibration], float], unit: str, model: str) -> Quantity:
        coarse = s.vibration_levels.coarse
        error = None if coarse is None else scalar_error(get(found), get(coarse))
        return Quantity(get(found), unit, error, model)

    best = "rigid" if s.yielding is None else "elastic"
    said = f"by the vector sum of all reactions on the casing; all its lines are resolved{casing_note(found)}"
    return Quantity(parts=velocity_parts(found, made, best), note=said)


def vibration_zone(s: Stages) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    return zone_answer(s.vibration.zone)


def mass(s: Stages) -> Quantity:
    """Masses as given, and the specific mass in kg per N·m of output torque."""
    d = s.feasible.scene.drive
    members = {
        "satellite": d.satellite.mass,
        "input_shaft": d.input_shaft.mass,
        "counterweight": 0.0 if d.counterweight is None else d.counterweight.mass,
        "output_shaft": 0.0 if d.output_shaft is None else d.output_shaft.mass,
        "casing": casing_mass(s.scene, lambda: s.casing_body)[0],
    }
    values = {name: (value, "kg") for name, value in members.items()}
    values["total"] = (math.fsum(members.values()), "kg")
    torque = s.scene.operation.output_torque
    if torque > 0.0:
        values["specific"] = (values["total"][0] / torque, "kg/(N*m)")
    note = "as the scene gives them" if torque > 0.0 else "specific mass needs a torque above zero"
    if is_elastic(s.scene):
        note += "; the casing's is that of its meshed body"
    return Quantity(parts=exact(values).parts, note=note)

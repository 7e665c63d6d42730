"""Answers about the bearings A, B, C and the joint O: their stiffness, and the safety and life of rolling ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from trochoid.drives.precessional.bearings import Joint, speeds
from trochoid.drives.precessional.stages import Stages
from trochoid.drives.rolling import Held
from trochoid.drives.rolling_answers import NONE, assumed, life_parts, seat_parts
from trochoid.kinematics.errors import SceneError
from trochoid.results.outcome import Parts, Quantity

ENTRIES = (
    ("radial", (0, 1), 1e-6, "N/um"),
    ("axial", (2,), 1e-6, "N/um"),
    ("tilt", (3, 4), 1.0, "N*m/rad"),
)
INNER_TURNS = {
    "A": False,
    "B": False,
    "C": True,
}  # past the load, which stands still in the frame of the input shaft

UNDER_TEETH = (
    "reactions to the members' inertia, what the output torque adds through the teeth (bearing_loads; neither "
    "radial_load nor moment_load stands for it), and the axial_load; on rigid rings"
)
UNDER_INERTIA = (
    "a bearing's radial_load and moment_load where the scene gives them, else the reactions to the members' inertia "
    "alone, and its axial_load; on rigid rings"
)


def bearing_stiffness(s: Stages) -> Quantity:
    """Stiffness of A, B, O and C as the equations have it: means across z, along z, against tilting."""
    found = s.yielding
    assert found is not None
    parts: dict[str, Quantity | Parts] = {}
    for joint in found.joints.all:
        if joint.yields:
            parts[joint.name.lower()] = _joint(joint, s.bearings.get(joint.name, ()))
    note = (
        "the tangent under the mean load of a turn, which stands still in the frame of the input shaft; where a motion "
        "is missing the joint holds it rigidly or not at all"
    )
    return Quantity(
        parts=parts, note=note if parts else "all joints are rigid: no table gives any of them a stiffness"
    )


def _joint(joint: Joint, over: tuple[Held, ...]) -> dict[str, Quantity]:
    model = "ISO/TS 16281" if joint.bearings else "given"
    parts = {}
    for name, motions, scale, unit in ENTRIES:
        values = [float(joint.stiffness[i, i]) for i in motions]
        if max(values) > 0.0:
            error = None
            if name == "radial" and over:
                error = scale * float(np.mean(values)) * _spread(over)
            parts[name] = Quantity(scale * float(np.mean(values)), unit, error, model)
    if joint.bearings:
        one = joint.bearings[0]
        if said := assumed(one):
            parts["radial"] = replace(parts["radial"], note=said)
        low, high = min(one.extremes[0] for one in over), max(one.extremes[1] for one in over)
        parts["one_along_load_least"] = Quantity(1e-6 * low, "N/um", None, model)
        parts["one_along_load_most"] = Quantity(1e-6 * high, "N/um", None, model)
        if one.seat is not None:
            parts |= seat_parts(one)
    return parts


def _spread(over: tuple[Held, ...]) -> float:
    """Return by how much the stiffness along the load departs from its middle over a period, relative."""
    worst = 0.0
    for one in over:
        low, high = one.extremes
        worst = max(worst, (high - low) / (high + low))
    return worst


def bearing_life(s: Stages) -> Quantity:
    """Safety against sinking in and life of the rolling bearings under the loads of a turn."""
    if not s.lasting:
        raise SceneError(f"bearing_life: {NONE} in [drive.bearing_a], [drive.bearing_b] or [drive.bearing_c]")
    turning, parts = speeds(s.design), dict[str, Quantity | Parts]()
    for name, rows in s.lasting.items():
        inner, outer = turning[name]
        found = [life_parts(one, inner - outer, INNER_TURNS[name]) for one in rows]
        if len(found) == 1:
            parts[name.lower()] = found[0]
        else:
            parts |= {f"{name.lower()}_{i}": each for i, each in enumerate(found, 1)}
    note = UNDER_TEETH if s.lasting is not s.bearings else UNDER_INERTIA
    return Quantity(parts=parts, note=note)

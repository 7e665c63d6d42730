"""The plan of a run whose stages have fixed costs."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from trochoid.plan import Plan, PlannedStage
from trochoid.scene import Scene

CASING = {
    "casing mesh": "the elastic casing as a body of finite elements",
    "casing": "reduced to its bores, feet and modes, on two mesh levels for the error",
}
SUPPORTS = "rolling bearings of the members and what they carry, in turn; their flexible seats"
REDUCING = 150.0, 14e-3  # MiB of a reduction, and of each of its degrees of freedom
PER_PATCH = 50.0  # degrees of freedom for each square of the box's surface with an edge's length as its side
MOST_MEMORY = 64.0 * 1024.0  # MiB: more than a workstation has
USUAL = 54_000.0  # degrees of freedom of a mesh from a file, which is not read here


def with_casing(
    scene: Scene[Any],
    why: Mapping[str, str],
    stages_of: Mapping[str, tuple[str, ...]],
    of_the_body: Iterable[str] = (),
) -> tuple[dict[str, str], dict[str, tuple[str, ...]]]:
    """Return what stages are for, and the stages of each quantity, with those of an elastic casing where there is one.

    It is shaken on its modes; quantities `of_the_body` ask for its mass alone.
    """
    if scene.casing is None or not scene.casing.elastic:
        return dict(why), dict(stages_of)
    made = {}
    for name, stages in stages_of.items():
        shaken = "vibration" in stages
        made[name] = (
            *stages,
            *(["casing mesh"] if shaken or name in of_the_body else []),
            *(["casing"] if shaken else []),
        )
    return {**why, **CASING}, made


def with_supports(
    has: bool, why: Mapping[str, str], stages_of: Mapping[str, tuple[str, ...]]
) -> tuple[dict[str, str], dict[str, tuple[str, ...]]]:
    """Return both with the stage "supports" before the contacts where rolling bearings hold members."""
    if not has:
        return dict(why), dict(stages_of)
    said = {}
    for name, reason in why.items():
        if name == "contact":
            said["supports"] = SUPPORTS
        said[name] = reason
    return said, {
        name: (*stages, "supports") if "contact" in stages else stages for name, stages in stages_of.items()
    }


def casing_cost(scene: Scene[Any]) -> tuple[dict[str, float], dict[str, float]]:
    """Return what the stages of an elastic casing cost, in seconds and MiB; nothing without one."""
    if scene.casing is None or not scene.casing.elastic:
        return {}, {}
    size, box = USUAL, scene.casing.box
    if box is not None:
        edge = scene.casing.mesh_edge or 1.5 * box.wall
        size = PER_PATCH * _area(box.size) / edge**2
    seconds = {"casing mesh": 0.5 + 2.5e-5 * size, "casing": 6.0 * (size / 38e3) ** 1.75}
    return seconds, {"casing mesh": 200.0 + 2e-3 * size, "casing": REDUCING[0] + REDUCING[1] * size}


def least_edge(size: tuple[float, float, float]) -> float:
    """Return the shortest edges of a box's mesh that fit into MOST_MEMORY, m; `size` of the box."""
    return math.sqrt(PER_PATCH * _area(size) * REDUCING[1] / (MOST_MEMORY - REDUCING[0]))


def _area(size: tuple[float, float, float]) -> float:
    x, y, z = size
    return 2.0 * (x * y + y * z + z * x)


def planned(
    scene: Scene[Any],
    why: Mapping[str, str],
    stages_of: Mapping[str, Iterable[str]],
    seconds: Mapping[str, float],
    model: str = "closed forms",
    memory: float = 100.0,
) -> Plan:
    """Return what a run would do: the stages in the order of `why`, which says what each is for.

    `stages_of` names the stages of each quantity, `seconds` what a stage costs (0.01 where it says nothing),
    `memory` (MiB) is that of every stage.
    """
    needed = {stage for name in scene.ask.quantities for stage in stages_of[name]}
    of_casing, memories = casing_cost(scene)
    seconds = {**of_casing, **seconds}
    stages = tuple(
        PlannedStage(name, reason, seconds.get(name, 0.01), memories.get(name, memory), name in needed)
        for name, reason in why.items()
    )
    effects = tuple(effect.type for effect in scene.effects)
    return Plan(stages, effects, scene.ask.quantities, model)

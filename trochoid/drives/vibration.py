"""Vibration of a scene's casing with and without each effect, and the zone that a standard gives it.

One load has most in it, that of the elastic reactions where there are any; others, such as the rigid one, shake the
same casing beside it, and the first one shakes the casing's variants: rigid, on rigid mounts, free.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from trochoid.drives.casing import Shaken, casing_table
from trochoid.drives.mesh_error import Pair
from trochoid.drives.seats import on_bores, seats_residual
from trochoid.dynamics.vibration import Vibration, vibrate
from trochoid.dynamics.wrench import Wrench
from trochoid.dynamics.zones import Machine, Zone, zone
from trochoid.scene import Scene

RIGID, SLOW, PRINTED, UNBALANCED = "rigid", "without_inertia", "printed", "without_counterweight"
GENEVA = "geneva_wheel"  # another mechanism in the same place
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Load:
    """What a drive puts on its casing by one model: the resultant, and on request where, by the places' names."""

    whole: Wrench
    by_seat: Callable[[], Mapping[str, Wrench]]


@dataclass(frozen=True, slots=True)
class CasingVibration:
    """Vibration by all that is in the scene (`elastic`, also where nothing yields), `others` by what each is without.

    `residual`: how far loads by their places are from their resultant, relative; 0 for a rigid casing.
    """

    elastic: Vibration
    others: Mapping[str, Vibration]
    zone: Zone
    casing: Shaken
    residual: float = 0.0

    @property
    def rigid(self) -> Vibration:
        """Vibration by the rigid reactions."""
        return self.others.get(RIGID, self.elastic)

    @property
    def static(self) -> Vibration:
        """Vibration by reactions without inertia."""
        return self.others.get(SLOW, self.elastic)

    def said(self, change: Callable[[Vibration], Vibration]) -> CasingVibration:
        """Return the same with other words in each."""
        others = {name: change(found) for name, found in self.others.items()}
        return replace(self, elastic=change(self.elastic), others=others)


def shaken(
    scene: Scene[Any],
    casing: Shaken,
    loads: Mapping[str, Load],
    base: float,
    speeds: tuple[float, float],
) -> CasingVibration:
    """Shake a casing and its variants with the first of the `loads`, and the casing with the others, by their names.

    The records of the loads last 1/`base` seconds; `speeds` of the driving and the driven shaft in rad/s. Raises
    Infeasible for a load that no bore of an elastic casing holds.
    """
    first, *names = loads
    residual = 0.0

    def act(name: str) -> Wrench | Mapping[str, Wrench]:
        nonlocal residual
        load = loads[name]
        if not casing.elastic:
            return load.whole
        held = on_bores(load.by_seat(), casing.bores, casing.holds)
        residual = max(residual, seats_residual(held, load.whole))
        return held

    best = act(first)
    elastic = vibrate(casing.body, best, base, casing.points)
    others = {name: vibrate(casing.body, act(name), base, casing.points) for name in names}
    others |= {name: vibrate(body, best, base, casing.points) for name, body in casing.variants.items()}
    return CasingVibration(elastic, others, zone_of(scene, elastic, speeds), casing, residual)


def on_levels(
    found: Pair[T], casing: Pair[Shaken], shake: Callable[[T, Shaken], CasingVibration]
) -> Pair[CasingVibration]:
    """Shake the casing on both levels of the loads and of the casing; what has one level only stands for both."""
    fine = shake(found.fine, casing.fine)
    if found.coarse is None and casing.coarse is None:
        return Pair(fine, None)
    load = found.fine if found.coarse is None else found.coarse
    return Pair(fine, shake(load, casing.fine if casing.coarse is None else casing.coarse))


def zone_of(scene: Scene[Any], found: Vibration, speeds: tuple[float, float]) -> Zone:
    """Return the zone of a vibration; `speeds` of the driving and the driven shaft in rad/s, both positive."""
    table = casing_table(scene)
    machine = Machine(
        scene.operation.output_torque * speeds[1],
        *speeds,
        gear_unit=table.machine != "industrial_machine",
        rigid_support=table.rigid_support,
    )
    return zone(found.rms_max, machine)

"""The stages of an indexer's run, each computed when it is first asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.indexer.design import Design, design
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer_slot import Slot, slot
from trochoid.scene.drive_indexer import IndexerScene

if TYPE_CHECKING:
    from trochoid.drives.indexer.forces import Forces
    from trochoid.drives.indexer.measures import Measured
    from trochoid.drives.indexer.pin import Pair
    from trochoid.drives.indexer.shaken import Shaken
    from trochoid.drives.indexer.wheel import WheelMass


@dataclass(frozen=True)
class Stages:
    """What a scene's quantities are made from; every stage is a value, computed once."""

    scene: IndexerScene
    clock: Clock

    @cached_property
    def design(self) -> Design:
        """The chosen mechanism among all solutions; raises Infeasible if none serves."""
        with self.clock.stage("synthesis"):
            return design(self.scene)

    @cached_property
    def measured(self) -> Mapping[str, Measured]:
        """Peaks, constants and rest of the indexer and of the Geneva wheel."""
        made = self.design
        with self.clock.stage("motion"):
            from trochoid.drives.indexer.measures import measure

            return measure(made)

    @cached_property
    def slots(self) -> Mapping[str, Slot]:
        """Travel of the pin in the slot of both mechanisms."""
        made = self.design
        with self.clock.stage("geometry"):
            return {name: slot(indexer) for name, indexer in made.mechanisms.items()}

    @cached_property
    def feasible(self) -> Design:
        """The design, once the wheel has been found possible; raises Infeasible with every reason."""
        made, travel = self.design, self.slots
        with self.clock.stage("geometry"):
            from trochoid.drives.indexer.feasible import faults, pin_faults

            reasons = faults(made, travel["indexer"])
            if self.scene.has("elastic_contact"):
                reasons += pin_faults(made)
            if reasons:
                raise Infeasible("\n".join(reasons))
        return made

    @cached_property
    def wheel(self) -> WheelMass:
        """Mass and moment of inertia of the wheel."""
        made = self.feasible
        with self.clock.stage("mass"):
            from trochoid.drives.indexer.wheel import wheel_mass

            return wheel_mass(self.scene, self.slots["indexer"], made)

    @cached_property
    def forces(self) -> Mapping[str, Forces]:
        """Forces over an index of both mechanisms, rigid."""
        made, wheel = self.feasible, self.wheel
        with self.clock.stage("forces"):
            from trochoid.drives.indexer.forces import Load, forces

            inertia = wheel.used + (self.scene.drive.output_shaft.inertia or 0.0)
            inertia = inertia if self.scene.has("inertia") else 0.0
            load = Load(
                made.speed, inertia, self.scene.operation.output_torque, self.scene.drive.sphere_radius
            )
            return {name: forces(indexer, load) for name, indexer in made.mechanisms.items()}

    @cached_property
    def pairs(self) -> Mapping[str, Pair]:
        """Pin and slot of both mechanisms as elastic pairs."""
        made, loads = self.feasible, self.forces
        with self.clock.stage("contact"):
            from trochoid.drives.indexer.pin import pairs

            return pairs(self.scene, made, self.slots, loads)

    @cached_property
    def shaken(self) -> Mapping[str, Shaken]:
        """Response of wheel and output over an index and its dwell, of the Geneva wheel also in the same time."""
        loaded, wheel = self.pairs, self.wheel
        with self.clock.stage("vibration"):
            from trochoid.drives.indexer.shaken import shaken

            return shaken(self.scene, wheel, loaded)

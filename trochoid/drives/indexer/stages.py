"""The stages of an indexer's run, each computed when it is first asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.casing import casing_reasons
from trochoid.drives.indexer.design import Design, design
from trochoid.kinematics.errors import Infeasible, NotConverged
from trochoid.kinematics.indexer_slot import Slot, slot
from trochoid.scene.drive_indexer import IndexerScene

if TYPE_CHECKING:
    from trochoid.drives.casing import Shaken as ShakenCasing
    from trochoid.drives.indexer.forces import Forces
    from trochoid.drives.indexer.measures import Measured
    from trochoid.drives.indexer.modes import Modes
    from trochoid.drives.indexer.pin import Pair
    from trochoid.drives.indexer.reactions import Turn
    from trochoid.drives.indexer.shaken import Shaken
    from trochoid.drives.indexer.vibration import Loads
    from trochoid.drives.indexer.wall import Bodies
    from trochoid.drives.indexer.wheel import WheelMass
    from trochoid.drives.mesh_error import Pair as Levels
    from trochoid.drives.vibration import CasingVibration
    from trochoid.fem.solid import SolidBody


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
            from trochoid.drives.indexer.feasible import faults, pin_faults, play_faults

            elastic = self.scene.has("elastic_contact")
            loose = elastic and self.scene.has("clearance")
            reasons = faults(made, travel["indexer"], made.drive.pin.play if loose else 0.0)
            if elastic:
                reasons += pin_faults(made)
            if loose:
                reasons += play_faults(made, travel["indexer"])
            reasons = (*reasons, *casing_reasons(self.scene))
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
    def bodies(self) -> Bodies:
        """Slotted wheels and pins as finite elements, on two mesh levels."""
        made, loads = self.feasible, self.forces
        with self.clock.stage("bodies"):
            from trochoid.drives.indexer.feasible import too_thin
            from trochoid.drives.indexer.pin import differences, fail_if_absurd, pin_of
            from trochoid.drives.indexer.wall import ELASTIC, RIGID, Bodies, bodies

            if all(x.largest(lambda y: y.pin)[0] == 0.0 for x in loads.values()):
                return Bodies(None, None)
            pin = pin_of(self.scene, made, self.slots["indexer"])
            fail_if_absurd(pin, loads)
            thin, model = too_thin(made, self.slots), self.scene.accuracy.model
            if thin and model == ELASTIC:
                raise Infeasible(thin)
            if thin and model != RIGID:
                return Bodies(None, None, refusal=thin)
            return bodies(
                self.scene,
                made,
                self.slots,
                pin,
                lambda fine, coarse, name: differences(fine, coarse, loads[name])["stiffness"],
            )

    @property
    def pairs(self) -> Mapping[str, Pair]:
        """Pin and slot of both mechanisms as elastic pairs."""
        return self._paired[0]

    @property
    def refusal(self) -> str:
        """Why the wheel counts as rigid although the scene does not say so; empty where it does not."""
        return self._paired[1]

    @cached_property
    def _paired(self) -> tuple[Mapping[str, Pair], str]:
        made, loads, elastic = self.feasible, self.forces, self.bodies
        with self.clock.stage("contact"):
            from trochoid.drives.indexer.pin import pairs, pin_of
            from trochoid.drives.indexer.wall import ELASTIC, Bodies

            pin = pin_of(self.scene, made, self.slots["indexer"])
            try:
                return pairs(self.scene, made, pin, loads, elastic), elastic.refusal
            except NotConverged as fault:
                if elastic.fine is None or self.scene.accuracy.model == ELASTIC:
                    raise
                return pairs(self.scene, made, pin, loads, Bodies(None, None)), str(fault)

    @cached_property
    def shaken(self) -> Mapping[str, Shaken]:
        """Response of wheel and output over an index and its dwell, of the Geneva wheel also in the same time."""
        loaded, wheel = self.pairs, self.wheel
        with self.clock.stage("march"):
            from trochoid.drives.indexer.shaken import shaken

            return shaken(self.scene, wheel, loaded)

    @property
    def marched(self) -> bool:
        """Whether elastic contact and inertia are both in the equations, so that there is a response in time."""
        return self.scene.has("elastic_contact") and self.scene.has("inertia")

    @cached_property
    def response(self) -> tuple[Mapping[str, Shaken] | None, str]:
        """The response in time, or None and why there is none."""
        if not self.marched:
            return None, ""
        try:
            return self.shaken, ""
        except (NotConverged, Infeasible) as refusal:
            return None, str(refusal)

    @cached_property
    def reactions(self) -> Mapping[str, Mapping[str, Turn]]:
        """Reactions over a turn of each mechanism, rigid, and elastic where there is a march."""
        found, (responses, _) = self.forces, self.response
        with self.clock.stage("reactions"):
            from trochoid.drives.indexer.reactions import shafts, turns

            return turns(found, shafts(self.scene.drive), responses)

    @cached_property
    def modes(self) -> Mapping[str, Modes]:
        """Natural frequencies of the output at frozen positions."""
        loaded, wheel = self.pairs, self.wheel
        with self.clock.stage("modes"):
            from trochoid.drives.indexer.modes import modes

            return modes(self.scene, wheel, loaded)

    @cached_property
    def casing_body(self) -> SolidBody:
        """The elastic casing as a finite-element body."""
        from trochoid.drives.casing_body import casing_body

        return casing_body(self.scene, self.clock)

    @cached_property
    def casing(self) -> Levels[ShakenCasing]:
        """The casing, and its variants without single effects."""
        from trochoid.drives.casing_body import casings

        return casings(self.scene, self.clock, lambda: self.casing_body)

    @cached_property
    def casing_loads(self) -> Levels[Loads]:
        """What presses the casing over a turn of the arm, index and dwell; where marched, on two lengths of steps."""
        found, (responses, _) = self.forces, self.response
        with self.clock.stage("vibration"):
            from trochoid.drives.indexer.vibration import casing_loads

            return casing_loads(found, responses)

    @cached_property
    def vibration(self) -> Levels[CasingVibration]:
        """Vibration velocity of the casing and its zone."""
        loads, casing = self.casing_loads, self.casing
        with self.clock.stage("vibration"):
            from trochoid.drives.indexer.vibration import casing_vibration
            from trochoid.drives.vibration import on_levels

            return on_levels(loads, casing, lambda found, shaken: casing_vibration(self.scene, found, shaken))

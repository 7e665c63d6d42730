"""The stages of a precessional run, each computed when it is first asked for; heavy imports are inside."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.casing import casing_reasons, is_elastic
from trochoid.drives.mesh_error import Pair
from trochoid.drives.precessional.design import Design, design
from trochoid.kinematics.errors import Infeasible
from trochoid.scene.drive_precessional import PrecessionalScene

if TYPE_CHECKING:
    from trochoid.drives.casing import Shaken
    from trochoid.drives.precessional.contact import Series
    from trochoid.drives.precessional.contact_stages import Slack, Solved, Teeth
    from trochoid.drives.precessional.elastic import Elastic
    from trochoid.drives.precessional.mechanism import PrecessionalDrive
    from trochoid.drives.precessional.modes import NaturalModes
    from trochoid.drives.precessional.turn import Turn
    from trochoid.drives.precessional.wedging import Wedged
    from trochoid.drives.precessional.yielding import Yielding
    from trochoid.drives.rolling import Held
    from trochoid.drives.vibration import CasingVibration
    from trochoid.fem.solid import SolidBody


@dataclass(frozen=True)
class Stages:
    """What a scene's quantities are made from; every stage is a value, computed once."""

    scene: PrecessionalScene
    clock: Clock

    @cached_property
    def design(self) -> Design:
        """Nutating pair and sphere tooth."""
        with self.clock.stage("kinematics"):
            return design(self.scene)

    @cached_property
    def feasible(self) -> Design:
        """The design, once its teeth have been found possible; raises Infeasible with every reason."""
        from trochoid.drives.precessional.feasible import faults

        made = self.design
        with self.clock.stage("geometry"):
            reasons = faults(made)
            if not reasons and self.scene.has("elastic_contact"):
                from trochoid.drives.precessional.rim import rim_faults

                reasons = rim_faults(made)
            reasons = (*reasons, *casing_reasons(self.scene))
            if self.scene.has("bearing_compliance"):
                from trochoid.drives.rolling import faults as rolling_faults

                d = self.scene.drive
                named = {"bearing_a": d.bearing_a, "bearing_b": d.bearing_b, "bearing_c": d.bearing_c}
                reasons = (*reasons, *rolling_faults(named))
            if reasons:
                raise Infeasible("\n".join(reasons))
        return made

    @cached_property
    def mechanism(self) -> PrecessionalDrive:
        """Masses and places."""
        made = self.feasible
        with self.clock.stage("mass"):
            return made.mechanism

    @cached_property
    def penetration(self) -> float | None:
        """How deep (rad) a pin cuts into a flank at any crank angle, by brute force; None without teeth."""
        tooth = self.feasible.tooth
        with self.clock.stage("penetration"):
            from trochoid.kinematics.sphere_tooth_clearance import penetration

            return None if tooth is None else penetration(tooth)

    @cached_property
    def yielding(self) -> Yielding | None:
        """Joints that yield and the steady motion on them; None where the scene has none.

        Raises NotConverged where no steady motion lasts: the members run away from it, undamped, at this speed.
        """
        if not self.scene.has("bearing_compliance"):
            return None
        drive, made = self.mechanism, self.design
        with self.clock.stage("elastic"):
            from trochoid.drives.precessional.modes import fail_if_unstable
            from trochoid.drives.precessional.yielding import yielding

            found = yielding(made, drive)
            fail_if_unstable(found, made.speed)
            return found

    @cached_property
    def bearings(self) -> dict[str, tuple[Held, ...]]:
        """Rolling bearings of the joints A, B, C under the loads of a period."""
        drive, made, held = self.mechanism, self.design, self.yielding
        if held is None:
            return {}
        with self.clock.stage("bearings"):
            from trochoid.drives.precessional.yielding import bearings_over_period

            return bearings_over_period(made, drive, held)

    @cached_property
    def lasting(self) -> dict[str, tuple[Held, ...]]:
        """Rolling bearings under what wears them: inertia, and the output torque through elastic teeth."""
        drive, made, held = self.mechanism, self.design, self.yielding
        if held is None or self.contact is None or not self.scene.has("elastic_contact"):
            return self.bearings
        contact = self.contact
        with self.clock.stage("bearings"):
            from trochoid.drives.precessional.tooth_loads import tooth_loads
            from trochoid.drives.precessional.yielding import bearings_over_period

            return bearings_over_period(made, drive, held, tooth_loads(made, contact.fine))

    @property
    def elastic(self) -> Elastic | None:
        """Steady motion of the yielding members; None where nothing yields."""
        return None if self.yielding is None else self.yielding.elastic

    @cached_property
    def teeth(self) -> Teeth | None:
        """The elastic teeth, before anything is solved; None without teeth."""
        from trochoid.drives.precessional.contact_stages import Teeth

        if self.feasible.tooth is None:
            return None
        return Teeth(self.design, self.clock, None if self.yielding is None else self.yielding.joints)

    @cached_property
    def contact(self) -> Solved | None:
        """Rollers and teeth over a pitch on two mesh levels; None without teeth."""
        return None if self.teeth is None else self.teeth.solved()

    @cached_property
    def wedged(self) -> Wedged | None:
        """How rollers press both sides of the teeth without any load; None where they do not."""
        if self.teeth is None or self.contact is None or not self.scene.has("clearance"):
            return None
        from trochoid.drives.precessional.wedging import wedged

        with self.clock.stage("contact"):
            return wedged(self.design, self.contact, self.teeth.tilt_stiffness)

    @cached_property
    def running(self) -> Series | None:
        """Contacts with the satellite's inertia besides; None where nothing yields to it, or the scene has none."""
        if self.teeth is None or self.contact is None or not self.scene.has("inertia"):
            return None
        held = self.teeth.tilt_stiffness is None or self.contact.fine.torque == 0.0
        return None if held else self.teeth.running(self.contact)

    @cached_property
    def slack(self) -> Slack | None:
        """The output turned both ways under a small torque; None without teeth."""
        return None if self.teeth is None or self.contact is None else self.teeth.slack(self.contact)

    @cached_property
    def reactions(self) -> Mapping[str, Turn]:
        """Reactions over a turn, by the models "rigid" and "printed", and "elastic" with yielding joints."""
        drive, made, elastic = self.mechanism, self.design, self.elastic
        with self.clock.stage("reactions"):
            from trochoid.drives.precessional.turn import turns

            return turns(drive, made.speed, elastic)

    @cached_property
    def modes(self) -> NaturalModes:
        """Natural frequencies of the members on their joints, and of the casing on its mounts with them."""
        drive, made, held = self.mechanism, self.design, self.yielding
        moves = is_elastic(self.scene) and self.scene.has("casing_on_mounts")
        body = self.casing_body if moves else None
        with self.clock.stage("modes"):
            from trochoid.drives.precessional.modes import natural_modes

            return natural_modes(made, drive, held, body)

    @cached_property
    def casing_body(self) -> SolidBody:
        """The elastic casing as a finite-element body."""
        from trochoid.drives.casing_body import casing_body

        return casing_body(self.scene, self.clock)

    @cached_property
    def casing(self) -> Pair[Shaken]:
        """The casing, and its variants without single effects."""
        from trochoid.drives.casing_body import casings

        return casings(self.scene, self.clock, lambda: self.casing_body)

    @cached_property
    def vibration(self) -> CasingVibration:
        """Vibration velocity of the casing and its zone."""
        return self._vibration(self.casing.fine)

    @cached_property
    def vibration_levels(self) -> Pair[CasingVibration]:
        """The same on both mesh levels of an elastic casing."""
        coarse = self.casing.coarse
        return Pair(self.vibration, None if coarse is None else self._vibration(coarse))

    def _vibration(self, casing: Shaken) -> CasingVibration:
        drive, made, held = self.mechanism, self.design, self.yielding
        with self.clock.stage("vibration"):
            from trochoid.drives.precessional.vibration import vibration

            return vibration(made, drive, casing, held)

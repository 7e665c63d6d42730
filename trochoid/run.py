"""A run: a scene in, an outcome out; what is not asked for is not computed, nor its libraries loaded."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from trochoid.clock import Clock
from trochoid.drives import Drive, drive_of
from trochoid.kinematics.errors import SceneError
from trochoid.plan import Plan
from trochoid.scene import Scene

if TYPE_CHECKING:
    from trochoid.results.outcome import Outcome, Quantity


@dataclass(frozen=True)
class Run:
    """A scene being computed, lazily; every quantity of the drive is an attribute: `run.torsional_stiffness`.

    Stages are values that the quantities share; each is computed once.
    """

    scene: Scene[Any]
    clock: Clock = field(default_factory=Clock)

    @cached_property
    def drive(self) -> Drive:
        """What the drive's folder offers."""
        return drive_of(self.scene.drive.type)

    @cached_property
    def stages(self) -> Any:
        """The drive's stages; their type belongs to the drive."""
        return self.drive.stages(self.scene, self.clock)

    def quantity(self, name: str) -> Quantity:
        """Compute one quantity by name; raises SceneError for one that the drive does not offer."""
        if name not in self.drive.quantities:
            offered = ", ".join(self.drive.quantities)
            raise SceneError(f'{self.scene.drive.type} offers no quantity "{name}"; it offers {offered}')
        return self.drive.quantities[name](self.stages)

    def __getattr__(self, name: str) -> Quantity:
        """Compute a quantity on first use."""
        if name in type(self).__dict__:  # an attribute was missing inside this property: say which
            return super().__getattribute__(name)  # type: ignore[no-any-return]
        if name.startswith("_") or name not in self.drive.quantities:
            raise AttributeError(f'a run has no stage and no quantity "{name}"')
        return self.quantity(name)

    @cached_property
    def outcome(self) -> Outcome:
        """Everything that the scene asks for, ready to be written."""
        quantities = {name: self.quantity(name) for name in self.scene.ask.quantities}
        return self.drive.outcome(self.stages, quantities)


def plan(scene: Scene[Any]) -> Plan:
    """Say what a run of the scene would do and cost; nothing is solved.

    Raises Infeasible with every reason when the drive cannot be built.
    """
    return drive_of(scene.drive.type).plan(scene)

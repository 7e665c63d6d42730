"""The stages of a K-H-V run, each computed when it is first asked for; heavy imports are inside."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Generic, TypeVar

from trochoid.clock import Clock
from trochoid.drives.khv.design import Design, design
from trochoid.kinematics.errors import Infeasible, NotConverged, SceneError, TrochoidError
from trochoid.scene import Scene

if TYPE_CHECKING:
    from trochoid.drives.khv.bodies import Level
    from trochoid.drives.khv.field import DiscState
    from trochoid.drives.khv.mass import Masses
    from trochoid.drives.khv.reactions import Reactions
    from trochoid.drives.khv.seat import SeatStiffness
    from trochoid.drives.khv.series import Series
    from trochoid.drives.khv.vibration import CasingVibration
    from trochoid.geometry.mesh import Mesh

COARSEST = 8  # facets per lobe: with 6 the order of convergence is not yet seen, and the estimate misleads
FINEST = 64
RESOLVED_BELOW = (
    1e-3  # tolerance under which pressure is resolved by strips; level 0 agrees with them to 1e-4
)


T = TypeVar("T")
U = TypeVar("U")


@dataclass(frozen=True, slots=True)
class Pair(Generic[T]):
    """A value on the finer mesh level and on the coarser one; None where there is no mesh."""

    fine: T
    coarse: T | None

    def map(self, make: Callable[[T], U]) -> Pair[U]:
        """Make something of both."""
        return Pair(make(self.fine), None if self.coarse is None else make(self.coarse))


@dataclass(frozen=True)
class Solved:
    """Contacts over a turn on the finer of two mesh levels, on the coarser one (None for rigid discs), and
    their levels.
    """

    fine: Series
    coarse: Series | None
    level: Level | None
    coarse_level: Level | None


@dataclass(frozen=True)
class Stages:
    """What a scene's quantities are made from; every stage is a value, computed once."""

    scene: Scene
    clock: Clock

    @cached_property
    def design(self) -> Design:
        """Members, profile, speeds."""
        with self.clock.stage("kinematics"):
            return design(self.scene)

    @cached_property
    def feasible(self) -> Design:
        """The design, once its geometry has been found possible; raises Infeasible with every reason."""
        from trochoid.drives.khv.feasible import faults

        made = self.design
        with self.clock.stage("geometry"):
            reasons = faults(made)
            if reasons:
                raise Infeasible("\n".join(reasons))
        return made

    @cached_property
    def masses(self) -> Masses:
        """Masses and inertias of the members."""
        from trochoid.drives.khv.mass import masses

        made = self.feasible
        with self.clock.stage("mass"):
            return masses(made)

    @property
    def rung(self) -> str:
        """The contact model."""
        return rung_of(self.scene)

    def meshes(self, facets: int) -> tuple[Mesh, ...]:
        """Mesh the distinct discs."""
        made = self.feasible
        with self.clock.stage("mesh"):
            from trochoid.drives.khv.bodies import meshes

            return meshes(made, facets)

    def coarsest_level(self) -> Level:
        """Build the discs on the coarsest level whose mesh thin walls allow; raises what the finest mesh says."""
        facets = COARSEST
        while 2 * facets < FINEST:
            made = None
            with suppress(TrochoidError):
                made = self.meshes(facets)
            if made is not None:
                return self.level(facets, made)
            facets *= 2
        return self.level(facets)

    def level(self, facets: int, made: tuple[Mesh, ...] | None = None) -> Level:
        """Build the discs on one mesh level, of which the meshes may be there already."""
        meshes = self.meshes(facets) if made is None else made
        with self.clock.stage("bodies"):
            from trochoid.drives.khv.bodies import build_level

            return build_level(self.design, facets, meshes)

    def series(self, level: Level | None) -> Series:
        """Solve all positions on a level, or with rigid discs."""
        made = self.feasible
        with self.clock.stage("contact"):
            from trochoid.drives.khv.series import solve_series

            bodies = () if level is None else level.elastic
            return solve_series(made, self.rung, bodies, self.scene.ask.positions)

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a turn, on the coarsest pair of levels whose estimated error meets the tolerance.

        Raises NotConverged when the finest pair does not.
        """
        if self.rung == "springs":
            return Solved(self.series(None), None, None, None)
        from trochoid.drives.khv.estimate import worst_error

        given = self.scene.accuracy.facets_per_lobe
        level = self.coarsest_level() if given is None else self.level(max(3, given // 2))
        facets = level.facets_per_lobe
        coarse = self.series(level)
        while True:
            finer = self.level(given or 2 * facets)
            fine = self.series(finer)
            error, name = worst_error(fine, coarse)
            if given is not None or error <= self.scene.accuracy.tolerance:
                return Solved(fine, coarse, finer, level)
            facets, level, coarse = 2 * facets, finer, fine
            if 2 * facets > FINEST:
                raise NotConverged(
                    f"the error of {name} is estimated at {error:.1e} with {facets} facets per lobe, more than "
                    f"accuracy.tolerance = {self.scene.accuracy.tolerance:g}; raise the tolerance to {error:.1e}, or "
                    "name accuracy.facets_per_lobe and accept the error"
                )

    @cached_property
    def bearing(self) -> Pair[SeatStiffness]:
        """Stiffness of the eccentric bearing."""
        solved = self.contact
        with self.clock.stage("bearing"):
            from trochoid.drives.khv.seat import seat_stiffness

            fine = seat_stiffness(self.design, solved.fine, solved.level)
            if solved.coarse is None:
                return Pair(fine, None)
            return Pair(fine, seat_stiffness(self.design, solved.coarse, solved.coarse_level))

    @cached_property
    def field(self) -> Pair[tuple[DiscState, ...]]:
        """Displacement and stress of every disc at the asked position."""
        solved = self.contact
        angle = self.scene.ask.stress_position or 0.0
        with self.clock.stage("stress"):
            from trochoid.drives.khv.field import disc_states

            if solved.level is None or solved.coarse_level is None:
                raise SceneError("a rigid disc has no stress: list the effect elastic_contact")
            return Pair(solved.level, solved.coarse_level).map(
                lambda level: disc_states(self.design, self.rung, level, angle)
            )

    @cached_property
    def reactions(self) -> Pair[Reactions]:
        """Bearing reactions over a turn."""
        solved, masses = self.contact, self.masses
        damping = self.scene.operation.damping_ratio
        with self.clock.stage("reactions"):
            from trochoid.drives.khv.reactions import reactions

            return Pair(solved.fine, solved.coarse).map(
                lambda series: reactions(self.design, series, masses, damping)
            )

    @cached_property
    def vibration(self) -> Pair[CasingVibration]:
        """Vibration velocity of the casing."""
        found = self.reactions
        with self.clock.stage("vibration"):
            from trochoid.drives.khv.vibration import casing_vibration

            return found.map(lambda reactions: casing_vibration(self.design, reactions))


def rung_of(scene: Scene) -> str:
    """Return the contact model: named by the scene, or the cheapest that its tolerance allows."""
    if not scene.has("elastic_contact"):
        return "springs"
    if scene.accuracy.model is not None:
        return scene.accuracy.model
    return "strips" if scene.accuracy.tolerance < RESOLVED_BELOW else "level0"

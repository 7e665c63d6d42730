"""The stages of an RV run, each computed when it is first asked for; heavy imports are inside."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.choosing import FINEST, choose, doubled
from trochoid.drives.mesh_error import Pair
from trochoid.drives.rv.design import Design, design
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.scene.drive_rv import RvScene

if TYPE_CHECKING:
    from trochoid.drives.rv.bodies import Level
    from trochoid.drives.rv.field import DiscStress
    from trochoid.drives.rv.mass import Masses
    from trochoid.drives.rv.reactions import Reactions
    from trochoid.drives.rv.reversal import Reversal
    from trochoid.drives.rv.running import Running
    from trochoid.drives.rv.series import Series
    from trochoid.drives.rv.teeth import Teeth
    from trochoid.drives.vibration import CasingVibration
    from trochoid.geometry.mesh import Mesh
    from trochoid.kinematics.types import Array


COARSEST = 12  # facets per lobe: with 8 the largest pin force of small pins is off by a twentieth
TOOTH_FACETS = 8  # on a flank of sun and planet, on the coarser level


@dataclass(frozen=True)
class Solved:
    """Contacts over a turn of the crankshafts on the finer of two mesh levels; `pair`: at every fourth position, on
    both; and the levels.
    """

    fine: Series
    pair: Pair[Series]
    levels: Pair[Level]


@dataclass(frozen=True)
class Stages:
    """What a scene's quantities are made from; every stage is a value, computed once."""

    scene: RvScene
    clock: Clock

    @cached_property
    def design(self) -> Design:
        """Members, profiles, speeds."""
        with self.clock.stage("kinematics"):
            return design(self.scene)

    @cached_property
    def feasible(self) -> Design:
        """The design, once its geometry has been found possible; raises Infeasible with every reason."""
        made = self.design
        with self.clock.stage("geometry"):
            from trochoid.drives.rv.feasible import faults

            reasons = faults(made)
            if reasons:
                raise Infeasible("\n".join(reasons))
        return made

    @cached_property
    def masses(self) -> Masses:
        """Masses and inertias of the members."""
        made = self.feasible
        with self.clock.stage("mass"):
            from trochoid.drives.rv.mass import masses

            return masses(made)

    @property
    def rung(self) -> str:
        """The contact model: named by the scene, or the cheapest that its tolerance allows."""
        return self.scene.accuracy.model or self.contact.fine.rung

    def meshes(self, facets: int) -> tuple[Mesh, ...]:
        """Mesh the distinct discs."""
        made = self.feasible
        with self.clock.stage("mesh"):
            from trochoid.drives.rv.bodies import meshes

            return meshes(made, facets)

    def coarsest(self) -> tuple[int, tuple[Mesh, ...] | None]:
        """Return the coarsest level whose mesh thin walls allow, with its meshes; the finest without any."""
        facets = COARSEST
        while 2 * facets < FINEST:
            with suppress(TrochoidError):
                return facets, self.meshes(facets)
            facets *= 2
        return facets, None

    def first_given(self, given: int) -> int:
        """Return the level that tells the error of the facets per lobe that a scene names."""
        return max(3, given // 2)

    def level(self, facets: int, made: tuple[Mesh, ...] | None = None) -> Level:
        """Build the discs on one mesh level, of which the meshes may be there already."""
        meshes = self.meshes(facets) if made is None else made
        given = self.scene.drive.first_stage.mesh_stiffness
        stiffness = self.teeth.fine.mean if given is None else given
        with self.clock.stage("bodies"):
            from trochoid.drives.rv.bodies import build_level

            return build_level(self.design, facets, meshes, stiffness)

    @cached_property
    def teeth(self) -> Pair[Teeth]:
        """Stiffness of sun and planet in mesh, on two mesh levels."""
        made = self.feasible
        with self.clock.stage("teeth"):
            from trochoid.drives.rv.teeth import teeth

            return Pair(teeth(made, 2 * TOOTH_FACETS), teeth(made, TOOTH_FACETS))

    def series(self, level: Level, rung: str, angle: Array) -> Series:
        """Solve positions at input angles (n,) in rad."""
        made = self.feasible
        with self.clock.stage("contact"):
            from trochoid.drives.rv.series import solve_series

            return solve_series(made, rung, level, angle)

    def model_error(self, level: Level) -> float:
        """Return how far level 0 is from strips."""
        made = self.feasible
        with self.clock.stage("contact"):
            from trochoid.drives.rv.estimate import model_error

            return model_error(made, level)

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a turn of the crankshafts, on the coarsest pair of levels whose estimated error meets the
        tolerance. Raises NotConverged when the finest pair does not.
        """
        from trochoid.drives.rv.estimate import worst_error
        from trochoid.drives.rv.series import STRIDE, turn_angles, woven

        accuracy = self.scene.accuracy
        given = accuracy.facets_per_lobe
        first, meshes = self.coarsest() if given is None else (self.first_given(given), None)
        built = {first: self.level(first, meshes)}
        angle = turn_angles(self.design, self.scene.ask.positions)
        solved: dict[int, Series] = {}

        def solve(rung: str, facets: int) -> Series:
            if facets not in built:
                built[facets] = self.level(facets)
            solved[facets] = self.series(built[facets], rung, angle[::STRIDE])
            return solved[facets]

        found = choose(
            accuracy.tolerance if given is None else float("inf"),
            doubled(first) if given is None else (first, given),
            solve,
            worst_error,
            lambda: self.model_error(built[first]),
            accuracy.model,
        )
        coarse, fine = found.levels[-2:]
        between = self.series(built[fine], found.rung, angle[[i % STRIDE > 0 for i in range(len(angle))]])
        whole = woven(solved[fine], between)
        return Solved(whole, Pair(solved[fine], solved[coarse]), Pair(built[fine], built[coarse]))

    @cached_property
    def difference(self) -> float:
        """Largest relative difference of the two mesh levels among what the answers rest on."""
        from trochoid.drives.rv.estimate import differences

        both = self.contact.pair
        return 0.0 if both.coarse is None else max(differences(both.fine, both.coarse).values())

    @cached_property
    def reversal(self) -> Pair[Reversal]:
        """Twists under a small torque to either side."""
        solved, rung = self.contact, self.rung
        with self.clock.stage("reversal"):
            from trochoid.drives.rv.reversal import reversal

            return solved.levels.map(lambda level: reversal(self.design, rung, level))

    @cached_property
    def losses(self) -> Pair[Running]:
        """The running drive with friction, at some positions of a turn of the crankshafts."""
        solved, rung = self.contact, self.rung
        with self.clock.stage("losses"):
            from trochoid.drives.rv.running import run

            return solved.levels.map(lambda level: run(self.design, rung, level))

    @cached_property
    def field(self) -> Pair[tuple[DiscStress, ...]]:
        """Displacement and stress of every disc at the asked position."""
        solved, rung = self.contact, self.rung
        angle = self.scene.ask.stress_position or 0.0
        with self.clock.stage("stress"):
            from trochoid.drives.rv.field import disc_stresses

            return solved.levels.map(lambda level: disc_stresses(self.design, rung, level, angle))

    @cached_property
    def roots(self) -> Pair[tuple[Array, Array]]:
        """Tension in the fillets of sun and planet over a base pitch."""
        made = self.teeth
        with self.clock.stage("stress"):
            from trochoid.drives.rv.teeth import root_stress

            return made.map(root_stress)

    @cached_property
    def reactions(self) -> Reactions:
        """Reactions of all bearings over a turn of the crankshafts."""
        return self._reactions(self.contact.fine)

    @cached_property
    def reaction_levels(self) -> Pair[Reactions]:
        """The same at every fourth position on both mesh levels; on none where these are too few."""
        both = self.contact.pair
        if both.coarse is None or len(both.fine.angle) < 4:
            return Pair(self.reactions, None)
        return both.map(self._reactions)

    def _reactions(self, series: Series) -> Reactions:
        parts, damping = self.masses, self.scene.operation.damping_ratio
        with self.clock.stage("reactions"):
            from trochoid.drives.rv.reactions import reactions

            return reactions(self.design, series, parts, damping)

    @cached_property
    def vibration(self) -> CasingVibration:
        """Vibration velocity of the casing."""
        return self._vibration(self.reactions)

    @cached_property
    def vibration_levels(self) -> Pair[CasingVibration]:
        """The same from the reactions on both mesh levels."""
        both = self.reaction_levels
        return Pair(self.vibration, None) if both.coarse is None else both.map(self._vibration)

    def _vibration(self, found: Reactions) -> CasingVibration:
        with self.clock.stage("vibration"):
            from trochoid.drives.rv.vibration import casing_vibration

            return casing_vibration(self.design, found)

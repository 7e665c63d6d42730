"""The stages of an RV run, each computed when it is first asked for; heavy imports are inside."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.casing import casing_reasons
from trochoid.drives.choosing import Chosen, choose, coarsest, doubled, first_given, or_level0
from trochoid.drives.mesh_error import Pair
from trochoid.drives.rv.design import Design, design
from trochoid.kinematics.errors import Infeasible
from trochoid.scene.drive_rv import RvScene

if TYPE_CHECKING:
    from trochoid.drives.casing import Shaken
    from trochoid.drives.rolling import Held
    from trochoid.drives.rv.bearings import CrankBearings
    from trochoid.drives.rv.bodies import Level
    from trochoid.drives.rv.field import DiscStress
    from trochoid.drives.rv.mass import Masses
    from trochoid.drives.rv.modes import NaturalModes
    from trochoid.drives.rv.reactions import Reactions
    from trochoid.drives.rv.reversal import Reversal
    from trochoid.drives.rv.running import Running
    from trochoid.drives.rv.seat import ArmStiffness
    from trochoid.drives.rv.series import Series
    from trochoid.drives.rv.teeth import Teeth
    from trochoid.drives.vibration import CasingVibration
    from trochoid.fem.solid import SolidBody
    from trochoid.geometry.mesh import Mesh
    from trochoid.kinematics.types import Array


COARSEST = 12  # facets per lobe: with 8 the largest pin force of small pins is off by a twentieth
TOOTH_FACETS = 8  # on a flank of sun and planet, on the coarser level


@dataclass(frozen=True)
class Solved:
    """Contacts over a turn of the crankshafts on the finer of two mesh levels; `pair`: at every fourth position, on
    both; and the levels; `doubt`: why the error of level 0 is not known.
    """

    fine: Series
    pair: Pair[Series]
    levels: Pair[Level]
    doubt: str = ""


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

            reasons = [*faults(made), *casing_reasons(self.scene)]
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
        return coarsest(COARSEST, self.meshes)

    def level(self, facets: int, made: tuple[Mesh, ...] | None = None) -> Level:
        """Build the discs on one mesh level, of which the meshes may be there already."""
        found = self._supporting
        if found is None:
            return self._bodies(facets, made)
        level, cranks = found
        bare = level if level.facets_per_lobe == facets else self._bodies(facets, made)
        return replace(bare, cranks=cranks.stiffness)

    def _bodies(self, facets: int, made: tuple[Mesh, ...] | None = None) -> Level:
        meshes = self.meshes(facets) if made is None else made
        given = self.scene.drive.first_stage.mesh_stiffness
        stiffness = self.teeth.fine.mean if given is None else given
        with self.clock.stage("bodies"):
            from trochoid.drives.rv.bodies import build_level

            return build_level(self.design, facets, meshes, stiffness)

    @cached_property
    def _supporting(self) -> tuple[Level, CrankBearings] | None:
        """Rolling bearings of the crankshafts and the level on which their loads were found; None without them."""
        from trochoid.drives.rv.plan import rolls

        if not rolls(self.scene):
            return None
        given = self.scene.accuracy.facets_per_lobe
        facets, meshes = self.coarsest() if given is None else (first_given(given), None)
        level = self._bodies(facets, meshes)
        with self.clock.stage("supports"):
            from trochoid.drives.rv.bearings import crank_bearings

            return level, crank_bearings(self.feasible, level)

    @cached_property
    def rolling(self) -> tuple[Held, ...]:
        """Rolling bearings A and B of the crankshafts under the loads that the contacts gave."""
        table, found = self.scene.drive.crankshaft, self._supporting
        if table.bearing is None or not self.scene.has("bearing_compliance"):
            return ()
        solved = self.contact
        with self.clock.stage("supports"):
            from trochoid.drives.rv.bearings import under

            return under(self.design, solved.fine, None if found is None else found[1])

    @property
    def crank_stiffness(self) -> tuple[Array | None, Array | None]:
        """Stiffness (2, 2) of the bearings A and B as it was computed for the contacts, None where it is given, N/m."""
        if self._supporting is None:
            return None, None
        one, two = self._supporting[1].stiffness
        return one, two

    @cached_property
    def arm(self) -> Pair[ArmStiffness]:
        """Stiffness of a turning-arm bearing."""
        solved = self.contact
        with self.clock.stage("bearing"):
            from trochoid.drives.rv.seat import arm_stiffness

            both, levels = solved.pair, solved.levels
            fine = arm_stiffness(self.design, both.fine, levels.fine)
            if both.coarse is None or levels.coarse is None:
                return Pair(fine, None)
            return Pair(fine, arm_stiffness(self.design, both.coarse, levels.coarse))

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
        first, meshes = self.coarsest() if given is None else (first_given(given), None)
        built = {first: self.level(first, meshes)}
        angle = turn_angles(self.design, self.scene.ask.positions)
        solved: dict[int, Series] = {}

        def solve(rung: str, facets: int) -> Series:
            if facets not in built:
                built[facets] = self.level(facets)
            solved[facets] = self.series(built[facets], rung, angle[::STRIDE])
            return solved[facets]

        def best(rung: str | None) -> Chosen:
            return choose(
                accuracy.tolerance if given is None else float("inf"),
                doubled(first) if given is None else (first, given),
                solve,
                worst_error,
                lambda: self.model_error(built[first]),
                rung,
            )

        found, doubt = or_level0(best, accuracy.model)
        coarse, fine = found.levels[-2:]
        between = self.series(built[fine], found.rung, angle[[i % STRIDE > 0 for i in range(len(angle))]])
        whole = woven(solved[fine], between)
        return Solved(whole, Pair(solved[fine], solved[coarse]), Pair(built[fine], built[coarse]), doubt)

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
    def modes(self) -> NaturalModes:
        """Natural frequencies over a turn of the crankshafts."""
        return self._modes(self.contact.fine)

    @cached_property
    def mode_levels(self) -> Pair[NaturalModes]:
        """The same at every fourth position on both mesh levels."""
        both = self.contact.pair
        return Pair(self.modes, None) if both.coarse is None else both.map(self._modes)

    def _modes(self, series: Series) -> NaturalModes:
        parts = self.masses
        with self.clock.stage("modes"):
            from trochoid.drives.rv.modes import natural_modes

            return natural_modes(self.design, series, parts)

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
        """Vibration velocity of the casing."""
        return self._vibration(self.reactions, self.casing.fine)

    @cached_property
    def vibration_levels(self) -> Pair[CasingVibration]:
        """The same from the reactions and the casing on both mesh levels."""
        from trochoid.drives.vibration import on_levels

        both, casing = self.reaction_levels, self.casing
        if both.coarse is None and casing.coarse is None:
            return Pair(self.vibration, None)
        return on_levels(both, casing, self._vibration)

    def _vibration(self, found: Reactions, casing: Shaken) -> CasingVibration:
        with self.clock.stage("vibration"):
            from trochoid.drives.rv.vibration import casing_vibration

            return casing_vibration(self.design, found, casing)

"""The stages of a K-H-V run, each computed when it is first asked for; heavy imports are inside."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.casing import casing_reasons
from trochoid.drives.choosing import COARSEST, Chosen, coarsest, doubled, first_given, or_level0
from trochoid.drives.khv.design import Design, design
from trochoid.drives.mesh_error import Pair
from trochoid.kinematics.errors import Infeasible, SceneError
from trochoid.scene.drive_khv import KhvScene

if TYPE_CHECKING:
    from trochoid.drives.casing import Shaken
    from trochoid.drives.khv.bodies import Level
    from trochoid.drives.khv.field import DiscState
    from trochoid.drives.khv.load_path import LoadPath
    from trochoid.drives.khv.mass import Masses
    from trochoid.drives.khv.modes import NaturalModes
    from trochoid.drives.khv.reactions import Reactions
    from trochoid.drives.khv.running import Running
    from trochoid.drives.khv.seat import SeatStiffness
    from trochoid.drives.khv.series import Series
    from trochoid.drives.khv.torsional import Torsional
    from trochoid.drives.khv.vibration import CasingVibration
    from trochoid.drives.rolling import Held
    from trochoid.fem.position import ElasticBody
    from trochoid.fem.solid import SolidBody
    from trochoid.geometry.mesh import Mesh


@dataclass(frozen=True)
class Solved:
    """Contacts over a turn on the finer of two mesh levels, on the coarser one (None for rigid discs), and
    their levels; `doubt`: why the error of level 0 is not known.
    """

    fine: Series
    coarse: Series | None
    level: Level | None
    coarse_level: Level | None
    doubt: str = ""


@dataclass(frozen=True)
class Stages:
    """What a scene's quantities are made from; every stage is a value, computed once."""

    scene: KhvScene
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
            reasons = [*faults(made), *casing_reasons(self.scene)]
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
        """The contact model: named by the scene, or the cheapest that its tolerance allows."""
        return named_rung(self.scene) or self.contact.fine.rung

    def meshes(self, facets: int) -> tuple[Mesh, ...]:
        """Mesh the distinct discs."""
        made = self.feasible
        with self.clock.stage("mesh"):
            from trochoid.drives.khv.bodies import meshes

            return meshes(made, facets)

    def coarsest(self) -> tuple[int, tuple[Mesh, ...] | None]:
        """Return the coarsest level whose mesh thin walls allow, with its meshes; the finest without any."""
        return coarsest(COARSEST, self.meshes)

    def level(self, facets: int, made: tuple[Mesh, ...] | None = None) -> Level:
        """Build the discs on one mesh level, of which the meshes may be there already."""
        meshes = self.meshes(facets) if made is None else made
        with self.clock.stage("bodies"):
            from trochoid.drives.khv.bodies import build_level

            return build_level(self.design, facets, meshes, tangential=self.asks_friction)

    @property
    def asks_friction(self) -> bool:
        """Whether friction is listed and an answer follows it: only then discs are pressed along their flanks."""
        from trochoid.drives.khv.plan import STAGES_OF

        asked = {stage for name in self.scene.ask.quantities for stage in STAGES_OF[name]}
        return self.scene.friction is not None and bool({"torsion", "losses"} & asked)

    def rubbing(self, level: Level | None) -> tuple[ElasticBody, ...]:
        """Return the discs of a level for answers that follow friction, pressed along their flanks if it is listed."""
        if level is None:
            return ()
        if self.scene.friction is None or level.rubs:
            return level.elastic
        with self.clock.stage("bodies"):
            from trochoid.drives.khv.bodies import build_level

            return build_level(self.design, level.facets_per_lobe, level.meshes, tangential=True).elastic

    def series(self, level: Level | None, rung: str | None = None) -> Series:
        """Solve all positions on a level, or with rigid discs; on the scene's own rung unless another is named."""
        made, chosen = self.feasible, rung or self.rung
        with self.clock.stage("contact"):
            from trochoid.drives.khv.series import solve_series

            bodies = () if level is None else level.elastic
            return solve_series(made, chosen, bodies, self.scene.ask.positions)

    def model_error(self, level: Level) -> float:
        """Return how far level 0 is from strips."""
        made = self.feasible
        with self.clock.stage("contact"):
            from trochoid.drives.khv.choice import model_error

            return model_error(made, level)

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a turn, on the coarsest pair of levels whose estimated error meets the tolerance.

        Raises NotConverged when the finest pair does not.
        """
        rung, accuracy = named_rung(self.scene), self.scene.accuracy
        self.supported  # noqa: B018 - refuses what cannot hold before anything is meshed
        if rung == "springs":
            return Solved(self.series(None), None, None, None)
        from trochoid.drives.khv.choice import choose

        given = accuracy.facets_per_lobe
        first, meshes = self.coarsest() if given is None else (first_given(given), None)
        levels = (first, given) if given is not None else doubled(first)
        built = {first: self.level(first, meshes)}
        solved: dict[int, Series] = {}

        def solve(rung: str, facets: int) -> Series:
            if facets not in built:
                built[facets] = self.level(facets)
            solved[facets] = self.series(built[facets], rung)
            return solved[facets]

        tolerance = accuracy.tolerance if given is None else float("inf")

        def best(rung: str | None) -> Chosen:
            return choose(tolerance, levels, solve, lambda: self.model_error(built[first]), rung)

        found, doubt = or_level0(best, rung)
        coarse, fine = found.levels[-2:]
        return Solved(solved[fine], solved[coarse], built[fine], built[coarse], doubt)

    @cached_property
    def difference(self) -> float:
        """Largest relative difference of the two mesh levels among what the answers rest on; 0 without a mesh."""
        from trochoid.drives.khv.estimate import differences

        solved = self.contact
        return 0.0 if solved.coarse is None else max(differences(solved.fine, solved.coarse).values())

    @cached_property
    def load_path(self) -> Pair[LoadPath]:
        """Torque-twist loops at held input; on the coarser level at the first angle only, which tells the error."""
        solved, rung = self.contact, self.rung
        bodies, coarse = self.rubbing(solved.level), self.rubbing(solved.coarse_level)
        with self.clock.stage("torsion"):
            from trochoid.drives.khv.load_path import held_angles, load_path

            angles = held_angles(self.design)
            fine = load_path(self.design, rung, bodies, angles)
            if solved.coarse_level is None:
                return Pair(fine, None)
            return Pair(fine, load_path(self.design, rung, coarse, angles[:1]))

    @cached_property
    def losses(self) -> Pair[Running]:
        """The running drive with friction, at some positions of a turn."""
        solved, rung = self.contact, self.rung
        bodies, coarse = self.rubbing(solved.level), self.rubbing(solved.coarse_level)
        with self.clock.stage("losses"):
            from trochoid.drives.khv.running import run, running_angles

            angles = running_angles(self.scene.accuracy.tolerance)
            fine = run(self.design, rung, bodies, angles)
            if solved.coarse_level is None:
                return Pair(fine, None)
            return Pair(fine, run(self.design, rung, coarse, angles))

    @cached_property
    def supported(self) -> bool:
        """Whether rolling bearings hold shaft or flange; their stiffness is then found under their loads."""
        from trochoid.drives.khv.plan import rolls

        made = self.feasible
        if not rolls(self.scene):
            return False
        d = self.scene.drive
        if None not in (d.input_shaft.bearing_stiffness, d.output_flange.bearing_stiffness):
            return True
        with self.clock.stage("supports"):
            made.bearings  # noqa: B018 - solved once, and kept
        return True

    @cached_property
    def rolling(self) -> dict[str, tuple[Held, Held]]:
        """Rolling bearings A and B of shaft and flange under the loads that the contacts gave."""
        if not self.supported:
            return {}
        solved = self.contact
        with self.clock.stage("supports"):
            from trochoid.drives.khv.bearings import under

            return under(self.design, solved.fine)

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

            if solved.level is None:
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
    def modes(self) -> Pair[NaturalModes]:
        """Natural frequencies on the mean stiffness over the turn."""
        solved, masses = self.contact, self.masses
        with self.clock.stage("modes"):
            from trochoid.drives.khv.modes import natural_modes

            return Pair(solved.fine, solved.coarse).map(
                lambda series: natural_modes(self.design, series, masses)
            )

    @cached_property
    def torsional(self) -> Torsional | None:
        """Torsional vibration of the driven member, on the finer mesh level; None where it is free within its play."""
        if self.scene.ask.positions < 3:
            raise SceneError(
                f"torsional_vibration needs ask.positions of 3 or more, given {self.scene.ask.positions}: a harmonic "
                "takes three"
            )
        solved, masses = self.contact, self.masses
        with self.clock.stage("torsional"):
            from trochoid.drives.khv.torsional import pendulum, torsional

            if not (solved.fine.torsional_stiffness[:-1] > 0.0).all():
                return None
            made = pendulum(self.design, solved.fine, masses, self.scene.operation.damping_ratio)
            return torsional(made, self.design.crank_speed)

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
    def vibration(self) -> Pair[CasingVibration]:
        """Vibration velocity of the casing."""
        found, casing = self.reactions, self.casing
        with self.clock.stage("vibration"):
            from trochoid.drives.khv.vibration import casing_vibration
            from trochoid.drives.vibration import on_levels

            return on_levels(
                found, casing, lambda reactions, shaken: casing_vibration(self.design, reactions, shaken)
            )


def named_rung(scene: KhvScene) -> str | None:
    """Return the contact model that the scene names, by its effects or by accuracy.model; None leaves the choice."""
    return scene.accuracy.model if scene.has("elastic_contact") else "springs"

"""The stages of a run of a planetary set, each computed when it is first asked for; heavy imports are inside."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from trochoid.clock import Clock
from trochoid.drives.casing import casing_reasons
from trochoid.drives.choosing import POSITIONS, Chosen, choose, or_level0
from trochoid.drives.mesh_error import Pair
from trochoid.drives.planetary.design import Design, design
from trochoid.kinematics.errors import Infeasible, NotConverged, SceneError
from trochoid.kinematics.train import Speeds, planetary_train, speeds
from trochoid.scene.drive_planetary import PlanetaryScene

if TYPE_CHECKING:
    from trochoid.drives.casing import Shaken
    from trochoid.drives.planetary.blocking import Blocking
    from trochoid.drives.planetary.bodies import Level
    from trochoid.drives.planetary.contact import Load
    from trochoid.drives.planetary.face import Faces
    from trochoid.drives.planetary.mass import Masses
    from trochoid.drives.planetary.meshes import Meshes
    from trochoid.drives.planetary.modes import SetModes
    from trochoid.drives.planetary.moving import Moving
    from trochoid.drives.planetary.reactions import Reactions
    from trochoid.drives.planetary.rigid import Rigid
    from trochoid.drives.planetary.roots import Roots
    from trochoid.drives.planetary.series import Series
    from trochoid.drives.rolling import Held
    from trochoid.drives.vibration import CasingVibration
    from trochoid.fem.solid import SolidBody
    from trochoid.geometry.planetary_curves import Members

LEAST = 10
LEVELS = (6, 12, 24)  # facets per flank; with 4 the fillets of a ring are too coarse for its elements


@dataclass(frozen=True)
class Solved:
    """Contacts over a pitch on the finer of two mesh levels and on the coarser one, and these levels; `doubt`: why the
    error of level 0 is not known.
    """

    fine: Series
    coarse: Series | None
    level: Level
    coarse_level: Level | None
    doubt: str = ""


@dataclass(frozen=True)
class Stages:
    """What a scene's quantities are made from; every stage is a value, computed once."""

    scene: PlanetaryScene
    clock: Clock

    @cached_property
    def speeds(self) -> Speeds:
        """Speeds of all members over that of the driving one."""
        d = self.scene.drive
        with self.clock.stage("kinematics"):
            return speeds(planetary_train(d.z_sun, d.z_planet, d.z_ring), d.fixed, d.driving, d.driven)

    @cached_property
    def feasible(self) -> Design:
        """The set, once its geometry has been found possible; raises Infeasible with every reason."""
        from trochoid.drives.planetary.feasible import faults

        with self.clock.stage("geometry"):
            made = design(self.scene)
            reasons = [*faults(made), *casing_reasons(self.scene)]
            if reasons:
                raise Infeasible("\n".join(reasons))
        return made

    @cached_property
    def curves(self) -> Members:
        """Exact boundaries of sun, planet and ring."""
        from trochoid.geometry.planetary_curves import members

        made = self.feasible
        with self.clock.stage("profiles"):
            return members(made.given, made.rounding)

    @cached_property
    def blocking(self) -> Blocking:
        """Blocking contours, the coaxiality line and the best shifts on it."""
        from trochoid.drives.planetary.blocking import blocking

        made = self.feasible
        with self.clock.stage("blocking"):
            return blocking(made)

    @cached_property
    def masses(self) -> Masses:
        """Masses of sun, planet and ring from their exact outlines."""
        from trochoid.drives.planetary.mass import masses

        made, curves = self.feasible, self.curves
        with self.clock.stage("mass"):
            return masses(made, curves)

    @cached_property
    def rigid(self) -> Rigid:
        """Torques and forces of rigid members, all planets alike."""
        from trochoid.drives.planetary.rigid import rigid

        made, turning = self.feasible, self.speeds
        planet = self.masses.planet.mass if self.scene.has("inertia") else 0.0
        with self.clock.stage("forces"):
            return rigid(made, turning, planet)

    @property
    def rung(self) -> str:
        """The contact model: named by the scene, or the cheapest that its tolerance allows."""
        return self.contact.fine.rung

    @property
    def load(self) -> Load:
        """What the contacts carry; raises Infeasible without a torque."""
        from trochoid.drives.planetary.contact import Load

        found = self.rigid
        if found.torques["sun"] == 0.0:
            raise Infeasible("operation.output_torque = 0: no flank is pressed; take a torque above 0")
        return Load(found.torques[self.scene.drive.driven], found.torques["sun"], found.centrifugal)

    def level(self, facets: int) -> Level:
        """Mesh and press the wheels with so many facets per flank."""
        made, curves = self.feasible, self.curves
        with self.clock.stage("bodies"):
            from trochoid.drives.planetary.bodies import build_level

            return build_level(made, curves, facets)

    def series(self, level: Level, rung: str, positions: int | None = None) -> Series:
        """Solve positions over a pitch on a level."""
        made, turning, load = self.feasible, self.speeds, self.load
        with self.clock.stage("contact"):
            from trochoid.drives.planetary.contact import angles
            from trochoid.drives.planetary.series import solve_series

            at = angles(made, turning, positions or self.scene.ask.positions)
            return solve_series(made, turning, level, load, at, rung)

    def model_error(self, level: Level) -> float:
        """Return how far level 0 is from strips at a few positions; raises NotConverged where strips find nothing."""
        from trochoid.drives.planetary.estimate import model_error

        return model_error(*(self.series(level, rung, POSITIONS) for rung in ("level0", "strips")))

    @property
    def levels(self) -> tuple[int, ...]:
        """The mesh levels that a run may try: the coarser of two first. Raises SceneError for too few facets."""
        given = self.scene.accuracy.facets_per_lobe
        if given is not None and given < LEAST:
            raise SceneError(
                f"accuracy.facets_per_lobe: given {given}; a flank of a planetary set needs at least {LEAST}, for half "
                "of them tell the error"
            )
        return LEVELS if given is None else (given // 2, given)

    @cached_property
    def contact(self) -> Solved:
        """Contacts over a pitch, on the coarsest pair of levels whose estimated error meets the tolerance.

        Raises NotConverged when the finest pair does not.
        """
        from trochoid.drives.planetary.estimate import worst_error

        self.supported  # noqa: B018 - refuses what cannot hold before anything is meshed
        accuracy, levels, faults = self.scene.accuracy, self.levels, list[str]()
        built: dict[int, Level] = {}
        solved: dict[int, Series] = {}

        def on(facets: int) -> Level:
            if facets not in built:
                built[facets] = self.level(facets)
            return built[facets]

        if accuracy.facets_per_lobe is None:
            try:
                on(levels[0])
            except NotConverged:  # too coarse for this ring's fillets
                levels = levels[1:]

        def solve(rung: str, facets: int) -> Series:
            solved[facets] = self.series(on(facets), rung)
            return solved[facets]

        def off() -> float:
            return self.model_error(on(levels[0]))

        def best(rung: str | None) -> Chosen:
            tolerance = accuracy.tolerance if accuracy.facets_per_lobe is None else float("inf")
            return choose(tolerance, levels, solve, worst_error, off, rung)

        found, fault = or_level0(best, accuracy.model)
        faults.append(fault)
        coarse, fine = found.levels[-2:]
        return Solved(solved[fine], solved[coarse], built[fine], built[coarse], "".join(faults))

    @cached_property
    def difference(self) -> float:
        """Largest relative difference of the two mesh levels among what the answers rest on."""
        from trochoid.drives.planetary.estimate import differences

        solved = self.contact
        return 0.0 if solved.coarse is None else max(differences(solved.fine, solved.coarse).values())

    @cached_property
    def supported(self) -> bool:
        """Whether a rolling bearing holds each planet; its stiffness is then found under the planet's force."""
        from trochoid.drives.planetary.plan import rolls

        made = self.feasible
        if not rolls(self.scene):
            return False
        if self.scene.drive.planet.bearing_stiffness is not None:
            return True
        with self.clock.stage("supports"):
            made.planet_seat  # noqa: B018 - solved once, and kept
        return True

    @cached_property
    def rolling(self) -> tuple[Held, ...]:
        """Rolling bearing of each planet under its forces over a pitch."""
        if not self.supported:
            return ()
        solved = self.contact
        with self.clock.stage("supports"):
            from trochoid.drives.planetary.bearings import under

            return under(self.feasible, solved.fine)

    @cached_property
    def roots(self) -> Pair[Roots]:
        """Tension in the fillets of the loaded teeth."""
        solved = self.contact
        with self.clock.stage("stress"):
            from trochoid.drives.planetary.roots import roots

            fine = roots(self.feasible, self.speeds, solved.level, solved.fine)
            if solved.coarse is None or solved.coarse_level is None:
                return Pair(fine, None)
            return Pair(fine, roots(self.feasible, self.speeds, solved.coarse_level, solved.coarse))

    @cached_property
    def meshes(self) -> Pair[Meshes]:
        """Each mesh of one planet by itself, under its even share of the torque."""
        solved, load = self.contact, self.load
        with self.clock.stage("meshes"):
            from trochoid.drives.planetary.meshes import meshes

            def made(level: Level) -> Meshes:
                return meshes(self.feasible, level, load, self.scene.ask.positions)

            return Pair(
                made(solved.level), None if solved.coarse_level is None else made(solved.coarse_level)
            )

    @cached_property
    def faces(self) -> Pair[Faces]:
        """Load over the face width of both meshes of one planet; on the coarser level with half of the slices."""
        solved, load = self.contact, self.load
        with self.clock.stage("face"):
            from trochoid.drives.planetary.face import faces

            def made(level: Level, coarser: bool) -> Faces:
                return faces(self.feasible, level, load, self.scene.ask.positions, coarser)

            coarse = None if solved.coarse_level is None else made(solved.coarse_level, True)
            return Pair(made(solved.level, False), coarse)

    @cached_property
    def moving(self) -> Pair[Moving]:
        """The set as a system with mass, and the stiffness of its meshes at every position."""
        solved, masses = self.contact, self.masses
        with self.clock.stage("dynamics"):
            from trochoid.drives.planetary.moving import moving

            def made(series: Series, level: Level) -> Moving:
                return moving(self.feasible, self.speeds, masses, series, level)

            fine = made(solved.fine, solved.level)
            if solved.coarse is None or solved.coarse_level is None:
                return Pair(fine, None)
            return Pair(fine, made(solved.coarse, solved.coarse_level))

    @cached_property
    def reactions(self) -> Pair[Reactions]:
        """Forces of the moving set over a pitch."""
        set_, solved, damping = self.moving, self.contact, self.scene.operation.damping_ratio
        with self.clock.stage("reactions"):
            from trochoid.drives.planetary.reactions import reactions

            fine = reactions(set_.fine, solved.fine, damping)
            if set_.coarse is None or solved.coarse is None:
                return Pair(fine, None)
            return Pair(fine, reactions(set_.coarse, solved.coarse, damping))

    @cached_property
    def modes(self) -> Pair[SetModes]:
        """Natural frequencies on the mean stiffness over a pitch."""
        set_ = self.moving
        with self.clock.stage("modes"):
            from trochoid.drives.planetary.modes import natural_modes

            return set_.map(natural_modes)

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
            from trochoid.drives.planetary.vibration import casing_vibration
            from trochoid.drives.vibration import on_levels

            return on_levels(
                found,
                casing,
                lambda reactions, shaken: casing_vibration(self.feasible, self.speeds, reactions, shaken),
            )

    @property
    def moves(self) -> bool:
        """Whether the reactions are those of elastic wheels with mass."""
        return self.scene.has("elastic_contact") and self.scene.has("inertia")

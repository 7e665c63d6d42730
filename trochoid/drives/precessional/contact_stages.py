"""From a scene to its solved contacts: mesh levels, the choice among them, and what holds the satellite's axis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.choosing import choose
from trochoid.drives.mesh_error import sampling_error
from trochoid.drives.precessional.contact import Series, inertia_moment, pitch_angles, solve_series
from trochoid.drives.precessional.estimate import differences, worst_error
from trochoid.drives.precessional.teeth import LEAST, Level, build_level
from trochoid.kinematics.errors import SceneError
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.clock import Clock
    from trochoid.drives.precessional.bearings import Joints
    from trochoid.drives.precessional.design import Design

MODEL = "slices"
LEVELS = (8, 16, 32)  # facets of a tooth
UNIT = "facets per tooth"
SLIGHT = 0.03  # of the output torque: where lost motion is read
PLAY_POSITIONS = 24  # of a pitch, at the most, for lost motion


@dataclass(frozen=True, eq=False, slots=True)
class Solved:
    """Contacts over a pitch on the finer of two mesh levels and on the coarser one, and these levels.

    None for the coarser one where a level is solved alone.
    """

    fine: Series
    coarse: Series | None
    level: Level
    coarse_level: Level | None

    @property
    def difference(self) -> float:
        """Largest relative difference of the levels among what the answers rest on."""
        return 0.0 if self.coarse is None else max(differences(self.fine, self.coarse).values())


@dataclass(frozen=True, eq=False, slots=True)
class Slack:
    """Mean angle (rad) of the output under +3 % less that under −3 % of its torque, on both levels.

    `few` is the error for the few positions of the mean.
    """

    fine: float
    coarse: float | None
    few: float = 0.0


@dataclass(frozen=True)
class Teeth:
    """The elastic teeth of a design; `joints` are given where bearings yield."""

    design: Design
    clock: Clock
    joints: Joints | None = None

    @cached_property
    def tilt_stiffness(self) -> float | None:
        """Stiffness (N·m/rad) of the satellite's axis against tilting about O: A and the shaft on B in series.

        None where all of it is rigid.
        """
        if self.joints is None:
            return None
        drive = self.design.scene.drive
        arm = drive.satellite.bearing_distance
        lever = drive.input_shaft.bearing_distance - arm * self.design.nutation.axis[2]
        soft = 0.0
        for stiffness, factor in (
            (_mean(self.joints.a.stiffness, 0), 1.0),
            (_mean(self.joints.b.stiffness, 0), 1.0),
            (_mean(self.joints.b.stiffness, 3), lever**2),
        ):
            if stiffness > 0.0:
                soft += factor / stiffness
        return arm**2 / soft if soft > 0.0 else None

    def level(self, facets: int) -> Level:
        """Build the bodies with so many facets on a tooth."""
        with self.clock.stage("bodies"):
            return build_level(self.design, facets)

    def series(self, level: Level, torque: float, positions: int) -> Series:
        """Solve positions over a pitch."""
        crank = pitch_angles(self.design, positions)
        return solve_series(self.design, level, torque, crank, self.tilt_stiffness)

    @property
    def levels(self) -> tuple[int, ...]:
        """Mesh levels that a run may try, the coarser of two first; raises SceneError for too few facets."""
        given = self.design.scene.accuracy.facets_per_lobe
        if given is not None and given < LEAST:
            raise SceneError(
                f"accuracy.facets_per_lobe: given {given}; a sphere tooth needs at least {LEAST}, for half of them "
                "tell the error"
            )
        return LEVELS if given is None else (given // 2, given)

    def solved(self) -> Solved:
        """Solve on the coarsest pair of levels whose estimated error meets the tolerance; raises NotConverged."""
        scene = self.design.scene
        built: dict[int, Level] = {}
        found: dict[int, Series] = {}

        def solve(_: str, facets: int) -> Series:
            built[facets] = self.level(facets)
            with self.clock.stage("contact"):
                found[facets] = self.series(built[facets], scene.operation.output_torque, scene.ask.positions)
            return found[facets]

        tolerance = scene.accuracy.tolerance if scene.accuracy.facets_per_lobe is None else float("inf")
        coarse, fine = choose(tolerance, self.levels, solve, worst_error, lambda: 0.0, MODEL, UNIT).levels[
            -2:
        ]
        return Solved(found[fine], found[coarse], built[fine], built[coarse])

    def alone(self, level: Level) -> Solved:
        """Solve on one level, without an estimate of its error."""
        scene = self.design.scene
        with self.clock.stage("contact"):
            series = self.series(level, scene.operation.output_torque, scene.ask.positions)
            return Solved(series, None, level, None)

    def running(self, solved: Solved) -> Series:
        """Solve a pitch again with the satellite's inertia at the speed of operation, at fewer positions."""
        count = min(PLAY_POSITIONS, self.design.scene.ask.positions)
        with self.clock.stage("contact"):
            crank = pitch_angles(self.design, count)
            moment = inertia_moment(self.design)
            return solve_series(
                self.design, solved.level, solved.fine.torque, crank, self.tilt_stiffness, moment
            )

    def slack(self, solved: Solved) -> Slack:
        """Turn the output both ways under a small torque."""
        scene = self.design.scene
        torque, count = SLIGHT * scene.operation.output_torque, min(PLAY_POSITIONS, scene.ask.positions)

        def between(level: Level) -> Array:
            ways = [self.series(level, sign * torque, count).lag for sign in (1.0, -1.0)]
            return np.asarray(ways[0] - ways[1])

        def thinned(stride: int) -> list[Array]:
            return [fine[start::stride] for start in range(stride)] if count >= stride else []

        with self.clock.stage("lost motion"):
            coarse, fine = solved.coarse_level, between(solved.level)
            few = sampling_error(lambda x: float(x.mean()), fine, thinned)
            return Slack(float(fine.mean()), None if coarse is None else float(between(coarse).mean()), few)


def _mean(stiffness: Array, first: int) -> float:
    """Return the mean stiffness across an axis: of the motions `first` and the next."""
    return 0.5 * float(stiffness[first, first] + stiffness[first + 1, first + 1])

"""Everything an indexer's run hands over: quantities, series, pictures, checks, warnings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from trochoid.drives.indexer import headline
from trochoid.drives.indexer.design import SHOWN
from trochoid.drives.indexer.plan import WHY
from trochoid.drives.indexer.stages import Stages
from trochoid.kinematics.indexer import motion
from trochoid.results.outcome import Check, Outcome, Quantity, Stage

EXACT = 1e-9


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran = tuple(stages.clock.seconds)
    made = Outcome(
        scene=stages.scene.model_dump(mode="json"),
        quantities=quantities,
        not_needed=tuple(name for name in WHY if name not in ran),
        title=headline.title(stages),
        facts=headline.facts(stages),
        not_simulated=headline.not_simulated(stages.scene),
        checks=checks(stages, ran),
        warnings=warnings(stages, ran),
    )
    if "motion" in ran or "geometry" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.indexer.dataset import dataset
            from trochoid.drives.indexer.picture import plots

            made = replace(made, dataset=dataset(stages, ran), plots=plots(stages, ran))
    if "geometry" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.indexer.plane import drawing

            made = replace(made, drawing=drawing(stages))
    seconds = stages.clock.seconds
    return replace(made, stages=tuple(Stage(name, seconds[name]) for name in seconds))


def checks(stages: Stages, ran: tuple[str, ...]) -> tuple[Check, ...]:
    """Return what the synthesis promised, measured on the mechanism, and the balance of power."""
    made = stages.design.indexer
    at = motion(made, made.half_turn * np.linspace(-1.0, 1.0, 1441))
    top = float(np.abs(at.velocity).max())
    ends = float(np.abs(at.velocity[[0, -1]]).max()) / top
    swing = abs(made.swing - stages.scene.drive.swing_angle)
    back = max(0.0, -float((at.velocity * made.sense).min())) / top
    found = [
        _check("no hard shock: speed of the wheel at both ends over its peak", ends),
        _check("swing of the wheel as asked, rad", swing),
        _check("the wheel never turns back, speed over its peak", back),
    ]
    if "forces" in ran:
        found += [
            _check(f"power in = power out + kinetic, {SHOWN[name]}", forces.residual())
            for name, forces in stages.forces.items()
        ]
    return tuple(found)


def _check(name: str, value: float) -> Check:
    return Check(name, value, EXACT, bool(value <= EXACT))


def warnings(stages: Stages, ran: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a reader must know before trusting the numbers."""
    made, said = stages.design, list[str]()
    if not made.closes:
        turns = 360.0 / math.degrees(made.drive.swing_angle)
        said.append(
            f"{turns:.4g} swings make a turn of the wheel: it can index on and on in one sense only if a whole "
            f"number does, as with swing_angle = {360.0 / max(1, round(turns)):.7g}"
        )
    if "geometry" not in ran:
        return tuple(said)
    travel, within = stages.slots["indexer"], made.drive.dwell_tolerance
    if travel.farthest > travel.entry:
        said.append(
            f"in mid-index the pin is {1e3 * made.drive.sphere_radius * (travel.farthest - travel.entry):.3g} mm "
            f"farther from the wheel's axis than at its ends: a rim that holds it there meets the pin before the "
            f"index, {1e3 * made.drive.sphere_radius * travel.offset:.3g} mm off the middle of the slot, and turns "
            f"the resting wheel by {math.degrees(travel.disturbance):.3g}°"
            + (
                f", more than dwell_tolerance = {math.degrees(within):g}°"
                if travel.disturbance > within
                else ""
            )
        )
    return tuple(said)

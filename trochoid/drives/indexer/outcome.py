"""Everything an indexer's run hands over: quantities, series, pictures, checks, warnings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from trochoid.drives.gathering import begun, timed
from trochoid.drives.indexer import headline
from trochoid.drives.indexer.design import SHOWN
from trochoid.drives.indexer.plan import WHY
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.words import NAMES
from trochoid.kinematics.indexer import motion
from trochoid.results.outcome import Check, Outcome, Quantity

EXACT = 1e-9
MARCHED = 1e-3
WIDE = 0.2  # of the pin's radius, half width of a contact up to which it is Hertz's
LEFT = 0.01  # of the amplitude, left when the next index starts


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran = tuple(stages.clock.seconds)
    made = begun(stages, quantities, WHY, headline, headline.not_simulated(stages.scene))
    made = replace(made, checks=checks(stages, ran), warnings=warnings(stages, ran))
    if "motion" in ran or "geometry" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.indexer.dataset import dataset
            from trochoid.drives.indexer.picture import plots

            made = replace(made, dataset=dataset(stages, ran), plots=plots(stages, ran))
    if "geometry" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.indexer.plane import drawing

            made = replace(made, drawing=drawing(stages))
    if "contact" in ran:
        from trochoid.drives.indexer.films import contact_film

        pair, facets = stages.pairs["indexer"], stages.bodies.facets
        film = contact_film(stages.design, stages.slots["indexer"], pair, facets)
        made = replace(made, films=(film, *made.films))
    return timed(made, stages.clock)


def checks(stages: Stages, ran: tuple[str, ...]) -> tuple[Check, ...]:
    """Return what the synthesis promised, measured on the mechanism, and the balance of power."""
    made = stages.design.indexer
    at = motion(made, made.half_turn * np.linspace(-1.0, 1.0, 1441))
    top = float(np.abs(at.velocity).max())
    ends = float(np.abs(at.velocity[[0, -1]]).max()) / top
    swing = abs(made.swing - stages.scene.drive.swing_angle)
    back = max(0.0, -float((at.velocity * made.sense).min())) / top
    found = [
        Check.within("no hard shock: speed of the wheel at both ends over its peak", ends, EXACT),
        Check.within("swing of the wheel as asked, rad", swing, EXACT),
        Check.within("the wheel never turns back, speed over its peak", back, EXACT),
    ]
    if "forces" in ran:
        found += [
            Check.within(f"power in = power out + kinetic, {SHOWN[name]}", forces.residual(), EXACT)
            for name, forces in stages.forces.items()
        ]
    if "reactions" in ran:
        found += [
            Check.within(
                f"power in = power at the pin, {SHOWN[name]}, elastic", x["elastic"].residual(), EXACT
            )
            for name, x in stages.reactions.items()
            if "elastic" in x
        ]
    if "vibration" in ran and stages.response[0]:
        found += [
            Check.within(f"work of the pin = energy and losses, {NAMES[name]}", x.balance, MARCHED)
            for name, x in stages.shaken.items()
        ]
    return tuple(found)


def warnings(stages: Stages, ran: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a reader must know before trusting the numbers."""
    made, said = stages.design, list[str]()
    if not made.closes:
        turns = 360.0 / math.degrees(made.drive.swing_angle)
        said.append(
            f"{turns:.4g} swings make a turn of the wheel: it can index on and on in one sense only if a whole "
            f"number does, as with swing_angle = {360.0 / max(1, round(turns)):.7g}"
        )
    if "contact" in ran and stages.refusal:
        said.append(
            f"the slotted wheel could not be meshed or pressed ({stages.refusal}); it counts as rigid: pin and wall "
            "yield as half-spaces"
        )
    if "contact" in ran:
        said += _mesh_warnings(stages) + _elastic_warnings(stages, ran)
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


def _mesh_warnings(stages: Stages) -> list[str]:
    """Say where two meshes differ by more than the tolerance."""
    accuracy = stages.scene.accuracy
    if stages.refusal or stages.bodies.coarse is None or accuracy.facets_per_lobe is not None:
        return []
    worst = {name: x.differences["stiffness"] for name, x in stages.pairs.items() if x.coarse is not None}
    return [
        f"{NAMES[name]}: two meshes suggest an error of {100.0 * off:.2g} % in stiffness, more than "
        f"accuracy.tolerance = {accuracy.tolerance:g}, on the finest mesh that a run takes by itself; "
        "accuracy.facets_per_lobe may name a finer one"
        for name, off in worst.items()
        if off > accuracy.tolerance
    ]


def _elastic_warnings(stages: Stages, ran: tuple[str, ...]) -> list[str]:
    """Say where contact and vibration are beyond what they are made for."""
    said = []
    for name, pair in stages.pairs.items():
        if pair.largest[0] == 0.0:
            continue
        pressed = pair.at_largest
        wide, along = float(pressed.half_width.max()), float(pressed.along.max())
        if wide > WIDE * pair.pin.radius:
            said.append(
                f"{NAMES[name]}: the contact's half width of {1e3 * wide:.3g} mm is no small part of pin_radius = "
                f"{1e3 * pair.pin.radius:.4g} mm: pressure and stiffness are Hertz's, for narrow contacts"
            )
        if along > 0.5 * pair.pin.thickness:
            said.append(
                f"{NAMES[name]}: the contact would be {2e3 * along:.3g} mm long on a wheel of "
                f"{1e3 * pair.pin.thickness:.4g} mm; it presses at its ends: take a smaller pin.crown_radius"
            )
    if "vibration" in ran and stages.response[0]:
        said += [
            f"{NAMES[name]}: {100.0 * x.left:.2g} % of the residual vibration are left when the next index starts; "
            "each index is computed from rest"
            for name, x in stages.shaken.items()
            if x.left > LEFT
        ]
    return said

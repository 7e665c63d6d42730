"""Everything an indexer's run hands over: quantities, series, pictures, checks, warnings."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from trochoid.drives.casing_doubt import casing_warnings
from trochoid.drives.gathering import begun, timed
from trochoid.drives.indexer import headline
from trochoid.drives.indexer.design import INDEXER, SHOWN
from trochoid.drives.indexer.plan import WHY
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.warned import WIDE, march_warnings
from trochoid.drives.indexer.words import NAMES
from trochoid.drives.planning import with_casing
from trochoid.drives.vibration_answers import casing_checks
from trochoid.kinematics.indexer import motion
from trochoid.kinematics.readable import readable
from trochoid.results.outcome import Check, Outcome, Quantity

EXACT = 1e-9
MARCHED = 1e-3


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran = tuple(stages.clock.seconds)
    why, _ = with_casing(stages.scene, WHY, {})
    made = begun(stages, quantities, why, headline, headline.not_simulated(stages.scene))
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
    if "march" in ran and stages.response[0]:
        found += [
            Check.within(f"work of the pin = energy and losses, {NAMES[name]}", x.balance, MARCHED)
            for name, x in stages.shaken.items()
        ]
    if "vibration" in ran:
        found += _casing_checks(stages)
    return tuple(found)


def _casing_checks(stages: Stages) -> list[Check]:
    """Return the balances of what is put on the casing."""
    from trochoid.drives.indexer.casing_loads import inertia_residual
    from trochoid.drives.vibration import RIGID

    loads = stages.casing_loads.fine
    off = inertia_residual(stages.forces[INDEXER], loads.cycles[RIGID])
    found = [
        Check.within(
            "rigid loads on the casing sum to the wheel's inertia and the friction torque", off, EXACT
        ),
        Check.within(
            "loads on the casing sum to the torque on the wheel, by every model", loads.residual, EXACT
        ),
    ]
    return [*found, *casing_checks(stages.vibration.fine)]


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
    if "vibration" in ran:
        said += stages.vibration.fine.elastic.warnings
        said += casing_warnings(stages.scene, stages.vibration)
        said += _followed(stages)
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


def _followed(stages: Stages) -> list[str]:
    """Say where the casing is shaken by less than the march of a whole cycle."""
    marched, why = stages.response
    if why:
        return [f"the casing is shaken by the rigid drive alone: {why}"]
    short = {name: x.followed for name, x in marched.items() if name in SHOWN} if marched else {}
    return [
        f"{NAMES[name]}: the march follows {readable(100.0 * part)} % of the dwell; the rest shakes the casing no more"
        for name, part in short.items()
        if part < 1.0
    ]


def _mesh_warnings(stages: Stages) -> list[str]:
    """Say where two meshes differ by more than the tolerance."""
    accuracy = stages.scene.accuracy
    if stages.refusal or stages.bodies.coarse is None or accuracy.facets_per_lobe is not None:
        return []
    worst = {name: x.differences["stiffness"] for name, x in stages.pairs.items() if x.coarse is not None}
    return [
        f"{NAMES[name]}: two meshes suggest an error of {readable(100.0 * off, 2)} % in stiffness, more than "
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
                f"{NAMES[name]}: the contact's half width of {readable(1e3 * wide)} mm is no small part of "
                f"pin_radius = {readable(1e3 * pair.pin.radius, 4)} mm: pressure and stiffness are Hertz's, "
                "for narrow contacts"
            )
        if along > 0.5 * pair.pin.thickness:
            said.append(
                f"{NAMES[name]}: the contact would be {readable(2e3 * along)} mm long on a wheel of "
                f"{readable(1e3 * pair.pin.thickness, 4)} mm; it presses at its ends: take a smaller pin.crown_radius"
            )
    if "march" in ran and stages.response[0]:
        said += march_warnings(stages.shaken)
    return said

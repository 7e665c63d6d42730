"""Everything a precessional run hands over: quantities, series, pictures, checks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from trochoid.drives.casing_doubt import casing_warnings
from trochoid.drives.gathering import begun, timed
from trochoid.drives.planning import with_casing
from trochoid.drives.precessional import headline
from trochoid.drives.precessional.plan import ELASTIC, WHY
from trochoid.drives.precessional.stages import Stages
from trochoid.drives.vibration_answers import casing_checks
from trochoid.results.outcome import Check, Outcome, Quantity

BALANCE = 1e-9
ENERGY = 1e-6
PENETRATION = 1e-12  # rad
SOLVED = 1e-9  # of the largest approach


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran, elastic = tuple(stages.clock.seconds), stages.scene.has("elastic_contact")
    why, _ = with_casing(stages.scene, WHY, {})
    words = begun(
        stages,
        quantities,
        [name for name in why if elastic or name not in ELASTIC],
        headline,
        headline.not_simulated(stages.scene),
    )
    words = replace(words, checks=checks(stages, ran), warnings=tuple(warnings(stages)))
    if "vibration" in ran:
        doubts = casing_warnings(stages.scene, stages.vibration_levels)
        words = replace(words, warnings=(*words.warnings, *doubts))
    if "reactions" in ran:
        words = replace(words, notes=headline.notes(stages))
    if {"penetration", "contact", "reactions", "vibration", "modes"} & set(ran) or "profile" in quantities:
        words = replace(words, **_pictures(stages, ran, "profile" in quantities))
    return timed(words, stages.clock)


def _pictures(stages: Stages, ran: tuple[str, ...], profile: bool) -> dict[str, Any]:
    """Return the series of what ran and the pictures of the drive."""
    with stages.clock.stage("figures"):
        from trochoid.drives.precessional.dataset import dataset
        from trochoid.drives.precessional.picture import space, undercut_map

        drawn = space(stages.design)
        if "contact" in ran and stages.contact is not None:
            from trochoid.drives.precessional.picture_contact import with_forces

            drawn = with_forces(drawn, stages.design, stages.contact.fine)
        tooth = stages.design.tooth
        maps = () if tooth is None or "penetration" not in ran else (undercut_map(tooth),)
        made: dict[str, Any] = {"dataset": dataset(stages, ran, profile), "plots": (drawn, *maps)}
        if "modes" in ran:
            from trochoid.drives.precessional.mode_shapes import films

            made["plots"] = (drawn, *maps, stages.modes.campbell)
            made["films"] = films(stages.design, stages.modes)
        if "contact" in ran and stages.contact is not None:
            from trochoid.drives.precessional.films import contact_film

            film = contact_film(stages.design, stages.contact)
            made["films"] = (film, *made.get("films", ()))
        return made


def checks(stages: Stages, ran: tuple[str, ...]) -> tuple[Check, ...]:
    """Return the balances of what was computed."""
    found = []
    if "penetration" in ran and stages.penetration is not None:
        found.append(
            Check.within("no pin cuts into a flank at any input angle (rad)", stages.penetration, PENETRATION)
        )
    if "reactions" in ran:
        from trochoid.drives.precessional.turn import residual

        off = residual(stages.mechanism, stages.design.speed, stages.reactions["rigid"])
        found.append(Check.within("rigid reactions on the casing sum to the members' inertia", off, BALANCE))
    if "contact" in ran and stages.contact is not None:
        from trochoid.drives.precessional.tooth_loads import power_residual, spin_residual, tooth_loads

        series = stages.contact.fine
        loads = tooth_loads(stages.design, series)
        power = power_residual(stages.design, series, loads)
        found += [
            Check.within(
                "teeth and rollers neither overlap nor part where pressed",
                float(series.residual.max()),
                SOLVED,
            ),
            Check.within("teeth turn the satellite as the output holds it", spin_residual(series), BALANCE),
            Check.within("power goes out or into pressed teeth", power, BALANCE),
        ]
    if "reactions" in ran and stages.elastic is not None:
        from trochoid.drives.precessional.turn import elastic_residual

        moved = stages.elastic
        off = elastic_residual(stages.reactions["elastic"], moved)
        found.append(
            Check.within("elastic reactions on the casing sum to the members' inertia", off, BALANCE)
        )
        unmet = abs(moved.power - moved.loss) / moved.loss if moved.loss > 0.0 else 0.0
        found.append(Check.within("work on the elastic motion is what damping takes", unmet, ENERGY))
    if "vibration" in ran:
        found += casing_checks(stages.vibration)
    return tuple(found)


def warnings(stages: Stages) -> Iterator[str]:
    """Yield what the scene gives and no listed effect heeds, and pressures that no edge can have."""
    scene = stages.scene
    rollers = scene.drive.rollers
    if not scene.has("elastic_contact"):
        given = [name for name in ("rollers", "rim") if getattr(scene.drive, name).model_fields_set]
        given += ["accuracy"] if scene.accuracy != type(scene.accuracy)() else []
        if given:
            yield f'the tables {", ".join(given)} do nothing without the effect "elastic_contact"'
        return
    ignored = [name for name in ("crown", "clearance", "tilt", "skew") if getattr(rollers, name) != 0.0]
    if ignored and not scene.has("clearance"):
        yield f'{" and ".join(ignored)} of the rollers do nothing without the effect "clearance"'
    if rollers.seat_stiffness is not None and not scene.has("pin_compliance"):
        yield 'the seat_stiffness of the rollers does nothing without the effect "pin_compliance": they stand rigidly'
    if rollers.bore_angle is not None and not scene.has("pin_compliance"):
        yield 'the bore of the rollers does nothing without the effect "pin_compliance": they are rigid'
    if "contact" in stages.clock.seconds and stages.contact is not None:
        from trochoid.drives.precessional.answers_contact import EDGE
        from trochoid.drives.precessional.overload import doubts

        if stages.contact.fine.edge.any():
            yield EDGE
        if stages.wedged is not None:
            from trochoid.drives.precessional.wedging import said

            yield said(stages.design, stages.wedged)
        yield from doubts(stages.contact.fine, stages.wedged is not None)

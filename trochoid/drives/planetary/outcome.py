"""Everything a run of a planetary set hands over: quantities, pictures, checks, warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from trochoid.drives.casing_doubt import casing_warnings
from trochoid.drives.choosing import doubtful, unheeded
from trochoid.drives.gathering import begun, timed
from trochoid.drives.planetary import headline
from trochoid.drives.planetary.plan import ELASTIC, WHY, rolls
from trochoid.drives.planetary.stages import Stages
from trochoid.drives.planning import with_casing, with_supports
from trochoid.drives.vibration_answers import casing_checks
from trochoid.results.outcome import Check, Outcome, Quantity

BALANCE = 1e-9
NOTICED = 1e-8  # m of play that is worth a word
NEAR_RESONANCE = 5.0  # times the answer to a force that rests


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but what the figures need."""
    ran, elastic = tuple(stages.clock.seconds), stages.scene.has("elastic_contact")
    why, _ = with_supports(rolls(stages.scene), *with_casing(stages.scene, WHY, {}))
    words = begun(
        stages,
        quantities,
        [name for name in why if elastic or name not in ELASTIC],
        headline,
        headline.not_simulated(stages.scene),
    )
    if "geometry" in ran:
        words = replace(words, warnings=tuple(warnings(stages)))
    if "contact" in ran:
        words = replace(words, checks=(*checks(stages), *contact_checks(stages)))
    elif "forces" in ran:
        words = replace(words, checks=checks(stages))
    if "profiles" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.planetary.dataset import dataset
            from trochoid.drives.planetary.picture import drawing
            from trochoid.drives.planetary.plots import plots

            words = replace(
                words, dataset=dataset(stages, ran), drawing=drawing(stages), plots=plots(stages, ran)
            )
            if "modes" in ran:
                from trochoid.drives.planetary.mode_shapes import films

                shown = films(stages.feasible, stages.curves, stages.moving.fine, stages.modes.fine)
                words = replace(words, films=shown)
    elif "blocking" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.planetary.dataset import blocking_dataset
            from trochoid.drives.planetary.plots import plots

            words = replace(words, dataset=blocking_dataset(stages), plots=plots(stages, ran))
    return timed(words, stages.clock)


def checks(stages: Stages) -> tuple[Check, ...]:
    """Return the balances of the members."""
    torque, power = stages.rigid.residuals
    return (
        Check.within("torques of the members balance", torque, BALANCE),
        Check.within("power in is power out", power, BALANCE),
    )


def contact_checks(stages: Stages) -> tuple[Check, ...]:
    """Return the balances of what was solved, recomputed from the forces on the teeth."""
    from trochoid.drives.planetary import balance

    series = stages.contact.fine
    found = {
        "no flank penetrates": series.penetration,
        "contact problem is solved": series.imbalance,
        "every planet is in equilibrium": balance.planet_residual(series),
        "the driven member carries its load": balance.load_residual(series),
        "torques about the main axis balance": balance.torque_residual(series),
        "power goes out or into pressed teeth": balance.power_residual(series, stages.speeds),
    }
    if series.layout.floating:
        found["bearings hold what the teeth press"] = balance.seat_residual(stages.feasible, series)
    if "reactions" in stages.clock.seconds:
        moved = stages.reactions.fine
        found["teeth of the moving set press each other alike"] = moved.balance
        found["forces of the moving set are its inertia"] = moved.seats
        found["work of the moving set is what damping takes"] = moved.work
    made = [Check.within(name, value, BALANCE) for name, value in found.items()]
    if "vibration" in stages.clock.seconds:
        made += casing_checks(stages.vibration.fine)
    return tuple(made)


def warnings(stages: Stages) -> Iterator[str]:
    """Yield what a reader must know before trusting the numbers."""
    made = stages.feasible
    set_, x = made.geometry, made.given.shifts
    for who, pair, have, need, key, fit in (
        ("sun and planet", set_.outer, x[0] + x[1], made.sums[0], "x_planet", made.sums[0] - x[0]),
        ("planet and ring", set_.inner, x[2] - x[1], made.sums[1], "x_ring", made.sums[1] + x[1]),
    ):
        play = float(pair.backlash)
        if abs(play) < NOTICED:
            continue
        said = f"{1e6 * abs(play):.2g} µm {'of play' if play > 0.0 else 'too tight, back flanks overlap'}"
        yield (
            f"{who}: the shifts' sum is {have:.6g}, and the centre distance asks for {need:.7g}: {said} along the line "
            f"of action; {key} = {fit:.7g} meshes without play"
        )
    from trochoid.geometry.planetary_quality import quality

    radial = quality(made.geometry, made.limits)["radial assembly of planet and ring"]
    if not radial.fulfilled:
        yield "planets cannot be pushed into the ring radially, only along the axis"
    yield from _unheeded(stages)
    yield from _moving(stages)
    if "contact" in stages.clock.seconds:
        yield from doubtful(stages.contact.doubt)


def _moving(stages: Stages) -> Iterator[str]:
    """Yield what the reactions of the moving set do not cover."""
    ran = stages.clock.seconds
    if "reactions" in ran:
        found = stages.reactions.fine
        if found.separation:
            yield (
                "flanks would part in the moving set: the force of a mesh falls below nothing, and its equations keep "
                "them together; more torque, more damping or another speed would hold them"
            )
        if found.resonance is not None and found.resonance.factor > NEAR_RESONANCE:
            peak = found.resonance
            yield (
                f"near resonance: harmonic {peak.harmonic} of the mesh frequency ({peak.frequency:.4g} Hz) meets the "
                f"mode at {peak.natural_frequency:.4g} Hz, which answers {peak.factor:.3g} times as much as to a force "
                "that rests; the result rests on the damping ratio"
            )
    if "vibration" in ran:
        yield from stages.vibration.fine.elastic.warnings
        yield from casing_warnings(stages.scene, stages.vibration)


def _unheeded(stages: Stages) -> Iterator[str]:
    """Yield what the scene gives and no listed effect heeds."""
    scene, d = stages.scene, stages.scene.drive
    yield from unheeded(scene)
    if not scene.has("elastic_contact"):
        return
    reliefs = (d.sun.tip_relief, d.planet.tip_relief, d.ring.tip_relief)
    for given, effect, what in (
        (any(reliefs), "clearance", "tip relief"),
        (any(d.planet.position_errors), "position_errors", "position errors of planets"),
    ):
        if given and not scene.has(effect):
            yield f'the scene gives {what}, but the effect "{effect}" is not listed: it is not in the gaps'

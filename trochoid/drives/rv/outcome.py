"""Everything an RV run hands over: quantities, series, drawing, checks, warnings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from trochoid.drives.casing import is_elastic
from trochoid.drives.casing_doubt import casing_warnings
from trochoid.drives.choosing import doubtful, unheeded
from trochoid.drives.gathering import begun, timed
from trochoid.drives.rv import headline
from trochoid.drives.rv.plan import why
from trochoid.drives.rv.stages import Stages
from trochoid.drives.vibration_answers import casing_checks
from trochoid.results.outcome import Check, Outcome, Quantity

BALANCE = 1e-9
SUM = 1e-3  # of strips, whose tangent is not quite Hertz's


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran = tuple(stages.clock.seconds)
    made = begun(
        stages,
        quantities,
        why(stages.scene),
        headline,
        headline.not_simulated(stages.scene, "contact" in ran),
    )
    made = replace(made, warnings=tuple(unheeded(stages.scene)))
    if "contact" in ran:
        made = replace(made, checks=checks(stages), warnings=warnings(stages))
    if "geometry" in ran:
        with stages.clock.stage("figures"):
            from trochoid.drives.rv.dataset import dataset
            from trochoid.drives.rv.picture import drawing, plots, stress_film

            made = replace(
                made,
                dataset=dataset(stages, ran),
                drawing=drawing(stages),
                plots=plots(stages.design),
                films=(stress_film(stages),) if "stress" in ran else (),
            )
            if "modes" in ran:
                made = replace(made, **_modes(stages, made))
    if "reactions" in ran:
        made = replace(made, notes={"Rigid and elastic reactions": stages.reactions.reason})
    return timed(made, stages.clock)


def _modes(stages: Stages, made: Outcome) -> dict[str, Any]:
    """Return plots and films with those of the modes."""
    from trochoid.drives.rv.mode_shapes import films
    from trochoid.drives.rv.modes import campbell

    design, series, masses = stages.design, stages.contact.fine, stages.masses
    return {
        "plots": (*made.plots, campbell(design, series, masses)),
        "films": (*made.films, *films(design, series, masses, stages.modes)),
    }


def checks(stages: Stages) -> tuple[Check, ...]:
    """Return the balances of what was solved."""
    from trochoid.drives.rv.balance import crank_residual, disc_residual, power_residual, torque_residual

    made, series = stages.design, stages.contact.fine
    split = np.abs(series.parts.sum(axis=1) / series.compliance - 1)
    found = {
        "forces and torques balance at every position": (float(series.imbalance.max()), BALANCE),
        "no contact penetrates": (float(series.penetration.max()), BALANCE),
        "discs in equilibrium": (disc_residual(made, series), BALANCE),
        "crankshafts in equilibrium": (crank_residual(made, series), BALANCE),
        "ring pins carry the ring's torque": (torque_residual(made, series), BALANCE),
        "powers of sun and ring are what is stored, at every position": (
            power_residual(made, series),
            BALANCE,
        ),
    }
    if "losses" in stages.clock.seconds:
        found["sun and ring give what is stored and lost"] = (stages.losses.fine.residual, BALANCE)
    if "reactions" in stages.clock.seconds:
        found["reactions on the casing sum to the members' inertia"] = (stages.reactions.residual, BALANCE)
        if stages.reactions.response is not None:
            found["work on the elastic motion is what damping takes"] = (stages.reactions.work, BALANCE)
    if not np.isnan(split).any():
        found["compliances of the parts add up to the whole"] = (float(split.max()), SUM)
    checked = tuple(Check.within(name, value, limit) for name, (value, limit) in found.items())
    return (*checked, *casing_checks(stages.vibration)) if "vibration" in stages.clock.seconds else checked


def warnings(stages: Stages) -> tuple[str, ...]:
    """Return what a reader must know before trusting the numbers."""
    said: list[str] = []
    scene, d = stages.scene, stages.scene.drive
    m = d.cycloid.modification
    given = [m.equidistant, m.radial, m.rotation, d.cycloid.pin_clearance, d.arm_bearing.clearance]
    if any([*given, d.first_stage.backlash]) and not scene.has("clearance"):
        said.append(
            'the scene gives modifications or clearances, but the effect "clearance" is not listed: '
            "they are not in the gaps"
        )
    if (stages.contact.fine.mesh_force < 0).any():
        said.append(
            "the teeth of a planet are pulled at some positions: they would lift off and fall back, which is not in "
            "the model; raise operation.output_torque or lower first_stage.sun_stiffness"
        )
    ran = stages.clock.seconds
    said += doubtful(stages.contact.doubt)
    if "reactions" in ran:
        found = stages.reactions
        if found.mismatch > 0.01:
            said.append(
                "forces do not repeat after a turn of the crankshafts, because rollers stand elsewhere: "
                f"{100 * found.mismatch:.2g} % of the largest bearing force was taken out as a ramp before spectra "
                "were made"
            )
        if found.response is not None:
            said += found.response.warnings
    if "vibration" in ran:
        said += stages.vibration.elastic.warnings
        if is_elastic(stages.scene):
            said += casing_warnings(stages.scene, stages.vibration_levels)
    return tuple(said)

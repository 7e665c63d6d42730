"""Everything a K-H-V run hands over: quantities, series, pictures, checks, warnings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from trochoid.drives.casing_doubt import casing_warnings
from trochoid.drives.choosing import doubtful
from trochoid.drives.gathering import begun, timed
from trochoid.drives.khv import headline
from trochoid.drives.khv.plan import WHY, rolls
from trochoid.drives.khv.stages import Stages
from trochoid.drives.planning import with_casing, with_supports
from trochoid.drives.vibration_answers import casing_checks
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Check, Outcome, Quantity

if TYPE_CHECKING:
    from trochoid.drives.khv.series import Series
    from trochoid.results.film import Film
    from trochoid.results.plot import Plot

BALANCE = 1e-9


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran = tuple(stages.clock.seconds)
    why, _ = with_supports(rolls(stages.scene), *with_casing(stages.scene, WHY, {}))
    words = begun(stages, quantities, why, headline, headline.not_simulated(stages.scene))
    if "contact" in ran:
        words = replace(words, checks=checks(stages), warnings=warnings(stages), **_pictures(stages, ran))
    if "reactions" in ran:
        words = replace(words, notes={"Rigid and elastic reactions": stages.reactions.fine.reason})
    return timed(words, stages.clock)


def _pictures(stages: Stages, ran: tuple[str, ...]) -> dict[str, Any]:
    """Return series, drawing and films of the solved contacts."""
    with stages.clock.stage("figures"):
        from trochoid.drives.khv.dataset import dataset
        from trochoid.drives.khv.picture import drawing, stress_film

        return {
            "dataset": dataset(stages, ran),
            "drawing": drawing(stages),
            "films": (*((stress_film(stages),) if "stress" in ran else ()), *_mode_films(stages, ran)),
            "plots": tuple(_plots(stages, ran)),
        }


def _mode_films(stages: Stages, ran: tuple[str, ...]) -> tuple[Film, ...]:
    if "modes" not in ran:
        return ()
    from trochoid.drives.khv.mode_shapes import films

    return films(stages.design, stages.modes.fine)


def _plots(stages: Stages, ran: tuple[str, ...]) -> Iterator[Plot]:
    if "modes" in ran:
        from trochoid.drives.khv.modes import campbell

        yield campbell(stages.design, stages.contact.fine, stages.masses)
    if "torsional" in ran and stages.torsional is not None:
        from trochoid.drives.khv.answers_torsional import picture

        yield picture(stages, stages.torsional)


def checks(stages: Stages) -> tuple[Check, ...]:
    """Return the balances of what was solved."""
    series = stages.contact.fine
    found = [
        Check.within("forces and torques balance at every position", series.imbalance, BALANCE),
        Check.within("no contact penetrates", series.penetration, BALANCE),
    ]
    for i in range(len(stages.design.discs)):
        found.append(Check.within(f"disc {i + 1} in equilibrium", disc_residual(stages, i), BALANCE))
    found.append(Check.within("output pins carry the output torque", torque_residual(stages), BALANCE))
    if "losses" in stages.clock.seconds:
        found.append(
            Check.within("input power is output power and losses", stages.losses.fine.residual, BALANCE)
        )
    if "reactions" in stages.clock.seconds:
        found.append(
            Check.within(
                "reactions on the casing sum to the members' inertia", stages.reactions.fine.residual, BALANCE
            )
        )
        if stages.reactions.fine.response is not None:
            work = stages.reactions.fine.work
            found.append(Check.within("work on the elastic motion is what damping takes", work, BALANCE))
    if "vibration" in stages.clock.seconds:
        found += casing_checks(stages.vibration.fine)
    return tuple(found)


def disc_residual(stages: Stages, i: int) -> float:
    """Return the largest sum of forces and of moments on a disc over its largest force (and lever),
    recomputed from contacts alone.
    """
    from trochoid.drives.khv.contact import centrifugal

    series, flank = stages.contact.fine, stages.design.flank
    angle = series.crank + stages.design.discs[i].crank
    center = flank.eccentricity * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    center = center + _displacement(series, f"disc{i}")
    kinds = [series.ring, series.output] + ([] if series.bearing is None else [series.bearing])
    # the eccentric holds the classical disc with whatever force is needed: torque balance only
    free = 0.0 if series.bearing is None else 1.0
    force = free * centrifugal(stages.design, series.crank)[:, i]
    moment, size = np.zeros(len(angle)), np.zeros(len(angle))
    for touches in kinds:
        push = -touches.force[:, i, :, None] * touches.normal[:, i]
        arm = touches.point[:, i] - center[:, None]
        force += free * push.sum(axis=1)
        moment += (arm[..., 0] * push[..., 1] - arm[..., 1] * push[..., 0]).sum(axis=1)
        size = np.maximum(size, touches.force[:, i].max(axis=1, initial=0.0))
    size = np.where(size > 0, size, 1.0)
    return float(
        max(np.abs(force / size[:, None]).max(), np.abs(moment / (size * flank.pin_circle_radius)).max())
    )


def _displacement(series: Series, member: str, z: float = 0.0) -> Array:
    """Return how far (n, 2) a member's centre at the axial place z has gone when contacts were last looked at.

    The classical calculation looks at them in their nominal places.
    """
    from trochoid.drives.khv.contact import Layout

    if series.rung == "springs":
        return np.zeros((len(series.angle), 2))
    rows = Layout(series.names, True, True).rows(member, z)[:2]
    return np.asarray(series.motion @ rows.T)


def torque_residual(stages: Stages) -> float:
    """Return how far the output pins' torque about the axis is from the flange's, relative to the larger of it
    and the largest pin force at the pins' circle.
    """
    series, torque = stages.contact.fine, stages.design.flange_torque
    touches = series.output
    reach = float(touches.force.max(initial=0.0)) * stages.design.drive.output_pins.circle_radius
    total = np.zeros(len(series.angle))
    for i, disc in enumerate(stages.design.discs):
        arm = touches.point[:, i] - _displacement(series, "output", disc.z)[:, None]
        push = touches.force[:, i, :, None] * touches.normal[:, i]
        total += (arm[..., 0] * push[..., 1] - arm[..., 1] * push[..., 0]).sum(axis=1)
    return float(np.abs(total + torque).max() / (max(torque, reach) or 1.0))


def warnings(stages: Stages) -> tuple[str, ...]:
    """Return what a reader must know before trusting the numbers."""
    said: list[str] = []
    scene, d = stages.scene, stages.scene.drive
    given = [d.modification.equidistant, d.modification.radial, d.modification.rotation, d.pin_clearance]
    given += [d.output_pins.hole_clearance, d.eccentric_bearing.clearance]
    if any(given) and not scene.has("clearance"):
        said.append(
            'the scene gives modifications or clearances, but the effect "clearance" is not listed: '
            "they are not in the gaps"
        )
    if not scene.has("elastic_contact"):
        said.append(
            'the effect "elastic_contact" is not listed: discs are rigid and every contact is a spring (springs)'
        )
    ran = stages.clock.seconds
    if "contact" in ran:
        said += doubtful(stages.contact.doubt)
    if "reactions" in ran:
        found = stages.reactions.fine
        if found.mismatch > 1e-3:
            said.append(
                "forces do not repeat after one input turn (holes, rollers and lobes are of unlike number): "
                f"{100 * found.mismatch:.2g} % of the bearing force was taken out as a ramp before spectra were made"
            )
        if found.response is not None:
            said += found.response.warnings
    if "vibration" in ran:
        said += stages.vibration.fine.elastic.warnings
        said += casing_warnings(scene, stages.vibration)
    return tuple(said)

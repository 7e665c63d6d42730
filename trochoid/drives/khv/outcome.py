"""Everything a K-H-V run hands over: quantities, series, pictures, checks, warnings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from trochoid.drives.khv import headline
from trochoid.drives.khv.plan import WHY
from trochoid.drives.khv.stages import Stages
from trochoid.results.outcome import Check, Outcome, Quantity, Stage

BALANCE = 1e-9


def outcome(stages: Stages, quantities: Mapping[str, Quantity]) -> Outcome:
    """Gather what the stages hold; no stage is started here but the figures' own."""
    ran = tuple(stages.clock.seconds)
    words = Outcome(
        scene=stages.scene.model_dump(mode="json"),
        quantities=quantities,
        not_needed=tuple(name for name in WHY if name not in ran),
        title=headline.title(stages),
        facts=headline.facts(stages),
        not_simulated=headline.not_simulated(stages.scene),
    )
    if "contact" in ran:
        words = replace(words, checks=checks(stages), warnings=warnings(stages), **_pictures(stages, ran))
    if "reactions" in ran:
        words = replace(words, notes={"Rigid and elastic reactions": stages.reactions.fine.reason})
    seconds = stages.clock.seconds
    return replace(words, stages=tuple(Stage(name, seconds[name]) for name in seconds))


def _pictures(stages: Stages, ran: tuple[str, ...]) -> dict[str, Any]:
    """Return series, drawing and fields of the solved contacts."""
    with stages.clock.stage("figures"):
        from trochoid.drives.khv.dataset import dataset
        from trochoid.drives.khv.picture import drawing, fields

        return {
            "dataset": dataset(stages, ran),
            "drawing": drawing(stages),
            "fields": fields(stages) if "stress" in ran else (),
        }


def checks(stages: Stages) -> tuple[Check, ...]:
    """Return the balances of what was solved."""
    series = stages.contact.fine
    found = [
        _check("forces and torques balance at every position", series.imbalance, BALANCE),
        _check("no contact penetrates", series.penetration, BALANCE),
    ]
    for i in range(len(stages.design.discs)):
        found.append(_check(f"disc {i + 1} in equilibrium", disc_residual(stages, i), BALANCE))
    found.append(_check("output pins carry the output torque", torque_residual(stages), BALANCE))
    if "reactions" in stages.clock.seconds:
        found.append(
            _check(
                "reactions on the casing sum to the members' inertia", stages.reactions.fine.residual, BALANCE
            )
        )
    return tuple(found)


def _check(name: str, value: float, limit: float) -> Check:
    return Check(name, value, limit, bool(value <= limit))


def disc_residual(stages: Stages, i: int) -> float:
    """Return the largest sum of forces and of moments on a disc over its largest force (and lever),
    recomputed from contacts alone.
    """
    from trochoid.drives.khv.contact import centrifugal

    series, flank = stages.contact.fine, stages.design.flank
    if series.bearing is None:  # the classical disc is held by its eccentric: torque balance only
        return 0.0
    inertia = centrifugal(stages.design, series.crank)[:, i]
    angle = series.crank + stages.design.discs[i].crank
    center = flank.eccentricity * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    row = series.names.index(f"disc{i}.x")
    center = center + series.motion[:, row : row + 2]
    force, moment, size = inertia.copy(), np.zeros(len(inertia)), np.zeros(len(inertia))
    for touches in (series.ring, series.output, series.bearing):
        push = -touches.force[:, i, :, None] * touches.normal[:, i]
        arm = touches.point[:, i] - center[:, None]
        force += push.sum(axis=1)
        moment += (arm[..., 0] * push[..., 1] - arm[..., 1] * push[..., 0]).sum(axis=1)
        size = np.maximum(size, touches.force[:, i].max(axis=1, initial=0.0))
    size = np.where(size > 0, size, 1.0)
    return float(
        max(np.abs(force / size[:, None]).max(), np.abs(moment / (size * flank.pin_circle_radius)).max())
    )


def torque_residual(stages: Stages) -> float:
    """Return how far the output pins' torque about the axis is from the flange's, relative."""
    series, torque = stages.contact.fine, stages.design.flange_torque
    if torque == 0.0:
        return 0.0
    touches = series.output
    hub = np.zeros((len(series.angle), 2))
    if "output.x" in series.names:
        row = series.names.index("output.x")
        hub = series.motion[:, row : row + 2]
    total = np.zeros(len(series.angle))
    for i, disc in enumerate(stages.design.discs):
        tilt = np.zeros_like(hub)
        if "output.tilt_x" in series.names:
            a, b = series.names.index("output.tilt_x"), series.names.index("output.tilt_y")
            tilt = disc.z * np.stack([series.motion[:, b], -series.motion[:, a]], axis=-1)
        arm = touches.point[:, i] - (hub + tilt)[:, None]
        push = touches.force[:, i, :, None] * touches.normal[:, i]
        total += (arm[..., 0] * push[..., 1] - arm[..., 1] * push[..., 0]).sum(axis=1)
    return float(np.abs(total + torque).max() / torque)


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
    return tuple(said)

"""Answers about torsional vibration."""

from __future__ import annotations

import numpy as np

from trochoid.drives.exact import ARCMIN, RPM
from trochoid.drives.khv.stages import Stages
from trochoid.drives.khv.torsional import Torsional
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Quantity
from trochoid.results.plot import Axis, Plot, PlotCurve

ARCSEC = ARCMIN / 60.0


def torsional_vibration(s: Stages) -> Quantity:
    """How the driven member swings about its even turning, and how its torque does; where it resonates."""
    found = s.torsional
    if found is None:
        return Quantity("free within its play", note="at some input angle nothing resists the driven member")
    made, (least, most) = found.pendulum, found.torques
    worst = int(np.argmax(found.up))
    values = {
        "natural_frequency": (made.natural_frequency, "Hz"),
        "peak_to_peak": (found.swing / ARCSEC, "arcsec"),
        "torque_min": (least, "N*m"),
        "torque_max": (most, "N*m"),
        "dynamic_factor": (most / made.torque, ""),
        "largest_beyond_creeping": (float(found.up[worst]) / ARCSEC, "arcsec"),
        "largest_at_speed": (float(found.speeds[worst]) / RPM, "rpm"),
    }
    if found.growth.size:
        values["growth_per_turn"] = (float(found.growth[0]), "")
    parts = {name: Quantity(value, unit, None, s.rung) for name, (value, unit) in values.items()}
    return Quantity(parts=parts, note="; ".join(_said(s, found)))


def _said(s: Stages, found: Torsional) -> list[str]:
    said = [f"one coordinate, {found.pendulum.harmonics} harmonics of the input"]
    if found.torques[0] <= 0.0:
        said.append("contacts leave each other during the turn")
    if found.jumps.size:
        said.append(f"two motions from {_span(found.jumps)}: the motion jumps there")
    if found.unstable.size:
        said.append(
            f"parametric instability: the varying stiffness excites itself at {_span(found.unstable)}"
        )
    elif found.growth.size:
        said.append("no parametric instability among the speeds tried")
    if found.pendulum.harmonics < s.scene.drive.pins:
        need = 2 * s.scene.drive.pins + 1
        said.append(
            f"the passing of the ring pins is not resolved: take {need} positions (ask.positions) or more"
        )
    return said


def _span(speeds: Array) -> str:
    return f"{speeds.min() / RPM:.4g} to {speeds.max() / RPM:.4g} rpm"


def picture(s: Stages, found: Torsional) -> Plot:
    """Draw the swing over the speed, swept up and down."""
    curves = [PlotCurve("speed rising", np.column_stack([found.speeds, found.up / ARCSEC]))]
    if found.jumps.size:
        curves.append(PlotCurve("speed falling", np.column_stack([found.speeds, found.down / ARCSEC])))
    top = 1.05 * max(float(found.up.max()), float(found.down.max())) / ARCSEC
    at = np.array([[s.design.crank_speed, 0.0], [s.design.crank_speed, top]])
    curves.append(PlotCurve("speed of operation", at, style="dashed"))
    return Plot(
        "Torsional vibration",
        (Axis("input speed", "rad/s"), Axis("peak to peak (arcsec)")),
        tuple(curves),
        (),
        "What the lag of the driven member swings beyond the transmission error, which is its swing at creeping speed.",
        equal=False,
    )

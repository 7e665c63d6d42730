"""Answers from the load path at held input, and from the losses of the running drive."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from trochoid.drives.exact import ARCMIN
from trochoid.drives.khv.estimate import scalar_error
from trochoid.drives.khv.running import Running
from trochoid.drives.khv.stages import Stages
from trochoid.drives.khv.torsion import Torsion, torsion
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Quantity


def lost_motion(s: Stages) -> Quantity:
    """Lost motion as catalogues measure it, mean over the held input angles."""
    note = "middle of the torsion curve between +3 % and −3 % of operation.output_torque, mean over a pitch of the pins"
    return _mean(s, lambda t: t.lost_motion / ARCMIN, "arcmin", _lacking(s, note))


def backlash(s: Stages) -> Quantity:
    """Angle between the branches of the torsion curve at zero torque."""
    note = "width of the torsion curve at zero torque: play and hysteresis"
    return _mean(s, lambda t: t.backlash / ARCMIN, "arcmin", _lacking(s, note))


def torsion_curve(s: Stages) -> Quantity:
    """What else the torsion curve tells: stiffness by two lines, hysteresis, play, and how they vary with the angle."""
    return Quantity(
        parts={
            "stiffness_3_to_50_percent": _mean(s, lambda t: t.lower * ARCMIN, "N*m/arcmin"),
            "stiffness_50_to_100_percent": _mean(s, lambda t: t.upper * ARCMIN, "N*m/arcmin"),
            "wind_up": _mean(s, lambda t: t.wind_up / ARCMIN, "arcmin"),
            "play": _mean(s, lambda t: t.play / ARCMIN, "arcmin"),
            "hysteresis_at_zero_torque": _mean(s, lambda t: t.hysteresis / ARCMIN, "arcmin"),
            "loss_per_cycle": _loss(s),
            "lost_motion_min": _number(s, lambda t: t.lost_motion / ARCMIN, "arcmin", np.min),
            "lost_motion_max": _number(s, lambda t: t.lost_motion / ARCMIN, "arcmin", np.max),
            "backlash_min": _number(s, lambda t: t.backlash / ARCMIN, "arcmin", np.min),
            "backlash_max": _number(s, lambda t: t.backlash / ARCMIN, "arcmin", np.max),
        },
        note=_lacking(s, "input held, torque 0, +T, −T, +T with T = operation.output_torque"),
    )


def efficiency(s: Stages) -> Quantity:
    """Output power over input power, mean over a turn: what friction at pins and rollers leaves."""
    given = s.scene.operation.output_torque / abs(
        float(s.design.speeds.ratio)
    )  # work per radian of the input

    def get(running: Running) -> float:
        return float(given / (given + _lost_per_turn(s, running).sum()))

    note = "without bearings, seals and oil"
    return _of_run(s, get, "", note)


def power_loss(s: Stages) -> Quantity:
    """Power lost by friction at ring pins and output pins, mean over a turn."""
    speed = s.scene.operation.input_speed
    parts = {
        name: _of_run(s, lambda r, i=i: float(_lost_per_turn(s, r)[i]) * speed, "W")  # type: ignore[misc]
        for i, name in enumerate(("ring_pins", "output_pins"))
    }
    parts["total"] = _of_run(s, lambda r: float(_lost_per_turn(s, r).sum()) * speed, "W")
    parts["input_torque"] = _of_run(s, lambda r: _input_torque(s, r), "N*m")
    parts["ring_pin_force_max"] = _of_run(s, lambda r: float(r.ring_force.max()), "N")
    parts["output_pin_force_max"] = _of_run(s, lambda r: float(r.output_force.max()), "N")
    return Quantity(
        parts=parts, note="friction of ring pins and output pins only; largest forces with friction"
    )


def _lacking(s: Stages, note: str) -> str:
    """Add what is not in the numbers."""
    absent = [name for name in ("clearance", "friction") if not s.scene.has(name)]
    return note + (f"; without {' and '.join(absent)}" if absent else "")


def _mean(s: Stages, get: Callable[[Torsion], Array], unit: str, note: str | None = None) -> Quantity:
    return _number(s, get, unit, np.mean, note)


def _number(
    s: Stages,
    get: Callable[[Torsion], Array],
    unit: str,
    of: Callable[[Array], float],
    note: str | None = None,
) -> Quantity:
    """Return a number of the loops.

    Its error is that of the loop that the coarser mesh has followed too, and the share by which loops do not close.
    """
    pair, torque = s.load_path, s.scene.operation.output_torque
    read = torsion(pair.fine, torque)
    fine = get(read)
    error = None
    if pair.coarse is not None:
        error = scalar_error(float(fine[0]), float(get(torsion(pair.coarse, torque))[0]), s.difference)
        error += float((np.abs(fine) * read.open / read.wind_up).max())
    return Quantity(float(of(fine)), unit, error, s.rung, note=note)


def _loss(s: Stages) -> Quantity:
    """Return the area of the loops; by how much it misses what friction took adds to its error."""
    answer = _mean(s, lambda t: t.loss, "J")
    missed = float(torsion(s.load_path.fine, s.scene.operation.output_torque).unmet.max())
    return replace(answer, error=None if answer.error is None else answer.error + missed)


def _of_run(s: Stages, get: Callable[[Running], float], unit: str, note: str | None = None) -> Quantity:
    """Return a number of the running drive; what every second position would have given adds to its error."""
    pair = s.losses
    value, half = get(pair.fine), get(pair.fine.every_second)
    error = abs(value - half)
    if pair.coarse is not None:
        error += scalar_error(value, get(pair.coarse), s.difference)
    return Quantity(value, unit, error, s.rung, note=note)


def _lost_per_turn(s: Stages, running: Running) -> Array:
    """Return what ring pins and output pins (2,) lose in J per radian of the input."""
    kinds = [x.sum(axis=(1, 2)).mean() for x in (running.ring, running.output)]
    return np.array(kinds) * abs(s.design.mesh_speed)


def _input_torque(s: Stages, running: Running) -> float:
    """Return the mean torque of the input in N·m: what it takes to give the output's work and the losses."""
    given = s.scene.operation.output_torque / abs(float(s.design.speeds.ratio))
    return float(given + _lost_per_turn(s, running).sum())

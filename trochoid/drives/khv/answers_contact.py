"""Answers from the contacts over a turn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.exact import ARCMIN
from trochoid.drives.khv.numbers import number, over_turn
from trochoid.drives.khv.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.khv.field import DiscState
    from trochoid.drives.khv.series import Series, Touches
    from trochoid.fem.stress_peak import Peak


def load_sharing(s: Stages) -> Quantity:
    """How the torque is shared by the discs, and the load of one disc by its pins."""

    def disc_share(series: Series) -> float:
        torque = np.abs(_disc_torque(s, series.ring.force, series.crank))
        return float(_share(torque, torque.sum(axis=1, keepdims=True)).max())

    def pin_share(series: Series) -> float:
        force = series.ring.force
        return float(_share(force.max(axis=2), force.sum(axis=2)).max())

    return Quantity(
        parts={
            "disc_torque_share_max": over_turn(s, disc_share, ""),
            "pin_force_share_max": over_turn(s, pin_share, ""),
            "loaded_pins_mean": over_turn(s, lambda x: float(x.ring.touching.mean()), ""),
            "loaded_output_pins_mean": over_turn(s, lambda x: float(x.output.touching.mean()), ""),
        }
    )


def _share(part: Array, whole: Array) -> Array:
    return np.divide(part, whole, out=np.zeros_like(part), where=whole > 0)


def _disc_torque(s: Stages, force: Array, crank: Array) -> Array:
    """Torque (n, d) of the ring pins on each disc about its centre, N·m, from forces (n, d, p)."""
    flank = s.design.flank
    angle = crank[:, None, None] + np.array([d.crank for d in s.design.discs])[None, :, None]
    t = flank.contact_parameter(np.arange(flank.pins)[None, None, :], angle)
    return np.asarray((force * flank.lever(t)).sum(axis=2))


def contact_force_max(s: Stages) -> Quantity:
    """Largest force of each kind of contact."""
    return _largest(s, lambda touches: touches.force, 1.0, "N")


def contact_pressure_max(s: Stages) -> Quantity:
    """Largest contact pressure of each kind of contact."""
    return _largest(s, lambda touches: touches.pressure, 1e-6, "MPa")


def _largest(s: Stages, get: Callable[[Touches], Array], scale: float, unit: str) -> Quantity:
    parts = {
        "ring_pins": over_turn(s, lambda x: float(get(x.ring).max()) * scale, unit),
        "output_pins": over_turn(s, lambda x: float(get(x.output).max()) * scale, unit),
    }
    if s.contact.fine.bearing is not None:
        parts["bearing_rollers"] = over_turn(s, lambda x: _rollers(x, get) * scale, unit)
    return Quantity(parts=parts)


def _rollers(series: Series, get: Callable[[Touches], Array]) -> float:
    return 0.0 if series.bearing is None else float(get(series.bearing).max())


def stress_max(s: Stages) -> Quantity:
    """Largest von Mises and shear stress of the discs at the stress position; below a contact as a rule."""
    angle = float(np.degrees(s.field.fine[0].angle))
    near = "the strips" if s.rung == "strips" else "Hertz's pressure"
    note = (
        f"at input angle {angle:g}°: below the contacts from {near} in closed form, the rest by finite elements; "
        "place in the fixed frame"
    )
    return Quantity(
        parts={
            "von_mises": _peak(s, lambda disc: disc.field.von_mises_peak),
            "max_shear": _peak(s, lambda disc: disc.field.max_shear_peak),
        },
        note=note,
    )


def _peak(s: Stages, get: Callable[[DiscState], Peak]) -> Parts:
    """Return the largest stress among the discs, how deep it lies, and where."""
    from trochoid.drives.khv.picture import ring_angle, turned

    peak = s.field.map(lambda discs: max((get(disc) for disc in discs), key=lambda peak: peak.value))
    i = next(k for k, disc in enumerate(s.field.fine) if get(disc) is peak.fine)
    disc = s.field.fine[i]
    x, y = 1e3 * turned(disc.points[peak.fine.node, :2], float(ring_angle(s.design, np.array(disc.angle))))
    return {
        "stress": number(s, peak.map(lambda p: 1e-6 * p.value), "MPa"),
        "depth": number(s, peak.map(lambda p: 1e3 * p.depth), "mm"),
        "disc": Quantity(float(1 + i)),
        "x": Quantity(float(x), "mm"),
        "y": Quantity(float(y), "mm"),
    }


def transmission_error(s: Stages) -> Quantity:
    """Loaded transmission error of the driven member over a turn, and its mean, the wind-up."""
    scale = 1 / (ARCMIN * s.design.leverage)
    return Quantity(
        parts={
            "peak_to_peak": over_turn(s, lambda x: float(np.ptp(x.twist[:-1])) * scale * 60, "arcsec"),
            "wind_up": over_turn(s, lambda x: float(x.twist[:-1].mean()) * scale, "arcmin"),
        },
        note=None
        if (s.contact.fine.torsional_stiffness > 0).all()
        else "the driven member is free within its play: its angle is one of many",
    )


def torsional_stiffness(s: Stages) -> Quantity:
    """Torque per angle at the output with the input held, mean over a turn: the tangent at the load."""
    scale = ARCMIN * s.design.leverage**2  # from the flange to the driven member
    answer = over_turn(s, lambda x: float(x.torsional_stiffness[:-1].mean()) * scale, "N*m/arcmin")
    note = "tangent at the operating torque, mean over a turn"
    return replace(answer, note=note if answer.value else "nothing touches: the drive does not resist")

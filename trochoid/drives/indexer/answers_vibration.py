"""Answers about what elasticity makes of the soft shocks, the spherical Geneva wheel's beside each."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.indexer.answers_contact import pressure_parts
from trochoid.drives.indexer.design import INDEXER
from trochoid.drives.indexer.shaken import Shaken
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.words import SAME_TIME
from trochoid.kinematics.readable import readable
from trochoid.results.outcome import Parts, Quantity

MODEL = "marched"


def dynamic_factor(s: Stages) -> Quantity:
    """Largest pin force of the elastic drive over that of the rigid one."""
    rows: dict[str, Parts | Quantity] = {name: _factor(x) for name, x in s.shaken.items()}
    if SAME_TIME in s.shaken:
        ours, theirs = (s.shaken[x].peak[0] for x in (INDEXER, SAME_TIME))
        rows["geneva_over_indexer_in_same_time"] = {"pin_force": Quantity(theirs / ours, "", None, MODEL)}
    return Quantity(
        parts=rows,
        note="from rest without load; pin and slot in contact at one wall at a time; errors are those of the steps",
    )


def _factor(x: Shaken) -> Parts:
    factor, error = x.factor
    force, at = x.peak
    low = x.output.frequencies[0] / (2.0 * math.pi)
    row: dict[str, Quantity] = {
        "factor": Quantity(factor, "", error, MODEL),
        "pin_force": Quantity(force, "N", error * x.pair.largest[0], MODEL),
        "pin_force_rigid": Quantity(x.pair.largest[0], "N", None, "rigid"),
        "at": Quantity(math.degrees(at), "deg", None, MODEL),
        "natural_periods_in_index": Quantity(low * float(x.fine.index.time[-1]), "", None, MODEL),
        "lag_max": Quantity(
            60.0 * math.degrees(float(np.abs(x.fine.index.deviation).max())), "arcmin", None, MODEL
        ),
    }
    return row | _entry(x) | (pressure_parts(x.pair, x.pressed) if force > 0.0 else {})


def _entry(x: Shaken) -> dict[str, Quantity]:
    """Return what happens as the pin first touches its slot."""
    start = x.at_entry
    if math.isnan(x.touch):
        return {"at_entry_over_rigid_start": Quantity("never touches its slot in the index", model=MODEL)}
    words = Quantity("starts without force", model="exact")
    row = {"at_entry_over_rigid_start": Quantity(start, "", None, MODEL) if math.isfinite(start) else words}
    if x.pair.law.play > 0.0:
        row["first_touch"] = Quantity(1e3 * x.touch, "ms", None, MODEL)
    return row


def residual_vibration(s: Stages) -> Quantity:
    """How the output swings after the stop, held by the lock: amplitude, velocity, decay."""
    rows: dict[str, Parts | Quantity] = {name: _residual(s, x) for name, x in s.shaken.items()}
    if SAME_TIME in s.shaken:
        ours, theirs = (s.shaken[x] for x in (INDEXER, SAME_TIME))
        if ours.amplitude[0] > 0.0 < theirs.amplitude[0]:
            rows["geneva_over_indexer_in_same_time"] = {
                "amplitude": Quantity(theirs.amplitude[0] / ours.amplitude[0], "", None, MODEL)
            }
    return Quantity(
        parts=rows,
        note="about where friction holds the output in the end, held_off_by_friction from the rigid drive's rest; "
        "settled: within 5 % of the amplitude; errors are those of the steps",
    )


def _residual(s: Stages, x: Shaken) -> Parts:
    amplitude, error = x.amplitude
    radius = 1e3 * s.scene.drive.sphere_radius
    speed = float(np.abs(x.fine.dwell.speed).max())
    row = {
        "amplitude": Quantity(
            3600.0 * math.degrees(amplitude), "arcsec", 3600.0 * math.degrees(error), MODEL
        ),
        "amplitude_on_sphere_radius": Quantity(1e3 * radius * amplitude, "um", 1e3 * radius * error, MODEL),
        "velocity": Quantity(speed, "rad/s", None, MODEL),
        "settling_time": _settling(x),
        "left_at_next_index": Quantity("held by friction" if x.held else x.left, "", None, MODEL),
        "held_off_by_friction": Quantity(3600.0 * math.degrees(x.offset), "arcsec", None, MODEL),
    }
    for i, omega in enumerate(x.output.frequencies, 1):
        key = "natural_frequency" if len(x.output.frequencies) == 1 else f"natural_frequency_{i}"
        row[key] = Quantity(omega / (2.0 * math.pi), "Hz", None, MODEL)
    return row


def _settling(x: Shaken) -> Quantity:
    if x.settling is not None:
        return Quantity(x.settling, "s", None, MODEL)
    if x.held:
        return Quantity(
            f"not settled: friction holds it off by {readable(100.0 * x.held)} % of the swing", model=MODEL
        )
    what = "the dwell" if x.followed > 0.999 else f"{readable(x.fine.dwell.time[-1])} s, which were followed"
    return Quantity(f"not settled within {what}", model=MODEL)

"""Series of the elastic teeth: over a pitch, over the passage of one roller, and along the teeth."""

from __future__ import annotations

import numpy as np

from trochoid.drives.entries import Entries, Entry, entry, named
from trochoid.drives.precessional.contact import Series
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.tooth_loads import tooth_loads
from trochoid.kinematics.types import Array

PITCH, PASSAGE, PLACE, SLICE, LOADED = "pitch_angle", "passage_angle", "distance", "slice", "loaded_roller"


def passage_angle(design: Design, series: Series) -> Array:
    """Return crank angles (n·pins,) of roller 0 in rising order, while it meets all flanks once.

    A pitch of the crank later the next roller stands where this one stood.
    """
    pins = series.force.shape[1]
    pitch = 2.0 * np.pi / design.nutation.fixed_teeth
    return np.asarray((series.crank + pitch * np.arange(pins)[:, None]).ravel())


def passage(values: Array) -> Array:
    """Return values (n, pins, ...) of all rollers over a pitch as those of roller 0 over its passage (n·pins, ...)."""
    pins = values.shape[1]
    order = -np.arange(pins) % pins  # roller k at angle t stands where roller 0 does k pitches before
    rolled = np.moveaxis(values, 1, 0)[order]
    return np.asarray(rolled.reshape(-1, *values.shape[2:]))


def contact_places(design: Design, series: Series) -> Entries:
    """Return the coordinates of all that `contact_entries` gives."""
    loaded = np.flatnonzero(series.total[0] > 0.0)
    pitch = 2.0 * np.pi / design.nutation.fixed_teeth
    over_pitch = np.append(series.crank, series.crank[0] + pitch)
    turned = passage_angle(design, series)
    over_passage = np.append(turned, turned[0] + pitch * series.force.shape[1])
    return {
        PITCH: entry((PITCH,), over_pitch, "rad", "input angle over a pitch of the wheel"),
        PASSAGE: entry((PASSAGE,), over_passage, "rad", "input angle over the passage of a roller"),
        PLACE: entry((PLACE,), series.places, "m", "distance from O"),
        SLICE: named(
            SLICE, tuple(f"{1e3 * place:.1f} mm" for place in series.places), "slice at a distance from O"
        ),
        LOADED: entry((LOADED,), 1 + loaded, "", "roller, of those pressed at input angle 0"),
    }


def contact_entries(design: Design, series: Series) -> Entries:
    """Return forces, pressures, stiffnesses and the transmission error; a pitch or passage ends as it began."""
    loads, lag = tooth_loads(design, series), series.lag
    loaded = np.flatnonzero(series.total[0] > 0.0)
    wind_up = float(np.degrees(lag.mean()) * 60.0)
    pressure = passage(series.pressure)
    made = {
        "roller_force": entry(
            (PASSAGE,),
            passage(series.total),
            "N",
            "force on a roller",
            "Force on a roller",
            caption="Force of one roller while it meets all flanks once; the others follow a pitch apart.",
        ),
        "roller_pressure": entry(
            (PASSAGE,),
            pressure.max(axis=1),
            "Pa",
            "largest pressure on a roller",
            "Pressure on a roller",
            caption="Largest pressure of one roller while it meets all flanks once.",
        ),
        "pressure_over_passage": entry(
            (PASSAGE, SLICE),
            pressure,
            "Pa",
            "pressure on a roller",
            "Pressure along a roller over its passage",
            plot="heatmap",
            caption="Largest pressure of each slice of a roller while it meets all flanks once.",
        ),
        "pressure_along_teeth": entry(
            (PLACE, LOADED),
            series.pressure[0][loaded].T,
            "Pa",
            "pressure along the teeth",
            "Pressure along the teeth",
            caption="Largest pressure across each contact over the distance from O, at input angle 0.",
        ),
        "loaded_teeth": entry((PITCH,), (series.total > 0.0).sum(axis=1), "", "teeth that carry"),
        "largest_share": entry(
            (PITCH,), _largest_share(series), "", "largest share of a tooth in all forces"
        ),
        "transmission_error": entry(
            (PITCH,),
            lag - lag.mean(),
            "rad",
            "transmission error",
            "Transmission error",
            caption=f"Lag of the loaded output behind its ideal angle, less its mean over the pitch, the wind-up of "
            f"{wind_up:.4g} arcmin.",
        ),
        "torsional_stiffness": entry(
            (PITCH,),
            series.torsional_stiffness,
            "N*m/rad",
            "torsional stiffness",
            "Torsional stiffness",
            caption="Torque per angle at the output with the input held: the tangent at the operating torque.",
        ),
        "input_torque_under_load": entry(
            (PITCH,), loads.motor, "N*m", "torque of the motor against the load"
        ),
    }
    for name, values in (("a", loads.joint_a), ("o", loads.joint_o), ("b", loads.support)):
        size = np.linalg.norm(values, axis=1)
        made[f"bearing_load_{name}"] = entry(
            (PITCH,), size, "N", f"force in {name.upper()} of the output torque"
        )
    return {name: _closed(each) for name, each in made.items()}


def _closed(given: Entry) -> Entry:
    """Return an entry with its first value at the end again, where it goes over a pitch or a passage."""
    dims, values, attributes = given
    if dims[0] not in (PITCH, PASSAGE):
        return given
    return dims, np.concatenate([values, values[:1]]), attributes


def _largest_share(series: Series) -> Array:
    whole = series.total.sum(axis=1)
    return np.asarray(np.divide(series.total.max(axis=1), whole, out=np.zeros_like(whole), where=whole > 0.0))

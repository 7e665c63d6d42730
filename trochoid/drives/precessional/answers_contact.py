"""Answers from the elastic contacts of rollers and sphere teeth over one pitch."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.exact import ARCMIN
from trochoid.drives.mesh_error import Pair, sampling_error, scalar_error
from trochoid.drives.precessional.answers_geometry import NO_TEETH
from trochoid.drives.precessional.stages import Stages
from trochoid.kinematics.types import Array, IntArray
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.precessional.contact import Series

MODEL = "slices"
NO_LOAD = "no torque at the output: nothing is pressed"
EDGE = (
    "an end of a roller or an edge of a cut crest presses: the pressure there has no bound, and the one given is the "
    "mean over the last slice; a crown, or longer flanks, take it away"
)


def number(s: Stages, pair: Pair[float], unit: str, worst: float | None = None) -> Quantity:
    """Return a number with the error that two mesh levels suggest."""
    if s.contact is None:
        return NO_TEETH
    share = s.contact.difference if worst is None else worst
    error = None if pair.coarse is None else scalar_error(pair.fine, pair.coarse, share)
    return Quantity(pair.fine, unit, error, MODEL)


def over_pitch(s: Stages, get: Callable[[Series], float], unit: str, worst: float | None = None) -> Quantity:
    """Return a number of the contacts over a pitch; its error is that of the mesh and of few positions.

    `worst` takes the place of the worst number's relative difference of the meshes: whole numbers are off by their own.
    """
    if s.contact is None:
        return NO_TEETH
    found = number(s, Pair(s.contact.fine, s.contact.coarse).map(get), unit, worst)
    if found.error is None:
        return found
    return replace(found, error=found.error + sampling_error(get, s.contact.fine, s.contact.fine.thinned))


def load_sharing(s: Stages) -> Quantity:
    """How many teeth carry, and the largest share of one in the sum of all forces."""
    if s.contact is None:
        return NO_TEETH
    teeth = {
        "min": over_pitch(s, lambda x: float(_carrying(x).min()), "", 0.0),
        "mean": over_pitch(s, lambda x: float(_carrying(x).mean()), "", 0.0),
        "max": over_pitch(s, lambda x: float(_carrying(x).max()), "", 0.0),
    }
    parts: dict[str, Quantity | Parts] = {
        "loaded_teeth": teeth,
        "largest_share": over_pitch(s, lambda x: float(_share(x).max()), ""),
        "largest_share_mean": over_pitch(s, lambda x: float(_share(x).max(axis=1).mean()), ""),
    }
    return Quantity(parts=parts, note="share: force of a contact over the sum of all of them")


def _carrying(series: Series) -> IntArray:
    return np.asarray((series.total > 0.0).sum(axis=1))


def _share(series: Series) -> Array:
    force = series.total
    whole = force.sum(axis=1, keepdims=True)
    return np.asarray(np.divide(force, whole, out=np.zeros_like(force), where=whole > 0.0))


def contact_force_max(s: Stages) -> Quantity:
    """Largest force of a roller on a flank."""
    answer = over_pitch(s, lambda x: float(x.total.max()), "N")
    return replace(answer, note=_at_speed(s, lambda x: float(x.total.max()), "N"))


def _at_speed(s: Stages, get: Callable[[Series], float], unit: str) -> str | None:
    """Say what the inertia of the satellite makes of a number where the bearings let it act on the teeth."""
    if s.running is None:
        return None
    return f"under the output torque alone; with the satellite's inertia at speed {get(s.running):.4g} {unit}"


def contact_pressure_max(s: Stages) -> Quantity:
    """Largest pressure between rollers and flanks."""
    answer = over_pitch(s, lambda x: 1e-6 * float(x.pressure.max()), "MPa")
    if s.contact is None:
        return answer
    said = _at_speed(s, lambda x: 1e-6 * float(x.pressure.max()), "MPa")
    edge = EDGE if s.contact.fine.edge.any() else None
    return replace(answer, note="; ".join(filter(None, (edge, said))) or None)


def mesh_stiffness(s: Stages) -> Quantity:
    """Stiffness of all teeth together against rotations of the satellite about O, in the frame of the crank."""
    names = ("across", "sideways", "shaft")
    parts: dict[str, Quantity | Parts] = {
        "about_satellite_axis": {
            "mean": over_pitch(s, lambda x: _about_axis(x).mean(), "N*m/rad"),
            "least": over_pitch(s, lambda x: _about_axis(x).min(), "N*m/rad"),
            "largest": over_pitch(s, lambda x: _about_axis(x).max(), "N*m/rad"),
        }
    }
    if s.contact is None:
        return NO_TEETH
    matrix = {}
    for i, one in enumerate(names):
        for j in range(i, 3):
            name = one if i == j else f"{one}_{names[j]}"
            matrix[name] = over_pitch(s, lambda x, i=i, j=j: float(x.mesh[:, i, j].mean()), "N*m/rad")  # type: ignore[misc]
    parts["mean_matrix"] = matrix
    note = (
        "tangent at the load; matrix about the crank's axes: shaft along the input shaft, across towards the side to "
        "which the satellite leans, sideways at right angles to both"
    )
    return Quantity(parts=parts, note=note)


def _about_axis(series: Series) -> Array:
    return np.asarray(np.einsum("i,nij,j->n", series.axis, series.mesh, series.axis))


def torsional_stiffness(s: Stages) -> Quantity:
    """Torque per angle at the output with the input held, mean over a pitch: the tangent at the load."""
    answer = over_pitch(s, lambda x: float(x.torsional_stiffness.mean()) * ARCMIN, "N*m/arcmin")
    if s.contact is None:
        return answer
    note = "tangent at the operating torque, input held, mean over a pitch" if answer.value else NO_LOAD
    return replace(answer, note=f"{note}; {_hold(s)}")


def _hold(s: Stages) -> str:
    yields = s.teeth is not None and s.teeth.tilt_stiffness is not None
    return (
        "bearings A and B yield with the teeth, the joint O does not"
        if yields
        else "bearings and joints are rigid"
    )


def transmission_error(s: Stages) -> Quantity:
    """Loaded transmission error of the output over a pitch, and its mean, the wind-up."""
    if s.contact is None:
        return NO_TEETH
    parts = {
        "peak_to_peak": over_pitch(s, lambda x: float(np.ptp(x.lag)) / ARCMIN * 60, "arcsec"),
        "wind_up": over_pitch(s, lambda x: float(x.lag.mean()) / ARCMIN, "arcmin"),
    }
    return Quantity(parts=parts, note=_hold(s))


def lost_motion(s: Stages) -> Quantity:
    """How far the output turns between +3 % and −3 % of its torque with the input held, mean over a pitch."""
    slack = s.slack
    if slack is None:
        return NO_TEETH
    coarse = None if slack.coarse is None else slack.coarse / ARCMIN
    answer = number(s, Pair(slack.fine / ARCMIN, coarse), "arcmin")
    error = None if answer.error is None else answer.error + slack.few / ARCMIN
    return replace(
        answer,
        error=error,
        note="between +3 % and −3 % of operation.output_torque, input held, mean over a pitch",
    )


def bearing_loads(s: Stages) -> Quantity:
    """Forces on A, O and B, moments on B and the output shaft, and the motor's torque, from the teeth's forces."""
    if s.contact is None:
        return NO_TEETH
    from trochoid.drives.precessional.tooth_loads import ToothLoads, tooth_loads

    made = s.feasible

    def sizes(get: Callable[[ToothLoads, Series], Array], unit: str) -> Parts:
        def of(read: Callable[[Array], float]) -> Quantity:
            return over_pitch(s, lambda x: read(get(tooth_loads(made, x), x)), unit)

        return {"mean": of(lambda a: float(a.mean())), "max": of(lambda a: float(a.max()))}

    def radial_a(loads: ToothLoads, series: Series) -> Array:
        axial = loads.joint_a @ series.axis
        return _size(loads.joint_a - axial[:, None] * series.axis)

    parts: dict[str, Quantity | Parts] = {
        "a_radial": sizes(radial_a, "N"),
        "a_axial": sizes(lambda x, y: np.abs(x.joint_a @ y.axis), "N"),
        "o_radial": sizes(lambda x, _: _size(x.joint_o), "N"),
        "b_radial": sizes(lambda x, _: _size(x.support[:, :2]), "N"),
        "b_axial": sizes(lambda x, _: np.abs(x.support[:, 2]), "N"),
        "b_moment": sizes(lambda x, _: _size(x.support_moment), "N*m"),
        "motor_torque": sizes(lambda x, _: x.motor, "N*m"),
        "output_shaft_moment": over_pitch(
            s, lambda x: float(np.linalg.norm(tooth_loads(made, x).output_moment)), "N*m"
        ),
    }
    return Quantity(
        parts=parts,
        note="of the output torque through the teeth, without inertia (that is in reactions); steady but for the mesh "
        "in the frame of the input shaft",
    )


def _size(vectors: Array) -> Array:
    return np.asarray(np.linalg.norm(vectors, axis=-1))

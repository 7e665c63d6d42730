"""Series over the input angle, spectra and the profile as one labelled dataset, in SI."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from trochoid.drives.khv.stages import Stages
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    import xarray

    from trochoid.drives.khv.series import Series, Touches

MANY = 12  # traces in one row of a figure beyond which a map is clearer
PER_LOBE = 40  # points of the profile
ANGLE = "input_angle"
BEARINGS = ("input shaft A", "input shaft B", "output flange A", "output flange B")
SHARING, OUTPUT, ECCENTRIC = "Load sharing of the ring pins", "Output pins", "Eccentric bearings"
PRESSURE, STIFFNESS, ERROR = "Contact pressure", "Torsional stiffness", "Transmission error"
REACTIONS, CHANGE, VELOCITY = "Bearing reactions", "Elastic less rigid reactions", "Vibration velocity"
CAPTIONS = {
    SHARING: "Force of every ring pin on each disc, and how many pins of each disc carry load.",
    OUTPUT: "Force between each output pin's roller and its hole.",
    ECCENTRIC: "Force of each disc on its eccentric, and the share of every roller between them.",
    PRESSURE: "Largest Hertz pressure of each kind of contact on each disc.",
    STIFFNESS: "Torque per angle at the output with the input held: the tangent at the operating torque.",
    REACTIONS: "Size of the force on shaft and flange in each of their bearings, A at the lower z.",
    VELOCITY: "Amplitude at the multiples of the input speed, by the vector sum of all forces on the casing.",
}

Entry = tuple[tuple[str, ...], npt.NDArray[Any], dict[str, str]]
Entries = dict[str, Entry]


def dataset(stages: Stages, wanted: Collection[str]) -> xarray.Dataset | None:
    """Return what the stages "geometry", "contact", "reactions", "vibration" hold if `wanted`; None without any.

    No other stage is started. The end of the turn, which stands for its beginning, is left out.
    """
    if not {"geometry", "contact", "reactions", "vibration"} & set(wanted):
        return None
    import xarray

    entries, coordinates = _profile(stages), _places(stages)
    if "contact" in wanted:
        entries |= _contact(stages)
        coordinates |= _angle(stages.contact.fine.angle[:-1])
    if "reactions" in wanted:
        entries |= _reactions(stages)
        coordinates |= _angle(stages.reactions.fine.angle)
    if "vibration" in wanted:
        entries |= _vibration(stages)
        found = stages.vibration.fine.elastic
        names = np.array([point.name for point in found.points])
        coordinates["frequency"] = _entry(("frequency",), found.frequencies, "Hz", "frequency")
        coordinates["point"] = _entry(("point",), names, "", "point on the casing")
    used = {dim for dims, *_ in entries.values() for dim in dims}
    return xarray.Dataset(entries, {name: entry for name, entry in coordinates.items() if name in used})


def _entry(
    dims: tuple[str, ...], values: npt.ArrayLike, units: str, name: str, figure: str = "", **more: str
) -> Entry:
    shown = {"figure": figure} if figure else {}
    said = {"caption": CAPTIONS[figure]} if figure in CAPTIONS else {}
    return dims, np.asarray(values), {"units": units, "long_name": name} | shown | said | more


def _angle(values: Array) -> Entries:
    return {ANGLE: _entry((ANGLE,), values, "rad", "input angle")}


def _places(stages: Stages) -> Entries:
    """Return the coordinates that name discs, contacts, bearings and axes; all are counted from 1."""
    drive = stages.scene.drive
    numbered = {
        "disc": (drive.discs, "disc, in the order of z"),
        "pin": (drive.pins, "ring pin, the first on the ring's x axis, counter-clockwise"),
        "output_pin": (
            drive.output_pins.count,
            "output pin, the first at output_pins.phase, counter-clockwise",
        ),
        "roller": (drive.eccentric_bearing.rollers, "roller of the eccentric bearing, counter-clockwise"),
    }
    named = {
        "bearing": (BEARINGS, "bearing, A at the lower z"),
        "axis": (("x", "y"), "direction in the fixed frame"),
        "direction": (("x", "y", "z"), "direction in the fixed frame"),
    }
    entries = {
        dim: _entry((dim,), np.arange(1, count + 1), "", said) for dim, (count, said) in numbered.items()
    }
    return entries | {dim: _entry((dim,), np.array(names), "", said) for dim, (names, said) in named.items()}


def _profile(stages: Stages) -> Entries:
    """Return the theoretical flank, which modifications leave as it is."""
    flank, dims = stages.design.flank, ("profile_point",)
    t = np.linspace(0.0, flank.period, PER_LOBE * flank.lobes + 1)
    x, y = flank.point(t).T
    return {
        "profile_parameter": _entry(
            dims, t, "rad", "parameter of the theoretical flank, 2π/lobes for a lobe"
        ),
        "profile_x": _entry(dims, x, "m", "theoretical flank in the disc's frame, x"),
        "profile_y": _entry(dims, y, "m", "theoretical flank in the disc's frame, y"),
        "profile_curvature": _entry(
            dims, flank.curvature(t), "1/m", "curvature of the flank, positive where convex"
        ),
        "profile_pressure_angle": _entry(dims, flank.pressure_angle(t), "rad", "pressure angle"),
    }


def _contact(stages: Stages) -> Entries:
    series, disc = stages.contact.fine, (ANGLE, "disc")
    on_eccentric = np.linalg.norm(_on_eccentrics(stages), axis=-1)
    loaded = (series.ring.force[:-1] > 0).sum(axis=2)
    entries = {
        **_forces(series.ring, "pin", "ring pin", SHARING),
        "loaded_ring_pins": _entry(disc, loaded, "", "loaded ring pins", SHARING),
        **_forces(series.output, "output_pin", "output pin", OUTPUT),
        "eccentric_force": _entry(disc, on_eccentric, "N", "force on the eccentric", ECCENTRIC),
    }
    if series.bearing is not None:
        entries |= _forces(series.bearing, "roller", "roller", ECCENTRIC)
    return entries | _pressures(series) | _flange(stages)


def _forces(touches: Touches, dim: str, name: str, figure: str) -> Entries:
    """Return forces and pressures of all contacts of one kind; a crowd of forces is shown as a map."""
    dims, key = (ANGLE, "disc", dim), name.replace(" ", "_")
    look = {"plot": "heatmap"} if touches.force.shape[2] > MANY else {}
    return {
        f"{key}_force": _entry(dims, touches.force[:-1], "N", f"{name} force", figure, **look),
        f"{key}_pressure": _entry(dims, touches.pressure[:-1], "Pa", f"largest pressure at each {name}"),
    }


def _pressures(series: Series) -> Entries:
    kinds = {"ring_pin": series.ring, "output_pin": series.output, "roller": series.bearing}
    return {
        f"{key}_pressure_max": _entry(
            (ANGLE, "disc"),
            touches.pressure[:-1].max(axis=2),
            "Pa",
            f"pressure, {key.replace('_', ' ')}s",
            PRESSURE,
        )
        for key, touches in kinds.items()
        if touches is not None
    }


def _on_eccentrics(stages: Stages) -> Array:
    """Force (n, d, 2) of each disc on its eccentric, N, in the ring's frame: what pins and inertia leave."""
    from trochoid.drives.khv.contact import centrifugal

    series = stages.contact.fine
    inertia = centrifugal(stages.design, series.crank)
    return np.asarray((inertia - series.ring.resultant - series.output.resultant)[:-1])


def _flange(stages: Stages) -> Entries:
    """Return stiffness and lag at the driven member: the flange, or the ring when the flange is held.

    Seen from the ring, the flange lags by z_p/z_c times what the ring lags seen from the flange; torques likewise.
    """
    drive, series = stages.scene.drive, stages.contact.fine
    share = 1.0 if drive.fixed == "ring" else drive.lobes / drive.pins
    lag = share * series.twist[:-1]
    stiffness = series.torsional_stiffness[:-1] / share**2
    mean = float(lag.mean())
    caption = (
        "Lag of the loaded output behind its ideal angle, less its mean over the turn, the wind-up of "
        f"{np.degrees(mean) * 60:.4g} arcmin."
    )
    said = "lag of the loaded output behind its ideal angle"
    return {
        "torsional_stiffness": _entry((ANGLE,), stiffness, "N*m/rad", "torsional stiffness", STIFFNESS),
        "transmission_error": _entry(
            (ANGLE,), lag - mean, "rad", "transmission error", ERROR, caption=caption
        ),
        "output_lag": _entry((ANGLE,), lag, "rad", said),
    }


def _reactions(stages: Stages) -> Entries:
    found = stages.reactions.fine
    parts = (ANGLE, "bearing", "axis")
    models = {"rigid": found.rigid, "elastic": found.elastic}
    forces = {
        name: np.concatenate([v["shaft"], v["output"]], axis=1) for name, v in models.items() if v is not None
    }
    entries: Entries = {}
    for name, force in forces.items():
        size = np.linalg.norm(force, axis=-1)
        entries[f"reaction_{name}"] = _entry(parts[:2], size, "N", f"reaction, {name}", REACTIONS)
        entries[f"reaction_{name}_components"] = _entry(
            parts, force, "N", f"components of the {name} reaction"
        )
    if "elastic" in forces:
        change = np.linalg.norm(forces["elastic"] - forces["rigid"], axis=-1)
        because = f"Size of the vector difference: {found.reason}."
        entries["reaction_change"] = _entry(parts[:2], change, "N", "difference", CHANGE, caption=because)
    disc, vector = (ANGLE, "disc", "axis"), (ANGLE, "direction")
    entries["eccentric_force_components"] = _entry(
        disc, found.eccentric, "N", "force of each disc on the shaft"
    )
    for name, load in (("rigid", found.casing_rigid), ("elastic", found.casing)):
        said = f"on the casing about the origin, {name} reactions"
        entries[f"casing_force_{name}"] = _entry(vector, load.force, "N", f"force {said}")
        entries[f"casing_moment_{name}"] = _entry(vector, load.moment, "N*m", f"moment {said}")
    return entries


def _vibration(stages: Stages) -> Entries:
    found, dims = stages.vibration.fine, ("frequency", "point", "direction")
    elastic, rigid = (np.moveaxis(v.velocity, -1, 0) for v in (found.elastic, found.rigid))
    band = "10–1000 Hz"
    return {
        "vibration_velocity": _entry(dims, elastic, "m/s", "velocity", VELOCITY, scale="log"),
        "vibration_velocity_rigid": _entry(dims, rigid, "m/s", "velocity by the rigid reactions"),
        "vibration_rms": _entry(dims[1:], found.elastic.rms, "m/s", f"rms velocity, {band}"),
        "vibration_rms_rigid": _entry(
            dims[1:], found.rigid.rms, "m/s", f"rms velocity by the rigid reactions, {band}"
        ),
    }

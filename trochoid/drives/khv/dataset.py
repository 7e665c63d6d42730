"""Series over the input angle, spectra and the profile as one labelled dataset, in SI."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.khv import entries as show
from trochoid.drives.khv.entries import ANGLE, Entries, entry, named, numbered
from trochoid.drives.khv.stages import Stages
from trochoid.drives.vibration_answers import comparison
from trochoid.dynamics.spectrum import harmonics
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    import xarray

    from trochoid.drives.khv.series import Series, Touches

LOST = 0.03  # share of the torque where the lower line begins
MANY = 12  # traces in one row of a figure beyond which a map is clearer
PER_LOBE = 40  # points of the profile
BEARINGS = ("input shaft A", "input shaft B", "output flange A", "output flange B")


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
        coordinates[ANGLE] = entry((ANGLE,), stages.contact.fine.angle[:-1], "rad", "input angle")
    if "reactions" in wanted:
        entries |= _reactions(stages)
        coordinates[ANGLE] = entry((ANGLE,), stages.reactions.fine.angle, "rad", "input angle")
        count = len(entries["reaction_lines_rigid"][1])
        base = stages.scene.operation.input_speed / (2.0 * np.pi)
        coordinates["reaction_frequency"] = entry(
            ("reaction_frequency",), base * np.arange(1, count + 1), "Hz", "frequency"
        )
    if "vibration" in wanted:
        entries |= _vibration(stages)
        found = stages.vibration.fine.elastic
        points = tuple(point.name for point in found.points)
        coordinates["frequency"] = entry(("frequency",), found.frequencies, "Hz", "frequency")
        coordinates["point"] = named("point", points, "point on the casing")
    if "torsion" in wanted:
        entries |= _torsion(stages)
        path = stages.load_path.fine
        torque = stages.scene.operation.output_torque
        coordinates["load_torque"] = entry(("load_torque",), torque * path.share, "N*m", "load torque")
        places = tuple(f"held at {x:.4g}°" for x in np.degrees(path.angle))
        coordinates["held_angle"] = named("held_angle", places, "input angle held")
    if "losses" in wanted:
        entries |= _losses(stages)
        coordinates["running_angle"] = entry(
            ("running_angle",), stages.losses.fine.angle, "rad", "input angle"
        )
    used = {dim for dims, *_ in entries.values() for dim in dims}
    return xarray.Dataset(entries, {name: place for name, place in coordinates.items() if name in used})


def _places(stages: Stages) -> Entries:
    """Return the coordinates of discs, contacts, bearings and axes; all numbers count from 1."""
    drive, pins = stages.scene.drive, stages.scene.drive.output_pins
    rollers = drive.eccentric_bearing.rollers
    return {
        "disc": numbered("disc", drive.discs, "disc, in the order of z"),
        "pin": numbered("pin", drive.pins, "ring pin, the first on the ring's x axis, counter-clockwise"),
        "output_pin": numbered(
            "output_pin", pins.count, "output pin, the first at its phase, counter-clockwise"
        ),
        "roller": numbered("roller", rollers, "roller of the eccentric bearing, counter-clockwise"),
        "bearing": named("bearing", BEARINGS, "bearing, A at the lower z"),
        "axis": named("axis", ("x", "y"), "direction in the fixed frame"),
        "direction": named("direction", ("x", "y", "z"), "direction in the fixed frame"),
    }


def _profile(stages: Stages) -> Entries:
    """Return the theoretical flank, which modifications leave as it is."""
    flank, dims = stages.design.flank, ("profile_point",)
    t = np.linspace(0.0, flank.period, PER_LOBE * flank.lobes + 1)
    x, y = flank.point(t).T
    return {
        "profile_parameter": entry(dims, t, "rad", "parameter of the theoretical flank, 2π/lobes for a lobe"),
        "profile_x": entry(dims, x, "m", "theoretical flank in the disc's frame, x"),
        "profile_y": entry(dims, y, "m", "theoretical flank in the disc's frame, y"),
        "profile_curvature": entry(
            dims, flank.curvature(t), "1/m", "curvature of the flank, positive where convex"
        ),
        "profile_pressure_angle": entry(dims, flank.pressure_angle(t), "rad", "pressure angle"),
    }


def _contact(stages: Stages) -> Entries:
    series, disc = stages.contact.fine, (ANGLE, "disc")
    on_eccentric = np.linalg.norm(_on_eccentrics(stages), axis=-1)
    made = {
        **_forces(series.ring, "pin", "ring pin", show.SHARING),
        "disc_torque_share": entry(disc, _torque_share(stages), "", "share of the torque", show.SHARING),
        "loaded_ring_pins": entry(disc, (series.ring.force[:-1] > 0).sum(axis=2), "", "loaded ring pins"),
        **_forces(series.output, "output_pin", "output pin", show.OUTPUT),
        "eccentric_force": entry(disc, on_eccentric, "N", "force on the eccentric", show.ECCENTRIC),
    }
    if series.bearing is not None:
        made |= _forces(series.bearing, "roller", "roller", show.ECCENTRIC)
    return made | _pressures(series) | _output(stages)


def _forces(touches: Touches, dim: str, name: str, figure: str) -> Entries:
    """Return forces and pressures of all contacts of one kind; a crowd of forces is shown as a map."""
    dims, key = (ANGLE, "disc", dim), name.replace(" ", "_")
    look = {"plot": "heatmap"} if touches.force.shape[2] > MANY else {}
    return {
        f"{key}_force": entry(dims, touches.force[:-1], "N", f"{name} force", figure, **look),
        f"{key}_pressure": entry(dims, touches.pressure[:-1], "Pa", f"largest pressure at each {name}"),
    }


def _pressures(series: Series) -> Entries:
    kinds = {"ring_pin": series.ring, "output_pin": series.output, "roller": series.bearing}
    largest = {
        key: touches.pressure[:-1].max(axis=2) for key, touches in kinds.items() if touches is not None
    }
    return {
        f"{key}_pressure_max": entry(
            (ANGLE, "disc"), values, "Pa", f"pressure, {key.replace('_', ' ')}s", show.PRESSURE
        )
        for key, values in largest.items()
    }


def _on_eccentrics(stages: Stages) -> Array:
    """Force (n, d, 2) of each disc on its eccentric, N, in the ring's frame: what pins and inertia leave."""
    from trochoid.drives.khv.contact import centrifugal

    series = stages.contact.fine
    inertia = centrifugal(stages.design, series.crank)
    return np.asarray((inertia - series.ring.resultant - series.output.resultant)[:-1])


def _torque_share(stages: Stages) -> Array:
    """Share (n, d) of each disc in the torque of the output pins about the axis; 0 without torque."""
    touches = stages.contact.fine.output
    point, push = touches.point[:-1], touches.force[:-1, ..., None] * touches.normal[:-1]
    torque = (point[..., 0] * push[..., 1] - point[..., 1] * push[..., 0]).sum(axis=2)
    loaded = stages.design.flange_torque > 0
    return np.asarray(torque / torque.sum(axis=1, keepdims=True) if loaded else np.zeros_like(torque))


def _output(stages: Stages) -> Entries:
    """Return stiffness and lag at the driven member: the flange, or the ring when the flange is held.

    Seen from the ring, the flange lags by z_p/z_c times what the ring lags seen from the flange, and the flange's
    torque is z_c/z_p of the ring's.
    """
    drive, series = stages.scene.drive, stages.contact.fine
    share = 1.0 if drive.fixed == "ring" else drive.lobes / drive.pins
    lag = share * series.twist[:-1]
    stiffness = series.torsional_stiffness[:-1] / share**2
    mean = float(lag.mean())
    said = "lag of the loaded output behind its ideal angle"
    caption = f"{said.capitalize()}, less its mean over the turn, the wind-up of {np.degrees(mean) * 60:.4g} arcmin."
    error = entry((ANGLE,), lag - mean, "rad", "transmission error", show.ERROR, caption=caption)
    return {
        "torsional_stiffness": entry((ANGLE,), stiffness, "N*m/rad", "torsional stiffness", show.STIFFNESS),
        "transmission_error": error,
        "output_lag": entry((ANGLE,), lag, "rad", said),
    }


def _torsion(stages: Stages) -> Entries:
    """Return the torque-twist path, the middle of its loop and the two lines through it, mean of the held angles."""
    from trochoid.drives.khv.torsion import HALF, middle, torsion

    path, torque = stages.load_path.fine, stages.scene.operation.output_torque
    share = path.share[path.falling]
    center = middle(path)
    once, dims = np.full(len(path.share), np.nan), ("load_torque",)
    lines = []
    for low, high in ((LOST, HALF), (HALF, 1.0)):
        line, inside = once.copy(), (np.abs(share) >= low - 1e-9) & (np.abs(share) <= high + 1e-9)
        ends = [float(np.interp(x, share[::-1], center[::-1])) for x in (-high, -low, low, high)]
        line[path.falling] = np.where(inside, np.interp(share, (-high, -low, low, high), ends), np.nan)
        lines.append(line)
    read = torsion(path, torque)
    lost, left = (np.degrees(x.mean()) * 60 for x in (read.lost_motion, read.backlash))
    caption = (
        f"Angle of the output with the input held, over the load torque: up, down and up again. Lost motion "
        f"{lost:.4g} arcmin, backlash {left:.4g} arcmin. The lines give the stiffness."
    )
    return {
        "torsion_twist": entry(
            ("held_angle", *dims), path.twist, "rad", "twist", show.TORSION, caption=caption
        ),
        "torsion_line_lower": entry(dims, lines[0], "rad", "twist, line 3 to 50 %", show.TORSION),
        "torsion_line_upper": entry(dims, lines[1], "rad", "twist, line 50 to 100 %", show.TORSION),
        "torsion_friction_work": entry(("held_angle", *dims), path.lost, "J", "work that friction took"),
    }


def _losses(stages: Stages) -> Entries:
    """Return what the running drive loses, per radian of the input."""
    found, share = stages.losses.fine, abs(stages.design.mesh_speed)
    dims = ("running_angle", "disc")
    return {
        "ring_pin_loss": entry(dims, share * found.ring.sum(axis=2), "N*m", "loss, ring pins", show.LOSSES),
        "output_pin_loss": entry(
            dims, share * found.output.sum(axis=2), "N*m", "loss, output pins", show.LOSSES
        ),
    }


def _reactions(stages: Stages) -> Entries:
    found = stages.reactions.fine
    parts = (ANGLE, "bearing", "axis")
    models = {"rigid": found.rigid, "elastic": found.elastic}
    forces = {
        k: np.concatenate([v["shaft"], v["output"]], axis=1) for k, v in models.items() if v is not None
    }
    made: Entries = {}
    for name, force in forces.items():
        size = np.linalg.norm(force, axis=-1)
        made[f"reaction_{name}"] = entry(parts[:2], size, "N", f"reaction, {name}", show.REACTIONS)
        made[f"reaction_{name}_components"] = entry(parts, force, "N", f"components of the {name} reaction")
    for name, force in forces.items():
        lines = np.linalg.norm(harmonics(force)[1:], axis=-1)
        dims = ("reaction_frequency", "bearing")
        made[f"reaction_lines_{name}"] = entry(
            dims, lines, "N", f"amplitude, {name}", show.LINES, scale="log"
        )
    if "elastic" in forces:
        change = np.linalg.norm(forces["elastic"] - forces["rigid"], axis=-1)
        made["reaction_change"] = entry(parts[:2], change, "N", "difference", show.CHANGE)
    disc, vector = (ANGLE, "disc", "axis"), (ANGLE, "direction")
    made["eccentric_force_components"] = entry(disc, found.eccentric, "N", "force of each disc on the shaft")
    for name, load in (("rigid", found.casing_rigid), ("elastic", found.casing)):
        said = f"on the casing about the origin, {name} reactions"
        made[f"casing_force_{name}"] = entry(vector, load.force, "N", f"force {said}")
        made[f"casing_moment_{name}"] = entry(vector, load.moment, "N*m", f"moment {said}")
    return made


def _vibration(stages: Stages) -> Entries:
    found, dims = stages.vibration.fine, ("frequency", "point", "direction")
    elastic, rigid = (np.moveaxis(v.velocity, -1, 0) for v in (found.elastic, found.rigid))
    low, high = found.elastic.band
    band = f"{low:g} to {high:g} Hz"
    by_rigid = "by the rigid reactions"
    return {
        "vibration_velocity": entry(dims, elastic, "m/s", "velocity", show.VELOCITY, scale="log"),
        "vibration_velocity_rigid": entry(dims, rigid, "m/s", f"velocity {by_rigid}"),
        "vibration_rms": entry(dims[1:], found.elastic.rms, "m/s", f"rms velocity, {band}"),
        "vibration_rms_rigid": entry(dims[1:], found.rigid.rms, "m/s", f"rms velocity {by_rigid}, {band}"),
        **comparison(found),
    }

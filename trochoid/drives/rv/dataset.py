"""Series over the input angle, lines of the transmission error and the profile as one labelled dataset, in SI."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from trochoid.drives.entries import ANGLE, Entries, Entry, entry, named, numbered
from trochoid.drives.rv.stages import Stages
from trochoid.drives.vibration_answers import comparison
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    import xarray

    from trochoid.drives.rv.series import Series

PER_LOBE = 40  # points of the profile
SHARING, CRANKS, ARMS = "Load sharing of the ring pins", "Crank bearings", "Turning-arm bearings"
CRANK_SHARES, PRESSURE = "Load sharing of the crankshafts", "Contact pressure"
STIFFNESS, ERROR, LINES, TEETH = (
    "Torsional stiffness",
    "Transmission error",
    "Lines of the transmission error",
    "Stiffness of the teeth",
)
YIELDING = "Where the drive yields"
REACTIONS, CHANGE = "Bearing reactions", "Elastic less rigid reactions"
REACTION_LINES, VELOCITY = "Harmonics of the bearing reactions", "Vibration velocity"
FAINT = 1e-4  # of the loudest line: what is not shown
CAPTIONS = {
    SHARING: "Force of every ring pin on each disc, and each disc's share of the torque.",
    CRANKS: "Size of the force of each crankshaft on the carrier, A at the lower z.",
    ARMS: "Force between each disc and each crankshaft.",
    CRANK_SHARES: "Share of each crankshaft in the torques of sun and carrier.",
    PRESSURE: "Largest pressure at pins and rollers on each disc.",
    STIFFNESS: "Torque per angle at the output with the input held: the tangent at the operating torque.",
    LINES: "Amplitude over the order, in multiples of the input speed; the crankshafts turn once in each.",
    TEETH: "One mesh of sun and planet over a base pitch, along the line of action.",
    REACTIONS: "Size of the force in each bearing of crankshafts and carrier, A at the lower z.",
    CHANGE: "Size of the vector difference: what the inertia of the members' elastic motion adds.",
    REACTION_LINES: "Larger half axis of the force's ellipse in the carrier's frame, over orders of the input speed.",
    VELOCITY: "Amplitude at all lines that the casing feels, by the vector sum of all forces on it.",
    YIELDING: "Share of each part in the angle of the output per torque.",
}
PART_WORDS = {
    "ring_pins": "ring pins",
    "discs": "discs",
    "arm_bearings": "turning-arm bearings",
    "crankshafts": "crankshafts",
    "crank_bearings": "crank bearings",
    "first_stage": "teeth of the first stage",
    "sun_support": "support of the sun",
    "turning_levers": "turning levers",
    "wandering_contacts": "contacts that the load moves",
}


def dataset(stages: Stages, wanted: Collection[str]) -> xarray.Dataset:
    """Return what the stages hold if `wanted`; no other stage is started."""
    import xarray

    entries, coordinates = _profile(stages), _places(stages)
    if "contact" in wanted:
        from trochoid.drives.rv.spectrum import order_of

        entries |= _contact(stages) | _output(stages) | _lines(stages)
        order = order_of(stages.design) * np.arange(1, len(entries["transmission_error_lines"][1]) + 1)
        coordinates["order"] = entry(("order",), order, "", "order, multiple of the input speed")
        coordinates[ANGLE] = entry((ANGLE,), stages.contact.fine.angle, "rad", "input angle")
    if "reactions" in wanted:
        entries |= _reactions(stages)
        coordinates["reaction_angle"] = entry(
            ("reaction_angle",), stages.reactions.angle, "rad", "input angle"
        )
        names = reaction_names(stages)
        coordinates["reaction"] = named("reaction", names, "bearing, A at the lower z")
    if "vibration" in wanted:
        found = stages.vibration.elastic
        entries |= _vibration(stages)
        coordinates["frequency"] = entry(("frequency",), found.frequencies[heard(stages)], "Hz", "frequency")
        coordinates["point"] = named("point", tuple(p.name for p in found.points), "point on the casing")
        coordinates["direction"] = named("direction", ("x", "y", "z"), "direction in the fixed frame")
    if "teeth" in wanted:
        path, dims = stages.teeth.fine, ("sun_angle",)
        entries["tooth_stiffness"] = _shown(dims, path.stiffness, "N/m", "stiffness of one mesh", TEETH)
        coordinates["sun_angle"] = entry(dims, path.angle, "rad", "angle of the sun")
    used = {dim for dims, *_ in entries.values() for dim in dims}
    return xarray.Dataset(entries, {name: place for name, place in coordinates.items() if name in used})


def _shown(
    dims: tuple[str, ...], values: npt.ArrayLike, units: str, name: str, figure: str, **more: str
) -> Entry:
    return entry(dims, values, units, name, figure, **({"caption": CAPTIONS[figure]} | more))


def _places(stages: Stages) -> Entries:
    """Return the coordinates of discs, contacts and bearings; all numbers count from 1."""
    from trochoid.drives.rv.breakdown import PARTS

    drive = stages.scene.drive
    cranks = drive.first_stage.cranks
    return {
        "disc": numbered("disc", drive.cycloid.discs, "disc, in the order of z"),
        "pin": numbered(
            "pin", drive.cycloid.pins, "ring pin, the first on the ring's x axis, counter-clockwise"
        ),
        "crankshaft": numbered("crankshaft", cranks, "crankshaft, the first on the carrier's x axis"),
        "roller": numbered("roller", drive.arm_bearing.rollers, "roller of a turning-arm bearing"),
        "bearing": named("bearing", ("bearing A", "bearing B"), "bearing of a crankshaft, A at the lower z"),
        "axis": named("axis", ("x", "y"), "direction in the carrier's frame"),
        "component": named("component", ("x", "y", "z"), "direction in the carrier's frame"),
        "part": named("part", tuple(PART_WORDS[name] for name in PARTS), "part of the drive"),
    }


def _profile(stages: Stages) -> Entries:
    """Return the theoretical flank, which modifications leave as it is."""
    flank, dims = stages.design.flank, ("profile_point",)
    t = np.linspace(0.0, flank.period, PER_LOBE * flank.lobes + 1)
    x, y = flank.point(t).T
    bend = "curvature of the flank, positive where convex"
    return {
        "profile_parameter": entry(dims, t, "rad", "parameter of the theoretical flank, 2π/lobes for a lobe"),
        "profile_x": entry(dims, x, "m", "theoretical flank in the disc's frame, x"),
        "profile_y": entry(dims, y, "m", "theoretical flank in the disc's frame, y"),
        "profile_curvature": entry(dims, flank.curvature(t), "1/m", bend),
        "profile_pressure_angle": entry(dims, flank.pressure_angle(t), "rad", "pressure angle"),
    }


def _contact(stages: Stages) -> Entries:
    from trochoid.drives.rv.answers_contact import crank_shares, disc_shares

    series, disc = stages.contact.fine, (ANGLE, "disc")
    crank = (ANGLE, "crankshaft")
    mesh = series.mesh_force
    whole = mesh.sum(axis=1, keepdims=True)
    at_sun = np.divide(mesh, whole, out=np.zeros_like(mesh), where=whole != 0)
    bearing = np.linalg.norm(series.bearing_force, axis=-1)
    arm = np.linalg.norm(series.arm.resultant, axis=-1)
    made = {
        "ring_pin_force": _shown(
            (*disc, "pin"), series.ring.force, "N", "ring pin force", SHARING, plot="heatmap"
        ),
        "ring_pin_pressure": entry((*disc, "pin"), series.ring.pressure, "Pa", "pressure at each ring pin"),
        "disc_torque_share": _shown(disc, disc_shares(stages, series), "", "share of the torque", SHARING),
        "sun_torque_share": _shown(crank, at_sun, "", "share of the sun's torque", CRANK_SHARES),
        "arm_force": _shown((*disc, "crankshaft"), arm, "N", "force of a disc on a crankshaft", ARMS),
        "arm_roller_force": entry(
            (*disc, "crankshaft", "roller"),
            series.arm.force,
            "N",
            "force of a roller of a turning-arm bearing",
        ),
        "tooth_force": entry(crank, mesh, "N", "normal force of the teeth of a planet"),
        "ring_pin_pressure_max": _shown(
            disc, series.ring.pressure.max(axis=2), "Pa", "pressure, ring pins", PRESSURE
        ),
        "arm_roller_pressure_max": _shown(
            disc, series.arm.pressure.max(axis=(2, 3)), "Pa", "pressure, rollers", PRESSURE
        ),
    }
    if stages.scene.has("bearing_compliance"):  # else nothing tells what the crank bearings carry
        made |= {
            "carrier_torque_share": _shown(
                crank, crank_shares(stages, series), "", "share of the carrier's torque", CRANK_SHARES
            ),
            "crank_bearing_force": _shown((*crank, "bearing"), bearing, "N", "crank-bearing force", CRANKS),
            "crank_bearing_force_components": entry(
                (*crank, "bearing", "axis"), series.bearing_force, "N", "force of a crankshaft on the carrier"
            ),
        }
    return made


def _output(stages: Stages) -> Entries:
    """Return stiffness, its split, and lag at the driven member; see `Design.leverage`."""
    series, share = stages.contact.fine, stages.design.leverage
    lag = series.twist / share
    mean = float(lag.mean())
    said = "lag of the loaded output behind its ideal angle"
    caption = f"{said.capitalize()}, less its mean over the turn, the wind-up of {math.degrees(mean) * 60:.4g} arcmin."
    stiffness = share**2 / series.compliance
    parts = series.parts / share**2
    return {
        "torsional_stiffness": _shown((ANGLE,), stiffness, "N*m/rad", "torsional stiffness", STIFFNESS),
        "compliance_parts": entry((ANGLE, "part"), parts, "rad/(N*m)", "compliance of each part"),
        "compliance_shares": _shown(
            (ANGLE, "part"),
            series.parts / series.compliance[:, None],
            "",
            "share of the compliance",
            YIELDING,
        ),
        "transmission_error": entry(
            (ANGLE,), lag - mean, "rad", "transmission error", ERROR, caption=caption
        ),
        "output_lag": entry((ANGLE,), lag, "rad", said),
        "input_torque": entry((ANGLE,), _sun_torque(stages, series), "N*m", "torque on the sun"),
    }


def _sun_torque(stages: Stages, series: Series) -> Array:
    return np.asarray(series.mesh_force.sum(axis=1) * stages.design.first.pair.first.base_radius)


def _lines(stages: Stages) -> Entries:
    from trochoid.drives.rv.spectrum import twist_lines

    amplitude = twist_lines(stages.contact.fine)[1:] / stages.design.leverage
    return {
        "transmission_error_lines": _shown(
            ("order",), amplitude, "rad", "amplitude of the transmission error", LINES, scale="log"
        ),
    }


def reaction_names(stages: Stages) -> tuple[str, ...]:
    """Return the bearings of all crankshafts and of the carrier."""
    cranks = range(1, stages.scene.drive.first_stage.cranks + 1)
    return (*(f"crankshaft {j} {b}" for j in cranks for b in "AB"), "carrier A", "carrier B")


def _reactions(stages: Stages) -> Entries:
    from trochoid.drives.rv.spectrum import force_lines

    found, dims = stages.reactions, ("reaction_angle", "reaction")
    made: Entries = {}
    models = {"rigid": found.rigid} | ({} if found.elastic is None else {"elastic": found.elastic})
    vectors = {
        name: np.concatenate([x.crank.reshape(len(found.angle), -1, 2), x.main], axis=1)
        for name, x in models.items()
    }
    for name, force in vectors.items():
        size = np.linalg.norm(force, axis=-1)
        made[f"reaction_{name}"] = _shown(dims, size, "N", f"reaction, {name}", REACTIONS)
        said = f"components of the {name} reaction, carrier's frame"
        made[f"reaction_{name}_components"] = entry((*dims, "axis"), force, "N", said)
        lines = np.stack([force_lines(force[:, b, None]) for b in range(force.shape[1])], axis=1)[1:]
        said = f"amplitude, {name}"
        made[f"reaction_lines_{name}"] = _shown(
            ("order", "reaction"), lines, "N", said, REACTION_LINES, scale="log"
        )
    if "elastic" in vectors:
        change = np.linalg.norm(vectors["elastic"] - vectors["rigid"], axis=-1)
        made["reaction_change"] = _shown(dims, change, "N", "difference", CHANGE)
    vector = ("reaction_angle", "component")
    for name, load in (("rigid", found.casing_rigid), ("elastic", found.casing)):
        said = f"on the casing about the origin, {name} reactions, carrier's frame"
        made[f"casing_force_{name}"] = entry(vector, load.force, "N", f"force {said}")
        made[f"casing_moment_{name}"] = entry(vector, load.moment, "N*m", f"moment {said}")
    return made


def heard(stages: Stages) -> npt.NDArray[np.bool_]:
    """Return which lines (f,) of the vibration are not empty: the record is longer than the load's period."""
    size = np.abs(stages.vibration.elastic.velocity).max(axis=(0, 1))
    return np.asarray(size >= FAINT * size.max(initial=0.0))


def _vibration(stages: Stages) -> Entries:
    found, dims = stages.vibration, ("frequency", "point", "direction")
    lines = heard(stages)
    elastic, rigid = (np.moveaxis(v.velocity, -1, 0)[lines] for v in (found.elastic, found.rigid))
    low, high = found.elastic.band
    band, by_rigid = f"{low:g} to {high:g} Hz", "by the rigid reactions"
    return {
        "vibration_velocity": _shown(
            dims, np.abs(elastic), "m/s", "amplitude of the velocity", VELOCITY, scale="log"
        ),
        "vibration_velocity_rigid": entry(
            dims, np.abs(rigid), "m/s", f"amplitude of the velocity {by_rigid}"
        ),
        "vibration_rms": entry(dims[1:], found.elastic.rms, "m/s", f"rms velocity, {band}"),
        "vibration_rms_rigid": entry(dims[1:], found.rigid.rms, "m/s", f"rms velocity {by_rigid}, {band}"),
        **comparison(found, np.flatnonzero(lines)),
    }

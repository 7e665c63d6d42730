"""Entries of the dataset of a set that moves: reactions, vibration; and the load over the face width."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from trochoid.drives.entries import ANGLE, Entries, entry, named
from trochoid.drives.planetary.moving import MAIN
from trochoid.drives.planetary.stages import Stages
from trochoid.drives.vibration_answers import comparison
from trochoid.dynamics.spectrum import harmonics

BEARINGS, MESH, LINES = "Force on the planets' bearings", "Mesh forces", "Harmonics of the reactions"
VELOCITY, FACE = "Vibration velocity", "Load over the face width"
CAPTIONS = {
    BEARINGS: "With the inertia of the members, and without it; rigid members press evenly.",
    MESH: "Normal force in both meshes of the first planet, with the inertia of the members, and without it; of rigid "
    "members it is constant.",
    LINES: "Amplitude at the multiples of the mesh frequency, of the torque that holds the fixed member.",
    VELOCITY: "Amplitude by the forces of the bearings and the torque that holds the fixed member.",
    FACE: "All teeth of a mesh together, at the position where the largest slice is most above the mean.",
}


def moving_entries(stages: Stages, ran: Collection[str]) -> tuple[Entries, Entries]:
    """Return entries and coordinates of the stages "reactions", "vibration" and "face", if they `ran`."""
    made: Entries = {}
    coordinates: Entries = {}
    for stage, read in (("reactions", _reactions), ("vibration", _vibration), ("face", _face)):
        if stage in ran:
            entries, places = read(stages)
            made |= entries
            coordinates |= places
    return made, coordinates


def _reactions(stages: Stages) -> tuple[Entries, Entries]:
    found, fixed = stages.reactions.fine, stages.scene.drive.fixed
    rigid = np.array([stages.rigid.torques[name] for name in MAIN])
    made: Entries = {}
    dims = (ANGLE, "member")
    held = f"Torque that holds the {fixed}"
    caption = (
        "Of rigid members it is constant; elastic ones have a transmission error, and inertia acts back."
    )
    count = len(found.torque["sun"])
    for name, torque, force, bearing, mesh in (
        ("elastic", found.torque, found.force, found.bearing, found.mesh),
        ("without_inertia", found.static_torque, found.static_force, found.static_bearing, found.static_mesh),
    ):
        said = name.replace("_", " ")
        made[f"reaction_{name}_torque"] = entry(
            dims, np.stack([torque[m] for m in MAIN], axis=1), "N*m", f"torque from outside, {said}"
        )
        made[f"reaction_{name}_force"] = entry(
            (*dims, "axis"), np.stack([force[m] for m in MAIN], axis=1), "N", f"force on the bearings, {said}"
        )
        made[f"holding_torque_{name}"] = entry(
            (ANGLE,), torque[fixed], "N*m", f"torque, {said}", held, caption=caption
        )
        made[f"planet_bearing_{name}"] = entry(
            (ANGLE, "planet"),
            np.linalg.norm(bearing, axis=-1),
            "N",
            f"force, {said}",
            BEARINGS,
            caption=CAPTIONS[BEARINGS],
        )
        made[f"mesh_force_{name}"] = entry((ANGLE, "mesh", "planet"), mesh, "N", f"normal force, {said}")
        made[f"first_mesh_force_{name}"] = entry(
            (ANGLE, "mesh"), mesh[:, :, 0], "N", f"force, {said}", MESH, caption=CAPTIONS[MESH]
        )
        made[f"holding_torque_lines_{name}"] = entry(
            ("mesh_frequency",),
            np.abs(harmonics(torque[fixed])[1:]),
            "N*m",
            f"amplitude, {said}",
            LINES,
            scale="log",
            caption=CAPTIONS[LINES],
        )
    made["reaction_rigid_torque"] = entry(
        dims, np.tile(rigid, (count, 1)), "N*m", "torque from outside, rigid"
    )
    made["holding_torque_rigid"] = entry(
        (ANGLE,), np.full(count, rigid[MAIN.index(fixed)]), "N*m", "torque, rigid", held, caption=caption
    )
    planets = found.bearing.shape[1]
    made["planet_bearing_rigid"] = entry(
        (ANGLE, "planet"),
        np.full((count, planets), stages.rigid.bearing),
        "N",
        "force, rigid",
        BEARINGS,
        caption=CAPTIONS[BEARINGS],
    )
    normal = [stages.rigid.outer.normal, stages.rigid.inner.normal]
    made["first_mesh_force_rigid"] = entry(
        (ANGLE, "mesh"), np.tile(normal, (count, 1)), "N", "force, rigid", MESH, caption=CAPTIONS[MESH]
    )
    lines = found.speed / (2.0 * np.pi) * np.arange(1, (count - 1) // 2 + 1)
    return made, {
        "member": named("member", MAIN, "member"),
        "mesh_frequency": entry(("mesh_frequency",), lines, "Hz", "frequency"),
    }


def _vibration(stages: Stages) -> tuple[Entries, Entries]:
    found, dims = stages.vibration.fine, ("frequency", "point", "direction")
    elastic, static = (np.moveaxis(v.velocity, -1, 0) for v in (found.elastic, found.static))
    low, high = found.elastic.band
    # the lines are those of the mesh with side bands of the carrier's turning: all others are nothing
    heard = np.flatnonzero(np.abs(elastic).max(axis=(1, 2)) > 1e-9 * np.abs(elastic).max(initial=0.0))
    band, slow = f"{low:g} to {high:g} Hz", "without inertia"
    points = tuple(point.name for point in found.elastic.points)
    made = {
        "vibration_velocity": entry(
            dims, elastic[heard], "m/s", "velocity", VELOCITY, scale="log", caption=CAPTIONS[VELOCITY]
        ),
        "vibration_velocity_without_inertia": entry(dims, static[heard], "m/s", f"velocity {slow}"),
        "vibration_rms": entry(dims[1:], found.elastic.rms, "m/s", f"rms velocity, {band}"),
        "vibration_rms_without_inertia": entry(
            dims[1:], found.static.rms, "m/s", f"rms velocity {slow}, {band}"
        ),
        **comparison(found, heard),
    }
    return made, {
        "frequency": entry(("frequency",), found.elastic.frequencies[heard], "Hz", "frequency"),
        "point": named("point", points, "point on the casing"),
        "direction": named("direction", ("x", "y", "z"), "direction"),
    }


def _face(stages: Stages) -> tuple[Entries, Entries]:
    found, made = stages.faces.fine, {}
    for name, load in (("sun_and_planet", found.outer), ("planet_and_ring", found.inner)):
        worst = int(load.factor.argmax())
        made[f"line_load_{name}"] = entry(
            ("face_place",),
            load.line_load[worst].sum(axis=0),
            "N/m",
            f"line load, {name.replace('_', ' ')}",
            FACE,
            caption=CAPTIONS[FACE],
        )
    return made, {
        "face_place": entry(("face_place",), found.places, "m", "place from the middle of the face width")
    }

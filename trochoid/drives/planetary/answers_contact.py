"""Answers from the elastic contacts over one pitch of the meshes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.exact import ARCMIN, RPM
from trochoid.drives.mesh_error import Pair, sampling_error, scalar_error
from trochoid.drives.planetary.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.planetary.meshes import Meshes
    from trochoid.drives.planetary.roots import Roots
    from trochoid.drives.planetary.series import Series, Touches
    from trochoid.fem.gear_path import Path

STILL = 1e-13  # m: what rounding leaves of a member that does not move


def number(s: Stages, pair: Pair[float], unit: str) -> Quantity:
    """Return a number with the error that two mesh levels suggest, and the model that gave it."""
    error = None if pair.coarse is None else scalar_error(pair.fine, pair.coarse, s.difference)
    return Quantity(pair.fine, unit, error, s.rung)


def over_pitch(s: Stages, get: Callable[[Series], float], unit: str) -> Quantity:
    """Return a number of the contacts over a pitch; its error is that of the mesh and of few positions."""
    found = number(s, Pair(s.contact.fine, s.contact.coarse).map(get), unit)
    if found.error is None:
        return found
    return replace(found, error=found.error + sampling_error(get, s.contact.fine, s.contact.fine.thinned))


def load_sharing(s: Stages) -> Quantity:
    """How the torque is shared by the planets, and the load of a mesh by its pairs of teeth."""
    count = s.scene.drive.planets
    planets = {
        f"planet_{i + 1}": over_pitch(s, lambda x, i=i: float(x.shares[:, i].mean()), "")  # type: ignore[misc]
        for i in range(count)
    }
    parts: dict[str, Quantity | Parts] = {
        "mean_share_of_the_torque": planets,
        "largest_share": over_pitch(s, lambda x: float(x.shares.max()), ""),
        "overload_of_a_planet": over_pitch(s, lambda x: count * float(x.shares.max()), ""),
        "pairs_of_teeth": {
            "sun_and_planet_mean": over_pitch(s, lambda x: _touching(x.sun), ""),
            "planet_and_ring_mean": over_pitch(s, lambda x: _touching(x.ring), ""),
            "sun_and_planet_largest_share": over_pitch(s, lambda x: _largest_share(x.sun), ""),
            "planet_and_ring_largest_share": over_pitch(s, lambda x: _largest_share(x.ring), ""),
        },
    }
    note = "overload: largest torque of a planet over an even share, K_γ"
    if s.scene.drive.lead is not None:
        parts["face_load_factor"] = {
            "sun_and_planet": _face(s, s.faces.map(lambda f: float(f.outer.factor.max()))),
            "planet_and_ring": _face(s, s.faces.map(lambda f: float(f.inner.factor.max()))),
        }
        note += "; face load factor: largest over mean load of a slice of the face width, K_Hβ"
    return Quantity(parts=parts, note=note)


def _face(s: Stages, factor: Pair[float]) -> Quantity:
    """Return a face load factor; its error is the whole difference from half of the slices on the coarser mesh, as the
    load of a slice is a mean over its width.
    """
    error = None if factor.coarse is None else abs(factor.fine - factor.coarse)
    return Quantity(factor.fine, "", error, s.rung)


def _touching(touches: Touches) -> float:
    return float((touches.force > 0).sum(axis=2).mean())


def _largest_share(touches: Touches) -> float:
    whole = touches.force.sum(axis=2)
    return float(np.divide(touches.force.max(axis=2), whole, out=np.zeros_like(whole), where=whole > 0).max())


def contact_force_max(s: Stages) -> Quantity:
    """Largest force on one pair of teeth in each kind of mesh."""
    return _largest(s, lambda touches: touches.force, 1.0, "N")


def contact_pressure_max(s: Stages) -> Quantity:
    """Largest contact pressure in each kind of mesh."""
    answer = _largest(s, lambda touches: touches.pressure, 1e-6, "MPa")
    tip = s.contact.fine.rounding * 1e3
    note = (
        f"where a tip edge of radius {tip:.3g} mm meets a flank early or late, that edge has the largest; tip relief "
        "lowers it"
    )
    return replace(answer, note=note)


def _largest(s: Stages, get: Callable[[Touches], Array], scale: float, unit: str) -> Quantity:
    return Quantity(
        parts={
            "sun_and_planet": over_pitch(s, lambda x: float(get(x.sun).max()) * scale, unit),
            "planet_and_ring": over_pitch(s, lambda x: float(get(x.ring).max()) * scale, unit),
        }
    )


def stress_max(s: Stages) -> Quantity:
    """Largest tension in the fillets of the teeth of each wheel."""

    def of(get: Callable[[Roots], Array]) -> Quantity:
        return number(s, s.roots.map(lambda r: 1e-6 * float(get(r).max())), "MPa")

    parts = {
        "sun_root": of(lambda r: r.sun),
        "planet_root": of(lambda r: r.planet),
        "ring_root": of(lambda r: r.ring),
    }
    return Quantity(
        parts=parts, note="largest tension along the fillets of the teeth that carry, over a pitch"
    )


def transmission_error(s: Stages) -> Quantity:
    """Loaded transmission error of the driven member over a pitch, and its mean, the wind-up."""
    parts = {
        "peak_to_peak": over_pitch(s, lambda x: float(np.ptp(x.lag)) / ARCMIN * 60, "arcsec"),
        "wind_up": over_pitch(s, lambda x: float(x.lag.mean()) / ARCMIN, "arcmin"),
    }
    load = abs(s.contact.fine.load.driven)
    shafts = {"sun": "sun_shaft", "ring": "ring_seat", "carrier": "carrier"}
    for member, twist in s.contact.fine.twists.items():
        parts[f"of_it_{shafts[member]}"] = Quantity(twist * load / ARCMIN, "arcmin", 0.0, "exact")
    return Quantity(parts=parts)


def torsional_stiffness(s: Stages) -> Quantity:
    """Torque per angle at the output with the input held, mean over a pitch: the tangent at the load."""
    answer = over_pitch(s, lambda x: float(x.torsional_stiffness.mean()) * ARCMIN, "N*m/arcmin")
    return replace(answer, note=_said(s))


def _said(s: Stages) -> str:
    twisting = " and ".join(s.contact.fine.twists)
    rest = f"with the twist of {twisting}" if twisting else "shafts and carrier do not twist"
    return f"tangent at the operating torque, mean over a pitch; {rest}"


def mesh_stiffness(s: Stages) -> Quantity:
    """Normal force per approach along the line of action of one planet's meshes, each by itself: the tangent."""
    width = s.scene.drive.face_width
    parts = {
        name: _mesh(s, get, width) for name, get in (("sun_and_planet", _outer), ("planet_and_ring", _inner))
    }
    note = "under an even share of the torque, centres held"
    if s.scene.drive.ring.held == "evenly":
        note += "; the ring's rim bends under this one mesh alone, more than under all of them"
    return Quantity(parts=parts, note=note)


def _outer(meshes: Meshes) -> Path:
    return meshes.outer


def _inner(meshes: Meshes) -> Path:
    return meshes.inner


def _mesh(s: Stages, get: Callable[[Meshes], Path], width: float) -> Quantity:
    def of(read: Callable[[Array], float], unit: str, scale: float) -> Quantity:
        return number(s, s.meshes.map(lambda m: scale * read(get(m).stiffness)), unit)

    return Quantity(
        parts={
            "mean": of(lambda k: float(k.mean()), "N/um", 1e-6),
            "least": of(lambda k: float(k.min()), "N/um", 1e-6),
            "largest": of(lambda k: float(k.max()), "N/um", 1e-6),
            "mean_per_face_width": of(lambda k: float(k.mean()), "N/mm/um", 1e-9 / width),
        }
    )


def elastic_bearing_loads(s: Stages) -> Quantity:
    """Forces on the planets' bearings and on those of the other members over a pitch, and how far these float."""

    on = float(s.speeds.relative("planet", "carrier")) * s.scene.operation.input_speed
    parts: dict[str, Quantity | Parts] = {
        "planet_bearing": {
            "largest": over_pitch(s, lambda x: float(_size(x.bearing).max()), "N"),
            "mean": over_pitch(s, lambda x: float(_size(x.bearing).mean()), "N"),
            "speed": Quantity(on / RPM, "rpm", 0.0, "exact"),
        }
    }
    for member in ("sun", "ring", "carrier"):
        parts[member] = _member(s, member)
    return Quantity(parts=parts, note="what is left on sun, ring and carrier of unequal planets")


def _member(s: Stages, member: str) -> Parts:
    """Return the largest force that a member's own bearings take, and how far it moves in them."""

    def moved(x: Series) -> float:
        way = float(_size(x.moved(member)[:, :2]).max())
        return 1e6 * way if way > STILL else 0.0

    made = {"largest": over_pitch(s, lambda x: float(_size(x.members[member]).max()), "N")}
    if f"{member}.x" in s.contact.fine.layout.names:
        made["displacement"] = over_pitch(s, moved, "um")
    return made


def _size(vectors: Array) -> Array:
    return np.asarray(np.hypot(vectors[..., 0], vectors[..., 1]))

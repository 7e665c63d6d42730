"""Series over the input angle and along the paths of contact as one labelled dataset, in SI."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.entries import ANGLE, Entries, entry, named, numbered
from trochoid.drives.planetary.blocking_entries import blocking_entries
from trochoid.drives.planetary.mesh_phase import MESHES, period, places
from trochoid.drives.planetary.moving_entries import moving_entries
from trochoid.drives.planetary.stages import Stages
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    import xarray

SHARING, PAIRS, SLIDING = "Load sharing of the planets", "Pairs of teeth in mesh", "Specific sliding"
PITCHES = 2  # over which the series go
PER_TOOTH = 40


def dataset(stages: Stages, ran: Collection[str]) -> xarray.Dataset:
    """Return the profiles, what slides along the paths of contact, the pairs in mesh over two pitches; and over one
    pitch what the stages "contact" and "meshes" hold, if they `ran`.
    """
    import xarray

    wide = np.linspace(0.0, PITCHES * _period(stages), 401)
    coordinates = {
        "rolled_angle": entry(("rolled_angle",), wide, "rad", "input angle"),
        "mesh": named("mesh", MESHES, "mesh"),
        "planet": numbered("planet", stages.scene.drive.planets, "planet, the first on the carrier's x axis"),
        "path": entry(("path",), np.linspace(0.0, 1.0, 101), "", "share of the path of contact"),
    }
    entries = {**_profiles(stages), **_sliding(stages), **_pairs(stages, wide)}
    if "contact" in ran:
        entries = {**_contact(stages), **entries}
        coordinates[ANGLE] = entry((ANGLE,), stages.contact.fine.angle, "rad", "input angle")
        coordinates["axis"] = named("axis", ("x", "y"), "direction in the carrier's frame")
    if "stress" in ran:
        entries = {**entries, **_roots(stages)}
    if "meshes" in ran:
        entries = {**_meshes(stages), **entries}
        coordinates["base_pitch"] = entry(
            ("base_pitch",),
            np.arange(stages.scene.ask.positions) / stages.scene.ask.positions,
            "",
            "share of a base pitch",
        )
    if "blocking" in ran:
        entries = {**entries, **blocking_entries(stages)}
    made, more = moving_entries(stages, ran)
    entries, coordinates = {**made, **entries}, coordinates | more
    return xarray.Dataset(entries, coordinates)


def blocking_dataset(stages: Stages) -> xarray.Dataset:
    """Return the boundaries of the blocking contours alone."""
    import xarray

    return xarray.Dataset(blocking_entries(stages))


def _period(stages: Stages) -> float:
    return period(stages.feasible.given, float(stages.speeds.relative("sun", "carrier")))


def _profiles(stages: Stages) -> Entries:
    made = {}
    for name in ("sun", "planet", "ring"):
        curve = getattr(stages.curves, name)
        x, y = curve.point(np.linspace(-0.5, 0.5, PER_TOOTH + 1)).T
        dims, said = (f"{name}_profile_point",), f"one space of the {name}, tooth middle to tooth middle"
        made[f"{name}_profile_x"] = entry(dims, x, "m", f"{said}, x")
        made[f"{name}_profile_y"] = entry(dims, y, "m", f"{said}, y")
    return made


def _contact(stages: Stages) -> Entries:
    series, dims = stages.contact.fine, (ANGLE, "planet")
    lag = series.lag
    said = "lag of the loaded output behind its ideal angle"
    mean = float(np.degrees(lag.mean()) * 60)
    made = {
        "planet_torque_share": entry(
            dims,
            series.shares,
            "",
            "share of the torque",
            SHARING,
            caption="Share of each planet in the sun's torque.",
        ),
        "transmission_error": entry(
            (ANGLE,),
            lag - lag.mean(),
            "rad",
            "transmission error",
            "Transmission error",
            caption=f"{said.capitalize()}, less its mean over the pitch, the wind-up of {mean:.4g} arcmin.",
        ),
        "output_lag": entry((ANGLE,), lag, "rad", said),
        "torsional_stiffness": entry(
            (ANGLE,),
            series.torsional_stiffness,
            "N*m/rad",
            "torsional stiffness",
            "Torsional stiffness",
            caption="Torque per angle at the output with the input held: the tangent at the operating torque.",
        ),
        "planet_bearing_force": entry((*dims, "axis"), series.bearing, "N", "force on a planet's bearing"),
    }
    pressure = "Largest pressure on a flank in each mesh."
    for name, touches in (("sun_planet", series.sun), ("planet_ring", series.ring)):
        words = name.replace("_", " and ")
        made[f"{name}_force"] = entry((*dims, f"{name}_pair"), touches.force, "N", f"force on pairs, {words}")
        made[f"{name}_pressure"] = entry(
            dims,
            touches.pressure.max(axis=2),
            "Pa",
            f"pressure, {words}",
            "Contact pressure",
            caption=pressure,
        )
    return made


def _roots(stages: Stages) -> Entries:
    found, caption = stages.roots.fine, "Largest tension in the fillets of the teeth that carry."
    wheels = {"sun": found.sun, "planets": found.planet.max(axis=1), "ring": found.ring}
    return {
        f"root_stress_{name}": entry(
            (ANGLE,), stress, "Pa", f"root stress, {name}", "Root stress", caption=caption
        )
        for name, stress in wheels.items()
    }


def _meshes(stages: Stages) -> Entries:
    caption = (
        "Normal force per approach of one planet's meshes, each by itself under an even share of the torque."
    )
    found = stages.meshes.fine
    return {
        f"mesh_stiffness_{name}": entry(
            ("base_pitch",),
            path.stiffness,
            "N/m",
            f"stiffness, {name.replace('_', ' and ')}",
            "Mesh stiffness",
            caption=caption,
        )
        for name, path in (("sun_planet", found.outer), ("planet_ring", found.inner))
    }


def _pairs(stages: Stages, angle: Array) -> Entries:
    made, turning = stages.feasible, stages.speeds.members
    found = places(
        made.given,
        made.geometry,
        float(turning["carrier"]) * angle,
        float(turning["ring"]) * angle,
        forward=stages.rigid.torques["sun"] >= 0.0,
    )
    counts = np.stack([place.touching.sum(axis=-1) for place in found], axis=1)
    caption = "Pairs of unloaded teeth on their path of contact in each mesh: the phases of the planets to each other."
    return {
        "pairs_in_mesh": entry(
            ("rolled_angle", "mesh", "planet"), counts, "", "pairs in mesh", PAIRS, caption=caption
        )
    }


def _sliding(stages: Stages) -> Entries:
    set_ = stages.feasible.geometry
    sun, planet, ring = (float(tip) for tip in set_.tips)
    caption = (
        "Sliding speed over the rolling speed of each flank, from the first to the last contact of a pair; negative "
        "below the pitch circle."
    )
    found: Entries = {}
    share = np.linspace(0.0, 1.0, 101)
    for pair, tips, wheels in (
        (set_.outer, (sun, planet), ("sun", "planet on sun")),
        (set_.inner, (planet, ring), ("planet in ring", "ring")),
    ):
        low, high = float(pair.lowest(*tips)[0]), float(pair.first.curvature_radius(tips[0]))
        rho = low + share * (high - low)
        other = pair.of_second(rho)
        with np.errstate(divide="ignore"):
            slides = 1.0 - other / rho / pair.ratio, 1.0 - rho / other * pair.ratio
        for wheel, values in zip(wheels, slides, strict=True):
            key = f"specific_sliding_{wheel.replace(' ', '_')}"
            found[key] = entry(("path",), values, "", f"sliding, {wheel}", SLIDING, caption=caption)
    return found

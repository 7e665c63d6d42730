"""Scenes of K-H-V drives for tests: the example with other values, and random drives that can be built."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from pathlib import Path

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st

from trochoid.drives.khv.bodies import Level, build_level, meshes
from trochoid.drives.khv.contact import centrifugal, layout
from trochoid.drives.khv.design import Design, design
from trochoid.drives.khv.feasible import faults
from trochoid.drives.khv.series import Series, solve_series
from trochoid.fem.position import Contact
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array
from trochoid.scene import load
from trochoid.scene.drive_khv import KhvScene
from trochoid.scene.needs import EFFECTS_OF

EFFECTS = EFFECTS_OF["khv"]
EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
RV40 = (  # sources §3
    "drive.pins=40",
    "drive.lobes=39",
    "drive.pin_circle_radius=64",
    "drive.pin_radius=3",
    "drive.eccentricity=1.3",
    "drive.output_pins.count=12",
    "drive.output_pins.circle_radius=40",
    "operation.output_torque=206",
    "drive.discs=1",
)
NO_PLAY = (
    "drive.modification.equidistant=0",
    "drive.output_pins.hole_clearance=0",
    "drive.eccentric_bearing.clearance=0",
)

# one lobe to each hole, and a cage that goes on by whole rollers while the crank passes one pin
EVERY_PIN_ALIKE = (
    "drive.pins=9",
    "drive.lobes=8",
    "drive.eccentricity=5.5",
    "drive.pin_radius=8",
    "drive.output_pins.count=8",
    "drive.output_pins.circle_radius=46",
    "drive.output_pins.roller_radius=5",
    "drive.eccentric_bearing.rollers=14",
    "drive.eccentric_bearing.roller_radius=3.125",
    "drive.input_shaft.radius=12",
    "drive.discs=1",
    "drive.ring.outer_radius=110",
    *NO_PLAY,
)


def listed(effects: Sequence[str]) -> str:
    """Return the override that lists these effects."""
    return "effects=[" + ", ".join(f'{{type="{name}"}}' for name in effects) + "]"


def without(*effects: str) -> tuple[str, ...]:
    """Return all effects but these."""
    return tuple(name for name in EFFECTS if name not in effects)


def scene(*overrides: str, effects: Sequence[str] = EFFECTS) -> KhvScene:
    """Return the example with other values; a number of facets is dropped where there is no mesh."""
    meshed = all(
        "elastic_contact" in each for each in (listed(effects), *overrides) if each.startswith("effects=")
    )
    meshed &= not any("springs" in each for each in overrides)
    given = [each for each in overrides if meshed or not each.startswith("accuracy.facets_per_lobe")]
    return load(EXAMPLE, (listed(effects), 'ask.quantities=["ratio"]', *given))


def drive(*overrides: str, effects: Sequence[str] = EFFECTS) -> Design:
    """Return the example's drive with other values."""
    return design(scene(*overrides, effects=effects))


_LEVELS: dict[Hashable, Level] = {}


def level_of(made: Design, facets: int = 4) -> Level:
    """Return the discs on a coarse mesh, made once for all drives with the same discs; thin walls get a finer one."""
    d = made.drive
    holes = (d.output_pins.count, d.output_pins.circle_radius, made.hole_radius, made.hole_angles)
    kind = (d.plane, made.scene.materials[d.material], made.scene.friction is not None)
    key = (made.flank, holes, d.bore_radius, d.face_width, kind, facets)
    if key not in _LEVELS:
        try:
            _LEVELS[key] = build_level(
                made, facets, meshes(made, facets), tangential=made.scene.friction is not None
            )
        except TrochoidError:
            if facets >= 32:
                raise
            return level_of(made, 2 * facets)
        while len(_LEVELS) > 8:
            _LEVELS.pop(next(iter(_LEVELS)))
    return _LEVELS[key]


def turn(made: Design, level: Level | None, positions: int, rung: str = "level0") -> Series:
    """Return the contacts over a turn; without a level of rigid discs on springs."""
    return solve_series(
        made, "springs" if level is None else rung, () if level is None else level.elastic, positions
    )


def imbalance(made: Design, contact: Contact, angle: float, classical: bool = False) -> float:
    """Return the largest unbalanced force or moment of any member, by vectors and points of the contacts alone.

    Relative to the largest force, at the pin circle's radius for moments. The classical calculation leaves
    the contacts where they are without load; its disc is held by its eccentric, so that only its moment counts.
    """
    rows, motion = layout(made, "springs" if classical else "level0"), contact.motion
    moved = 0.0 * motion if classical else motion
    crank = angle * made.mesh_speed
    forces, moments = {"shaft": np.zeros(2), "output": np.zeros(2)}, {"output": made.flange_torque}
    tilts = {"shaft": np.zeros(2), "output": np.zeros(2)}
    weights = centrifugal(made, np.array([crank]))[0]
    for i, disc in enumerate(made.discs):
        at = crank + disc.crank
        center = made.flank.eccentricity * np.array([np.cos(at), np.sin(at)])
        center = center + rows.rows(f"disc{i}")[:2] @ moved
        forces[f"disc{i}"], moments[f"disc{i}"] = weights[i].copy(), 0.0
        for kind, other in (("ring", None), ("output", "output"), ("bearing", "shaft")):
            if f"{kind}{i}" not in contact.touches:
                continue
            touch = contact.touches[f"{kind}{i}"]
            push = touch.force[:, None] * touch.state.normal  # by the disc on its partner
            forces[f"disc{i}"] -= push.sum(axis=0)
            moments[f"disc{i}"] -= _moment(touch.state.point - center, push)
            if other is not None:
                forces[other] += push.sum(axis=0)
                tilts[other] += disc.z * push.sum(axis=0)
            if other == "output":
                hub = rows.rows("output", disc.z)[:2] @ moved
                moments["output"] += _moment(touch.state.point - hub, push)
    if rows.floating:
        for member, table in (("shaft", made.drive.input_shaft), ("output", made.drive.output_flange)):
            for z, stiffness in zip(table.bearing_positions, made.supports[member], strict=True):
                held = stiffness * rows.rows(member, z)[:2] @ motion
                forces[member] -= held
                tilts[member] -= z * held
    else:
        del forces["shaft"], forces["output"]
        tilts = {}
    if not rows.lateral:
        forces = {}
    size = float(largest_force(contact)) or 1.0
    reach = made.flank.pin_circle_radius
    unmet = [np.abs(f).max() for f in forces.values()]
    unmet += [
        np.abs(np.asarray(m, dtype=np.float64)).max() / reach for m in (*moments.values(), *tilts.values())
    ]
    return float(max(unmet)) / size


def _moment(arm: Array, force: Array) -> float:
    return float((arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]).sum())


def all_forces(contact: Contact) -> Array:
    """Return the forces of all contacts in one row."""
    return np.concatenate([touch.force for touch in contact.touches.values()])


def largest_force(contact: Contact) -> float:
    """Return the largest force of any contact."""
    return float(all_forces(contact).max(initial=0.0))


@st.composite
def drives(draw: st.DrawFn, pins: int = 60, elastic: bool = False) -> KhvScene:
    """Return a random scene whose drive can be built: any size, plays, number of discs, holes and rollers."""

    def between(low: float, high: float) -> float:
        return draw(st.floats(low, high, allow_nan=False))

    z = draw(st.integers(6, pins))
    big = 10 ** between(-2, 0)  # m
    e = between(0.4, 0.85) * big / z
    limit = min(Cycloid(z, z - 1, big, 1e-6 * big, e).undercut_radius, big * math.sin(math.pi / z))
    r = between(0.3, 0.85) * limit
    root = big - e - r
    bore = between(0.3, 0.45) * root
    holes = draw(st.integers(3, 12))
    circle = 0.5 * (bore + root)
    play = draw(st.sampled_from([0.0, 1e-5, 1e-4])) * big
    hole = between(0.4, 0.75) * min(0.5 * (root - bore), circle * math.sin(math.pi / holes))
    roller = hole - e - play
    assume(roller > 0.01 * big)
    count = draw(st.integers(4, 24))
    pitch = math.sin(math.pi / count)
    needle = between(0.5, 0.9) * min(0.3 * (bore - e), bore * pitch / (1 + pitch))
    race = bore - 2 * needle
    width = between(0.05, 0.3) * big
    discs = draw(st.integers(1, 3))
    steel = (width / 0.01) * (big / 0.08) ** 2  # torques that load the drive as much as the example's
    some = st.lists(st.sampled_from(["pin_compliance", "inertia", "bearing_compliance"]), unique=True)
    effects = ["clearance", *draw(some), *(["elastic_contact"] if elastic else [])]
    overrides = {
        "drive.pins": z,
        "drive.lobes": z - 1,
        "drive.pin_circle_radius": big,
        "drive.pin_radius": r,
        "drive.eccentricity": e,
        "drive.discs": discs,
        "drive.face_width": width,
        "drive.disc_gap": between(0.01, 0.2) * width,
        "drive.bore_radius": bore,
        "drive.output_pins.circle_radius": circle,
        "drive.output_pins.roller_radius": roller,
        "drive.output_pins.hole_clearance": play,
        "drive.eccentric_bearing.roller_radius": needle,
        "drive.eccentric_bearing.roller_length": between(0.5, 1.0) * width,
        "drive.eccentric_bearing.clearance": draw(st.sampled_from([0.0, 1e-4])) * bore,
        "drive.modification.equidistant": draw(st.sampled_from([0.0, 2e-5, 2e-4])) * big,
        "drive.modification.radial": draw(st.sampled_from([0.0, -2e-5])) * big,
        "drive.pin_clearance": draw(st.sampled_from([0.0, 1e-5])) * big,
        "drive.ring.outer_radius": 1.3 * (big + r),
        "drive.input_shaft.radius": between(0.5, 0.9) * (race - e),
        "drive.output_flange.outer_radius": circle,
    }
    words = [
        f'{key}="{value!r} m"' if isinstance(value, float) else f"{key}={value}"
        for key, value in overrides.items()
    ]
    words += [
        f"drive.output_pins.count={holes}",
        f"drive.eccentric_bearing.rollers={count}",
        f"drive.output_pins.phase={between(0, 360)}",
        f"drive.modification.rotation={draw(st.sampled_from([0.0, 1e-3]))}",
        f"drive.fixed={draw(st.sampled_from(['ring', 'output']))}",
        f"drive.plane={draw(st.sampled_from(['strain', 'stress']))}",
        f'drive.input_shaft.bearing_stiffness="{1e9 * 10 ** between(-1, 1) * width / 0.01} N/m"',
        f'drive.output_flange.bearing_stiffness="{1e9 * 10 ** between(-1, 1) * width / 0.01} N/m"',
        f'drive.input_shaft.bearing_positions=["{-2.5 * width} m", "{between(2, 4) * width} m"]',
        f'drive.output_flange.bearing_positions=["{3 * width} m", "{between(4, 6) * width} m"]',
        f"operation.output_torque={10 ** between(1, 3) * steel}",
        f"operation.input_speed={10 ** between(2, 3.5) * min(1.0, 0.08 / big)}",
    ]
    found = scene(*words, effects=effects)
    assume(not faults(design(found)))
    return found

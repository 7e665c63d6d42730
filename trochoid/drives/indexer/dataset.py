"""Series over a turn of the arm and the table of solutions as one labelled dataset, in SI."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.entries import ANGLE, Entries, entry, named, numbered
from trochoid.drives.indexer.design import SHOWN
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.words import FAULT_WORDS, name_of
from trochoid.drives.vibration_answers import comparison
from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.indexer_slot import pressure_angle
from trochoid.kinematics.types import Array, BoolArray

if TYPE_CHECKING:
    import xarray

    from trochoid.drives.indexer.forces import State

MOTION, PIN, FORCES = "Motion of the wheel over a turn of the arm", "Pin and slot", "Forces over an index"
CONTACT = "Pin and slot as elastic bodies"
VELOCITY = "Vibration velocity of the casing"
CAPTIONS = {
    MOTION: (
        "0° is the middle of the index; the wheel rests at both sides of it. Where ε jumps is the soft shock. "
        "Both mechanisms turn the same swing on the same shafts at the same speed of the arm. "
        "N is the power that a unit moment of inertia takes."
    ),
    PIN: "Where the pin is on the wheel, and the angle between its path and the normal of the slot in an index.",
    CONTACT: (
        "Under the forces of the rigid drive. Where the pin force passes through 0 the contact has no width, and is "
        "softest."
    ),
    VELOCITY: (
        "Amplitudes by all that the drive and its motor put on the casing in a turn of the arm, index and dwell. The "
        "comb of multiples of the arm's speed is broad: each soft shock is a jump."
    ),
    FORCES: "Rigid, pin without friction in its slot; negative where the pin pushes against the sense of growing ψ.",
}
STEP = 1e-9  # rad, by which the ends of an index are shown from either side


def dataset(stages: Stages, wanted: Collection[str]) -> xarray.Dataset:
    """Return what the stages "motion", "geometry", "forces" hold if `wanted`; no other stage is started."""
    import xarray

    made = stages.design
    angle = angles(list(made.mechanisms.values()), stages.scene.ask.positions)
    entries = _motions(stages, angle) if "motion" in wanted else {}
    if "geometry" in wanted:
        entries |= _pins(stages, angle)
    if "forces" in wanted:
        entries |= _forces(stages, angle)
    if "contact" in wanted:
        entries |= _contacts(stages, angle)
    shaken = _vibration(stages) if "vibration" in wanted else {}
    names = tuple(SHOWN[name] for name in made.mechanisms)
    places = {
        ANGLE: entry((ANGLE,), angle, "rad", "input angle from the middle of the index"),
        "mechanism": named("mechanism", names, "mechanism"),
        "solution": numbered("solution", len(made.solutions), "solution of the task, those that serve first"),
    }
    return xarray.Dataset(entries | shaken | _solutions(stages), places | (_lines(stages) if shaken else {}))


def angles(mechanisms: Collection[Indexer], positions: int) -> Array:
    """Drive angles (n,) of a turn, −π to π: even ones, and both sides of the ends of every index."""
    even = np.linspace(-math.pi, math.pi, positions + 1)
    ends = [side * x.half_turn + step for x in mechanisms for side in (-1.0, 1.0) for step in (-STEP, STEP)]
    return np.unique(np.concatenate((even, ends)))


def within(indexer: Indexer, angle: Array) -> BoolArray:
    """Which of the drive angles belong to the index."""
    inside: BoolArray = np.abs(angle) <= indexer.half_turn
    return inside


def wheel_angle(indexer: Indexer, angle: Array) -> Array:
    """ψ (rad) over a turn: it rests at ∓ψ0 outside the index."""
    held = np.clip(angle, -indexer.half_turn, indexer.half_turn)
    turned: Array = motion(indexer, held).angle
    return turned


def _motions(stages: Stages, angle: Array) -> Entries:
    speed = stages.design.speed
    rows = []
    for made in stages.design.mechanisms.values():
        at, inside = motion(made, angle), within(made, angle)
        rows.append(
            [wheel_angle(made, angle)]
            + [np.where(inside, x, 0.0) for x in (at.velocity, at.acceleration, at.power)]
        )
    psi, omega, epsilon, power = (np.array(x).T for x in zip(*rows, strict=True))
    dims = (ANGLE, "mechanism")
    said = {"caption": CAPTIONS[MOTION]}
    return {
        "wheel_angle": entry(dims, psi, "rad", "angle ψ", MOTION, **said),
        "wheel_velocity": entry(dims, omega * speed, "rad/s", "velocity ω", MOTION),
        "wheel_acceleration": entry(dims, epsilon * speed**2, "rad/s^2", "acceleration ε", MOTION),
        "wheel_power": entry(dims, power * speed**3, "W/(kg*m^2)", "power N = ω ε", MOTION),
        "wheel_velocity_invariant": entry(dims, omega, "", "dψ/dφ"),
        "wheel_acceleration_invariant": entry(dims, epsilon, "", "d²ψ/dφ²"),
    }


def _pins(stages: Stages, angle: Array) -> Entries:
    dims, said = (ANGLE, "mechanism"), {"caption": CAPTIONS[PIN]}
    made = stages.design.mechanisms.values()
    reach = np.array([x.reach(angle) for x in made]).T
    steep = np.array([np.where(within(x, angle), pressure_angle(x, angle), np.nan) for x in made]).T
    pins = np.stack([x.path.point(angle) for x in made], axis=1)
    return {
        "pin_reach": entry(dims, reach, "rad", "angle from the wheel's axis to the pin", PIN, **said),
        "pressure_angle": entry(dims, steep, "rad", "pressure angle", PIN),
        "pin_place": entry(
            (*dims, "axis"), stages.design.drive.sphere_radius * pins, "m", "place of the pin"
        ),
    }


def _forces(stages: Stages, angle: Array) -> Entries:
    states: list[State] = [x.state(angle) for x in stages.forces.values()]
    inside = [within(x.indexer, angle) for x in stages.forces.values()]

    def series(name: str) -> Array:
        return np.array([np.where(i, getattr(x, name), 0.0) for i, x in zip(inside, states, strict=True)]).T

    dims, said = (ANGLE, "mechanism"), {"caption": CAPTIONS[FORCES]}
    return {
        "pin_force": entry(dims, series("pin"), "N", "pin force", FORCES, **said),
        "wheel_torque": entry(dims, series("torque"), "N*m", "torque on the wheel", FORCES),
        "input_torque": entry(dims, series("input_torque"), "N*m", "input torque", FORCES),
        "tooth_force": entry(dims, series("tooth"), "N", "tooth force of the planet", FORCES),
        "input_power": entry(dims, series("power"), "W", "input power"),
    }


def _vibration(stages: Stages) -> Entries:
    """Return the spectra of the casing's velocity, with and without each effect."""
    found = stages.vibration.fine
    best, (low, high) = stages.casing_loads.fine.best, found.elastic.band
    lines, dims = np.moveaxis(found.elastic.velocity, -1, 0), ("frequency", "point", "direction")
    rms = f"rms velocity of the casing, {low:g} to {high:g} Hz"
    return {
        "vibration_velocity": entry(
            dims, lines, "m/s", f"velocity, {best}", VELOCITY, scale="log", caption=CAPTIONS[VELOCITY]
        ),
        "vibration_rms": entry(dims[1:], found.elastic.rms, "m/s", rms),
        **comparison(found),
    }


def _lines(stages: Stages) -> Entries:
    found = stages.vibration.fine.elastic
    return {
        "frequency": entry(("frequency",), found.frequencies, "Hz", "frequency"),
        "point": named("point", tuple(point.name for point in found.points), "point on the casing"),
        "direction": named("direction", ("x", "y", "z"), "direction"),
    }


def _contacts(stages: Stages, angle: Array) -> Entries:
    rows = []
    for pair in stages.pairs.values():
        inside = within(pair.forces.indexer, angle)
        found = pair.state(angle[inside])
        held = np.full((4, len(angle)), np.nan)
        pressed = found.pressed
        held[:, inside] = (
            found.stiffness,
            found.lag,
            pressed.pressure.max(axis=-1),
            pressed.half_width.max(axis=-1),
        )
        held[0] = np.where(held[0] > 0.0, held[0], np.nan)  # no load, no stiffness
        rows.append(held)
    stiffness, lag, pressure, width = np.array(rows).transpose(1, 2, 0)
    dims, said = (ANGLE, "mechanism"), {"caption": CAPTIONS[CONTACT]}
    return {
        "contact_pressure": entry(dims, pressure, "Pa", "largest pressure of pin and slot", CONTACT, **said),
        "contact_half_width": entry(dims, width, "m", "half width of the contact", CONTACT),
        "mesh_stiffness": entry(dims, stiffness, "N*m/rad", "stiffness about the wheel's axis", CONTACT),
        "wheel_lag": entry(dims, lag, "rad", "lag of the wheel", CONTACT),
    }


def _solutions(stages: Stages) -> Entries:
    found, dims = stages.design.solutions, ("solution",)
    made = [x.indexer for x in found]
    return {
        "solution_name": entry(
            dims, np.array([name_of(x) for x in found]), "", "kind and place of the pin path"
        ),
        "solution_verdict": entry(
            dims, np.array([FAULT_WORDS[x.fault] for x in found]), "", "whether it serves"
        ),
        "solution_relative_turning_time": entry(
            dims, [x.duration for x in made], "", "relative turning time"
        ),
        "solution_pin_ratio": entry(dims, [x.path.pin_ratio for x in made], "", "pin ratio"),
        "solution_arm_angle": entry(dims, [x.path.arm for x in made], "rad", "arm angle"),
        "solution_pin_angle": entry(dims, [x.path.pin for x in made], "rad", "pin angle"),
    }

"""The drive over the input angle with its contact forces, and the fields of its discs, in the fixed frame."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from trochoid.drives.disc_field import disc_field, turned, turned_stress
from trochoid.drives.disc_pack import circle
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.stages import Stages
from trochoid.drives.paths import Path, framed
from trochoid.kinematics.motion import PlaneMotion, khv_motions
from trochoid.kinematics.types import Array, frozen
from trochoid.results.film import Film
from trochoid.results.outcome import Arrow, Drawing

__all__ = ["drawing", "ring_angle", "stress_film", "turned", "turned_stress"]

FLANK_POINTS = 760
SMALL, LARGE = 48, 120  # points of a circle
NOISE = 1e-6  # N: what rounding of gaps leaves of a contact without load
RING_PINS, OUTPUT_PINS, SHAFT, AXES = "ring pins", "output pins", "shaft and eccentrics", "pitch circles"


def drawing(stages: Stages, frames: int = 36) -> Drawing:
    """Return at most `frames` pictures over one input turn; nothing is solved here.

    Once contacts are solved, these are solved positions with the forces on the discs as arrows.
    """
    if "contact" not in stages.__dict__:
        angles = np.linspace(0.0, 2 * np.pi, frames, endpoint=False)
        arrows: list[tuple[Arrow, ...]] = [()] * frames
    else:
        positions = range(
            0, len(stages.contact.fine.angle) - 1, -(-(len(stages.contact.fine.angle) - 1) // frames)
        )
        angles = stages.contact.fine.angle[list(positions)]
        arrows = [tuple(_arrows(stages, position)) for position in positions]
    return framed(angles, tuple(_paths(stages.design, angles)), arrows)


def _paths(design: Design, angles: Array) -> Iterator[Path]:
    """Draw all members on their ideal paths; elastic motion is too small to be seen."""
    motions = khv_motions(design.flank, angles, len(design.discs), design.drive.fixed)
    yield Path("ring", frozen(circle(design.drive.ring.outer_radius, 2 * LARGE)), "ring")
    for i in range(len(design.discs)):
        yield from _disc(design, motions[f"disc{i}"], i)
    yield from _pins(design, motions["ring"], motions["output"])
    for i in range(len(design.discs)):
        yield from _bearing(design, angles, motions[f"disc{i}"].center, i)
    radius = design.drive.input_shaft.radius
    yield Path("input shaft", frozen(circle(radius, LARGE)), SHAFT)
    mark = motions["input"].to_fixed([[0.0, 0.0], [radius, 0.0]])
    yield Path("input angle", frozen(mark), SHAFT, closed=False)
    yield from _axes(design)


def _disc(design: Design, motion: PlaneMotion, i: int) -> Iterator[Path]:
    """Draw a disc in its motion, which is that of its profile; its body may lie turned by whole lobes."""
    drive, pins, disc, group = design.drive, design.drive.output_pins, design.discs[i], _name(i)
    flank = design.flank.modified(design.modification)
    t = np.linspace(0.0, flank.period, flank.lobes * max(8, FLANK_POINTS // flank.lobes), endpoint=False)
    yield Path(group, frozen(motion.to_fixed(flank.point(t))), group, "body")
    yield Path(f"{group} bore", frozen(motion.to_fixed(circle(drive.bore_radius, LARGE))), group, "hole")
    start = design.hole_angles[disc.body] + disc.lead
    for k, center in enumerate(circle(pins.circle_radius, pins.count, start)):
        hole = center + circle(design.hole_radius, SMALL)
        yield Path(f"{group} hole {k + 1}", frozen(motion.to_fixed(hole)), group, "hole")


def _pins(design: Design, ring: PlaneMotion, flange: PlaneMotion) -> Iterator[Path]:
    drive, pins = design.drive, design.drive.output_pins
    for k, center in enumerate(circle(drive.pin_circle_radius, drive.pins)):
        pin = ring.to_fixed(center + circle(drive.pin_radius, SMALL))
        yield Path(f"ring pin {k + 1}", frozen(pin), RING_PINS, "pin")
    for k, center in enumerate(circle(pins.circle_radius, pins.count, pins.phase)):
        roller = flange.to_fixed(center + circle(pins.roller_radius, SMALL))
        yield Path(f"output pin {k + 1}", frozen(roller), OUTPUT_PINS, "pin")


def _bearing(design: Design, angles: Array, center: Array, i: int) -> Iterator[Path]:
    """Draw an eccentric and the rollers on it, in their cage."""
    bearing = design.drive.eccentric_bearing
    turn = ring_angle(design, angles) + design.cage_angle(1.0) * design.mesh_speed * angles
    cage = PlaneMotion(center, frozen(turn))
    yield Path(f"eccentric {i + 1}", frozen(cage.to_fixed(circle(design.race_radius, LARGE))), SHAFT)
    for k, place in enumerate(circle(design.pitch_radius, bearing.rollers)):
        roller = cage.to_fixed(place + circle(bearing.roller_radius, SMALL // 2))
        yield Path(f"roller {k + 1}", frozen(roller), f"rollers, {_name(i)}", "pin")


def _axes(design: Design) -> Iterator[Path]:
    drive = design.drive
    yield Path("pin circle", frozen(circle(drive.pin_circle_radius, LARGE)), AXES, "center")
    yield Path("output pin circle", frozen(circle(drive.output_pins.circle_radius, LARGE)), AXES, "center")
    reach = 1.04 * drive.ring.outer_radius
    yield Path("x axis", frozen([[-reach, 0.0], [reach, 0.0]]), AXES, "center", closed=False)
    yield Path("y axis", frozen([[0.0, -reach], [0.0, reach]]), AXES, "center", closed=False)


def _arrows(stages: Stages, position: int) -> Iterator[Arrow]:
    """Return the forces on the discs at a solved position, where they act."""
    series = stages.contact.fine
    turn = float(ring_angle(stages.design, series.angle[position]))
    for name, touches in (
        ("ring pin", series.ring),
        ("output pin", series.output),
        ("roller", series.bearing),
    ):
        if touches is None:
            continue
        force = touches.force[position]
        points = turned(touches.point[position], turn)
        vectors = turned(-force[..., None] * touches.normal[position], turn)
        for i, k in np.argwhere(force > NOISE).tolist():
            yield Arrow(frozen(points[i, k]), frozen(vectors[i, k]), _name(i), f"{name} {k + 1}")


def stress_film(stages: Stages) -> Film:
    """Return the discs' displacement and stress at the asked position, at their axial places."""
    states = stages.field.fine
    turn = float(ring_angle(stages.design, np.array(states[0].angle)))
    bodies = tuple(disc_field(_name(i), state, turn) for i, state in enumerate(states))
    return Film("fields", "Stress and displacement of the discs", ((states[0].angle, bodies),))


def ring_angle(design: Design, angle: Array) -> Array:
    """Return how far the ring has turned at input angles (rad); contacts are given in its frame."""
    return float(design.speeds.members["ring"]) * angle


def _name(disc: int) -> str:
    return f"disc {disc + 1}"

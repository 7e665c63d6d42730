"""Where the drive's members face each other, for the resolved solution: true curves, circles before them, windows."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.drives.disc_pack import Disc, circle
from trochoid.drives.khv.contact import Layout
from trochoid.drives.khv.design import Design
from trochoid.fem.facing import Facing, Frame, turned
from trochoid.kinematics.curve import Circle, Curve
from trochoid.kinematics.cycloid import gap
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Spot:
    """A place of disc `disc` that may be pressed: `number` of its `kind`, on a `loop` of the outline at `parameter`.

    `curve` is what the loop is ground to, turned by `turn` (rad) about the disc's centre; the partner is a circle
    of `radius` about `center` (2,), in its own frame; `play` in m opens the gap.
    """

    kind: str
    disc: int
    number: int
    loop: str
    curve: Curve
    turn: float
    parameter: float
    body: Frame
    partner: Frame
    center: Array
    radius: float
    play: float

    @property
    def convex(self) -> bool:
        """Whether the partner is outside, so that its facets run the other way round."""
        return self.kind == "ring"

    def facing(self, parameters: Array, weights: Array) -> Facing:
        """Return facets, given by parameters (m, q) of the curve and weights (m, q), before the partner."""
        turn = turned(self.turn).T
        points, normals = self.curve.point(parameters) @ turn, self.curve.normal(parameters) @ turn
        return Facing(self.body, points, normals, weights, self.partner, self.center, self.radius, self.play)


def spots(design: Design, motions: Layout, crank: float, motion: Array) -> list[Spot]:
    """Return all places of all discs at a crank angle (rad) relative to the ring, at the feet after a motion (k,)."""
    found: list[Spot] = []
    for i, disc in enumerate(design.discs):
        angle = crank + disc.crank
        center = design.flank.eccentricity * np.array([math.cos(angle), math.sin(angle)])
        body = Frame(center, -angle / design.flank.lobes + disc.lead, motions.rows(f"disc{i}"))
        found += _ring(design, i, disc, body, angle, motion)
        found += _output(design, motions, i, disc, body, crank, motion)
        found += _bearing(design, motions, i, disc, body, crank, motion)
    return found


def _ring(design: Design, i: int, disc: Disc, body: Frame, angle: float, motion: Array) -> list[Spot]:
    flank, change = design.flank, design.modification
    ring = Frame(np.zeros(2), 0.0, np.zeros_like(body.moves))
    pins = circle(flank.pin_circle_radius, flank.pins)
    local = body.local(ring.place(pins, motion), motion)
    start = flank.contact_parameter(np.arange(flank.pins), angle) - disc.lead
    distance, t = gap(flank, change, local, start)
    ground = flank.modified(change)
    turns = _turns(distance + flank.pin_radius, local, ground.point(t), change.rotation)
    return [
        Spot(
            *("ring", i, j, "flank", ground, float(turns[j]), float(t[j])),
            *(body, ring, pins[j], flank.pin_radius, design.pin_play),
        )
        for j in range(flank.pins)
    ]


def _turns(distance: Array, pins: Array, points: Array, rotation: float) -> Array:
    """Return by which of the two turns of a flank that is ground turned both ways its points have their distance."""
    sides = np.array([-rotation, rotation])
    off = [np.linalg.norm(points @ turned(side).T - pins, axis=-1) - distance for side in sides]
    return np.asarray(sides[np.argmin(np.abs(off), axis=0)])


def _output(
    design: Design, motions: Layout, i: int, disc: Disc, body: Frame, crank: float, motion: Array
) -> list[Spot]:
    pins = design.drive.output_pins
    flange = Frame(np.zeros(2), -crank / design.flank.lobes, motions.rows("output", disc.z))
    names = (np.arange(pins.count) + disc.first_hole) % pins.count
    holes = circle(pins.circle_radius, pins.count, design.hole_angles[disc.body])[names]
    rollers = circle(pins.circle_radius, pins.count, pins.phase)
    places = _feet(holes, body.local(flange.place(rollers, motion), motion))
    return [
        Spot(
            *("output", i, j, f"hole{names[j]}", _hole(holes[j], design.hole_radius), 0.0, float(places[j])),
            *(body, flange, rollers[j], pins.roller_radius, 0.0),
        )
        for j in range(pins.count)
    ]


def _bearing(
    design: Design, motions: Layout, i: int, disc: Disc, body: Frame, crank: float, motion: Array
) -> list[Spot]:
    bearing = design.drive.eccentric_bearing
    cage = Frame(body.center, design.cage_angle(crank), motions.rows("shaft", disc.z))
    rollers = circle(design.pitch_radius, bearing.rollers)
    bore = _hole(np.zeros(2), design.drive.bore_radius)
    places = _feet(np.zeros(2), body.local(cage.place(rollers, motion), motion))
    return [
        Spot(
            *("bearing", i, j, "bore", bore, 0.0, float(places[j])),
            *(body, cage, rollers[j], bearing.roller_radius, 0.0),
        )
        for j in range(bearing.rollers)
    ]


def _hole(center: Array, radius: float) -> Circle:
    return Circle((float(center[0]), float(center[1])), radius, hole=True)


def _feet(holes: Array, rollers: Array) -> Array:
    """Return the angles (c,) at which rollers (c, 2) lie in their holes."""
    apart = rollers - holes
    return np.asarray(np.arctan2(apart[:, 1], apart[:, 0]))

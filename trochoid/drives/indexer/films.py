"""The indexer over a turn of its arm in space, with the pressure between pin and slot.

An elastic wheel is its finite elements with their stress; the rest is rigid but for the pin, which bends as a beam.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from trochoid.drives.indexer.dataset import wheel_angle
from trochoid.drives.indexer.design import Design
from trochoid.drives.indexer.film_bodies import arm, hub, on_wheel, pin, planet
from trochoid.drives.indexer.film_wheel import elastic_wheel, rigid_wheel
from trochoid.drives.indexer.outline import turned
from trochoid.drives.indexer.pin import Loaded, Pair
from trochoid.drives.solids import Solid
from trochoid.fem.cone_slices import Slices, between
from trochoid.fem.cone_strip import Strips, ellipse, strips
from trochoid.fem.pin_slot import flexibility
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.indexer_slot import Slot, slot_normal
from trochoid.kinematics.types import Array
from trochoid.results.film import Field, FieldFrame, Film, Later

INDEXING, RESTING = 28, 8  # frames of the index and of the dwell
SOLID, DARK, BRASS = ("#93a5b7", 1.0), ("#43525f", 0.45), ("#c9a55c", 1.0)
FAINT = 1e-6  # of the largest force: less is none


def contact_film(design: Design, slot: Slot, pair: Pair, facets: int = 0) -> Film:
    """Return the drive from the start of one index to that of the next, under the forces of the rigid drive.

    `facets` over the thickness of an elastic wheel, as it was solved.
    """
    return Film(
        "contacts",
        "Pin and slot of the indexer, and their pressure",
        Later(lambda: _frames(design, slot, pair, facets)),
        shown="contact_pressure",
        spatial=True,
        seen_from=_eye(design),
    )


def _frames(design: Design, slot: Slot, pair: Pair, facets: int) -> tuple[FieldFrame, ...]:
    made = design.indexer
    half = made.half_turn
    inside = half * np.linspace(-1.0, 1.0, INDEXING)
    rest = np.linspace(half, 2.0 * math.pi - half, RESTING + 2)[1:-1]
    crank = np.concatenate([inside, rest])
    psi = wheel_angle(made, crank)
    force = pair.forces.state(inside).pin
    loaded = pair.state(inside) if force.any() else None
    shape = None
    if pair.elastic is not None and loaded is not None and design.closes:
        with suppress(TrochoidError):  # of a mesh other than the one that was solved on
            reach = made.reach(inside)
            shape = elastic_wheel(design, slot, pair.pin, pair.elastic, facets, reach, loaded.pressed.force)
    shape = rigid_wheel(design, slot) if shape is None else shape
    middle = hub(design)
    frames: list[FieldFrame] = []
    for i, angle in enumerate(crank):
        state, way = None, 1.0
        if loaded is not None and i < INDEXING and abs(force[i]) > FAINT * pair.largest[0]:
            state, way = (
                _pressed(design, pair, loaded, i, float(angle), float(force[i])),
                float(np.sign(force[i])),
            )
        lag = np.zeros(3) if state is None else state.lag
        member = shape.field(design, float(psi[i]), lag, None if state is None else i, way)
        wall = np.zeros((0, 3))
        if state is not None:
            wall = shape.under_pin(design, float(psi[i]), i, way, state.strip.distance)
        others = _bodies(design, middle, float(angle), float(psi[i]), state, wall)
        frames.append((float(angle), (member, *others)))
    return tuple(frames)


@dataclass(frozen=True, eq=False, slots=True)
class _Pressed:
    """Pin and slot of one frame: the contact's `strip`, the rotation `lag` (3,) rad of the wheel.

    The pin pushes along the unit vector `push`; its `deflection` (n,) m is against that, at distances `along` (n,) m
    from the centre.
    """

    strip: Strips
    lag: Array
    push: Array
    along: Array
    deflection: Array


def _pressed(design: Design, pair: Pair, loaded: Loaded, i: int, angle: float, force: float) -> _Pressed:
    """Place the contact of frame `i`; `force` (N) is positive where it pushes ψ on."""
    made, drive, pressed = design.indexer, design.drive, loaded.pressed
    way = math.copysign(1.0, force)
    direction = made.path.point(np.asarray(angle))
    push = way * slot_normal(made, np.asarray(angle))
    lag = way * float(loaded.lag[i]) * made.axis  # ψ grows about −o
    side = np.cross(push, direction)
    if drive.pin.shape == "barrel":
        axes = np.stack([pressed.along[i] * direction, pressed.half_width[i, 0] * side])
        middle = drive.sphere_radius * direction + drive.pin_radius * push
        strip = ellipse(middle, axes, float(pressed.pressure[i, 0]))
        places = np.array([drive.sphere_radius])
    else:
        slices = contact_slices(pair)
        breaks, places = np.append(slices.inner, slices.outer[-1]), slices.middle
        wide = drive.pin_radius * (breaks / drive.sphere_radius if drive.pin.shape == "cone" else 1.0)
        middle = breaks[:, None] * direction + np.broadcast_to(wide, breaks.shape)[:, None] * push
        one = slice(i, i + 1)
        strip = strips(slices, middle[None], side[None], pressed.force[one], pressed.pressure[one])
    return _Pressed(strip, lag, push, *_bending(pair, places, pressed.force[i]))


def _bending(pair: Pair, places: Array, force: Array) -> tuple[Array, Array]:
    """Return places along a pin that is clamped at its root, m, and its deflection there, m, as that of a beam."""
    body = pair.pin
    ends = np.linspace(body.root, body.distance + 0.5 * body.thickness, 13)[1:] - 1e-6 * body.thickness
    both = np.concatenate([ends, places])
    order = np.argsort(both)  # no two places alike: ends lie beside the forces
    load = np.concatenate([np.zeros(len(ends)), force])[order]
    moved = flexibility(body, both[order]) @ load
    return np.append(body.root, both[order]), np.append(0.0, moved)


def contact_slices(pair: Pair) -> Slices:
    """Return the slices in which pin and slot touch: even ones for half-spaces, the wheel's layers otherwise."""
    if pair.elastic is not None:
        return pair.elastic.wall.slices
    count = pair.state(np.zeros(1)).pressed.force.shape[1]
    low, thick = pair.pin.distance - 0.5 * pair.pin.thickness, pair.pin.thickness
    return between(low + thick * np.arange(count + 1) / count)


def _bodies(
    design: Design, middle: Solid, angle: float, psi: float, state: _Pressed | None, wall: Array
) -> Iterator[Field]:
    path = design.indexer.path
    lag = np.zeros(3) if state is None else state.lag
    placed = on_wheel(design, middle, psi)
    yield _field("hub and output shaft", placed, {"displacement": np.cross(lag, placed.points)}, SOLID)
    direction = path.point(np.asarray(angle))
    body = pin(design, direction)
    moved = np.zeros_like(body.points)
    if state is not None:
        bent = np.interp(body.points @ direction, state.along, state.deflection)
        moved = -bent[:, None] * state.push
    yield _field("pin", body, {"displacement": moved, "deformation": moved}, DARK)
    if state is not None:
        strip = state.strip
        data = {
            "displacement": np.cross(lag, strip.points) + wall,
            "deformation": wall,
            "from_middle": strip.from_middle,
            "contact_pressure": strip.pressure,
        }
        yield _field("contacts", Solid(strip.points, strip.cells), data, SOLID)
    axis = turned(np.array([[math.sin(path.arm), 0.0, math.cos(path.arm)]]), angle)[0]
    gear = planet(design, axis)
    if gear is not None:
        yield _field("planet", gear, {}, BRASS)
    yield _field("arm and drive shaft", arm(design, angle), {}, SOLID)


def _field(name: str, solid: Solid, data: dict[str, Array], look: tuple[str, float]) -> Field:
    single = {key: np.asarray(x, dtype=np.float32) for key, x in data.items()}
    return Field(name, np.asarray(solid.points, dtype=np.float32), solid.cells, single, "triangle", *look)


def _eye(design: Design) -> tuple[float, float, float]:
    """Return where to look from: across both shafts, from outside the wheel's slots."""
    middle = design.indexer.path.point(np.asarray(0.0))
    x, y, z = 0.8 * middle + np.array([0.0, -1.0, 0.3]) + 0.1 * design.indexer.axis
    return float(x), float(y), float(z)

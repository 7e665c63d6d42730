"""The drive over a turn of its crank in space: elastic teeth with their stress, and the pressure of all contacts.

A pitch of the crank later all is as before, but for the numbers of rollers and teeth, which have moved by one: the
positions solved over a pitch make the whole turn.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from trochoid.drives.precessional.contact import to_flank
from trochoid.drives.precessional.contact_stages import Solved
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.film_bodies import holder, hub, input_shaft, rolled, rollers_turned
from trochoid.drives.precessional.rim import toothed
from trochoid.drives.solids import Solid, joined
from trochoid.fem.cone_field import displacements, rim_field, station_forces
from trochoid.fem.cone_stress import joined_at_cuts, nodal_stress, stress_rule, von_mises
from trochoid.fem.cone_strip import Strips, cone_strips, flank_displacement
from trochoid.fem.cone_surface import ToothSurface, tooth_surface
from trochoid.kinematics.nutation import satellite_motion
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array
from trochoid.results.film import Field, FieldFrame, Film, Later

FRAMES, FEW, MANY_NODES = 18, 9, 20_000  # over a turn; fewer where the teeth have many nodes
GLASS, SOLID = ("#9fb3c8", 0.18), ("#c9a55c", 1.0)  # colour and opacity of what carries no numbers
SEEN_FROM = (0.75, 0.6)  # and from the side of z to which the flanks are open


def contact_film(design: Design, solved: Solved) -> Film:
    """Return the drive over a turn of the crank in the fixed frame, under the output torque."""
    return Film(
        "contacts",
        "Pressure of the contacts and stress of the teeth",
        Later(lambda: _frames(design, solved)),
        shown="contact_pressure",
        spatial=True,
        seen_from=(*SEEN_FROM, 1.0 if solved.level.rim.shape.tooth.hole else -1.0),
    )


def _frames(design: Design, solved: Solved) -> tuple[FieldFrame, ...]:
    series, rim = solved.fine, solved.level.rim
    surface = tooth_surface(rim.body)
    count = FRAMES if rim.shape.tooth.lobes * len(surface.plane) <= MANY_NODES else FEW
    steps = design.nutation.fixed_teeth * len(series.crank)
    chosen = np.round(steps * np.arange(count) / count).astype(int)
    crank = 2.0 * math.pi * chosen / steps
    states = _states(design, solved, surface, np.unique(chosen % len(series.crank)))
    spun = rolled(design, series, crank)
    made: list[FieldFrame] = []
    for number, angle, turned in zip(chosen, crank, spun, strict=True):
        shift, row = divmod(int(number), len(series.crank))
        bodies = tuple(_bodies(design, solved, surface, states[row], row, shift, float(angle), turned))
        made.append((float(angle), bodies))
    return tuple(made)


@dataclass(frozen=True, eq=False, slots=True)
class _State:
    """What the rim does at a solved position: `deformation` (teeth, k, 3) m and von Mises `stress` (teeth, k) Pa of its
    surface, each tooth's in the frame of tooth 0; contacts and their deformation in the rim's frame, if there are any.
    """

    deformation: Array
    stress: Array
    contacts: tuple[Strips, Array] | None


def _states(design: Design, solved: Solved, surface: ToothSurface, rows: Array) -> dict[int, _State]:
    """Return what the rim does at the solved positions `rows`."""
    series, rim = solved.fine, solved.level.rim
    (tooth, _), body, pitch = toothed(design), rim.body, rim.shape.pitch
    turned = to_flank(tooth, series.crank[rows])
    point, normal = (turn(turned[:, None], x[rows]) for x in (series.point, series.normal))
    place, force, pressure = series.place[rows], series.force[rows], series.pressure[rows]
    loads = np.array([station_forces(rim, p, f) for p, f in zip(place, force, strict=True)])
    rule, found = stress_rule(body), {}
    for i, moved in enumerate(displacements(rim_field(rim), loads)):
        stress = joined_at_cuts(body, pitch, np.array([nodal_stress(rule, one) for one in moved]))
        pressed = np.flatnonzero(force[i].sum(axis=-1) > 0.0)
        contacts = None
        if len(pressed):
            strip = cone_strips(
                rim.compliance.slices,
                point[i, pressed],
                normal[i, pressed],
                force[i, pressed],
                pressure[i, pressed],
            )
            contacts = (
                strip,
                flank_displacement(rim, moved, place[i, pressed][strip.contact], strip.distance),
            )
        at = (slice(None), surface.plane, surface.layer)
        found[int(rows[i])] = _State(moved[at], von_mises(stress[at]), contacts)
    return found


def _bodies(
    design: Design,
    solved: Solved,
    surface: ToothSurface,
    state: _State,
    row: int,
    shift: int,
    angle: float,
    spun: Array,
) -> Iterator[Field]:
    series = solved.fine
    tooth, _ = toothed(design)
    crank = rotation(2, angle)
    satellite = satellite_motion(design.nutation, angle).rotation[0]
    still = np.eye(3)
    on_ring = tooth.pins_on == "ring"
    lobed_at, pins_at = (satellite, still) if on_ring else (still, satellite)
    tilt = crank @ series.motion[row]
    lobed, pinned = ("satellite", "wheel") if on_ring else ("wheel", "satellite")
    yield _teeth(solved, surface, state, shift, lobed, lobed_at, tilt if on_ring else 0.0 * tilt)
    if state.contacts is not None:
        # at the solved position the rim stood in the crank's frame as its teeth, `shift` on, do now
        at = crank @ to_flank(tooth, series.crank[row : row + 1])[0].T
        yield _contacts(*state.contacts, at, tilt if on_ring else 0.0 * tilt)
    rollers = joined(list(rollers_turned(design, spun))).turned(pins_at)
    carried = np.roll(series.total[row], shift)
    each = len(rollers.points) // tooth.pins
    data = {"roller_force": np.repeat(carried, each)}
    if not on_ring:
        data["displacement"] = _rotated(tilt, rollers.points)
    yield _field("rollers", rollers, data)
    yield _field(f"{pinned}, holder of the rollers", holder(design).turned(pins_at), {})
    middle = hub(design)
    if middle is not None:
        yield _field(f"{lobed}, hub", middle.turned(lobed_at), {})
    yield _field("input shaft", input_shaft(design).turned(crank), {}, SOLID)


def _teeth(
    solved: Solved,
    surface: ToothSurface,
    state: _State,
    shift: int,
    name: str,
    pose: Array,
    tilt: Array,
) -> Field:
    rim = solved.level.rim
    teeth, nodes = len(state.stress), len(surface.plane)
    at = pose @ rotation(2, rim.shape.pitch * np.arange(teeth))
    points = turn(at[:, None], surface.points(rim.body)).reshape(-1, 3)
    deformation = turn(at[:, None], np.roll(state.deformation, shift, axis=0)).reshape(-1, 3)
    data = {
        "displacement": deformation + _rotated(tilt, points),
        "deformation": deformation,
        "von_mises": np.roll(state.stress, shift, axis=0).ravel(),
    }
    cells = np.concatenate([surface.cells + nodes * k for k in range(teeth)], axis=1)
    return Field(name, _single(points), cells, {key: _single(x) for key, x in data.items()}, "triangle6")


def _contacts(strip: Strips, moved: Array, pose: Array, tilt: Array) -> Field:
    points, deformation = turn(pose, strip.points), turn(pose, moved)
    data = {
        "displacement": deformation + _rotated(tilt, points),
        "deformation": deformation,
        "from_middle": turn(pose, strip.from_middle),
        "contact_pressure": strip.pressure,
    }
    return _field("contacts", Solid(points, strip.cells), data, SOLID)


def _field(name: str, solid: Solid, data: dict[str, Array], look: tuple[str, float] = GLASS) -> Field:
    single = {key: _single(x) for key, x in data.items()}
    return Field(name, _single(solid.points), solid.cells, single, "triangle", *look)


def _rotated(vector: Array, points: Array) -> Array:
    """Return how points (n, 3) move when they turn about O by a rotation vector (3,), rad (Rodrigues)."""
    angle = float(np.linalg.norm(vector))
    once = np.cross(vector, points)
    second = 0.5 * np.sinc(0.5 * angle / math.pi) ** 2
    return np.asarray(np.sinc(angle / math.pi) * once + second * np.cross(vector, once))


def _single(values: Array) -> Array:
    return np.asarray(values, dtype=np.float32)

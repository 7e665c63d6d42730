"""Reactions of all bearings of an RV drive over a turn of its crankshafts, in the carrier's frame, and what the casing
feels.

*rigid*: members on their exact paths; forces of pins, rollers and teeth come from the contact solution, the bearings of
crankshafts and carrier follow by Newton and Euler: each crankshaft and the carrier is a rigid body on two bearings.
*elastic*: the members' elastic motion has accelerations, and their inertia acts back through the same stiffnesses
(dynamics.carried). With every stiffness growing the second becomes the first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.rv.carried import carried_masses, crank_masses
from trochoid.drives.rv.contact import inertia
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.mass import Masses
from trochoid.drives.rv.series import Series
from trochoid.drives.rv.supports import pressing
from trochoid.dynamics.carried import Carried, inertia_wrench, respond_carried
from trochoid.dynamics.elastic import Response, explain
from trochoid.dynamics.newton_euler import support_reactions
from trochoid.dynamics.spectrum import close_turn
from trochoid.dynamics.wrench import Wrench, balance_residual, couple, total, wrench
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Forces:
    """Forces in N over n positions: `arm` (n, d, j, 2) of discs on crankshafts, `crank` (n, j, 2, 2) of crankshafts on
    the carrier in bearings A, B, `main` (n, 2, 2) of the carrier on its main bearings, `ring` (n, d, 2) of discs on the
    ring, `sun` (n, 2) of the sun on what holds it.
    """

    arm: Array
    crank: Array
    main: Array
    ring: Array
    sun: Array


@dataclass(frozen=True, slots=True)
class Reactions:
    """Over n positions of one turn of the crankshafts as seen from the carrier, in its frame, at input `angle` (n,).

    `casing` and `casing_rigid`: resultant on the casing. `mismatch` is how far the record is from closing after the
    turn, relative; `residual` how far the sum of all forces on the casing is from the members' inertia, `work` how far
    the work on the elastic motion is from what damping takes.
    """

    angle: Array
    rigid: Forces
    elastic: Forces | None
    casing_rigid: Wrench
    casing: Wrench
    response: Response | None
    reason: str
    mismatch: float
    residual: float
    work: float = 0.0


@dataclass(frozen=True, slots=True)
class _Loads:
    """What acts on the crankshafts: arms (n, d, j, 2), teeth (n, j, 2) on planets, inertia (n, j, p, 2) at all places;
    and `sun_inertia` (n, 2), `ring` (n, d, 2) of the discs.
    """

    arm: Array
    teeth: Array
    own: Array
    sun_inertia: Array
    ring: Array


def reactions(design: Design, series: Series, masses: Masses, damping: float) -> Reactions:
    """Return rigid reactions and, where bearings are compliant, stiffness-aware ones.

    Raises TrochoidError for fewer than 3 positions; NotConverged.
    """
    if len(series.angle) < 4:
        raise TrochoidError("reactions over a turn need at least 3 positions: raise ask.positions")
    arm, mismatch = close_turn(series.arm.resultant)
    loads, discs = _rigid_loads(design, series, masses, arm)
    rigid = _forces(design, series, loads)
    casing_rigid = total([wrench(_disc_places(design), discs), _own_wrench(design, series, loads)])
    residual = _residual(design, series, rigid, casing_rigid)
    size = float(np.abs(arm).max(initial=0.0)) or 1.0
    made = Reactions(
        frozen(series.angle[:-1]),
        rigid,
        None,
        casing_rigid,
        casing_rigid,
        None,
        "bearings are rigid in this scene: there is nothing to feed back",
        float(np.abs(mismatch).max() / size),
        residual,
    )
    if not design.scene.has("bearing_compliance"):
        return made
    if np.isnan(series.compliance).any():
        reason = "the drive is free within its play: only the rigid reactions have a meaning"
        return replace(made, reason=reason)
    return _elastic(design, series, masses, damping, made, loads)


def carrier_bearings(design: Design) -> Array:
    """Return the places (2,) of the carrier's main bearings on the z axis: given, or in the middle of its plates."""
    table = design.drive.carrier
    if table.bearing_positions is not None:
        return np.array(table.bearing_positions)
    middle = 0.5 * (design.pack_width + table.thickness)
    return np.array([-middle, middle])


def _rigid_loads(design: Design, series: Series, masses: Masses, arm: Array) -> tuple[_Loads, Array]:
    """Return the loads of members on exact paths, and the centrifugal forces (n, d, 2) of the discs."""
    crank, held = series.crank[:-1], series.motions.supports
    places, speed = design.crank_places, frame_speed(design)
    teeth, _ = close_turn(series.mesh_force)
    ring, _ = close_turn(series.ring.resultant)
    # all parts of a crankshaft go round with its axis, eccentrics round that axis as well
    round_axis = crank_masses(design, masses, held.places)[None, :, None] * speed**2 * places[:, None]
    own = np.tile(round_axis, (len(crank), 1, 1, 1))
    discs = []
    for i in range(len(design.discs)):
        disc, eccentric = inertia(design, i, crank)
        own[:, :, i] += eccentric[:, None]
        discs.append(disc)
    pushed = teeth[..., None] * pressing(design)
    return _Loads(arm, pushed, own, np.zeros((len(crank), 2)), ring), np.stack(discs, axis=1)


def frame_speed(design: Design) -> float:
    """Return the speed of the carrier, rad/s."""
    return float(design.speeds.members["carrier"]) * design.scene.operation.input_speed


def _forces(design: Design, series: Series, loads: _Loads) -> Forces:
    """Balance each crankshaft and the carrier on their two bearings."""
    held, table = series.motions.supports, design.drive.crankshaft
    discs = np.array([disc.z for disc in design.discs])
    z = np.concatenate([discs, [table.planet_position], held.places])
    ends, crank = np.array(table.bearing_positions), []
    for j in range(len(design.crank_places)):
        on = np.concatenate([loads.arm[:, :, j], loads.teeth[:, j, None], loads.own[:, j]], axis=1)
        crank.append(-support_reactions(ends, on, z))
    on_carrier = np.stack(crank, axis=1)
    main = -support_reactions(carrier_bearings(design), on_carrier.sum(axis=1), ends)
    sun = loads.sun_inertia - loads.teeth.sum(axis=1)
    return Forces(frozen(loads.arm), frozen(on_carrier), main, frozen(loads.ring), frozen(sun))


def _disc_places(design: Design) -> Array:
    return np.array([[0.0, 0.0, disc.z] for disc in design.discs])


def _own_wrench(design: Design, series: Series, loads: _Loads) -> Wrench:
    """Return the resultant of the crankshafts' own inertia."""
    z, places = series.motions.supports.places, design.crank_places
    points = np.array([[*place, each] for place in places for each in z])
    return wrench(points, loads.own.reshape(len(loads.own), -1, 2))


def _residual(design: Design, series: Series, found: Forces, inertia: Wrench) -> float:
    """Compare what ring, main bearings and the sun's support feel, as vectors, with the inertia of the members.

    About x and y; the torques about z have their own checks.
    """
    plane = replace(inertia, force=-inertia.force, moment=-inertia.moment * [1.0, 1.0, 0.0])
    return balance_residual([*_felt(design, found).values(), plane])


def on_casing(design: Design, found: Reactions, model: str) -> dict[str, Wrench]:
    """Return what the casing feels by a model, "rigid" or "elastic", by the names of the places (needs.SEATS_OF).

    In the carrier's frame. The couple about z acts where the member that stands still is held.
    """
    forces = found.rigid if model == "rigid" or found.elastic is None else found.elastic
    whole = found.casing_rigid if forces is found.rigid else found.casing
    places = _felt(design, forces)
    held = {"ring": ("ring",), "sun": ("sun",), "carrier": ("carrier A", "carrier B")}[design.drive.fixed]
    about_z = couple(whole.moment * [0.0, 0.0, 1.0 / len(held)])
    return {name: total([load, about_z]) if name in held else load for name, load in places.items()}


def _felt(design: Design, found: Forces) -> dict[str, Wrench]:
    """Return what the casing feels of ring, carrier and sun, by the names of the places."""
    main = [np.array([[0.0, 0.0, z]]) for z in carrier_bearings(design)]
    sun = np.array([[0.0, 0.0, design.drive.crankshaft.planet_position]])
    return {
        "ring": wrench(_disc_places(design), found.ring),
        **{f"carrier {x}": wrench(main[i], found.main[:, [i]]) for i, x in enumerate("AB")},
        "sun": wrench(sun, found.sun[:, None]),
    }


def _elastic(
    design: Design, series: Series, masses: Masses, damping: float, made: Reactions, loads: _Loads
) -> Reactions:
    motions = series.motions
    motion, _ = close_turn(series.motion)
    carried = carried_masses(design, motions, masses)
    speed = abs(design.turning) * design.scene.operation.input_speed
    stiffness = series.stiffness[:-1]
    found = respond_carried(  # modes swing many times while the crankshafts turn: as good as at rest
        motion, carried, stiffness, speed, frame_speed(design), damping, stiffness[0]
    )
    changed = _changed(design, series, loads, found)
    elastic = _forces(design, series, changed)
    casing = total([made.casing_rigid, inertia_wrench(carried, found)])
    return replace(
        made,
        elastic=elastic,
        casing=casing,
        response=found.response,
        reason=explain(found.response, [_spoken(name) for name in motions.names]),
        residual=max(made.residual, _residual(design, series, elastic, casing)),
        work=found.work,
    )


def _changed(design: Design, series: Series, loads: _Loads, found: Carried) -> _Loads:
    """Add to the loads what the dynamic motion makes of them: contacts carry what inertia asks and springs do not."""
    motions, held = series.motions, series.motions.supports
    spring, cranks = found.response.spring_correction, len(design.crank_places)
    contact = spring @ motions.springs(held.total) - found.response.inertia  # on the members
    discs, places = range(len(design.discs)), len(held.places)
    arm = np.stack(
        [np.stack([contact @ motions.crank(j, i)[:2].T for j in range(cranks)], axis=1) for i in discs],
        axis=1,
    )
    ring = -np.stack([contact @ motions.disc(i)[:2].T for i in discs], axis=1) - arm.sum(axis=2)
    pushed = held.teeth * spring @ motions.on_all(held.meshes).T
    first = len(design.discs)
    own = found.forces[:, first : first + cranks * places].reshape(len(spring), cranks, places, 2)
    return _Loads(
        loads.arm + arm,
        loads.teeth + pushed[..., None] * pressing(design),
        loads.own + own,
        loads.sun_inertia + found.forces[:, first + cranks * places],
        loads.ring + ring,
    )


def _spoken(name: str) -> str:
    """Return a motion's name in words: "rotation of disc 1" for "disc0.rotation"."""
    member, motion = name.split(".")
    kind, way = member.rstrip("0123456789"), motion.rstrip("0123456789")
    said = {"crank": "crankshaft"}.get(kind, kind)
    number = f" {int(member[len(kind) :]) + 1}" if member != kind else ""
    place = f" at disc {int(motion[len(way) :]) + 1}" if motion != way else ""
    return f"{way} of {said}{number}{place}"

"""Reactions of the bearings of shaft and flange over a turn, and what the casing feels.

*rigid*: members on their exact paths; discs and shafts balance by Newton–Euler, the contact forces come from
the contact solution. *elastic*: the members' elastic motion, which the contact solution finds for every
position, has accelerations; their inertia acts back through the same stiffnesses (dynamics.elastic). With
every stiffness growing the second becomes the first.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.khv.contact import Layout, centrifugal
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.eccentric import frames, mass_matrix, momenta, on_the_eccentric, turning
from trochoid.drives.khv.mass import Masses
from trochoid.drives.khv.series import Series
from trochoid.dynamics.elastic import Frame, Response, explain, respond
from trochoid.dynamics.floquet import fail_if_growing
from trochoid.dynamics.hill import rate, varied
from trochoid.dynamics.newton_euler import support_reactions
from trochoid.dynamics.spectrum import close_turn, harmonics, synthesize
from trochoid.dynamics.supports import Support, support_forces
from trochoid.dynamics.work import unmet
from trochoid.dynamics.wrench import Wrench, couple, total, wrench
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

MEMBERS = ("shaft", "output")


@dataclass(frozen=True, slots=True)
class Reactions:
    """Over n positions of one input turn, in the fixed frame.

    `rigid` and `elastic` by member: reactions (n, 2 bearings, 2) on it in N; `eccentric` (n, d, 2) force of
    the discs on the shaft, `ring` (n, d, 2) on the ring, of rigid members; `casing` and `casing_rigid`: resultant
    on the casing. `response` has axes that stand still. `mismatch` is how far the record is from closing after one
    turn, relative; `residual` the difference between the sum of all forces on the casing and the members' inertia,
    relative to the bearing forces; `work`: what the work on the elastic motion differs from what damping takes.
    """

    angle: Array
    rigid: dict[str, Array]
    elastic: dict[str, Array] | None
    eccentric: Array
    casing_rigid: Wrench
    casing: Wrench
    response: Response | None
    reason: str
    mismatch: float
    residual: float
    ring: Array
    work: float = 0.0


def reactions(design: Design, series: Series, masses: Masses, damping: float) -> Reactions:
    """Return rigid reactions and, when bearings are compliant, stiffness-aware ones.

    Raises TrochoidError for fewer than 3 positions; NotConverged where the varying stiffness excites itself.
    """
    if len(series.angle) < 4:
        raise TrochoidError("reactions over a turn need at least 3 positions: raise ask.positions")
    turn = float(design.speeds.members["ring"]) * series.angle
    inertia = _turned(centrifugal(design, series.crank), turn)
    ring, output = _turned(series.ring.resultant, turn), _turned(series.output.resultant, turn)
    eccentric, mismatch = close_turn(inertia - ring - output)
    pins, _ = close_turn(output)
    z = np.array([d.z for d in design.discs])
    rigid = {
        "shaft": support_reactions(_bearings(design, "shaft"), eccentric, z),
        "output": support_reactions(_bearings(design, "output"), pins, z),
    }
    size = float(np.abs(eccentric).max(initial=0.0)) or 1.0
    casing_rigid = wrench(_on_axis(z), close_turn(inertia)[0])
    on_ring, _ = close_turn(ring)
    residual = _residual(design, rigid, on_ring, casing_rigid, z, size)
    layout = Layout(series.names, True, True)
    response, work, elastic, casing, reason = (
        None,
        0.0,
        None,
        casing_rigid,
        "bearings are rigid in this scene: there is nothing to feed back",
    )
    if "shaft.x" in series.names and not (series.torsional_stiffness > 0).all():
        reason = (
            "the drive is free within its play: no stiffness holds the members, and only the rigid reactions "
            "have a meaning"
        )
    elif "shaft.x" in series.names:
        response, work = _response(design, series, masses, damping)
        elastic = {m: rigid[m] + _change(design, layout, m, response) for m in MEMBERS}
        casing = total([casing_rigid, _inertia_wrench(design, series.names, response.inertia)])
        reason = explain(response, [_spoken(name) for name in series.names])
    return Reactions(
        frozen(series.angle[:-1]),
        rigid,
        elastic,
        eccentric,
        casing_rigid,
        casing,
        response,
        reason,
        float(np.abs(mismatch).max() / size),
        residual,
        frozen(on_ring),
        work,
    )


def on_casing(design: Design, found: Reactions, model: str) -> dict[str, Wrench]:
    """Return what the casing feels by a model, "rigid" or "elastic", by the names of the places (needs.SEATS_OF).

    The discs' force on the ring by elastic members is what all inertia leaves of the bearings' forces. The couple about
    z acts where the member that stands still is held.
    """
    forces = found.rigid if model == "rigid" or found.elastic is None else found.elastic
    whole = found.casing_rigid if forces is found.rigid else found.casing
    places = {
        f"{name} {letter}": wrench(_on_axis(np.array([z])), -forces[member][:, [i]])
        for member, name in (("shaft", "input shaft"), ("output", "output flange"))
        for i, (letter, z) in enumerate(zip("AB", _bearings(design, member), strict=True))
    }
    about_z = whole.moment * [0.0, 0.0, 1.0]
    if forces is found.rigid:
        ring = wrench(_on_axis(np.array([d.z for d in design.discs])), found.ring)
    else:
        taken = [replace(each, force=-each.force, moment=-each.moment) for each in places.values()]
        ring = total([whole, *taken, couple(-about_z)])
    loads = {"ring": ring, **places}
    held = ("ring",) if design.drive.fixed == "ring" else ("output flange A", "output flange B")
    for name in held:
        loads[name] = total([loads[name], couple(about_z / len(held))])
    return loads


def _spoken(name: str) -> str:
    """Return a motion's name in words: "rotation of disc 1" for "disc0.rotation"."""
    member, motion = name.split(".")
    if member.startswith("disc"):
        member = f"disc {int(member[4:]) + 1}"
    return f"{motion.replace('_', ' about ')} of {member}"


def _turned(vectors: Array, angle: Array) -> Array:
    """Turn vectors (n, …, 2) of the ring's frame by the ring's angle (n,) into the fixed frame."""
    c, s = (f(angle).reshape(-1, *(1,) * (vectors.ndim - 2)) for f in (np.cos, np.sin))
    return np.stack(
        [c * vectors[..., 0] - s * vectors[..., 1], s * vectors[..., 0] + c * vectors[..., 1]], axis=-1
    )


def _bearings(design: Design, member: str) -> Array:
    table = design.drive.input_shaft if member == "shaft" else design.drive.output_flange
    return np.array(table.bearing_positions)


def _on_axis(z: Array) -> Array:
    return np.stack([0 * z, 0 * z, z], axis=-1)


def _residual(
    design: Design, rigid: dict[str, Array], ring: Array, inertia: Wrench, z: Array, size: float
) -> float:
    """Compare what ring and bearings put on the casing, summed as vectors, with the inertia of the members."""
    parts = [wrench(_on_axis(z), ring)]
    parts += [wrench(_on_axis(_bearings(design, m)), -rigid[m]) for m in MEMBERS]
    whole = total(parts)
    reach = float(np.abs(z).max(initial=0.0)) + design.drive.face_width
    force = np.abs(whole.force - inertia.force).max() / size
    moment = np.abs(whole.moment[:, :2] - inertia.moment[:, :2]).max() / (size * reach)
    return float(max(force, moment))


def _response(design: Design, series: Series, masses: Masses, damping: float) -> tuple[Response, float]:
    """Return the response along the axes of the fixed frame, and what its energy balance lacks, relative.

    It is found in the frame of the eccentric, where the stiffness varies least.
    """
    names, speed = series.names, design.crank_speed
    seen, stiffness = on_the_eccentric(series)
    motion, _ = close_turn(seen)
    mass, unit = mass_matrix(design, names, masses), turning(design, names, masses)
    frame = Frame(
        speed * unit.gyroscopic, speed**2 * unit.centrifugal, speed * unit.rate, ", seen from the eccentric"
    )
    found = respond(motion, mass, stiffness, speed, damping, frame)
    fail_if_growing(
        mass,
        found.damper + frame.gyroscopic,
        stiffness + frame.centrifugal + found.damper @ frame.rate,
        speed,
        "the stiffness of the contacts, which varies over the turn,",
    )
    turned = frames(names, series.angle[:-1])

    def out(record: Array) -> Array:
        return frozen(np.einsum("nij,nj->ni", turned, record))

    fixed = replace(
        found,
        motion=out(found.motion),
        correction=out(found.correction),
        spring_correction=out(found.spring_correction),
        velocity=out(found.velocity + found.correction @ frame.rate.T),
        acceleration=out(found.acceleration),
        inertia=out(found.inertia),
        amplitudes=harmonics(out(found.motion))[1:],
    )
    seen_from_it = (found.correction, motion, varied(stiffness, found.correction))
    return fixed, _work(
        names, seen_from_it, (mass, speed * momenta(design, names, masses)), speed, found.loss
    )


def _work(
    names: tuple[str, ...], seen: tuple[Array, ...], inertia: tuple[Array, Array], speed: float, loss: float
) -> float:
    """Return how far the work of all loads on the elastic motion is from what damping takes, relative.

    Along axes that stand still, where no term of the turning frame occurs: `seen` from the eccentric are y, q and the
    forces of all springs, which are turned out and differentiated there; `inertia`: M and the momenta about z.
    """
    count = 2 * len(seen[0])  # turning adds a harmonic
    turned = frames(names, 2.0 * np.pi * np.arange(count) / count)
    y, still, springs = (
        np.einsum("nij,nj->ni", turned, synthesize(harmonics(record), count)) for record in seen
    )
    mass, spins = inertia
    load = -rate(still, speed, 2) @ mass - rate(still, speed) @ spins.T
    return unmet(rate(y, speed), (load, -springs), loss)


def _change(design: Design, layout: Layout, member: str, response: Response) -> Array:
    """Return the change (n, 2, 2) of a member's bearing reactions by the dynamic motion."""
    table = design.drive.input_shaft if member == "shaft" else design.drive.output_flange
    changes = []
    for z, stiffness in zip(table.bearing_positions, design.supports[member], strict=True):
        support = Support(member, layout.rows(member, z)[:2], stiffness * np.eye(2))
        changes.append(-support_forces(support, response.spring_correction))
    return np.stack(changes, axis=1)


def _inertia_wrench(design: Design, names: tuple[str, ...], inertia: Array) -> Wrench:
    """Return the resultant of inertia loads (n, k) on the motions, about the origin."""
    loads = []
    for i, name in enumerate(names):
        member, motion = name.split(".")
        z = design.discs[int(member[4:])].z if member.startswith("disc") else 0.0
        vector = np.zeros((len(inertia), 3))
        axis = {"x": 0, "y": 1, "rotation": 2, "tilt_x": 0, "tilt_y": 1}[motion]
        vector[:, axis] = inertia[:, i]
        point = np.array([[0.0, 0.0, z]])
        loads.append(wrench(point, vector[:, None]) if motion in ("x", "y") else couple(vector))
    return total(loads)

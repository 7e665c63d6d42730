"""Reactions of the bearings of shaft and flange over a turn, and what the casing feels.

*rigid*: members on their exact paths; discs and shafts balance by Newton–Euler, the contact forces come from
the contact solution. *elastic*: the members' elastic motion, which the contact solution finds for every
position, has accelerations; their inertia acts back through the same stiffnesses (dynamics.elastic). With
every stiffness growing the second becomes the first.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.contact import Layout, centrifugal
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.mass import Masses
from trochoid.drives.khv.series import Series
from trochoid.dynamics.elastic import Response, explain, respond
from trochoid.dynamics.newton_euler import support_reactions
from trochoid.dynamics.spectrum import close_turn
from trochoid.dynamics.supports import Support, support_forces
from trochoid.dynamics.wrench import Wrench, couple, total, wrench
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

MEMBERS = ("shaft", "output")


@dataclass(frozen=True, slots=True)
class Reactions:
    """Over n positions of one input turn, in the fixed frame.

    `rigid` and `elastic` by member: reactions (n, 2 bearings, 2) on it in N; `eccentric` (n, d, 2) force of
    the discs on the shaft; `casing` and `casing_rigid`: resultant on the casing. `mismatch` is how far the
    record is from closing after one turn, relative; `residual` the difference between the sum of all forces
    on the casing and the members' inertia, relative to the bearing forces.
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


def reactions(design: Design, series: Series, masses: Masses, damping: float) -> Reactions:
    """Return rigid reactions and, when bearings are compliant, stiffness-aware ones.

    Raises TrochoidError for fewer than 3 positions.
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
    residual = _residual(design, rigid, close_turn(ring)[0], casing_rigid, z, size)
    layout = Layout(series.names, True, True)
    response, elastic, casing, reason = (
        None,
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
        response = _response(design, series, masses, damping, turn)
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
    )


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


def _response(design: Design, series: Series, masses: Masses, damping: float, turn: Array) -> Response:
    turned = frames(series.names, turn)
    motion, _ = close_turn(np.einsum("nij,nj->ni", turned, series.motion))
    stiffness = np.einsum("nij,njk,nlk->nil", turned, series.stiffness, turned)[:-1]
    return respond(motion, mass_matrix(design, series.names, masses), stiffness, design.crank_speed, damping)


def frames(names: tuple[str, ...], turn: Array) -> Array:
    """Return matrices (n, k, k) that turn motions from the ring's frame into the fixed one."""
    made = np.tile(np.eye(len(names)), (len(turn), 1, 1))
    for first, second in (("x", "y"), ("tilt_x", "tilt_y")):
        for i in [i for i, name in enumerate(names) if name.endswith("." + first)]:
            j = names.index(names[i].removesuffix(first) + second)
            made[:, i, i] = made[:, j, j] = np.cos(turn)
            made[:, j, i], made[:, i, j] = np.sin(turn), -np.sin(turn)
    return made


def mass_matrix(design: Design, names: tuple[str, ...], masses: Masses) -> Array:
    """Return the diagonal mass matrix of the motions: kg for x and y, kg·m² for rotation and tilt."""
    pins = design.drive.output_pins
    flange = masses.flange.mass + pins.count * masses.output_pin.mass
    spin = masses.flange.axial_inertia + pins.count * masses.output_pin.mass * pins.circle_radius**2
    tilt = masses.flange.transverse_inertia + 0.5 * (spin - masses.flange.axial_inertia)
    disc = {"x": masses.disc.mass, "y": masses.disc.mass, "rotation": masses.disc.axial_inertia}
    shaft_tilt = masses.shaft.transverse_inertia
    values = {
        "shaft": {"x": masses.shaft.mass, "y": masses.shaft.mass, "tilt_x": shaft_tilt, "tilt_y": shaft_tilt},
        "output": {"x": flange, "y": flange, "rotation": spin, "tilt_x": tilt, "tilt_y": tilt},
    }
    split = [name.split(".") for name in names]
    return np.diag([values.get(member, disc)[motion] for member, motion in split])


def _change(design: Design, layout: Layout, member: str, response: Response) -> Array:
    """Return the change (n, 2, 2) of a member's bearing reactions by the dynamic motion."""
    table = design.drive.input_shaft if member == "shaft" else design.drive.output_flange
    changes = []
    for z in table.bearing_positions:
        support = Support(member, layout.rows(member, z)[:2], table.bearing_stiffness * np.eye(2))
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

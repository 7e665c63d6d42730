"""All rollers and teeth together over one pitch of the teeth, with the satellite's rotations about O free.

In the frame of the crank (z along the shaft, the satellite's axis n = (sin ϑ, 0, cos ϑ)) everything repeats after a
pitch of the wheel, 2π/z1 of the crank: pins and lobes have then moved by one.  The satellite is loaded by the joint at
O, whose moment on it is −T (n + k)/(1 + cos ϑ): it gives power to the output alone, whatever the satellite does.
The bearing A holds the satellite's axis against tilting about O.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.overload import explained
from trochoid.drives.precessional.rim import crowning, lean, play, reach, toothed
from trochoid.drives.precessional.teeth import Level
from trochoid.fem.cone_assembly import ConeAssembly, ConeContact
from trochoid.fem.cone_pair import RollerPair, crown, roller_pair
from trochoid.fem.cone_position import solve_cone
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array, BoolArray, frozen

TRIAL = 25, 400  # steps and pivots that a load may take which is only tried: enough below the limit
HELD = 1e4  # E R³: what is held rigidly is so much stiffer than teeth, which have a tenth of E R³ at the most


@dataclass(frozen=True, eq=False, slots=True)
class Series:
    """Contacts at crank angles (n,), rad, over a pitch under the output's `torque` (N·m); vectors in the crank's frame.

    `force`, `pressure` (n, pins, slices) N, Pa at distances `places` (slices,) m from O; `point`, `normal` (n, pins, 3)
    of the contacts, the normal out of the lobed member, `place` (n, pins) their arc lengths, rad, from the start of the
    flank's tooth 0; `edge` (n, pins) where a pressure at an edge has no bound.
    `motion` (n, 3) rotation of the satellite, rad; `mesh` (n, 3, 3) stiffness of the teeth, N·m/rad, `held` (3, 3)
    that of what holds the satellite's axis.  The joint O puts the moment −`torque`·`out` (3,) on the satellite, which
    turns the output by its rotation along `out`.  `on_satellite` is +1 where pins are on it: the sign of n F on it.
    `residual` (n,) is the worst overlap over the largest approach, `breadth` (n,) the largest half width of a contact
    over its relative radius of curvature, which Hertz takes as small.
    """

    crank: Array
    torque: float
    axis: Array
    places: Array
    force: Array
    pressure: Array
    point: Array
    normal: Array
    place: Array
    edge: BoolArray
    motion: Array
    mesh: Array
    held: Array
    out: Array
    on_satellite: int
    residual: Array
    breadth: Array

    def thinned(self, stride: int) -> Iterator[Series]:
        """Yield every so-manieth position, from each of the first on; nothing where there are too few."""
        n = len(self.crank)
        of_all = {f.name for f in fields(self)} - {"torque", "axis", "places", "held", "out", "on_satellite"}
        for start in range(stride) if n >= stride else ():
            yield replace(self, **{name: getattr(self, name)[start::stride] for name in of_all})

    @property
    def total(self) -> Array:
        """Force (n, pins) of each contact, N."""
        return np.asarray(self.force.sum(axis=-1))

    @property
    def load(self) -> Array:
        """Moment (3,) of the joint O on the satellite, N·m."""
        return np.asarray(-self.torque * self.out)

    @property
    def lag(self) -> Array:
        """How far (n,), rad, the load pushes the output back."""
        return np.asarray(-self.motion @ self.out)

    @property
    def tooth_force(self) -> Array:
        """Force (n, 3) of all teeth on the satellite, N."""
        return np.asarray(self.on_satellite * np.einsum("nc,nci->ni", self.total, self.normal))

    @property
    def tooth_moment(self) -> Array:
        """Moment (n, 3) about O of all teeth on the satellite, N·m, from the forces on the slices."""
        lever = np.einsum("ncs,s->nc", self.force, self.places)
        return np.asarray(
            self.on_satellite * np.einsum("nc,nci->ni", lever, np.cross(self.point, self.normal))
        )

    @property
    def torsional_stiffness(self) -> Array:
        """Torque over angle (n,) at the output with the input held, N·m/rad; 0 where nothing touches."""
        if not self.force.any():
            return np.zeros(len(self.crank))
        yielded = np.linalg.solve(
            self.mesh + self.held, np.broadcast_to(self.out[:, None], (*self.motion.shape, 1))
        )
        return np.asarray(1.0 / np.einsum("i,nij->n", self.out, yielded))


def pitch_angles(design: Design, positions: int) -> Array:
    """Return crank angles (n,) over a pitch of the wheel's teeth, its end left out."""
    return frozen(2.0 * math.pi / design.nutation.fixed_teeth * np.arange(positions) / positions)


def to_flank(tooth: SphereTooth, crank: Array) -> Array:
    """Return what turns vectors of the crank's frame into that of the lobed member, (n, 3, 3)."""
    if tooth.pins_on == "satellite":
        return rotation(2, crank)
    return np.asarray(rotation(2, float(tooth.pair.tooth_ratio) * crank) @ rotation(1, -tooth.nutation))


def output_unit(design: Design) -> Array:
    """Return (n + k)/(1 + cos ϑ), (3,), with the sign of the output's speed."""
    n = design.nutation.axis
    way = 1.0 if design.nutation.ratio > 0 else -1.0
    k = np.array([0.0, 0.0, 1.0])
    return np.asarray(way * (n + k) / (1.0 + n[2]))


def solve_series(
    design: Design,
    level: Level,
    torque: float,
    crank: Array,
    tilt_stiffness: float | None = None,
    moment: Array | None = None,
) -> Series:
    """Solve the positions; `tilt_stiffness` (N·m/rad) of the satellite's axis about O, None: held rigidly.

    A torque below 0 drives the output on.  `moment` (3,) in N·m about O acts on the satellite besides, steady in the
    crank's frame: that of its inertia is `inertia_moment`.  Raises NotConverged.
    """
    (tooth, _), compliance = toothed(design), level.rim.compliance
    turned = to_flank(tooth, crank)
    n, out = design.nutation.axis, output_unit(design)
    stiff = _rigid(design) if tilt_stiffness is None else tilt_stiffness
    held = stiff * (np.eye(3) - np.outer(n, n))
    moves = satellite_moves(tooth, turned)
    sign = -1 if tooth.pins_on == "ring" else 1  # of the force along the contact's normal on the satellite
    load = turn(turned, sign * (torque * out - (0.0 if moment is None else moment)))
    slices, pair = compliance.slices, paired(design, level, crank)
    springs = stiff * np.diag([1.0, 1.0, 0.0])  # in the satellite's frame, or a frame with its axis
    assembly = ConeAssembly(compliance, pair, springs, turn(np.swapaxes(moves, 1, 2), load), level.roller)
    try:
        found = [solve_cone(assembly)] if tooth.pins_on == "ring" else _one_by_one(assembly, moves)
    except NotConverged as fault:
        row = 0 if fault.row is None else fault.row
        one = _alone(assembly, moves, row)

        def tried(share: float) -> ConeContact:
            return solve_cone(replace(one, load=share * one.load), steps=TRIAL[0], pivots=TRIAL[1])

        raise explained(design, torque, crank[row], fault, tried) from fault
    back = np.swapaxes(turned, 1, 2)

    def joined(name: str) -> Array:
        return np.concatenate([getattr(each, name) for each in found])

    def placed(name: str) -> Array:
        return turn(back[:, None], np.concatenate([getattr(each.state, name) for each in found]))

    to_arm = back @ moves
    mesh = to_arm @ (joined("stiffness") - springs) @ np.swapaxes(to_arm, 1, 2)
    short = reach(design) is not None
    return Series(
        crank=frozen(crank),
        torque=torque,
        axis=n,
        places=slices.middle,
        force=joined("force"),
        pressure=joined("pressure"),
        point=placed("point"),
        normal=placed("normal"),
        place=np.concatenate([each.state.place for each in found]),
        edge=np.concatenate([_edges(each, short) for each in found]),
        motion=-sign * turn(to_arm, joined("motion")) if torque else np.zeros((len(crank), 3)),
        mesh=mesh,
        held=held,
        out=out,
        on_satellite=sign,
        residual=joined("residual"),
        breadth=np.concatenate([_breadth(tooth, each, slices.middle) for each in found]),
    )


def paired(design: Design, level: Level, crank: Array) -> RollerPair:
    """Return all rollers as the scene has them against the flank of the rim."""
    (tooth, _), rim = toothed(design), level.rim
    slices = rim.compliance.slices
    return roller_pair(
        tooth,
        crank,
        slices,
        rim.shape.start,
        clearance=play(design),
        relief=crown(slices, crowning(design)),
        edges=rim.shape.edges,
        lean=lean(design),
    )


def inertia_moment(design: Design) -> Array:
    """Return the mean moment (3,) of the satellite's inertia about O, N·m, in the crank's frame of the contacts.

    ε and ω are those of the rigid drive; a satellite with uneven moments of inertia shakes besides, about this mean.
    """
    from trochoid.drives.precessional.reactions import inertia_couple

    turns = 2.0 * math.pi * np.arange(8) / 8 / float(2 * design.nutation.tooth_ratio)
    x, y, z = inertia_couple(design.mechanism, turns, design.speed).mean(axis=0)
    return np.array([y, -x, z])  # there y points to the side of A, here x


def _rigid(design: Design) -> float:
    """Return the stiffness (N·m/rad) that stands for a rigid hold."""
    young = design.scene.materials[design.scene.drive.material].youngs_modulus
    return HELD * young * design.tooth_radius**3


def satellite_moves(tooth: SphereTooth, turned: Array) -> Array:
    """Return the rotations (n, 3, 3) of the lobed member to be solved for, the last about the satellite's axis."""
    if tooth.pins_on == "ring":  # that axis stands still in the satellite's own frame
        return np.broadcast_to(np.eye(3), turned.shape)
    return np.asarray(turned @ rotation(1, tooth.nutation))


def _one_by_one(assembly: ConeAssembly, moves: Array) -> list[ConeContact]:
    """Solve positions whose motions differ."""
    found = []
    for i in range(len(moves)):
        try:
            found.append(solve_cone(_alone(assembly, moves, i)))
        except NotConverged as fault:
            raise NotConverged(str(fault), i) from fault
    return found


def _alone(assembly: ConeAssembly, moves: Array, row: int) -> ConeAssembly:
    """Return one position, with motions of its own."""
    rows = np.array([row])
    pair = replace(assembly.pair.rows(rows), moves=np.concatenate([moves[row], np.zeros((3, 3))]))
    return replace(assembly, pair=pair, load=assembly.load[rows])


def _breadth(tooth: SphereTooth, found: ConeContact, places: Array) -> Array:
    """Return the largest half width (n,) over the least relative radius of curvature within it."""
    half = (found.half_width / places).max(axis=-1)
    reach = half / np.maximum(tooth.speed(found.state.parameter), 1e-300)
    within = found.state.parameter + np.linspace(-1.0, 1.0, 5)[:, None, None] * reach
    bend = found.state.bend + tooth.curvature(within).max(axis=0) - tooth.curvature(found.state.parameter)
    return np.asarray(np.where(found.state.off, 0.0, half * bend).max(axis=1))


def _edges(found: ConeContact, short: bool) -> BoolArray:
    """Say where an edge presses: ends of rollers that are shorter than the flank, edges of cut crests."""
    cut = found.state.off & (found.total > 0.0)
    return np.asarray(found.edge() if short else cut)

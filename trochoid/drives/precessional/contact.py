"""All rollers and teeth together over one pitch of the teeth, with the satellite's rotations about O free.

In the frame of the crank (z along the shaft, the satellite's axis n = (sin ϑ, 0, cos ϑ)) everything repeats after a
pitch of the wheel, 2π/z1 of the crank: pins and lobes have then moved by one.  The satellite is loaded by the joint at
O, whose moment on it is −T (n + k)/(1 + cos ϑ): it gives power to the output alone, whatever the satellite does.
The bearing A holds the satellite's axis against tilting about O.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.rim import crowning, play, reach, toothed
from trochoid.drives.precessional.teeth import Level
from trochoid.fem.cone_pair import crown, roller_pair
from trochoid.fem.cone_position import ConeAssembly, ConeContact, solve_cone
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical import rotation, turn
from trochoid.kinematics.types import Array, BoolArray, frozen

HELD = 1e4  # E R³: what is held rigidly is so much stiffer than teeth, which have a tenth of E R³ at the most


@dataclass(frozen=True, eq=False, slots=True)
class Series:
    """Contacts at crank angles (n,), rad, over a pitch under the output's `torque` (N·m); vectors in the crank's frame.

    `force`, `pressure` (n, pins, slices) N, Pa at distances `places` (slices,) m from O; `point`, `normal` (n, pins, 3)
    of the contacts, the normal out of the lobed member; `edge` (n, pins) where a pressure at an edge has no bound.
    `motion` (n, 3) rotation of the satellite, rad; `mesh` (n, 3, 3) stiffness of the teeth, N·m/rad, `held` (3, 3)
    that of what holds the satellite's axis.  The joint O puts the moment −`torque`·`out` (3,) on the satellite, which
    turns the output by its rotation along `out`.  `on_satellite` is +1 where pins are on it: the sign of n F on it.
    `residual` (n,) is the worst overlap over the largest approach.
    """

    crank: Array
    torque: float
    axis: Array
    places: Array
    force: Array
    pressure: Array
    point: Array
    normal: Array
    edge: BoolArray
    motion: Array
    mesh: Array
    held: Array
    out: Array
    on_satellite: int
    residual: Array

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
    design: Design, level: Level, torque: float, crank: Array, tilt_stiffness: float | None = None
) -> Series:
    """Solve the positions; `tilt_stiffness` (N·m/rad) of the satellite's axis about O, None: held rigidly.

    A torque below 0 drives the output on.  Raises NotConverged.
    """
    (tooth, _), rim = toothed(design), level.rim
    compliance = rim.compliance
    turned = to_flank(tooth, crank)
    n, out = design.nutation.axis, output_unit(design)
    stiff = _rigid(design) if tilt_stiffness is None else tilt_stiffness
    held = stiff * (np.eye(3) - np.outer(n, n))
    moves = _moves(tooth, turned)
    sign = -1 if tooth.pins_on == "ring" else 1  # of the force along the contact's normal on the satellite
    load = turn(turned, sign * torque * out)
    slices = compliance.slices
    pair = roller_pair(
        tooth,
        crank,
        slices,
        rim.shape.start,
        clearance=play(design),
        relief=crown(slices, crowning(design)),
        edges=rim.shape.edges,
    )
    springs = stiff * np.diag([1.0, 1.0, 0.0])  # in the satellite's frame, or a frame with its axis
    assembly = ConeAssembly(compliance, pair, springs, turn(np.swapaxes(moves, 1, 2), load), level.roller)
    found = [solve_cone(assembly)] if tooth.pins_on == "ring" else _one_by_one(assembly, moves)
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
        edge=np.concatenate([_edges(each, short) for each in found]),
        motion=-sign * turn(to_arm, joined("motion")) if torque else np.zeros((len(crank), 3)),
        mesh=mesh,
        held=held,
        out=out,
        on_satellite=sign,
        residual=joined("residual"),
    )


def _rigid(design: Design) -> float:
    """Return the stiffness (N·m/rad) that stands for a rigid hold."""
    young = design.scene.materials[design.scene.drive.material].youngs_modulus
    return HELD * young * design.tooth_radius**3


def _moves(tooth: SphereTooth, turned: Array) -> Array:
    """Return the rotations (n, 3, 3) of the lobed member to be solved for, the last about the satellite's axis."""
    if tooth.pins_on == "ring":  # that axis stands still in the satellite's own frame
        return np.broadcast_to(np.eye(3), turned.shape)
    return np.asarray(turned @ rotation(1, tooth.nutation))


def _one_by_one(assembly: ConeAssembly, moves: Array) -> list[ConeContact]:
    """Solve positions whose motions differ."""
    found = []
    for i, move in enumerate(moves):
        rows = np.array([i])
        pair = replace(assembly.pair.rows(rows), moves=np.concatenate([move, np.zeros((3, 3))]))
        one = replace(assembly, pair=pair, load=assembly.load[rows])
        try:
            found.append(solve_cone(one))
        except NotConverged as fault:
            raise NotConverged(str(fault), i) from fault
    return found


def _edges(found: ConeContact, short: bool) -> BoolArray:
    """Say where an edge presses: ends of rollers that are shorter than the flank, edges of cut crests."""
    cut = found.state.off & (found.total > 0.0)
    return np.asarray(found.edge() if short else cut)

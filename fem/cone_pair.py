"""Conical rollers on the flank of a rim: gaps, arms and curvatures at a displaced pose, from the exact curves.

The rim turns by δ and moves by d against the rollers' member; both in the rim's frame.  Rotations about O keep the
contact conical: gaps come from the exact nearest point of the flank to each displaced roller axis, to rounding of the
displacement.  Translations close the gap by n·d, to first order, alike along the roller.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.cone_slices import Slices
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.sphere_tooth_gap import gap_of
from trochoid.kinematics.spherical import angle_between, turn, unit
from trochoid.kinematics.types import Array, BoolArray, IntArray

RIGID = np.eye(6)  # rotations x, y, z about O, then translations x, y, z
ROTATIONS = RIGID[:, :3]


@dataclass(frozen=True, eq=False, slots=True)
class ConeState:
    """Contacts of n positions with C rollers.

    `off` (n, C): the roller stands beyond the edge of a cut crest, and touches the edge if anything.
    `gap` (n, C, s) in m, `arms` (n, C, s, k) closing per unit motion, `place` (n, C) arc length from the start of
    tooth 0 and `parameter` (n, C) on the flank, `point` and `normal` (n, C, 3) on the unit sphere, `bend` (n, C) the
    relative curvature in 1/rad: a radius is ρ/bend.
    """

    gap: Array
    arms: Array
    place: Array
    parameter: Array
    point: Array
    normal: Array
    bend: Array
    off: BoolArray


@dataclass(frozen=True, eq=False, slots=True)
class RollerPair:
    """Rollers against a flank at crank angles (n,), rad.

    `rollers` (C,) are numbers of pins; `moves` (6, k) turns motions into rotation and translation of the rim.
    `clearance` (rad) by which rollers are thinner than the flank was cut for; `relief` (C, s), m, further gaps from
    crowning, misalignment and ground flanks.  `start` is the flank parameter where tooth 0 begins, `edges` those
    between which a crest is cut away.  `lean` (rad) tilts the rollers' axes about the middle of their reach: their
    outer ends move away from the axis of the member that carries them, and round it, to first order.
    """

    tooth: SphereTooth
    crank: Array
    rollers: IntArray
    slices: Slices
    moves: Array
    start: float
    clearance: float
    relief: Array
    arc: ArcLength
    edges: tuple[float, float] | None = None
    lean: tuple[float, float] = (0.0, 0.0)

    def rows(self, rows: IntArray) -> RollerPair:
        """Return the pair at some positions."""
        return replace(self, crank=self.crank[rows])

    def at(self, motion: Array) -> ConeState:
        """Return the contacts after motions (n, k)."""
        step = motion @ self.moves.T
        nominal = self.tooth.contact_parameter(self.rollers, self.crank[:, None])
        before = self.tooth.center_path(nominal)
        moved = turn(_turning(-step[:, :3])[:, None], before)
        parameter, opening = gap_of(self.tooth, nominal, moved)
        parameter, off = self._kept(parameter)
        point, normal = self.tooth.point(parameter), self.tooth.normal(parameter)
        if off.any():  # the nearest point is the edge, and what it presses points at the axis
            axis = before + moved
            away = axis - np.sum(axis * point, axis=-1, keepdims=True) * point
            normal = np.where(off[..., None], unit(away), normal)
            opening = np.where(off, angle_between(axis, point) - self.tooth.pin_angle, opening)
        rho = self.slices.middle
        open_angle = opening + self.clearance
        shift = np.sum(normal * step[:, None, 3:], axis=-1)
        gap = rho * open_angle[..., None] - shift[..., None] + self.relief
        if any(self.lean):
            gap = gap + self._leaning(before, normal)[..., None] * (
                rho - 0.5 * (self.slices.inner[0] + self.slices.outer[-1])
            )
        lever = rho[:, None] * np.cross(point, normal)[..., None, :]
        both = np.concatenate([lever, np.broadcast_to(normal[..., None, :], lever.shape)], axis=-1)
        bend = self.tooth.curvature(parameter) + 1.0 / np.tan(self.tooth.pin_angle - self.clearance)
        first = float(self.arc.length(self.start))
        place = self.arc.length(parameter) - first
        return ConeState(gap, both @ self.moves, place, parameter, point, normal, bend, off)

    def _leaning(self, axis: Array, normal: Array) -> Array:
        """Return how much (n, C), rad, the gaps open along the rollers."""
        carrier = self.tooth.carrier_axis(self.crank)[:, None]
        round_ = unit(np.cross(carrier, axis))
        away = np.cross(round_, axis)
        tilted, skew = self.lean
        return np.asarray(np.sum((tilted * away + skew * round_) * normal, axis=-1))

    def _kept(self, parameter: Array) -> tuple[Array, BoolArray]:
        """Return parameters drawn back from cut crests to their edges, and where that was done."""
        if self.edges is None:
            return parameter, np.zeros(parameter.shape, dtype=bool)
        pitch = 2.0 * np.pi / self.tooth.lobes
        turn = np.floor((parameter - 0.5 * (sum(self.edges) - pitch)) / pitch) * pitch
        low, high = (turn + edge for edge in self.edges)
        off = (parameter > low) & (parameter < high)
        edge = np.where(parameter < 0.5 * (low + high), low, high)
        return np.where(off, edge, parameter), off


def roller_pair(
    tooth: SphereTooth,
    crank: Array,
    slices: Slices,
    start: float,
    rollers: IntArray | None = None,
    moves: Array = ROTATIONS,
    clearance: float = 0.0,
    relief: Array | float = 0.0,
    edges: tuple[float, float] | None = None,
    lean: tuple[float, float] = (0.0, 0.0),
) -> RollerPair:
    """Return all rollers (or those numbered) at crank angles (n,); `start` and `edges` are those of the rim's shape."""
    number = np.arange(tooth.pins) if rollers is None else np.asarray(rollers)
    given = np.broadcast_to(np.asarray(relief, dtype=np.float64), (len(number), len(slices.middle)))
    return RollerPair(
        tooth,
        np.atleast_1d(crank),
        number,
        slices,
        moves,
        start,
        clearance,
        given,
        ArcLength(tooth),
        edges,
        lean,
    )


def crown(slices: Slices, depth: float, reach: tuple[float, float] | None = None) -> Array:
    """Return the gap (s,) in m of a roller crowned along a parabola: `depth` (m) at both ends of its `reach`."""
    low, high = (float(slices.inner[0]), float(slices.outer[-1])) if reach is None else reach
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    # mean of the parabola over each slice
    return np.asarray(depth * ((slices.middle - middle) ** 2 + slices.length**2 / 12.0) / half**2)


def tilt(slices: Slices, angle: Array) -> Array:
    """Return the gaps (C, s) in m of rollers tilted by `angle` (C,), rad, about their middle: open at the outer end."""
    middle = 0.5 * (slices.inner[0] + slices.outer[-1])
    return np.asarray(np.multiply.outer(np.asarray(angle, dtype=np.float64), slices.middle - middle))


def _turning(vector: Array) -> Array:
    """Return rotations less the identity (n, 3, 3) about vectors (n, 3), rad (Rodrigues)."""
    angle = np.linalg.norm(vector, axis=-1)[:, None, None]
    x, y, z = vector.T
    o = np.zeros_like(x)
    cross = np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], -2)
    first = np.sinc(angle / np.pi)
    second = 0.5 * np.sinc(angle / (2.0 * np.pi)) ** 2
    return np.asarray(first * cross + second * (cross @ cross))

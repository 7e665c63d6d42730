"""Closed curves made of straight lines and circular arcs, with corners: blocks, plates, half discs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, slots=True)
class Piece:
    """A line or arc from `start` to `end` (m) that turns left by `turn` rad (0: a line, negative: right)."""

    start: tuple[float, float]
    end: tuple[float, float]
    turn: float = 0.0


@dataclass(frozen=True)
class Path:
    """Counter-clockwise closed Curve; piece i runs over t = i … i+1, a corner belongs to the next piece.

    With `hole=True` the material is outside.
    """

    pieces: tuple[Piece, ...]
    hole: bool = False

    def __post_init__(self) -> None:
        """Refuse a path that is not closed or has a piece without length."""
        size = float(np.ptp([p.start for p in self.pieces], axis=0).max())
        for i, piece in enumerate(self.pieces):
            following = self.pieces[(i + 1) % len(self.pieces)]
            if math.dist(piece.end, following.start) > 1e-12 * size:
                raise Infeasible(
                    f"piece {i} ends at {piece.end} m, the next begins at {following.start} m; join them"
                )
            if piece.start == piece.end or abs(piece.turn) >= 2.0 * math.pi:
                raise Infeasible(
                    f"piece {i} has no length or turns by {piece.turn} rad; less than a full turn is allowed"
                )

    @property
    def period(self) -> float:
        """Number of pieces."""
        return float(len(self.pieces))

    @property
    def corners(self) -> Array:
        """Parameters of the joints between pieces."""
        return np.arange(len(self.pieces), dtype=np.float64)

    def _local(self, t: npt.ArrayLike) -> tuple[IntArray, Array]:
        t = np.mod(np.asarray(t, dtype=np.float64), self.period)
        index = np.minimum(np.floor(t), self.period - 1.0).astype(np.intp)
        return index, t - index

    def _columns(self, index: IntArray) -> tuple[Array, Array, Array]:
        start = np.array([p.start for p in self.pieces])
        chord = np.array([p.end for p in self.pieces]) - start
        turn = np.array([p.turn for p in self.pieces])
        return start[index], chord[index], turn[index]

    def point(self, t: npt.ArrayLike) -> Array:
        """Position, m: from the start a chord |c| sin(u β/2)/sin(β/2), turned by (u − 1) β/2 from c."""
        index, u = self._local(t)
        start, chord, turn = self._columns(index)
        return (
            start
            + _turned(chord, 0.5 * (u - 1.0) * turn)
            * (u * _sinc(0.5 * u * turn) / _sinc(0.5 * turn))[..., None]
        )

    def tangent(self, t: npt.ArrayLike) -> Array:
        """Unit tangent."""
        index, u = self._local(t)
        _, chord, turn = self._columns(index)
        return _turned(chord / np.linalg.norm(chord, axis=-1, keepdims=True), (u - 0.5) * turn)

    def normal(self, t: npt.ArrayLike) -> Array:
        """Unit normal out of the material."""
        tangent = self.tangent(t)
        side = -1.0 if self.hole else 1.0
        return side * np.stack((tangent[..., 1], -tangent[..., 0]), axis=-1)

    def speed(self, t: npt.ArrayLike) -> Array:
        """|dr/dt| = length of the piece, m."""
        index, _ = self._local(t)
        _, chord, turn = self._columns(index)
        speed: Array = np.linalg.norm(chord, axis=-1) / _sinc(0.5 * turn)
        return speed

    def curvature(self, t: npt.ArrayLike) -> Array:
        """Turn over length, 1/m, positive where the material is convex."""
        index, _ = self._local(t)
        _, _, turn = self._columns(index)
        curvature: Array = (-1.0 if self.hole else 1.0) * turn / self.speed(t)
        return curvature


def polygon(vertices: npt.ArrayLike, hole: bool = False) -> Path:
    """Path of straight lines through `vertices` (n, 2), m, counter-clockwise."""
    corners = [(float(x), float(y)) for x, y in np.asarray(vertices, dtype=np.float64)]
    joints = zip(corners, corners[1:] + corners[:1], strict=True)
    return Path(tuple(Piece(start, end) for start, end in joints), hole)


def _sinc(x: Array) -> Array:
    """Return sin x / x."""
    sinc: Array = np.sinc(x / math.pi)
    return sinc


def _turned(vectors: Array, angle: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack((c * x - s * y, s * x + c * y), axis=-1)

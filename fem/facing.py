"""Facets of one body before a circle fixed to another: gaps from the true curves at displaced poses.

The gap of a facet is the mean distance of its points from the circle. Members that are pressed overlap where the
deformation is; a distance taken from there sees circles that are smaller or larger by the overlap. So the
circle is first drawn back until it touches the middle facet; how far is added again, along each facet's normal,
which is where displacements are measured.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Frame:
    """A member at its nominal pose: `center` (2,) in m, `angle` in rad; `moves` (3, k) turns motions into x, y,
    rotation of its centre.
    """

    center: Array
    angle: float
    moves: Array

    def displaced(self, motion: Array) -> tuple[Array, float]:
        """Return centre and angle after the motion (k,)."""
        step = self.moves @ motion
        return self.center + step[:2], self.angle + float(step[2])

    def local(self, points: Array, motion: Array) -> Array:
        """Return points (..., 2) of the fixed frame in the displaced member's own."""
        center, angle = self.displaced(motion)
        return (points - center) @ turned(angle)

    def place(self, points: Array, motion: Array) -> Array:
        """Return points (..., 2) of the displaced member in the fixed frame."""
        center, angle = self.displaced(motion)
        return center + points @ turned(angle).T


@dataclass(frozen=True, slots=True)
class Facing:
    """m facets of a body before a circle of `radius` about `center` (2,) of the partner; `play` opens all gaps.

    Each facet has q points (m, q, 2) of its true curve, their outward normals (m, q, 2) and their weights (m, q) in a
    mean. Points and normals are in the members' own frames.
    """

    body: Frame
    points: Array
    normals: Array
    weights: Array
    partner: Frame
    center: Array
    radius: float
    play: float = 0.0

    @property
    def size(self) -> float:
        """The largest length in m that a gap is the difference of."""
        return max(float(np.abs(self.points).max()), float(np.abs(self.center).max()), self.radius)

    def gap(self, motion: Array) -> tuple[Array, Array]:
        """Return gaps (m,) in m and arms (m, k), how fast they close per unit motion."""
        way = self._way(motion)
        closing = -np.einsum("mqc,mqck->mqk", way.apart / way.distance[..., None], way.moves)
        gap = (self.weights * (way.distance - self.radius + way.opening)).sum(axis=1) + self.play
        return gap, np.einsum("mq,mqk->mk", self.weights, closing)

    def resultant(self, motion: Array, force: Array) -> tuple[Array, Array]:
        """Return the sum (2,) in N of forces (m,) of the body on its partner, and the middle (2,) of their places."""
        way = self._way(motion)
        share = force[:, None] * self.weights
        push = -np.einsum("mq,mqc->c", share, way.apart / way.distance[..., None])
        even = share if force.any() else self.weights
        return push, np.einsum("mq,mqc->c", even, way.point) / even.sum()

    def turning(self, motion: Array, force: Array) -> Array:
        """Return the stiffness (k, k) that forces (m,) give the motions because their arms turn with them."""
        way = self._way(motion)
        toward = way.apart / way.distance[..., None]
        share = force[:, None] * self.weights
        slide = way.moves - toward[..., None] * np.einsum("mqc,mqck->mqk", toward, way.moves)[..., None, :]
        bend = np.einsum("mq,mqck,mqcl->kl", share / way.distance, slide, slide)
        for frame, reach, sign in ((self.body, way.reach, -1.0), (self.partner, way.hub, 1.0)):
            spin = frame.moves[2]
            bend += sign * float((share * (toward * reach).sum(axis=-1)).sum()) * np.outer(spin, spin)
        return np.asarray(-bend)

    def _way(self, motion: Array) -> _Way:
        point, hub = self.body.place(self.points, motion), self.partner.place(self.center, motion)
        reach, lever = point - self.body.displaced(motion)[0], hub - self.partner.displaced(motion)[0]
        moves = _rate(self.body, reach) - _rate(self.partner, lever)
        middle = len(point) // 2
        first = self.weights[middle] @ point[middle] - hub
        back = first - self.radius * first / np.linalg.norm(first)
        opening = -(self.normals @ turned(self.body.displaced(motion)[1]).T) @ back
        apart = point - hub - back
        return _Way(point, apart, np.linalg.norm(apart, axis=-1), opening, moves, reach, lever)


@dataclass(frozen=True, slots=True)
class _Way:
    """From the centre of the circle, drawn back by `opening` (m, q) along normals, to a `point` (m, q, 2): `apart`
    (m, q, 2), its length, and its rate `moves` (m, q, 2, k).

    `reach` (m, q, 2) of the points and `hub` (2,) of the circle count from their members' centres.
    """

    point: Array
    apart: Array
    distance: Array
    opening: Array
    moves: Array
    reach: Array
    hub: Array


def turned(angle: float) -> Array:
    """Return the plane rotation matrix."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


def _rate(frame: Frame, reach: Array) -> Array:
    """Return how points at `reach` (..., 2) from the member's centre move (..., 2, k) per unit motion."""
    across = np.stack([-reach[..., 1], reach[..., 0]], axis=-1)
    return np.asarray(frame.moves[:2] + across[..., None] * frame.moves[2])

"""What all rolling bearings have in common: the motion of the inner ring, the state of a bearing, its notes.

The outer ring stands still, the inner one is moved by `(x, y, z, tilt_x, tilt_y)`: metres, and radians about the
x and y axes through the bearing centre, right-handed; z is the bearing axis.  Tilts are small.  A load is what
the inner ring passes to the outer one, `(F_x, F_y, F_z, M_x, M_y)`: the gradient of the elastic energy, so the
stiffness, its exact derivative, is symmetric and, as the energy is convex, positive semi-definite.  Rings are
rigid; friction, cage, ribs and the moment about the axis are not in the models.  Every array may have leading
axes: many displacements of one bearing at once.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Protocol

import numpy as np

from trochoid.kinematics.types import Array, BoolArray, frozen

MOTIONS = ("x", "y", "z", "tilt_x", "tilt_y")


@dataclass(frozen=True, slots=True)
class RollingState:
    """Rolling bearing at displacements (…, 5) of its inner ring; angles in rad, loads in N, N·m.

    `angles` (n,): where the elements are; `inner_loads` and `outer_loads` (…, n): their normal forces on the
    two raceways, which differ by centrifugal force only; `inner_angles` and `outer_angles` (…, n): contact
    angles, zero where nothing touches; `slice_loads` (…, n, s): the inner loads by slice along the element
    (balls: one); `load` (…, 5) from the inner to the outer ring; `stiffness` (…, 5, 5) in N/m, N and N·m/rad;
    `energy` (…) in J.
    """

    displacement: Array
    angles: Array
    inner_loads: Array
    outer_loads: Array
    inner_angles: Array
    outer_angles: Array
    slice_loads: Array
    load: Array
    stiffness: Array
    energy: Array

    def at(self, index: int) -> RollingState:
        """Return one of many states side by side."""
        whole = {f.name: getattr(self, f.name) for f in fields(self)}
        return RollingState(**{k: v if k == "angles" else frozen(v[index]) for k, v in whole.items()})

    @property
    def touching(self) -> Array:
        """Number of elements that pass load from the inner to the outer ring (…,)."""
        return np.asarray((self.inner_loads > 0.0).sum(axis=-1), dtype=np.float64)

    @property
    def note(self) -> str:
        """Say in words what a reader of the stiffness must know, or nothing."""
        if (self.touching == 0).any():
            return "no element carries: the bearing is open and its stiffness is zero"
        if (self.touching == 1).any():
            return "a single element carries: there is no stiffness across its line of action"
        return ""


class Rolling(Protocol):
    """A rolling bearing: its law, and the sizes that a solver scales with."""

    @property
    def lever(self) -> float:
        """Length in m that turns a tilt into a displacement of a rolling element."""
        ...

    @property
    def play(self) -> float:
        """Displacement in m within which the bearing may be open."""
        ...

    @property
    def bend(self) -> float:
        """Length in m over which a displacement across a contact turns it, 0 where contacts do not turn."""
        ...

    def deflection(self, force: float) -> float:
        """Return the size of the displacement in m that a force in N causes beyond the play."""
        ...

    def respond(self, displacement: Array, turn: float) -> RollingState:
        """Return the state at displacements (…, 5), with element 0 at the angle `turn`."""
        ...

    def overreached(self, state: RollingState) -> BoolArray:
        """Return where (…,) the state lies outside of what the law describes."""
        ...

    def refusal(self, load: Array, free: BoolArray) -> str:
        """Say why no displacement passes the components `free` (5,) of a load (5,), or nothing."""
        ...


def load_distribution(bearing: Rolling, displacement: Array, turn: float = 0.0) -> RollingState:
    """Return loads, contact angles and stiffness at displacements (…, 5) of the inner ring."""
    return bearing.respond(np.asarray(displacement, dtype=np.float64), turn)


def stiffness(bearing: Rolling, displacement: Array, turn: float = 0.0) -> Array:
    """Return the exact Jacobian ∂load/∂displacement (…, 5, 5)."""
    return load_distribution(bearing, displacement, turn).stiffness


def about(matrix: Array, height: float) -> Array:
    """Return a stiffness (…, 5, 5) for displacements of a point of the inner ring `height` m up the axis.

    The loads are moved with it; their turning of arms, second order in the displacements, is left out.
    """
    move = np.eye(5)
    move[0, 4], move[1, 3] = -height, height
    return frozen(move.T @ matrix @ move)


def element_angles(elements: int, turn: float) -> Array:
    """Return the angles (n,) of evenly spaced elements."""
    return turn + 2.0 * np.pi * np.arange(elements) / elements


def meridian(angles: Array, radius: float | Array, height: float | Array = 0.0) -> Array:
    """Return (n, …, 2, 5): radial and axial motion of ring points per displacement of the inner ring.

    The points lie at `radius` and `height` in the meridian planes at `angles` (n,).
    """
    radius, height = np.broadcast_arrays(np.asarray(radius, float), np.asarray(height, float))
    angle = angles.reshape(-1, *([1] * radius.ndim))
    c, s = np.broadcast_arrays(np.cos(angle), np.sin(angle) + 0.0 * radius)
    zero, one = np.zeros_like(s), np.ones_like(s)
    radial = np.stack([c + zero, s, zero, -s * height, c * height], axis=-1)
    axial = np.stack([zero, zero, one, s * radius, -c * radius], axis=-1)
    return np.stack([radial, axial], axis=-2)


def symmetric(matrix: Array) -> Array:
    """Return the symmetric part of matrices (…, k, k) that are symmetric up to rounding."""
    half: Array = 0.5 * (matrix + np.swapaxes(matrix, -1, -2))
    return half

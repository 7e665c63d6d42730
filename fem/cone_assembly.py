"""Rim, rollers, springs and loads, and what contact makes of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_pair import ConeState, RollerPair
from trochoid.fem.cone_table import RimCompliance
from trochoid.kinematics.types import Array, BoolArray


@dataclass(frozen=True, eq=False, slots=True)
class Roller:
    """The roller's side of each contact: `kernel` 2/(πE') in 1/Pa, 0 for a rigid one.

    `own` (s, s) in m/N is its S when it is a body of its own (see `cone_roller`), with `ends` (m) and `blunt` (s,) as
    in `Side`; otherwise half a solid cylinder pressed on its far side as well (Johnson, Contact Mechanics, 5.57):
    (2/(πE'))(ln(4r/b) − ½) per unit line load, r the roller's radius.  `seat` (m/N) is what its pin, and the body that
    carries the pin, give way by under the roller's whole force, each for itself and without tilting.
    """

    kernel: float = 0.0
    poissons_ratio: float = 0.3
    own: Array | None = None
    ends: tuple[float, float] = (0.0, 0.0)
    blunt: Array | None = None
    seat: float = 0.0


RIGID_ROLLER = Roller()


@dataclass(frozen=True, eq=False, slots=True)
class ConeAssembly:
    """Rim, rollers, springs (k, k) in N·m/rad (N/m) and loads (n, k) in N·m (N) on the rim's motions."""

    rim: RimCompliance
    pair: RollerPair
    springs: Array
    load: Array
    roller: Roller = RIGID_ROLLER


@dataclass(frozen=True, eq=False, slots=True)
class ConeContact:
    """Solved positions.

    `force` (n, C, s) in N on slices, `pressure` (n, C, s) the largest of each in Pa, `half_width` (n, C, s) in m,
    `motion` (n, k), `stiffness` (n, k, k) its tangent, `state` the geometry there, `steps` taken, `residual` (n,) the
    worst overlap, or opening of pressed slices, over the largest approach.

    The stiffness is the symmetric part of the slope of load over motion, arms that turn and contacts that move along
    the flank included.  (Forces act along the normal at the middle of each contact; what that leaves, 5e-4 of the
    stiffness in the tests' cases, is skew.)
    """

    force: Array
    pressure: Array
    half_width: Array
    motion: Array
    stiffness: Array
    state: ConeState
    steps: int
    residual: Array

    @property
    def total(self) -> Array:
        """Force (n, C) of each contact, N."""
        return np.asarray(self.force.sum(axis=-1))

    def edge(self) -> BoolArray:
        """Say where (n, C) the true pressure at an edge has no bound, and the one given is too low.

        So it is where an end of a roller presses (a crowned one does not), and at the pressed edge of a cut crest.
        """
        ends = (self.force[..., 0] > 0.0) | (self.force[..., -1] > 0.0)
        return np.asarray(ends | (self.state.off & (self.total > 0.0)))

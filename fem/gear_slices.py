"""Load over the face width: slices of the plane model, for misaligned and crowned flanks.

Each slice is a plane gear pair of its own, with its own bending, its own contact and its own gap. What couples them
is the rigid rotation of both gears only: the hub is stiff, and teeth and rim do not pass load from slice to slice by
shear. Real teeth do, over about a tooth's height; so the model gives too much to the end that touches first, and no
overhang at unloaded ends. Plane strain suits faces that are wider than teeth are high.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.gear_path import Mating, path_assembly
from trochoid.fem.position import solve_positions
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, slots=True)
class Lead:
    """How the gap between flanks changes over the common face width: `misalignment` from one end to the other, and
    `crown` at both ends beside the middle, in m; `slices` of equal width.
    """

    misalignment: float = 0.0
    crown: float = 0.0
    slices: int = 15

    def __post_init__(self) -> None:
        """Refuse what is no division."""
        if self.slices < 1:
            raise Infeasible(f"{self.slices} slices of the face width: at least 1 is needed, 15 are usual")

    @property
    def place(self) -> Array:
        """Middles of the slices in face widths from the middle, −½ … ½."""
        return np.asarray((np.arange(self.slices) + 0.5) / self.slices - 0.5)

    @property
    def gap(self) -> Array:
        """Gaps (slices,) in m beside the slice that touches first."""
        gap = self.misalignment * self.place + self.crown * (2.0 * self.place) ** 2
        return np.asarray(gap - gap.min())


@dataclass(frozen=True, slots=True)
class FaceLoad:
    """Load over the face width at n positions.

    `line_load` (n, c, slices) in N/m of c tooth contacts, `pressure` likewise in Pa, `error` (n,) of transmission in m
    on the line of action, beside the slice that touches first; `stiffness` (n,) its tangent in N/m.
    """

    line_load: Array
    pressure: Array
    error: Array
    stiffness: Array

    @property
    def factor(self) -> Array:
        """Largest over mean load of a slice (n,), all teeth together: K_Hβ."""
        slices = self.line_load.sum(axis=1)
        return np.asarray(slices.max(axis=1) / slices.mean(axis=1))


def solve_face(mating: Mating, angle: Array, lead: Lead) -> FaceLoad:
    """Solve all slices together at angles (n,) of the first gear. Raises NotConverged, Infeasible."""
    contact = solve_positions(path_assembly(mating, angle, lead.gap))
    touches = [contact.touches[f"mesh{i}"] for i in range(lead.slices)]
    width = min(w.width for w in mating.wheels) / lead.slices
    radius = mating.wheels[1].flank.base_radius
    return FaceLoad(
        frozen(np.stack([t.force for t in touches], axis=-1) / width),
        frozen(np.stack([t.peak for t in touches], axis=-1) / width),
        frozen(mating.sense * contact.motion[:, 0] * radius),
        frozen(contact.stiffness[:, 0, 0] / radius**2),
    )

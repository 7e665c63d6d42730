"""The shape of a rim of sphere teeth on its hub, with whole crests or cut ones."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.types import BoolArray


@dataclass(frozen=True, slots=True)
class RimShape:
    """A rim of sphere teeth on a hub: the body between the flank and the cone at the polar angle `hub` (rad).

    The hub lies on the material's side: nearer to the pole than the flank, or farther where the flank is a hole.
    `tip` is the polar angle at which the teeth are cut, None for whole crests.
    """

    tooth: SphereTooth
    hub: float
    tip: float | None = None

    def __post_init__(self) -> None:
        """Refuse a hub that cuts the tooth spaces."""
        low, high = self.reach
        if self.tooth.hole and not high < self.hub < math.pi:
            raise Infeasible(
                f"hub at polar angle {math.degrees(self.hub):.6g}°: outside a rim that reaches to "
                f"{math.degrees(high):.6g}° it must be more than that"
            )
        if not self.tooth.hole and not 0.0 < self.hub < low:
            raise Infeasible(
                f"hub at polar angle {math.degrees(self.hub):.6g}°: the tooth spaces reach down to "
                f"{math.degrees(low):.6g}°; take less than that, and more than 0°"
            )

        if self.tip is not None and not low < self.tip < high:
            raise Infeasible(
                f"teeth cut at polar angle {math.degrees(self.tip):.6g}°: the flank reaches from "
                f"{math.degrees(low):.6g}° to {math.degrees(high):.6g}°; cut between these, or not at all"
            )

    @property
    def edges(self) -> tuple[float, float] | None:
        """Flank parameters between which the crest of tooth 0 is cut away."""
        if self.tip is None:
            return None
        low, high = self.start, self.start + 0.5 * self.pitch
        rising = not self.tooth.hole
        for _ in range(60):
            middle = 0.5 * (low + high)
            polar = float(np.arccos(self.tooth.point(np.array(middle))[2]))
            low, high = (middle, high) if (polar < self.tip) == rising else (low, middle)
        return low, 2.0 * self.start + self.pitch - low

    @property
    def reach(self) -> tuple[float, float]:
        """Least and largest polar angle (rad) of the flank."""
        ends = np.arccos(self.tooth.point(np.array([0.0, math.pi / self.tooth.lobes]))[:, 2])
        return float(ends.min()), float(ends.max())

    @property
    def pitch(self) -> float:
        """Azimuth (rad) from tooth to tooth."""
        return 2.0 * math.pi / self.tooth.lobes

    @property
    def start(self) -> float:
        """Flank parameter of the bottom of the tooth space before tooth 0."""
        polar = np.arccos(self.tooth.point(np.array([0.0, 0.5 * self.pitch]))[:, 2])
        first_is_bottom = (polar[0] > polar[1]) == self.tooth.hole
        return 0.0 if first_is_bottom else -0.5 * self.pitch


def beyond_edge(shape: RimShape, parameter: npt.ArrayLike) -> BoolArray:
    """Say which flank parameters (…) lie on a crest that is cut away, its edges not counted."""
    p = np.asarray(parameter, dtype=np.float64)
    if shape.edges is None:
        return np.zeros(p.shape, dtype=bool)
    along = np.mod(p - shape.start, shape.pitch)
    low, high = (edge - shape.start for edge in shape.edges)
    rounding = 1e-9 * shape.pitch
    return np.asarray((along > low + rounding) & (along < high - rounding))

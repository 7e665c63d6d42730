"""A drive as contacts see it, at many positions side by side, and what is found there.

Arrays have the positions as first axis, written (n, …); those of a single position have none.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from trochoid.fem.coupling import ElasticBody, Seated
from trochoid.fem.edge_law import EdgeLine
from trochoid.fem.laws import HertzLine, Law
from trochoid.fem.pair import Pair, State
from trochoid.kinematics.types import Array, IntArray


@dataclass(frozen=True, slots=True)
class Family:
    """Contacts of one kind.

    `kernel` (c,) is the sum of 2/(πE') of both sides over the face width, `round_side` (c,) the smooth part
    in m/N of a side in closed form (a pin); `law` None means Hertz line contact with the pair's radius, which
    *strips* can resolve; with another law Hertz gives the pressure only.
    """

    name: str
    pair: Pair
    kernel: Array
    round_side: Array
    law: Law | None = None

    def law_at(self, state: State) -> Law:
        """Return the law, Hertz's with the radii of a state."""
        return self.law if self.law is not None else self.line_at(state)

    def line_at(self, state: State) -> HertzLine | EdgeLine:
        """Return the line contact with the radii of a state: Hertz's, cut off where a surface ends."""
        if state.edge is None:
            return HertzLine(self.kernel, state.radius)
        return EdgeLine(self.kernel, state.radius, state.edge[..., 0], state.edge[..., 1])

    def seated(self, state: State) -> Seated:
        """Return what the coupling through bodies asks of the contacts."""
        return Seated(state, self.pair.seat, self.round_side, self.pair.far_seat)


@dataclass(frozen=True, slots=True)
class Assembly:
    """A drive: families, bodies, springs (k, k) and loads (n, k) on the motions.

    `follow`: gaps and arms follow the displaced poses; the classical hand calculation keeps those of the
    nominal pose.
    """

    families: tuple[Family, ...]
    bodies: tuple[ElasticBody, ...]
    springs: Array
    load: Array
    follow: bool = True

    def rows(self, rows: IntArray) -> Assembly:
        """Return some of the positions."""
        families = tuple(replace(f, pair=f.pair.rows(rows)) for f in self.families)
        return replace(self, families=families, load=self.load[rows])


@dataclass(frozen=True, slots=True)
class Touch:
    """Result for one family: forces (n, c) in N, half widths (n, c) in m, and `peak` (n, c) in N/m, the largest
    pressure times the face width; where pressure is resolved, `offset` (n, c, m) in m along the arc and `strips`
    (n, c, m) in N, else (n, c, 0).
    """

    state: State
    force: Array
    half_width: Array
    peak: Array
    offset: Array
    strips: Array


@dataclass(frozen=True, slots=True)
class Contact:
    """Result: touches by family name, motion (n, k), tangent stiffness (n, k, k), residuals and Newton steps (n,)."""

    touches: dict[str, Touch]
    motion: Array
    stiffness: Array
    imbalance: Array
    penetration: Array
    iterations: IntArray

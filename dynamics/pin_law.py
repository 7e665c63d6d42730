"""The law N(u) of a pin in its slot as a table that can be read millions of times: cubics in √u.

Where the wall bends the law depends on where along the slot the pin is: columns of the table, linear between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

CELLS = 160
COLUMNS, POINTS = 97, 30  # places along a slot, and angles, at which a law is asked for


@dataclass(frozen=True, eq=False, slots=True)
class PinLaw:
    """N (N·m) of the angle u (rad), odd: cubics (columns, 4, cells) of x = √(u/`top`)·cells from each cell's start,
    highest power first.  `play` (rad) is how far a pin moves from the middle of its slot before it touches.

    Columns stand evenly between the angles `ends` (rad) from the wheel's axis to the pin; a single one holds anywhere.
    """

    top: float
    cubics: Array
    play: float = 0.0
    ends: tuple[float, float] = (0.0, math.pi)

    @property
    def largest(self) -> float:
        """Least N at the end of the table, N·m."""
        return float(self.cubics[:, :, -1].sum(axis=1).min())

    def stiffest(self, reach: Array) -> Array:
        """Return the largest slopes dN/du (n,) up to `largest`, N·m/rad, at angles α (n,)."""
        place = np.arange(1, CELLS + 1) / CELLS
        u = np.broadcast_to(self.top * place**2, (len(reach), CELLS)).ravel()
        at = np.repeat(reach, CELLS)
        within = self.moment(u, at) <= self.largest * (1.0 + 1e-12)
        found: Array = np.where(within, self.slope(u, at), 0.0).reshape(len(reach), CELLS).max(axis=1)
        return found

    def moment(self, pressed: Array, reach: Array | float = 0.0) -> Array:
        """Return N (n,) where the pin is pressed by u − play (n,), 0 to `top`, at angles α (n,)."""
        (a, b, c, d), x, _ = self._at(pressed, reach)
        found: Array = ((a * x + b) * x + c) * x + d
        return found

    def slope(self, pressed: Array, reach: Array | float = 0.0) -> Array:
        """Return dN/du (n,) where the pin is pressed by u − play (n,), above 0 to `top`, at angles α (n,)."""
        (a, b, c, _), x, place = self._at(pressed, reach)
        found: Array = ((3.0 * a * x + 2.0 * b) * x + c) * CELLS**2 / (2.0 * self.top * place)
        return found

    def pressed(self, moment: Array, reach: Array | float = 0.0) -> Array:
        """Return u − play (n,) at moments (n,) of 0 to `largest` and angles α (n,): bisection down to rounding."""
        low, high = np.zeros(moment.shape), np.full(moment.shape, math.sqrt(self.top))
        for _ in range(60):
            middle = 0.5 * (low + high)
            over = self.moment(middle**2, reach) > moment
            low, high = np.where(over, low, middle), np.where(over, middle, high)
        return np.asarray((0.5 * (low + high)) ** 2 * (moment > 0.0))

    def torque(self, damping: float) -> Callable[[float, float, float], float]:
        """Return the torque (N·m) on the wheel as a function of lag d (rad), its rate, and the angle α (rad).

        s = sin α: s N(s d) + β s² N' d', β = `damping` in s; a contact does not pull.  Beyond the table its last slope
        goes on.
        """
        tables = [list(zip(*column.tolist(), strict=True)) for column in self.cubics]
        scale, play, last = CELLS / math.sqrt(self.top), self.play, CELLS - 1
        square, sin, sqrt = 0.5 * scale * scale, math.sin, math.sqrt
        first, final = self.ends[0], len(tables) - 2
        per_angle = (len(tables) - 1) / (self.ends[1] - self.ends[0])

        def found(d: float, rate: float, reach: float) -> float:
            s = sin(reach)
            u = s * d
            a = (u if u > 0.0 else -u) - play
            if a <= 0.0:
                return 0.0
            place = scale * sqrt(a)
            i = int(place)
            if i > last:
                i = last
            x = place - i
            if final < 0:
                a3, a2, a1, a0 = tables[0][i]
            else:
                w = (reach - first) * per_angle
                k = int(w)
                k = 0 if k < 0 else final if k > final else k
                w -= k
                a3, a2, a1, a0 = tables[k][i]
                b3, b2, b1, b0 = tables[k + 1][i]
                a3 += w * (b3 - a3)
                a2 += w * (b2 - a2)
                a1 += w * (b1 - a1)
                a0 += w * (b0 - a0)
            value = ((a3 * x + a2) * x + a1) * x + a0
            turn = s * rate if u > 0.0 else -s * rate
            value += damping * turn * ((3.0 * a3 * x + 2.0 * a2) * x + a1) * square / place
            if value < 0.0:
                return 0.0
            pushed: float = s * value if u > 0.0 else -s * value
            return pushed

        return found

    def _at(self, pressed: Array, reach: Array | float) -> tuple[Array, Array, Array]:
        place = CELLS * np.sqrt(np.asarray(pressed, dtype=np.float64) / self.top)
        i = np.clip(place.astype(np.intp), 0, CELLS - 1)
        columns = len(self.cubics)
        if columns == 1:
            return self.cubics[0][:, i], place - i, place
        w = (np.asarray(reach) - self.ends[0]) / (self.ends[1] - self.ends[0]) * (columns - 1)
        k = np.clip(w.astype(np.intp), 0, columns - 2)
        low, high = (np.moveaxis(self.cubics[k + n, :, i], -1, 0) for n in (0, 1))
        return low + (w - k) * (high - low), place - i, place


def pin_law(moment: Callable[[Array], Array], top: float, play: float = 0.0) -> PinLaw:
    """Tabulate a law `moment`(u), which grows from N(0) = 0, up to u = `top` (rad).  Raises TrochoidError."""
    x = np.arange(CELLS + 1.0)
    return PinLaw(top, _cubics(moment(top * (x / CELLS) ** 2)[None]), play)


def slot_law(
    moment: Callable[[Array, Array], Array], top: float, ends: tuple[float, float], play: float = 0.0
) -> PinLaw:
    """Tabulate a law `moment`(u, α) of angles u (n,) up to `top` and α (n,) between `ends`.  Raises TrochoidError."""
    from scipy.interpolate import CubicSpline

    asked = (np.arange(POINTS + 1) / POINTS) ** 1.5  # √(u/top), denser where the law bends
    at, u = (x.ravel() for x in np.meshgrid(np.linspace(*ends, COLUMNS), top * asked**2, indexing="ij"))
    rows = moment(u, at).reshape(COLUMNS, -1)
    _fail_if_not_growing(rows)
    level = (1, np.zeros(COLUMNS))
    spline = CubicSpline(asked, rows, axis=1, bc_type=(level, "not-a-knot"))
    return PinLaw(top, _cubics(spline(np.arange(CELLS + 1.0) / CELLS)), play, ends)


def _cubics(values: Array) -> Array:
    """Return cubics (columns, 4, cells) through values (columns, cells + 1)."""
    from scipy.interpolate import CubicSpline

    _fail_if_not_growing(values)
    level = (1, np.zeros(len(values)))
    made = CubicSpline(np.arange(CELLS + 1.0), values, axis=1, bc_type=(level, "not-a-knot")).c
    return np.ascontiguousarray(np.moveaxis(made, 2, 0))


def _fail_if_not_growing(values: Array) -> None:
    if not (
        np.all(np.isfinite(values)) and np.all(values[:, 0] == 0.0) and np.all(np.diff(values, axis=1) > 0.0)
    ):
        raise TrochoidError("the law of a pin must be finite and grow from 0")

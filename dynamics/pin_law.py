"""The law N(u) of a pin in its slot as a table that can be read millions of times: cubics in √u."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

CELLS = 160


@dataclass(frozen=True, eq=False, slots=True)
class PinLaw:
    """N (N·m) of the angle u (rad), odd: cubics (4, cells) of x = √(u/`top`)·cells from each cell's start, highest
    power first.  `play` (rad) is how far a pin moves from the middle of its slot before it touches.
    """

    top: float
    cubics: Array
    play: float = 0.0

    @property
    def largest(self) -> float:
        """N at the end of the table, N·m."""
        return sum(self.cubics[:, -1].tolist(), 0.0)

    @property
    def stiffest(self) -> float:
        """Largest slope dN/du in the table, N·m/rad."""
        place = np.arange(1, CELLS + 1) / CELLS
        slopes: Array = self.slope(self.top * place**2)
        return float(slopes.max())

    def moment(self, pressed: Array) -> Array:
        """Return N (n,) where the pin is pressed by u − play (n,), 0 to `top`."""
        (a, b, c, d), x, _ = self._at(pressed)
        found: Array = ((a * x + b) * x + c) * x + d
        return found

    def slope(self, pressed: Array) -> Array:
        """Return dN/du (n,) where the pin is pressed by u − play (n,), above 0 to `top`."""
        (a, b, c, _), x, place = self._at(pressed)
        found: Array = ((3.0 * a * x + 2.0 * b) * x + c) * CELLS**2 / (2.0 * self.top * place)
        return found

    def pressed(self, moment: Array) -> Array:
        """Return u − play (n,) at moments (n,) of 0 to `largest`: bisection down to rounding."""
        low, high = np.zeros(moment.shape), np.full(moment.shape, math.sqrt(self.top))
        for _ in range(60):
            middle = 0.5 * (low + high)
            over = self.moment(middle**2) > moment
            low, high = np.where(over, low, middle), np.where(over, middle, high)
        return np.asarray((0.5 * (low + high)) ** 2 * (moment > 0.0))

    def torque(self, damping: float) -> Callable[[float, float, float], float]:
        """Return the torque (N·m) on the wheel as a function of lag d (rad), its rate, and the lever s.

        s N(s d) + β s² N' d', β = `damping` in s; a contact does not pull.  Beyond the table its last slope goes on.
        """
        rows = [x.tolist() for x in self.cubics]
        a3, a2, a1, a0 = rows
        scale, play, last = CELLS / math.sqrt(self.top), self.play, CELLS - 1
        square = 0.5 * scale * scale

        def found(d: float, rate: float, s: float) -> float:
            u = s * d
            a = (u if u > 0.0 else -u) - play
            if a <= 0.0:
                return 0.0
            place = scale * math.sqrt(a)
            i = int(place)
            if i > last:
                i = last
            x = place - i
            value = ((a3[i] * x + a2[i]) * x + a1[i]) * x + a0[i]
            turn = s * rate if u > 0.0 else -s * rate
            value += damping * turn * ((3.0 * a3[i] * x + 2.0 * a2[i]) * x + a1[i]) * square / place
            if value < 0.0:
                return 0.0
            pushed: float = s * value if u > 0.0 else -s * value
            return pushed

        return found

    def _at(self, pressed: Array) -> tuple[Array, Array, Array]:
        place = CELLS * np.sqrt(np.asarray(pressed, dtype=np.float64) / self.top)
        i = np.clip(place.astype(np.intp), 0, CELLS - 1)
        return self.cubics[:, i], place - i, place


def pin_law(moment: Callable[[Array], Array], top: float, play: float = 0.0) -> PinLaw:
    """Tabulate a law `moment`(u), which grows from N(0) = 0, up to u = `top` (rad).  Raises TrochoidError."""
    from scipy.interpolate import CubicSpline

    x = np.arange(CELLS + 1.0)
    values = moment(top * (x / CELLS) ** 2)
    if not (np.all(np.isfinite(values)) and values[0] == 0.0 and np.all(np.diff(values) > 0.0)):
        raise TrochoidError("the law of a pin must be finite and grow from 0")
    return PinLaw(top, np.asarray(CubicSpline(x, values, bc_type=((1, 0.0), "not-a-knot")).c), play)

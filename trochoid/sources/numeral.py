"""Numbers as they are printed: read, compared digit by digit, and written with more digits than the print has."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from decimal import ROUND_DOWN, ROUND_HALF_UP, Decimal
from fractions import Fraction

from trochoid.sources.row import Value

_ANGLE = re.compile(r"(\d+)°(\d+)′(\d+)″")
MORE = 2  # digits shown beyond the printed ones
MOST = 12  # significant digits at most: beyond them is rounding
NOISE = 1e-11  # relative


@dataclass(frozen=True, slots=True)
class Numeral:
    """A printed number: its value (arc seconds for an angle), decimals, and whether it is an angle or a fraction."""

    value: Fraction
    decimals: int
    angle: bool = False
    fraction: bool = False

    def difference(self, computed: Value) -> float:
        """Computed − printed, in the printed unit (arc seconds for angles in rad); 0 for what is rounding only."""
        found = self._found(computed)
        off = float(found - self.value)
        return 0.0 if abs(off) <= NOISE * abs(float(found)) else off

    def same_digits(self, computed: Value, cut: bool = False) -> bool:
        """Whether the computed number, rounded or cut off to the printed digits, is the printed one."""
        found = self._found(computed)
        if self.fraction:
            return found == self.value
        clean = Decimal(f"{float(found):.{MOST}g}")
        last = Decimal(1).scaleb(-self.decimals)
        return Fraction(clean.quantize(last, ROUND_DOWN if cut else ROUND_HALF_UP)) == self.value

    def text(self, computed: Value) -> str:
        """The computed number with two digits more than printed; whole numbers and fractions as they are."""
        if self.angle:
            seconds = float(self._found(computed))
            return f"{int(seconds // 3600)}°{int(seconds // 60) % 60:02d}′{seconds % 60:05.2f}″"
        if isinstance(computed, (int, Fraction)):
            return signed(str(computed))
        size = math.floor(math.log10(abs(computed))) if computed else 0
        decimals = max(0, min(self.decimals + MORE, MOST - 1 - size))
        return signed(f"{computed:.{decimals}f}")

    def _found(self, computed: Value) -> Fraction:
        exact = Fraction(computed)
        return exact * Fraction(math.degrees(1.0)) * 3600 if self.angle else exact


def numeral(printed: str) -> Numeral:
    """Read a printed number: "−0.0961", "121/120" or "28°43′40″"."""
    angle = _ANGLE.fullmatch(printed)
    if angle:
        d, m, s = (int(part) for part in angle.groups())
        return Numeral(Fraction(3600 * d + 60 * m + s), 0, angle=True)
    plain = printed.replace("−", "-")
    _, _, decimals = plain.partition(".")
    return Numeral(Fraction(plain), len(decimals), fraction="/" in plain)


def signed(text: str) -> str:
    """The text with proper minus signs; −0 is 0."""
    if not re.search(r"[1-9]", text):
        text = text.lstrip("-")
    return text.replace("-", "−")

"""Numbers, errors and units as an engineer reads them; shared by the terminal and the report."""

from __future__ import annotations

import math
import re
from typing import IO

from trochoid.results.outcome import Quantity

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_SYMBOLS = {"um": "µm", "deg": "°", "dimensionless": "", "1": "", "percent": "%"}
_PLAIN = {
    "·": "*",
    "µ": "u",
    "²": "^2",
    "³": "^3",
    "⁴": "^4",
    "°": "deg",
    "±": "+/-",
    "−": "-",
    "×10": "e",
    "\u202f": "",
}
_MINUS = "−"
_MOST_DECIMALS = 9  # of a value and its error without a power of ten
_NO_SYMBOL = r"(?<!^[A-Z])_|_(?![A-Z0-9]_)"  # an underscore that is not the one of "R_A_mean"
_ENDINGS = {" max": "largest", " min": "least", " mean": "mean"}  # of names, and what headings say


def pretty_unit(unit: str) -> str:
    """Return `unit` ("N*m/arcmin", "kg*m**2", "um") with its usual signs ("N·m/arcmin", "kg·m²", "µm")."""
    spaced = re.sub(r"(\*\*|\^)(-?\d+)", lambda m: m.group(2).translate(_SUPERSCRIPTS), unit.strip())
    return "".join(_SYMBOLS.get(word, word) for word in re.split(r"([*/ ])", spaced)).replace("*", "·")


def label(name: str) -> str:
    """Return the heading of a name: "mass" → "Mass", "stress_max" → "Largest stress"; a symbol ("R_A") stays."""
    words = spoken(name)
    for ending, word in _ENDINGS.items():
        if words.endswith(ending):
            words = words.removesuffix(ending)
            words = f"{words} {word}" if words.endswith(" ·") else f"{word} {words}"
    return words[:1].upper() + words[1:]


def spoken(name: str) -> str:
    """Return a name in words; symbols such as R_A and M_3 stay as they are, alone or at the head of a name."""
    return " · ".join(
        part if re.fullmatch(r"[A-Z]_\w{1,2}", part) else re.sub(_NO_SYMBOL, " ", part).strip()
        for part in name.split(" · ")
    )


def number(value: float | str | None, digits: int = 5) -> str:
    """Return `value` with `digits` significant digits, a proper minus, powers of ten outside 1e-4 … 1e6."""
    if value is None:
        return "none"
    if isinstance(value, (str, bool)):
        return str(value)
    if not math.isfinite(value):
        return "not finite"
    if value == int(value) and abs(value) < 10**6:
        return _signed(f"{int(value)}")
    exponent = math.floor(math.log10(abs(value)))
    if -4 <= exponent < 6:
        return _signed(_stripped(f"{value:.{max(0, digits - 1 - exponent)}f}"))
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return _signed(_power(_stripped(mantissa), int(power)))


def value_and_error(value: float | str | None, error: float | None) -> tuple[str, str]:
    """Return value and error to the same last digit, two digits of the error; "" where there is none."""
    if (
        value is None
        or isinstance(value, str)
        or error is None
        or not math.isfinite(value)
        or not math.isfinite(error)
    ):
        return number(value), ""
    if error <= 0.0:
        return number(value), ""
    size = max(abs(value), error)
    exponent = math.floor(math.log10(size))
    last = max(math.floor(math.log10(error)) - 1, exponent - 9)
    scale = exponent if not -3 <= exponent < 6 or (exponent < 0 and last < -_MOST_DECIMALS) else 0
    decimals = max(0, scale - last)
    shown, margin = f"{value / 10.0**scale:.{decimals}f}", f"{error / 10.0**scale:.{decimals}f}"
    if float(margin) == 0.0:
        return number(value, 10), ""
    if scale:
        shown, margin = _power(shown, scale), _power(margin, scale)
    return _signed(shown), margin


def sentence(quantity: Quantity) -> str:
    """Return "101.3 ± 0.4 N·m/arcmin"."""
    value, error = value_and_error(quantity.value, quantity.error)
    unit = pretty_unit(quantity.unit)
    gap = "" if unit in ("°", "%", "") else " "
    if error:
        return f"{value} ± {error}{' ' if unit else ''}{unit}"
    return f"{value}{gap}{unit}"


def plain(text: str) -> str:
    """Return `text` in ASCII, for a stream that can show no more."""
    raised = re.sub(r"×10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)", lambda m: f"e{_lowered(m.group(1))}", text)
    for sign, letters in _PLAIN.items():
        raised = raised.replace(sign, letters)
    return raised.encode("ascii", "replace").decode("ascii")


def speaks_unicode(stream: IO[str]) -> bool:
    """Return whether a stream can show more than ASCII."""
    return (getattr(stream, "encoding", None) or "utf-8").lower().replace("-", "").startswith("utf")


def _lowered(digits: str) -> str:
    return digits.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))


def _power(mantissa: str, exponent: int) -> str:
    return f"{mantissa}×10{str(exponent).translate(_SUPERSCRIPTS)}"


def _stripped(digits: str) -> str:
    return digits.rstrip("0").rstrip(".") if "." in digits else digits


def _signed(digits: str) -> str:
    return digits.replace("-", _MINUS)

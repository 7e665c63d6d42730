"""The answer about shifts: which are possible, which stay coaxial, which are best."""

from __future__ import annotations

from trochoid.drives.planetary.stages import Stages
from trochoid.geometry.blocking_contour import Contour
from trochoid.geometry.blocking_line import Choice, Line
from trochoid.results.outcome import Parts, Quantity

VALUE = {
    "contact_ratio": ("lesser_contact_ratio", 1.0, ""),
    "sliding": ("specific_sliding", 1.0, ""),
    "tips": ("thinnest_tip", 1e3, "mm"),
}


def blocking_contour(s: Stages) -> Quantity:
    """Areas of the plane contours, volume of their body, the coaxiality line with its ends, best shifts on it."""
    found, needed = s.blocking, s.feasible.sums
    parts: dict[str, Quantity | Parts] = {
        "sun_and_planet": _contour(found.outer),
        "planet_and_ring": _contour(found.inner),
        "body": Quantity(parts={"volume": _number(found.volume)}),
        "coaxial_line": _line(found.line, needed),
    }
    parts |= {name: _choice(choice) for name, choice in found.best.items()}
    return Quantity(parts=parts, note="shifts are in modules; so are areas and volume")


def _contour(contour: Contour) -> Quantity:
    """Area, with the conditions that make its boundary."""
    bounds = f"bounded by {', '.join(contour.binding)}" if contour.binding else "no shifts are possible"
    return Quantity(parts={"area": Quantity(contour.area, "", 0.0, "exact", note=bounds)})


def _line(line: Line, needed: tuple[float, float]) -> Quantity:
    parts: dict[str, Quantity | Parts] = {
        "sum_sun_and_planet": Quantity(
            line.outer, "", 0.0, "exact", note=_play("x_sun + x_planet", needed[0])
        ),
        "sum_planet_and_ring": Quantity(
            line.inner, "", 0.0, "exact", note=_play("x_ring − x_planet", needed[1])
        ),
    }
    if not line.stretches:
        return Quantity(parts=parts, note="no shifts on it fulfil all conditions")
    several = len(line.stretches) > 1
    for k, stretch in enumerate(line.stretches, 1):
        at = f"_{k}" if several else ""
        for end, x1, name in (
            ("lower", stretch.low, stretch.low_condition),
            ("upper", stretch.high, stretch.high_condition),
        ):
            parts[f"{end}_end{at}"] = {**_shifts(line.shifts(x1)), "binding": Quantity(name, model="exact")}
    return Quantity(parts=parts)


def _choice(choice: Choice) -> Quantity:
    name, factor, unit = VALUE[choice.aim]
    bound = {"binding": Quantity(choice.bound, model="exact")} if choice.bound else {}
    return Quantity(parts={**_shifts(choice.shifts), name: _number(factor * choice.value, unit), **bound})


def _shifts(shifts: tuple[float, float, float]) -> dict[str, Quantity]:
    return {f"x_{name}": _number(float(x)) for name, x in zip(("sun", "planet", "ring"), shifts, strict=True)}


def _number(value: float, unit: str = "") -> Quantity:
    return Quantity(value, unit, 0.0, "exact")


def _play(sums: str, needed: float) -> str:
    return f"{sums}; {needed:.7g} would mesh without play"

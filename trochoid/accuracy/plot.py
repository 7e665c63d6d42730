"""The picture: error against seconds on logarithmic axes, one line per rung, as SVG that needs nothing else."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise

from trochoid.accuracy import words
from trochoid.accuracy.study import Judged, Study
from trochoid.report import style
from trochoid.results import text

WIDTH, HEIGHT = 760, 512
LEFT, RIGHT, TOP, BOTTOM = 74, 108, 52, 98
FLOOR = 1e-6  # errors below are drawn there


@dataclass(frozen=True, slots=True)
class Point:
    """A step in the picture: seconds, error, its mesh level, and whether the error is only estimated."""

    seconds: float
    error: float
    level: int | None
    estimated: bool
    chosen: bool


@dataclass(frozen=True, slots=True)
class Frame:
    """The axes: decimal logarithms of their ends, and the pixels that they span."""

    x: tuple[float, float]
    y: tuple[float, float]

    def at(self, seconds: float, error: float) -> tuple[float, float]:
        """Return the pixels of a point."""
        across = (math.log10(seconds) - self.x[0]) / (self.x[1] - self.x[0])
        up = (math.log10(max(error, FLOOR)) - self.y[0]) / (self.y[1] - self.y[0])
        return LEFT + across * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - up * (HEIGHT - TOP - BOTTOM)


def svg(study: Study, quantity: str | None = None) -> str:
    """Return the picture of one quantity, or of the largest error of all."""
    lines = {rung.name: list(_points(study, rung.name, quantity)) for rung in study.rungs}
    lines = {name: points for name, points in lines.items() if points}
    check = _checked(study, quantity)
    drawn = [point for points in lines.values() for point in points]
    frame = _frame(drawn if check is None else [*drawn, check], study.tolerance)
    names = list(study.reference.errors)
    single = quantity or (names[0] if len(names) == 1 else None)
    what = text.label(single) if single else "Largest of all quantities asked for"
    title = what if quantity else f"{study.title}: what accuracy costs"
    body = [
        *_axes(frame),
        *_tolerance(frame, study.tolerance),
        *(part for mark in _marks(frame, lines) for part in mark),
        *_check_mark(frame, check),
        *_legend(study, lines),
        _text(LEFT, 22, title, size=15, weight=600),
        _text(LEFT - 8, TOP - 9, "error", anchor="end", size=13, color=style.MUTED),
        _text(LEFT, TOP - 6, "" if quantity else what[:1].lower() + what[1:], size=12, color=style.MUTED),
    ]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" '
        f'height="{HEIGHT}" font-family="{escape(style.FONT)}" role="img">\n'
        f"<title>{escape(study.title)}: {escape(what)} against seconds</title>\n"
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>\n' + "\n".join(body) + "\n</svg>\n"
    )


def _points(study: Study, rung: str, quantity: str | None) -> Iterator[Point]:
    chosen = None if study.choice is None else study.choice.judged
    for judged in study.steps:
        error = _error(judged, quantity)
        if judged.step.rung == rung and error is not None and judged.step.seconds > 0.0:
            yield Point(judged.step.seconds, error, judged.step.level, judged.estimated, judged is chosen)


def _checked(study: Study, quantity: str | None) -> Point | None:
    """Return where the independent model stands: its seconds, and how far the reference is from it."""
    if study.check is None:
        return None
    errors = {name: error.size for name, error in study.check.errors.items() if quantity in (None, name)}
    if not errors or study.check.seconds <= 0.0:
        return None
    return Point(study.check.seconds, max(errors.values()), None, False, False)


def _error(judged: Judged, quantity: str | None) -> float | None:
    if quantity is None:
        return judged.error
    return judged.errors[quantity].size if quantity in judged.errors else None


def _frame(points: Sequence[Point], tolerance: float) -> Frame:
    seconds = [point.seconds for point in points]
    errors = [max(point.error, FLOOR) for point in points] + [tolerance]
    return Frame(_ends(seconds, 0.08), _ends(errors, 0.15))


def _ends(values: Sequence[float], margin: float) -> tuple[float, float]:
    low, high = math.log10(min(values)), math.log10(max(values))
    wide = max(high - low, 1.0)
    return low - margin * wide, max(high, low + 1.0) + margin * wide


def _axes(frame: Frame) -> Iterator[str]:
    bottom, right = HEIGHT - BOTTOM, WIDTH - RIGHT
    for power, value in _ticks(frame.x):
        x, _ = frame.at(value, 1.0)
        major = value == 10.0**power
        yield _line(x, TOP, x, bottom, style.GRID, 1.0 if major else 0.5)
        if major or (_span(frame.x) < 3.2 and round(value / 10.0**power) in (2, 5)):
            yield _text(x, bottom + 18, f"{value:g}", anchor="middle")
    for power, value in _ticks(frame.y):
        _, y = frame.at(1.0, value)
        major = value == 10.0**power
        yield _line(LEFT, y, right, y, style.GRID, 1.0 if major else 0.5)
        if major:
            yield _text(LEFT - 8, y + 4, f"{100 * value:g} %", anchor="end")
    yield _line(LEFT, bottom, right, bottom, style.AXIS, 1.0)
    yield _line(LEFT, TOP, LEFT, bottom, style.AXIS, 1.0)
    yield _text((LEFT + right) / 2, bottom + 38, "seconds", anchor="middle", color=style.MUTED, size=13)


def _span(ends: tuple[float, float]) -> float:
    return ends[1] - ends[0]


def _ticks(ends: tuple[float, float]) -> Iterator[tuple[int, float]]:
    """Yield (power, value): every whole multiple of a power of ten between the ends."""
    for power in range(math.floor(ends[0]), math.ceil(ends[1])):
        for digit in range(1, 10):
            value = digit * 10.0**power
            if ends[0] <= math.log10(value) <= ends[1]:
                yield power, value


def _tolerance(frame: Frame, tolerance: float) -> Iterator[str]:
    _, y = frame.at(1.0, tolerance)
    yield _line(LEFT, y, WIDTH - RIGHT, y, style.INK, 1.2, dash="6 4")
    yield _text(WIDTH - RIGHT + 8, y - 3, "tolerance", size=12)
    yield _text(WIDTH - RIGHT + 8, y + 12, words.percent(tolerance), size=12)


def _marks(frame: Frame, lines: dict[str, list[Point]]) -> Iterator[list[str]]:
    """Yield the drawing of each rung: line, markers, mesh levels, name."""
    for index, (name, points) in enumerate(lines.items()):
        color = style.CATEGORIES[index % len(style.CATEGORIES)]
        below = index == len(lines) - 1 and len(lines) > 1
        places = [frame.at(point.seconds, point.error) for point in points]
        drawn = [
            _line(*a, *b, color, 2.2, dash="3 4" if points[i + 1].estimated else "")
            for i, (a, b) in enumerate(pairwise(places))
        ]
        for point, (x, y) in zip(points, places, strict=True):
            if point.chosen:
                drawn.append(_circle(x, y, 11, "none", style.INK, 1.6))
            drawn.append(_circle(x, y, 5, "white" if point.estimated else color, color, 2))
            if point.level is not None:
                shift = (-9, 17) if below else (9, -8)
                drawn.append(
                    _text(
                        x + shift[0],
                        y + shift[1],
                        str(point.level),
                        color=color,
                        size=12,
                        anchor="end" if below else "start",
                    )
                )
        drawn += _name(name, points, places, color, below)
        yield drawn


def _name(
    name: str, points: Sequence[Point], places: Sequence[tuple[float, float]], color: str, below: bool
) -> list[str]:
    x, y = places[-1] if below else places[0]
    if points[0].level is None:
        return [_text(x + 11, y + 4, name, color=color, weight=600, size=13)]
    if below:
        return [_text(x + 11, y + 5, name, color=color, weight=600, size=13)]
    return [_text(x - 4, y - 24, name, color=color, weight=600, size=13)]


def _legend(study: Study, lines: dict[str, list[Point]]) -> Iterator[str]:
    """Say below the axes what numbers, ring, hollow marker and diamond mean, in two columns."""
    said = [f"numbers: {study.unit}"]
    if any(point.chosen for points in lines.values() for point in points):
        said.append("ringed: what the tolerance picks")
    if any(point.estimated for points in lines.values() for point in points):
        said.append("hollow: the reference of all others; its own error is estimated")
    if study.check is not None:
        said.append("diamond: how far the reference is from it")
    for index, line in enumerate(said):
        row, column = index // 2, index % 2
        x, y = LEFT + 380 * column, HEIGHT - BOTTOM + 66 + 18 * row
        yield _text(x, y, line, size=12, color=style.MUTED)


def _check_mark(frame: Frame, check: Point | None) -> Iterator[str]:
    if check is None:
        return
    x, y = frame.at(check.seconds, check.error)
    yield f'<path d="M{x:.1f} {y - 7:.1f}l7 7l-7 7l-7 -7z" fill="{style.MUTED}"/>'
    yield _text(x, y - 27, "resolved FE,", color=style.MUTED, weight=600, size=12, anchor="middle")
    yield _text(x, y - 13, "one position", color=style.MUTED, weight=600, size=12, anchor="middle")


def _line(x1: float, y1: float, x2: float, y2: float, color: str, width: float, dash: str = "") -> str:
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" '
        f'stroke-width="{width:g}"{dashes}/>'
    )


def _circle(x: float, y: float, radius: float, fill: str, stroke: str, width: float) -> str:
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" fill="{fill}" stroke="{stroke}" '
        f'stroke-width="{width:g}"/>'
    )


def _text(
    x: float,
    y: float,
    words_: str,
    *,
    size: float = 12.5,
    color: str = style.INK,
    anchor: str = "start",
    weight: int = 400,
) -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size:g}" fill="{color}" text-anchor="{anchor}" '
        f'font-weight="{weight}" paint-order="stroke" stroke="white" stroke-width="3" stroke-linejoin="round">'
        f"{escape(words_)}</text>"
    )

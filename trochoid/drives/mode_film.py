"""Natural modes as films: members as simple rigid solids of true size, swinging over one period of the mode.

A drive names the shapes of its members and how each moves in a mode: a complex displacement and rotation about a point
of the member.  What is shown is Re(U exp(iφ)) over the phase φ, so that whirl is seen as whirl; its size is a fixed
share of the drive's, whatever the mode's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.drives import solids
from trochoid.drives.solids import Solid, revolved
from trochoid.kinematics.types import Array, ComplexArray, IntArray, frozen
from trochoid.results.film import Field, FieldFrame, Film, Later
from trochoid.results.plot import Axis

PHASE = Axis("phase", "rad")
UPWARDS = np.array([0.0, 0.0, 1.0])
FRAMES, MOST = 12, 6  # phases of a film, and modes that are shown
GLASS = 0.3  # opacity of what rests, or hides others
SHARE = 0.08  # of the drive's half size: the largest displacement
SIDES, AROUND, POINTS = 20, 36, 160  # of a cylinder, of a ring, of an outline with lobes or teeth
BYTES = 7.5e6  # of all films; fewer modes are shown where their files were larger


@dataclass(frozen=True, eq=False, slots=True)
class Part:
    """A rigid solid: `points` (n, 3) m, triangles `cells` (3, m), and the point `center` (3,) that its motion is of.

    Where others would be hidden behind it, its `opacity` is below 1.
    """

    name: str
    points: Array
    cells: IntArray
    center: Array
    opacity: float = 1.0

    def moved(self, motion: ComplexArray) -> ComplexArray:
        """Return displacements (n, 3) by displacement and rotation (6,) at the centre."""
        return np.asarray(motion[:3] + np.cross(motion[3:], self.points - self.center))


@dataclass(frozen=True, eq=False, slots=True)
class Swing:
    """A mode: its number from 1, what is said of it, and displacement and rotation (parts, 6) of all parts."""

    number: int
    words: str
    motion: ComplexArray


def mode_films(parts: Sequence[Part], swings: Sequence[Swing], seen: str = "") -> tuple[Film, ...]:
    """Return a film `mode_1`, … of each of the first of these modes; `seen` as in "seen from the eccentric".

    They are MOST, or fewer with files that were larger than BYTES, and then the titles say so.
    """
    reach = 0.5 * max(float(np.ptp(np.concatenate([p.points[:, axis] for p in parts]))) for axis in range(3))
    each = FRAMES * sum(1200 + 24 * len(part.points) + 17 * part.cells.shape[1] for part in parts)
    shown = min(MOST, max(1, int(BYTES // each)))
    fewer = f"{shown} films, more were too large" if shown < min(MOST, len(swings)) else ""
    return tuple(_film(parts, swing, SHARE * reach, (seen, fewer)) for swing in swings[:shown])


def _film(parts: Sequence[Part], swing: Swing, largest: float, notes: tuple[str, ...]) -> Film:
    moved = [part.moved(motion) for part, motion in zip(parts, swing.motion, strict=True)]
    whole = np.concatenate(moved)
    turn = np.exp(-0.5j * np.angle((whole**2).sum()))  # the phase at which most is displaced comes first
    size = max(_size(each) for each in moved)
    scale = turn * (largest / size if size > 0.0 else 0.0)

    def frames() -> list[FieldFrame]:
        made = []
        for phase in 2.0 * np.pi * np.arange(FRAMES) / FRAMES:
            at = scale * np.exp(1j * phase)
            bodies = (_body(part, (at * u).real, bool(u.any())) for part, u in zip(parts, moved, strict=True))
            made.append((float(phase), tuple(bodies)))
        return made

    said = (f"Mode {swing.number}: {swing.words}", *notes, "of arbitrary size")
    return Film(
        f"mode_{swing.number}",
        "; ".join(each for each in said if each),
        Later(frames),
        PHASE,
        "displacement",
        spatial=True,
    )


def _body(part: Part, displacement: Array, moves: bool) -> Field:
    data = {"displacement": displacement.astype(np.float32)}
    opacity = part.opacity if moves else min(part.opacity, GLASS)
    return Field(part.name, part.points.astype(np.float32), part.cells, data, "triangle", opacity=opacity)


def _size(displacement: ComplexArray) -> float:
    """Return the largest displacement of any point at any phase: half the long axis of its ellipse."""
    square = (np.abs(displacement) ** 2).sum(axis=1)
    return float(np.sqrt(0.5 * (square + np.abs((displacement**2).sum(axis=1)))).max(initial=0.0))


def plate(name: str, outline: Array, radius: float, z: float, center: Array) -> Part:
    """Return a flat ring at z between a star-shaped `outline` (p, 2) about `center` and the circle of `radius`."""
    rims = np.concatenate([outline, _on_circle(outline, radius, center)])
    points = np.column_stack([rims, np.full(len(rims), z)])
    return Part(name, frozen(points), _band(0, len(outline), len(outline)), frozen(center))


def solid(name: str, radius: float, low: float, high: float, center: Array) -> Part:
    """Return a cylinder about the axis through `center` (3,), between two heights, with both lids."""
    profile = ((0.0, low), (radius, low), (radius, high), (0.0, high))
    return _upright(name, revolved(profile, UPWARDS, SIDES), center)


def tube(name: str, radii: tuple[float, float], low: float, high: float, center: Array) -> Part:
    """Return a round ring of two radii between two heights."""
    inner, outer = sorted(radii)
    profile = ((inner, low), (outer, low), (outer, high), (inner, high))
    return _upright(name, revolved(profile, UPWARDS, AROUND), center)


def _upright(name: str, made: Solid, center: Array) -> Part:
    """Return a solid about the z axis as a part about the axis through `center`."""
    points = made.points + np.array([*center[:2], 0.0])
    return Part(name, frozen(points), made.cells, frozen(center))


def joined(name: str, parts: Sequence[Part], opacity: float = 1.0) -> Part:
    """Return solids that are one member, which moves as the first of them."""
    whole = solids.joined([Solid(part.points, part.cells) for part in parts])
    return Part(name, frozen(whole.points), whole.cells, parts[0].center, opacity)


def at_parameters(period: float, teeth: int) -> Array:
    """Return parameters (n,) of a coarse outline with `teeth` lobes or teeth, POINTS or fewer where that will do."""
    each = max(4, min(12, POINTS // teeth))
    return period * np.arange(each * teeth) / (each * teeth)


def _band(first: int, second: int, count: int) -> IntArray:
    """Return triangles (3, 2 count) between two closed lines of as many points."""
    at, after = np.arange(count), (np.arange(count) + 1) % count
    lower = np.stack([first + at, first + after, second + at])
    upper = np.stack([second + at, first + after, second + after])
    return np.concatenate([lower, upper], axis=1)


def _on_circle(outline: Array, radius: float, center: Array) -> Array:
    """Return the points (p, 2) of a circle about `center` under those of an outline."""
    out = outline - center[:2]
    return np.asarray(center[:2] + radius * out / np.linalg.norm(out, axis=1, keepdims=True))

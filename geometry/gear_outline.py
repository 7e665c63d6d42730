"""Outline of a gear body: one fine tooth, coarser ones beside it and coarse ones round the rest of the rim.

Loops "teeth" and "rim": the bore of a gear with external teeth, the outer edge of a ring. All teeth are alike, so the
fine one is pressed for all of them; what the others must carry over is their bending with the rim, for which a few
facets each are enough.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from trochoid.geometry.gear_curve import LAND, ROUND, GearBoundary
from trochoid.geometry.gear_tooth import Tooth
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

LEVEL = 8  # facets per flank without those that the tip edge asks for
_EDGE, _RISE = 0.1, 3.2  # facets at the tip edge: share of the flank's, and how fast it grows to one
_NEAR, _FAST = 2.0, 1.8  # pitches from the fine tooth, beyond which elements grow faster, and how fast
_STEEP = 1.0  # growth of facets along flanks that are not pressed
_BESIDE, _ROUGH = 2, 4  # how much coarser the neighbours and all other teeth are
_TURNED = 0.4  # facets per radian that a fillet turns, times the level
_TURN = 0.58  # rad that a facet of any fillet turns at the most, or elements fold
_FEWEST = 12  # facets on the rim's edge
_SAME = 1e-6  # of the module: closer breaks are one
_LEAST_RIM = 0.05  # of the module: a thinner rim has no room for elements


@dataclass(frozen=True, slots=True)
class Blank:
    """A gear body: its tooth, and the radius of the bore, or of the outer edge of a ring, m."""

    tooth: Tooth
    rim_radius: float

    def __post_init__(self) -> None:
        """Refuse a rim without thickness."""
        if self.rim_radius > 0.0 and self.rim >= _LEAST_RIM * self.tooth.gear.module:
            return
        root, least = self.tooth.cut.root_radius, _LEAST_RIM * self.tooth.gear.module
        ring = self.tooth.gear.internal
        name, word = ("outer", "above") if ring else ("bore", "between 0 and")
        limit = root + least if ring else root - least
        raise Infeasible(
            f"{name} radius {1e3 * self.rim_radius:.6g} mm: with a root circle of {1e3 * root:.6g} mm it must lie "
            f"{word} {1e3 * limit:.6g} mm"
        )

    @property
    def rim(self) -> float:
        """Thickness of the rim below the root circle, m."""
        return self.tooth.gear.side * (self.tooth.cut.root_radius - self.rim_radius)

    @property
    def boundary(self) -> GearBoundary:
        """The toothed boundary as a curve."""
        return GearBoundary(self.tooth)


def gear_outline(blank: Blank, level: int = LEVEL, rim_facets: int | None = None) -> Outline:
    """Outline of a gear body with `level` facets per flank; twice the level halves every facet.

    `rim_facets` per tooth at the level 8 on the rim's edge; by default as the rim's thickness asks. Raises Infeasible.
    """
    if level < 2:
        raise Infeasible(f"{level} facets per flank: at least 2 are needed, {LEVEL} are usual")
    curve, z = blank.boundary, blank.tooth.gear.teeth
    fine, beside, rough = (_tooth_breaks(blank, max(1.0, level / k), k) for k in (1, _BESIDE, _ROUGH))
    breaks = [fine, np.ones(1)]
    for tooth in range(1, z):
        one = beside if tooth in (1, z - 1) else rough
        breaks.append(tooth + one[one > 0.0])  # one facet on the root between two coarse teeth
    teeth = Loop("teeth", curve, breaks=np.append(np.concatenate(breaks), float(z)))
    ring = blank.tooth.gear.internal
    count = max(math.ceil(_FEWEST / z), round((rim_facets or default_rim_facets(blank)) * level / LEVEL))
    rim = Loop("rim", Circle((0.0, 0.0), blank.rim_radius, hole=not ring), z * count)
    return Outline(rim, (teeth,)) if ring else Outline(teeth, (rim,))


def gear_growth(blank: Blank) -> Callable[[Array], Array]:
    """Growth of elements away from the boundary, for `mesh_outline`: slow near the fine tooth, fast elsewhere."""
    middle, pitch = 0.5 * blank.tooth.pitch, blank.tooth.pitch

    def growth(points: Array) -> Array:
        away = np.mod(np.arctan2(points[:, 1], points[:, 0]) - middle + math.pi, 2.0 * math.pi) - math.pi
        return np.where(np.abs(away) < _NEAR * pitch, 1.3, _FAST)

    return growth


def default_rim_facets(blank: Blank) -> int:
    """Facets per tooth on the rim's edge at the level 8: no longer than the rim is thick, or two per tooth."""
    length = blank.tooth.pitch * blank.rim_radius
    return int(np.clip(math.ceil(length / blank.rim), 1, 8)) if blank.rim < length else 1


def _tooth_breaks(blank: Blank, level: float, coarser: int) -> Array:
    """Breaks from the middle of one space to that of the next, the last left out, within t = 0 … 1."""
    tooth, curve = blank.tooth, blank.boundary
    root, fillet, _ = curve.plain.knots
    length = 0.5 * abs(tooth.end**2 - tooth.cut.start**2) / tooth.gear.base_radius
    land, turn = tooth.cut.root_radius * tooth.cut.fillet.root, _turn(curve, root, fillet)
    bends = _bent(curve, root, fillet, max(math.ceil(turn / _TURN), round(_TURNED * level * turn)))
    half = [_even(0.0, root, max(1, round(level * land / length))), bends]
    step = float(np.linalg.norm(np.diff(curve.point(bends[-2:]), axis=0)))
    half.append(_flank(blank, level, step, coarser == 1))
    if coarser == 1:
        half.append(_even(ROUND, 0.5 if tooth.full else LAND, max(2, round(level / 4))))
        half += [] if tooth.full else [_land(blank, level)]
    one = _apart(np.unique(np.round(np.concatenate(half), 14)), curve, _SAME * tooth.gear.module)
    mirrored = 1.0 - one[one > 0.0][::-1]
    return np.unique(np.round(np.concatenate((one, mirrored)), 14))


def _apart(breaks: Array, curve: GearBoundary, least: float) -> Array:
    """Leave out breaks whose points are not `least` metres past the one before: at the limit of undercut the fillet
    meets the involute where that starts, at the base circle, and the involute's first points fall together.
    """
    kept = [breaks[0]]
    for at, point in zip(breaks[1:], curve.point(breaks[1:]), strict=True):
        if np.linalg.norm(point - curve.point(kept[-1])) > least:
            kept.append(at)
    return np.array(kept)


def _turn(curve: GearBoundary, low: float, high: float) -> float:
    """Angle (rad) by which the boundary turns between two parameters."""
    t = np.linspace(low, high, 801)[1:-1]
    return float(np.mean(curve.speed(t) * np.abs(curve.curvature(t))) * (high - low))


def _even(low: float, high: float, count: int) -> Array:
    return np.linspace(low, high, count + 1)


def _bent(curve: GearBoundary, low: float, high: float, count: int) -> Array:
    """Facets that share arc length and turning of the fillet alike."""
    t = np.linspace(low, high, 801)[1:-1]
    arc = curve.speed(t)
    turn = arc * np.abs(curve.curvature(t))
    density = np.cumsum(arc / arc.sum() + turn / turn.sum())
    inner = np.interp(np.arange(1, count) / count * density[-1], density, t)
    return np.concatenate(([low], inner, [high]))


def _flank(blank: Blank, level: float, step: float, pressed: bool) -> Array:
    """Facets that grow from the fillet's last one, of the length `step`, up; and on a pressed flank from the tip edge
    down, where the compliance rises with the logarithm of the distance.
    """
    tooth, curve = blank.tooth, blank.boundary
    low, high = tooth.cut.start**2, tooth.end**2
    length = 0.5 * abs(high - low) / tooth.gear.base_radius
    share = np.linspace(0.0, 1.0, 2001)  # of the arc, from the tip
    size = np.minimum(1.0, level * step / length + (_RISE if pressed else _STEEP * level) * (1.0 - share))
    if pressed:
        size = np.minimum(size, _EDGE + _RISE * share)
    total = np.concatenate(([0.0], np.cumsum(0.5 * (1.0 / size[1:] + 1.0 / size[:-1]) * np.diff(share))))
    count = max(4 if pressed else 1, round(level * total[-1]))
    at = np.interp(np.linspace(0.0, total[-1], count + 1), total, share)
    return np.sort(curve.parameter(np.sqrt(high - (high - low) * at)))


def _land(blank: Blank, level: float) -> Array:
    """Half the land, its facets growing from the edge."""
    tooth = blank.tooth
    half = tooth.tip_radius * (0.5 * tooth.pitch - float(np.angle(tooth.center)))
    first = 1.5 * tooth.rounding
    count = max(1, round(0.25 * level * math.log1p(half / first)))
    at = np.expm1(np.linspace(0.0, math.log1p(half / first), count + 1)) * first / half
    return np.asarray(LAND + (0.5 - LAND) * at)

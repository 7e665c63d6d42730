"""Where two gear flanks are closest: on both involutes, or on the rounded tip edge of one of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.fem.gear_flank import Flank, Posed
from trochoid.kinematics.types import Array, BoolArray, ComplexArray

SEARCH = 40  # steps towards the closest place of relieved flanks; they halve a bracket at the worst
FINE = 1e-13  # slope between flanks that touch


@dataclass(frozen=True, slots=True)
class Touching:
    """Closest places (n, c): gap, `point` on the first profile, normal out of it, ρ on both flanks, arc length `along`.

    `over`: how far the flanks' closest place lies beyond both involutes; `bend` (1/m) of the first profile and `radii`
    (m) of both, positive where convex; `plain` the flanks' common curvature, as if they went on.
    """

    gap: Array
    point: ComplexArray
    normal: ComplexArray
    rho: tuple[Array, Array]
    along: Array
    over: tuple[Array, Array]
    bend: Array
    radii: tuple[Array, Array]
    plain: Array


def closest(one: Posed, two: Posed) -> Touching:
    """Return the closest places of the flanks as they stand."""
    rho = _involutes(one, two)
    point, normal = one.point(rho)
    gap, facing, _ = two.seen(point)
    over = one.flank.beyond(rho), two.flank.beyond(facing)
    along = 0.5 * rho**2 / one.flank.base_radius
    plain = Touching(
        gap, point, normal, (rho, facing), along, over, *_bends(one.flank, two.flank, rho, facing)
    )
    return _over_second(one, two, _over_first(one, two, plain))


def _bends(one: Flank, two: Flank, rho: Array, facing: Array) -> tuple[Array, tuple[Array, Array], Array]:
    first = one.side / one.curved(rho) + one.relief(rho)[2]
    second = two.side / two.curved(facing) + two.relief(facing)[2]
    return first, (1.0 / first, 1.0 / second), first + second


def _involutes(one: Posed, two: Posed) -> Array:
    """Return ρ (n, c) on the first flank where two involutes, that may go on beyond their ends, are closest."""
    apart = two.center - one.center
    cosine = (one.flank.base_radius + two.flank.side * two.flank.base_radius) / np.abs(apart)
    turn = two.flank.side * one.hand * np.arccos(np.clip(cosine, -1.0, 1.0))
    rho = one.rho(np.angle(apart) + turn)
    if not (one.flank.reliefs or two.flank.reliefs):
        return rho
    return _searched(one, two, rho)


def _searched(one: Posed, two: Posed, rho: Array) -> Array:
    """Move ρ to where relieved flanks are parallel: Newton on their slope along the arc, within a bracket."""
    base = one.flank.base_radius
    s = 0.5 * np.maximum(rho, 0.0) ** 2 / base
    low, high = np.zeros(s.shape), s + 0.5 * one.flank.end**2 / base
    for _ in range(SEARCH):
        rho = np.sqrt(2.0 * base * s)
        slope, bend = _slope(one, two, rho)
        low, high = np.where(slope < 0.0, s, low), np.where(slope > 0.0, s, high)
        step = s - slope / bend
        inside = (step >= low) & (step <= high) & (bend > 0.0)
        done = np.abs(slope) <= FINE
        s = np.where(done, s, np.where(inside, step, 0.5 * (low + high)))
        if done.all():
            break
    return np.sqrt(2.0 * base * s)


def _slope(one: Posed, two: Posed, rho: Array) -> tuple[Array, Array]:
    """Return how the distance between the flanks grows along the first one's arc, and its growth's growth in 1/m."""
    point, normal = one.point(rho)
    _, facing, other = two.seen(point)
    slope = np.real(np.conj(other) * (1j * one.hand * normal))
    return np.asarray(slope), _bends(one.flank, two.flank, rho, facing)[2]


def _over_first(one: Posed, two: Posed, touch: Touching) -> Touching:
    """Put the first gear's tip rounding in the place of its flank where the closest place lies beyond."""
    center, radius = one.edge(), one.flank.rounding
    distance, facing, other = two.seen(center)
    end = np.full(facing.shape, one.flank.end)
    _, last = one.point(end)
    turned = np.clip(one.hand * np.angle(-other / last), 0.0, math.pi)
    bend = np.full(facing.shape, 1.0 / radius)
    second = _bends(one.flank, two.flank, end, facing)[1][1]
    along = 0.5 * end**2 / one.flank.base_radius + radius * turned
    edge = Touching(
        distance - radius,
        center - radius * other,
        -other,
        (end, facing),
        along,
        touch.over,
        bend,
        (1.0 / bend, second),
        touch.plain,
    )
    return _chosen(touch.over[0] > 0.0, edge, touch)


def _over_second(one: Posed, two: Posed, touch: Touching) -> Touching:
    """Put the second gear's tip rounding in the place of its flank where the closest place lies beyond."""
    center, radius = two.edge(), two.flank.rounding
    distance, rho, normal = one.seen(center)
    end = np.full(rho.shape, two.flank.end)
    first, radii, _ = _bends(one.flank, two.flank, rho, end)
    gap = distance - radius
    edge = Touching(
        gap,
        center - distance * normal,
        normal,
        (rho, end),
        0.5 * np.maximum(rho, 0.0) ** 2 / one.flank.base_radius,
        touch.over,
        first,
        (radii[0], np.full(rho.shape, radius)),
        touch.plain,
    )
    return _chosen((touch.over[1] > 0.0) & (touch.over[0] <= 0.0), edge, touch)


def _chosen(where: BoolArray, one: Touching, other: Touching) -> Touching:
    def pick(a: Array, b: Array) -> Array:
        return np.where(where, a, b)

    return Touching(
        pick(one.gap, other.gap),
        np.where(where, one.point, other.point),
        np.where(where, one.normal, other.normal),
        (pick(one.rho[0], other.rho[0]), pick(one.rho[1], other.rho[1])),
        pick(one.along, other.along),
        other.over,
        pick(one.bend, other.bend),
        (pick(one.radii[0], other.radii[0]), pick(one.radii[1], other.radii[1])),
        other.plain,
    )


def profile(one: Posed, along: Array) -> ComplexArray:
    """Return points of the first profile at arc lengths (n, c, m): flank, then rounding."""
    f = one.flank
    last = 0.5 * f.end**2 / f.base_radius
    rho = np.sqrt(2.0 * f.base_radius * np.clip(along, 0.0, last))
    point, _ = one.point(rho)
    center = one.edge()
    _, normal = one.point(np.full(one.phase.shape, f.end))
    turned = np.clip((along - last) / f.rounding, 0.0, math.pi)
    round_ = center + f.rounding * normal * np.exp(1j * one.hand * turned)
    return np.where(along > last, round_, point)

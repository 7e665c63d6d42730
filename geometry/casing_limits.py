"""Measures of a box casing that cannot be: each refusal names the limit and the nearest feasible value."""

from __future__ import annotations

import math
from itertools import combinations

from trochoid.geometry.casing_box import Bore, BoxCasing, MountPlace, inner_face, outer_face
from trochoid.kinematics.errors import Infeasible


def fail_if_impossible(casing: BoxCasing) -> None:
    """Raise Infeasible naming the first measure that cannot be, and its nearest feasible value."""
    names = [bore.name for bore in casing.bores] + [mount.name for mount in casing.mounts]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise Infeasible(f"casing: bores and mounts need different names; {', '.join(twice)} given twice")
    _fail_unless_hollow(casing)
    for bore in casing.bores:
        _fail_unless_bore_fits(casing, bore)
    for mount in casing.mounts:
        _fail_unless_mount_fits(casing, mount)
    _fail_if_overlapping(casing)


def _fail_unless_hollow(casing: BoxCasing) -> None:
    for name, value in (("wall", casing.wall), ("base", casing.plate)):
        if not (math.isfinite(value) and value > 0.0):
            raise Infeasible(f"casing: {name} must be thicker than 0 mm, given {1e3 * value:g} mm")
    if min(casing.flange) < 0.0:
        raise Infeasible(
            f"casing: the flange cannot reach {_mm(*casing.flange)} mm beyond the box; give 0 or more"
        )
    solid = (2.0 * casing.wall, casing.wall + casing.plate, 2.0 * casing.wall)
    for axis, side, walls in zip("xyz", casing.size, solid, strict=True):
        if not side > walls:
            raise Infeasible(
                f"casing: {1e3 * side:g} mm along {axis} leave nothing between walls of {1e3 * walls:g} mm together; "
                f"give more than {1e3 * walls:g} mm, or thinner walls"
            )


def _fail_unless_bore_fits(casing: BoxCasing, bore: Bore) -> None:
    if bore.wall not in ("low", "high"):
        raise Infeasible(f'casing: {bore.name} is in wall {bore.wall!r}; allowed are "low" and "high"')
    if not 0.0 < bore.radius < bore.boss:
        raise Infeasible(
            f"casing: {bore.name} needs 0 < radius < boss, given a bore of {1e3 * bore.radius:g} mm in a boss of "
            f"{1e3 * bore.boss:g} mm"
        )
    inside = casing.size[2] - casing.wall
    if not casing.wall <= bore.length < inside:
        raise Infeasible(
            f"casing: the seat of {bore.name} is {1e3 * bore.length:g} mm long; it goes through the wall, so at least "
            f"{1e3 * casing.wall:g} mm, and less than {1e3 * inside:g} mm, where the other wall is"
        )
    low, high, wall = casing.low, casing.high, casing.wall
    room = {
        "x": (low[0] + wall + bore.boss, high[0] - wall - bore.boss, bore.x),
        "y": (low[1] + casing.plate + bore.boss, high[1] - wall - bore.boss, bore.y),
    }
    for axis, (least, most, given) in room.items():
        if not least < given < most:
            largest = bore.boss - max(least - given, given - most)
            raise Infeasible(
                f"casing: the boss of {bore.name}, radius {1e3 * bore.boss:g} mm at {axis} = {1e3 * given:g} mm, meets "
                f"a wall; there its radius must be below {1e3 * largest:g} mm"
            )


def _fail_unless_mount_fits(casing: BoxCasing, mount: MountPlace) -> None:
    if not mount.radius > 0.0:
        raise Infeasible(f"casing: {mount.name} needs a radius above 0, given {1e3 * mount.radius:g} mm")
    for i, given in ((0, mount.x), (2, mount.z)):
        reach = casing.flange[i // 2]
        least, most = casing.low[i] - reach + mount.radius, casing.high[i] + reach - mount.radius
        if not least < given < most:
            raise Infeasible(
                f"casing: {mount.name}, radius {1e3 * mount.radius:g} mm, is not on the base plate at {'xyz'[i]} = "
                f"{1e3 * given:g} mm; allowed is between {1e3 * least:g} and {1e3 * most:g} mm"
            )


def _fail_if_overlapping(casing: BoxCasing) -> None:
    for one, two in combinations(casing.bores, 2):
        ends = [sorted((outer_face(casing, b), inner_face(casing, b))) for b in (one, two)]
        if max(ends[0][0], ends[1][0]) <= min(ends[0][1], ends[1][1]):
            _fail_if_near(
                f"the bosses {one.name} and {two.name}",
                math.dist((one.x, one.y), (two.x, two.y)),
                one.boss + two.boss,
            )
    for first, second in combinations(casing.mounts, 2):
        _fail_if_near(
            f"the mount places {first.name} and {second.name}",
            math.dist((first.x, first.z), (second.x, second.z)),
            first.radius + second.radius,
        )


def _fail_if_near(what: str, apart: float, least: float) -> None:
    if not apart > least:
        raise Infeasible(
            f"casing: {what} overlap: {1e3 * apart:g} mm apart with radii of together {1e3 * least:g} mm; move them "
            "further apart or make them smaller"
        )


def _mm(*values: float) -> str:
    return ", ".join(f"{1e3 * value:g}" for value in values)

"""Measures of a box casing that cannot be: each refusal names the limit and the nearest feasible value.

Walls below a 200th of the box are plates that no mesh of solid elements answers for; a boss thinner than the facets of
its bore bulge cannot be meshed; edges far longer than the walls are thick or the box is wide leave a mesh that says
nothing.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import combinations

from trochoid.geometry.casing_box import Bore, BoxCasing, MountPlace, inner_face, outer_face
from trochoid.kinematics.errors import Infeasible

THIN_WALL = 1.0 / 200.0  # of the largest side of the box: the least thickness of walls and base plate
THIN_BOSS = 1.02  # radii of its bore: a bore is a polygon of 16 sides, which is 1/cos(pi/16) wide
LONG_EDGE = 8.0  # walls: the longest edges of the mesh
EDGES = 3.0  # the least of them along the shortest side of the box


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
    thin = THIN_WALL * max(casing.size)
    for name, value in (("wall", casing.wall), ("base", casing.plate)):
        if value < thin:
            raise Infeasible(
                f"casing: a {name} of {1e3 * value:g} mm is too thin for a body of solid elements; with sides up to "
                f"{1e3 * max(casing.size):g} mm, give {_up(thin)} mm or more"
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
    if bore.boss < THIN_BOSS * bore.radius:
        raise Infeasible(
            f"casing: the boss of {bore.name}, radius {1e3 * bore.boss:g} mm, is too thin round a bore of "
            f"{1e3 * bore.radius:g} mm; give {_up(THIN_BOSS * bore.radius)} mm or more"
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
    tightest = sorted(room.items(), key=lambda each: min(each[1][2] - each[1][0], each[1][1] - each[1][2]))
    for axis, (least, most, given) in tightest:
        if not least < given < most:
            largest = bore.boss - max(least - given, given - most)
            advice = []
            if largest > THIN_BOSS * bore.radius:
                advice.append(f"there its radius must be below {1e3 * largest:g} mm")
            if least < most:
                advice.append(f"at that radius {axis} must be between {_mm(least)} and {_mm(most)} mm")
            widest = bore.boss + 0.5 * (most - least)
            if not advice and widest > 0.0:
                advice.append(f"between these walls its radius must be below {1e3 * widest:g} mm anywhere")
            raise Infeasible(
                f"casing: the boss of {bore.name}, radius {1e3 * bore.boss:g} mm at {axis} = {1e3 * given:g} mm, meets "
                f"a wall; {', or '.join(advice)}"
            )


def _fail_unless_mount_fits(casing: BoxCasing, mount: MountPlace) -> None:
    if not mount.radius > 0.0:
        raise Infeasible(f"casing: {mount.name} needs a radius above 0, given {1e3 * mount.radius:g} mm")
    for i, given in ((0, mount.x), (2, mount.z)):
        reach = casing.flange[i // 2]
        least, most = casing.low[i] - reach + mount.radius, casing.high[i] + reach - mount.radius
        if not least < given < most:
            allowed = f"allowed is between {_mm(least)} and {_mm(most)} mm"
            if not least < most:
                widest = mount.radius + 0.5 * (most - least)
                allowed = f"the plate has room for a radius below {_mm(widest)} mm"
            raise Infeasible(
                f"casing: {mount.name}, radius {1e3 * mount.radius:g} mm, is not on the base plate at {'xyz'[i]} = "
                f"{_mm(given)} mm; {allowed}"
            )


def fail_if_edge_too_long(casing: BoxCasing, edge: float) -> None:
    """Raise Infeasible for edges of the mesh, m, that are too long for walls and box."""
    by_wall, by_side = LONG_EDGE * casing.wall, min(casing.size) / EDGES
    if edge > min(by_wall, by_side):
        why = f"{LONG_EDGE:g} walls" if by_wall < by_side else "a third of the shortest side of the box"
        raise Infeasible(
            f"casing: edges of the mesh of {1e3 * edge:g} mm are longer than {why}; give mesh_edge = "
            f"{_down(min(by_wall, by_side))} mm or less"
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


def _up(value: float) -> str:
    """Return a least value in mm, with four digits or fewer, and not less than it."""
    return _rounded(value, math.ceil)


def _down(value: float) -> str:
    return _rounded(value, math.floor)


def _rounded(value: float, whole: Callable[[float], int]) -> str:
    step = 10.0 ** (math.floor(math.log10(1e3 * value)) - 3)
    return f"{step * whole(round(1e3 * value / step, 6)):.6g}"

"""A plain casing from its measures: a box with bosses and bores in its two walls across z, on a base plate.

y ┌──────────────┐      the drive's axis is z; walls "low" and "high" stand across it
  │  ╭─╮ boss    │      bosses stand on the inside of a wall, bores go through both
  │  ╰─╯ bore    │      the base plate is the lowest part of the box, and may reach beyond it
══╧══════════════╧══ x  mount places are discs on its underside
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from typing import Literal

from trochoid.geometry.solid_places import Cylinder, Disc, Place
from trochoid.kinematics.errors import Infeasible

Triple = tuple[float, float, float]
Wall = Literal["low", "high"]


@dataclass(frozen=True, slots=True)
class Bore:
    """A bearing's seat in a `wall`: axis through `x`, `y`, of `radius`, over `length` inwards from its outer face.

    Its boss has the outer radius `boss`; all in m.
    """

    name: str
    wall: Wall
    radius: float
    boss: float
    length: float
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True, slots=True)
class MountPlace:
    """A disc of `radius` round `x`, `z` on the underside of the base plate, m."""

    name: str
    x: float
    z: float
    radius: float


@dataclass(frozen=True, slots=True)
class BoxCasing:
    """A box of outer `size` (x, y, z) round `center`, with walls of one thickness `wall`, m.

    Its base plate is `base` thick (None: as the walls) and reaches `flange` (x, z) beyond the box on each side.
    """

    size: Triple
    wall: float
    bores: tuple[Bore, ...]
    mounts: tuple[MountPlace, ...]
    center: Triple = (0.0, 0.0, 0.0)
    base: float | None = None
    flange: tuple[float, float] = (0.0, 0.0)

    @property
    def plate(self) -> float:
        """Thickness of the base plate, m."""
        return self.wall if self.base is None else self.base

    @property
    def low(self) -> Triple:
        """The corner of the box with the least coordinates, m."""
        x, y, z = (c - 0.5 * s for c, s in zip(self.center, self.size, strict=True))
        return x, y, z

    @property
    def high(self) -> Triple:
        """The corner of the box with the largest coordinates, m."""
        x, y, z = (c + 0.5 * s for c, s in zip(self.center, self.size, strict=True))
        return x, y, z


def outer_face(casing: BoxCasing, bore: Bore) -> float:
    """Return z of the outer face of a bore's wall, m."""
    return casing.low[2] if bore.wall == "low" else casing.high[2]


def inner_face(casing: BoxCasing, bore: Bore) -> float:
    """Return z where a bore's boss ends inside, m."""
    return outer_face(casing, bore) + (bore.length if bore.wall == "low" else -bore.length)


def seat_center(casing: BoxCasing, bore: Bore) -> Triple:
    """Return the middle of a bore's seat, m."""
    return bore.x, bore.y, 0.5 * (outer_face(casing, bore) + inner_face(casing, bore))


def mount_center(casing: BoxCasing, mount: MountPlace) -> Triple:
    """Return the middle of a mount place, m."""
    return mount.x, casing.low[1], mount.z


def casing_places(casing: BoxCasing) -> dict[str, Place]:
    """Return where bores and mount places are on the surface, by name."""
    places: dict[str, Place] = {}
    for bore in casing.bores:
        half = 0.5 * bore.length
        places[bore.name] = Cylinder(seat_center(casing, bore), (0.0, 0.0, 1.0), bore.radius, (-half, half))
    for mount in casing.mounts:
        places[mount.name] = Disc(mount_center(casing, mount), (0.0, 1.0, 0.0), mount.radius)
    return places


def centers(casing: BoxCasing) -> dict[str, Triple]:
    """Return the middle of each bore's seat and of each mount place, m, by name."""
    seats = {bore.name: seat_center(casing, bore) for bore in casing.bores}
    return seats | {mount.name: mount_center(casing, mount) for mount in casing.mounts}


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

"""A plain casing from its measures: a box with bosses and bores in its two walls across z, on a base plate.

y ┌──────────────┐      the drive's axis is z; walls "low" and "high" stand across it
  │  ╭─╮ boss    │      bosses stand on the inside of a wall, bores go through both
  │  ╰─╯ bore    │      the base plate is the lowest part of the box, and may reach beyond it
══╧══════════════╧══ x  mount places are discs on its underside
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from trochoid.geometry.solid_places import Cylinder, Disc, Place

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

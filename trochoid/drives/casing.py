"""A scene's casing, ready to be shaken, with the variants that tell what each of its effects contributes.

rigid      mass and inertia of the scene ─────────────────────────┐
elastic    box ─► mesh ┐                                           ├─► Shaken(body, variants, points)
           file ───────┴► body ─► reduced to bores, feet, modes ───┘    (`casing_body`)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.scene import Casing as CasingTable
from trochoid.scene import Scene

if TYPE_CHECKING:
    from trochoid.dynamics.structure import Structure
    from trochoid.fem.solid import SolidBody

Triple = tuple[float, float, float]

RIGID_CASING, RIGID_MOUNTS, FREE = "rigid_casing", "rigid_mounts", "free_casing"


@dataclass(frozen=True, slots=True)
class Shaken:
    """A casing `body`, its `variants` by what they are without, and the points where it is read.

    Of an elastic one: middles of the `bores`, m, and which places of the drive each `holds`, its elastic natural
    `frequencies` without mounts, Hz, and how far the reduction puts them off (`error`, None: not compared).
    """

    body: Casing | Structure
    variants: Mapping[str, Casing | Structure]
    points: tuple[Point, ...]
    bores: Mapping[str, Triple] = field(default_factory=dict)
    holds: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    frequencies: tuple[float, ...] = ()
    error: float | None = None

    @property
    def elastic(self) -> bool:
        """Whether it must be told where its loads act."""
        return not isinstance(self.body, Casing)


def is_elastic(scene: Scene[Any]) -> bool:
    """Return whether the scene has an elastic casing."""
    return scene.casing is not None and scene.casing.elastic


def rigid_shaken(scene: Scene[Any]) -> Shaken:
    """Return the rigid casing of a scene; raises TrochoidError without a casing."""
    casing, points = rigid_casing_of(scene)
    stands = any(any(m.stiffness) or any(m.damping) for m in casing.mounts)
    variants = {FREE: Casing(casing.mass, casing.inertia, casing.center)} if stands else {}
    return Shaken(casing, variants, points)


def rigid_casing_of(scene: Scene[Any], body: SolidBody | None = None) -> tuple[Casing, tuple[Point, ...]]:
    """Return the rigid casing on its mounts, that of an elastic `body` as it is, and where it is measured.

    Raises TrochoidError without a casing.
    """
    table = casing_table(scene)
    mounts = tuple(Mount(m.position, m.stiffness, m.damping) for m in table.mounts)
    points = tuple(Point(p.name, p.position) for p in table.points) or (Point("centre", table.center),)
    if body is None:
        if table.mass is None or table.inertia is None:
            raise TrochoidError(
                "a rigid casing needs mass and inertia; an elastic one has them from its body"
            )
        return Casing(table.mass, table.inertia, table.center, mounts), points
    from trochoid.fem.solid import mass_properties

    found = mass_properties(body)
    x, y, z = found.center.tolist()
    return Casing(found.mass, found.inertia, (x, y, z), mounts), points


def casing_mass(scene: Scene[Any], body: Callable[[], SolidBody]) -> tuple[float, str]:
    """Return the mass of the casing, kg, 0 without one, and where it is from: "given", or "mesh" of an elastic one."""
    if scene.casing is None:
        return 0.0, "given"
    if not scene.casing.elastic:
        return scene.casing.mass or 0.0, "given"
    from trochoid.fem.solid import mass_properties

    return mass_properties(body()).mass, "mesh"


def casing_table(scene: Scene[Any]) -> CasingTable:
    """Return the table; raises TrochoidError without one."""
    if scene.casing is None:
        raise TrochoidError("vibration needs the scene's [casing] table")
    return scene.casing


def casing_reasons(scene: Scene[Any]) -> list[str]:
    """Return why the box of an elastic casing cannot be; nothing is meshed."""
    if not (is_elastic(scene) and scene.has("casing_on_mounts")):
        return []
    from trochoid.drives.casing_body import box_casing
    from trochoid.geometry.casing_limits import fail_if_impossible

    try:
        box = box_casing(casing_table(scene))
        if box is not None:
            fail_if_impossible(box)
    except Infeasible as fault:
        return [str(fault)]
    return []

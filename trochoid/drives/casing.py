"""A scene's casing, ready to be shaken, with the variants that tell what each of its effects contributes.

rigid      mass and inertia of the scene ─────────────────────────┐
elastic    box ─► mesh ┐                                           ├─► Shaken(body, variants, points)
           file ───────┴► body ─► reduced to bores, feet, modes ───┘    (`casing_body`)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from trochoid.drives.planning import MOST_MEMORY, least_edge
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.scene import Casing as CasingTable
from trochoid.scene import Scene
from trochoid.scene.casing import Mount as MountTable

if TYPE_CHECKING:
    from trochoid.dynamics.structure import Structure
    from trochoid.fem.solid import SolidBody
    from trochoid.geometry.casing_box import BoxCasing

Triple = tuple[float, float, float]

RIGID_CASING, RIGID_MOUNTS, FREE = "rigid_casing", "rigid_mounts", "free_casing"
AT = 1e-6  # of the box: how near a mount must be to its underside


@dataclass(frozen=True, slots=True)
class Shaken:
    """A casing `body`, its `variants` by what they are without, and the points where it is read.

    Of an elastic one: middles of the `bores`, m, and which places of the drive each `holds`, its elastic natural
    `frequencies` without mounts, Hz, and how far the reduction puts them off (`error`, None: not compared); `edge`: of
    a box's mesh, m; `alone`: why there is no coarser one that would tell the error.
    """

    body: Casing | Structure
    variants: Mapping[str, Casing | Structure]
    points: tuple[Point, ...]
    bores: Mapping[str, Triple] = field(default_factory=dict)
    holds: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    frequencies: tuple[float, ...] = ()
    error: float | None = None
    edge: float | None = None
    alone: str = ""

    @property
    def compared(self) -> bool:
        """Whether there is a coarser mesh of the casing, or none at all, as for a rigid one."""
        return not self.elastic or (self.edge is not None and not self.alone)

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
    """Return why the box of an elastic casing cannot be, what stands off it, or needs too fine a mesh; none is made."""
    if not (is_elastic(scene) and (scene.has("casing_on_mounts") or "mass" in scene.ask.quantities)):
        return []
    from trochoid.drives.casing_body import box_casing, mesh_edge
    from trochoid.geometry.casing_limits import fail_if_edge_too_long, fail_if_impossible
    from trochoid.geometry.casing_surface import points_off

    table = casing_table(scene)
    try:
        box = box_casing(table)
        if box is None:
            return []
        fail_if_impossible(box)
    except Infeasible as fault:
        return [str(fault)]
    edge = mesh_edge(table, box)
    found = [_off_the_underside(mount, box.low[1], max(box.size)) for mount in table.mounts]
    found += [_said(lambda: fail_if_edge_too_long(box, edge)), _too_fine(box, edge)]
    found += points_off(box, {point.name: point.position for point in table.points})
    return [said for said in found if said]


def _said(look: Callable[[], None]) -> str:
    try:
        look()
    except Infeasible as fault:
        return str(fault)
    return ""


def _off_the_underside(mount: MountTable, underside: float, side: float) -> str:
    """Say that a mount is not where a box has its feet: springs would pull elsewhere than they hold."""
    if abs(mount.position[1] - underside) <= AT * side:
        return ""
    return (
        f"casing: {mount.name} is at y = {1e3 * mount.position[1]:g} mm, but a box stands on its underside; "
        f"give y = {1e3 * underside:g} mm"
    )


def _too_fine(box: BoxCasing, edge: float) -> str:
    least = least_edge(box.size)
    if edge >= least:
        return ""
    given = f"edges of the mesh of {1e3 * edge:.3g} mm need more than {MOST_MEMORY / 1024.0:g} GiB of memory"
    return f"casing: {given}; give mesh_edge = {1e3 * least:.2g} mm or more"

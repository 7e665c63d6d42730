"""An elastic casing from a scene: meshed or read, reduced to its bores, feet and modes, with its variants."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from trochoid.clock import Clock
from trochoid.drives.casing import (
    FREE,
    RIGID_CASING,
    RIGID_MOUNTS,
    Shaken,
    Triple,
    casing_table,
    is_elastic,
    rigid_shaken,
)
from trochoid.drives.mesh_error import Pair
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import BAND, Point
from trochoid.kinematics.errors import TrochoidError
from trochoid.scene import Casing as CasingTable
from trochoid.scene import Scene

if TYPE_CHECKING:
    from trochoid.dynamics.structure import Structure
    from trochoid.fem.reduction import Reduced
    from trochoid.fem.solid import SolidBody
    from trochoid.geometry.casing_box import BoxCasing
    from trochoid.geometry.solid_mesh import SolidMesh
    from trochoid.geometry.solid_places import Place

UPPER, LEAST = 6.0 * BAND[1], 2.0 * BAND[1]  # Hz: up to where modes are kept, with bores and feet held
TRUE = 1.0 / 3.0  # of that frequency: up to where those of the casing are those of the whole model
COMPARED = 2.0 * BAND[1]  # Hz: up to where frequencies are reported
COARSER = 2.0  # times the edges of the mesh, on the level that tells the error
LARGEST = 60_000  # degrees of freedom of a mesh from a file up to which the whole model is factored once more
REDUCED = 0.01  # of a natural frequency, what the reduction may cost


def casing_body(scene: Scene[Any], clock: Clock) -> SolidBody:
    """Return the elastic casing as a body, in the stage "casing mesh"."""
    with clock.stage("casing mesh"):
        return meshed(scene)


def casings(scene: Scene[Any], clock: Clock, body: Callable[[], SolidBody]) -> Pair[Shaken]:
    """Return the casing of a scene; an elastic box also on a coarser mesh, in the stage "casing".

    The whole model is factored once more, to tell what the reduction costs: of the coarser mesh, or of one from a file
    that is not too large. Where the measures allow no coarser mesh there is one level.
    """
    if not is_elastic(scene):
        return Pair(rigid_shaken(scene), None)
    made = body()
    with clock.stage("casing"):
        small = made.size <= LARGEST
        if casing_table(scene).box is None:
            return Pair(elastic_shaken(scene, made, small), None)
        try:
            other = meshed(scene, coarser=True)
            if other.mesh.points.shape == made.mesh.points.shape:
                raise TrochoidError("edges twice as long leave it as it is")
            coarse = elastic_shaken(scene, other, True)
        except TrochoidError as fault:
            return Pair(replace(elastic_shaken(scene, made, small), alone=str(fault)), None)
        return Pair(replace(elastic_shaken(scene, made, False), error=coarse.error), coarse)


def box_casing(table: CasingTable) -> BoxCasing | None:
    """Return the measures of a box casing; None for one from a file."""
    if table.box is None:
        return None
    from trochoid.geometry.casing_box import Bore, BoxCasing, MountPlace

    bores = [
        Bore(b.name, b.wall, b.radius, b.boss, b.length, b.x, b.y)
        for b in table.bores
        if b.wall is not None and b.radius is not None and b.boss is not None and b.length is not None
    ]
    mounts = [
        MountPlace(m.name, m.position[0], m.position[2], m.radius)
        for m in table.mounts
        if m.name is not None and m.radius is not None
    ]
    box = table.box
    return BoxCasing(box.size, box.wall, tuple(bores), tuple(mounts), box.center, box.base, box.flange)


def meshed(scene: Scene[Any], coarser: bool = False) -> SolidBody:
    """Return the elastic casing as a finite-element body; a box on request with edges twice as long.

    Raises Infeasible for measures that cannot be, TrochoidError for a file that has no body or not these places.
    """
    from trochoid.fem.material import Material
    from trochoid.fem.solid import solid_body

    table = casing_table(scene)
    made = scene.materials[table.material]
    mesh = _mesh(table, coarser)
    return solid_body(mesh, Material(made.youngs_modulus, made.poissons_ratio, made.density))


def _mesh(table: CasingTable, coarser: bool) -> SolidMesh:
    box = box_casing(table)
    if box is None:
        from trochoid.geometry.solid_file import read_solid
        from trochoid.scene.casing import METRES

        return read_solid(table.mesh_file or "", METRES[table.mesh_unit], _found_places(table))
    from trochoid.geometry.casing_mesh import mesh_casing

    edge = mesh_edge(table, box)
    return mesh_casing(box, COARSER * edge if coarser else edge)


def mesh_edge(table: CasingTable, box: BoxCasing) -> float:
    """Return the length of the edges of a box's mesh, m."""
    from trochoid.geometry.casing_limits import EDGES
    from trochoid.geometry.casing_mesh import COARSE

    usual = min(COARSE * box.wall, min(box.size) / EDGES)
    return usual if table.mesh_edge is None else table.mesh_edge


def _found_places(table: CasingTable) -> dict[str, Place]:
    """Return bores and mounts that are found by their shape in a mesh from a file."""
    from trochoid.geometry.solid_places import Cylinder, Disc

    places: dict[str, Place] = {}
    for bore in table.bores:
        if bore.point is not None and bore.direction is not None and bore.radius is not None:
            given = () if bore.span is None else (bore.span,)
            places[bore.name] = Cylinder(bore.point, bore.direction, bore.radius, *given)
    for mount in table.mounts:
        if mount.name is not None and mount.normal is not None and mount.radius is not None:
            places[mount.name] = Disc(mount.position, mount.normal, mount.radius)
    return places


def elastic_shaken(scene: Scene[Any], body: SolidBody, compare: bool) -> Shaken:
    """Return the elastic casing reduced to its bores, feet and modes; `compare`: with the whole model.

    Raises TrochoidError for a point off the body, Infeasible for places that meet.
    """
    from trochoid.dynamics.structure import elastic_casing, rigid_casing
    from trochoid.fem.reduction import reduce
    from trochoid.fem.solid_interface import Interface
    from trochoid.geometry.solid_places import patch

    table = casing_table(scene)
    middles, sets = _places(table, body.mesh)
    off = []
    for point in table.points:
        try:
            patch(body.mesh, point.position, name=point.name)
        except TrochoidError as fault:
            off.append(str(fault))
    if off:
        raise TrochoidError("\n".join(off))
    places = [Interface(name, middles[name], body.mesh.sets[sets[name]]) for name in middles]
    reduced = reduce(body, places, UPPER, least=LEAST)
    mounts = {m.name or "": Mount(m.position, m.stiffness, m.damping) for m in table.mounts}
    points, ratio = {p.name: p.position for p in table.points}, table.damping_ratio or 0.0
    firm = [name for name, mount in mounts.items() if any(mount.stiffness)]
    variants: dict[str, Casing | Structure] = {RIGID_CASING: rigid_casing(reduced, mounts)}
    if firm:
        variants[RIGID_MOUNTS] = elastic_casing(reduced, {}, points, ratio, firm)
    if firm or any(any(mount.damping) for mount in mounts.values()):
        variants[FREE] = elastic_casing(reduced, {}, points, ratio)
    frequencies, error = _frequencies(reduced, compare)
    box = box_casing(table)
    return Shaken(
        elastic_casing(reduced, mounts, points, ratio),
        variants,
        tuple(Point(name, at) for name, at in points.items()),
        {bore.name: middles[bore.name] for bore in table.bores},
        {bore.name: bore.seats for bore in table.bores},
        frequencies,
        error,
        None if box is None else mesh_edge(table, box),
    )


def _places(table: CasingTable, mesh: SolidMesh) -> tuple[dict[str, Triple], dict[str, str]]:
    """Return the middles of bores and mounts, m, and the mesh's sets of their nodes, by name."""
    from trochoid.geometry.casing_box import centers
    from trochoid.geometry.solid_places import middle

    box = box_casing(table)
    places = [(b.name, b.set or b.name) for b in table.bores]
    places += [(m.name or "", m.set or m.name or "") for m in table.mounts]
    sets = dict(places)
    unknown = sorted({name for name in sets.values() if name not in mesh.sets})
    if unknown:
        raise TrochoidError(
            f"casing: {table.mesh_file} has no set {', '.join(map(repr, unknown))}; "
            f"there are {', '.join(mesh.sets) or 'none'}"
        )
    return (centers(box) if box is not None else {n: middle(mesh, s) for n, s in sets.items()}), sets


def _frequencies(reduced: Reduced, compare: bool) -> tuple[tuple[float, ...], float | None]:
    """Return the elastic frequencies of the free casing up to COMPARED, and how far the lower ones are off."""
    from trochoid.dynamics.modes import natural_modes
    from trochoid.fem.reduction_error import FREE as RIGID_MOTIONS
    from trochoid.fem.reduction_error import reduction_error

    hertz = natural_modes(reduced.mass, reduced.stiffness).hertz[RIGID_MOTIONS:]
    low = tuple(hertz[hertz <= COMPARED].tolist())
    count = int((hertz <= min(COMPARED, TRUE * reduced.upper)).sum())
    if not count:
        return low, 0.0
    return low, float(reduction_error(reduced, count).relative.max()) if compare else None

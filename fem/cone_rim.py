"""From the shape of a rim to its compliance: mesh, factor, condense, and all teeth by symmetry."""

from __future__ import annotations

from dataclasses import dataclass, replace

from trochoid.fem.cone_body import ConeBody, cone_body
from trochoid.fem.cone_flank import SPREAD, Flank, flank
from trochoid.fem.cone_layers import layers
from trochoid.fem.cone_ring import full_rim, row_of_teeth
from trochoid.fem.cone_sector import DEGREE, Sector, condense, station_loads
from trochoid.fem.cone_table import RimCompliance, rim_compliance
from trochoid.fem.material import Material
from trochoid.geometry.quality import Quality
from trochoid.geometry.sphere_mesh import mesh_sphere, sphere_quality
from trochoid.geometry.sphere_outline import sector_outline
from trochoid.geometry.sphere_rim import RimShape


@dataclass(frozen=True, slots=True)
class RimSize:
    """A rim between the distances `inner` and `outer` (m) from O, pressed by rollers over `reach` (None: all of it).

    `web` is the part of the hub's cone that is held, None all of it; `teeth` of a row with free ends, None for the
    full rim.
    """

    inner: float
    outer: float
    reach: tuple[float, float] | None = None
    web: tuple[float, float] | None = None
    teeth: int | None = None


@dataclass(frozen=True, slots=True)
class RimMesh:
    """How fine: `facets` on each tooth, `layers` between the spheres, `growth` of elements away from the flank.

    Contacts have slices of a layer's `parts`: several where rollers are crowned so much that they touch over little,
    and slices as short as `spot` (m; 0: none) about the middle of the rollers, where a slight load is all they carry.
    """

    facets: int = 28
    layers: int = 9
    growth: float = 1.3
    parts: int = 1
    degree: int = DEGREE
    spread: float = SPREAD
    spot: float = 0.0

    @property
    def coarser(self) -> RimMesh:
        """The mesh whose difference from this one estimates the error."""
        return replace(
            self, facets=max(6, self.facets // 2), layers=max(3, self.layers // 2), spot=2.0 * self.spot
        )


@dataclass(frozen=True, eq=False, slots=True)
class Rim:
    """A rim that was pressed: its compliance, the degrees of freedom and the mesh quality of one tooth.

    `body`, `side` and `sector` are that tooth's elements, pressed side and superelement, `degree` that of its cuts.
    """

    compliance: RimCompliance
    shape: RimShape
    dofs: int
    quality: Quality
    body: ConeBody
    side: Flank
    sector: Sector
    degree: int


def press_rim(
    shape: RimShape, size: RimSize, material: Material, mesh: RimMesh | None = None, solver: str | None = None
) -> Rim:
    """Return the compliance between all places of all teeth.  Raises Infeasible or TrochoidError."""
    mesh = RimMesh() if mesh is None else mesh
    plane = mesh_sphere(sector_outline(shape, mesh.facets, 1, mesh.growth), mesh.growth)
    ends = () if size.reach is None else size.reach
    web = () if size.web is None else size.web
    radial = layers(size.inner, size.outer, mesh.layers, (*ends, *web))
    body = cone_body(plane, radial, material, web=size.web)
    side = flank(plane, shape.tooth, spread=mesh.spread, cut=shape.edges)
    loads = station_loads(side, body, size.reach)
    sector = condense(body, loads, shape.pitch, mesh.degree, solver)
    teeth = shape.tooth.lobes if size.teeth is None else size.teeth
    coupling = full_rim(sector, teeth) if size.teeth is None else row_of_teeth(sector, teeth)
    compliance = rim_compliance(body, side, coupling, loads.slices, mesh.parts, mesh.spot)
    return Rim(compliance, shape, body.size, sphere_quality(plane), body, side, sector, mesh.degree)

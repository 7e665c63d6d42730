"""The discs as elastic bodies: outline, mesh, factor and compliance of each distinct one."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.khv.contact import plane
from trochoid.drives.khv.design import Design
from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import Compliance, press
from trochoid.fem.position import ElasticBody
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Outline
from trochoid.kinematics.errors import NotConverged

LOPSIDED = 0.2  # compliance against its transpose; 0.01 is usual


@dataclass(frozen=True, slots=True)
class Level:
    """All distinct discs on one mesh level."""

    facets_per_lobe: int
    meshes: tuple[Mesh, ...]
    bodies: tuple[Body, ...]
    elastic: tuple[ElasticBody, ...]

    @property
    def rubs(self) -> bool:
        """Whether the discs were pressed along their surfaces too."""
        return all(body.compliance.tangential is not None for body in self.elastic)


def outlines(design: Design, facets_per_lobe: int) -> tuple[Outline, ...]:
    """Return the outline of each distinct disc."""
    return tuple(design.outline(body, facets_per_lobe) for body in range(len(design.hole_angles)))


def meshes(design: Design, facets_per_lobe: int) -> tuple[Mesh, ...]:
    """Mesh each distinct disc."""
    return tuple(mesh_outline(outline) for outline in outlines(design, facets_per_lobe))


def build_level(
    design: Design, facets_per_lobe: int, made: tuple[Mesh, ...], tangential: bool = False
) -> Level:
    """Factor the discs and press them at every station; with `tangential` along the surface too, for friction."""
    bodies = tuple(build_body(mesh, plane(design)) for mesh in made)
    elastic = tuple(
        ElasticBody(
            _resolved(press(body, outline.loops, tangential), design, facets_per_lobe),
            design.drive.face_width,
        )
        for body, outline in zip(bodies, outlines(design, facets_per_lobe), strict=True)
    )
    return Level(facets_per_lobe, made, bodies, elastic)


def _resolved(compliance: Compliance, design: Design, facets_per_lobe: int) -> Compliance:
    """Refuse a compliance that is far from symmetric: the mesh does not see how sharply the flank bends."""
    if compliance.asymmetry <= LOPSIDED:
        return compliance
    flank = design.flank
    raise NotConverged(
        f"the discs' compliance is not resolved with {facets_per_lobe} facets per lobe: it differs by "
        f"{compliance.asymmetry:.0%} from its transpose; keep drive.pin_radius = {1e3 * flank.pin_radius:.6g} mm "
        f"farther from the undercut limit {1e3 * flank.undercut_radius:.6g} mm, where the flank bends sharply, or "
        "set a larger accuracy.tolerance"
    )

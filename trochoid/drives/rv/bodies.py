"""The discs as elastic bodies: outline, mesh, factor and compliance of each distinct one."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.rv.contact import plane
from trochoid.drives.rv.design import Design
from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import press
from trochoid.fem.position import ElasticBody
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Outline
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

LOPSIDED = 0.2  # compliance against its transpose; 0.01 is usual


@dataclass(frozen=True, slots=True)
class Level:
    """All distinct discs on one mesh level, and the stiffness of one mesh of sun and planet, N/m.

    `cranks`: that of the crankshafts' bearings where rolling ones tell it, see `supports`.
    """

    facets_per_lobe: int
    bodies: tuple[Body, ...]
    elastic: tuple[ElasticBody, ...]
    teeth: float
    cranks: Array | None = None


def meshes(design: Design, facets_per_lobe: int) -> tuple[Mesh, ...]:
    """Mesh each distinct disc."""
    return tuple(mesh_outline(outline) for outline in _outlines(design, facets_per_lobe))


def _outlines(design: Design, facets_per_lobe: int) -> tuple[Outline, ...]:
    return tuple(design.outline(body, facets_per_lobe) for body in range(len(design.hole_angles)))


def build_level(design: Design, facets_per_lobe: int, made: tuple[Mesh, ...], teeth: float) -> Level:
    """Factor the discs and press them at every station of flank and crank holes; windows and bore stay free.

    Raises NotConverged for a compliance that is far from symmetric: the mesh does not see how sharply a flank bends.
    """
    bodies, elastic = [], []
    for mesh, outline in zip(made, _outlines(design, facets_per_lobe), strict=True):
        pressed = [loop for loop in outline.loops if loop.name == "flank" or loop.name.startswith("hole")]
        bodies.append(build_body(mesh, plane(design)))
        compliance = press(bodies[-1], pressed)
        if compliance.asymmetry > LOPSIDED:
            raise NotConverged(
                f"the discs' compliance is not resolved with {facets_per_lobe} facets per lobe: it differs by "
                f"{compliance.asymmetry:.0%} from its transpose; keep cycloid.pin_radius farther from the undercut "
                f"limit {1e3 * design.flank.undercut_radius:.6g} mm, or set a larger accuracy.tolerance"
            )
        elastic.append(ElasticBody(compliance, design.drive.cycloid.face_width))
    return Level(facets_per_lobe, tuple(bodies), tuple(elastic), teeth)

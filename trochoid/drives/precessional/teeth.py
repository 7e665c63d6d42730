"""The toothed rim and the rollers of a scene as elastic bodies, on one mesh level."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.rim import crowning, play, reach, rim_shape, toothed, web
from trochoid.fem.cone_position import RIGID_ROLLER, Roller
from trochoid.fem.cone_rim import Rim, RimMesh, RimSize, press_rim
from trochoid.fem.cone_roller import closed_form_roller, press_roller
from trochoid.fem.material import Material

LAYERS = 10 / 32  # for each facet of a tooth
CROWNED_PARTS = 8  # slices of a layer, for crowned rollers: 100 µm of crown leave a third of them pressed
LEAST = 12  # facets: half of them tell the error, and the outline needs 6


@dataclass(frozen=True, eq=False, slots=True)
class Level:
    """Rim and rollers with so many `facets` on each tooth."""

    facets: int
    rim: Rim
    roller: Roller


def build_level(design: Design, facets: int) -> Level:
    """Mesh, factor and condense one tooth, and make the rim and the rollers of it."""
    tooth, teeth = toothed(design)
    given = design.scene.materials[design.scene.drive.material]
    material = Material(given.youngs_modulus, given.poissons_ratio, given.density)
    parts = CROWNED_PARTS if crowning(design) > 0.0 else 1
    size = RimSize(teeth.inner_radius, teeth.outer_radius, reach(design), web(design))
    mesh = RimMesh(facets, max(3, round(LAYERS * facets)), parts=parts)
    rim = press_rim(rim_shape(design), size, material, mesh)
    if not design.scene.has("pin_compliance"):
        return Level(facets, rim, RIGID_ROLLER)
    bore = design.scene.drive.rollers.bore_angle
    if bore is None:
        return Level(facets, rim, closed_form_roller(material))
    angles = tooth.pin_angle - play(design), bore
    return Level(facets, rim, press_roller(rim.compliance.layers, angles, material, parts=parts))

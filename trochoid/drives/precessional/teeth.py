"""The toothed rim and the rollers of a scene as elastic bodies, on one mesh level."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.rim import crowning, lean, play, reach, rim_shape, toothed, web
from trochoid.fem.cone_assembly import RIGID_ROLLER, Roller
from trochoid.fem.cone_rim import Rim, RimMesh, RimSize, press_rim
from trochoid.fem.cone_roller import closed_form_roller, press_roller
from trochoid.fem.material import Material

LAYERS = 10 / 32  # for each facet of a tooth
CROWNED_PARTS = 8  # slices of a layer, for crowned rollers: 100 µm of crown leave a third of them pressed
SPOT, FINE = 8.0, 32  # slices over half of a contact with so many facets
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
    spot = _spot(design, material, facets)
    size = RimSize(teeth.inner_radius, teeth.outer_radius, reach(design), web(design))
    mesh = RimMesh(facets, max(3, round(LAYERS * facets)), parts=parts, spot=spot)
    rim = press_rim(rim_shape(design), size, material, mesh)
    if not design.scene.has("pin_compliance"):
        return Level(facets, rim, RIGID_ROLLER)
    bore = design.scene.drive.rollers.bore_angle
    if bore is None:
        return Level(facets, rim, _seated(design, closed_form_roller(material)))
    angles = tooth.pin_angle - play(design), bore
    roller = press_roller(rim.compliance.layers, angles, material, parts=parts, spot=spot)
    return Level(facets, rim, _seated(design, roller))


def _seated(design: Design, roller: Roller) -> Roller:
    """Return the roller on what gives way under its pin; None in the scene is rigid."""
    stiffness = design.scene.drive.rollers.seat_stiffness
    return roller if stiffness is None else replace(roller, seat=1.0 / stiffness)


def _spot(design: Design, material: Material, facets: int) -> float:
    """Return the length (m) of the slices in the middle of crowned rollers, 0 where they touch over much.

    Half of their contact is about a = (11 A R F)^(1/3) long, from δ ≈ 9 A F/1.6a and a² = 2Rδ: A is 2/(πE') of both,
    R the radius of the crown, F the largest force where all rollers with a lever share the torque.
    """
    depth, torque = crowning(design), abs(design.scene.operation.output_torque)
    if (
        depth == 0.0 or torque == 0.0 or any(lean(design))
    ):  # leaning rollers touch elsewhere than in the middle
        return 0.0
    _, teeth = toothed(design)
    low, high = reach(design) or (teeth.inner_radius, teeth.outer_radius)
    force = largest_force(design, torque)
    kernel = (2.0 if design.scene.has("pin_compliance") else 1.0) * material.plane("strain").kernel
    length = float(np.cbrt(11.0 * kernel * (0.5 * (high - low)) ** 2 / (2.0 * depth) * force))
    spot = length / SPOT * FINE / facets
    usual = (high - low) / (max(3, round(LAYERS * facets)) * CROWNED_PARTS)
    return spot if spot < usual else 0.0


def largest_force(design: Design, torque: float) -> float:
    """Return the largest force (N) of a roller where all that have a lever share the torque (N·m) by it."""
    tooth, _ = toothed(design)
    lever = np.abs(tooth.lever(tooth.contact_parameter(np.arange(tooth.pins), 0.0)))
    return abs(torque) / design.tooth_radius * float(lever.max() / (0.5 * lever @ lever))

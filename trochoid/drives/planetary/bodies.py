"""Sun, planet and ring as elastic bodies on one mesh level; all planets are one body."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.planetary.design import Design
from trochoid.fem.gear_body import GearBody, press_gear
from trochoid.fem.gear_flank import Relief
from trochoid.fem.gear_mesh import Wheel
from trochoid.fem.material import Material, Plane
from trochoid.geometry.gear_outline import Blank
from trochoid.geometry.gear_tooth import Tooth, sharpest
from trochoid.geometry.planetary_curves import Members

BENT = 1.0  # share of a tip relief over which it bends: a parabola, whose curvature has no steps within the relief


@dataclass(frozen=True, slots=True)
class Level:
    """The three wheels with `facets` per flank."""

    facets: int
    wheels: tuple[Wheel, Wheel, Wheel]


def plane(design: Design) -> Plane:
    """Return the plane moduli of the wheels."""
    given = design.scene.materials[design.drive.material]
    made = Material(given.youngs_modulus, given.poissons_ratio, given.density)
    return made.plane(design.drive.plane)


def blanks(design: Design, curves: Members) -> tuple[Blank, Blank, Blank]:
    """Return teeth with rounded tip edges and the rims below them; raises Infeasible."""
    d, (bore_sun, bore_planet, outer) = design.drive, design.bores
    tips = [float(tip) for tip in design.geometry.tips]
    made = []
    for curve, tip, rim in zip((curves.sun, curves.planet, curves.ring), tips, (bore_sun, bore_planet, outer), strict=True):
        gear = curve.cut.gear
        rounding = sharpest(gear) if d.tip_rounding is None else d.tip_rounding
        made.append(Blank(Tooth(curve.cut, tip, rounding), rim))
    return made[0], made[1], made[2]


def build_level(design: Design, curves: Members, facets: int) -> Level:
    """Mesh and press the wheels; raises Infeasible, TrochoidError."""
    moduli, width = plane(design), design.drive.face_width
    made = [press_gear(blank, moduli, facets, held) for blank, held in zip(blanks(design, curves), held_rims(design), strict=True)]
    sun, planet, ring = (Wheel.of(body, width, reliefs(design, body, k)) for k, body in enumerate(made))
    return Level(facets, (sun, planet, ring))


def held_rims(design: Design) -> tuple[bool, bool, bool]:
    """Whether the rims' edges are fixed: bores sit on stiff shafts and pins, the ring in its casing as the scene says."""
    return True, True, design.drive.ring.held == "edge"


def reliefs(design: Design, body: GearBody, wheel: int) -> tuple[Relief, ...]:
    """Return the tip relief of sun, planet or ring (0, 1, 2): none without the effect "clearance"."""
    d = design.drive
    amount = (d.sun, d.planet, d.ring)[wheel].tip_relief
    if amount == 0.0 or not design.scene.has("clearance"):
        return ()
    tooth = body.blank.tooth
    return (Relief(tooth.end - tooth.gear.side * design.relief_length, tooth.end, amount, BENT),)

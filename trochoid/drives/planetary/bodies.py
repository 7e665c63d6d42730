"""Sun, planet and ring as elastic bodies on one mesh level; all planets are one body."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.planetary.blanks import blanks
from trochoid.drives.planetary.design import Design
from trochoid.fem.gear_body import GearBody, press_gear
from trochoid.fem.gear_flank import Relief
from trochoid.fem.gear_mesh import Wheel
from trochoid.fem.material import Material, Plane
from trochoid.geometry.planetary_curves import Members
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError

TRIES = 6  # numbers of facets, one after the other
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


def build_level(design: Design, curves: Members, facets: int) -> Level:
    """Mesh and press the wheels with `facets` per flank, or a few more where so many make curved elements fold.

    Raises Infeasible, NotConverged.
    """
    said = ""
    for more in range(TRIES):
        try:
            return _level(design, curves, facets + more)
        except (Infeasible, NotConverged):
            raise
        except TrochoidError as error:
            said = str(error)
    sharp = design.given.cutter.rounding == 0.0
    advice = (
        f"the cutter's sharp tips leave fillets that a mesh does not follow; give drive.ring_cutter.tip_rounding, some "
        f"{100.0 * design.drive.module:.3g} mm, or more accuracy.facets_per_lobe"
        if sharp
        else "give more accuracy.facets_per_lobe"
    )
    raise NotConverged(
        f"the wheels cannot be meshed with {facets} to {facets + TRIES - 1} facets per flank ({said}); {advice}"
    )


def _level(design: Design, curves: Members, facets: int) -> Level:
    moduli, width = plane(design), design.drive.face_width
    shapes, held = blanks(design, curves), held_rims(design)
    # the ring first: its sharp fillets are what a mesh may fail at
    made = {k: press_gear(shapes[k], moduli, facets, held[k]) for k in (2, 0, 1)}
    sun, planet, ring = (Wheel.of(made[k], width, reliefs(design, made[k], k)) for k in range(3))
    return Level(facets, (sun, planet, ring))


def held_rims(design: Design) -> tuple[bool, bool, bool]:
    """Whether the rims' edges are fixed: bores sit on stiff shafts and pins, the ring is held as the scene says."""
    return True, True, design.drive.ring.held == "edge"


def reliefs(design: Design, body: GearBody, wheel: int) -> tuple[Relief, ...]:
    """Return the tip relief of sun, planet or ring (0, 1, 2): none without the effect "clearance"."""
    d = design.drive
    amount = (d.sun, d.planet, d.ring)[wheel].tip_relief
    if amount == 0.0 or not design.scene.has("clearance"):
        return ()
    tooth = body.blank.tooth
    return (Relief(tooth.end - tooth.gear.side * design.relief_length, tooth.end, amount, BENT),)

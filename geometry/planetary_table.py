"""The 65 numbers of the sources' Table 1 (§4), as they are right or as the source has them.

The source counts with two different planet tips: it draws d_a2 = 66.000 and takes 66.159 for the mesh with the
ring.  It also has the ring's constant chord with +x.  Where it is given as it prints, `printed` says so.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from trochoid.geometry.planetary import Planetary
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_measure import Chord, OverPins, Span, constant_chord, over_pins, span

Three = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Table:
    """Table 1; triples are sun, planet, ring; lengths and thicknesses in m, angles in rad, shifts in modules.

    Radii of curvature: ρ_s at the constant chord, ρ_p where the active flank ends, ρ_w where the span touches,
    ρ_a at the tip, ρ_m at the roller, ρ_l where the involute begins.
    """

    ratios: tuple[float, float]
    reference_diameter: Three
    tip_diameter: Three
    root_diameter: Three
    pitch_diameter: Three
    operating_angle: float
    chord: Three
    chord_height: Three
    rho_s: Three
    rho_p: Three
    span_teeth: tuple[int, int, int]
    span: Three
    rho_w: Three
    rho_a: Three
    roller: float
    roller_angle: Three
    roller_circle: Three
    rho_m: Three
    over_rollers: Three
    thickness: Three
    least_shift: tuple[float, float]
    rho_l: Three
    tip_thickness: Three
    contact_ratios: tuple[float, float]


def table(set_: Planetary, roller: float, printed: bool = False) -> Table:
    """Table 1 of a set with a roller diameter (m); `printed` gives the source's planet tip and ring chord."""
    gears, tips = set_.gears, set_.tips
    sun, planet, ring = gears
    ring_side_tip = set_.planet_tip_for_ring if printed else tips[1]
    chords = [constant_chord(g, tip) for g, tip in zip(gears, tips, strict=True)]
    if printed:
        chords[2] = _chord_with_plus(ring, tips[2])
    spans = [span(g) for g in gears]
    pins = [over_pins(g, roller) for g in gears]
    low_sun, low_planet = set_.outer.lowest(tips[0], tips[1])
    _, low_ring = set_.inner.lowest(ring_side_tip, tips[2])
    pitch_sun, pitch_planet = set_.outer.pitch_radii
    return Table(
        ratios=(set_.outer.ratio, set_.inner.ratio),
        reference_diameter=_three([2.0 * g.pitch_radius for g in gears]),
        tip_diameter=_three([2.0 * tip for tip in tips]),
        root_diameter=_three([2.0 * root for root in set_.roots]),
        pitch_diameter=_three([2.0 * pitch_sun, 2.0 * pitch_planet, 2.0 * set_.inner.pitch_radii[1]]),
        operating_angle=float(set_.outer.operating_angle),
        chord=_of(chords, "length"),
        chord_height=_of(chords, "height"),
        rho_s=_of(chords, "curvature_radius"),
        rho_p=_three([low_sun, low_planet, low_ring]),
        span_teeth=(spans[0].teeth, spans[1].teeth, spans[2].teeth),
        span=_of(spans, "length"),
        rho_w=_of(spans, "curvature_radius"),
        rho_a=_three([g.curvature_radius(tip) for g, tip in zip(gears, tips, strict=True)]),
        roller=roller,
        roller_angle=_of(pins, "pressure_angle"),
        roller_circle=_of(pins, "center_diameter"),
        rho_m=_of(pins, "curvature_radius"),
        over_rollers=_of(pins, "size"),
        thickness=_three([g.thickness for g in gears]),
        least_shift=(sun.least_shift, planet.least_shift),
        rho_l=_three(list(set_.boundaries)),
        tip_thickness=_three([g.thickness_at(tip) for g, tip in zip(gears, tips, strict=True)]),
        contact_ratios=(
            float(set_.outer.contact_ratio(tips[0], tips[1])),
            float(set_.inner.contact_ratio(ring_side_tip, tips[2])),
        ),
    )


def _chord_with_plus(ring: Gear, tip: Any) -> Chord:
    """The ring's constant chord as printed: with the thickness of its space (+x) on its tooth."""
    wrong = replace(ring, shift=-ring.shift)
    chord = constant_chord(wrong, tip)
    return chord


def _of(items: list[Chord] | list[Span] | list[OverPins], name: str) -> Three:
    return _three([getattr(item, name) for item in items])


def _three(values: list[Any]) -> Three:
    sun, planet, ring = values
    return float(sun), float(planet), float(ring)

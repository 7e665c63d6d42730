"""What the wheels' bodies are cut from: teeth with rounded tip edges, and the rims below them."""

from __future__ import annotations

from trochoid.drives.planetary.design import Design
from trochoid.geometry.gear_outline import Blank
from trochoid.geometry.gear_tooth import Tooth, sharpest
from trochoid.geometry.planetary_curves import Members


def blanks(design: Design, curves: Members) -> tuple[Blank, Blank, Blank]:
    """Return teeth with rounded tip edges and the rims below them; raises Infeasible."""
    d, (bore_sun, bore_planet, outer) = design.drive, design.bores
    tips = [float(tip) for tip in design.geometry.tips]
    made = []
    for curve, tip, rim in zip(
        (curves.sun, curves.planet, curves.ring), tips, (bore_sun, bore_planet, outer), strict=True
    ):
        gear = curve.cut.gear
        rounding = sharpest(gear) if d.tip_rounding is None else d.tip_rounding
        made.append(Blank(Tooth(curve.cut, tip, rounding), rim))
    return made[0], made[1], made[2]

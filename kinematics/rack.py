"""The basic rack as a tool (GOST 13755): straight flanks, rounded tips; what it cuts into external teeth."""

from __future__ import annotations

import math
from dataclasses import dataclass

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_cut import Cut, Fillet, trimmed


@dataclass(frozen=True, slots=True)
class Rack:
    """Rack tool; coefficients are multiples of the module: tip height h_a0* = h_a* + c*, tip rounding ρ_f*."""

    module: float
    pressure_angle: float = math.radians(20.0)
    tip_height: float = 1.25
    rounding: float = 0.38

    def __post_init__(self) -> None:
        """Refuse a tip that is too round for its width."""
        sine, cosine = math.sin(self.pressure_angle), math.cos(self.pressure_angle)
        half = 0.25 * math.pi - self.tip_height * math.tan(self.pressure_angle)  # of the tip land, in modules
        limit = half * cosine / (1.0 - sine)
        if half < 0.0:
            allowed = 0.25 * math.pi / math.tan(self.pressure_angle)
            raise Infeasible(
                f"rack tip height {self.tip_height:g}: its teeth end in a point at {allowed:.4g}"
            )
        if not 0.0 <= self.rounding <= limit * (1.0 + 1e-12):
            raise Infeasible(f"rack tip rounding {self.rounding:g}: it must lie between 0 and {limit:.4g}")

    @property
    def straight(self) -> float:
        """Height h_l* = h_a0* − ρ_f*(1 − sin α) of the rack's tip side up to which its flank is straight."""
        return self.tip_height - self.rounding * (1.0 - math.sin(self.pressure_angle))


def rack_cut(gear: Gear, rack: Rack) -> Cut:
    """What `rack` leaves in a space of an external `gear`; an undercut flank is trimmed. Raises Infeasible."""
    if gear.internal:
        raise Infeasible("a rack cannot cut a ring; give a shaper cutter")
    if rack.module != gear.module or rack.pressure_angle != gear.pressure_angle:
        raise Infeasible("rack and gear have different module or pressure angle; give both the same")
    m, sine, cosine = gear.module, math.sin(gear.pressure_angle), math.cos(gear.pressure_angle)
    depth = rack.tip_height - rack.rounding  # of the centre of the rounding below the reference line
    width = 0.25 * math.pi - depth * sine / cosine - rack.rounding / cosine
    x = float(gear.shift)
    corner = m * complex(x - depth, width)
    root = gear.pitch_radius + m * (x - rack.tip_height)
    if root <= 0.0:
        least = rack.tip_height - 0.5 * gear.teeth
        raise Infeasible(f"shift {x:g} of {gear.teeth} teeth: no root is left; it must exceed {least:.4g}")
    r = gear.pitch_radius
    fillet = Fillet(
        pitch_radius=r,
        pitch_curvature=0.0,
        corner=corner,
        rounding=m * rack.rounding,
        sign=-1.0 if corner.real > 0.0 else 1.0,
        internal=False,
        root=corner.imag / r,
        end=(corner.imag + corner.real * cosine / sine) / r,
    )
    boundary = r * sine - m * (rack.straight - x) / sine
    return trimmed(Cut(gear, fillet, root, boundary, max(boundary, 0.0)))

"""The shaper cutter, an involute pinion as a tool; what it cuts into external teeth and into rings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear, inverse_involute, involute
from trochoid.kinematics.involute_cut import Cut, Fillet, trimmed
from trochoid.kinematics.involute_pair import Pair, mesh


@dataclass(frozen=True, slots=True)
class Shaper:
    """Shaper cutter: teeth z0, shift x0, tip diameter d_a0 and tip rounding, m; α and m of the gear's rack."""

    teeth: int
    shift: float
    tip_diameter: float
    rounding: float = 0.0

    def gear(self, work: Gear) -> Gear:
        """Return the cutter as a gear of the work's module and pressure angle."""
        return Gear(self.teeth, work.module, work.pressure_angle, self.shift, work.addendum, work.clearance)


def cutting_pair(work: Gear, shaper: Shaper) -> Pair:
    """Cutter and work in generation, at their own α_w0; raises Infeasible."""
    return mesh(shaper.gear(work), work)


def ring_root_radius(ring: Gear, shaper: Shaper) -> Any:
    """Root radius a_w0 + d_a0/2 (m) of a shaper-cut ring; nan for shifts (array) that cannot be cut."""
    return _distance(ring, shaper)[0] + 0.5 * shaper.tip_diameter


def ring_boundary(ring: Gear, shaper: Shaper) -> Any:
    """Radius of curvature ρ_l = a_w0 sin α_w0 + √(d_a0² − d_b0²)/2 (m) where a ring's involute ends.

    A tip rounded with ρ shortens the cutter's flank: √((d_a0/2 − ρ)² − r_b0²) + ρ stands for the root then.
    """
    distance, angle = _distance(ring, shaper)
    foot = 0.5 * shaper.tip_diameter - shaper.rounding
    return distance * np.sin(angle) + shaper.gear(ring).curvature_radius(foot) + shaper.rounding


def trimming(ring: Gear, shaper: Shaper) -> Any:
    """Radius of curvature a_w0 sin α_w0 (m) of a ring at which the cutter's involute ends on its base circle.

    A ring's tip nearer to the centre is trimmed by the cutter and no involute there.
    """
    distance, angle = _distance(ring, shaper)
    return distance * np.sin(angle)


def _distance(ring: Gear, shaper: Shaper) -> tuple[Any, Any]:
    """Centre distance (m) and pressure angle in generation, for arrays of shifts too."""
    teeth, alpha = ring.teeth - shaper.teeth, ring.pressure_angle
    if teeth <= 0:
        given = f"a cutter of {shaper.teeth} teeth in a ring of {ring.teeth}"
        raise Infeasible(f"{given}: take one of at most {ring.teeth - 1} teeth")
    inv = involute(alpha) + 2.0 * (ring.shift - shaper.shift) * math.tan(alpha) / teeth
    angle = inverse_involute(inv)
    return 0.5 * ring.module * teeth * math.cos(alpha) / np.cos(angle), angle


def shaper_cut(gear: Gear, shaper: Shaper) -> Cut:
    """What a shaper leaves in a space of `gear`; an undercut flank is trimmed. Raises Infeasible."""
    pair = cutting_pair(gear, shaper)
    tool, side = pair.first, gear.side
    flank, foot = _tip(tool, shaper)
    r0, r = (float(radius) for radius in pair.pitch_radii)
    alpha, roll = float(pair.operating_angle), (flank + shaper.rounding) / tool.base_radius
    # half a cutter tooth at its base circle, then the centre of the rounding, in the cutter's frame
    half = math.pi / tool.teeth - float(tool.base_angle)
    angle = half - roll + math.atan2(flank, tool.base_radius)
    center = complex(foot * math.cos(angle), foot * math.sin(angle))
    if angle < 0.0:
        point = tool.base_radius / np.cos(inverse_involute(half - shaper.rounding / tool.base_radius))
        given = f"cutter of {shaper.teeth} teeth with tip diameter {_mm(shaper.tip_diameter)}"
        raise Infeasible(f"{given}: its teeth end in a point at {_mm(2.0 * float(point + shaper.rounding))}")
    end = (alpha + half - roll) * r0 / r
    fillet = Fillet(
        pitch_radius=r,
        pitch_curvature=side / r0,
        corner=center - r0 if gear.internal else r0 - center.conjugate(),
        rounding=shaper.rounding,
        sign=1.0 if foot > r0 else -1.0,
        internal=gear.internal,
        root=angle * r0 / r,
        end=end,
    )
    depth = float(pair.center_distance)
    root = depth + 0.5 * shaper.tip_diameter if gear.internal else depth - 0.5 * shaper.tip_diameter
    boundary = float(pair.of_second(flank + shaper.rounding))
    return trimmed(Cut(gear, fillet, root, boundary, max(boundary, 0.0)))


def _tip(tool: Gear, shaper: Shaper) -> tuple[float, float]:
    """Tangent length (m) to the centre of the tip rounding, and that centre's radius (m)."""
    foot = 0.5 * shaper.tip_diameter - shaper.rounding
    if shaper.rounding < 0.0:
        raise Infeasible(f"cutter tip rounding {_mm(shaper.rounding)}: it must not be negative")
    if foot <= tool.base_radius:
        least = 2.0 * (tool.base_radius + shaper.rounding)
        given = f"cutter of {shaper.teeth} teeth with tip diameter {_mm(shaper.tip_diameter)}"
        raise Infeasible(f"{given}: its tip must lie outside the base circle, above {_mm(least)}")
    return math.sqrt(foot**2 - tool.base_radius**2), foot


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"

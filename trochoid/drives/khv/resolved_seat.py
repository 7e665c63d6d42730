"""The rollers of the eccentric bearing in the resolved solution: what of their contact the plane can have.

A roller between two raceways follows ISO/TS 16281, which comprises both line contacts. Its law stays, and only the
seat in the bore is taken from the refined disc: one unknown a roller, which presses the bore by a Hertz pressure
of the half width under a typical load. A roller on a rigid eccentric (no bearing_compliance) is a rigid circle,
and its contact is resolved; where it is shorter than the disc is wide, its load spreads as in `contact`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.contact import layout, nominal_roller_load, plane, roller_seat
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.spots import Spot
from trochoid.fem.bearing import EXPONENT
from trochoid.fem.laws import HertzLine, PowerLaw
from trochoid.fem.resolved import Facets, spread
from trochoid.fem.strips import curve_compliance
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class Seated:
    """A roller's law with the linear part that its seat in the finite elements lacks, in m/N."""

    roller: PowerLaw
    seat: float

    def approach(self, force: Array) -> tuple[Array, Array]:
        """Return approach and derivative."""
        delta, slope = self.roller.approach(force)
        return delta + self.seat * force, slope + self.seat


def has_law(design: Design, spot: Spot) -> bool:
    """Return whether a place is a roller under its law rather than a contact to be resolved."""
    return spot.kind == "bearing" and layout(design, "resolved").floating


def seat_half_width(design: Design, force: float | None = None) -> float:
    """Return the half width in m of a roller's contact with the bore, under its typical load when no force is given."""
    bearing = design.drive.eccentric_bearing
    radius = 1 / (1 / bearing.roller_radius - 1 / design.drive.bore_radius)
    kernel = 2 * plane(design).kernel / bearing.roller_length
    load = np.array([nominal_roller_load(design) if force is None else force])
    return float(HertzLine(np.array([kernel]), np.array([radius])).half_width(load)[0])


def bump(facets: Facets) -> Facets:
    """Return one unknown: a Hertz pressure over all facets of a window."""
    half = 0.5 * facets.length.sum()
    x = np.clip(np.append(facets.offset - 0.5 * facets.length, half) / half, -1.0, 1.0)
    return spread(facets, np.diff((x * np.sqrt(1 - x * x) + np.arcsin(x)) / np.pi))


def roller_law(design: Design) -> Seated:
    """Return ISO/TS 16281 less the standard's own seat, and what the middle of the pressure sinks more than its mean.

    `contact` closes its smooth seat with the logarithm at the middle of a Hertz pressure, (2/πE')(ln(2/a) + ½)
    per unit line load. Here the elements have that logarithm: the mean over the pressure, ln(2/a) + ¼.
    """
    rolling = roller_seat(design)
    law = PowerLaw(rolling.constant, EXPONENT)
    wide = plane(design).kernel / design.drive.face_width
    own = wide * (math.log(2 / seat_half_width(design)) + 0.5)
    exchanged = rolling.seat_for_seat(law, nominal_roller_load(design))
    return Seated(law, rolling.widening + exchanged - own + 0.25 * wide)


def spreading(design: Design, spot: Spot, facets: Facets) -> Array:
    """Return what a rigid roller shorter than the disc is wide adds (m, m), in m/N."""
    count, bearing = len(facets.length), design.drive.eccentric_bearing
    if has_law(design, spot) or bearing.roller_length >= design.drive.face_width:
        return np.zeros((count, count))
    share = plane(design).kernel * (1 / bearing.roller_length - 1 / design.drive.face_width)
    points = spot.curve.point(facets.middle)
    return curve_compliance(share, points, facets.length) + roller_seat(design).widening

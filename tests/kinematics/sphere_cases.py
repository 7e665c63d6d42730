"""Sphere teeth for tests: examples, and random ones that can be made."""

import math

from hypothesis import assume
from hypothesis import strategies as st

from trochoid.kinematics.sphere_tooth import Carrier, SphereTooth
from trochoid.kinematics.sphere_tooth_checks import largest_nutation, overlap_angle
from trochoid.kinematics.sphere_tooth_clearance import clear_pin_angle


def tooth(
    pins: int, lobes: int, alpha: float, r: float, nutation: float, side: int = 1, on: Carrier = "ring"
) -> SphereTooth:
    """A tooth with its angles in degrees."""
    return SphereTooth(pins, lobes, math.radians(alpha), math.radians(r), math.radians(nutation), side, on)


EXAMPLES = (
    tooth(30, 29, 65.0, 2.5, 3.0),
    tooth(30, 29, 65.0, 2.5, 3.0, 1, "satellite"),
    tooth(15, 14, 70.0, 3.0, 2.5, -1),
    tooth(14, 15, 60.0, 4.0, 2.5, 1, "satellite"),
    tooth(14, 15, 60.0, 1.5, 2.5, -1),
    tooth(5, 4, 60.0, 20.0, 8.0),
)


@st.composite
def teeth(draw: st.DrawFn) -> SphereTooth:
    """Feasible flanks of 4 to 60 pins, one lobe more or less, both sides, pins on ring or satellite."""
    pins = draw(st.integers(4, 60))
    lobes = pins + draw(st.sampled_from((-1, 1)))
    side = draw(st.sampled_from((-1, 1)))
    on: Carrier = draw(st.sampled_from(("ring", "satellite")))
    thin = SphereTooth(pins, lobes, draw(st.floats(0.2, 1.55)), 0.0, 0.1, side, on)
    nutation = draw(st.floats(0.05, 0.95)) * min(largest_nutation(thin), 0.3)
    thin = SphereTooth(pins, lobes, thin.polar_angle, 0.0, nutation, side, on)
    limit = min(clear_pin_angle(thin), overlap_angle(thin))
    assume(limit > 1e-4)
    return SphereTooth(pins, lobes, thin.polar_angle, draw(st.floats(0.05, 0.97)) * limit, nutation, side, on)

"""Contact ratio by counting pins, and what is refused, with advice that works."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.meshing import check_cycloid, contact_ratio, cycloid_faults

EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)


@pytest.mark.independent
@pytest.mark.parametrize("pins", [4, 5, 12, 20, 41])
def test_contact_ratio_counts_the_pins_with_a_driving_lever(pins: int) -> None:
    """Half the pins carry (sources §3); odd pin numbers alternate.  Counted at 1001 crank angles."""
    cycloid = Cycloid(pins, pins - 1, 0.08, 0.001, 0.04 / pins)
    cranks = np.linspace(0.0, 2.0 * math.pi, 1001)[:, None] + 1e-4
    levers = cycloid.lever(cycloid.contact_parameter(np.arange(pins), cranks))
    counts = np.count_nonzero(levers > 0.0, axis=1)
    ratio = contact_ratio(cycloid)
    assert (ratio.least, ratio.most) == (counts.min(), counts.max())
    assert ratio.mean == pytest.approx(counts.mean(), rel=2e-3)


@pytest.mark.independent
def test_mean_pressure_angle_is_weighted_with_the_pin_force() -> None:
    """Against plain averages over 2000 crank angles with forces in proportion to the levers."""
    t = EXAMPLE.contact_parameter(np.arange(20), np.linspace(0.0, 0.314, 2000)[:, None])
    force = np.maximum(0.0, EXAMPLE.lever(t))
    mean = float(np.sum(force * EXAMPLE.pressure_angle(t)) / force.sum())
    ratio = contact_ratio(EXAMPLE)
    assert ratio.pressure_angle_mean == pytest.approx(mean, rel=1e-3)
    assert ratio.pressure_angle_min == pytest.approx(math.acos(0.625), rel=1e-12)


@pytest.mark.exact
def test_the_example_is_feasible() -> None:
    """Issue 2's drive passes."""
    check_cycloid(EXAMPLE)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("cycloid", "message"),
    [
        (Cycloid(3, 2, 0.08, 0.005, 0.0025), "pins = 3: at least 4 pins"),
        (Cycloid(20, 19, 0.08, 0.0, 0.0025), "pin_radius = 0.0 m: a positive length"),
        (Cycloid(20, 19, 0.08, 0.005, -0.001), "eccentricity = -0.001 m: a positive length"),
        (Cycloid(20, 19, 0.08, 0.005, math.nan), "eccentricity = nan m"),
        (Cycloid(20, 19, 0.08, 0.005, 0.004), "eccentricity = 4 mm: it must be less than .* = 4 mm"),
        (Cycloid(20, 19, 0.08, 0.006, 0.0039), "pin_radius = 6 mm: the flank is undercut"),
        (Cycloid(20, 19, 0.08, 0.0126, 0.0025), "pins overlap; it must be less than .* = 12.5148 mm"),
    ],
)
def test_what_cannot_be_made_is_refused(cycloid: Cycloid, message: str) -> None:
    """Issue 2, bad input: undercut, e ≥ R/z_p, 3 pins, pins that overlap."""
    with pytest.raises(Infeasible, match=message):
        check_cycloid(cycloid)


@pytest.mark.property
@given(pins=st.integers(4, 100), k=st.floats(0.05, 0.99), pin=st.floats(0.01, 0.5))
@settings(max_examples=100, deadline=None)
def test_nearest_feasible_values_are_feasible(pins: int, k: float, pin: float) -> None:
    """Just inside a limit that a message prints, the fault is gone; just outside it is not."""
    cycloid = Cycloid(pins, pins - 1, 1.0, pin, k / pins)
    for fault in cycloid_faults(cycloid):
        values = [1e-3 * float(value) for value in re.findall(r"([0-9.e+-]+) mm", fault)[1:]]
        kind = fault.split(":")[1].split(";")[0]
        trials = [replace(cycloid, pin_radius=values[0])]
        if len(values) > 1:
            trials.append(replace(cycloid, eccentricity=values[1]))
        for trial in trials:
            for share, gone in ((1.0 - 1e-4, True), (1.0 + 1e-4, False)):
                moved = (
                    replace(cycloid, pin_radius=share * trial.pin_radius)
                    if trial.eccentricity == cycloid.eccentricity
                    else replace(cycloid, eccentricity=share * trial.eccentricity)
                )
                assert any(kind in other for other in cycloid_faults(moved)) is not gone

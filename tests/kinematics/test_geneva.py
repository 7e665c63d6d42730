"""The spherical Geneva wheel against closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import motion, shock
from trochoid.kinematics.indexer_measure import dwell, peaks


@pytest.mark.exact
@given(swing=st.floats(0.05, 3.1), shaft_angle=st.floats(0.05, 3.1), part=st.floats(-1.0, 1.0))
@settings(max_examples=100, deadline=None)
def test_closed_form(swing: float, shaft_angle: float, part: float) -> None:
    """tan ψ = sin φ/(sin D cot β − cos D cos φ); no hard shock, the swing asked for, the pin outside in the dwell."""
    wheel = geneva(swing, shaft_angle)
    phi, pin = part * wheel.half_turn, wheel.path.arm
    expected = math.atan2(
        math.sin(phi), math.sin(shaft_angle) / math.tan(pin) - math.cos(shaft_angle) * math.cos(phi)
    )
    assert float(motion(wheel, phi).angle) == pytest.approx(expected, abs=1e-12)
    assert wheel.swing == pytest.approx(swing, rel=1e-12)
    assert abs(shock(wheel)) < 1e-12
    assert dwell(wheel).clearance >= -1e-12
    assert (wheel.duration - 0.5) * math.cos(shaft_angle) <= 1e-16  # outer below 90°, inner above


@pytest.mark.exact
@pytest.mark.parametrize("slots", [3, 4, 5, 6, 8, 12])
def test_plane_limit(slots: int) -> None:
    """As D → 0: k = (z − 2)/2z, ω_max = λ/(1 − λ), ε_start = tan(π/z), λ = sin(π/z) of the plane Geneva wheel."""
    wheel, radius = geneva(2.0 * math.pi / slots, 1e-5), math.sin(math.pi / slots)
    assert wheel.duration == pytest.approx((slots - 2) / (2 * slots), abs=1e-9)
    assert peaks(wheel).velocity == pytest.approx(radius / (1.0 - radius), rel=1e-8)
    assert peaks(wheel).start == pytest.approx(math.tan(math.pi / slots), rel=1e-8)


@pytest.mark.exact
def test_right_angle() -> None:
    """D = 90°: β = ψ0, half of the turn, ω_max = tan ψ0, and ε at the start ½ sin ψ_Σ."""
    for swing in np.radians([30.0, 60.0, 90.0, 120.0, 170.0]):
        wheel = geneva(swing)
        assert wheel.duration == pytest.approx(0.5, abs=1e-15)
        assert wheel.path.arm == pytest.approx(0.5 * swing)
        assert peaks(wheel).velocity == pytest.approx(math.tan(0.5 * swing))
        assert peaks(wheel).start == pytest.approx(0.5 * math.sin(swing))


@pytest.mark.parametrize(("swing", "shaft_angle"), [(0.0, 1.0), (math.pi, 1.0), (1.0, 0.0), (1.0, math.pi)])
def test_refusals(swing: float, shaft_angle: float) -> None:
    with pytest.raises(Infeasible, match="take"):
        geneva(swing, shaft_angle)

"""What the pin asks of its slot, against rotation matrices and plain sampling."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.kinematics.indexer_cases import DEGREE, indexers, pin_at, tasks
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.indexer_slot import pressure_angle, slot, slot_normal
from trochoid.kinematics.indexer_synthesis import Task, by_duration, cusped


@pytest.mark.independent
@given(task=tasks(), duration=st.floats(0.1, 0.9))
@settings(max_examples=40, deadline=None)
def test_travel(task: Task, duration: float) -> None:
    """No sample of the path lies nearer or farther than the travel says, and the extremes are reached."""
    for x in by_duration(task, duration):
        if x.fault:
            continue
        made, found = x.indexer, slot(x.indexer)
        at = [pin_at(made.path, t).real for t in np.linspace(0.0, made.half_turn, 101)]
        reach = np.arccos(np.clip(np.array(at) @ made.axis, -1.0, 1.0))
        assert reach.min() >= found.nearest - 1e-7
        assert reach.max() <= found.farthest + 1e-7
        assert reach.min() == pytest.approx(found.nearest, abs=1e-2)
        assert float(made.reach(found.nearest_at)) == pytest.approx(found.nearest, abs=1e-12)
        assert float(made.reach(found.farthest_at)) == pytest.approx(found.farthest, abs=1e-12)
        assert found.nearest <= found.entry <= found.farthest
        assert (found.offset == 0.0) == (found.farthest == found.entry)


@pytest.mark.exact
@given(made=indexers(), t=st.floats(-3.0, 3.0))
@settings(max_examples=80, deadline=None)
def test_pin_pushes_along_the_normal(made: Indexer, t: float) -> None:
    """n·P' = ω sin α, and the pressure angle is that between the two: α from the wheel's axis to the pin."""
    reach = float(made.reach(t))
    assume(0.05 < reach < 3.09)
    first = made.path.derivatives(t, 1)[1]
    speed = float(np.linalg.norm(first))
    assume(speed > 1e-3)
    across = float(slot_normal(made, t) @ first)
    assert across == pytest.approx(float(motion(made, t).velocity) * math.sin(reach), abs=1e-9)
    assert math.cos(float(pressure_angle(made, t))) == pytest.approx(abs(across) / speed, abs=1e-9)


@pytest.mark.exact
def test_geneva_wheel() -> None:
    """D = 90°: nearest at D − β, rim where the slot touches the crank's circle: cos α = cos β cos D/cos … = 0."""
    for swing in (60.0, 90.0, 120.0):
        found = slot(geneva(swing * DEGREE))
        assert found.nearest == pytest.approx((90.0 - 0.5 * swing) * DEGREE, abs=1e-14)
        assert found.entry == found.farthest == pytest.approx(90 * DEGREE, abs=1e-14)
        assert found.disturbance == 0.0
        ends = pressure_angle(geneva(swing * DEGREE), np.array([-90 * DEGREE, 0.0]))
        np.testing.assert_allclose(ends, [90 * DEGREE, 0.0], atol=1e-7)


@pytest.mark.exact
def test_hypocycloid_cusp_comes_back_out() -> None:
    """ψ_Σ = 90°, i = 4: the pin is 58.8° off the axis in the middle, 54.7° at the cusps, so it meets the rim early.

    The way outside the slot is found by sampling positions from rotation matrices.
    """
    made = next(x for x in cusped(Task(90 * DEGREE, 4)) if not x.fault).indexer
    found = slot(made)
    assert found.nearest / DEGREE == pytest.approx(54.7356, abs=1e-4)
    assert found.farthest / DEGREE == pytest.approx(58.8209, abs=1e-4)
    w = np.cross(made.axis, [0.0, 1.0, 0.0])
    rim, most = math.cos(found.farthest), 0.0
    for t in np.linspace(made.half_turn, math.pi, 20001):
        P = pin_at(made.path, t).real
        if P @ made.axis > rim:
            turned = math.atan2(P[1], -(P @ w)) if P @ -w > 0 else math.atan2(P[1], P @ w)
            most = max(most, abs(turned - 45 * DEGREE))
    assert most <= found.disturbance < most + 2e-4
    assert found.disturbance / DEGREE == pytest.approx(4.790, abs=1e-3)
    assert found.offset == pytest.approx(math.sin(found.farthest) * found.disturbance, rel=0.02)

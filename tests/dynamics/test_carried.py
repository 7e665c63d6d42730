"""Elastic motion in a frame that turns: closed forms of one mass, the same motion in fixed axes, momentum."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.dynamics.carried import Carried, Mass, inertia_wrench, mass_matrix, respond_carried, to_fixed
from trochoid.dynamics.elastic import respond
from trochoid.dynamics.spectrum import harmonics
from trochoid.dynamics.wrench import wrench
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

COUNT, SPEED, WEIGHT, SPRING = 40, 47.0, 2.0, 5e5
TURN = 2 * np.pi * np.arange(COUNT) / COUNT
PLANE = Mass(WEIGHT, np.array([0.03, 0.01, 0.02]), np.eye(2, 3), 1e-3, np.array([0.0, 0.0, 1.0]))


def circling(order: int, reach: float = 1e-5) -> Array:
    """A quasi-static motion x, y (n, 2) on a circle, `order` times a turn, backwards where negative."""
    return reach * np.stack([np.cos(order * TURN), np.sin(order * TURN)], axis=-1)


def answered(order: int, frame: float) -> tuple[Carried, Array]:
    motion = np.column_stack([circling(order), 0 * TURN])
    stiffness = np.diag([SPRING, SPRING, 1e3])
    return respond_carried(motion, [PLANE], stiffness, SPEED, frame, 0.0), motion


@pytest.mark.exact
@settings(max_examples=25, deadline=None)
@given(order=st.integers(-4, 4).filter(bool), frame=st.floats(-60, 60))
def test_one_mass_on_a_circle(order: int, frame: float) -> None:
    """Round springs in a frame that turns with Ω: w = q k/(k − m (h ω + Ω)²)."""
    found, motion = answered(order, frame)
    fast = order * SPEED + frame
    assert found.response.motion == pytest.approx(
        motion * SPRING / (SPRING - WEIGHT * fast**2), rel=1e-9, abs=1e-16
    )
    force = WEIGHT * fast**2 * found.response.motion[:, :2]
    assert found.forces[:, 0] == pytest.approx(force, rel=1e-8, abs=1e-9 * WEIGHT * SPEED**2 * 1e-5)
    load = inertia_wrench([PLANE], found)
    own = wrench(np.array([PLANE.place]), found.forces)
    assert load.moment == pytest.approx(own.moment, rel=1e-12, abs=1e-15)


@pytest.mark.exact
def test_without_turning_it_is_the_plain_response() -> None:
    """In a frame that stands the answer is that of `respond`, whatever the stiffness does."""
    stiffness = np.eye(3) * [SPRING, SPRING, 1e3] * (1 + 0.2 * np.cos(2 * TURN))[:, None, None]
    motion = np.column_stack([circling(2), 1e-4 * np.sin(3 * TURN)])
    found = respond_carried(motion, [PLANE], stiffness, SPEED, 0.0, 0.02).response
    plain = respond(motion, mass_matrix([PLANE]), stiffness, SPEED, 0.02)
    for name in ("motion", "inertia", "spring_correction", "acceleration"):
        expected = getattr(plain, name)
        assert getattr(found, name) == pytest.approx(expected, abs=1e-9 * np.abs(expected).max())


@pytest.mark.exact
def test_lines_of_the_frame_are_shifted_in_fixed_axes() -> None:
    """A force that runs round h times in the frame has the one line h ω + Ω outside, of the same size."""
    force = np.column_stack([circling(3, 7.0), 2.0 + 0 * TURN])
    load = to_fixed(wrench(np.zeros((1, 3)), force[:, None]), TURN / 5, 5, 2 * np.pi / 5)
    lines = np.abs(harmonics(load.force))
    assert len(load.force) == 5 * COUNT
    assert lines[16, :2] == pytest.approx([7.0, 7.0], rel=1e-12)
    assert lines[0, 2] == pytest.approx(2.0, rel=1e-12)
    lines[16, :2] = lines[0, 2] = 0.0
    assert lines.max() < 1e-12


@pytest.mark.property
def test_what_cannot_be_answered_is_refused() -> None:
    """A coordinate without mass."""
    motion = np.column_stack([circling(1), 0 * TURN])
    light = Mass(WEIGHT, np.zeros(3), np.eye(2, 3), 0.0, np.zeros(3))
    with pytest.raises(TrochoidError, match="every coordinate needs a mass"):
        respond_carried(motion, [light], SPRING * np.eye(3), SPEED, 1.0)

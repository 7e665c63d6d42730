"""Gaps between facets and circles, their arms and how these turn."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fem.cases import FLANK, on_circle
from trochoid.fem.facing import Facing, Frame
from trochoid.kinematics.cycloid import Modification, gap
from trochoid.kinematics.types import Array

WEIGHTS = np.full((5, 3), 1 / 3)


def _touching(radius: float = 0.005) -> tuple[Facing, Array]:
    """Return a circle that touches the middle facet of a disc at a random motion of four, and that motion."""
    random = np.random.default_rng(3)
    moves = random.normal(size=(2, 3, 4))
    disc = Frame(np.array([0.01, -0.02]), 0.7, moves[0])
    angle = np.linspace(0.4, 0.40028, 15).reshape(5, 3)
    points = on_circle(0.05, angle.ravel()).reshape(5, 3, 2)
    motion = 1e-3 * random.normal(size=4)
    hub = disc.place(on_circle(0.055, np.array([0.40014]))[0], motion)
    partner = Frame(np.array([-0.03, 0.04]), -0.2, moves[1])
    return Facing(disc, points, points / 0.05, WEIGHTS, partner, partner.local(hub, motion), radius), motion


@pytest.mark.exact
def test_arms_and_turning_are_derivatives() -> None:
    """Arms: gaps by differences; turning: loads of the arms by differences, with circle and disc just touching."""
    facing, motion = _touching()
    force, step = np.array([1.0, 3.0, 5.0, 2.0, 4.0]), 1e-6
    arms, turning = facing.gap(motion)[1], facing.turning(motion, force)
    for i, way in enumerate(step * np.eye(4)):
        ahead, back = facing.gap(motion + way), facing.gap(motion - way)
        assert arms[:, i] == pytest.approx((back[0] - ahead[0]) / (2 * step), rel=1e-5, abs=1e-7)
        change = force @ (ahead[1] - back[1]) / (2 * step)
        assert turning[i] == pytest.approx(change, rel=1e-2, abs=1e-2 * np.abs(turning).max())
    assert turning == pytest.approx(turning.T, abs=1e-12 * np.abs(turning).max())


@pytest.mark.exact
@pytest.mark.parametrize("overlap", [0.0, 1e-5, 1e-4])
def test_gap_of_overlapping_circles(overlap: float) -> None:
    """Two circles: s²/2 (1/R + 1/r) less the overlap, however deep; the curvature does not change with it."""
    still = Frame(np.zeros(2), 0.0, np.zeros((3, 1)))
    angle = np.linspace(-0.004, 0.004, 81)[:, None]
    points = on_circle(0.05, angle.ravel())[:, None]
    hub = np.array([0.055 - overlap, 0.0])
    facing = Facing(still, points, points / 0.05, np.ones((81, 1)), still, hub, 0.005, play=2e-6)
    found = facing.gap(np.zeros(1))[0]
    parabola = (0.05 * angle[:, 0]) ** 2 / 2 * (1 / 0.05 + 1 / 0.005)
    assert found + overlap - 2e-6 == pytest.approx(parabola, rel=1e-3, abs=1e-15)


@pytest.mark.independent
@pytest.mark.parametrize("change", [Modification(), Modification(2e-5, -3e-5)])
def test_gap_to_the_flank(change: Modification) -> None:
    """A facet at the foot of a pin on the ground flank: the gap of `kinematics.cycloid`."""
    still = Frame(np.zeros(2), 0.0, np.zeros((3, 1)))
    pin = np.array([0.0801, 0.002])
    distance, t = gap(FLANK, change, pin[None], np.array([0.03]))
    ground = FLANK.modified(change)
    points, normals = ground.point(t)[:, None], ground.normal(t)[:, None]
    facing = Facing(still, points, normals, np.ones((1, 1)), still, pin, FLANK.pin_radius)
    found = facing.gap(np.zeros(1))[0]
    assert found[0] == pytest.approx(distance[0], abs=1e-15)

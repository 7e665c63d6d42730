"""Gaps of displaced pins: the nearest point of the flank, and no rounding beside displacements however small."""

from __future__ import annotations

import numpy as np
import pytest

from tests.kinematics.sphere_cases import EXAMPLES
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.sphere_tooth_gap import gap_of, opened, path_step
from trochoid.kinematics.spherical import unit
from trochoid.kinematics.spherical_curve import foot_point
from trochoid.kinematics.types import Array

START = np.array([0.1, 0.77, 2.3, -1.4])
WAY = np.array([[0.3, -0.5, 0.2], [0.1, 0.9, -0.4], [-0.7, 0.2, 0.6], [0.5, 0.5, 0.1]])


def displaced(tooth: SphereTooth, size: float) -> Array:
    """Displacements (4, 3) of unit vectors in the direction of WAY across the axes, about `size` rad, to rounding."""
    axis = tooth.center_path(START)
    across = WAY - np.sum(WAY * axis, axis=-1, keepdims=True) * axis
    length = size * np.linalg.norm(across, axis=-1, keepdims=True)
    return np.asarray(np.sin(length) * unit(across) - 2.0 * np.sin(0.5 * length) ** 2 * axis)


@pytest.mark.exact
@pytest.mark.parametrize("tooth", EXAMPLES[:4])
def test_gap_is_the_nearest_point_of_the_flank(tooth: SphereTooth) -> None:
    """Axes displaced by 1e-3 rad: parameter and angle of the foot point on the flank, to rounding of unit vectors."""
    moved = displaced(tooth, 1e-3)
    parameter, angle = foot_point(tooth, tooth.center_path(START) + moved, START)
    found, gap = opened(tooth, START, moved, parameter)
    assert found == pytest.approx(parameter, abs=1e-11)
    assert gap == pytest.approx(angle - tooth.pin_angle, abs=1e-14)


@pytest.mark.exact
@pytest.mark.parametrize("tooth", EXAMPLES[:4])
def test_small_displacements_are_not_rounded(tooth: SphereTooth) -> None:
    """The gap over the displacement is that of first order at 1e-12, 1e-15 and 1e-30 rad, to ten digits."""
    across = np.cos(tooth.pin_angle) * tooth.normal(START) - np.sin(tooth.pin_angle) * tooth.point(START)
    for size in (1e-12, 1e-15, 1e-30):
        moved = displaced(tooth, size)
        _, gap = opened(tooth, START, moved, START)
        assert gap == pytest.approx(np.sum(moved * across, axis=-1), rel=1e-10, abs=1e-10 * size)
    _, none = opened(tooth, START, 0.0 * moved, START)
    assert not none.any()


@pytest.mark.exact
@pytest.mark.parametrize("tooth", EXAMPLES[:4])
def test_steps_along_the_path(tooth: SphereTooth) -> None:
    """Large steps are differences of points, small ones speed times tangent."""
    step = np.array([0.3, -0.2, 0.05, 1.0])
    whole = tooth.center_path(START + step) - tooth.center_path(START)
    assert path_step(tooth, START, step) == pytest.approx(whole, abs=1e-14)
    slope = path_step(tooth, START, 1e-12 * step) / (1e-12 * step)[:, None]
    assert slope == pytest.approx(tooth.path_speed(START)[:, None] * tooth.tangent(START), abs=1e-10)


@pytest.mark.exact
@pytest.mark.parametrize("tooth", EXAMPLES[:4])
@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-6, 1e-3, 5e-3])
def test_gap_without_a_foot_point_to_begin_with(tooth: SphereTooth, size: float) -> None:
    """From where the axes were, the same parameters and angles as from the nearest points of the flank."""
    moved = displaced(tooth, size) if size else np.zeros((4, 3))
    foot, _ = foot_point(tooth, tooth.center_path(START) + moved, START)
    parameter, angle = opened(tooth, START, moved, foot)
    found, gap = gap_of(tooth, START, moved)
    assert found == pytest.approx(parameter, abs=1e-12)
    assert gap == pytest.approx(angle, rel=1e-9, abs=1e-15 * size + 1e-50)

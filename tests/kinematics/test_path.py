"""Lines and arcs against their closed forms."""

import math

import numpy as np
import pytest

from trochoid.kinematics.curve import ArcLength, corners
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.path import Path, Piece, polygon

HALF_DISC = Path((Piece((-0.5, 0.0), (0.5, 0.0), math.pi), Piece((0.5, 0.0), (-0.5, 0.0))))


@pytest.mark.exact
def test_an_arc_lies_on_its_circle() -> None:
    """The lower half of a circle of radius 0.5 from left to right turns left by π about the origin."""
    t = np.linspace(0.0, 0.999, 40)
    angle = math.pi * (1.0 + t)
    radial = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    np.testing.assert_allclose(HALF_DISC.point(t), 0.5 * radial, atol=1e-15)
    np.testing.assert_allclose(HALF_DISC.normal(t), radial, atol=1e-15)
    np.testing.assert_allclose(HALF_DISC.curvature(t), 2.0, rtol=1e-14)
    np.testing.assert_allclose(HALF_DISC.speed(t), 0.5 * math.pi, rtol=1e-14)


@pytest.mark.exact
def test_a_line_is_straight_and_faces_outwards() -> None:
    """The closing diameter runs back at its length, without curvature, its normal upwards."""
    t = np.array([1.0, 1.25, 1.9])
    np.testing.assert_allclose(HALF_DISC.point(t)[:, 0], 0.5 - (t - 1.0), atol=1e-15)
    np.testing.assert_allclose(HALF_DISC.normal(t), [[0.0, 1.0]] * 3, atol=1e-15)
    np.testing.assert_array_equal(HALF_DISC.curvature(t), 0.0)


@pytest.mark.exact
def test_length_and_corners_of_closed_paths() -> None:
    """π r + 2 r for a half disc; the perimeter of a 3-4-5 triangle."""
    assert ArcLength(HALF_DISC).total == pytest.approx(0.5 * math.pi + 1.0, rel=1e-15)
    triangle = polygon([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]])
    assert ArcLength(triangle).total == pytest.approx(12.0, rel=1e-15)
    np.testing.assert_array_equal(corners(triangle), [0.0, 1.0, 2.0])


@pytest.mark.exact
def test_a_hole_has_its_material_outside() -> None:
    """A square hole has inward normals and a right-turning arc of an outer path is concave."""
    hole = polygon([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], hole=True)
    np.testing.assert_allclose(hole.normal(0.5), [0.0, 1.0], atol=1e-15)
    notch = Path((Piece((0.0, 0.0), (1.0, 0.0), -1.0), Piece((1.0, 0.0), (0.0, 0.0), 4.0)))
    assert notch.curvature(0.5) < 0.0 < notch.curvature(1.5)


@pytest.mark.exact
def test_open_and_empty_paths_are_refused() -> None:
    """The message names the piece."""
    with pytest.raises(Infeasible, match="piece 1 ends at"):
        Path((Piece((0.0, 0.0), (1.0, 0.0)), Piece((1.0, 0.0), (0.5, 1.0))))
    with pytest.raises(Infeasible, match="piece 1 has no length"):
        polygon([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])

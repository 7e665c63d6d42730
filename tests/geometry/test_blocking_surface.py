"""Surface of the volumetric blocking contour: closed, its volume, and that every face lies on what it names."""

from __future__ import annotations

import numpy as np
import pytest

from trochoid.geometry.blocking import inner_contour, inner_plane, outer_contour, outer_plane, volume
from trochoid.geometry.blocking_contour import trace
from trochoid.geometry.blocking_surface import Face, surface
from trochoid.geometry.planetary import PlanetarySet
from trochoid.geometry.planetary_quality import Limits, least_margin
from trochoid.kinematics.shaper import Shaper
from trochoid.kinematics.types import Array

SOURCE = PlanetarySet((20, 30, 80), 2e-3, 52e-3, (0.5, 0.634, 1.768), Shaper(25, 0.15, 55.6e-3), planets=4)


def enclosed(faces: tuple[Face, ...]) -> tuple[float, Array]:
    """Volume (by the divergence theorem) and the sum of all area vectors, which a closed surface has not."""
    total, vector = 0.0, np.zeros(3)
    for face in faces:
        a, b, c = (face.vertices[face.triangles[:, k]] for k in range(3))
        total += float(np.sum(a * np.cross(b, c))) / 6.0
        vector += 0.5 * np.cross(b - a, c - a).sum(axis=0)
    return total, vector


@pytest.mark.independent
def test_the_surface_of_the_source_encloses_its_volume() -> None:
    """Sources §4: 10.77 on a grid, 10.808 exactly; sections by levels converge with their square."""
    outer, inner = outer_contour(SOURCE, steps=80), inner_contour(SOURCE, steps=80)
    found, vector = enclosed(surface(outer, inner))
    assert found == pytest.approx(volume(outer, inner), rel=1e-4)
    assert np.abs(vector).max() < 1e-9
    rough, _ = enclosed(surface(outer, inner, 30))
    assert abs(rough - found) < 1e-3 * found


@pytest.mark.exact
def test_faces_lie_on_the_conditions_that_they_name() -> None:
    """Middles of all faces: the named condition nearly vanishes there, no other is much below zero."""
    faces = surface(outer_contour(SOURCE, steps=80), inner_contour(SOURCE, steps=80), 200)
    assert {face.name for face in faces} >= {
        "undercut of the planet",
        "pointed tip of the sun",
        "ring tip in planet fillet",
    }
    for face in faces:
        x1, x2, x3 = face.vertices[face.triangles].mean(axis=1).T
        margins: dict[str, Array] = {}
        for plane in (outer_plane(SOURCE, x1, x2, Limits()), inner_plane(SOURCE, x2, x3, Limits())):
            names, values = least_margin(plane, SOURCE.module)
            margins |= dict(zip(names, values, strict=True))
        assert np.abs(margins[face.name]).max() < 2e-2, face.name
        assert min(float(values.min()) for values in margins.values()) > -2e-2


@pytest.mark.exact
def test_a_cylinder_and_a_hole() -> None:
    """Two discs give the body common to two crossed cylinders, 16/3; with a hole in one of them, less."""

    def disc(x: Array, y: Array) -> Array:
        return np.stack((1.0 - x**2 - y**2,))

    def holed(x: Array, y: Array) -> Array:
        return np.stack((1.0 - x**2 - y**2, x**2 + y**2 - 0.25))

    plain = trace(disc, ("rim",), (-2.0, -2.0), (2.0, 2.0), 80)
    found, vector = enclosed(surface(plain, plain, 300))
    assert found == pytest.approx(16.0 / 3.0, rel=1e-3)
    assert np.abs(vector).max() < 1e-9
    ring = trace(holed, ("rim", "hole"), (-2.0, -2.0), (2.0, 2.0), 80)
    faces = surface(ring, plain, 300)
    found, vector = enclosed(faces)
    assert found == pytest.approx(volume(ring, plain), rel=2e-3)
    assert np.abs(vector).max() < 1e-9
    assert {face.name for face in faces} == {"rim", "hole"}


@pytest.mark.exact
def test_nothing_in_common_has_no_surface() -> None:
    empty = trace(lambda x, y: np.stack((x - 9.0,)), ("far",), (-2.0, -2.0), (2.0, 2.0))
    assert surface(empty, outer_contour(SOURCE, steps=40)) == ()

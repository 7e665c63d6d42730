"""The pin's path: harmonics against rotation matrices, rolling of the cones, the protocol of curves on the sphere."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.kinematics.indexer_cases import paths, pin_at
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.spherical_trochoid import SphericalTrochoid


@pytest.mark.independent
@given(path=paths(), phi=st.floats(-7.0, 7.0))
@settings(max_examples=100, deadline=None)
def test_harmonics_are_the_chain_of_rotations(path: SphericalTrochoid, phi: float) -> None:
    """Position and first derivative (complex step) to 1e-13; the pin stays on the unit sphere."""
    point, slope = path.derivatives(phi, 1)
    np.testing.assert_allclose(point, pin_at(path, phi).real, atol=1e-13)
    np.testing.assert_allclose(
        slope, pin_at(path, phi + 1e-40j).imag / 1e-40, atol=1e-13 * (1 + abs(path.ratio))
    )
    assert np.linalg.norm(path.point(phi)) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.property
@given(path=paths(), phi=st.floats(-3.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_period_and_mirror(path: SphericalTrochoid, phi: float) -> None:
    """With a whole i the path closes after one turn of the arm, and is its own mirror image about the xz plane."""
    np.testing.assert_allclose(path.point(phi + path.period), path.point(phi), atol=1e-12)
    np.testing.assert_allclose(path.point(-phi), path.point(phi) * [1.0, -1.0, 1.0], atol=1e-13)


@pytest.mark.exact
@given(path=paths())
@settings(max_examples=60, deadline=None)
def test_pitch_cones_roll(path: SphericalTrochoid) -> None:
    """sin δ_c = i sin δ_s, and a pin with ρ = 1 stands still where it meets the instantaneous axis."""
    assert math.sin(path.central_cone) == pytest.approx(
        abs(path.ratio) * math.sin(path.planet_cone), abs=1e-14
    )
    on_cone = SphericalTrochoid(path.arm, path.planet_cone, path.ratio, path.phase)
    assert on_cone.pin_ratio == pytest.approx(1.0, rel=1e-14)
    inner = path.ratio > 0.0
    cusp = (math.pi * inner - path.phase + math.pi * (path.arm < 0.0)) / path.ratio
    assert float(on_cone.speed(cusp)) < 1e-13 * abs(path.ratio)
    tangent = on_cone.tangent(cusp)
    assert (
        abs(tangent @ np.cross(on_cone.point(cusp), [0.0, 0.0, 1.0])) < 1e-8
    )  # a cusp points along the meridian


@pytest.mark.independent
@given(path=paths().filter(lambda p: abs(p.pin_ratio - 1.0) > 0.05), phi=st.floats(-3.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_as_a_curve_on_the_sphere(path: SphericalTrochoid, phi: float) -> None:
    """Tangent, normal and geodesic curvature against the turn of the tangent along the path."""
    step = 1e-5
    before, after = path.tangent(phi - step), path.tangent(phi + step)
    turn = -(after - before) @ path.normal(phi) / (2.0 * step * float(path.speed(phi)))
    assert turn == pytest.approx(float(path.curvature(phi)), rel=1e-5, abs=1e-5)
    assert abs(path.normal(phi) @ path.tangent(phi)) < 1e-14
    assert abs(path.normal(phi) @ path.point(phi)) < 1e-13


@pytest.mark.exact
def test_a_crank_runs_on_a_circle() -> None:
    """β = 0: a small circle of radius γ, geodesic curvature cot γ."""
    crank = SphericalTrochoid(0.7, 0.0, 3.0)
    phi = np.linspace(0.0, 6.0, 7)
    np.testing.assert_allclose(crank.curvature(phi), 1.0 / math.tan(0.7), rtol=1e-13)
    np.testing.assert_allclose(crank.speed(phi), math.sin(0.7), rtol=1e-14)


@pytest.mark.parametrize(
    ("arm", "pin", "ratio", "message"),
    [
        (0.0, 0.1, 4.0, "must not lie along the drive's"),
        (0.5, 1.6, 4.0, "below 90°"),
        (0.5, -0.1, 4.0, "below 90°"),
        (0.5, 0.1, -1.0, "take more than 1"),
    ],
)
def test_refusals(arm: float, pin: float, ratio: float, message: str) -> None:
    with pytest.raises(Infeasible, match=message):
        SphericalTrochoid(arm, pin, ratio)

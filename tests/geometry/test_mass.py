"""Areas, centroids and moments against closed forms and polygon limits."""

import math

import numpy as np
import pytest
from scipy.special import ellipe

from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mass import cylinder, enclosed, prism, section
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.path import Path, Piece, polygon

EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)


@pytest.mark.exact
def test_circle_away_from_the_origin() -> None:
    """π r², its centre, π r⁴/2 + A c² (Steiner), for a hole as for a body."""
    for hole in (False, True):
        figure = enclosed(Circle((0.3, -0.2), 0.1, hole))
        assert figure.area == pytest.approx(math.pi * 0.01, rel=1e-14)
        assert figure.centroid == pytest.approx((0.3, -0.2), rel=1e-13)
        assert figure.polar_centroid == pytest.approx(math.pi * 1e-4 / 2.0, rel=1e-12)
        assert figure.polar == pytest.approx(math.pi * (1e-4 / 2.0 + 0.01 * 0.13), rel=1e-14)


@pytest.mark.exact
def test_rectangle_and_half_disc() -> None:
    """b h and b h (b² + h²)/12; the centroid of a half disc is 4 r/(3π) off its diameter."""
    figure = enclosed(polygon([[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]]))
    assert figure.area == pytest.approx(6.0, rel=1e-15)
    assert figure.centroid == pytest.approx((1.5, 1.0), rel=1e-15)
    assert figure.polar_centroid == pytest.approx(6.0 * 13.0 / 12.0, rel=1e-14)
    half = enclosed(Path((Piece((-1.0, 0.0), (1.0, 0.0), math.pi), Piece((1.0, 0.0), (-1.0, 0.0)))))
    assert half.centroid[1] == pytest.approx(-4.0 / (3.0 * math.pi), rel=1e-14)


@pytest.mark.exact
@pytest.mark.parametrize(
    "cycloid", [EXAMPLE, Cycloid(7, 6, 0.03, 0.004, 0.0025), Cycloid(101, 100, 0.2, 0.002, 0.0019)]
)
def test_area_of_a_cycloid_disc(cycloid: Cycloid) -> None:
    """Steiner: A = π(R² + z_p e²) − r L + π r², L = 4R(1 + K) E(4K/(1 + K)²) the length of the pin path."""
    k, radius, pin = cycloid.trochoid_ratio, cycloid.pin_circle_radius, cycloid.pin_radius
    length = 4.0 * radius * (1.0 + k) * float(ellipe(4.0 * k / (1.0 + k) ** 2))
    path = math.pi * (radius**2 + cycloid.pins * cycloid.eccentricity**2)
    assert enclosed(cycloid).area == pytest.approx(path - pin * length + math.pi * pin**2, rel=1e-13)


@pytest.mark.independent
def test_cycloid_moments_are_the_limit_of_polygons() -> None:
    """Shoelace sums over inscribed polygons converge to them with the square of the side."""
    figure, errors = enclosed(EXAMPLE), []
    for sides in (3800, 7600):
        p = EXAMPLE.point(2.0 * math.pi * np.arange(sides) / sides)
        q = np.roll(p, -1, axis=0)
        cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
        polar = float(np.sum(cross * np.sum(p * p + p * q + q * q, axis=1))) / 12.0
        errors.append((0.5 * cross.sum() / figure.area - 1.0, polar / figure.polar - 1.0))
    np.testing.assert_allclose(np.array(errors[0]) / np.array(errors[1]), 4.0, rtol=1e-3)
    assert np.abs(errors[1]).max() < 1e-5
    assert np.abs(figure.centroid).max() < 1e-16


@pytest.mark.exact
def test_a_disc_is_its_flank_less_its_holes() -> None:
    """Additivity with Steiner's terms for eight holes and the bore."""
    whole = section(disc_outline(EXAMPLE, 0.025, 8, 0.052, 0.01, 0.1, 12))
    flank, hole, bore = enclosed(EXAMPLE), math.pi * 1e-4, math.pi * 0.025**2
    assert whole.area == pytest.approx(flank.area - 8 * hole - bore, rel=1e-13)
    polar = flank.polar - 8 * hole * (0.5e-4 + 0.052**2) - 0.5 * bore * 0.025**2
    assert whole.polar == pytest.approx(polar, rel=1e-13)
    assert np.abs(whole.centroid).max() < 1e-16


@pytest.mark.exact
def test_a_body_smaller_than_its_holes_is_refused() -> None:
    """Nothing would be left."""
    loops = Loop("rim", Circle((0.0, 0.0), 1.0), 12), Loop("hole", Circle((0.0, 0.0), 2.0, True), 12)
    with pytest.raises(Infeasible, match="larger than the body"):
        section(Outline(loops[0], (loops[1],)))


@pytest.mark.exact
def test_hollow_cylinder() -> None:
    """m = ρπ(a² − b²)l, J = m(a² + b²)/2, transverse m(3(a² + b²) + l²)/12."""
    solid = cylinder(0.05, 0.2, 7850.0, 0.03)
    mass = 7850.0 * math.pi * (0.05**2 - 0.03**2) * 0.2
    assert solid.mass == pytest.approx(mass, rel=1e-14)
    assert solid.axial_inertia == pytest.approx(0.5 * mass * (0.05**2 + 0.03**2), rel=1e-14)
    assert solid.transverse_inertia == pytest.approx(
        mass * (3.0 * (0.05**2 + 0.03**2) + 0.04) / 12.0, rel=1e-14
    )
    assert prism(enclosed(Circle((0.0, 0.0), 0.05)), 0.2, 7850.0).mass == pytest.approx(
        cylinder(0.05, 0.2, 7850.0).mass
    )
    with pytest.raises(Infeasible, match=r"inner radius 0.05 m"):
        cylinder(0.05, 0.2, 7850.0, 0.05)

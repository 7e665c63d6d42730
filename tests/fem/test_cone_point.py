"""Point contact: the published two spheres, and S of a body against another load and a half-space."""

from __future__ import annotations

import math

import numpy as np
import pytest

from trochoid.fem.cone_body import ConeBody, cone_body
from trochoid.fem.cone_flank import Flank, flank
from trochoid.fem.cone_layers import layers
from trochoid.fem.hertz_point import contact_modulus, point_contact
from trochoid.fem.material import Material
from trochoid.fem.point_contact import Bump, PointLaw, bump_load, middle_of_bump, smooth_part
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import roller_outline
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.spherical_curve import SmallCircle

STEEL = Material(210e9, 0.3)


@pytest.mark.published
def test_two_spheres_of_code_aster() -> None:
    """SSNV104: spheres R = 50, E = 20 000, ν = 0.3, each moved by 2 mm: p0 2798.3 MPa, a = 10 mm, F = 586 081 N."""
    soft = Material(20e9, 0.3)
    contact = point_contact((2.0 / 50e-3, 2.0 / 50e-3), contact_modulus(soft, soft))
    force = PointLaw(contact).force(np.array([4e-3]))
    assert force[0] == pytest.approx(586081.0, rel=1e-5)
    assert contact.pressure(force)[0] == pytest.approx(2798.3e6, rel=2e-5)
    assert contact.semi_axes(force)[0][0] == pytest.approx(10e-3, rel=1e-6)


@pytest.mark.exact
def test_law_and_its_inverse() -> None:
    """force(approach(Q)) = Q; the slope is a central difference; nothing presses where nothing approaches."""
    law = PointLaw(point_contact((40.0, 90.0), 1.1e11), 2e-9)
    force = np.array([1e-3, 1.0, 500.0, 1e5])
    approach, slope = law.approach(force)
    assert law.force(approach) == pytest.approx(force, rel=1e-11)
    change = (law.approach(force * 1.0001)[0] - law.approach(force * 0.9999)[0]) / (2e-4 * force)
    assert change == pytest.approx(slope, rel=1e-6)
    assert not law.force(np.array([-1e-6, 0.0])).any()


def _block(facets: int, count: int) -> tuple[ConeBody, Flank]:
    """A thick cylinder of 2·8 mm on a bore of 3 mm, 16 mm long, nearly without taper."""
    mesh = mesh_sphere(roller_outline(8e-3, facets, 3e-3))
    body = cone_body(mesh, layers(1.0 - 8e-3, 1.0 + 8e-3, count, grading=1.0), STEEL)
    return body, flank(mesh, SmallCircle((1.0, 0.0, 0.0), 8e-3))


@pytest.mark.exact
def test_bump_presses_with_one_newton() -> None:
    """The load integrates to the inward normal, and its moment to that of its middle."""
    body, side = _block(24, 8)
    at = Bump(float(side.centers[3]), 1.0 + 1e-3, 2e-3, 3e-3)
    load = bump_load(body, side, at).toarray().reshape(-1, 3, body.radial.count)
    assert load.sum(axis=(0, 2)) == pytest.approx(-side.normal_at(at.place), rel=1e-12, abs=1e-12)
    depth = np.einsum("ncl,l,c->", load, body.radial.nodes, -side.normal_at(at.place))
    assert depth == pytest.approx(at.rho, rel=1e-9)
    with pytest.raises(Infeasible, match="reaches beyond"):
        bump_load(body, side, Bump(0.0, 1.0, 1e-3, 9e-3))


@pytest.mark.exact
def test_half_space_under_half_an_ellipsoid() -> None:
    """Round: 3/(4E'a) in its middle; an ellipse by its elliptic integral lies between its two circles."""
    body, _ = _block(16, 4)
    modulus = STEEL.plane("strain").modulus
    assert middle_of_bump(body, Bump(0.0, 1.0, 2e-3, 2e-3)) == pytest.approx(
        0.75 / (modulus * 2e-3), rel=1e-12
    )
    near = middle_of_bump(body, Bump(0.0, 1.0, 2e-3, 2.0001e-3))
    assert near == pytest.approx(0.75 / (modulus * 2e-3), rel=1e-4)
    long = middle_of_bump(body, Bump(0.0, 1.0, 2e-3, 4e-3))
    assert 0.75 / (modulus * 4e-3) < long < 0.75 / (modulus * 2e-3)


@pytest.mark.independent
def test_smooth_part_does_not_depend_on_the_load() -> None:
    """S from bumps of different width, shape and mesh: within 2 % of the local approach of a contact 0.2 mm wide."""
    found = []
    for facets, count, across, along in (
        (20, 8, 3e-3, 3e-3),
        (20, 8, 2.6e-3, 3.4e-3),
        (28, 10, 2.2e-3, 2.2e-3),
    ):
        body, side = _block(facets, count)
        found.append(smooth_part(body, side, Bump(float(side.centers[0]), 1.0, across, along)))
    local = 0.75 / (STEEL.plane("strain").modulus * 0.2e-3)
    assert np.ptp(found) < 2e-2 * local
    assert math.isfinite(found[0])

"""Hertz point contact against closed forms, scipy's elliptic integrals and Hertz's own integral equation."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import ellipe, ellipk

from trochoid.fem.hertz_point import ISO16281, PointContact, contact_modulus, point_contact
from trochoid.fem.material import Material
from trochoid.kinematics.errors import Infeasible

STEEL = Material(206e9, 0.3)
MODULUS = contact_modulus(STEEL, STEEL)


@pytest.mark.exact
def test_two_spheres() -> None:
    """Johnson, Contact Mechanics (4.22)–(4.24): a³ = 3QR/(4E*), δ = a²/R, p₀ = 3Q/(2πa²)."""
    radius, load = 4e-3, 120.0
    contact = point_contact((1.0 / radius, 1.0 / radius), MODULUS)
    a = np.cbrt(0.75 * load * radius / MODULUS)
    long, short = contact.semi_axes(np.array(load))
    assert float(long) == pytest.approx(a, rel=1e-14)
    assert float(short) == pytest.approx(a, rel=1e-14)
    assert contact.softness() * load ** (2.0 / 3.0) == pytest.approx(a**2 / radius, rel=1e-14)
    assert float(contact.pressure(np.array(load))) == pytest.approx(1.5 * load / (np.pi * a**2), rel=1e-14)


@pytest.mark.independent
@settings(max_examples=60, deadline=None)
@given(st.floats(0.0, 8.0), st.floats(1.0, 4.0))
def test_ellipse_fulfils_hertz(decades: float, size: float) -> None:
    """Hertz (Johnson 4.26): the curvatures' ratio is that of an ellipse of this ratio, by scipy's integrals.

    With k² = 1 − 1/χ²: B/A = (χ²E − K)/(K − E); the ellipse's ratio χ must give back the curvatures.
    """
    low = 10.0**size
    high = low * (1.0 + 10.0 ** (decades - 4.0))
    contact = point_contact((high, low), MODULUS)
    chi = contact.ratio
    first, second = ellipk(1.0 - chi**-2.0), ellipe(1.0 - chi**-2.0)
    assert contact.first == pytest.approx(first, rel=1e-9)
    assert contact.second == pytest.approx(second, rel=1e-9)
    if chi > 1.01:  # below, K − E of the two integrals cancels
        assert (chi**2 * second - first) / (first - second) == pytest.approx(high / low, rel=1e-9)


@pytest.mark.published
def test_constant_of_iso16281() -> None:
    """Public comparison with MASTA (minzhun/ISO16281): c_p = 333 592 N/mm^1.5, which is Hertz unrounded."""
    d, pitch, e = 11.5, 43.5, 210e3
    g = d / pitch
    modulus = e / (2.0 * (1.0 - 0.3**2))
    inner = point_contact((2.0 / d / (1.0 - g), 2.0 / d - 1.0 / (0.52 * d)), modulus)
    outer = point_contact((2.0 / d / (1.0 + g), 2.0 / d - 1.0 / (0.53 * d)), modulus)
    assert (inner.softness() + outer.softness()) ** -1.5 == pytest.approx(333592.0, abs=0.5)
    rounded = (inner.softness(ISO16281) + outer.softness(ISO16281)) ** -1.5
    assert rounded / 333592.0 == pytest.approx(1.48 * 3.0 / (np.pi * np.sqrt(2.0)), rel=1e-6)


@pytest.mark.exact
def test_load_at_a_pressure() -> None:
    """The load that gives 4200 MPa gives 4200 MPa, and the pressure carries the load: Q = ⅔πab p₀."""
    contact = point_contact((300.0, 20.0), MODULUS)
    load = np.array(contact.load_at(4.2e9))
    long, short = contact.semi_axes(load)
    assert float(contact.pressure(load)) == pytest.approx(4.2e9, rel=1e-13)
    assert float(2.0 / 3.0 * np.pi * long * short) * 4.2e9 == pytest.approx(float(load), rel=1e-13)


@pytest.mark.exact
@pytest.mark.parametrize("curvatures", [(100.0, 0.0), (100.0, -1.0), (np.inf, 1.0), (1e20, 1.0)])
def test_no_point_contact(curvatures: tuple[float, float]) -> None:
    """Conforming and straight contacts are refused with advice."""
    with pytest.raises(Infeasible, match="Hertz point contact"):
        point_contact(curvatures, MODULUS)


@pytest.mark.property
def test_softer_with_longer_ellipse() -> None:
    """At one curvature sum, conformity stiffens: the softness falls as the curvatures part."""
    contacts: list[PointContact] = [
        point_contact((100.0 + d, 100.0 - d), MODULUS) for d in (0.0, 50.0, 90.0, 99.0)
    ]
    soft = [c.softness() for c in contacts]
    assert (np.diff(soft) < 0.0).all()

"""A pin in its slot: beams and Hertz in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from trochoid.fem.hertz_point import contact_modulus
from trochoid.fem.material import Material
from trochoid.fem.pin_slot import Pin, Shape, crowned, flexibility, press
from trochoid.kinematics.errors import Infeasible

STEEL = Material(2.1e11, 0.3)
U = np.array([0.0, 1e-7, 1e-6, 1e-5, 1e-4])


def pin(shape: Shape = "cylinder", overhang: float = 3e-3, *, bends: bool = True) -> Pin:
    return Pin(shape, 5e-3, 0.1, 12e-3, overhang, 20e-3, STEEL, 0.5, bends)


@pytest.mark.exact
def test_cantilever() -> None:
    """Timoshenko: F L³/(3EI) + F L/(κGA), κ = 6(1 + ν)/(7 + 6ν); and a load before the end by superposition."""
    G = flexibility(pin(), np.array([0.1, 0.106]))
    area, inertia = math.pi * 25e-6, 0.25 * math.pi * 625e-12
    shear = 2.1e11 / 2.6 * area * 7.8 / 8.8
    bend = 2.1e11 * inertia
    a, b = 9e-3, 15e-3
    assert G[1, 1] == pytest.approx(b**3 / (3 * bend) + b / shear, rel=1e-9)
    assert G[0, 0] == pytest.approx(a**3 / (3 * bend) + a / shear, rel=1e-9)
    assert G[0, 1] == pytest.approx(a**2 * (3 * b - a) / (6 * bend) + a / shear, rel=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize("shape", ["cylinder", "cone"])
def test_line_contact_is_hertz(shape: Shape) -> None:
    """A pin that does not bend: each slice by Johnson (4.43, 4.45); q, b, p of one load belong together."""
    made = pin(shape, bends=False)
    found = press(made, U)
    modulus = contact_modulus(STEEL, STEEL)
    q = found.force[-1] / (12e-3 / 16)
    rho = 0.1 + 12e-3 * ((np.arange(16) + 0.5) / 16 - 0.5)
    opening = 0.05
    radius = 5e-3 if shape == "cylinder" else rho / (1.0 / math.tan(opening) + math.tan(opening))
    np.testing.assert_allclose(found.pressure[-1], np.sqrt(q * modulus / (math.pi * radius)), rtol=1e-12)
    np.testing.assert_allclose(
        found.half_width[-1], np.sqrt(4 * q * radius / (math.pi * modulus)), rtol=1e-12
    )
    depth = 5e-3 if shape == "cylinder" else rho * math.tan(opening)
    local = sum(2.0 * np.log(2.0 * d / found.half_width[-1]) - 0.3 / 0.7 for d in (depth, 20e-3))
    np.testing.assert_allclose(q * 0.91 / (math.pi * 2.1e11) * local, 1e-4 * rho, rtol=2e-5)
    assert found.moment[-1] == pytest.approx(float(found.force[-1] @ rho))
    assert found.moment[0] == 0.0 == found.pressure[0].max()


@pytest.mark.exact
def test_barrel_is_hertz_and_beam() -> None:
    """Approach of a point contact and deflection of the beam add up to the way of the wall."""
    made = pin("barrel")
    found = press(made, U)
    force = found.force[-1, 0]
    G = float(flexibility(made, np.array([0.1]))[0, 0])
    assert crowned(made).softness() * force ** (2 / 3) + G * force == pytest.approx(1e-5, rel=1e-12)
    along, across = crowned(made).semi_axes(np.array(force))
    assert found.pressure[-1, 0] == pytest.approx(1.5 * force / (math.pi * along * across), rel=1e-12)


@pytest.mark.independent
@pytest.mark.parametrize("shape", ["cylinder", "cone", "barrel"])
def test_slope_is_the_derivative(shape: Shape) -> None:
    """dN/du against central differences."""
    made = pin(shape)
    for u in (1e-6, 1e-4):
        low, high = press(made, np.array([u * (1 - 1e-4), u * (1 + 1e-4)])).moment
        assert press(made, np.array([u])).slope[0] == pytest.approx((high - low) / (2e-4 * u), rel=1e-6)


@pytest.mark.property
def test_bending_softens_and_loads_the_root() -> None:
    """A longer overhang: less force for the same way, and more of it near the root; a thin long pin lets go its end."""
    close, far = (press(pin(overhang=x), U) for x in (1e-3, 10e-3))
    assert far.moment[-1] < close.moment[-1]
    assert far.force[-1, 0] / far.force[-1].mean() > close.force[-1, 0] / close.force[-1].mean()
    thin = press(Pin("cylinder", 5e-4, 0.1, 12e-3, 1e-3, 20e-3, STEEL), U)
    assert (thin.force >= 0.0).all()
    assert thin.force[-1, 0] > 0.0
    assert np.all(np.diff(thin.moment) > 0.0)


@pytest.mark.property
def test_held_beyond_the_centre() -> None:
    """No pin is longer than the radius of its sphere."""
    with pytest.raises(Infeasible, match="must be less than 94 mm"):
        press(pin(overhang=0.1), U)

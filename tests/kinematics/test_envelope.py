"""One equation of meshing against every closed form of an envelope, in the plane and on the sphere, to 1e-12."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.kinematics.sphere_cases import EXAMPLES, teeth
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.envelope import contact_near, contacts, generated, meshing, meshing_slope
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.relative_motion import MeetingAxes, ParallelAxes, RackMotion
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.spherical_curve import SmallCircle

Array = npt.NDArray[np.float64]
PHI = np.linspace(0.1, 6.9, 37)


@dataclass(frozen=True)
class Line:
    """Straight rack flank through `foot`; material on the right of its direction `angle` (rad)."""

    foot: tuple[float, float]
    angle: float
    period: float = 1.0

    def point(self, t: npt.ArrayLike) -> Array:
        return np.asarray(self.foot) + np.asarray(t)[..., None] * self.tangent(t)

    def tangent(self, t: npt.ArrayLike) -> Array:
        along = np.array([math.cos(self.angle), math.sin(self.angle)])
        return np.broadcast_to(along, (*np.shape(t), 2))

    def normal(self, t: npt.ArrayLike) -> Array:
        across = np.array([-math.sin(self.angle), math.cos(self.angle)])
        return np.broadcast_to(across, (*np.shape(t), 2))

    def speed(self, t: npt.ArrayLike) -> Array:
        return np.ones(np.shape(t))

    def curvature(self, t: npt.ArrayLike) -> Array:
        return np.zeros(np.shape(t))


def cycloid_motion(cycloid: Cycloid) -> ParallelAxes:
    """The ring, which carries the pins, as the disc sees it over the crank angle."""
    return ParallelAxes(-cycloid.eccentricity, cycloid.pins / cycloid.lobes, -1.0)


def pin_circle(tooth: SphereTooth) -> SmallCircle:
    """Pin 0 in the frame of its own member."""
    axis = (math.sin(tooth.polar_angle), 0.0, math.cos(tooth.polar_angle))
    return SmallCircle(axis, tooth.pin_angle)


def nearest(found: Array, expected: Array, position: npt.NDArray[np.intp]) -> Array:
    """Distance from each expected point (n, d) to the nearest found one of the same position."""
    away = np.full(len(expected), np.inf)
    np.minimum.at(away, position, np.linalg.norm(found - expected[position], axis=-1))
    return away


@pytest.mark.exact
@pytest.mark.parametrize(
    "cycloid",
    [
        Cycloid(20, 19, 0.08, 0.005, 0.0025),
        Cycloid(40, 39, 0.064, 0.003, 0.0013),
        Cycloid(5, 4, 1.0, 0.2, 0.15),
    ],
)
def test_cycloid_flank(cycloid: Cycloid) -> None:
    """A pin on the ring leaves the flank of sources §3 on one side, and the one 2r away on the other."""
    pin = Circle((cycloid.pin_circle_radius, 0.0), cycloid.pin_radius)
    found = contacts(pin, cycloid_motion(cycloid), PHI)
    assert np.bincount(found.position).tolist() == [2] * PHI.size
    t = cycloid.contact_parameter(0, PHI)
    size = cycloid.pin_circle_radius
    assert nearest(found.point, cycloid.point(t), found.position).max() < 1e-12 * size
    other = cycloid.point(t) + 2.0 * cycloid.pin_radius * cycloid.normal(t)
    assert nearest(found.point, other, found.position).max() < 1e-12 * size


@pytest.mark.exact
@pytest.mark.parametrize("tooth", EXAMPLES)
def test_sphere_tooth(tooth: SphereTooth) -> None:
    """A pin on the sphere leaves the flank of sources §5, σ = 1 and σ = −1 at the two contacts."""
    found = contacts(pin_circle(tooth), tooth.relative_motion, PHI)
    assert np.bincount(found.position).tolist() == [2] * PHI.size
    p = tooth.contact_parameter(0, PHI)
    assert nearest(found.point, tooth.point(p), found.position).max() < 1e-12
    far = math.cos(2 * tooth.pin_angle) * tooth.point(p) + math.sin(2 * tooth.pin_angle) * tooth.normal(p)
    assert nearest(found.point, far, found.position).max() < 1e-12


@pytest.mark.exact
@given(tooth=teeth())
@settings(max_examples=40, deadline=None)
def test_any_sphere_tooth(tooth: SphereTooth) -> None:
    """As above for random pairs, with the normals: into the pin on the flank, out of the pin on the circle."""
    found = contacts(pin_circle(tooth), tooth.relative_motion, PHI)
    p = tooth.contact_parameter(0, PHI)
    assert nearest(found.point, tooth.point(p), found.position).max() < 1e-12
    assert nearest(found.normal, -tooth.normal(p), found.position).max() < 1e-11 / tooth.pin_angle


@pytest.mark.exact
@pytest.mark.parametrize("pressure_angle", [14.5, 20.0, 30.0])
def test_involute_of_a_rack(pressure_angle: float) -> None:
    """A straight flank leaves the involute of r_b = r cos α: radius r_b √(1 + s²), polar angle s − atan s."""
    alpha, r = math.radians(pressure_angle), 0.05
    motion = RackMotion(r)
    flank = Line((r, 0.0), -alpha)
    phi = np.linspace(-0.6, 0.6, 41)
    u = contact_near(flank, motion, phi, np.zeros(41))
    point = generated(flank, motion, u, phi)
    z = point[:, 0] + 1j * point[:, 1]
    base = r * math.cos(alpha)
    unwound = math.tan(alpha) + phi  # roll angle on the base circle
    radius = base * np.sqrt(1.0 + unwound**2)
    np.testing.assert_allclose(np.abs(z), radius, atol=1e-12 * r)
    involute = unwound - np.arctan(unwound)
    at_pitch = math.tan(alpha) - alpha
    np.testing.assert_allclose(np.angle(z), at_pitch - involute, atol=1e-12)


@pytest.mark.exact
def test_circles_about_one_axis() -> None:
    """Without a distance between the axes a pin only sweeps rings: contacts on the line through both centres."""
    found = contacts(Circle((3.0, 0.0), 0.5), ParallelAxes(0.0, 1.0, 0.3), PHI)
    radius = np.linalg.norm(found.point, axis=-1)
    np.testing.assert_allclose(np.sort(radius), np.repeat([2.5, 3.5], PHI.size), rtol=1e-14)
    found = contacts(SmallCircle((math.sin(0.9), 0.0, math.cos(0.9)), 0.1), MeetingAxes(0.0, 1.0, 0.3), PHI)
    np.testing.assert_allclose(
        np.sort(np.arccos(found.point[:, 2])), np.repeat([0.8, 1.0], PHI.size), rtol=1e-13
    )


@pytest.mark.property
def test_inversion_gives_the_pins_back() -> None:
    """The flank, carried by the motion the other way round, leaves the pin again: a circle about the pin's axis."""
    tooth = EXAMPLES[5]
    way = tooth.relative_motion
    back = MeetingAxes(-way.angle, -way.second, -way.first)
    found = contacts(tooth, back, PHI, samples=720)
    axis = np.array(pin_circle(tooth).pole)
    turns = 2.0 * math.pi * np.arange(tooth.pins) / tooth.pins
    pins = np.stack((axis[0] * np.cos(turns), axis[0] * np.sin(turns), np.full(tooth.pins, axis[2])), axis=-1)
    away = np.arccos(np.clip(found.point @ pins.T, -1.0, 1.0)).min(axis=1)
    on_pin = np.abs(away - tooth.pin_angle) < 1e-12
    assert np.bincount(found.position[on_pin], minlength=PHI.size).tolist() == [tooth.pins] * PHI.size


@pytest.mark.independent
@given(seed=st.integers(0, 2**31 - 1))
@settings(max_examples=30, deadline=None)
def test_velocity_spin_and_slope_are_derivatives(seed: int) -> None:
    """Central differences of the carried points, directions and of the equation itself."""
    rng = np.random.default_rng(seed)
    a, b, d = rng.uniform(-2.0, 2.0, 3)
    u, phi, h = rng.uniform(0.0, 6.0, 9), rng.uniform(-3.0, 3.0, 9), 1e-5
    cases = (
        (Circle((1.0, 0.3), 0.4), ParallelAxes(d, a, b)),
        (Circle((1.0, 0.3), 0.4), RackMotion(d)),
        (SmallCircle((0.4, 0.5, 0.6), 0.3), MeetingAxes(d, a, b)),
    )
    for curve, motion in cases:
        points, tangent = curve.point(u), curve.tangent(u)
        for whole, rate, carry in (
            (points, motion.velocity, motion.carry),
            (tangent, motion.spin, motion.direct),
        ):
            change = (carry(whole, phi + h) - carry(whole, phi - h)) / (2.0 * h)
            np.testing.assert_allclose(motion.direct(rate(whole, phi), phi), change, atol=1e-7)
        slope = (meshing(curve, motion, u + h, phi) - meshing(curve, motion, u - h, phi)) / (2.0 * h)
        np.testing.assert_allclose(meshing_slope(curve, motion, u, phi), slope, atol=1e-7)


@pytest.mark.exact
def test_a_branch_is_followed_or_the_failure_is_said() -> None:
    """Newton from near the contact gives the contact that the search finds; what never touches says so."""
    tooth = EXAMPLES[0]
    found = contacts(pin_circle(tooth), tooth.relative_motion, PHI)
    again = contact_near(
        pin_circle(tooth), tooth.relative_motion, PHI[found.position], found.parameter + 0.05
    )
    np.testing.assert_allclose(again, found.parameter, atol=1e-12)
    with pytest.raises(NotConverged, match="search the whole curve"):
        contact_near(Line((0.05, 0.0), 0.2), ParallelAxes(0.01, 1.0, -1.0), np.array([0.3]), np.array([0.0]))

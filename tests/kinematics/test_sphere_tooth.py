"""The sphere tooth against the motion that generates it, its own derivatives, brute force and the plane cycloid."""

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.kinematics.sphere_cases import EXAMPLES, teeth, tooth
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.nutation import satellite_motion
from trochoid.kinematics.sphere_tooth import Carrier, SphereTooth
from trochoid.kinematics.sphere_tooth_checks import (
    check_sphere_tooth,
    largest_nutation,
    overlap_angle,
    sphere_tooth_faults,
)
from trochoid.kinematics.sphere_tooth_clearance import clear_pin_angle, penetration
from trochoid.kinematics.spherical import angle_between, rotation, turn

Array = npt.NDArray[np.float64]


def in_fixed_frame(flank: SphereTooth, vectors: Array, crank: Array) -> Array:
    """Vectors (n, k, 3) of the flank's body at crank angles (n,), in the fixed frame."""
    if flank.pins_on == "satellite":
        return vectors
    return satellite_motion(flank.pair, crank).to_fixed(vectors)


def pin_axes(flank: SphereTooth, crank: Array) -> Array:
    """Axes (n, pins, 3) of all pins in the fixed frame."""
    turns = 2.0 * math.pi * np.arange(flank.pins) / flank.pins
    s, c = math.sin(flank.polar_angle), math.cos(flank.polar_angle)
    own = np.stack((s * np.cos(turns), s * np.sin(turns), np.full(flank.pins, c)), axis=-1)
    if flank.pins_on == "ring":
        return np.broadcast_to(own, (crank.size, *own.shape))
    return satellite_motion(flank.pair, crank).to_fixed(own)


@pytest.mark.property
@given(flank=teeth(), seed=st.integers(0, 2**31 - 1))
@settings(max_examples=60, deadline=None)
def test_every_pin_touches_the_flank_at_every_crank_angle(flank: SphereTooth, seed: int) -> None:
    """Conjugacy: point and normal at the contact parameter lead to the pin's axis, r away, within 1e-12 rad.

    The common normal, a great circle, also goes through the instantaneous axis (law of gearing on the sphere).
    """
    crank = np.random.default_rng(seed).uniform(-20.0, 20.0, 7)
    p = flank.contact_parameter(np.arange(flank.pins), crank[:, None])
    point = in_fixed_frame(flank, flank.point(p), crank)
    normal = in_fixed_frame(flank, flank.normal(p), crank)
    pins = math.cos(flank.pin_angle) * point + math.sin(flank.pin_angle) * normal
    np.testing.assert_allclose(pins, pin_axes(flank, crank), atol=1e-12)
    axis = satellite_motion(flank.pair, crank).instantaneous_axis()
    through = np.einsum("nkj,nj->nk", np.cross(point, normal), axis)
    np.testing.assert_allclose(through, 0.0, atol=1e-11)


@pytest.mark.independent
@given(flank=teeth())
@settings(max_examples=40, deadline=None)
def test_no_pin_penetrates_anywhere(flank: SphereTooth) -> None:
    """Brute force over the flank, every crank angle and every pin: nothing deeper than 1e-12 rad."""
    assert penetration(flank) <= 1e-12


@pytest.mark.independent
@pytest.mark.parametrize("flank", EXAMPLES)
def test_no_flank_point_is_ever_inside_a_pin(flank: SphereTooth) -> None:
    """The same without the path: bodies posed at many crank angles, all pins, distances as they are."""
    crank = np.linspace(0.0, 2.0 * math.pi * flank.satellite_teeth, 60 * flank.satellite_teeth)
    p = np.linspace(0.0, 2.0 * math.pi / flank.lobes, 25)
    points = in_fixed_frame(flank, np.broadcast_to(flank.point(p), (crank.size, 25, 3)), crank)
    cosine = points @ np.swapaxes(pin_axes(flank, crank), 1, 2)
    assert cosine.max() <= math.cos(flank.pin_angle) + 1e-13


@pytest.mark.independent
@pytest.mark.parametrize("flank", EXAMPLES)
def test_tangent_speed_and_curvature_are_those_of_the_points(flank: SphereTooth) -> None:
    """Spectral derivatives of the points (FFT over a round) know no formula for normal or curvature."""
    n = 1 << 15
    p = 2.0 * math.pi * np.arange(n) / n
    wave = 1j * np.fft.fftfreq(n, 1.0 / n)[:, None]
    points = flank.point(p)
    spectrum = np.fft.fft(points, axis=0)
    spectrum[np.abs(spectrum) < 1e-13 * np.abs(spectrum).max()] = 0.0
    first, second = (np.fft.ifft(wave**k * spectrum, axis=0).real for k in (1, 2))
    speed = np.linalg.norm(first, axis=1)
    np.testing.assert_allclose(flank.speed(p), speed, rtol=1e-8)
    np.testing.assert_allclose(flank.tangent(p), first / speed[:, None], atol=1e-8)
    out = np.cross(flank.tangent(p), points) * (-1.0 if flank.hole else 1.0)
    np.testing.assert_allclose(flank.normal(p), out, atol=1e-8)
    bend = -np.sum(second * flank.normal(p), axis=1) / speed**2
    np.testing.assert_allclose(flank.curvature(p), bend, atol=1e-6 * np.abs(bend).max())


@pytest.mark.exact
@given(flank=teeth())
@settings(max_examples=40, deadline=None)
def test_curvature_as_the_sources_print_it(flank: SphereTooth) -> None:
    """Sources §5: the two forms of κ, for pins on the ring and on the satellite, with a·u and e_z·u."""
    p = np.linspace(0.0, 1.0, 50)
    t = flank.crank_angle(p)
    nu, k, a = float(flank.pair.tooth_ratio), np.array([0.0, 0.0, 1.0]), flank.pair.axis
    pin = np.array([math.sin(flank.polar_angle), 0.0, math.cos(flank.polar_angle)])
    if flank.pins_on == "ring":
        u, W = turn(rotation(2, -t), pin), -k + nu * a
        size, w = np.linalg.norm(np.cross(W, u), axis=-1), u @ W
        kappa = nu * (u @ a) / size - w * (W @ k - w * (u @ k)) / size**3
    else:
        u, W = turn(rotation(1, flank.nutation) @ rotation(2, -nu * t), pin), k - nu * a
        size, w = np.linalg.norm(np.cross(W, u), axis=-1), u @ W
        kappa = (u @ k) / size - nu * w * (W @ a - w * (u @ a)) / size**3
    np.testing.assert_allclose(
        flank.center_path_curvature(p), kappa, rtol=1e-9, atol=1e-9 * np.abs(kappa).max()
    )


@pytest.mark.independent
@given(flank=teeth())
@settings(max_examples=40, deadline=None)
def test_undercut_limit_is_the_least_radius_of_curvature(flank: SphereTooth) -> None:
    """The quadratic's extreme against a search on a grid; beyond it the flank turns back, before it not."""
    p = np.linspace(0.0, math.pi, 20001) / flank.lobes
    steepest = (flank.side * flank.center_path_curvature(p)).max()
    assert flank.steepest_curvature == pytest.approx(steepest, rel=1e-4, abs=1e-6)
    assert flank.steepest_curvature >= steepest - 1e-9 * abs(steepest)
    for share, regular in ((1.0 - 1e-4, True), (1.0 + 1e-4, False)):
        other = replace(flank, pin_angle=share * flank.undercut_angle)
        assert bool((other.speed(p) > 0.0).all()) is regular


@pytest.mark.property
@given(flank=teeth())
@settings(max_examples=40, deadline=None)
def test_symmetries_of_the_flank(flank: SphereTooth) -> None:
    """Mirror symmetry about valley and crest, one lobe like the next, closed after a period."""
    p = np.linspace(0.0, 1.0, 50)
    mirror = np.array([1.0, -1.0, 1.0])
    pitch = 2.0 * math.pi / flank.lobes
    for got, expected in (
        (flank.point(-p), flank.point(p) * mirror),
        (flank.normal(-p), flank.normal(p) * mirror),
        (turn(rotation(2, -pitch), flank.point(pitch - p)), flank.point(p) * mirror),
        (flank.point(p + pitch), turn(rotation(2, pitch), flank.point(p))),
        (flank.point(p + flank.period), flank.point(p)),
    ):
        np.testing.assert_allclose(got, expected, atol=1e-12)


@pytest.mark.property
@given(flank=teeth())
@settings(max_examples=40, deadline=None)
def test_inversion_swaps_the_fixed_member(flank: SphereTooth) -> None:
    """Pins on ring or satellite: the same two members, so the same flank, half a lobe further."""
    swapped: Carrier = "satellite" if flank.pins_on == "ring" else "ring"
    other = replace(flank, pins_on=swapped)
    p, half = np.linspace(0.0, 3.0, 60), math.pi / flank.lobes
    np.testing.assert_allclose(other.point(p + half), turn(rotation(2, half), flank.point(p)), atol=1e-12)
    np.testing.assert_allclose(other.normal(p + half), turn(rotation(2, half), flank.normal(p)), atol=1e-11)
    assert other.undercut_angle == pytest.approx(flank.undercut_angle, rel=1e-9)
    assert other.pair.ratio + flank.pair.ratio == 1


@pytest.mark.property
@given(flank=teeth(), turned=st.floats(-3.0, 3.0))
@settings(max_examples=30, deadline=None)
def test_rotation_of_the_frame_changes_nothing(flank: SphereTooth, turned: float) -> None:
    """Turning the crank and a pin together by 2π/pins brings the next pin to the same place on the next tooth.

    The distance between pin and flank points is thus the same in any frame and for any pin.
    """
    crank = np.array([turned])
    k = np.arange(flank.pins)
    p = flank.contact_parameter(k, crank[:, None])
    points = in_fixed_frame(flank, flank.point(p), crank)
    away = angle_between(points, pin_axes(flank, crank))
    np.testing.assert_allclose(away, flank.pin_angle, atol=1e-12)


@pytest.mark.property
@given(flank=teeth())
@settings(max_examples=30, deadline=None)
def test_lever_is_the_moment_of_the_normal(flank: SphereTooth) -> None:
    """(f × n)·e_z, and power balance: forces of all pins do work on neither member while the pair turns.

    What the normal gives the body about its own axis it takes from the arm: with W the relative angular
    velocity of the two members, (f × n)·W = 0 at each contact.
    """
    p = np.linspace(0.0, 2.0, 80)
    moment = np.cross(flank.point(p), flank.normal(p))
    np.testing.assert_allclose(flank.lever(p), moment[:, 2], atol=1e-12)
    crank = np.array([0.4])
    q = flank.contact_parameter(np.arange(flank.pins), crank[:, None])
    f, n = (in_fixed_frame(flank, v, crank)[0] for v in (flank.point(q), flank.normal(q)))
    relative = satellite_motion(flank.pair, crank).velocity[0]
    np.testing.assert_allclose(np.cross(f, n) @ relative, 0.0, atol=1e-12)


def wrapped(plane: Cycloid, radius: float, on: Carrier) -> SphereTooth:
    """The plane pair on a sphere of `radius` (m): angles are lengths over it."""
    alpha, r, nutation = (x / radius for x in (plane.pin_circle_radius, plane.pin_radius, plane.eccentricity))
    return SphereTooth(plane.pins, plane.lobes, alpha, r, nutation, pins_on=on)


@pytest.mark.exact
@pytest.mark.parametrize("on", ["ring", "satellite"])
@pytest.mark.parametrize(
    "plane", [Cycloid(20, 19, 0.08, 0.005, 0.0025), Cycloid(40, 39, 0.064, 0.003, 0.0013)]
)
def test_planar_limit(plane: Cycloid, on: Carrier) -> None:
    """R → ∞, α = R_p/R, ϑ = e/R, r = r_p/R: the plane flank, with an error that falls as R⁻² (sources §5)."""
    p = np.linspace(0.0, 2.0, 200)
    shift = 0.0 if on == "ring" else math.pi / plane.lobes
    errors = []
    for R in (1.0, 2.0, 4.0, 8.0, 16.0):
        sphere = wrapped(plane, R, on)
        places = turn(rotation(2, -shift), sphere.point(p + shift))[:, :2] * R
        bend = sphere.curvature(p + shift) / R
        errors.append((np.abs(places - plane.point(p)).max(), np.abs(bend - plane.curvature(p)).max()))
    falls = np.log2(np.array(errors)[:-1] / np.array(errors)[1:])
    np.testing.assert_allclose(falls[1:], 2.0, atol=0.02)
    limit = wrapped(plane, 100.0, on).undercut_angle
    assert 100.0 * limit == pytest.approx(plane.undercut_radius, rel=1e-5)


@pytest.mark.independent
def test_global_limit_where_it_binds() -> None:
    """At 27.6° nutation a pin within its local limit cuts the flank at another crank angle; the check sees it."""
    wide = tooth(24, 25, 89.0, 2.5, 27.6)
    assert wide.pin_angle < wide.undercut_angle
    assert penetration(wide) > 1e-2
    limit = clear_pin_angle(wide)
    assert limit < 0.8 * wide.undercut_angle
    assert penetration(replace(wide, pin_angle=(1.0 - 1e-9) * limit)) <= 1e-12
    assert penetration(replace(wide, pin_angle=1.01 * limit), samples=2000) > 1e-6
    assert any("at another crank angle" in fault for fault in sphere_tooth_faults(wide))


@pytest.mark.independent
@given(flank=teeth())
@settings(max_examples=25, deadline=None)
def test_pin_beyond_the_clear_angle_penetrates(flank: SphereTooth) -> None:
    """The limit is sharp: 2 % beyond it brute force finds the cut."""
    limit = clear_pin_angle(flank)
    assume(limit < 1.4)
    beyond = replace(flank, pin_angle=1.02 * limit)
    assert penetration(beyond, samples=800) > 1e-9 * limit


@pytest.mark.exact
@given(flank=teeth())
@settings(max_examples=30, deadline=None)
def test_range_of_nutation(flank: SphereTooth) -> None:
    """At the largest nutation the pin's axis meets the instantaneous axis, where the path's speed is 0."""
    limit = largest_nutation(flank)
    assume(limit < 0.99 * flank.polar_angle)
    at = replace(flank, nutation=(1.0 - 1e-8) * limit, pin_angle=0.0)
    near = math.pi if (flank.pins_on == "ring") == (flank.difference < 0) else 0.0
    assert abs(float(at.speed(near / flank.lobes))) < 1e-6 * flank.satellite_teeth
    assert not sphere_tooth_faults(flank)


@pytest.mark.exact
def test_refusals_name_the_condition_and_the_nearest_feasible_value() -> None:
    """Tooth difference, side, ranges of angles, undercut, overlapping pins; the advice then passes."""
    with pytest.raises(Infeasible, match="take lobes = 29 or 31"):
        tooth(30, 28, 65.0, 2.5, 3.0)
    with pytest.raises(Infeasible, match="side is 1 or −1"):
        tooth(30, 29, 65.0, 2.5, 3.0, side=0)
    for wrong, said in (
        (tooth(30, 29, 65.0, 2.5, 5.0), "nutation = 5°: out of range.*just below 3.82487°"),
        (
            tooth(30, 29, 65.0, 4.0, 3.0),
            "undercut; feasible is a pin_angle just below 3.0576°.*nutation just below 1.38",
        ),
        (tooth(30, 29, 65.0, 6.0, 0.5), "neighbouring pins overlap; it must be less than .* = 5.43607°"),
        (tooth(30, 29, 95.0, 2.5, 3.0), "polar_angle = 95°: it must be above 0° and at most 90°"),
        (tooth(30, 29, 65.0, 0.0, 3.0), "pin_angle = 0°: a positive angle"),
        (tooth(30, 29, 65.0, 2.5, -1.0), "nutation = -1°: a positive angle"),
        (tooth(3, 2, 65.0, 2.5, 3.0), "at least 3 of each"),
    ):
        with pytest.raises(Infeasible, match=said):
            check_sphere_tooth(wrong)
    for right in (
        tooth(30, 29, 65.0, 2.5, 3.0),
        tooth(30, 29, 65.0, 3.0575, 3.0),
        tooth(30, 29, 65.0, 4.0, 1.387),
        tooth(30, 29, 65.0, 0.05, 3.8248),
    ):
        check_sphere_tooth(right)
    assert math.degrees(overlap_angle(tooth(30, 29, 65.0, 2.5, 3.0))) == pytest.approx(5.43607, abs=5e-6)

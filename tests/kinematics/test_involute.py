"""Involute gears: the function and its inverse, one gear, a pair, what tools leave; against brute force."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from tests.kinematics.involute_cases import depth, rack_tooth, roll_rack, roll_shaper, shaper_tooth
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear, inverse_involute, involute
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.involute_cut import Cut
from trochoid.kinematics.involute_measure import constant_chord, over_pins, span
from trochoid.kinematics.involute_pair import Pair, mesh, mesh_at, needed_shift
from trochoid.kinematics.rack import Rack, rack_cut
from trochoid.kinematics.shaper import Shaper, cutting_pair, ring_boundary, ring_root_radius, shaper_cut

M = 2e-3
RACK = Rack(M)
RING = Gear(80, M, shift=1.768, internal=True)
CUTTER = Shaper(25, 0.15, 55.6e-3)


@st.composite
def rack_cuts(draw: st.DrawFn) -> Cut:
    """External gears of 8 to 120 teeth, undercut ones among them, with tip roundings up to the full."""
    teeth, shift = draw(st.integers(8, 120)), draw(st.floats(-0.6, 1.2))
    alpha = math.radians(draw(st.floats(14.0, 25.0)))
    gear = Gear(teeth, M, alpha, shift)
    limit = (0.25 * math.pi - 1.25 * math.tan(alpha)) * math.cos(alpha) / (1.0 - math.sin(alpha))
    rack = Rack(M, alpha, 1.25, draw(st.floats(0.0, 0.999)) * limit)
    return rack_cut(gear, rack)


@st.composite
def shaper_cuts(draw: st.DrawFn) -> tuple[Cut, Shaper]:
    """Rings and external gears cut by a shaper of 12 to 30 teeth, sharp or rounded."""
    internal = draw(st.booleans())
    teeth = draw(st.integers(45, 120) if internal else st.integers(12, 100))
    gear = Gear(teeth, M, shift=draw(st.floats(0.0, 1.0)), internal=internal)
    z0, x0 = draw(st.integers(16, 30)), draw(st.floats(-0.1, 0.15))
    shaper = Shaper(z0, x0, M * (z0 + 2.0 * (1.25 + x0)), draw(st.sampled_from([0.0, 0.05, 0.15])) * M)
    return shaper_cut(gear, shaper), shaper


def curve_of(cut: Cut) -> GearCurve:
    """The gear with tips of a height of 0.8 modules, or as high as its teeth are not pointed."""
    gear = cut.gear
    end = math.hypot(gear.base_radius, cut.start)
    tip = gear.pitch_radius + gear.module * (float(gear.shift) + gear.side * 0.8)
    if gear.internal:
        return GearCurve(cut, max(tip, 1.0001 * gear.base_radius))
    while gear.thickness_at(tip) < 0.05 * M:
        tip -= 0.05 * M
    assume(tip > 1.001 * end)
    return GearCurve(cut, tip)


@pytest.mark.independent
def test_inverse_of_the_involute_function() -> None:
    """Against a bracketing solver, from 0.1° to 89°, and back."""
    angle = np.radians(np.concatenate((np.linspace(0.1, 89.0, 500), [20.0])))
    np.testing.assert_allclose(inverse_involute(involute(angle)), angle, rtol=1e-9)
    for value in (1e-6, 0.014904, 0.3, 7.0):
        solved = brentq(lambda a, v=value: math.tan(a) - a - v, 1e-6, 1.57, xtol=1e-15)
        assert inverse_involute(value) == pytest.approx(solved, rel=1e-10)
    assert involute(math.radians(20.0)) == pytest.approx(0.014904383867, abs=5e-13)  # tables of inv 20°
    assert inverse_involute(0.0) == 0.0
    assert math.isnan(inverse_involute(-1e-3))


@pytest.mark.exact
def test_ring_is_the_negative_of_an_external_gear() -> None:
    """A ring's space is the tooth of the external gear with the same teeth and shift, at every radius."""
    ring, gear = Gear(60, M, shift=0.4, internal=True), Gear(60, M, shift=0.4)
    for radius in (0.0575, 0.06, 0.0615):
        space = 2.0 * radius * ring.flank_angle(radius)
        assert space == pytest.approx(gear.thickness_at(radius), rel=1e-12)


@pytest.mark.exact
@pytest.mark.parametrize("gear", [Gear(20, M, shift=0.5), Gear(12, M), Gear(80, M, shift=2.0, internal=True)])
def test_flanks_meet_at_the_point_radius(gear: Gear) -> None:
    assert gear.thickness_at(gear.point_radius) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.independent
@given(cut=rack_cuts(), roll=st.floats(-0.5, 0.5))
@settings(max_examples=30, deadline=None)
def test_a_rack_touches_its_cut_and_never_enters_it(cut: Cut, roll: float) -> None:
    """Brute force: points of the rack, rolled, lie at most 1e-12 of the radius in the gear; the cut fits."""
    gear, fillet = cut.gear, cut.fillet
    rack = Rack(M, gear.pressure_angle, 1.25, fillet.rounding / M)
    tooth = rack_tooth(rack, float(gear.shift), 1.0 - float(gear.shift))
    rolls = np.concatenate((roll + np.linspace(-0.05, 0.05, 21), np.linspace(-1.2, 1.2, 121)))
    inside = depth(cut, roll_rack(tooth, gear.pitch_radius, rolls))
    assert inside.max() <= 1e-12 * gear.pitch_radius
    # every point of the fillet is touched at its own roll: there the corner's centre is ρ away along the normal
    phi = np.linspace(fillet.root, fillet.end, 50)
    center = fillet.point(phi) - fillet.rounding * -fillet.normal(phi)
    expected = np.exp(1j * phi) * (gear.pitch_radius + fillet.corner - 1j * gear.pitch_radius * phi)
    np.testing.assert_allclose(center, expected, atol=1e-13 * gear.pitch_radius)


@pytest.mark.independent
@given(pair=shaper_cuts(), roll=st.floats(-0.3, 0.3))
@settings(max_examples=30, deadline=None)
def test_a_shaper_touches_its_cut_and_never_enters_it(pair: tuple[Cut, Shaper], roll: float) -> None:
    """Brute force as for the rack, with both kinds of gear, sharp and rounded cutters."""
    cut, shaper = pair
    generation = cutting_pair(cut.gear, shaper)
    tooth = shaper_tooth(generation, shaper)
    rolls = np.concatenate((roll + np.linspace(-0.02, 0.02, 21), np.linspace(-0.6, 0.6, 121)))
    points = roll_shaper(tooth, generation, rolls)
    # a gear has no material beyond its tips, nor an involute beyond its base circle
    gear = cut.gear
    beyond = gear.side * (np.abs(points) - gear.pitch_radius) > (1.0 + gear.side * float(gear.shift)) * M
    # and a cutter trims what its involute, from its own base circle on, does not reach
    reach = np.hypot(gear.base_radius, float(generation.action))
    beyond |= gear.side * (np.abs(points) - reach) > 0.0
    inside = depth(cut, points[~beyond])
    assert inside.max() <= 1e-12 * cut.gear.pitch_radius
    assert inside.max() >= -1e-5 * cut.gear.pitch_radius


@pytest.mark.independent
@given(cut=rack_cuts())
@settings(max_examples=15, deadline=None)
def test_rack_curves_are_closed_and_consistent(cut: Cut) -> None:
    check_curve(curve_of(cut))


@pytest.mark.independent
@given(pair=shaper_cuts())
@settings(max_examples=15, deadline=None)
def test_shaper_curves_are_closed_and_consistent(pair: tuple[Cut, Shaper]) -> None:
    check_curve(curve_of(pair[0]))


def check_curve(curve: GearCurve) -> None:
    """Points without jumps; tangent, normal, speed and curvature as differences of the points; symmetry."""
    z, size = curve.cut.gear.teeth, curve.cut.gear.pitch_radius
    gear = curve.cut.gear
    near = np.concatenate((curve.corners[:6], [0.0]))
    np.testing.assert_allclose(curve.point(near - 1e-13), curve.point(near + 1e-13), atol=1e-11 * size)
    t = np.linspace(0.003, 0.997, 331)
    t = t[np.abs(t[:, None] - curve.corners[:6]).min(axis=1) > 2e-3]
    h = 1e-5
    velocity = (curve.point(t + h) - curve.point(t - h)) / (2.0 * h)
    speed = np.linalg.norm(velocity, axis=-1)
    np.testing.assert_allclose(curve.speed(t), speed, rtol=2e-4, atol=1e-7 * size)
    moving = speed > 1e-3 * speed.max()
    tangent = curve.tangent(t)
    np.testing.assert_allclose(tangent[moving], velocity[moving] / speed[moving, None], atol=1e-3)
    normal = gear.side * np.stack((tangent[:, 1], -tangent[:, 0]), axis=-1)
    np.testing.assert_allclose(curve.normal(t), normal, atol=1e-14)
    turn = gear.side * (curve.tangent(t + h) - curve.tangent(t - h)) / (2.0 * h)
    bend = np.sum(turn * np.stack((-tangent[:, 1], tangent[:, 0]), axis=-1), axis=-1)
    np.testing.assert_allclose((curve.curvature(t) * speed)[moving], bend[moving], rtol=1e-3, atol=1e-3)
    # closed over a pitch, mirror symmetric about the spaces
    pitch = np.exp(2j * math.pi / z)
    at = curve.point(t) @ np.array([1.0, 1j])
    np.testing.assert_allclose(curve.point(t + 1.0) @ np.array([1.0, 1j]), at * pitch, atol=1e-13 * size)
    np.testing.assert_allclose(curve.point(t + curve.period), curve.point(t), atol=1e-12 * size)
    np.testing.assert_allclose(curve.point(-t), curve.point(t) * [1.0, -1.0], atol=1e-13 * size)


@pytest.mark.exact
def test_arc_length_of_a_gear() -> None:
    """The length of the pieces: circles, involute (ρ_a² − ρ_l²)/(2 r_b); only the fillet is summed."""
    curve = GearCurve(rack_cut(Gear(20, M, shift=0.5), RACK), 22.732e-3)
    cut, gear = curve.cut, curve.cut.gear
    flank = (gear.curvature_radius(curve.tip_radius) ** 2 - cut.start**2) / (2.0 * gear.base_radius)
    phi = np.linspace(cut.fillet.root, cut.fillet.end, 20001)
    fillet = np.abs(np.diff(cut.fillet.point(phi))).sum()
    arcs = 2.0 * cut.root_radius * cut.fillet.root + gear.thickness_at(curve.tip_radius)
    assert ArcLength(curve).total == pytest.approx(20 * (2.0 * (flank + fillet) + arcs), rel=1e-8)


@pytest.mark.property
@given(cut=rack_cuts(), scale=st.floats(1e-2, 1e2))
@settings(max_examples=30, deadline=None)
def test_scale_invariance(cut: Cut, scale: float) -> None:
    """A larger module enlarges points and leaves directions; curvature falls."""
    gear, rack = cut.gear, Rack(scale * M, cut.gear.pressure_angle, 1.25, cut.fillet.rounding / M)
    large = rack_cut(Gear(gear.teeth, scale * M, gear.pressure_angle, gear.shift), rack)
    one = curve_of(cut)
    other = GearCurve(large, scale * one.tip_radius)
    t = np.linspace(0.0, 1.0, 173)
    np.testing.assert_allclose(other.point(t) / scale, one.point(t), atol=1e-11 * gear.pitch_radius)
    np.testing.assert_allclose(other.normal(t), one.normal(t), atol=1e-7)
    assert large.boundary / scale == pytest.approx(cut.boundary, abs=1e-14)


@pytest.mark.exact
@given(cut=rack_cuts())
@settings(max_examples=60, deadline=None)
def test_fillet_meets_the_involute_tangentially_unless_undercut(cut: Cut) -> None:
    """Without undercut at ρ_l with a common normal; undercut at a corner where the involute is left."""
    gear, end = cut.gear, cut.fillet.end
    point, normal = cut.fillet.point(end), cut.fillet.normal(end)
    radius = float(np.abs(point))
    assert radius == pytest.approx(math.hypot(gear.base_radius, cut.start), rel=1e-9)
    assert float(np.angle(point)) == pytest.approx(float(gear.flank_angle(radius)), abs=1e-7)
    involute_normal = -1j * np.exp(1j * (gear.base_angle + cut.start / gear.base_radius))
    off = abs(normal - involute_normal)
    assert cut.undercut is bool(cut.boundary < 0.0)
    if not cut.undercut:
        assert cut.boundary == cut.start
        assert off < 1e-11
    assert np.all(cut.fillet.growth(np.linspace(cut.fillet.root, end, 50)) > 0.0)


@pytest.mark.exact
def test_undercut_begins_at_the_least_shift() -> None:
    """x_min = h_l* − z sin²α/2, with h_l* the straight height of the rack (here h_a* with ρ_f = c/(1 − sin α))."""
    rack = Rack(M, rounding=0.25 / (1.0 - math.sin(math.radians(20.0))))
    assert rack.straight == pytest.approx(1.0, abs=1e-15)
    for teeth in (10, 14, 17, 20):
        least = Gear(teeth, M).least_shift
        assert not rack_cut(Gear(teeth, M, shift=least + 1e-9), rack).undercut
        assert rack_cut(Gear(teeth, M, shift=least - 1e-9), rack).undercut


@pytest.mark.exact
def test_ring_root_and_boundary_agree_with_the_cut() -> None:
    """d_f3 = 2a_w0 + d_a0 and ρ_l3 are those of the curve; a rounding shortens the flank."""
    sharp = shaper_cut(RING, CUTTER)
    assert sharp.root_radius == pytest.approx(ring_root_radius(RING, CUTTER), rel=1e-14)
    assert sharp.boundary == pytest.approx(ring_boundary(RING, CUTTER), rel=1e-14)
    assert shaper_cut(RING, Shaper(25, 0.15, 55.6e-3, 0.3e-3)).boundary < sharp.boundary


@pytest.mark.property
def test_a_large_shaper_cuts_like_a_rack() -> None:
    """As z0 grows, the fillet of a shaper with the rack's tip height tends to the rack's, as 1/z0."""
    gear, sharp = Gear(24, M, shift=0.3), Rack(M, rounding=0.0)
    t = np.linspace(0.0, 0.5, 60)
    exact = GearCurve(rack_cut(gear, sharp), 25.5e-3).point(t)

    def off(z0: int) -> float:
        cut = shaper_cut(gear, Shaper(z0, 0.0, M * (z0 + 2.5)))
        return float(np.abs(GearCurve(cut, 25.5e-3).point(t) - exact).max())

    assert off(4000) / off(8000) == pytest.approx(2.0, rel=0.01)


@pytest.mark.exact
@given(
    z=st.tuples(st.integers(10, 60), st.integers(10, 120)),
    x=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
    internal=st.booleans(),
)
@settings(max_examples=80, deadline=None)
def test_pair_closes_between_shifts_angle_and_distance(
    z: tuple[int, int], x: tuple[float, float], internal: bool
) -> None:
    """Shifts → α_w → a_w → α_w → shifts; the tooth fills the space of the mate on the pitch circle."""
    teeth = z[0] + z[1] + 5 if internal else z[1]
    shift = x[0] + x[1] if internal else x[1]
    one, two = Gear(z[0], M, shift=x[0]), Gear(teeth, M, shift=shift, internal=internal)
    pair = mesh(one, two)
    again = mesh_at(one, two, float(pair.center_distance))
    assert again.operating_angle == pytest.approx(pair.operating_angle, abs=1e-8)
    assert needed_shift(pair) == pytest.approx(pair.shift, abs=1e-11)
    assert pair.backlash == pytest.approx(0.0, abs=1e-14)
    r1, r2 = pair.pitch_radii
    pitch = 2.0 * math.pi * r1 / one.teeth
    assert one.thickness_at(r1) + two.thickness_at(r2) == pytest.approx(pitch, rel=1e-10)


@pytest.mark.exact
def test_backlash_along_the_line_of_action() -> None:
    """Play = (pitch − both thicknesses on the pitch circles) cos α_w, external and internal."""
    for two, distance in (
        (Gear(30, M, shift=0.3), 51.3e-3),
        (Gear(70, M, shift=0.9, internal=True), 50.6e-3),
    ):
        pair = mesh_at(Gear(20, M, shift=0.2), two, distance)
        r1, r2 = pair.pitch_radii
        free = 2.0 * math.pi * r1 / 20 - pair.first.thickness_at(r1) - two.thickness_at(r2)
        assert pair.backlash == pytest.approx(free * math.cos(pair.operating_angle), rel=1e-9)


@pytest.mark.exact
def test_sliding_is_zero_at_the_pitch_point_and_mirrors() -> None:
    """ϑ1 = 1 − ω2ρ2/(ω1ρ1) from velocities; swapping the gears of an external pair swaps the results."""
    one, two = Gear(20, M, shift=0.5), Gear(30, M, shift=0.634)
    pair, swapped = mesh(one, two), mesh(two, one)
    tips = (22.732e-3, 33e-3)
    assert pair.sliding(*tips) == pytest.approx(swapped.sliding(*tips[::-1])[::-1], rel=1e-12)
    assert pair.contact_ratio(*tips) == pytest.approx(swapped.contact_ratio(*tips[::-1]), rel=1e-12)
    rho = pair.pitch_radii[0] * math.sin(pair.operating_angle)
    assert 1.0 - pair.of_second(rho) / rho / pair.ratio == pytest.approx(0.0, abs=1e-12)


@pytest.mark.exact
@pytest.mark.parametrize(
    "gear", [Gear(20, M, shift=0.5), Gear(30, M, shift=0.634), RING, Gear(21, M, shift=-0.1)]
)
def test_measures_are_distances_on_the_flanks(gear: Gear) -> None:
    """A span is z_w pitches less a space on the base circle; a roller touches both flanks of a space."""
    reach = span(gear)
    pitch = math.pi * gear.module * math.cos(gear.pressure_angle)
    base_tooth = pitch - 2.0 * gear.base_radius * float(gear.base_angle)
    if gear.internal:
        base_tooth = 2.0 * gear.base_radius * float(gear.base_angle)
    assert reach.length == pytest.approx((reach.teeth - 1) * pitch + base_tooth, rel=1e-12)
    pins = over_pins(gear, 1.732 * gear.module)
    radius = math.hypot(gear.base_radius, pins.curvature_radius)
    foot = radius * np.exp(1j * float(gear.flank_angle(radius)))
    assert abs(foot - 0.5 * pins.center_diameter) == pytest.approx(0.5 * pins.diameter, rel=1e-9)
    chord = constant_chord(gear, gear.pitch_radius + gear.side * M)
    radius = math.hypot(gear.base_radius, chord.curvature_radius)
    # half the chord, seen from the middle of the tooth
    half = radius * math.sin(math.pi / gear.teeth - float(gear.flank_angle(radius)))
    assert 2.0 * half == pytest.approx(chord.length, rel=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Gear(2, M), "at least 3"),
        (lambda: Gear(20, -M), "must be positive"),
        (lambda: Gear(20, M, 1.6), "between 0 and 90°"),
        (lambda: mesh(Gear(20, M), Gear(20, M, internal=True)), "take at least 21"),
        (lambda: mesh(Gear(20, M, shift=-2.0), Gear(30, M)), "must be at least -1.02374"),
        (lambda: mesh(Gear(20, M), Gear(30, 2 * M)), "give both the same"),
        (lambda: Pair(RING, RING, 0.3), "give the ring as the second"),
        (lambda: mesh_at(Gear(20, M), Gear(30, M), 0.046), "more than a·cos α = 46.9846 mm"),
        (lambda: Rack(M, rounding=0.5), "between 0 and 0.4719"),
        (lambda: Rack(M, tip_height=2.2), "end in a point at 2.158"),
        (lambda: rack_cut(RING, RACK), "give a shaper cutter"),
        (lambda: rack_cut(Gear(4, M, shift=-1.0), RACK), "must exceed -0.75"),
        (lambda: shaper_cut(RING, Shaper(90, 0.0, 0.185)), "take at least 91, or a smaller planet"),
        (lambda: shaper_cut(RING, Shaper(25, 0.15, 0.046)), "above 46.9846 mm"),
        (lambda: shaper_cut(RING, Shaper(25, 0.15, 0.058)), "end in a point at 56.7582 mm"),
        (
            lambda: GearCurve(rack_cut(Gear(20, M), RACK), 0.025),
            "end in a point at 23.0.* take a smaller tip circle",
        ),
        (lambda: GearCurve(rack_cut(Gear(20, M), RACK), 0.0185), "above the end of the fillet"),
        (lambda: GearCurve(shaper_cut(RING, CUTTER), 0.075), "must lie between 75.1754 mm"),
        (lambda: over_pins(Gear(20, M), 0.1e-3), "take them larger"),
        (lambda: span(Gear(20, M, shift=-0.7)), "shift above -0.603"),
    ],
)
def test_impossible_gears_say_what_is_allowed(make: "object", message: str) -> None:
    with pytest.raises(Infeasible, match=message):
        make()  # type: ignore[operator]

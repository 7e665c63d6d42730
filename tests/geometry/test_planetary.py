"""Planetary sets: the assembled flanks do not penetrate, quality against brute force, refusals."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.kinematics.involute_cases import depth
from trochoid.geometry.blocking_line import coaxial_line
from trochoid.geometry.planetary import PlanetarySet, planetary
from trochoid.geometry.planetary_check import check_planetary, planetary_faults
from trochoid.geometry.planetary_curves import Members, members, poses
from trochoid.geometry.planetary_quality import Condition, Limits, quality
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.involute_pair import mesh, tip_clash
from trochoid.kinematics.shaper import Shaper
from trochoid.kinematics.types import Array, ComplexArray

SOURCE = PlanetarySet((20, 30, 80), 2e-3, 52e-3, (0.5, 0.634, 1.768), Shaper(25, 0.15, 55.6e-3), planets=4)


@st.composite
def sets(draw: st.DrawFn) -> PlanetarySet:
    """Feasible sets without play: random teeth, centre distance, and place on the coaxiality line."""
    z1, z2 = draw(st.integers(14, 40)), draw(st.integers(16, 40))
    cutter = Shaper(z0 := draw(st.integers(16, 25)), 0.1, 2e-3 * (z0 + 2.0 * 1.35))
    distance = 1e-3 * (z1 + z2) * (1.0 + draw(st.floats(0.0, 0.035)))
    given = PlanetarySet((z1, z2, z1 + 2 * z2), 2e-3, distance, (0.0, 0.0, 0.0), cutter, planets=1)
    line = coaxial_line(given, limits=Limits(0.2e-3, 1.1))
    assume(line.stretches)
    stretch = line.stretches[0]
    x1 = stretch.low + (stretch.high - stretch.low) * draw(st.floats(0.0, 1.0))
    return replace(given, shifts=line.shifts(x1))


def cloud(curve: GearCurve, count: int = 240) -> ComplexArray:
    """Points of all the gear's pieces over three teeth, their corners among them."""
    corners = curve.corners[:6] - np.array([[-1.0], [0.0], [1.0], [2.0]])
    points = curve.point(np.concatenate((np.linspace(-1.5, 1.5, 3 * count + 1), corners.ravel())))
    return np.asarray(points[:, 0] + 1j * points[:, 1])


def penetrations(given: PlanetarySet, parts: Members, carrier: Array, ring: Array) -> tuple[Array, Array]:
    """Deepest penetration (m) of the first planet's teeth into sun and ring at the angles (n,) each."""
    at = poses(given, carrier, ring)
    center = at.center[:, 0] @ np.array([1.0, 1j])
    # teeth of the planet that point to the sun and to the ring
    out = []
    for part, angle, inward in ((parts.sun, at.sun, True), (parts.ring, at.ring, False)):
        toward = np.angle(center) + (math.pi if inward else 0.0) - at.planet[:, 0]
        near = np.round(toward * given.teeth[1] / (2.0 * math.pi)) * 2.0 * math.pi / given.teeth[1]
        planet = cloud(parts.planet) * np.exp(1j * (near + at.planet[:, 0]))[:, None] + center[:, None]
        local = planet * np.exp(-1j * angle)[:, None]
        inside = depth(part.cut, local)
        tip = part.cut.gear.side * (np.abs(local) - part.tip_radius) > 0.0
        out.append(np.where(tip, -1.0, inside).max(axis=1))
    return out[0], out[1]


@pytest.mark.property
@given(set_=sets(), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=12, deadline=None)
def test_flanks_touch_and_do_not_penetrate(set_: PlanetarySet, seed: int) -> None:
    """Conjugacy of the assembled set, brute force, at random angles of carrier and ring: ≤ 1e-12 of the radius."""
    carrier, ring = np.random.default_rng(seed).uniform(-7.0, 7.0, (2, 24))
    for deepest in penetrations(set_, members(set_), carrier, ring):
        assert deepest.max() <= 1e-12 * set_.center_distance
        assert deepest.min() > -2e-5 * set_.center_distance  # between two of the points, a flank touches


@pytest.mark.property
def test_all_planets_mesh_alike() -> None:
    """With (z1 + z3)/n whole, each of the four planets stands to sun and ring as the first one does, a pitch on."""
    exact = replace(SOURCE, shifts=tuple(coaxial_line(SOURCE).shifts(0.5)))
    at = poses(exact, 0.37)
    z1, z2, z3 = exact.teeth
    place = np.angle(at.center @ np.array([1.0, 1j]))
    for angle, z, sign in ((at.sun, z1, 1.0), (at.ring, z3, -1.0)):
        # phases of both gears on the line of centres, in pitches, add up to the same fraction
        phase = (place - angle) * z + sign * (place + (math.pi if z == z1 else 0.0) - at.planet) * z2
        np.testing.assert_allclose(np.exp(1j * phase), np.exp(1j * phase[0]), atol=1e-11)


@pytest.mark.property
@given(carrier=st.floats(-5.0, 5.0), other=st.floats(-5.0, 5.0))
def test_swapping_the_fixed_member_changes_no_mesh(carrier: float, other: float) -> None:
    """Turning everything by one angle: the ring fixed, the sun fixed and the carrier fixed give the same set."""
    base = poses(SOURCE, carrier)
    for turn in (-float(base.sun), -carrier, other):  # sun fixed, carrier fixed, any
        moved = poses(SOURCE, carrier + turn, turn)
        assert float(moved.sun) == pytest.approx(float(base.sun) + turn, abs=1e-11)
        np.testing.assert_allclose(moved.planet, base.planet + turn, atol=1e-11)
        assert float(moved.ring) == turn
    # speeds: ring fixed 1 + z3/z1, carrier fixed −z3/z1
    assert float(poses(SOURCE, 1.0).sun - poses(SOURCE, 0.0).sun) == pytest.approx(
        planetary(SOURCE).gear_ratio
    )
    assert float(poses(SOURCE, 0.0, 1.0).sun - poses(SOURCE, 0.0).sun) == pytest.approx(-80 / 20)


@pytest.mark.independent
def test_fillet_interference_is_penetration() -> None:
    """Beyond either end of the line the named tip enters the fillet; within it no flank enters another."""
    line = coaxial_line(SOURCE)
    (stretch,) = line.stretches
    carrier = np.linspace(0.0, 2.0 * math.pi / 80, 120)
    for x1, sun_bad, ring_bad in (
        (stretch.low, False, False),
        (stretch.high, False, False),
        (stretch.high + 0.05, True, False),
        (stretch.low - 0.07, False, True),
    ):
        given = replace(SOURCE, shifts=line.shifts(x1))
        sun, ring = penetrations(given, members(given), carrier, 0.0 * carrier)
        assert bool(sun.max() > 1e-12) is sun_bad
        # the ring's tip in the planet's fillet shows from both sides
        assert bool(_ring_in_planet(given, carrier).max() > 1e-12) is ring_bad
        assert bool(ring.max() > 1e-12) is ring_bad


def _ring_in_planet(given: PlanetarySet, carrier: Array) -> Array:
    parts, at = members(given), poses(given, carrier)
    center = at.center[:, 0] @ np.array([1.0, 1j])
    near = np.round(np.angle(center) * given.teeth[2] / (2.0 * math.pi)) * 2.0 * math.pi / given.teeth[2]
    ring = cloud(parts.ring) * np.exp(1j * near)[:, None]
    local = (ring - center[:, None]) * np.exp(-1j * at.planet[:, :1])
    beyond = np.abs(local) > parts.planet.tip_radius
    deepest: Array = np.where(beyond, -1.0, depth(parts.planet.cut, local)).max(axis=1)
    return deepest


@pytest.mark.independent
def test_tip_interference_of_a_ring_with_few_teeth_more() -> None:
    """Brute force: where the planet's tip corner crosses the ring's tip circle it must find a space."""
    found = []
    for teeth in (34, 36, 38, 40, 44, 50):
        given = PlanetarySet(
            (10, 30, teeth), 2e-3, 1e-3 * (teeth - 30), (0.0, 0.0, 0.0), Shaper(16, 0.0, 37e-3)
        )
        _, planet, ring = given.gears()
        pair = mesh(planet, ring)
        tips = (32e-3, 1e-3 * teeth - 1.5e-3)
        free = float(tip_clash(pair, *tips))
        corner = tips[0] * np.exp(1j * float(math.pi / 30 - planet.thickness_at(tips[0]) / (2.0 * tips[0])))
        deep = -math.inf
        for turn in np.linspace(-2.0, 2.0, 2001):  # ring fixed: the planet's centre turns, the planet rolls
            offset = turn * (1.0 - teeth / 30) + math.pi / 30
            for side in (corner, corner.conjugate()):
                for tooth in range(-6, 7):
                    at = pair.center_distance * np.exp(1j * turn)
                    z = at + side * np.exp(1j * (offset + tooth * 2.0 * math.pi / 30))
                    radius = abs(z)
                    if radius <= tips[1] or radius > tips[1] + 0.3e-3:
                        continue
                    pitch = 2.0 * math.pi / teeth
                    away = abs((np.angle(z) + 0.5 * pitch) % pitch - 0.5 * pitch)
                    deep = max(deep, radius * (away - float(ring.flank_angle(radius))))
        found.append((free, deep))
    assert any(free < 0.0 for free, _ in found)
    assert any(free > 0.0 for free, _ in found)
    for free, deep in found:
        assert bool(free < 0.0) is bool(deep > 1e-9), found


@pytest.mark.exact
def test_quality_lists_every_condition_once_with_its_margin() -> None:
    """All fulfilled for the source's set; names are unique; margins are value − limit in the right direction."""
    result = quality(planetary(SOURCE))
    names = [c.name for c in result.conditions]
    assert len(names) == len(set(names)) == 23
    assert result.failed == ()
    assert result["planet tip in ring fillet"].relation == "≤"
    assert result["planet tip in ring fillet"].margin == pytest.approx(1.26173e-3, abs=1e-8)
    assert result["contact ratio of planet and ring"].value == pytest.approx(1.42443, abs=1e-5)
    assert result["backlash of sun and planet"].margin < 0.0  # 1.134 instead of 1.13360: 0.6 µm too tight
    assert result["radial assembly of planet and ring"].fulfilled
    assert Condition("x", 3.0, 2.0, "1", least=False).margin == -1.0


@pytest.mark.exact
def test_the_source_can_be_built() -> None:
    check_planetary(SOURCE)
    assert planetary(SOURCE).gear_ratio == 5.0


@pytest.mark.exact
@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"teeth": (2, 30, 62)}, r"sun with 2 teeth: at least 3"),
        ({"teeth": (20, 30, 30)}, r"ring of 30 teeth around a planet of 30: .* near z1 \+ 2 z2 = 80"),
        ({"planets": 0}, r"0 planets: at least one"),
        (
            {"cutter": Shaper(80, 0.0, 0.165)},
            r"80 teeth for a ring of 80: it needs less(.|\n)*ring_cutter.z = 6",
        ),
        (
            {"cutter": Shaper(25, 5.0, 0.0756)},
            r"take a larger ring shift or a cutter with less teeth or shift",
        ),
        (
            {"center_distance": 45e-3},
            r"more than a·cos α = 46\.9846 mm\nthe nearest that can be built: center_distance = \"49\.\d mm\", x_sun",
        ),
        (
            {"teeth": (20, 30, 90)},
            r"\nthe nearest that can be built: .*z_ring = 80, .*x_sun = 0\.5, x_planet = 0\.63",
        ),
        (
            {"teeth": (20, 30, 81)},
            r"30 and 81 teeth stand 53\.0044 mm apart .* not coaxial\n"
            r"the nearest that can be built: z_ring = 80, x_sun = 0\.5, x_planet = 0\.6336, x_ring = 1\.76719",
        ),
        (
            {"shifts": (0.5, 0.7, 1.8)},
            r"20 and 30 teeth stand [^$]* nearest .*: x_sun = 0\.5, x_planet = 0\.6336",
        ),
        (
            {"planets": 3},
            r"sun \+ ring = 100 teeth is no multiple of 3\nthe nearest that can be built: planets = 4$",
        ),
        (
            {"planets": 5},
            r"5 planets of radius 33 mm .* collide: .*\nthe nearest that can be built: planets = 4$",
        ),
        (
            {"shifts": (-0.2, 1.334, 2.468)},
            r"undercut of the sun: -0\.2, and it must be ≥ -0\.169778"
            r"(.|\n)*\nthe nearest that can be built: x_sun = -0\.096, x_planet = 1\.2296, x_ring = 2\.36319",
        ),
        (
            {"shifts": (1.3, -0.166, 0.968)},
            r"planet tip in sun fillet: 8\.\d+ mm, [^$]*\nthe nearest that can be built: x_sun = 1\.195",
        ),
    ],
)
def test_impossible_sets_name_the_limit_and_the_nearest(change: dict[str, object], message: str) -> None:
    """Each refusal says what binds and what the nearest feasible value is."""
    with pytest.raises(Infeasible, match=message):
        check_planetary(replace(SOURCE, **change))  # type: ignore[arg-type]


@pytest.mark.property
@given(
    set_=sets(),
    shifts=st.tuples(st.floats(-1.5, 3.0), st.floats(-1.5, 3.0), st.floats(-2.0, 5.0)),
    more=st.integers(-2, 2),
    planets=st.integers(1, 6),
    wider=st.floats(0.8, 1.2),
)
@settings(max_examples=25, deadline=None)
def test_what_is_advised_stands_as_printed(
    set_: PlanetarySet, shifts: tuple[float, float, float], more: int, planets: int, wider: float
) -> None:
    """Numbers read from the message and put back: the set then stands."""
    z1, z2, z3 = set_.teeth
    wrong = replace(
        set_,
        shifts=shifts,
        teeth=(z1, z2, z3 + more),
        planets=planets,
        center_distance=wider * set_.center_distance,
    )
    limits = Limits(0.2e-3, 1.1)
    found = planetary_faults(wrong, limits)
    assume(found)
    said = dict(
        re.findall(
            r'([\w.]+) = "?(-?[\d.]+(?:e-?\d+)?)', found[-1].removeprefix("the nearest that can be built: ")
        )
    )
    if not found[-1].startswith("the nearest that can be built"):
        assert "no shifts" in found[-1]
        return
    x1, x2, x3 = shifts
    near = replace(
        wrong,
        shifts=(float(said.get("x_sun", x1)), float(said.get("x_planet", x2)), float(said.get("x_ring", x3))),
        teeth=(z1, z2, int(said.get("z_ring", z3 + more))),
        planets=int(said.get("planets", planets)),
        center_distance=1e-3 * float(said.get("center_distance", 1e3 * wrong.center_distance)),
    )
    assert planetary_faults(near, limits) == ()


@pytest.mark.property
@given(set_=sets())
@settings(max_examples=15, deadline=None)
def test_feasible_sets_are_not_refused(set_: PlanetarySet) -> None:
    assert planetary_faults(set_, Limits(0.2e-3 * (1 - 1e-9), 1.1 * (1 - 1e-9))) == () or _at_an_end(set_)


def _at_an_end(set_: PlanetarySet) -> bool:
    """Whether the least margin is nothing but rounding, as at the ends of the line."""
    failed = quality(planetary(set_), Limits(0.2e-3, 1.1)).failed
    return all(float(c.margin) > -1e-12 for c in failed)

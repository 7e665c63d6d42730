"""The hard cases of contact: each solved to 1e-12, in metres or millimetres, and as a library's quadratic program.

No case may fail. Forces agree to 1e-9 of the largest, and to what rounding each gap once does to them
(`uncertainty`): where the bodies yield by 1e-14 m in a gap of 1 mm, double precision knows forces to 1e-4 only.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.fem.cases import STEEL, on_circle
from tests.fem.hard_cases import (
    METRE,
    MILLIMETRE,
    SHAPES,
    cylinders,
    line_load,
    many,
    pin_in_hole,
    shape,
)
from tests.fem.qp import Flat, answer, flat, forces_of, residuals, uncertainty
from trochoid.fem.complementarity import Problem, solve
from trochoid.fem.laws import HertzLine, Law, LinearSpring
from trochoid.fem.pair import FlankPair, Member
from trochoid.fem.position import Assembly, Family, solve_position
from trochoid.fem.strips import strip_centres
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.meshing import check_cycloid, flank_faults

COMPLEMENTARY, ALIKE = 1e-12, 1e-9
CLEARANCES = {"1 mm": 1e-3, "10 um": 1e-5, "1 um": 1e-6, "none": 0.0, "-1 um": -1e-6}
LOADS = {f"{load:g} N/mm": load for load in (1e-6, 1.0, 1e3, 1e6)}
RATIOS = {f"ratio {ratio:g}": ratio for ratio in (1e-6, 1.0, 1e6)}


def over(name: str, values: dict[str, float]) -> pytest.MarkDecorator:
    """Return the axis of the matrix with its readable names."""
    return pytest.mark.parametrize(name, values.values(), ids=values.keys())


def check(make: Callable[[float], Problem], like: float = ALIKE) -> None:
    """Solve in both units, started from nothing and from another load; hold all against the quadratic program."""
    metres, millimetres = make(METRE), make(MILLIMETRE)
    found = solve(metres)
    conditions = flat(metres)
    reached = residuals(conditions, forces_of(found), found.motion)
    assert reached.largest <= COMPLEMENTARY, reached
    assert max(found.imbalance, found.penetration) <= COMPLEMENTARY
    forces, motion = answer(conditions, found.motion)
    library = residuals(conditions, forces, motion)
    assert library.largest <= COMPLEMENTARY, library
    allowed = like * float(np.abs(forces).max()) + uncertainty(conditions, forces, motion)
    assert forces_of(found) == pytest.approx(forces, abs=allowed)
    other = solve(millimetres)
    reached = residuals(flat(millimetres), forces_of(other), other.motion)
    assert reached.largest <= COMPLEMENTARY, reached
    per_metre = line_load(1.0, METRE) / line_load(1.0, MILLIMETRE)
    assert per_metre * forces_of(other) == pytest.approx(forces, abs=allowed)
    warm = solve(metres, solve(replace(metres, load=1.5 * metres.load)))
    assert residuals(conditions, forces_of(warm), warm.motion).largest <= COMPLEMENTARY
    assert forces_of(warm) == pytest.approx(forces, abs=allowed)


@pytest.mark.independent
@pytest.mark.parametrize("build", [pin_in_hole, cylinders], ids=["pin in hole", "cylinders"])
@over("ratio", RATIOS)
@over("load", LOADS)
@over("clearance", CLEARANCES)
def test_clearance_load_and_stiffness(
    clearance: float, load: float, ratio: float, build: Callable[[float, float, float, float], Problem]
) -> None:
    """Issue 3: clearance 1 mm … −1 µm, 1e-6 … 1e6 N/mm, stiffness ratio 1e-6 … 1e6."""
    check(lambda unit: build(clearance, load, ratio, unit))


@pytest.mark.independent
@pytest.mark.parametrize("tilt", [False, True], ids=["down", "down and tilting"])
@over("load", LOADS)
@over("depth", {"1 mm deep": 1e-3, "1 um deep": 1e-6})
@pytest.mark.parametrize("name", SHAPES)
def test_shapes(name: str, depth: float, load: float, tilt: bool) -> None:
    """Issue 3: open everywhere, flat on flat, wedge, cusp, contact that runs off an edge, punch, and worse."""
    check(lambda unit: shape(name, depth, load, unit, tilt))


@pytest.mark.independent
@pytest.mark.parametrize(
    ("contacts", "strips"), [*((c, 1) for c in (2, 3, 4, 5, 10, 20, 50, 200)), (2, 3), (20, 3), (100, 3)]
)
def test_number_of_contacts(contacts: int, strips: int) -> None:
    """Issue 3: 2 to 200 pins on one body, some with play, that share a torque and a force."""
    check(lambda unit: many(contacts, strips, unit))


@pytest.mark.exact
@over("load", LOADS)
def test_wedge_in_closed_form(load: float) -> None:
    """Johnson (5.5): a blunt wedge of slope s touches over a half-width P/(s E*): strips within one of it."""
    slope = load * 1e3 / (STEEL.modulus * 0.004)
    count = 99
    problem = shape("wedge", 0.010 * slope, load, METRE, False, count)
    touching = np.abs(0.010 * strip_centres(count)[forces_of(solve(problem)) > 0]).max()
    assert touching == pytest.approx(0.004, abs=0.020 / count)


@pytest.mark.exact
@over("clearance", {name: value for name, value in CLEARANCES.items() if value > 0})
@pytest.mark.parametrize("build", [pin_in_hole, cylinders], ids=["pin in hole", "cylinders"])
def test_open_and_unloaded(clearance: float, build: Callable[[float, float, float, float], Problem]) -> None:
    """Nothing pushes, nothing touches: no force, no motion."""
    problem = build(clearance, 0.0, 1.0, METRE)
    open_everywhere = tuple(replace(g, gap=g.gap + clearance) for g in problem.groups)
    found = solve(replace(problem, groups=open_everywhere))
    assert not forces_of(found).any()
    assert not found.motion.any()


def pair_of(
    count: int, share: float, trochoid_ratio: float, crank: float, lateral: bool, law: Law | None
) -> Assembly:
    """Return a rigid cycloid disc against `count` pins of `share` of the largest radius, under a torque.

    The disc turns; with `lateral` its centre moves too, on springs.
    """
    flank = cycloid(count, share, trochoid_ratio)
    moves = np.array([[0.0], [0.0], [1.0]]) if not lateral else np.eye(3)
    center = flank.eccentricity * on_circle(1.0, np.array([crank]))[0]
    disc = Member(center, -crank / flank.lobes, moves)
    ring = Member(np.zeros(2), 0.0, 0.0 * moves)
    family = Family(
        "ring",
        FlankPair.nominal(disc, ring, flank, crank),
        np.full(count, 2 * STEEL.kernel / 0.010),
        np.zeros(count),
        law,
    )
    size = moves.shape[1]
    springs, load = np.diag([3e8, 3e8, 0.0][-size:]), np.zeros(size)
    load[-1] = -50.0
    return Assembly((family,), (), springs, load)


def cycloid(count: int, share: float, trochoid_ratio: float = 0.6) -> Cycloid:
    """Return a profile with this share of the largest pin that neither undercuts nor meets its neighbour."""
    small = Cycloid(count, count - 1, 0.080, 1e-6, trochoid_ratio * 0.080 / count)
    limit = small.undercut_radius
    if share < 0.99:
        limit = min(limit, 0.080 * np.sin(np.pi / count))
    return replace(small, pin_radius=share * limit)


def check_pair(assembly: Assembly) -> None:
    """Solve a position; its pose and its laws linearised there make a quadratic program with the same forces."""
    contact = solve_position(assembly)
    assert max(contact.imbalance, contact.penetration) <= COMPLEMENTARY
    family, touch = assembly.families[0], contact.touches["ring"]
    assert np.isfinite(touch.force).all()
    law = family.law or HertzLine(family.kernel, touch.state.radius)
    at = np.maximum(touch.force, 1e-9 * touch.force.max())
    approach, slope = law.approach(at)
    bounds = np.zeros(len(at)), np.full(len(at), np.inf)
    load = assembly.load - assembly.springs @ contact.motion
    gap = touch.state.gap + approach - slope * at
    problem = Flat(np.diag(slope), gap, touch.state.arms, assembly.springs, load, *bounds)
    forces, motion = answer(problem, np.zeros(len(assembly.load)))
    assert residuals(problem, forces, motion).largest <= COMPLEMENTARY
    allowed = 1e-8 * float(forces.max()) + uncertainty(problem, forces, motion)
    assert touch.force == pytest.approx(forces, abs=allowed)


laws = pytest.mark.parametrize("law", [None, LinearSpring(2e8)], ids=["Hertz", "springs"])


@pytest.mark.independent
@laws
@pytest.mark.parametrize("lateral", [False, True], ids=["turning", "free"])
@pytest.mark.parametrize("pins", [2, 3, 4, 5, 10, 50, 200])
def test_number_of_pins(pins: int, lateral: bool, law: Law | None) -> None:
    """Issue 3: 2 to 200 pins on a cycloid flank (a drive has 4 at least)."""
    for crank in (0.3, 2.0) if pins < 50 else (0.3,):
        check_pair(pair_of(pins, 0.6, 0.6, crank, lateral, law))


@pytest.mark.independent
@laws
@pytest.mark.parametrize("short", [1e-3, 1e-6, 1e-9])
@pytest.mark.parametrize(("pins", "ratio"), [(20, 0.95), (9, 0.8)])
def test_nearly_pointed_tooth(pins: int, ratio: float, short: float, law: Law | None) -> None:
    """Issue 3: the flank's sharpest place has almost no radius left, a pin sits on it: solved all the same."""
    flank = cycloid(pins, 1 - short, ratio)
    check_cycloid(flank)
    t = np.linspace(0, 2 * np.pi / flank.lobes, 20001)
    sharpest = float(t[np.argmax(flank.curvature(t))])
    for crank in (0.3, sharpest * flank.lobes):
        check_pair(pair_of(pins, 1 - short, ratio, crank, True, law))


@pytest.mark.exact
@pytest.mark.parametrize(("pins", "ratio"), [(20, 0.95), (9, 0.8), (9, 0.1), (200, 0.3)])
def test_undercut_limit(pins: int, ratio: float) -> None:
    """Issue 3: a pin 1e-9 below the limit is made, one 1e-9 above it (or at it) is refused with the limit."""
    assert flank_faults(cycloid(pins, 1 - 1e-9, ratio)) == ()
    for share in (1.0, 1 + 1e-9):
        flank = cycloid(pins, share, ratio)
        limit = f"the nearest feasible pin_radius is just below {1e3 * flank.undercut_radius:.6g} mm"
        (fault,) = flank_faults(flank)
        assert "the flank is undercut" in fault
        assert limit in fault
        with pytest.raises(Infeasible, match=re.escape(fault)):
            check_cycloid(flank)


@pytest.mark.exact
@pytest.mark.parametrize("lobes", [17, 18, 20, 21])
def test_two_lobes_fewer_are_refused(lobes: int) -> None:
    """One lobe less than pins is what the equations hold for; other differences are refused with what to take."""
    with pytest.raises(
        Infeasible, match=rf"{lobes} lobes on 20 pins: .*one lobe less.*take lobes = 19 or pins = {lobes + 1}"
    ):
        Cycloid(20, lobes, 0.080, 0.005, 0.0025)

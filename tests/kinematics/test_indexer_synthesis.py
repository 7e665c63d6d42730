"""Synthesis without hard shock: what every solution fulfils, that none is missed, limits, refusals."""

import math
import re

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.kinematics.indexer_cases import DEGREE, pin_at, tasks, turned
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import motion, shock
from trochoid.kinematics.indexer_design import solutions, synthesise
from trochoid.kinematics.indexer_limits import Wish, nearest_swing
from trochoid.kinematics.indexer_measure import dwell, peaks, similarity
from trochoid.kinematics.indexer_pin_roots import roots_by_pin
from trochoid.kinematics.indexer_roots import roots_by_duration
from trochoid.kinematics.indexer_synthesis import Solution, Task, by_duration, by_pin, cusped
from trochoid.kinematics.spherical_trochoid import Kind
from trochoid.kinematics.types import Array

RIGHT = Task(90 * DEGREE, 4)
durations = st.floats(0.05, 0.95)


def places(found: tuple[Solution, ...]) -> Array:
    """Arm, signed pin and ratio of solutions, sorted."""
    rows = [
        (x.indexer.path.arm, x.indexer.path.pin * math.cos(x.indexer.path.phase), x.indexer.path.ratio)
        for x in found
    ]
    return np.array(sorted(rows))


def condition(task: Task, sense: int, ratio: float, half_turn: float, arm: float) -> float:
    """L(a)L(b') − L(a')L(b) from rotation matrices, primes by a complex step."""
    psi, D = sense * 0.5 * task.swing, task.shaft_angle
    w = np.array([-math.cos(D), 0.0, math.sin(D)])
    n = np.array([0.0, math.cos(psi), 0.0]) - w * math.sin(psi)
    phi = half_turn + 1e-40j
    arm_frame = turned(2, phi) @ turned(1, arm)
    a, b = n @ arm_frame[:, 2], n @ (arm_frame @ turned(2, ratio * phi))[:, 0]
    return float((a.real * b.imag - a.imag * b.real) / 1e-40)


@pytest.mark.property
@given(task=tasks(), duration=durations)
@settings(max_examples=100, deadline=None)
def test_no_hard_shock(task: Task, duration: float) -> None:
    """Every solution: at both ends the pin is on the slot at ±ψ0 and the wheel rests; the rest as `fault` says."""
    for x in by_duration(task, duration):
        made = x.indexer
        if float(np.sin(made.reach(made.half_turn))) < 1e-6:
            continue  # an index at the wheel's axis
        ends = motion(made, made.half_turn * np.array([-1.0, 1.0]))
        size = float(np.linalg.norm(made.path.derivatives(made.half_turn, 1)[1]) + 1.0)
        assert np.abs(ends.velocity).max() < 1e-9 * size / float(np.sin(made.reach(made.half_turn)))
        inside = motion(made, np.linspace(-0.999, 0.999, 201) * made.half_turn)
        if not x.fault:
            assert made.swing == pytest.approx(task.swing, abs=1e-9)
            assert (inside.velocity * made.sense > -1e-12).all()  # it may pause in a cusp in the middle
            assert np.ptp(inside.angle) < task.swing + 1e-12
            assert dwell(made).clearance > -1e-7
        if x.fault == "swing":
            turned_by = np.unwrap(inside.angle)
            assert abs(abs(turned_by[-1] - turned_by[0]) - task.swing) > 1e-3
        if x.fault == "returns":
            assert dwell(made).clearance < 0.0


@pytest.mark.independent
@given(task=tasks(), duration=durations)
@settings(max_examples=40, deadline=None)
def test_no_root_is_missed(task: Task, duration: float) -> None:
    """Every change of sign of L(a)L(b') − L(a')L(b), over arms every half degree, has its root."""
    assume(abs(math.sin(task.planet * math.pi * duration)) > 1e-2)
    roots = roots_by_duration(0.5 * task.swing, math.pi * duration, task.planet, task.shaft_angle)
    arms = np.radians(np.arange(-179.75, 180.0, 0.5))
    for sense in (1, -1):
        for ratio in (task.planet, -task.planet):
            values = np.array([condition(task, sense, ratio, math.pi * duration, x) for x in arms])
            signs = np.flatnonzero(values[1:] * values[:-1] < 0.0)
            # the other name of a mechanism: the opposite arm with the other kind of planet
            same = roots.arm[(roots.sense == sense) & (roots.ratio == ratio)]
            opposite = roots.arm[(roots.sense == sense) & (roots.ratio == -ratio)]
            known = np.concatenate((same, opposite - np.copysign(math.pi, opposite)))
            for i in signs:
                assert ((known > arms[i] - 1e-9) & (known < arms[i + 1] + 1e-9)).any()


@pytest.mark.independent
@given(task=tasks(), duration=st.floats(0.05, 0.9))
@settings(max_examples=40, deadline=None)
def test_both_ways_of_synthesis_meet(task: Task, duration: float) -> None:
    """A solution for a given k is found again from its ρ: two eliminations that share no equation in γ alone."""
    assume(abs(math.sin(task.planet * math.pi * duration)) > 0.05)
    for x in by_duration(task, duration):
        path = x.indexer.path
        if not (1e-2 < path.pin_ratio < 50.0 and 0.05 < abs(path.arm) < 3.09):
            continue
        again = roots_by_pin(0.5 * task.swing, path.pin_ratio, task.planet, task.shaft_angle)
        off = np.abs(again.arm - path.arm) + np.abs(again.half_turn - x.indexer.half_turn)
        assert off[(again.ratio == path.ratio)].min() < 1e-6


@pytest.mark.exact
@given(task=tasks())
@settings(max_examples=60, deadline=None)
def test_cusps_in_closed_form(task: Task) -> None:
    """At k = 1/i the roots are the cusps, ρ = 1; and ρ = 1 has them among its solutions."""
    A3 = np.cos(0.5 * task.swing) * np.cos(math.pi / task.planet) - np.cos(task.shaft_angle) * np.sin(
        0.5 * task.swing
    ) * np.sin(math.pi / task.planet)
    assume(abs(A3) > 1e-3)
    closed = cusped(task)
    np.testing.assert_allclose(places(by_duration(task, 1.0 / task.planet)), places(closed), atol=1e-9)
    for x in closed:
        assert x.indexer.path.pin_ratio == pytest.approx(1.0, rel=1e-9)
        assert x.cusp
    of_pin = places(by_pin(task, 1.0))
    for row in places(closed):
        assert np.abs(of_pin - row).max(axis=1).min() < 1e-9


@pytest.mark.property
@given(task=tasks(), duration=durations)
@settings(max_examples=60, deadline=None)
def test_from_the_other_end_of_the_wheel_shaft(task: Task, duration: float) -> None:
    """D and π − D name the same shafts: arms to the other side, the other sense, the same law of motion."""
    other = Task(task.swing, task.planet, math.pi - task.shaft_angle)
    one, two = by_duration(task, duration), by_duration(other, duration)
    mirrored = places(two) * [-1.0, -1.0, 1.0] if two else places(two)
    np.testing.assert_allclose(places(one), np.array(sorted(map(tuple, mirrored))), atol=1e-6)


@pytest.mark.exact
def test_without_a_planet_it_is_the_geneva_wheel() -> None:
    """As ρ → 0 the pin is on the arm: k, B and C go to the Geneva wheel's, linearly in ρ."""
    for shaft_angle in (60 * DEGREE, 90 * DEGREE, 110 * DEGREE):
        wheel, task = geneva(90 * DEGREE, shaft_angle), Task(90 * DEGREE, 4, shaft_angle)
        error = []
        for rho in (2e-3, 1e-3):
            made = [x.indexer for x in by_pin(task, rho) if not x.fault]
            error.append(
                min(abs(x.duration - wheel.duration) + abs(x.path.arm - wheel.path.arm) for x in made)
            )
        assert error[1] < 1e-2
        assert math.log2(error[0] / error[1]) == pytest.approx(1.0, abs=0.05)


@pytest.mark.property
@given(task=tasks(), duration=durations)
@settings(max_examples=25, deadline=None)
def test_choice(task: Task, duration: float) -> None:
    """The choice serves and has the least C; if there is none, the named swing serves and the next to it does not."""
    wish = Wish(duration=duration)
    try:
        chosen = synthesise(task, wish)
    except Infeasible as refusal:
        free = re.search(r"with this swing k = ([\d.]+) has one", str(refusal))
        if free:
            assert synthesise(task, Wish(duration=float(free[1]))).fault == ""
        named = re.search(r"nearest swing is ([\d.]+)°", str(refusal))
        if named:
            swing = float(named[1]) * DEGREE
            assert synthesise(Task(swing, task.planet, task.shaft_angle), wish).fault == ""
            further = swing + math.copysign(2e-4 * DEGREE, task.swing - swing)
            assert all(x.fault for x in solutions(Task(further, task.planet, task.shaft_angle), wish))
        return
    assert chosen.fault == ""
    least = similarity(chosen.indexer).acceleration
    for x in solutions(task, wish):
        if not x.fault:
            assert similarity(x.indexer).acceleration >= least * (1.0 - 1e-3)  # it is chosen from samples


@pytest.mark.property
@given(task=tasks(), rho=st.floats(0.02, 20.0), kind=st.sampled_from(["epi", "hypo"]))
@settings(max_examples=10, deadline=None)
def test_named_pin_ratio_serves(task: Task, rho: float, kind: Kind) -> None:
    """A refusal of ρ names one that serves with the same swing, if there is any."""
    try:
        assert synthesise(task, Wish(pin_ratio=rho, kind=kind)).kind == kind
    except Infeasible as refusal:
        free = re.search(r"with this swing ρ = ([\d.e+-]+) has one", str(refusal))
        if free:
            assert synthesise(task, Wish(pin_ratio=float(free[1]), kind=kind)).fault == ""


@pytest.mark.exact
def test_every_arm_where_cosines_match() -> None:
    """cos D = cot φ0 cot ψ0 with whole i·k: any ρ at one k, so k alone is refused and says what to do."""
    task = Task(90 * DEGREE, 4)
    with pytest.raises(Infeasible, match="give ρ in place of k"):
        synthesise(task, Wish(duration=0.5))
    for rho in (0.1, 0.4, 0.8):
        made = [x for x in by_pin(task, rho) if x.indexer.duration == pytest.approx(0.5, abs=1e-12)]
        assert len(made) >= 8
        assert max(abs(shock(x.indexer)) for x in made) < 1e-12


@pytest.mark.property
def test_kind_and_place() -> None:
    """Near and far pins of both kinds serve at a right angle; each is what its path says."""
    for kind, place in (("hypo", "near"), ("hypo", "far"), ("epi", "near"), ("epi", "far")):
        chosen = synthesise(RIGHT, Wish(pin_ratio=0.527, kind=kind, place=place))  # type: ignore[arg-type]
        path = chosen.indexer.path
        assert (chosen.kind, chosen.place) == (kind, place)
        off_drive = math.acos(float(pin_at(path, 0.0).real[2]))
        assert (off_drive > abs(path.arm)) is (place == "far")
        assert peaks(chosen.indexer).start > 0.0


@pytest.mark.parametrize(
    ("task", "wish", "reason", "nearest"),
    [
        (RIGHT, Wish(duration=0.2), "turn back on its way", 58.5341),
        (Task(250 * DEGREE, 4), Wish(pin_ratio=5.0, kind="epi"), "pass through the wheel's axis", 179.97),
    ],
)
def test_a_swing_without_solution(task: Task, wish: Wish, reason: str, nearest: float) -> None:
    """Refused with what binds and the nearest swing, which serves."""
    with pytest.raises(Infeasible, match=reason):
        synthesise(task, wish)
    found = nearest_swing(task, wish)
    assert found is not None
    assert found[0] / DEGREE == pytest.approx(nearest, abs=1e-2)
    assert synthesise(Task(found[0], task.planet, task.shaft_angle), wish).fault == ""


def test_no_swing_at_all() -> None:
    with pytest.raises(Infeasible, match="change k or i"):
        synthesise(Task(170 * DEGREE, 4), Wish(duration=0.8))
    with pytest.raises(Infeasible, match="change ρ or i"):
        synthesise(Task(90 * DEGREE, 3), Wish(pin_ratio=2.5, kind="hypo", place="near"))


@pytest.mark.parametrize(
    ("swing", "planet", "shaft_angle", "message"),
    [
        (0.0, 4, 1.0, "more than 0°"),
        (7.0, 4, 1.0, "less than 360°"),
        (1.0, 1, 1.0, "the nearest is 2"),
        (1.0, 3.4, 1.0, "the nearest is 3"),
        (1.0, 4, 3.2, "shafts must cross"),
    ],
)
def test_impossible_tasks(swing: float, planet: int, shaft_angle: float, message: str) -> None:
    with pytest.raises(Infeasible, match=message):
        Task(swing, planet, shaft_angle)


def test_impossible_wishes() -> None:
    with pytest.raises(Infeasible, match="give one of them"):
        Wish()
    with pytest.raises(Infeasible, match="give one of them"):
        Wish(duration=0.3, pin_ratio=0.5)
    with pytest.raises(Infeasible, match="less than 1"):
        by_duration(RIGHT, 1.0)
    with pytest.raises(Infeasible, match="off the planet's axis"):
        by_pin(RIGHT, 0.0)

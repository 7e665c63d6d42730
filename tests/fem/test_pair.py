"""Gaps, arms and turning arms of the pairs against finite differences and against the curves themselves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fem.cases import FLANK, on_circle
from trochoid.fem.pair import FlankPair, HolePair, Member, Pair, rotation
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.cycloid import Modification
from trochoid.kinematics.types import Array

ARC = ArcLength(FLANK)
GROUND = [Modification(), Modification(1e-5, -2e-5), Modification(1e-5, 0.0, 2e-4)]
FIRST, SECOND = np.eye(3, 6), np.eye(3, 6, 3)  # six motions: x, y, rotation of either member

motions = st.lists(st.floats(-1, 1), min_size=6, max_size=6).map(
    lambda v: 2e-5 * np.array(v) * [1, 1, 10, 1, 1, 10]
)
# no pin at the bottom of a valley or on a crest, where a rotation δ of the flanks leaves an edge
cranks = st.builds(lambda i, u: (i + u) * np.pi / 10, st.integers(0, 19), st.floats(0.1, 0.9))


def _flank(crank: float, ground: Modification) -> FlankPair:
    """Return all pins against a flank, both members free."""
    disc = Member(FLANK.eccentricity * on_circle(1.0, np.array([crank]))[0], -crank / FLANK.lobes, FIRST)
    pins, number = on_circle(FLANK.pin_circle_radius, 2 * np.pi * np.arange(20) / 20), np.arange(20)
    start = FLANK.contact_parameter(number, crank)
    return FlankPair(disc, Member(np.zeros(2), 0.0, SECOND), FLANK, ground, 3e-6, pins, start, ARC, None)


def _holes(crank: float) -> HolePair:
    """Return eight rollers in their holes, both members free; no roller is centred."""
    disc = Member(FLANK.eccentricity * on_circle(1.0, np.array([crank]))[0], -crank / FLANK.lobes, FIRST)
    holes = on_circle(0.052, 2 * np.pi * np.arange(8) / 8)
    return HolePair(disc, Member(np.zeros(2), disc.angle, SECOND), holes, 0.009, holes, 0.0065, None)


def _slope(pair: Pair, motion: Array, forces: Array | None = None) -> Array:
    """Return ∂gap/∂motion (c, 6), or with forces ∂(armsᵀF)/∂motion (6, 6), by central differences."""
    columns, step = [], 1e-7
    for axis in np.eye(6):
        up, down = (pair.at(motion + s * step * axis) for s in (1, -1))
        rise = up.gap - down.gap if forces is None else (up.arms - down.arms).T @ forces
        columns.append(rise / (2 * step))
    return np.stack(columns, axis=-1)


@pytest.mark.exact
@settings(max_examples=25, deadline=None)
@given(cranks, motions, st.sampled_from(GROUND))
def test_flank_arms_are_the_slope_of_the_gap(crank: float, motion: Array, ground: Modification) -> None:
    """Principle of virtual work: a gap closes by arms·motion, also on a ground flank and when both members move."""
    pair = _flank(crank, ground)
    assert pair.at(motion).arms == pytest.approx(-_slope(pair, motion), abs=2e-7)


@pytest.mark.exact
@settings(max_examples=25, deadline=None)
@given(cranks, motions)
def test_hole_arms_are_the_slope_of_the_gap(crank: float, motion: Array) -> None:
    """The same for rollers in holes."""
    pair = _holes(crank)
    assert pair.at(motion).arms == pytest.approx(-_slope(pair, motion), abs=2e-7)


@pytest.mark.exact
@settings(max_examples=25, deadline=None)
@given(cranks, motions, st.sampled_from(GROUND[:2]))
def test_turning_arms_of_the_flank(crank: float, motion: Array, ground: Modification) -> None:
    """The stiffness that forces give by turning their arms is the slope of armsᵀF, and symmetric."""
    pair, force = _flank(crank, ground), np.linspace(0.0, 100.0, 20)
    found = pair.turning(pair.at(motion), motion, force)
    assert found == pytest.approx(_slope(pair, motion, force), abs=1e-5 * float(np.abs(found).max()))
    assert found == pytest.approx(found.T, abs=1e-12 * float(np.abs(found).max()))


@pytest.mark.exact
@settings(max_examples=25, deadline=None)
@given(cranks, motions)
def test_turning_arms_of_the_holes(crank: float, motion: Array) -> None:
    """The same for rollers in holes, whose centres are close together."""
    pair, force = _holes(crank), np.linspace(100.0, 0.0, 8)
    found = pair.turning(pair.at(motion), motion, force)
    assert found == pytest.approx(_slope(pair, motion, force), abs=1e-5 * float(np.abs(found).max()))
    assert found == pytest.approx(found.T, abs=1e-12 * float(np.abs(found).max()))


@pytest.mark.exact
def test_nominal_flank_touches_every_pin() -> None:
    """At the nominal pose an unmodified flank has no gap, whatever the crank angle; then play opens all alike."""
    for crank in (0.0, 1.0, 4.0):
        state = _flank(crank, Modification()).at(np.zeros(6))
        assert state.gap == pytest.approx(np.full(20, 3e-6), abs=1e-16)
        lever = FLANK.lever(FLANK.contact_parameter(np.arange(20), crank))
        assert state.arms[:, 2] == pytest.approx(lever, abs=1e-15)


@pytest.mark.exact
@pytest.mark.parametrize("ground", GROUND[:2])
def test_gap_along_the_flank_is_the_distance_to_the_pin(ground: Modification) -> None:
    """Points of the ground flank in the fixed frame against the pin's circle: no expansion in the offset is left."""
    crank, motion = 0.7, np.array([1e-5, -2e-5, 1e-4, 0, 0, 0])
    pair = _flank(crank, ground)
    state = pair.at(motion)
    offset = np.linspace(-2e-4, 2e-4, 9)[None] * np.ones((20, 1))
    found = pair.gap_along(state, motion, offset)
    assert found[:, 4] == pytest.approx(state.gap, abs=1e-15)
    center, angle = pair.disc.displaced(motion)
    curve = FLANK.modified(ground)
    t = state.parameter[:, None] + offset / curve.speed(state.parameter)[:, None]
    places = curve.point(t) @ rotation(angle).T + center
    distance = np.linalg.norm(places - pair.pins[:, None], axis=-1) - FLANK.pin_radius + 3e-6
    assert found == pytest.approx(distance, abs=1e-15)


@pytest.mark.exact
def test_gap_along_a_hole_is_the_distance_to_the_roller() -> None:
    """The same for rollers in holes."""
    crank, motion = 0.7, np.array([1e-5, -2e-5, 1e-4, 0, 0, 0])
    pair = _holes(crank)
    state = pair.at(motion)
    offset = np.linspace(-2e-4, 2e-4, 9)[None] * np.ones((8, 1))
    center, angle = pair.disc.displaced(motion)
    around = state.parameter[:, None] + offset / 0.009
    places = pair.holes[:, None] + 0.009 * np.stack([np.cos(around), np.sin(around)], axis=-1)
    places = places @ rotation(angle).T + center
    rollers = pair.rollers @ rotation(pair.carrier.angle).T
    distance = np.linalg.norm(places - rollers[:, None], axis=-1) - 0.0065
    assert pair.gap_along(state, motion, offset) == pytest.approx(distance, abs=1e-15)


@pytest.mark.exact
@pytest.mark.parametrize("pair", [_flank(0.7, Modification()), _flank(0.7, GROUND[1]), _holes(0.7)])
def test_combined_radius_is_that_of_the_gap(pair: FlankPair | HolePair) -> None:
    """The gap opens by s²/(2R) beside the contact, R the combined radius of curvature."""
    state, step = pair.at(np.zeros(6)), 2e-5
    sides = step * np.array([-1.0, 0.0, 1.0]) * np.ones((len(state.gap), 1))
    gap = pair.gap_along(state, np.zeros(6), sides)
    bend = (gap[:, 0] - 2 * gap[:, 1] + gap[:, 2]) / step**2
    if isinstance(pair, HolePair):
        small, clear = pair.roller_radius, state.gap
    else:
        small, clear = FLANK.pin_radius, state.gap - pair.play
    while_open = 1 / (small + clear) - 1 / small  # the radius is that of closed contact
    assert bend == pytest.approx(1 / state.radius + while_open, rel=2e-4)


@pytest.mark.property
def test_centred_roller_touches_nothing() -> None:
    """A roller at the centre of its hole has no normal: the gap is the clearance, the arms are zero."""
    pair = HolePair(
        Member(np.zeros(2), 0.0, FIRST),
        Member(np.zeros(2), 0.0, SECOND),
        np.zeros((1, 2)),
        0.009,
        np.zeros((1, 2)),
        0.008,
        None,
    )
    state = pair.at(np.zeros(6))
    assert state.gap == pytest.approx([1e-3])
    assert not state.arms.any()
    assert not pair.turning(state, np.zeros(6), np.zeros(1)).any()

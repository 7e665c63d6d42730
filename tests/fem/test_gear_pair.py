"""Gaps between gear flanks against the curves themselves; arms and turning arms against finite differences."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fem.gear_cases import CENTERS, rigid_pair, teeth_20_30
from tests.geometry.gear_cases import external, ring
from trochoid.fem.gear_flank import Relief
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.pair import rotation
from trochoid.geometry.gear_curve import GearBoundary
from trochoid.geometry.gear_tooth import Tooth
from trochoid.kinematics.curve import foot_point
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.types import Array

SUN, PLANET, PAIR = teeth_20_30()
RELIEFS = (
    (Relief(9e-3, SUN.end, 20e-6), Relief(4e-3, 1e-3, 5e-6)),
    (Relief(14e-3, PLANET.end, 15e-6, 0.3),),
)
RING_RELIEFS = ((Relief(14e-3, PLANET.end, 20e-6),), (Relief(34e-3, ring().end, 10e-6),))

motions = st.lists(st.floats(-1, 1), min_size=6, max_size=6).map(
    lambda v: 1e-5 * np.array(v) * [1, 1, 40, 1, 1, 20]
)
angles = st.floats(-3.0, 3.0)
hands = st.sampled_from([1, -1])
KINDS = st.sampled_from(["outer", "relieved", "ring", "relieved ring"])


def _pair(kind: str, hand: int, angle: float) -> GearPair:
    at = np.array([angle])
    if "ring" in kind:
        return rigid_pair((PLANET, ring()), hand, at, RING_RELIEFS if "relieved" in kind else ((), ()))
    return rigid_pair((SUN, PLANET), hand, at, RELIEFS if "relieved" in kind else ((), ()))


@pytest.mark.exact
@given(KINDS, hands, angles)
@settings(max_examples=8, deadline=None)
def test_conjugate_flanks_touch_all_along_the_path(kind: str, hand: int, angle: float) -> None:
    """Exact: unrelieved involutes have no gap where ρ1 + s ρ2 spans the line of action; relief opens it."""
    pair = _pair(kind, hand, angle)
    state = pair.at(np.zeros((1, 6)))
    assert state.edge is not None
    on_path = state.edge[0, :, 0] > 0
    assert on_path.any()
    if "relieved" in kind:
        assert (state.gap[0] > -1e-15).all()
        assert (state.gap[0, on_path] < 40e-6).all()
    else:
        assert np.abs(state.gap[0, on_path]).max() < 1e-15
        assert (state.gap[0, ~on_path] > 0).all()


@pytest.mark.independent
@pytest.mark.parametrize("teeth", [(SUN, PLANET), (PLANET, ring())], ids=["outer", "ring"])
@given(hands, angles, motions)
@settings(max_examples=5, deadline=None)
def test_gap_is_the_least_distance_of_the_two_boundaries(
    teeth: tuple[Tooth, Tooth], hand: int, angle: float, motion: Array
) -> None:
    """Independent: points of the first boundary, and their feet on the second found by Newton on the curve."""
    pair = rigid_pair(teeth, hand, np.array([angle]))
    state, curves = pair.at(motion[None]), [GearBoundary(t).plain for t in teeth]
    assert state.edge is not None
    assert state.edge.shape[0] == 1
    (center, turn), (other, other_turn) = pair.first.displaced(motion), pair.second.displaced(motion)
    for c in np.flatnonzero(state.edge[0, :, 0] > 0.2e-3):
        starts = []
        for place, phi, curve in ((center, turn, curves[0]), (other, other_turn, curves[1])):
            local = (state.point[0, c] - place) @ rotation(np.ravel(phi)[0])
            z = curve.cut.gear.teeth
            near = z * np.arctan2(local[1], local[0]) / (2 * np.pi) + np.linspace(-0.6, 0.6, 2001)
            starts.append(near[np.linalg.norm(curve.point(near) - local, axis=1).argmin()])
        t = starts[0] + np.linspace(-0.01, 0.01, 401)
        points = curves[0].point(t) @ rotation(np.ravel(turn)[0]).T + center
        local = (points - other) @ rotation(np.ravel(other_turn)[0])
        _, distance = foot_point(curves[1], local, np.full(len(t), starts[1]))
        assert distance.min() == pytest.approx(state.gap[0, c], abs=3e-9)


@pytest.mark.independent
@pytest.mark.parametrize("hand", [1, -1])
@pytest.mark.parametrize("teeth", [(SUN, PLANET), (PLANET, ring())], ids=["outer", "ring"])
def test_contact_points_lie_on_both_boundaries(teeth: tuple[Tooth, Tooth], hand: int) -> None:
    """Independent: touching places are on the gears' meshed boundaries, with their normals, tooth by tooth."""
    pair = rigid_pair(teeth, hand, np.linspace(0.1, 0.1 + 2 * np.pi / teeth[0].gear.teeth, 7))
    state = pair.at(np.zeros((7, 6)))
    for member, tooth, number, sign in (
        (pair.first, teeth[0], pair.numbers[0], 1.0),
        (pair.second, teeth[1], pair.numbers[1], -1.0),
    ):
        own_hand = hand if sign > 0 else int(teeth[1].gear.side) * hand
        place = np.broadcast_to(member.center, (7, 2))[:, None]
        turn = rotation(np.broadcast_to(member.angle, (7,)))
        local = (state.point - place) @ turn
        normal = sign * state.normal @ turn
        rho = np.sqrt((local**2).sum(axis=-1) - tooth.gear.base_radius**2)
        t = number + own_hand * GearBoundary(tooth).parameter(rho)
        touching = np.abs(state.gap) < 1e-12
        assert touching.sum() >= 7
        # between the teeth of the whole curve, one is fine and ends in a rounding: stay on the involutes
        at = GearBoundary(tooth).point(t[touching])
        np.testing.assert_allclose(at, local[touching], atol=1e-12)
        np.testing.assert_allclose(GearBoundary(tooth).normal(t[touching]), normal[touching], atol=1e-9)


@pytest.mark.exact
@given(KINDS, hands, angles, motions)
@settings(max_examples=12, deadline=None)
def test_arms_are_the_gaps_derivatives(kind: str, hand: int, angle: float, motion: Array) -> None:
    """Exact: central differences of the gap, on flanks, on tip edges, and with relief to first order in its slope."""
    pair, step = _pair(kind, hand, angle), 1e-7
    state = pair.at(motion[None])
    assert state.edge is not None
    slopes = np.stack(
        [
            (pair.at((motion + d)[None]).gap - pair.at((motion - d)[None]).gap)[0] / (2 * step)
            for d in step * np.eye(6)
        ],
        axis=-1,
    )
    away = np.abs(state.edge[0, :, 0]) > 1e-5  # from where flank and edge change over
    if (
        "relieved" in kind
    ):  # relief is counted at the foot: where flanks are far apart its slope is not that of the gap
        away &= state.gap[0] < 0.1e-3
    tolerance = 2e-4 if "relieved" in kind else 1e-7
    np.testing.assert_allclose(-slopes[away], state.arms[0][away], atol=tolerance)


@pytest.mark.exact
@given(st.sampled_from(["outer", "ring"]), hands, angles, motions)
@settings(max_examples=8, deadline=None)
def test_turning_is_the_derivative_of_the_arms(kind: str, hand: int, angle: float, motion: Array) -> None:
    """Exact: central differences of Σ F·arm; the stiffness is symmetric."""
    pair, step = _pair(kind, hand, angle), 1e-6
    state = pair.at(motion[None])
    assert state.edge is not None
    force = np.where(np.abs(state.edge[..., 0]) > 2e-5, 1000.0, 0.0)
    found = pair.turning(state, motion[None], force)[0]
    rows = [
        np.einsum(
            "c,ck->k", force[0], (pair.at((motion + d)[None]).arms - pair.at((motion - d)[None]).arms)[0]
        )
        / (2 * step)
        for d in step * np.eye(6)
    ]
    scale = np.abs(found).max() + 1.0
    np.testing.assert_allclose(found, found.T, atol=1e-12 * scale)
    np.testing.assert_allclose(found, np.array(rows), atol=1e-5 * scale)


@pytest.mark.property
@given(KINDS, angles)
@settings(max_examples=6, deadline=None)
def test_next_tooth_finds_the_same(kind: str, angle: float) -> None:
    """Property: a pitch later the same gaps, radii and places stand beside other teeth."""
    one = _pair(kind, 1, angle)
    pitch = one.flanks[0].pitch
    other = _pair(kind, 1, angle + pitch)
    a, b = one.at(np.zeros((1, 6))), other.at(np.zeros((1, 6)))
    if a.gap.shape == b.gap.shape and np.allclose(a.parameter, b.parameter, atol=1e-6):
        np.testing.assert_allclose(a.gap, b.gap, atol=1e-14)
        np.testing.assert_allclose(a.radius, b.radius, rtol=1e-9)


@pytest.mark.property
def test_early_contact_is_on_the_tip_edge_and_grows_with_the_square() -> None:
    """Property: beyond the path the gap opens without a jump, slope and value both from zero."""
    base = SUN.gear.base_radius
    fine = np.linspace(-1.0, 1.0, 2001) * 0.02
    pair = rigid_pair((SUN, PLANET), 1, fine)
    state = pair.at(np.zeros((len(fine), 6)))
    assert state.edge is not None
    for c in range(state.gap.shape[1]):
        inside, gap = state.edge[:, c, 0], state.gap[:, c]
        near = (inside < 0) & (inside > -0.3e-3)
        if near.sum() > 20:
            assert (gap[near] > 0).all()
            ratio = gap[near] / inside[near] ** 2
            flat = np.median(1 / (2 * state.radius[near, c]))
            assert (ratio < 1.5 * flat).all()
            assert np.abs(np.diff(gap)).max() < 2 * base * np.diff(fine)[0]


@pytest.mark.property
def test_gears_that_do_not_mesh_are_refused() -> None:
    """Property: unlike base pitches, and base circles that cross."""
    with pytest.raises(Infeasible, match="base pitches"):
        rigid_pair((SUN, external(30, module=2.5e-3)), 1, np.zeros(1))
    with pytest.raises(Infeasible, match="base circles need more than"):
        rigid_pair((SUN, PLANET), 1, np.zeros(1), centers=0.9 * CENTERS)
    with pytest.raises(Infeasible, match="ring as the second"):
        rigid_pair((ring(), PLANET), 1, np.zeros(1))
    with pytest.raises(Infeasible, match="both ends must differ"):
        Relief(1e-3, 1e-3, 1e-6)

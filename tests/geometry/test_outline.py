"""Facets on curves: equal, graded, with corners and named sides."""

import math

import numpy as np
import pytest

from trochoid.geometry.disc import disc_outline
from trochoid.geometry.outline import Loop, bending_breaks, graded_breaks
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.path import polygon

EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)
SQUARE = polygon([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])


@pytest.mark.exact
def test_facets_are_equal_in_arc_length_and_alike_on_all_lobes() -> None:
    """12 facets a lobe of a flank: equal lengths, and parameters that repeat with the lobe pitch."""
    t = Loop("flank", EXAMPLE, 12 * 19).parameters()
    s = ArcLength(EXAMPLE).length(t)
    np.testing.assert_allclose(np.diff(s), s[-1] / (12 * 19), rtol=1e-10)
    np.testing.assert_allclose(t[12:] - t[:-12], 2.0 * math.pi / 19, rtol=1e-12)
    assert t[-1] - t[0] == EXAMPLE.period


@pytest.mark.property
@pytest.mark.parametrize("facets", [6, 12, 20])
def test_bending_breaks_are_alike_on_all_lobes_and_mirrored(facets: int) -> None:
    """Facet ends repeat with the lobe pitch and are symmetric about the crest."""
    t = bending_breaks(EXAMPLE, facets, 19)
    pitch = 2.0 * math.pi / 19
    assert t.size == 19 * facets + 1
    np.testing.assert_allclose(t[facets:] - t[:-facets], pitch, rtol=1e-12)
    np.testing.assert_allclose(t[: facets + 1], pitch - t[facets::-1], atol=1e-12)
    assert np.all(np.diff(t) > 0.0)


@pytest.mark.exact
def test_a_loop_starts_where_it_is_told() -> None:
    """Circle facets from 0.3 rad on."""
    t = Loop("hole", Circle((1.0, 2.0), 0.5, hole=True), 16, start=0.3).parameters()
    np.testing.assert_allclose(t, 0.3 + np.arange(17) * math.pi / 8.0, atol=1e-14)


@pytest.mark.exact
def test_corners_are_always_facet_ends() -> None:
    """Twelve facets round a 2 × 1 rectangle: four and two a side."""
    np.testing.assert_allclose(
        Loop("block", SQUARE, 12).parameters(),
        [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.25, 2.5, 2.75, 3.0, 3.5, 4.0],
        atol=1e-14,
    )


@pytest.mark.exact
@pytest.mark.parametrize(
    ("loop", "message"),
    [
        (Loop("a", SQUARE, 2), "loop 'a' has 2 facets; at least 3"),
        (Loop("b", SQUARE, breaks=np.array([0.0, 1.0, 3.0, 4.0])), "'b' leave out the corner at parameter 2"),
        (Loop("c", SQUARE, breaks=np.array([0.0, 1.0, 2.0, 3.0])), "'c' must grow over exactly one period"),
        (Loop("d", SQUARE, breaks=np.array([0.0, 2.0, 1.0, 3.0, 4.0])), "'d' must grow"),
    ],
)
def test_loops_that_cannot_be_cut_are_refused(loop: Loop, message: str) -> None:
    """The message names the loop."""
    with pytest.raises(Infeasible, match=message):
        loop.parameters()


@pytest.mark.property
def test_graded_breaks_follow_the_wanted_length() -> None:
    """Facets are within 15 % of finest + slope·distance, focus and corners are facet ends."""
    top = polygon([[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0], [-1.0, 0.0]])
    t = graded_breaks(top, np.array([3.0]), finest=1e-3, coarsest=0.1, slope=0.3, width=0.01)
    Loop("block", top, breaks=t).parameters()
    arc = ArcLength(top)
    s = arc.length(t)
    away = np.abs(0.5 * (s[1:] + s[:-1]) - arc.length(3.0))
    away = np.minimum(away, arc.total - away)
    wanted = np.minimum(0.1, 1e-3 + 0.3 * np.maximum(0.0, away - 0.01))
    assert np.all(np.abs(np.diff(s) / wanted - 1.0) < 0.15)
    assert np.abs(t - 3.0).min() < 1e-12


@pytest.mark.exact
def test_a_disc_has_its_named_loops() -> None:
    """Flank, bore and holes; the holes are congruent, and no coarser than 1.75 flank facets."""
    outline = disc_outline(EXAMPLE, 0.025, 8, 0.052, 0.01, 0.2, 12)
    assert [loop.name for loop in outline.loops] == ["flank", "bore", *(f"hole{j}" for j in range(8))]
    first, third = outline.holes[1], outline.holes[3]
    turn = np.exp(0.5j * math.pi)
    a, b = (loop.curve.point(loop.parameters()) @ np.array([1.0, 1.0j]) for loop in (first, third))
    np.testing.assert_allclose(a * turn, b, atol=1e-16)
    mean = ArcLength(EXAMPLE).total / (12 * 19)
    for loop in outline.holes:
        assert ArcLength(loop.curve).total / loop.facets <= 1.75 * mean


@pytest.mark.exact
def test_thin_walls_ask_for_finer_facets() -> None:
    """A wall of 1 mm beside a hole is met by facets of 1 mm, one of 10 µm by an eighth of the usual ones."""
    usual, thin, thinner = (
        disc_outline(EXAMPLE, 0.052 - 0.01 - w, 8, 0.052, 0.01, 0.0, 12) for w in (0.01, 1e-3, 1e-5)
    )
    assert 2.0 * math.pi * 0.01 / thin.holes[1].facets == pytest.approx(1e-3, rel=0.05)
    assert usual.holes[1].facets < thin.holes[1].facets < thinner.holes[1].facets < 9 * usual.holes[1].facets


@pytest.mark.exact
def test_a_disc_that_cannot_be_made_is_refused() -> None:
    """Holes into the bore; no facets."""
    with pytest.raises(Infeasible, match="break into the bore"):
        disc_outline(EXAMPLE, 0.043, 8, 0.052, 0.01, 0.0, 12)
    with pytest.raises(Infeasible, match="facets per lobe = 0"):
        disc_outline(EXAMPLE, 0.025, 8, 0.052, 0.01, 0.0, 0)

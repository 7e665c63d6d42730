"""Loops refined at contacts: equal facets in windows, growth between them, refusals."""

from __future__ import annotations

import numpy as np
import pytest

from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.geometry.refined import SLOPE, Window, refine
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.path import polygon

FLANK = Cycloid(20, 19, 0.080, 0.005, 0.0025)


@pytest.mark.property
@pytest.mark.parametrize(
    ("loop", "windows"),
    [
        (Loop("rim", Circle((0.0, 0.0), 0.05), 32), [Window(0.0, 1e-4, 9), Window(np.pi, 2e-6, 31)]),
        (Loop("hole", Circle((0.1, 0.0), 0.05, hole=True), 32), [Window(-3.1, 1e-4, 8)]),
        (Loop("flank", FLANK, 19 * 12), [Window(t, 1e-5, 49) for t in (0.1, 0.4, 6.2, 2.0)]),
        (Loop("block", polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), 16), [Window(2.5, 1e-3, 21)]),
    ],
)
def test_facets_are_equal_in_windows_and_grow_between(loop: Loop, windows: list[Window]) -> None:
    """Every window has its facets where it asks; none is longer than the loop's own, none jumps in length."""
    refined, numbers = refine(loop, windows)
    arc = ArcLength(loop.curve)
    ends = arc.length(refined.parameters())
    length = np.diff(ends)
    own = np.diff(arc.length(loop.parameters()))
    assert length.sum() == pytest.approx(arc.total, rel=1e-12)
    assert length.max() <= 1.6 * own.max()
    for window, facets in zip(windows, numbers, strict=True):
        assert len(facets) == window.facets
        assert length[facets] == pytest.approx(window.length, rel=1e-7)
        middle = 0.5 * (ends[facets[0]] + ends[facets[-1] + 1])
        off = np.mod(middle - arc.length(np.array(window.parameter)) + 0.5 * arc.total, arc.total)
        assert off - 0.5 * arc.total == pytest.approx(0.0, abs=1e-12)
    jump = np.roll(length, 1) / length
    assert max(jump.max(), 1 / jump.min()) < 1 + 3 * SLOPE


@pytest.mark.property
def test_without_windows_nothing_changes() -> None:
    """No window: the very same loop."""
    loop = Loop("rim", Circle((0.0, 0.0), 0.05), 32)
    assert refine(loop, ()) == (loop, ())


@pytest.mark.property
def test_refined_loops_can_be_meshed() -> None:
    """Facets of 1/1000 of the radius on both sides of a disc: a mesh of few elements."""
    loop, _ = refine(
        Loop("rim", Circle((0.0, 0.0), 0.05), 32), [Window(0.0, 5e-5, 31), Window(np.pi, 5e-5, 31)]
    )
    assert len(mesh_outline(Outline(loop)).triangles.T) < 3000


@pytest.mark.property
def test_overlap_and_corners_are_refused() -> None:
    """Two windows in one place, or one over a corner: said, with the windows."""
    rim = Loop("rim", Circle((0.0, 0.0), 0.05), 32)
    with pytest.raises(Infeasible, match="overlap"):
        refine(rim, [Window(0.0, 1e-3, 9), Window(0.1, 1e-3, 9)])
    with pytest.raises(Infeasible, match="overlap"):
        refine(rim, [Window(0.0, 0.1, 9)])
    block = Loop("block", polygon([(0, 0), (1, 0), (1, 1), (0, 1)]), 16)
    with pytest.raises(Infeasible, match="corner"):
        refine(block, [Window(1.99, 1e-2, 9)])

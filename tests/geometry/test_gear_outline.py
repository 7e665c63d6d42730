"""Gear bodies: the boundary as a curve, its rounded tips, facets, meshes, and what cannot be made."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.gear_cases import MODULE, external, pointed, ring
from trochoid.geometry.gear_curve import GearBoundary
from trochoid.geometry.gear_outline import Blank, gear_growth, gear_outline
from trochoid.geometry.gear_tooth import Tooth, sharpest
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.quality import quality
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.rack import Rack, rack_cut
from trochoid.kinematics.types import Array

TEETH = [external(20, 0.5, 0.134), pointed(), ring()]
BLANKS = [Blank(external(17), 8e-3), Blank(pointed(), 4e-3), Blank(ring(), 92e-3)]


@pytest.mark.exact
@pytest.mark.parametrize("tooth", TEETH, ids=["external", "pointed", "ring"])
def test_tangent_speed_and_curvature_are_those_of_the_points(tooth: Tooth) -> None:
    """Exact: derivatives of the position, by central differences, on both flanks of the fine tooth and beside it."""
    curve, step = GearBoundary(tooth), 1e-6
    t = np.linspace(-0.9, 1.9, 1500)
    knots = np.concatenate([curve.corners, curve.corners - curve.period])
    t = t[np.abs(t[:, None] - knots).min(axis=1) > 10 * step]
    slope = (curve.point(t + step) - curve.point(t - step)) / (2 * step)
    speed = curve.speed(t)
    np.testing.assert_allclose(slope, speed[:, None] * curve.tangent(t), atol=1e-7 * speed.max())
    turn = (curve.normal(t + step) - curve.normal(t - step)) / (2 * step)
    bend = curve.curvature(t) * speed
    scale = np.abs(bend).max()
    np.testing.assert_allclose(turn, bend[:, None] * curve.tangent(t), atol=1e-6 * scale)


@pytest.mark.exact
@pytest.mark.parametrize("tooth", TEETH, ids=["external", "pointed", "ring"])
def test_rounding_is_tangent_to_flank_and_tip(tooth: Tooth) -> None:
    """Exact: the boundary has no jump and no corner on the fine tooth, and does not reach beyond its tip circle."""
    curve = GearBoundary(tooth)
    for knot in curve.corners[(curve.corners > 0.3) & (curve.corners < 0.7)]:
        below, above = curve.point(knot - 1e-12), curve.point(knot + 1e-12)
        assert np.linalg.norm(above - below) < 1e-9 * tooth.tip_radius
        assert curve.normal(knot - 1e-12) @ curve.normal(knot + 1e-12) > 1 - 1e-9
    radius = np.linalg.norm(curve.point(np.linspace(0.4, 0.6, 2001)), axis=1)
    side = tooth.gear.side
    assert side * (side * radius).max() == pytest.approx(tooth.top_radius, rel=1e-9)
    assert tooth.full == (side * (tooth.tip_radius - tooth.top_radius) > 1e-12)


@pytest.mark.exact
def test_fine_tooth_is_the_involute_gear_below_its_rounding() -> None:
    """Exact: below the rounding all teeth are those of the whole gear's curve; `rho` inverts `parameter`."""
    tooth = external(20, 0.5, 0.134)
    curve, whole = GearBoundary(tooth), GearCurve(tooth.cut, tooth.tip_radius)
    rho = np.linspace(tooth.cut.start, tooth.end, 50)[1:-1]
    t = curve.parameter(rho)
    np.testing.assert_allclose(curve.rho(t), rho, rtol=1e-13)
    high = float(tooth.gear.curvature_radius(tooth.tip_radius))
    of_whole = 0.22 + 0.2 * (rho - tooth.cut.start) / (high - tooth.cut.start)
    for tooth_number in (0, 7):
        at = curve.point(tooth_number + t)
        np.testing.assert_allclose(at, whole.point(tooth_number + of_whole), atol=1e-15)


@pytest.mark.property
@settings(max_examples=8, deadline=None)
@given(st.integers(12, 60), st.floats(-0.1, 0.9), st.floats(0.005, 0.06), st.floats(0.3, 0.9))
def test_any_tooth_has_a_sound_mesh(teeth: int, shift: float, share: float, bore: float) -> None:
    """Property: no element of any gear is nearly folded; lands narrower than their rounding leave a few slim ones."""
    gear = Gear(teeth, MODULE, shift=shift)
    if gear.least_shift > shift:
        return
    cut = rack_cut(gear, Rack(MODULE))
    tooth = Tooth(cut, gear.pitch_radius + MODULE * (1 + shift), share * MODULE)
    blank = Blank(tooth, bore * cut.root_radius)
    found = quality(mesh_outline(gear_outline(blank, 6), gear_growth(blank)))
    assert found.min_angle > np.radians(3)
    assert found.max_angle < np.radians(155)
    assert found.min_scaled_jacobian > 0.08


@pytest.mark.property
@pytest.mark.parametrize("blank", BLANKS, ids=["external", "pointed", "ring"])
def test_twice_the_level_halves_the_facets_of_the_fine_tooth(blank: Blank) -> None:
    """Property: what the error estimate rests on."""
    meshes = [mesh_outline(gear_outline(blank, level), gear_growth(blank)) for level in (8, 16)]
    counts = []
    for mesh in meshes:
        t = mesh.parameters["teeth"][2]
        counts.append(int(((t > 0.22) & (t < 0.42)).sum()))
        assert np.array_equal(np.sort(1.0 - t[(t > 0) & (t < 1)]).round(9), t[(t > 0) & (t < 1)].round(9))
    assert 1.8 <= counts[1] / counts[0] <= 2.2
    assert all(quality(mesh).min_scaled_jacobian > 0.15 for mesh in meshes)


@pytest.mark.property
def test_what_cannot_be_made_says_what_could() -> None:
    """Property: each fault names its limit."""
    cut = rack_cut(Gear(20, MODULE), Rack(MODULE))
    with pytest.raises(Infeasible, match=r"sharp edge has no contact law.*0\.04 mm"):
        Tooth(cut, 22e-3, 0.0)
    with pytest.raises(Infeasible, match="above the end of the fillet"):
        Tooth(cut, 18.7e-3, 1e-5)
    with pytest.raises(Infeasible, match="leaves no involute"):
        Tooth(cut, 22e-3, 4e-3)
    tooth = external(20)
    with pytest.raises(Infeasible, match=r"bore radius 17\.49 mm.*17\.4 mm"):
        Blank(tooth, 17.49e-3)
    with pytest.raises(Infeasible, match=r"outer radius 80 mm.*above 85\.67"):
        Blank(ring(), 80e-3)
    with pytest.raises(Infeasible, match="1 facets per flank"):
        gear_outline(Blank(tooth, 9e-3), 1)


@pytest.mark.property
@pytest.mark.parametrize("teeth", range(8, 18))
@pytest.mark.parametrize("above", [0.0, 1e-9, 0.004], ids=["at", "just above", "above"])
def test_gear_at_the_limit_of_undercut_has_no_corner_twice(teeth: int, above: float) -> None:
    """Property: fillet and involute meet on the base circle, where the involute stands still; corners stay apart."""
    gear = Gear(teeth, MODULE, shift=Gear(teeth, MODULE).least_shift + above)
    cut = rack_cut(gear, Rack(MODULE))
    tip = gear.pitch_radius + 0.9 * MODULE * (1.0 + float(gear.shift))
    blank = Blank(Tooth(cut, tip, sharpest(gear)), 0.5 * cut.root_radius)
    corners = _corners(blank)
    apart = np.linalg.norm(np.diff(corners, axis=0, append=corners[:1]), axis=1)
    assert apart.min() > 1e-6 * MODULE


@pytest.mark.property
def test_gear_at_the_limit_of_undercut_is_meshed() -> None:
    """Property: a sun of twelve teeth with the least shift to 0.01, the sun of the RV starter."""
    gear = Gear(12, MODULE, shift=0.3)
    cut = rack_cut(gear, Rack(MODULE))
    blank = Blank(Tooth(cut, gear.pitch_radius + 1.3 * MODULE, sharpest(gear)), 0.5 * gear.pitch_radius)
    mesh = mesh_outline(gear_outline(blank, 4), growth=gear_growth(blank))
    assert quality(mesh).min_scaled_jacobian > 0.1


def _corners(blank: Blank) -> Array:
    """Return the points at which facets of the teeth meet."""
    (teeth,) = (loop for loop in (gear_outline(blank).outer,) if loop.name == "teeth")
    assert teeth.breaks is not None
    return np.asarray(teeth.curve.point(teeth.breaks[:-1]))

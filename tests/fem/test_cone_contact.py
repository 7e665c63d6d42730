"""Contact of rollers with a rim of sphere teeth: planar limit, Hertz's ellipse, resolved elements, invariants."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.fem.cone_cases import INNER, OUTER, SHAPE, SPIN, STEEL, TOOTH, pair, plane_disc, rim, solved
from trochoid.fem.cone_assembly import ConeAssembly, ConeContact
from trochoid.fem.cone_body import cone_body
from trochoid.fem.cone_estimate import estimate
from trochoid.fem.cone_flank import flank
from trochoid.fem.cone_layers import layers
from trochoid.fem.cone_pair import RIGID, ROTATIONS, crown, roller_pair, tilt
from trochoid.fem.cone_position import solve_cone
from trochoid.fem.cone_resolved import Window, resolve
from trochoid.fem.cone_rim import RimMesh, RimSize, press_rim
from trochoid.fem.cone_roller import closed_form_roller, press_roller
from trochoid.fem.hertz_point import point_contact
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import outline_of_breaks
from trochoid.geometry.sphere_refined import Focus, refined_breaks
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.types import Array

CRANK = np.array([0.0, 0.3, 2.0])
TORQUE = 135.0


@pytest.mark.independent
@pytest.mark.parametrize("rho", [1.0, 100.0])
def test_without_nutation_it_is_the_plane_engine(rho: float) -> None:
    """A rim far from O with a nutation → 0 (0.07°, 0.0007°) is a cycloid disc: rotation, stiffness, forces: 0.5 %."""
    width, crank = 6e-3, np.array([0.0, 0.4])
    exact = plane_disc(crank, 20.0, width)
    tooth = SphereTooth(12, 11, 24e-3 / rho, 2e-3 / rho, 1.2e-3 / rho)
    shape = RimShape(tooth, 12e-3 / rho)
    size = RimSize(rho - 0.5 * width, rho + 0.5 * width)
    built = press_rim(shape, size, Material(210e9, 0.0), RimMesh(24, 2)).compliance
    rollers = roller_pair(tooth, crank, built.slices, shape.start, moves=SPIN)
    found = solve_cone(ConeAssembly(built, rollers, np.zeros((1, 1)), np.full((2, 1), 20.0)))
    force = exact.touches["pins"].force
    assert found.motion == pytest.approx(exact.motion, rel=2e-3)
    assert found.stiffness[:, 0, 0] == pytest.approx(exact.stiffness[:, 0, 0], rel=5e-3)
    assert np.abs(found.total - force).max() < 2e-3 * force.max()


@pytest.mark.exact
def test_a_crowned_roller_touches_over_hertz_ellipse() -> None:
    """Crowned by 100 µm, a roller touches over 2 of 12 mm: ellipse and pressure of Hertz, in parts of the layers."""
    built = rim(12, 8, 16)
    slices = built.compliance.slices
    rollers = pair(built, np.array([0.3]), rollers=np.array([5]), relief=crown(slices, 100e-6))
    found = solved(built, rollers, 500.0 * 0.0486)
    across = float(found.state.bend[0, 0]) / 54e-3
    along = 2.0 * 100e-6 / 6e-3**2
    hertz = point_contact((across, along), STEEL.plane("strain").modulus)
    total = found.total[0, 0]
    long, short = hertz.semi_axes(total)
    assert found.pressure.max() == pytest.approx(hertz.pressure(total), rel=1e-2)
    assert found.half_width.max() == pytest.approx(short, rel=1e-2)
    pressed = found.force[0, 0] > 0.0
    assert 0.5 * slices.length[pressed].sum() == pytest.approx(long, rel=4e-2)
    assert not found.edge().any()


@pytest.mark.independent
def test_two_teeth_against_resolved_contact() -> None:
    """Two teeth share a load; facets of a quarter of the half width: approach, shares 1 %, pressures, ends 3 %."""
    rollers, first, load = np.array([5, 6]), 3, 800.0 * 0.0486
    row = press_rim(SHAPE, RimSize(INNER, OUTER, teeth=3), STEEL, RimMesh(24, 4)).compliance
    start = SHAPE.start + first * SHAPE.pitch
    touching = roller_pair(TOOTH, np.array([0.3]), row.slices, start, rollers, SPIN)
    found = solve_cone(ConeAssembly(row, touching, np.zeros((1, 1)), np.array([[load]])))
    width = (found.half_width[0] / row.slices.middle).max(axis=1)
    place = found.state.parameter[0]
    foci = tuple(Focus(float(p), float(w) / 4.0, 12) for p, w in zip(place, width, strict=True))
    mesh = mesh_sphere(outline_of_breaks(SHAPE, refined_breaks(SHAPE, first, 3, 12, foci), 1.5), 1.5)
    body = cone_body(mesh, layers(INNER, OUTER, 4), STEEL)
    side = flank(mesh, TOOTH)
    windows = tuple(
        Window(
            int(np.argmin(np.abs(side.parameters[0] - p))) + np.arange(-6, 6),
            TOOTH.center_path(TOOTH.contact_parameter(roller, 0.3)),
            TOOTH.pin_angle,
        )
        for p, roller in zip(place, rollers, strict=True)
    )
    exact = resolve(body, side, windows, SPIN, np.array([load]))
    assert found.motion[0] == pytest.approx(exact.motion, rel=1e-2)
    assert found.total[0] == pytest.approx(exact.line.sum(axis=1), rel=1e-2)
    assert found.force[0] == pytest.approx(exact.line, rel=3e-2)
    assert found.pressure[0] == pytest.approx(exact.pressure.max(axis=1), rel=3e-2)


@pytest.mark.exact
def test_forces_balance_and_stiffness_is_the_slope() -> None:
    """Rᵀp + K a = F with three rotations on springs; the tangent is a central difference of load over motion.

    The slope's small skew part is not in it.  Steps are so small that no slice is lost between them.
    """
    built, springs = rim(), np.diag([1e5, 1e5, 0.0])
    rollers = pair(built, CRANK[:2], ROTATIONS, clearance=1e-4)
    load = np.array([3.0, -2.0, TORQUE])
    found = solved(built, rollers, load, springs)
    carried = np.einsum("ncsk,ncs->nk", found.state.arms, found.force) + found.motion @ springs
    assert carried == pytest.approx(np.broadcast_to(load, carried.shape), rel=1e-8, abs=1e-6)
    assert found.residual.max() < 1e-7
    moved = []
    for step in 1e-5 * TORQUE * np.eye(3):
        up, down = (solved(built, rollers, load + s * step, springs).motion for s in (1, -1))
        moved.append((up - down) / (2e-5 * TORQUE))
    slope = np.linalg.inv(np.stack(moved, axis=-1))
    size = np.abs(slope).max(axis=(1, 2), keepdims=True)
    assert np.abs(0.5 * (slope + slope.transpose(0, 2, 1)) / size - found.stiffness / size).max() < 1e-3


@pytest.mark.property
def test_positions_repeat_and_do_not_know_each_other() -> None:
    """A crank turned by z2 pitches of teeth moves every contact on by one roller; alone or in company, all is equal."""
    built = rim()
    one = solved(built, pair(built, CRANK), TORQUE)
    period = 2.0 * math.pi * 29 / 30  # brings roller i to where i + 1 was, seen from the rim: by 2π/30
    other = solved(built, pair(built, CRANK + period), TORQUE)
    assert np.roll(one.total, -1, axis=1) == pytest.approx(other.total, abs=2e-2 * one.total.max())
    alone = solved(built, pair(built, CRANK[1:2]), TORQUE)
    assert alone.force[0] == pytest.approx(one.force[1], rel=1e-6, abs=1e-6)
    assert one.edge().any()


@pytest.mark.property
def test_mirrored_torque_mirrors_the_contact() -> None:
    """At crank angle 0 the rim is its own mirror image: −M presses roller −i as M presses roller i."""
    built = rim()
    found = solved(built, pair(built, np.zeros(1)), TORQUE)
    mirrored = solved(built, pair(built, np.zeros(1)), -TORQUE)
    assert mirrored.motion == pytest.approx(-found.motion, rel=5e-3)
    assert np.roll(mirrored.total[:, ::-1], 1, axis=1) == pytest.approx(
        found.total, abs=1e-2 * found.total.max()
    )


@pytest.mark.property
def test_clearance_takes_contacts_away() -> None:
    """Fewer contacts, larger forces, more rotation; a roller that is too thick presses at zero torque."""
    built = rim()
    runs = [solved(built, pair(built, CRANK, clearance=c / 54e-3), TORQUE) for c in (0.0, 1e-6, 1e-5, 1e-4)]
    counts = [int((run.total > 0.0).sum()) for run in runs]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > 2 * counts[-1]
    largest = [run.total.max() for run in runs]
    assert largest == sorted(largest)
    assert np.all(np.diff([run.motion.min() for run in runs]) > 0.0)
    tight = solved(built, pair(built, CRANK[:1], clearance=-2e-6 / 54e-3), 0.0)
    assert (tight.total > 0.0).all()


@pytest.mark.property
def test_zero_load_one_tooth_and_loads_in_rounding() -> None:
    """Nothing presses without a load; one roller alone carries M/arm; a load in the rounding of gaps is refused."""
    built = rim()
    nothing = solved(built, pair(built, CRANK), 0.0)
    assert not nothing.force.any()
    assert not nothing.pressure.any()
    one = solved(built, pair(built, CRANK[1:2], rollers=np.array([5])), 20.0)
    assert np.einsum("ncsk,ncs->nk", one.state.arms, one.force)[0] == pytest.approx(20.0, rel=1e-9)
    assert one.total[0, 0] == pytest.approx(20.0 / one.state.arms[0, 0, :, 0].mean(), rel=2e-2)
    with pytest.raises(NotConverged, match="drowns in rounding"):
        solved(built, pair(built, CRANK, relief=1e-4), 1e-15)
    held = solved(
        built, pair(built, CRANK, clearance=1e-3), 1.0, np.array([[1e6]])
    )  # springs carry all of it
    assert not held.force.any()
    assert held.motion == pytest.approx(np.full((3, 1), 1e-6), rel=1e-12)
    assert held.stiffness == pytest.approx(np.full((3, 1, 1), 1e6), rel=1e-12)
    with pytest.raises(NotConverged, match="nothing resists"):
        solved(built, pair(built, CRANK[1:2], rollers=np.array([5])), -20.0)


@pytest.mark.property
def test_slight_loads() -> None:
    """However slight, a load is carried without overlaps; shares tend to those of lines with one stiffness each."""
    runs = [solved(rim(), pair(rim(), CRANK[1:]), load) for load in (1e-3, 1e-9, 1e-15)]
    shares = [run.total / run.total.max() for run in runs]
    assert max(run.residual.max() for run in runs) < 1e-9
    assert np.abs(shares[1] - shares[2]).max() < 0.5 * np.abs(shares[0] - shares[1]).max() + 0.02
    soft = [float((run.motion / load).mean()) for run, load in zip(runs, (1e-3, 1e-9, 1e-15), strict=True)]
    assert soft[2] - soft[1] == pytest.approx(soft[1] - soft[0], rel=0.1)  # the logarithm of the width


@pytest.mark.property
def test_crown_tilt_and_short_rollers() -> None:
    """A tilt presses one end, a crown relieves both; a roller shorter than the flank presses its own ends more."""
    built = rim()
    slices, alone = built.compliance.slices, np.array([5])

    def line(relief: Array | float) -> Array:
        found = solved(built, pair(built, CRANK[1:2], rollers=alone, relief=relief), 20.0)
        q: Array = found.force[0, 0] / slices.length
        return q

    straight, tilted, crowned = line(0.0), line(tilt(slices, np.array([2e-4]))), line(crown(slices, 5e-6))
    assert np.all(np.diff(tilted / straight) < 0.0)
    assert crowned[0] < straight[0]
    assert crowned[-1] < straight[-1]
    assert crowned[2] > straight[2]
    short = press_rim(SHAPE, RimSize(INNER, OUTER, reach=(50e-3, 58e-3)), STEEL, RimMesh(12, 8))
    found = solved(short, pair(short, CRANK[1:2], rollers=alone), 20.0)
    q = found.force[0, 0] / short.compliance.slices.length
    assert found.edge().all()
    assert min(q[0], q[-1]) > 1.1 * q[1:-1].min()


@pytest.mark.independent
def test_elastic_rollers_two_ways() -> None:
    """Rollers on a thin pin as a body of their own and half a solid cylinder in closed form: near each other."""
    built = rim()
    layers_, angles = built.compliance.layers, (TOOTH.pin_angle, 0.4 * TOOTH.pin_angle)
    rigid = solved(built, pair(built, CRANK), TORQUE)
    closed = solved(built, pair(built, CRANK), TORQUE, roller=closed_form_roller(STEEL))
    body = solved(built, pair(built, CRANK), TORQUE, roller=press_roller(layers_, angles, STEEL))
    soft = [run.motion[:, 0] / rigid.motion[:, 0] - 1.0 for run in (closed, body)]
    assert np.all(soft[1] > 0.2)
    assert soft[0] == pytest.approx(soft[1], rel=0.3)
    stiff = Material(1e6 * STEEL.youngs_modulus, 0.3)
    same = solved(built, pair(built, CRANK), TORQUE, roller=press_roller(layers_, angles, stiff))
    assert same.motion == pytest.approx(rigid.motion, rel=1e-4)


@pytest.mark.exact
def test_rollers_on_seats() -> None:
    """One roller on a spring: its rotation grows by force over stiffness and lever; a stiff seat is a rigid one."""
    built, alone = rim(), pair(rim(), CRANK[1:2], rollers=np.array([5]))
    rigid, soft, stiff = (
        solved(built, alone, 20.0, roller=replace(closed_form_roller(STEEL), seat=seat))
        for seat in (0.0, 2e-10, 1e-20)
    )
    lever = float(soft.state.arms[0, 0, :, 0] @ soft.force[0, 0]) / soft.total[0, 0]
    gave_way = 2e-10 * soft.total[0, 0] / lever
    assert soft.motion[0, 0] - rigid.motion[0, 0] == pytest.approx(gave_way, rel=2e-2)
    assert 1.0 / soft.stiffness[0, 0, 0] - 1.0 / rigid.stiffness[0, 0, 0] == pytest.approx(
        2e-10 / lever**2, rel=2e-2
    )
    assert stiff.motion == pytest.approx(rigid.motion, rel=1e-9)


@pytest.mark.property
def test_all_six_motions() -> None:
    """On springs in all directions every motion balances, and the 6×6 stiffness is symmetric and positive."""
    built, springs = rim(), np.diag([1e5, 1e5, 0.0, 1e8, 1e8, 1e8])
    found: ConeContact = solved(built, pair(built, CRANK, RIGID), np.array([0, 0, TORQUE, 0, 0, 0]), springs)
    k = found.stiffness
    assert np.abs(k - k.transpose(0, 2, 1)).max() < 1e-9 * np.abs(k).max()
    assert np.linalg.eigvalsh(k).min() > 0.0


@pytest.mark.property
def test_contact_at_the_tip_edge() -> None:
    """Crests cut away: rollers beyond the edges touch these or nothing; forces balance; finer meshes agree."""
    shape, crank = replace(SHAPE, tip=math.radians(64.5)), np.linspace(0.0, 3.0, 8)
    runs = []
    for facets in (16, 28):
        built = press_rim(shape, RimSize(INNER, OUTER), STEEL, RimMesh(facets, 4)).compliance
        rollers = roller_pair(TOOTH, crank, built.slices, shape.start, moves=SPIN, edges=shape.edges)
        load = np.full((len(crank), 1), TORQUE)
        runs.append(solve_cone(ConeAssembly(built, rollers, np.zeros((1, 1)), load)))
    coarse, fine = runs
    assert fine.state.off.any()
    assert (fine.state.gap[fine.state.off] > -1e-9).mean() > 0.5  # edges stand back from where the crest was
    carried = np.einsum("ncsk,ncs->nk", fine.state.arms, fine.force)
    assert carried == pytest.approx(TORQUE, rel=1e-8)
    assert np.all(fine.edge()[fine.state.off & (fine.total > 0.0)])
    assert coarse.motion == pytest.approx(fine.motion, rel=5e-3)
    assert np.abs(coarse.total - fine.total).max() < 2e-2 * fine.total.max()


@pytest.mark.property
def test_estimate_contains_the_error() -> None:
    """Half the difference of two meshes against a third, finer one: within twice the estimate, and not idle."""
    crank, load = np.linspace(0.0, 3.0, 6), np.full((6, 1), TORQUE)
    coarse, middle, fine = (
        solved(rim(f, n), pair(rim(f, n), crank), TORQUE) for f, n in ((8, 3), (16, 5), (28, 8))
    )
    found, true = estimate(middle, coarse, load), estimate(fine, middle, load)
    assert found.motion.max() > true.motion.max()  # the latter is half of the error
    assert found.share.max() > 0.5 * true.share.max()
    assert 1e-3 < found.worst < 0.1

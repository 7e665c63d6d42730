"""Hard cases of elastic sphere teeth, through the scene: flat teeth, slight and excessive loads, undercut, edges."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from tests.drives.test_precessional_contact import ELASTIC, TORQUE, built, solved, stages
from tests.fem.cone_cases import plane_disc
from trochoid.drives.precessional.contact import Series, inertia_moment, pitch_angles, solve_series
from trochoid.drives.precessional.overload import doubts
from trochoid.drives.precessional.teeth import build_level
from trochoid.drives.precessional.tooth_loads import spin_residual
from trochoid.kinematics.errors import Infeasible, NotConverged, TrochoidError
from trochoid.run import Run

YIELDING = (*ELASTIC, "bearing_compliance", "inertia")


@pytest.mark.independent
def test_without_nutation_it_is_the_plane_engine() -> None:
    """A scene with a nutation of 0.017° at pins 0.34° off the axis, 4 m from O, is a cycloid disc: within 0.5 %."""
    rho, width, torque = 4.0, 6e-3, 20.0
    crank = np.array([0.0, 0.4])
    made = stages(
        drive__z_wheel=12,
        drive__z_satellite=11,
        drive__nutation_angle=math.degrees(1.2e-3 / rho),
        drive__teeth__polar_angle=math.degrees(24e-3 / rho),
        drive__teeth__pin_angle=math.degrees(2e-3 / rho),
        drive__teeth__inner_radius=1e3 * rho - 3.0,
        drive__teeth__outer_radius=1e3 * rho + 3.0,
        drive__rim__hub_angle=math.degrees(12e-3 / rho),
        materials__steel__poissons_ratio=0.0,
    )
    found = solve_series(made.feasible, build_level(made.feasible, 24), torque, crank)
    exact = plane_disc(crank, torque, width)
    force = exact.touches["pins"].force
    assert np.abs(found.total - force).max() < 5e-3 * force.max()
    assert found.lag == pytest.approx(exact.motion[:, 0], rel=5e-3)
    assert found.torsional_stiffness == pytest.approx(exact.stiffness[:, 0, 0], rel=5e-3)


def _flat(nutation: float, torque: float) -> Series:
    made = stages(drive__nutation_angle=nutation)
    return solved(made, build_level(made.feasible, 12), torque, crank=[0.0, 0.1])


@pytest.mark.property
def test_flat_teeth_are_alike() -> None:
    """Down to 1e-4° of nutation: under torques as its square, forces and motions of contacts go with the angle."""
    reference = _flat(0.1, 1e-3)
    for nutation in (1e-2, 1e-4):
        share = nutation / 0.1
        found = _flat(nutation, 1e-3 * share**2)
        assert found.total / share == pytest.approx(reference.total, abs=0.01 * reference.total.max())
        assert found.residual.max() < 1e-9
        assert spin_residual(found) < 1e-9


@pytest.mark.property
def test_a_rim_too_thin_for_its_facets() -> None:
    """Elements that fold between flank and hub: the message says how thin, and both ways out, which work."""
    made = stages(drive__nutation_angle=0.3, drive__rim__hub_angle=64.55)
    with pytest.raises(TrochoidError, match=r"only 0\.15° thin between the flank and the hub") as fault:
        build_level(made.feasible, 8)
    away, facets = re.findall(r"at least ([\d.]+)° away.* give the flank (\d+) facets", str(fault.value))[0]
    farther = stages(drive__nutation_angle=0.3, drive__rim__hub_angle=64.7 - float(away))
    assert build_level(farther.feasible, 8).rim.quality.min_scaled_jacobian > 0.3
    from trochoid.drives.precessional.rim import rim_shape
    from trochoid.geometry.sphere_mesh import mesh_sphere, sphere_quality
    from trochoid.geometry.sphere_outline import sector_outline

    finer = mesh_sphere(sector_outline(rim_shape(made.feasible), int(facets)))
    assert sphere_quality(finer).min_scaled_jacobian > 0.3


@pytest.mark.property
@pytest.mark.parametrize(
    ("effects", "nutation", "torque", "said"),
    [
        (("elastic_contact",), 0.05, 400.0, "yield by the height of the teeth"),
        (YIELDING, 1.0, 400.0, "bearings A and B let the satellite's axis lean"),
    ],
)
def test_overload(effects: tuple[str, ...], nutation: float, torque: float, said: str) -> None:
    """Teeth that jump: the cause is named; the torque and the nutation that are proposed are possible."""
    made = stages(effects, drive__nutation_angle=nutation)
    level = build_level(made.feasible, 8)
    tilt = None if made.teeth is None else made.teeth.tilt_stiffness
    with pytest.raises(NotConverged, match="more than the teeth hold") as fault:
        solved(made, level, torque, [0.1], tilt)
    assert said in str(fault.value)
    most, least = (
        float(re.findall(p, str(fault.value))[0]) for p in (r"about ([\d.]+) N", r"angle = ([\d.]+)")
    )
    held, slight = (solved(made, level, share * most, [0.1], tilt) for share in (0.99, 0.3))
    assert held.torsional_stiffness[0] < 0.6 * slight.torsional_stiffness[0]
    steeper = stages(effects, drive__nutation_angle=1.05 * least)
    assert solved(steeper, build_level(steeper.feasible, 8), torque, [0.1], tilt).total.any()


@pytest.mark.property
def test_an_axis_that_leans_is_warned_of() -> None:
    """Loads that lean the satellite's axis by more than a quarter of its nutation are doubtful; usual ones are not."""
    made, level = built()
    assert not list(doubts(solved(made, level, tilt=4e4)))
    assert any("axis leans by" in said for said in doubts(solved(made, level, 5.0 * TORQUE, tilt=4e4)))


@pytest.mark.property
@pytest.mark.parametrize("torque", [1.0, 1e-6])
def test_slight_torques_on_crowned_rollers(torque: float) -> None:
    """Slices shrink with the spots that they touch over: half as many facets agree, and Hertz's powers hold."""
    runs = []
    for facets in (12, 16):
        made = stages(ELASTIC, drive__rollers__crown=0.1, operation__output_torque=torque)
        runs.append(solved(made, build_level(made.feasible, facets), torque, [0.0]))
    coarse, fine = runs
    assert fine.residual.max() < 1e-9
    assert coarse.lag == pytest.approx(fine.lag, rel=0.03)
    assert coarse.pressure.max() == pytest.approx(fine.pressure.max(), rel=0.03)
    # spots are ellipses of Hertz at last: p ~ F^(1/3)
    heavy = stages(ELASTIC, drive__rollers__crown=0.1, operation__output_torque=8.0 * torque)
    other = solved(heavy, build_level(heavy.feasible, 16), 8.0 * torque, [0.0])
    force = other.total.max() / fine.total.max()
    assert other.pressure.max() / fine.pressure.max() == pytest.approx(math.cbrt(force), rel=0.03)


@pytest.mark.property
def test_pins_at_the_undercut_limit() -> None:
    """Just below the limit contacts are solved and said to be as wide as the flank is round; above it is refused."""
    limit = math.degrees(stages().feasible.tooth.undercut_angle)  # type: ignore[union-attr]
    runs = []
    for facets in (12, 20):
        made = stages(drive__teeth__pin_angle=0.9999 * limit)
        near = pitch_angles(made.feasible, 40)[22:27]  # rollers press where the flank is sharpest
        runs.append(solved(made, build_level(made.feasible, facets), crank=near))
    coarse, fine = runs
    assert fine.residual.max() < 1e-9
    assert coarse.lag == pytest.approx(fine.lag, rel=0.02)
    assert np.abs(coarse.total - fine.total).max() < 0.02 * fine.total.max()
    assert any("near undercut" in said for said in doubts(fine))
    assert not list(doubts(solved(*built())))
    with pytest.raises(Infeasible, match="the flank is undercut"):
        _ = stages(drive__teeth__pin_angle=1.0001 * limit).feasible


@pytest.mark.property
def test_one_roller_alone() -> None:
    """With much clearance and little torque one roller carries: force is torque over lever, its share is 1."""
    made = stages(("elastic_contact", "clearance"), drive__rollers__clearance=0.2)
    found = solved(made, build_level(made.feasible, 12), 0.1, [0.13])
    assert (found.total > 0.0).sum() == 1
    lever = float(found.tooth_moment[0] @ found.axis) / found.total.max()
    assert found.total.max() == pytest.approx(0.1 * abs(float(found.out @ found.axis)) / abs(lever), rel=1e-9)


@pytest.mark.property
def test_contact_at_the_tip_edge() -> None:
    """Cut crests: rollers beyond the edge press it, without a bound, and that is said; balances hold."""
    made = stages(drive__rim__tip_angle=66.0, ask__positions=4, ask__quantities=["contact_pressure_max"])
    outcome = Run(made.scene).outcome
    assert all(check.ok for check in outcome.checks)
    assert "no bound" in str(outcome.quantities["contact_pressure_max"].note)


@pytest.mark.exact
@pytest.mark.parametrize("pins_on", ["ring", "satellite"])
def test_misaligned_rollers_mirror(pins_on: str) -> None:
    """At input angle 0 all is its own mirror image: −T with skew −s, or tilt t, presses roller −i as T does i."""
    made, level = built(ELASTIC, 0.01, pins_on)

    def run(tilt: float, skew: float, torque: float) -> Series:
        leaning = stages(
            ELASTIC,
            drive__rollers__crown=0.01,
            drive__rollers__tilt=tilt,
            drive__rollers__skew=skew,
            drive__teeth__pins_on=pins_on,
        )
        return solved(leaning, level, torque, [0.0])

    plain = solved(made, level, TORQUE, [0.0])
    assert np.array_equal(run(0.0, 0.0, TORQUE).force, plain.force)
    for tilt, skew in ((0.05, 0.0), (0.0, 0.05), (0.03, -0.04)):
        one, other = run(tilt, skew, TORQUE), run(tilt, -skew, -TORQUE)
        mirrored = np.roll(other.force[:, ::-1], 1, axis=1)
        assert mirrored == pytest.approx(one.force, abs=2e-2 * one.force.max())  # triangles are not mirrored
        assert np.abs(one.force - plain.force).max() > 0.05 * plain.force.max()
        assert one.residual.max() < 1e-9


@pytest.mark.property
def test_skew_loads_one_end() -> None:
    """Skew brings the pressed spots of crowned rollers towards one end, by their crown's radius times the angle."""
    made, level = built(ELASTIC, 0.1)
    skewed = stages(ELASTIC, drive__rollers__crown=0.1, drive__rollers__skew=0.3)
    straight, found = solved(made, level, 10.0, [0.0]), solved(skewed, level, 10.0, [0.0])
    roller = int(np.argmax(found.total[0]))
    place = [float(run.force[0, roller] @ run.places / run.total[0, roller]) for run in (straight, found)]
    # the azimuth direction of the pins' member, in the crank's frame, against the normal into the roller
    axis = found.point[0, roller] + math.tan(math.radians(5.0)) * found.normal[0, roller]
    round_ = np.cross([0.0, 0.0, 1.0], axis)
    slope = math.radians(0.3) * float(found.normal[0, roller] @ round_) / np.linalg.norm(round_)
    radius = 7.5e-3**2 / (2.0 * 0.1e-3)
    assert place[1] - place[0] == pytest.approx(-slope * radius, rel=0.05)


@pytest.mark.exact
def test_inertia_of_the_satellite() -> None:
    """Its mean moment is that of the sources; a rigid hold takes all of it, a soft one lets teeth carry a share."""
    made = stages(YIELDING, drive__rollers__crown=0.01)
    moment = inertia_moment(made.design)
    drive, s, c = made.design.scene.drive.satellite, math.sin(math.radians(2.5)), math.cos(math.radians(2.5))
    mean, q = 0.5 * (drive.inertia[0] + drive.inertia[1]), 15 / 14
    size = made.design.speed**2 * s * (c * (mean - drive.inertia[2]) + q * drive.inertia[2])
    assert moment == pytest.approx([0.0, size, 0.0], rel=1e-9, abs=1e-9)  # −x3 of the shaft's frame is y here
    level, crank = build_level(made.feasible, 12), np.array([0.0, 0.1])
    for tilt, least, most in ((None, 0.0, 1e-3), (4e4, 0.01, 0.2)):
        alone, both = (solve_series(made.feasible, level, TORQUE, crank, tilt, m) for m in (None, moment))
        change = np.abs(both.total - alone.total).max() / alone.total.max()
        assert least <= change < most
        # teeth, joint, inertia and what holds the axis are in balance about O
        left = both.tooth_moment + both.load + moment - both.motion @ both.held
        assert np.abs(left).max() < 1e-8 * TORQUE
        assert spin_residual(both) < 1e-9

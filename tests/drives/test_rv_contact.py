"""The elastic RV drive: balances, closed forms of its linear parts, symmetries, models beside each other."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.drives.rv_cases import (
    NO_PLAY,
    TEETH,
    THREE_CRANKS,
    drive,
    level_of,
    part,
    scene,
    turn,
    whole,
    without,
)
from trochoid.clock import Clock
from trochoid.drives.rv.balance import crank_residual, disc_residual, power, power_residual, torque_residual
from trochoid.drives.rv.bodies import Level
from trochoid.drives.rv.breakdown import PARTS
from trochoid.drives.rv.contact import assembly, layout
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.ladder import ladder
from trochoid.drives.rv.mesh_stiffness import light, mean_stiffness, single_stiffness
from trochoid.drives.rv.reversal import first_stage_play
from trochoid.drives.rv.running import run, tooth_loss_factor
from trochoid.drives.rv.series import Series, solve_series, turn_angles
from trochoid.drives.rv.stages import Stages
from trochoid.drives.rv.supports import supports
from trochoid.kinematics.errors import NotConverged, SceneError
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_pair import mesh
from trochoid.kinematics.types import Array
from trochoid.run import Run, plan

BALANCE = 1e-9


@pytest.fixture(scope="module")
def example() -> tuple[Design, Series]:
    """The shipped drive on a coarse mesh, over a turn of its crankshafts."""
    made = drive()
    return made, turn(made, 24)


def balanced(made: Design, series: Series) -> None:
    """Fail unless every member is in balance and the powers close, at every position."""
    assert max(series.imbalance.max(), series.penetration.max()) <= BALANCE
    assert disc_residual(made, series) <= BALANCE
    assert crank_residual(made, series) <= BALANCE
    assert torque_residual(made, series) <= BALANCE
    assert power_residual(made, series) <= BALANCE


@pytest.mark.exact
@pytest.mark.parametrize(
    ("overrides", "effects"),
    [
        ((), without()),
        (THREE_CRANKS, without()),
        (("drive.cycloid.discs=1",), without()),
        (("drive.fixed=sun",), without("inertia")),
        (("drive.fixed=carrier",), without("clearance")),
        ((), without("bearing_compliance")),
        (("operation.output_torque=1",), without()),
    ],
)
def test_every_member_is_in_balance(overrides: tuple[str, ...], effects: tuple[str, ...]) -> None:
    """Discs, crankshafts, ring; and what sun and ring give is what the contacts store, at every position."""
    made = drive(*overrides, effects=effects)
    balanced(made, turn(made, 5))


@pytest.mark.exact
def test_sun_gives_the_torque_of_the_ratio_in_the_mean(example: tuple[Design, Series]) -> None:
    """Over a turn of the crankshafts nothing stays stored: the mean torque of the sun is T/i = 412/121 N·m."""
    made, series = example
    torque = series.mesh_force.sum(axis=1) * made.first.pair.first.base_radius
    assert torque.mean() == pytest.approx(412 / 121, rel=1e-3)
    assert np.ptp(torque) > 1e-3 * torque.mean()
    sun, ring, stored = power(made, series)
    assert sun + ring == pytest.approx(stored, rel=1e-9, abs=1e-9 * ring.max())
    assert np.abs(stored.mean()) < 1e-3 * ring.max()


@pytest.mark.exact
@settings(max_examples=12, deadline=None)
@given(
    angle=st.floats(-20, 20),
    cranks=st.sampled_from([2, 3]),
    fixed=st.sampled_from(["ring", "carrier", "sun"]),
)
def test_rigid_drive_without_play_touches_everywhere_and_runs_free(
    angle: float, cranks: int, fixed: str
) -> None:
    """At any angle all gaps are zero, and the motion of the ideal train closes none: the two stages fit together."""
    more = THREE_CRANKS if cranks == 3 else ()
    made = drive(*NO_PLAY, *more, f"drive.fixed={fixed}", effects=without("clearance"))
    motions = layout(made, TEETH)
    crank = made.crank_angle(np.array([angle]))
    free = np.zeros(len(motions.names))
    free[-1] = 1 / 40
    for i in range(2):
        x, y = made.eccentric(i, crank)[0]
        free += motions.disc(i)[0] * -y + motions.disc(i)[1] * x
        for j in range(cranks):
            free += motions.crank(j, i)[2]
    for family in assembly(made, motions, level_of(made).elastic, crank).families:
        state = family.pair.at(np.zeros((1, len(free))))
        assert np.abs(state.gap).max() < 1e-15
        assert np.abs(state.arms @ free).max() < 1e-15


@pytest.mark.exact
def test_linear_parts_have_their_closed_forms() -> None:
    """Cranks that turn together press the teeth by r_b each; stiff shafts rest on 2 k sideways, on Σ k z² tilted."""
    made = drive(effects=without("bearing_compliance"))
    both = np.ones(2)
    teeth = 2 * TEETH * made.first.pair.second.base_radius**2
    assert both @ supports(made, TEETH).total @ both == pytest.approx(
        teeth, rel=1e-12
    )  # the sun stays in the middle
    held = supports(drive("materials.steel.youngs_modulus=2.1e9"), 1e-3)
    aside = np.array([float(name in ("crank0.x0", "crank0.x1")) for name in held.names])
    tilt = np.array([{"crank0.y0": -0.005, "crank0.y1": 0.005}.get(name, 0.0) for name in held.names])
    for motion, stiff in ((aside, 2 * 250e6), (tilt, 2 * 250e6 * 0.016**2)):
        assert motion @ held.total @ motion == pytest.approx(stiff, rel=1e-3)
    assert np.linalg.eigvalsh(supports(drive(), TEETH).total).min() > 0


@pytest.mark.published
@pytest.mark.parametrize(
    ("teeth", "single", "ratio", "mean"),
    [
        ((20, 20), 11.487, 1.55684, 16.285),
        ((30, 30), 12.785, 1.65351, 19.051),
        ((17, 103), 13.247, 1.68527, 20.055),
        ((62, 62), 14.472, 1.78978, 23.044),
    ],
)
def test_stiffness_of_teeth_by_iso_6336(
    teeth: tuple[int, int], single: float, ratio: float, mean: float
) -> None:
    """ISO 6336-1, method B, x = 0, h_fP = 1.25: c' and c_γα in N/(mm·µm); a quarter of the fourth root when light."""
    pair = mesh(Gear(teeth[0], 1e-3), Gear(teeth[1], 1e-3))
    assert 1e-9 * single_stiffness(pair) == pytest.approx(single, abs=5e-4)
    assert 1e-9 * mean_stiffness(pair, ratio) == pytest.approx(mean, abs=5e-4)
    assert light(2e5) == 1.0
    assert light(1e5 / 16) == 0.5


@pytest.mark.exact
def test_parts_of_the_compliance_add_up(example: tuple[Design, Series]) -> None:
    """Shares of all parts at every position sum to the whole; only what moves with the load may be negative."""
    _, series = example
    assert series.parts.sum(axis=1) == pytest.approx(series.compliance, rel=1e-5)
    mean = dict(zip(PARTS, series.parts.mean(axis=0), strict=True))
    assert all(mean[name] > 0 for name in PARTS if name not in ("turning_levers", "wandering_contacts"))


@pytest.mark.exact
def test_tangent_is_the_slope_of_the_twist(example: tuple[Design, Series]) -> None:
    """Scenes of ±0.01 % of the torque, laws that depend on it among them: the compliance with contacts that wander
    along their surfaces is the difference to 3e-5; they are 3e-3 of it.
    """
    made, series = example
    angle = series.angle[:4]
    low, high = (
        solve_series(
            drive(f"operation.output_torque={412.0 * (1.0 + x)}"), "level0", level_of(made), angle
        ).twist
        for x in (-1e-4, 1e-4)
    )
    assert (high - low) / (2e-4 * made.ring_torque) == pytest.approx(series.compliance[:4], rel=3e-5)
    share = series.parts[:4, PARTS.index("wandering_contacts")] / series.compliance[:4]
    assert (np.abs(share) > 1e-3).any()


@pytest.mark.independent
def test_crank_bearings_yield_as_statics_say(example: tuple[Design, Series]) -> None:
    """N crankshafts at L on two springs k each twist by T/(2 N k L²); what the discs tilt them by comes on top."""
    made, series = example
    found = float(series.parts[:, PARTS.index("crank_bearings")].mean())
    least = 1 / (2 * 2 * 250e6 * made.first.arm**2)
    assert least < found < 1.1 * least


@pytest.mark.exact
def test_stiff_parts_drop_out(example: tuple[Design, Series]) -> None:
    """With crank bearings a thousand times stiffer their share goes to a thousandth, the others' hardly change."""
    _, series = example
    stiff = turn(drive('drive.crankshaft.bearing_stiffness="2.5e11 N/m"'), 6)
    k = PARTS.index("crank_bearings")
    assert stiff.parts[:, k].mean() < 2e-3 * series.parts[:, k].mean()
    rest, before = (np.delete(x.parts.mean(axis=0), k).sum() for x in (stiff, series))
    assert rest == pytest.approx(before, rel=0.05)


@pytest.mark.property
def test_which_member_stands_does_not_matter(example: tuple[Design, Series]) -> None:
    """Under equal torque on the ring the same twists are found, whoever drives; the output's follow by its leverage."""
    made, series = example
    for fixed, torque in (("carrier", 412 * 120 / 121), ("sun", 412.0)):
        other = drive(
            f"drive.fixed={fixed}", f"operation.output_torque={torque!r}", effects=without("inertia")
        )
        here = drive(effects=without("inertia"))
        assert other.ring_torque == pytest.approx(here.ring_torque, rel=1e-14)
        angle = series.angle[[1, 7]]
        one = solve_series(here, "level0", level_of(here), angle)
        two = solve_series(other, "level0", level_of(here), here.crank_angle(angle) / other.turning)
        assert two.twist == pytest.approx(one.twist, rel=1e-9)
    assert made.leverage == pytest.approx(121 / 120, rel=1e-15)


@pytest.mark.property
def test_the_drive_seen_from_its_other_end(example: tuple[Design, Series]) -> None:
    """Planets at the other side swap the discs: half a turn later all is as before, but for where rollers stand."""
    made, series = example
    other = drive("drive.crankshaft.planet_position=-26")
    half = series.angle[:3] + 0.5 * turn_angles(made, 1)[-1]
    found = solve_series(other, "level0", level_of(other), half)
    assert found.twist == pytest.approx(series.twist[:3], rel=3e-3)


@pytest.mark.property
def test_three_crankshafts_run_smoother_than_two(example: tuple[Design, Series]) -> None:
    """Two crankshafts in line make the drive softer twice a turn; three hold it alike in every direction."""
    _, two = example
    three = turn(drive(*THREE_CRANKS), 12)
    ripple: list[Array] = [np.ptp(series.twist) / series.twist.mean() for series in (two, three)]
    assert ripple[1] < 0.1 * ripple[0]
    assert three.compliance.mean() < two.compliance.mean()


@pytest.mark.independent
def test_strips_and_level_0_agree(example: tuple[Design, Series]) -> None:
    """Contacts here are Hertz's: forces, pressures and twist agree to 2e-3 with the pressure resolved."""
    made, one = example
    two = turn(made, 24, "strips")
    assert two.twist == pytest.approx(one.twist, rel=1e-4)
    assert two.ring.force.max() == pytest.approx(one.ring.force.max(), rel=2e-3)
    assert two.ring.pressure.max() == pytest.approx(one.ring.pressure.max(), rel=2e-3)


@pytest.mark.exact
def test_first_stage_play_at_the_output() -> None:
    """A play j on the pitch circle r of the sun is j/(r i) at the carrier, nothing without the effect."""
    assert first_stage_play(drive()) == pytest.approx(0.03e-3 / 9e-3 / 121, rel=1e-12)
    assert first_stage_play(drive("drive.fixed=carrier")) == pytest.approx(0.03e-3 / 9e-3 / 120, rel=1e-12)
    assert first_stage_play(drive(effects=without("clearance"))) == 0.0


@pytest.mark.independent
def test_loss_factor_of_teeth_is_its_integral() -> None:
    """H_v by quadrature over a base pitch: |sliding| of the pairs in contact, which share the force alike."""
    stage = drive().first
    pair, alpha = stage.pair, math.radians(20)
    pitch = math.pi * 1.5e-3 * math.cos(alpha)
    reach = [
        float(g.curvature_radius(tip)) - r * math.sin(alpha)
        for g, tip, r in zip((pair.first, pair.second), stage.tips, (9e-3, 27e-3), strict=True)
    ]
    x = -reach[1] + pitch * (np.arange(20000) + 0.5) / 20000
    pairs = np.stack([x + k * pitch for k in range(3)])
    inside = pairs < reach[0]
    mean = ((np.abs(pairs) * inside).sum(axis=0) / inside.sum(axis=0)).mean()
    expected = mean * (1 / pair.first.base_radius + 1 / pair.second.base_radius)
    assert tooth_loss_factor(stage) == pytest.approx(expected, rel=1e-3)


@pytest.mark.independent
@pytest.mark.parametrize("fixed", ["ring", "carrier", "sun"])
def test_little_friction_loses_what_normal_forces_say(fixed: str) -> None:
    """With μ → 0 the loss is Σ μ N |v| of the drive without friction; sun and ring give what is stored and lost."""
    made = drive(f"drive.fixed={fixed}", "effects.5.ring_pins=1e-4", "effects.5.teeth=0")
    found = run(made, "level0", level_of(made))
    assert found.residual <= BALANCE
    series = solve_series(made, "level0", level_of(made), found.angle)
    expected = np.zeros(len(found.angle))
    for i in range(2):
        at = series.ring.point[:, i]
        x, y = made.eccentric(i, series.crank).T[..., None]
        speed = np.stack(
            [-y + at[..., 1] / 40, x - at[..., 0] / 40], axis=-1
        )  # swing less the ring's turning
        along = np.abs(
            series.ring.normal[:, i, :, 0] * speed[..., 1] - series.ring.normal[:, i, :, 1] * speed[..., 0]
        )
        expected += 1e-4 * (series.ring.force[:, i] * along).sum(axis=1)
    assert found.pins.sum(axis=1) == pytest.approx(expected, rel=1e-3)
    assert found.teeth.max() == 0.0


@pytest.mark.property
def test_answers_of_a_whole_run() -> None:
    """Every quantity through the scene on a coarse mesh: finite, with errors, and the checks of the run hold."""
    made = whole()
    found = made.outcome
    assert all(check.ok for check in found.checks)
    assert len(found.checks) == 10
    efficiency = made.efficiency.value
    assert isinstance(efficiency, float)
    assert 0.9 < efficiency < 0.95
    power = 412 * 1815 * math.pi / 30 / 121
    assert part(made.power_loss, "total") == pytest.approx(power * (1 / efficiency - 1), rel=1e-9)
    assert all("ask.positions" in said for said in found.warnings)  # too few for a spectrum
    assert part(made.reactions, "crank_A_elastic", "max") > part(made.reactions, "crank_A_elastic", "min") > 0
    assert part(made.vibration_velocity, "flange", "worst") > 0.0
    assert made.vibration_zone.value == "none applies"  # 0.65 kW
    stiffness = made.torsional_stiffness.value
    assert isinstance(stiffness, float)
    assert (
        150 < stiffness < 180
    )  # above the catalogue's 108, which has carrier, main bearings and bolts in it
    assert 1e3 / part(made.stiffness_breakdown, "total", "compliance") == pytest.approx(stiffness, rel=1e-12)
    shares = [part(made.stiffness_breakdown, name, "share") for name in PARTS]
    assert sum(shares) == pytest.approx(100, rel=1e-5)
    assert part(made.load_sharing, "crankshaft_share_max_output") > 0.5
    lost = made.lost_motion
    total = part(lost, "cycloid_stage") + part(lost, "first_stage")
    assert part(lost, "mean") == pytest.approx(total, rel=1e-12)
    assert 100e-6 < part(made.mesh_stiffness, "mean") * 1e-6 < 170e-6
    assert found.drawing is not None
    assert found.drawing.frames[0].arrows
    assert found.dataset is not None
    assert math.isclose(float(found.dataset.input_angle[-1]), 2 * np.pi * 3.025)


@pytest.mark.property
def test_plan_names_the_stages_of_the_questions() -> None:
    """`check` tells what runs: a question about teeth needs no discs, and the models are told."""
    asked = plan(scene('ask.quantities=["mesh_stiffness"]'))
    assert {stage.name for stage in asked.stages if stage.needed} == {"kinematics", "geometry", "teeth"}
    assert plan(scene()).model == "level0, or strips where that is not within the tolerance"
    assert plan(scene(effects=())).model == "closed forms"
    assert sum(stage.seconds for stage in plan(scene()).stages if stage.needed) < 20


@pytest.mark.property
def test_ladder_climbs_from_the_levels_of_a_run() -> None:
    """`accuracy` compares both contact models on levels that double; a drive of rigid members has none."""
    found = ladder(scene(), Clock())
    assert found.levels == (12, 24, 48)
    assert [rung.name for rung in found.rungs] == ["level0", "strips"]
    assert "torsional_stiffness" in found.quantities
    assert "mesh_stiffness" not in found.quantities
    one = found.stages("level0", level_of(drive()), Clock())
    assert one.rung == "level0"
    with pytest.raises(SceneError, match='"elastic_contact" is not listed'):
        ladder(scene(effects=()), Clock())


@pytest.mark.property
def test_a_drive_that_locks_is_said_so() -> None:
    """Coefficients of 1: what runs without friction does not run, and the message says which they are."""
    rubbing = '{type="friction",ring_pins=1,teeth=1}'
    made = drive(f'effects=[{{type="elastic_contact"}},{rubbing}]', 'ask.quantities=["ratio"]')
    with pytest.raises(
        NotConverged, match=r"ring_pins = 1, teeth = 1; the drive may lock \(take .* up to 0\.3"
    ):
        run(made, "level0", level_of(made))


@pytest.mark.property
def test_level_0_is_taken_with_a_warning_where_strips_fail(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody knows then how wrong it is, and the reader hears why; a model that the scene names is not exchanged."""

    def fails(self: Stages, level: Level) -> float:
        raise NotConverged("strips do not cover that")

    monkeypatch.setattr(Stages, "model_error", fails)
    few = ("accuracy.facets_per_lobe=6", "ask.positions=1", 'ask.quantities=["torsional_stiffness"]')
    out = Run(scene(*few)).outcome
    assert any("level0 was taken" in said and "do not cover that" in said for said in out.warnings)
    assert not any(
        "level0 was taken" in said for said in Run(scene(*few, "accuracy.model=level0")).outcome.warnings
    )

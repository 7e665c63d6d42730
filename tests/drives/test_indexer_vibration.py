"""What an indexer puts on its casing, and how that vibrates: balances, limits, closed forms, units, elastic casings."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from tests.drives.indexer_cases import run_of
from trochoid.drives.indexer.casing_loads import MOST, Cycle, inertia_residual, lines_for, record, rigid_cycle
from trochoid.drives.indexer.stages import Stages
from trochoid.dynamics.vibration import Vibration
from trochoid.dynamics.wrench import balance_residual
from trochoid.faults import SceneFaults
from trochoid.kinematics.indexer import motion
from trochoid.results.outcome import Quantity
from trochoid.run import Run, plan

FREE = "relative_turning_time = 0.2902"
MOUNTS = [(x, -0.15, z) for x in (-0.1, 0.1) for z in (-0.1, 0.1)]
CASING = f"""
[casing]
mass = 20
inertia = [0.3, 0.4, 0.5]
center = [10, -20, 5]

{
    "".join(
        f'''[[casing.mounts]]
position = {[1e3 * each for each in place]}
stiffness = [2000, 3000, 2500]
damping = [300, 300, 300]

'''
        for place in MOUNTS
    )
}
[[casing.points]]
name = "cover"
position = [60, 80, -30]
"""
ELASTIC = (
    """
[drive.output_shaft]
inertia = 0.01
stiffness = 20000

[accuracy]
model = "rigid_wheel"
"""
    + CASING
)
ON = ("inertia", "casing_on_mounts")
BOX = (
    "casing.elastic=true",
    "casing.damping_ratio=0.01",
    "casing.mesh_edge=60",
    "casing.box={size=[360, 320, 300], wall=15}",
    'casing.bores=[{name="low", holds=["fixed wheel", "input shaft", "motor"], wall="low", radius=30, boss=50, '
    'length=20}, {name="high", holds=["output shaft", "lock"], wall="high", radius=30, boss=50, length=20}]',
    "casing.mounts=["
    + ", ".join(
        f'{{name="foot {i}", radius=15, position=[{x}, -160, {z}], stiffness=[2000, 3000, 2500], '
        "damping=[300, 300, 300]}"
        for i, (x, z) in enumerate([(x, z) for x in (-150, 150) for z in (-120, 120)])
    )
    + "]",
    'casing.points=[{name="cover", position=[0, 160, 0]}]',
)


@cache
def run(*overrides: str, effects: tuple[str, ...] = ON, tables: str = CASING, free: str = FREE) -> Run:
    asked = "" if "casing_on_mounts" not in effects else ', "vibration_velocity", "vibration_zone"'
    listed = "effects=[" + ", ".join(f'{{type="{name}"}}' for name in effects) + "]"
    return run_of(f"{free}\n{tables}", listed, f'ask.quantities=["reactions"{asked}]', *overrides)


def stages(made: Run) -> Stages:
    found = made.stages
    assert isinstance(found, Stages)
    return found


def elastic(*overrides: str) -> Run:
    quick = ("drive.wheel.inertia=0.02", 'operation.input_speed="40 rad/s"')  # few steps in a march
    return run(*quick, *overrides, effects=("elastic_contact", *ON), tables=ELASTIC)


def apart(one: Vibration, other: Vibration) -> float:
    return float(np.abs(one.velocity - other.velocity).max() / np.abs(other.velocity).max())


@pytest.mark.exact
@pytest.mark.parametrize("free", [FREE, "pin_ratio = 1.0"])
def test_loads_sum_to_inertia_and_friction(free: str) -> None:
    """All bearings, the fixed wheel and the motor: −dL/dt of the wheel less friction; 1 % of inertia more is seen."""
    found = stages(run(free=free))
    for name, forces in found.forces.items():
        cycle = rigid_cycle(forces)
        assert inertia_residual(forces, cycle) <= 1e-12, name
        heavier = replace(forces, load=replace(forces.load, inertia=1.01 * forces.load.inertia))
        assert inertia_residual(heavier, cycle) > 1e-4, name
    whole = found.casing_loads.fine.cycles["rigid"].records(40)
    assert set(whole) == {"fixed wheel", "input shaft", "motor", "output shaft", "lock"}
    assert not whole["lock"].moment.any()


@pytest.mark.exact
def test_lines_are_those_of_the_course() -> None:
    """A pulse and a ramp with a jump: lines by hand; averages of cells fold back 1/(4·16²) of the top line."""
    time, period = np.array([0.0, 0.3, 0.3, 0.7, 0.7, 1.0]), 1.0
    pulse = np.array([0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
    ramp = np.array([0.0, 0.3, 0.3, 0.7, 0.7, 1.0])
    lines = 50
    found = np.fft.rfft(record(time, np.stack([pulse, ramp], axis=1), period, lines), axis=0) / (
        2 * lines + 1
    )
    h = np.arange(1, lines + 1)
    ends = np.exp(-2j * math.pi * np.outer(h, [0.3, 0.7]))
    wanted = np.stack([(ends[:, 0] - ends[:, 1]) / (2j * math.pi * h), 1j / (2.0 * math.pi * h)], axis=1)
    assert np.abs(found[1:] - wanted).max(axis=0) * h[-1] == pytest.approx(0.0, abs=1e-3)
    assert found[0].real == pytest.approx([0.4, 0.5], abs=1e-12)


@pytest.mark.independent
def test_free_casing_swings_by_the_wheels_torque() -> None:
    """Forces cancel, the torque J ε + M_f about the wheel's axis x is left: v = ω × r, ω_h = T_h/(i Ω I), by hand."""
    none = [f"casing.mounts.{i}.{key}=[0,0,0]" for i in range(4) for key in ("stiffness", "damping")]
    found = stages(run(*none))
    forces, got = found.forces["indexer"], found.vibration.fine.elastic
    count = 1 << 18
    t = 2.0 * math.pi * (np.arange(count) + 0.5) / count
    t -= forces.indexer.half_turn
    load = forces.load
    torque = load.inertia * load.speed**2 * motion(forces.indexer, t).acceleration
    torque += forces.indexer.sense * load.friction
    torque[np.abs(t) > forces.indexer.half_turn] = 0.0
    lines = np.fft.rfft(torque)[1 : len(got.frequencies) + 1] * 2.0 / count
    spin = np.abs(lines) / (2.0 * math.pi * got.frequencies * 0.3)
    arm = math.hypot(0.100, 0.035)  # of the point from the centre of mass, across x
    speed = np.linalg.norm(got.velocity[0], axis=0)
    assert np.abs(got.velocity[0, 0]).max() <= 1e-9 * speed.max()
    assert speed == pytest.approx(spin * arm, abs=2e-4 * speed.max(), rel=5e-3)


@pytest.mark.independent
def test_elastic_loads_are_the_wheels_momentum() -> None:
    """∫ of all on the casing about the axis over the index: −(J Δω + what the shaft takes), both from the march."""
    x = stages(elastic()).shaken["indexer"]
    cycle, course, output = stages(elastic()).casing_loads.fine.cycles["elastic"], x.fine.index, x.output
    n = len(course.time)
    about = sum(each[:n, 3:] for each in cycle.places.values()) @ cycle.axis
    shaft = output.shaft * course.twist + output.damping * output.shaft * course.twist_rate
    spin = output.inertia * (course.base - course.rate)
    taken = float(spin[-1] - spin[0] + np.trapezoid(shaft, course.time))
    sense = x.pair.forces.indexer.sense
    assert sense * float(np.trapezoid(about, course.time)) == pytest.approx(
        taken, abs=1e-5 * np.abs(spin).max()
    )


@pytest.mark.property
def test_stiff_drive_is_the_rigid_one() -> None:
    """Without play, shaft or friction (which sticks against the lock): E × 1, 30 and 900 tend to the rigid drive."""
    off = []
    for factor in (1, 30, 900):
        found = stages(
            run(
                f"materials.steel.youngs_modulus={210e3 * factor}",
                "operation.damping_ratio=0.5",
                "operation.output_torque=0",
                'operation.input_speed="60 rad/s"',
                "drive.wheel.inertia=0.01",
                effects=("elastic_contact", *ON),
                tables='[accuracy]\nmodel = "rigid_wheel"\n' + CASING,
            )
        ).vibration.fine
        off.append(apart(found.elastic, found.rigid))
    assert off[0] > off[1] > off[2]
    assert off[2] < 0.01


@pytest.mark.property
def test_stiff_mounts_hold_the_casing() -> None:
    """Mounts × 1e4 and × 1e5: a tenth of the velocity, and far less than on mounts as they are."""
    size = []
    for factor in (1.0, 1e4, 1e5):
        stiff = [
            f"casing.mounts.{i}.stiffness=[{2e3 * factor},{3e3 * factor},{2.5e3 * factor}]" for i in range(4)
        ]
        size.append(stages(run(*stiff)).vibration.fine.elastic.rms_max)
    assert size[1] < 0.02 * size[0]
    assert size[2] == pytest.approx(0.1 * size[1], rel=1e-2)


@pytest.mark.property
def test_units_do_not_matter() -> None:
    """The same scene in inches, metres, grams and turns a minute."""
    inch = 25.4
    other = elastic(
        'operation.input_speed="381.9718634205488 rpm"',
        f'drive.sphere_radius="{100 / inch!r} in"',
        'casing.center=["1 cm", "-0.02 m", "5000 um"]',
        'casing.mass="20000 g"',
        f'casing.points.0.position=["{60 / inch!r} in", "8 cm", -30]',
    )
    one, two = (stages(x).vibration.fine for x in (elastic(), other))
    assert set(one.others) == set(two.others) == {"rigid", "without_inertia", "geneva_wheel", "free_casing"}
    assert apart(two.elastic, one.elastic) <= 1e-7  # friction sticks and slips at instants found by iteration
    for name in one.others:
        assert apart(two.others[name], one.others[name]) <= 1e-7, name


@pytest.mark.property
def test_without_the_effect_all_else_is_as_before() -> None:
    """Reactions are equal to the bit, no stage shakes a casing, and the question is a fault that names the effect."""
    off, on = (run(effects=effects) for effects in (("inertia",), ON))
    assert off.reactions == on.reactions
    assert "vibration" not in stages(off).clock.seconds
    assert not {"vibration", "casing"} & {stage.name for stage in plan(off.scene).stages if stage.needed}
    assert {"vibration", "forces"} <= {stage.name for stage in plan(on.scene).stages if stage.needed}
    assert "march" not in {stage.name for stage in plan(on.scene).stages if stage.needed}
    with pytest.raises(SceneFaults, match="casing_on_mounts"):
        run('ask.quantities=["vibration_velocity"]', effects=("inertia",))


@pytest.mark.property
def test_answers_and_outcome() -> None:
    """Each point by direction, the worst without each effect, errors of the march, spectra, checks that hold."""
    made = elastic()
    parts = made.vibration_velocity.parts
    assert parts is not None
    cover = parts["cover"]
    assert not isinstance(cover, Quantity)
    assert set(cover) == {
        *"xyz", "worst", "worst_rigid", "worst_without_inertia", "worst_geneva_wheel", "worst_free_casing"
    }  # fmt: skip
    worst = cover["worst"]
    assert isinstance(worst, Quantity)
    assert isinstance(worst.value, float)
    assert worst.error is not None
    assert 0.0 < worst.error < 0.01 * worst.value
    assert made.vibration_zone.value == "none applies"
    outcome = made.outcome
    assert outcome.dataset is not None
    assert outcome.dataset["vibration_compared_1"].dims == ("frequency", "variant")
    assert float(outcome.dataset["frequency"][-1]) >= 1000.0
    said = {check.name: check for check in outcome.checks}
    assert said["loads on the casing sum to the torque on the wheel, by every model"].value <= 1e-12
    assert all(check.ok for check in outcome.checks)
    assert {stage.name for stage in outcome.stages} >= {"march", "vibration"}


@pytest.mark.property
def test_slow_drive_says_how_far_its_harmonics_reach() -> None:
    """At 3 rpm the band has 20000 harmonics, 4096 are taken: a warning names both frequencies and the speed."""
    made = run('operation.input_speed="3 rpm"')
    assert lines_for(0.05) == MOST
    assert stages(made).vibration.fine.elastic.resolved_to == pytest.approx(MOST * 0.05)
    said = [x for x in made.outcome.warnings if "harmonics of the arm's speed" in x]
    assert len(said) == 1
    assert "204.8 Hz of 1000 Hz" in said[0]
    assert "input_speed = 14.7 rpm" in said[0]
    assert lines_for(2.0) == 500
    fast = stages(run()).vibration.fine.elastic
    assert fast.resolved_to >= 1000.0
    assert not fast.warnings


@pytest.mark.property
def test_elastic_casing_holds_all_places() -> None:
    """In a box of steel × 1e6 the casing moves as a rigid one, two bores share the arm's shaft; loads balance."""
    shared = [*BOX]
    shared[4] = shared[4].replace('"output shaft", "lock"', '"output shaft", "lock", "input shaft"')
    found = stages(run("materials.steel.youngs_modulus=2.1e11", *shared, tables=_bare(CASING))).vibration.fine
    assert found.residual <= 1e-12
    assert apart(found.elastic, found.others["rigid_casing"]) < 1e-4


@pytest.mark.property
def test_place_that_no_bore_holds_is_a_fault() -> None:
    """The lock is left out: the scene says so before anything is meshed."""
    open_ = [*BOX]
    open_[4] = open_[4].replace('"output shaft", "lock"', '"output shaft"')
    with pytest.raises(SceneFaults, match='no bore holds "lock"'):
        run(*open_, tables=_bare(CASING))


def _bare(text: str) -> str:
    """Return a casing's table without what only a rigid one has."""
    kept = [x for x in text.splitlines() if x.split(" = ")[0] not in ("mass", "inertia", "center")]
    return "\n".join(kept) + "\n"


@pytest.mark.property
def test_cycles_end_where_they_began() -> None:
    """Instants run from 0 to a turn of the arm and never back, of every model."""
    for name, cycle in stages(elastic()).casing_loads.fine.cycles.items():
        assert isinstance(cycle, Cycle)
        assert cycle.time[0] == 0.0, name
        assert cycle.time[-1] == pytest.approx(cycle.period, rel=1e-15), name
        assert (np.diff(cycle.time) >= -1e-15).all(), name
        assert balance_residual(list(cycle.records(60).values())) > 0.0, name

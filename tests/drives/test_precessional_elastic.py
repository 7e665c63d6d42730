"""Precessional drives on joints that yield: rigid limit, balances, bearings, natural frequencies, absent effects."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.drives.precessional_cases import DEGREES, REFERENCE, SPEED, drives
from trochoid.clock import Clock
from trochoid.drives.precessional.bearings import ACROSS, TILTS, Joint, Joints, _joint
from trochoid.drives.precessional.casing import casing_load, closed_record
from trochoid.drives.precessional.elastic import Elastic, respond
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.members import bodies
from trochoid.drives.precessional.modes import critical_speeds, reduce
from trochoid.drives.precessional.reactions import reactions
from trochoid.drives.precessional.stages import Stages
from trochoid.drives.precessional.turn import elastic_residual, turns
from trochoid.fem.rolling import stiffness
from trochoid.fem.rolling_assumed import assumed_ball_bearing
from trochoid.kinematics.errors import Infeasible, NotConverged
from trochoid.run import Run
from trochoid.scene import Override, load
from trochoid.scene.drive_precessional import Bearing, Support

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "precessional.toml")
DRIVE = replace(REFERENCE, mesh_radius=0.0675)
NAMES = ("joint_a", "joint_o", "support", "support_moment", "mesh", "mesh_couple", "torque")
EFFECTS = ("bearing_compliance", "inertia", "casing_on_mounts")
RIGID = Joints(
    Joint("A", np.zeros((6, 6)), (0, 1, 2)),
    Joint("B", np.zeros((6, 6)), (0, 1, 2, 3, 4)),
    Joint("O", np.zeros((6, 6)), (0, 1)),
    None,
)


def springs(a: float, b: float, tilt: float, o: float, c: float) -> Joints:
    """Return joints of springs alone, N/m and N·m/rad."""
    return Joints(
        Joint("A", np.diag([a, a, a, 0.0, 0.0, 0.0]), ()),
        Joint("B", np.diag([b, b, b, tilt, tilt, 0.0]), ()),
        Joint("O", np.diag([o, o, 0.0, 0.0, 0.0, 0.0]), ()),
        Joint("C", np.diag([c, c, 0.0, 0.0, 0.0, 0.0]), (2, 3, 4, 5)),
    )


def moved(drive: PrecessionalDrive, held: Joints, damping: float = 0.02) -> Elastic:
    """Return the elastic motion of a drive whose shaft is a solid cylinder, half a metre long so that it can exist."""
    mass = drive.shaft.mass
    shape = (0.5 * drive.support, mass, 0.5 * mass)
    return respond(drive, bodies(drive, SPEED, shape, held, 1.5), SPEED, damping)


def off(elastic: Elastic, drive: PrecessionalDrive) -> float:
    """Return the largest difference of elastic and rigid reactions over the largest rigid one of their kind."""
    found, rigid = elastic.reactions(DEGREES), reactions(drive, DEGREES, SPEED)
    forces = max(float(np.abs(getattr(rigid, name)).max()) for name in ("joint_a", "joint_o", "support"))
    moments = max(float(np.abs(rigid.support_moment).max()), forces * drive.joint)
    size = {
        name: moments if name in ("support_moment", "mesh_couple", "torque") else forces for name in NAMES
    }
    return max(
        float(np.abs(getattr(found, name) - getattr(rigid, name)).max()) / size[name] for name in NAMES
    )


def can_yield(drive: PrecessionalDrive) -> bool:
    """Say whether satellite and shaft have inertia about their own centres."""
    try:
        moved(drive, RIGID)
    except Infeasible:
        return False
    return True


@pytest.mark.property
@given(drive=drives())
@settings(max_examples=25, deadline=None)
def test_rigid_joints_give_the_rigid_reactions(drive: PrecessionalDrive) -> None:
    """Nothing moves: joints, teeth and motor balance d'Alembert's loads as the closed forms do, for any drive."""
    assume(can_yield(drive))
    assert off(moved(drive, RIGID), drive) < 1e-9


@pytest.mark.property
@given(drive=drives(), which=st.sampled_from(["all", "A", "B", "O"]))
@settings(max_examples=25, deadline=None)
def test_stiff_joints_give_the_rigid_reactions(drive: PrecessionalDrive, which: str) -> None:
    """All springs 1e19 N/m, or those of one joint among rigid ones: rigid reactions within 1e-6, for any drive.

    Where the instantaneous axis is near the satellite's own, teeth hardly hold it, and a spring counts for little:
    there a hundred times the stiffness must come fifty times nearer.
    """
    assume(can_yield(drive))

    def away(k: float) -> float:
        soft = springs(k, k, k, k, k)
        one = {"A": replace(RIGID, a=soft.a), "B": replace(RIGID, b=soft.b), "O": replace(RIGID, o=soft.o)}
        return off(moved(drive, one.get(which, soft)), drive)

    found = away(1e19)
    assert found < 1e-6 or away(1e21) < 0.02 * found


@pytest.mark.property
def test_motion_that_does_not_last_is_refused() -> None:
    """Past a critical speed of its soft joints the members run away: no reaction, no frequency is told."""
    overrides = ('ask.quantities=["natural_frequencies"]', "operation.input_speed=24000")
    with pytest.raises(NotConverged, match="do not stay on any steady motion"):
        Run(load(EXAMPLE, overrides)).natural_frequencies  # noqa: B018
    assert Run(load(EXAMPLE, overrides[:1])).natural_frequencies.parts


@pytest.mark.property
def test_change_falls_with_the_stiffness() -> None:
    """The difference to the rigid reactions goes with 1/K."""
    found = [off(moved(DRIVE, springs(k, k, 1e-3 * k, k, k)), DRIVE) for k in (1e9, 1e10, 1e11)]
    assert found[0] / found[1] == pytest.approx(10.0, rel=0.02)
    assert found[1] / found[2] == pytest.approx(10.0, rel=2e-3)


@pytest.mark.exact
def test_shaft_on_its_bearing_alone() -> None:
    """Only B yields across z, without dampers of weight: the eccentric shaft is the rotor of Laval, 1/(1 − Ω² m/k).

    The satellite hardly weighs anything; its mass alone counts, which its rigid joints leave where it is.
    """
    light = replace(
        DRIVE,
        satellite=replace(DRIVE.satellite, mass=1e-9, inertia=(5.3e-12, 5.1e-12, 3.6e-12)),
        counterweight=replace(DRIVE.counterweight, mass=1e-12),
    )
    k, mass, tilts = 2e5, light.shaft.mass, (2, 3, 4)
    # the pivot A may move along with the shaft where O does not hold it
    held = replace(
        RIGID, b=Joint("B", np.diag([k, k, 0, 0, 0, 0.0]), tilts), o=springs(1, 1, 1, 1e-3, 1).o, c=None
    )
    rigid = reactions(light, 0.0, SPEED).support[0]
    found = moved(light, held, 1e-9).reactions(0.0).support[0]
    assert found[1] / rigid[1] == pytest.approx(1.0 / (1.0 - SPEED**2 * mass / k), rel=1e-6)
    assert abs(found[0]) < 1e-6 * abs(found[1])


@pytest.mark.exact
@pytest.mark.parametrize("stiff", [3e5, 3e6, 3e8])
def test_balances_close(stiff: float) -> None:
    """Load on the casing = inertia of all members on their yielding paths; work on the motion = loss in the dampers."""
    found = moved(DRIVE, springs(stiff, 2 * stiff, 1e-3 * stiff, 0.5 * stiff, stiff), 0.05)
    turn = turns(DRIVE, SPEED, found)["elastic"]
    assert elastic_residual(turn, found) < 1e-11
    assert found.unbalanced < 1e-12
    assert found.loss > 0.0
    assert found.power == pytest.approx(found.loss, rel=1e-9)


@pytest.mark.property
def test_resonance_is_where_the_critical_speeds_say() -> None:
    """Little damping: R_A of the mean load grows by orders next to a critical speed, not between two."""
    held = springs(1e7, 1e7, 1e4, 1e7, 1e7)
    shape = (0.0725, 5e-4, 2e-4)
    lowest = critical_speeds(reduce(bodies(DRIVE, SPEED, shape, held, 1.5), SPEED), 0.0)
    assert len(lowest) >= 4

    def mean_change(speed: float) -> float:
        found = respond(DRIVE, bodies(DRIVE, speed, shape, held, 1.5), speed, 1e-4)
        rigid = reactions(DRIVE, DRIVE.reaction_period * np.arange(8) / 8, speed).joint_a.mean(axis=0)
        return float(np.linalg.norm(found.forces["A"][0, :3].real - rigid) / np.linalg.norm(rigid))

    near = max(mean_change(speed * (1.0 + 1e-6)) for speed in lowest[:2])
    assert near > 100.0 * mean_change(0.7 * lowest[0])


def scene(**values: Any) -> Any:
    """Return the example with values replaced; double underscores stand for dots."""
    return load(EXAMPLE, [Override(tuple(key.split("__")), value, key) for key, value in values.items()])


def without(name: str) -> list[dict[str, str]]:
    """Return all effects but one."""
    return [{"type": effect} for effect in EFFECTS if effect != name]


def leaves(quantity: Any, key: str = "") -> dict[str, Any]:
    """Return all values of a quantity by their path."""
    parts = quantity.parts if hasattr(quantity, "parts") else quantity
    if parts is None:
        return {key: quantity.value}
    return {name: v for part in parts for name, v in leaves(parts[part], f"{key}/{part}").items()}


@pytest.mark.property
def test_absent_effect_leaves_all_bits() -> None:
    """Without the effect the tables of bearings change nothing, no stage of theirs runs, and nothing is elastic."""
    asked = ["reactions", "balance", "vibration_velocity", "vibration_zone", "mass"]
    values: dict[str, Any] = {"effects": without("bearing_compliance"), "ask__quantities": asked}
    without_tables = dict.fromkeys(("bearing_a", "bearing_b", "joint_o"))
    plain = Run(scene(**values))
    whole, none = Run(scene()), plain.outcome
    assert "elastic" not in {stage.name for stage in none.stages}
    for name in ("balance", "mass"):
        assert leaves(none.quantities[name]) == leaves(whole.quantity(name))
    found, base = leaves(whole.reactions), leaves(none.quantities["reactions"])
    assert base == {key: found[key] for key in found if "elastic" not in key and "change" not in key}
    moving, still = leaves(whole.vibration_velocity), leaves(none.quantities["vibration_velocity"])
    assert moving["/lever/worst_rigid"] == still["/lever/worst"]
    assert moving["/lever/worst_printed"] == still["/lever/worst_printed"]
    assert moving["/lever/worst"] != still["/lever/worst"]
    drive = plain.scene.drive.model_copy(update=without_tables)
    bare = Stages(plain.scene.model_copy(update={"drive": drive}), Clock())
    for model, turn in bare.reactions.items():
        np.testing.assert_array_equal(turn.load.moment, plain.stages.reactions[model].load.moment)


@pytest.mark.property
def test_elastic_models_stand_beside_the_others() -> None:
    """Series, harmonics and load on the casing by all three models; a note says which reaction changes most."""
    run = Run(scene(ask__quantities=["reactions", "vibration_velocity"], ask__positions=24))
    data = run.outcome.dataset
    assert data is not None
    for model in ("rigid", "printed", "elastic"):
        assert {f"reaction_{model}", f"reaction_lines_{model}", f"casing_moment_{model}"} <= set(data)
        assert f"vibration_velocity_{model}" in data
    assert data["vibration_velocity_elastic"].attrs["figure"]
    assert "Most changed is R_B" in run.outcome.notes["Elastic reactions"]
    assert all(check.ok for check in run.outcome.checks)
    off_b = np.linalg.norm(
        (data["reaction_elastic_components"] - data["reaction_rigid_components"]).sel(reaction="R_B"), axis=1
    )
    assert off_b.max() == pytest.approx(leaves(run.reactions)["/change/R_B"], rel=1e-3)


@pytest.mark.exact
def test_counterweight_no_longer_balances_a_drive_that_yields() -> None:
    """Static balance holds for rigid joints; on springs the sum of the forces is the inertia of the motion."""
    found = moved(DRIVE, springs(1e7, 1e7, 1e4, 1e7, 1e7))
    crank = closed_record(DRIVE)
    load_, still = casing_load(found.reactions(crank)), casing_load(reactions(DRIVE, crank, SPEED))
    size = float(np.abs(found.reactions(crank).joint_a).max())
    assert np.abs(still.force).max() < 1e-12 * size
    assert np.abs(load_.force).max() > 1e-2 * size


def table(kind: Any, **values: Any) -> Support:
    """Return a bearing table, sizes in mm."""
    return Support(kind=kind, bore=30, outside=55, width=13, **values)


@pytest.mark.exact
def test_two_bearings_resist_tilting_by_their_distance() -> None:
    """Without a moment: twice the radial stiffness under half the load, and k d²/2 more against tilting."""
    force, none, spread = np.array([0.0, -1500.0]), np.zeros(2), 60e-3
    single = _joint("B", table("deep_groove"), 0.5 * force, none, tilts=True).stiffness
    pair = _joint("B", table("deep_groove", spread=60), force, none, tilts=True).stiffness
    assert pair[ACROSS[0], ACROSS[0]] == pytest.approx(2.0 * single[0, 0], rel=1e-9)
    for tilt, push in zip(TILTS, (1, 0), strict=True):
        wanted = 2.0 * single[tilt, tilt] + 0.5 * spread**2 * single[push, push]
        assert pair[tilt, tilt] == pytest.approx(wanted, rel=1e-9)
    np.testing.assert_allclose(pair, pair.T, atol=1e-6 * np.abs(pair).max())


@pytest.mark.exact
def test_bearing_is_that_of_the_library() -> None:
    """Stiffness is the derivative of the load: a secant between two loads lies between their tangents."""
    bearing = assumed_ball_bearing(30e-3, 55e-3, 13e-3)
    at = np.array([0.0, 8e-6, 0.0, 0.0, 0.0])
    force = bearing.respond(at, 0.0).load[1]
    table_ = Bearing(kind="deep_groove", bore=30, outside=55, width=13, radial_load=force)
    found = _joint("A", table_, np.array([0.0, 1.0]), np.zeros(2), tilts=False)
    assert found.stiffness[1, 1] == pytest.approx(
        stiffness(bearing, at)[1, 1], rel=0.05
    )  # a mean over the balls' places
    assert found.rigid == (2,)
    assert not found.stiffness[3:].any()


@pytest.mark.property
def test_bearing_that_resists_nothing_is_refused() -> None:
    """No load and no preload: nothing carries; a load, a press fit or stiffnesses help."""
    none = np.zeros(2)
    with pytest.raises(Infeasible, match="bearing B resists nothing in one of its directions"):
        _joint("B", table("deep_groove", clearance=0.01), none, none, tilts=True)
    for help_ in ({"radial_load": 500.0}, {"clearance": -0.005}):
        assert _joint("B", table("deep_groove", **help_), none, none, tilts=True).yields


@pytest.mark.exact
def test_casing_alone_has_its_own_frequencies() -> None:
    """On rigid joints and with hardly any mass inside, the modes are those of the casing on its mounts."""
    light = {
        "drive__satellite__mass": 1e-4,
        "drive__satellite__inertia": [5.3e-7, 5.1e-7, 3.6e-7],
        "drive__input_shaft__mass": 1e-4,
        "drive__input_shaft__offset": 0,
        "drive__input_shaft__product_of_inertia": 0,
        "drive__counterweight__mass": 1e-6,
        "drive__bearing_a__clearance": -0.005,
        "drive__bearing_b__clearance": -0.005,
    }
    run = Run(scene(**light))
    lowest = [mode.frequency for mode in run.stages.modes.modes[:6]]
    wanted = run.stages.vibration.rigid.natural_frequencies
    np.testing.assert_allclose(lowest, wanted, rtol=1e-4)


@pytest.mark.property
def test_natural_frequencies_say_who_moves() -> None:
    """Named by the motions with most energy; forward ones lie above backward ones; a Campbell diagram is drawn."""
    run = Run(scene(ask__quantities=["natural_frequencies"], effects=without("casing_on_mounts")))
    outcome = run.outcome
    values = leaves(run.natural_frequencies)
    assert [plot.title for plot in outcome.plots][-1] == "Campbell diagram"
    assert {"vibration", "reactions"} <= set(outcome.not_needed)
    words = {mode.words: mode.frequency for mode in run.stages.modes.modes}
    tilting = {said.split("; ")[1]: f for said, f in words.items() if said.startswith("input shaft tilting")}
    assert tilting["forward"] != tilting["backward"]
    assert math.isfinite(values["/mode_1"])
    assert values["/critical_speeds_of_the_input_speed/speed_1"] > 1430.0


@pytest.mark.property
def test_stiffer_drive_vibrates_as_the_rigid_one() -> None:
    """Stiffnesses of the scene a million times larger: velocity and zone of the rigid model within 1e-6."""
    values: dict[str, Any] = {}
    for name in ("bearing_a", "bearing_b"):
        values |= {f"drive__{name}__radial_stiffness": "1e17 N/m"}
    values |= {
        "drive__bearing_b__tilt_stiffness": "1e14 N*m/rad",
        "drive__joint_o__radial_stiffness": "1e17 N/m",
    }
    found = leaves(Run(scene(**values)).vibration_velocity)
    assert found["/lever/worst"] == pytest.approx(found["/lever/worst_rigid"], rel=1e-6)

"""Elastic sphere teeth of a precessional drive, from the scene: balances, symmetry of the cycle, limits."""

from __future__ import annotations

import math
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from trochoid.clock import Clock
from trochoid.drives.precessional.contact import Series, pitch_angles, solve_series
from trochoid.drives.precessional.dataset_contact import passage
from trochoid.drives.precessional.stages import Stages
from trochoid.drives.precessional.teeth import Level, build_level
from trochoid.drives.precessional.tooth_loads import power_residual, spin_residual, tooth_loads
from trochoid.kinematics.errors import Infeasible, SceneError
from trochoid.run import Run
from trochoid.scene import Override, load

EXAMPLE = Path(__file__).parents[2] / "examples" / "precessional.toml"
POSITIONS, TORQUE, COARSE = 12, 100.0, 12
ELASTIC = ("elastic_contact", "pin_compliance", "clearance")


def stages(effects: tuple[str, ...] = ("elastic_contact",), **values: Any) -> Stages:
    """The example with some effects; double underscores stand for dots."""
    ask = {
        "effects": [{"type": name} for name in effects],
        "ask__quantities": ["ratio"],
        "drive__rollers__crown": 0.0,
    }
    mesh = {"accuracy__facets_per_lobe": COARSE} if "elastic_contact" in effects else {}
    given = {"ask__positions": POSITIONS} | mesh | ask | values
    overrides = [Override(tuple(name.split("__")), value, name) for name, value in given.items()]
    return Stages(load(EXAMPLE, overrides), Clock())


@lru_cache(maxsize=8)
def built(
    effects: tuple[str, ...] = ("elastic_contact",), crown: float = 0.0, pins_on: str = "ring"
) -> tuple[Stages, Level]:
    """A coarse rim and its rollers, crown in mm."""
    made = stages(effects, drive__rollers__crown=crown, drive__teeth__pins_on=pins_on)
    return made, build_level(made.feasible, COARSE)


def solved(
    made: Stages, level: Level, torque: float = TORQUE, crank: Any = None, tilt: float | None = None
) -> Series:
    """Positions over a pitch."""
    at = pitch_angles(made.feasible, POSITIONS) if crank is None else np.asarray(crank)
    return solve_series(made.feasible, level, torque, at, tilt)


@pytest.mark.property
@pytest.mark.parametrize("pins_on", ["ring", "satellite"])
@pytest.mark.parametrize("tilt", [None, 4e4])
def test_balance_of_torque_and_power(pins_on: str, tilt: float | None) -> None:
    """Contacts as forces at points hold the satellite's axis and its power; the bearing A holds it across its axis."""
    made, level = built(pins_on=pins_on)
    found = solved(made, level, tilt=tilt)
    loads = tooth_loads(made.feasible, found)
    assert spin_residual(found) < 1e-9
    assert power_residual(made.feasible, found, loads) < 1e-9
    assert found.residual.max() < 1e-8
    ratio = abs(float(made.feasible.nutation.ratio))
    assert loads.motor == pytest.approx(TORQUE / ratio, rel=1e-3)  # rigid teeth: exactly
    assert np.abs(loads.joint_o[:, 2]).max() < 1e-9 * np.abs(loads.joint_a).max()  # O gives way along z
    arm = made.design.mechanism.joint
    moment = found.tooth_moment + found.load + np.cross(arm * found.axis, loads.joint_a)
    assert np.abs(moment).max() < 1e-9 * TORQUE
    held = -found.motion @ found.held  # what springs of the axis' hold say of the same moment
    assert np.cross(arm * found.axis, loads.joint_a) == pytest.approx(held, abs=1e-8 * TORQUE)


@pytest.mark.property
@pytest.mark.parametrize("pins_on", ["ring", "satellite"])
def test_cycle_repeats_after_a_pitch(pins_on: str) -> None:
    """A pitch 2π/z1 of the crank later, and z2 pitches later, forces are those of other numbers, all else alike.

    With pins on the ring the latter is 2π·lobes/pins: each flank then meets the neighbour of its roller.
    """
    made, level = built(pins_on=pins_on)
    tooth = made.feasible.tooth
    assert tooth is not None
    pitch = 2.0 * math.pi / tooth.fixed_teeth
    found = solved(made, level, crank=[0.1, 0.1 + pitch, 0.1 + tooth.satellite_teeth * pitch])
    for one, moved in ((1, 1), (2, tooth.satellite_teeth)):
        assert found.total[one] == pytest.approx(np.roll(found.total[0], moved), abs=1e-6 * found.total.max())
    assert found.lag == pytest.approx(found.lag[0], rel=1e-7)
    for matrix in found.mesh[1:]:
        assert matrix == pytest.approx(found.mesh[0], abs=1e-5 * np.abs(found.mesh[0]).max())


@pytest.mark.property
def test_passage_of_a_roller_is_smooth() -> None:
    """All rollers over a pitch, laid one behind the other, are one roller over its passage: no jumps."""
    made, level = built()
    rolled = passage(solved(made, level).total)
    three = np.stack([rolled, np.roll(rolled, -1), np.roll(rolled, -2)])
    pressed = (three > 0.0).all(axis=0)  # there is a kink where it comes into contact
    assert np.abs(three[0] - 2.0 * three[1] + three[2])[pressed].max() < 0.02 * rolled.max()
    assert 0.3 < (rolled > 0.0).mean() < 0.6  # half of all flanks have the right slope


@pytest.mark.property
def test_zero_load() -> None:
    """Without a torque nothing is pressed, nothing turns, and there is no stiffness."""
    made, level = built()
    found = solved(made, level, torque=0.0)
    assert not found.total.any()
    assert not found.lag.any()
    assert not found.torsional_stiffness.any()
    outcome = Run(
        stages(operation__output_torque=0, ask__quantities=["load_sharing", "torsional_stiffness"]).scene
    ).outcome
    stiffness = outcome.quantities["torsional_stiffness"]
    assert stiffness.value == 0.0
    assert "no torque" in str(stiffness.note)
    assert all(check.ok for check in outcome.checks)


@pytest.mark.property
def test_line_contact_scales_like_hertz() -> None:
    """Solid rollers without play: forces grow with the torque and pressures with its root; rotations a bit less."""
    made, level = built(("elastic_contact", "pin_compliance"))
    light, heavy = (solved(made, level, torque) for torque in (TORQUE, 4.0 * TORQUE))
    assert heavy.total.max() / light.total.max() == pytest.approx(4.0, rel=0.02)
    assert heavy.pressure.max() / light.pressure.max() == pytest.approx(2.0, rel=0.02)
    assert 3.3 < heavy.lag.mean() / light.lag.mean() < 4.0  # the logarithm of the width
    back = solved(made, level, -TORQUE)
    assert back.lag.mean() == pytest.approx(-light.lag.mean(), rel=0.02)  # flanks are nearly symmetric


@pytest.mark.property
def test_rotation_without_resistance_is_rolling() -> None:
    """Teeth do not resist rolling about the instantaneous axis; the output's angle hangs on what holds the axis."""
    made, level = built()
    found = solved(made, level)
    along = made.design.instantaneous_axis
    largest = np.linalg.eigvalsh(found.mesh)[:, -1]
    assert np.abs(found.mesh @ along).max() < 1e-3 * largest.min()  # but for the forces that turn with it
    tilt = 4e4
    soft = solved(made, level, tilt=tilt)
    # on a bearing so soft the satellite rolls by ψ along: T out·along = k |along across n|² ψ, lag = ψ out·along
    across = np.linalg.norm(np.cross(along, soft.axis))
    assert soft.lag.mean() == pytest.approx(TORQUE * (soft.out @ along / across) ** 2 / tilt, rel=0.01)


@pytest.mark.property
def test_crown_clearance_and_rollers() -> None:
    """Crown takes the ends out of contact and raises the pressure; play lets the output turn; rollers add softness."""
    made, level = built()
    plain = solved(made, level)
    crowned = solved(*built(ELASTIC, 0.1))
    assert not crowned.force[..., [0, -1]].any()
    assert crowned.pressure.max() > 1.2 * plain.pressure.max()
    soft = solved(*built(("elastic_contact", "pin_compliance")))
    assert soft.lag.mean() > 1.3 * plain.lag.mean()
    loose = stages(("elastic_contact", "clearance"), drive__rollers__clearance=0.01)
    thin = solve_series(loose.feasible, level, TORQUE, pitch_angles(loose.feasible, POSITIONS))
    play = 0.01e-3 / loose.design.tooth_radius  # angle of the gap, along the normals
    assert thin.lag.mean() > plain.lag.mean() + play
    assert (thin.total > 0.0).sum() < (plain.total > 0.0).sum()


@pytest.mark.property
def test_short_rollers_press_with_their_edges() -> None:
    """A straight roller shorter than the flank has an edge pressure without a bound: that is said."""
    ask: dict[str, Any] = {
        "drive__rollers__inner_radius": 63,
        "drive__rollers__outer_radius": 72,
        "ask__positions": 4,
    }
    made = stages(("elastic_contact",), **ask, ask__quantities=["contact_pressure_max"]).scene
    outcome = Run(made).outcome
    assert "no bound" in str(outcome.quantities["contact_pressure_max"].note)
    assert any("no bound" in warning for warning in outcome.warnings)
    assert all(check.ok for check in outcome.checks)


@pytest.mark.property
def test_effects_not_listed_change_nothing() -> None:
    """Crown, clearance, bore and [accuracy] without their effects: nothing changes, to the bit; nor do reactions."""
    one = solved(*built())
    made = stages(drive__rollers__crown=0.05, drive__rollers__clearance=0.02, drive__rollers__bore_angle=2.0)
    other = solved(made, build_level(made.feasible, COARSE))
    assert np.array_equal(one.force, other.force)
    assert np.array_equal(one.motion, other.motion)
    ask = ["reactions", "balance"]
    plain = Run(stages(("inertia",), ask__quantities=ask).scene).outcome.quantities
    elastic = Run(stages(("inertia", "elastic_contact"), ask__quantities=ask).scene).outcome.quantities
    assert plain == elastic


@pytest.mark.property
def test_what_cannot_be_built_is_refused() -> None:
    """Hub, tips, rollers, bore and facets out of range: the limit stands in the message."""
    for key, value, said in (
        ("drive__rim__hub_angle", 64, "take less than that"),
        ("drive__rim__tip_angle", 80, "cut between these"),
        ("drive__rollers__outer_radius", 90, "the teeth lie from 60 to 75 mm"),
        ("drive__rollers__bore_angle", 6, "must be less than the half angle"),
    ):
        with pytest.raises(Infeasible, match=said):
            _ = stages(("elastic_contact",), **{key: value}).feasible
    with pytest.raises(Infeasible, match="leaves less than half of a pin"):
        _ = stages(("elastic_contact", "clearance"), drive__rollers__clearance=5).feasible
    with pytest.raises(SceneError, match="at least 12"):
        _ = stages(accuracy__facets_per_lobe=8).contact


@pytest.mark.property
def test_scene_to_outcome() -> None:
    """All elastic quantities from a scene with all effects: numbers with errors, checks met, series, picture."""
    names = (
        "load_sharing",
        "contact_force_max",
        "mesh_stiffness",
        "torsional_stiffness",
        "lost_motion",
        "bearing_loads",
    )
    effects = (*ELASTIC, "bearing_compliance", "inertia")
    made = stages(effects, ask__quantities=list(names), drive__rollers__crown=0.01, ask__positions=4)
    outcome = Run(made.scene).outcome
    assert all(check.ok for check in outcome.checks)
    stiff = outcome.quantities["torsional_stiffness"]
    assert isinstance(stiff.value, float)
    assert stiff.error is not None
    assert 0.0 < stiff.error < 0.02 * stiff.value
    assert stiff.model == "slices"
    assert outcome.dataset is not None
    assert {"roller_force", "pressure_along_teeth", "transmission_error"} <= set(outcome.dataset)
    assert any(curve.group == "pressed contacts" for curve in outcome.plots[0].curves)
    loads = outcome.quantities["bearing_loads"].parts
    assert loads is not None

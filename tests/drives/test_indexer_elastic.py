"""Elastic indexers reached through scenes: rigid limits, effects that are not listed, the Geneva wheel beside."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.drives.indexer_cases import run_of
from tests.drives.test_indexer_published import number
from trochoid.kinematics.errors import Infeasible
from trochoid.run import Run
from trochoid.scene.overrides import Override

FREE = "relative_turning_time = 0.2902"
ELASTIC = 'effects=[{type="elastic_contact"},{type="inertia"}]'
FAST = "operation.input_speed=300"
SHAFT = ("drive.output_shaft.inertia=0.02", "drive.output_shaft.stiffness=20000")


def elastic(*overrides: str | Override) -> Run:
    return run_of(FREE, ELASTIC, 'accuracy.model="rigid_wheel"', "drive.wheel.thickness=12", *overrides)


@pytest.mark.exact
def test_pressure_of_an_even_load() -> None:
    """A pin that hardly bends: Hertz's √(F E*/(π r L)) of the rigid force, 5 % more at the nearer end for ρ alone."""
    run = elastic("drive.pin_radius=12", "drive.pin.overhang=0")
    force = number(run.contact_force_max, "indexer", "pin_force")
    modulus = 2.1e11 / (2 * 0.91)
    even = 1e-6 * math.sqrt(force * modulus / (math.pi * 12e-3 * 12e-3))
    found = number(run.contact_pressure_max, "indexer", "pressure")
    assert even < found < 1.1 * even


@pytest.mark.exact
def test_pressure_of_a_barrel() -> None:
    """Point contact: 3F/(2πab) with half axes as they are answered."""
    run = elastic('drive.pin.shape="barrel"', "drive.pin.crown_radius=300")
    force = number(run.contact_force_max, "indexer", "pin_force")
    found = run.contact_pressure_max
    a, b = 1e-6 * number(found, "indexer", "half_width"), 1e-3 * number(found, "indexer", "half_length")
    assert number(found, "indexer", "pressure") == pytest.approx(
        1e-6 * 1.5 * force / (math.pi * a * b), rel=1e-6
    )
    part = run.mesh_stiffness.parts["indexer"]["at_force_max"]  # type: ignore[index]
    assert part.error is None  # type: ignore[union-attr]


@pytest.mark.exact
def test_stiffnesses_in_series() -> None:
    """At the output 1/k = 1/k_mesh + 1/k_shaft, at every load."""
    run = elastic(*SHAFT)
    mesh = number(run.mesh_stiffness, "indexer", "at_force_max")
    whole = number(run.torsional_stiffness, "indexer", "at_force_max")
    assert 1.0 / whole == pytest.approx(1.0 / mesh + 10800.0 / (math.pi * 20000.0), rel=1e-12)
    error = run.mesh_stiffness.parts["indexer"]["mean"].error  # type: ignore[index, union-attr]
    assert error is not None
    assert 0.0 < error < 0.1 * mesh


@pytest.mark.independent
def test_stiff_limit() -> None:
    """E times 9 with strong damping: the elastic pin force comes to the rigid one, its lag falls as 1/E."""
    lags = []
    for stiff in (1, 9):
        run = elastic(f"materials.steel.youngs_modulus={210000 * stiff}", "operation.damping_ratio=0.9", FAST)
        lags.append(number(run.dynamic_factor, "indexer", "lag_max"))
        factor = number(run.dynamic_factor, "indexer", "factor")
        assert factor == pytest.approx(1.0, abs=0.01 / math.sqrt(stiff))
    assert 8.0 < lags[0] / lags[1] < 9.3


@pytest.mark.exact
def test_soft_shock_doubles_the_start() -> None:
    """Nearly undamped, the start overshoots until ∫N du = N_rigid u: to twice the rigid force or a little more."""
    run = elastic("operation.output_torque=0", "operation.damping_ratio=0.001")
    law = run.stages.pairs["indexer"].law
    start = 0.1 * number(run.contact_force_max, "indexer", "pin_force_at_start")
    u = np.linspace(0.0, 4.0 * float(law.pressed(np.array([start]))[0]), 20001)
    work = np.concatenate(([0.0], np.cumsum(0.5 * (law.moment(u)[1:] + law.moment(u)[:-1]) * np.diff(u))))
    expected = float(law.moment(u[1 + np.argmax(work[1:] > start * u[1:])])) / start
    assert 2.0 < expected < 2.1
    found = number(run.dynamic_factor, "indexer", "at_entry_over_rigid_start")
    assert found == pytest.approx(expected, abs=0.03)


@pytest.mark.property
def test_residual_vibration_beside_the_geneva_wheel() -> None:
    """With a soft shaft the output swings by Jε/k or so after the stop; both mechanisms and their ratio are there."""
    run = elastic("operation.output_torque=0", *SHAFT)
    found = run.residual_vibration
    assert set(found.parts or {}) == {
        "indexer",
        "geneva_wheel",
        "geneva_wheel_in_same_time",
        "geneva_over_indexer_in_same_time",
    }
    jump = number(run.indexing_motion, "indexer", "acceleration_at_start")
    expected = 3600 * math.degrees(0.02 * jump / 20000.0)
    amplitude = number(found, "indexer", "amplitude")
    assert 0.5 * expected < amplitude < 2.0 * expected
    omega = 2 * math.pi * number(found, "indexer", "natural_frequency_1")
    assert number(found, "indexer", "velocity") == pytest.approx(
        omega * math.radians(amplitude / 3600), rel=0.15
    )
    assert omega == pytest.approx(math.sqrt(20000.0 / 0.02), rel=0.02)
    # 5 % are left after ln 20/(ζ ω)
    assert number(found, "indexer", "settling_time") == pytest.approx(math.log(20) / (0.02 * omega), rel=0.2)
    made = run.outcome
    assert all(check.ok for check in made.checks)
    titles = [plot.title for plot in made.plots]
    assert "Residual vibration after the stop" in titles
    assert made.dataset is not None
    assert np.nanmax(made.dataset.contact_pressure.values) > 0.0


@pytest.mark.property
def test_friction_holds_the_output() -> None:
    """2 N·m of friction are more than what an unladen wheel brings to its stop: nothing swings."""
    found = elastic().residual_vibration
    assert number(found, "indexer", "amplitude") == 0.0
    assert number(found, "indexer", "settling_time") == 0.0


@pytest.mark.property
def test_play_knocks() -> None:
    """With play the pin meets its slot at speed: the peak is higher than without."""
    tight = number(elastic(*SHAFT, FAST).dynamic_factor, "indexer", "factor")
    knocking = 'effects=[{type="elastic_contact"},{type="clearance"},{type="inertia"}]'
    loose = elastic(*SHAFT, "drive.pin.play=0.05", knocking, FAST)
    assert number(loose.dynamic_factor, "indexer", "factor") > tight
    lever = 0.1 * math.sin(math.radians(number(loose.profile, "indexer", "rim_angle")))
    expected = 60 * math.degrees(5e-5 / lever)
    assert number(loose.mesh_stiffness, "indexer", "play_at_end") == pytest.approx(expected, rel=1e-6)


@pytest.mark.property
def test_nothing_presses() -> None:
    """Zero torque without inertia: no pressure, no stiffness, and no fault."""
    run = run_of(FREE, 'effects=[{type="elastic_contact"}]', "operation.output_torque=0")
    assert run.stages.bodies.fine is None  # nothing is meshed for nothing
    assert number(run.contact_pressure_max, "indexer") == 0.0
    assert run.mesh_stiffness.parts["indexer"].value == "unloaded"  # type: ignore[index, union-attr]
    assert run.torsional_stiffness.parts["indexer"].value == "unloaded"  # type: ignore[index, union-attr]
    assert all(check.ok for check in run.outcome.checks)


@pytest.mark.regression
def test_effects_that_are_not_listed_change_nothing() -> None:
    """Pin, lock and spring are not in the forces of a scene without elastic contact."""
    plain = run_of(FREE)
    other = run_of(FREE, "drive.pin.overhang=5", "drive.pin.play=1", "drive.wheel.lock_stiffness=7")
    assert (
        plain.contact_force_max
        == other.contact_force_max
        == elastic("drive.wheel.thickness=10").contact_force_max
    )
    assert plain.reactions == other.reactions


@pytest.mark.property
def test_pins_that_cannot_be() -> None:
    """Refused with the limit."""
    with pytest.raises(Infeasible, match=r"pin.overhang = 95 mm: .* must be less than .* 94 mm"):
        _ = elastic("drive.pin.overhang=95").mesh_stiffness
    with pytest.raises(Infeasible, match=r"pin_radius = 0.05 mm: .* must be thicker"):
        _ = elastic("drive.pin_radius=0.05", "operation.output_torque=1000").mesh_stiffness

"""Numbers of the sources on planetary-cycloid drives (sources §3), by the program's own springs rung."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from trochoid.drives.khv.design import design
from trochoid.drives.khv.series import solve_at
from trochoid.fem.pair import FlankPair, Member
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
RV40 = (
    "drive.pins=40",
    "drive.lobes=39",
    "drive.pin_circle_radius=64",
    "drive.pin_radius=3",
    "drive.eccentricity=1.3",
    "drive.output_pins.count=12",
    "drive.output_pins.circle_radius=40",
    "operation.output_torque=206",
)
CYCLOIDGEN = (
    "drive.pins=12",
    "drive.lobes=11",
    "drive.pin_circle_radius=50",
    "drive.pin_radius=4",
    "drive.eccentricity=1.5",
    "drive.output_pins.circle_radius=30",
    "operation.output_torque=2.5",
)


def pin_forces(*overrides: str, crank: float, effects: str = "") -> Array:
    """Ring-pin forces (pins,) on one rigid disc on springs, N."""
    words = (f"effects=[{effects}]", 'ask.quantities=["ratio"]', "drive.discs=1", *overrides)
    return solve_at(design(load(EXAMPLE, words)), "springs", (), crank).touches["ring0"].force


@pytest.mark.published
def test_largest_pin_force_of_the_hand_calculation() -> None:
    """Sources §3: z_p 40, R 64, r 3, e 1.3 mm, 206 N·m per disc, α = 0.2: F_max 405.469 N on 20 pins."""
    force = pin_forces(*RV40, crank=0.2)
    assert force.max() == pytest.approx(405.469, abs=5e-4)
    assert np.count_nonzero(force) == 20


@pytest.mark.published
def test_modified_flank_loads_fewer_pins() -> None:
    """Sources §3: ΔR −0.02, Δr +0.01 mm, 2e5 N/mm, exact gaps: 6 pins, F_max 1045.1 N."""
    ground = ("drive.modification={equidistant=0.01, radial=-0.02}", "drive.contact_stiffness=2e5")
    force = pin_forces(*RV40, *ground, crank=0.2, effects='{type="clearance"}')
    assert force.max() == pytest.approx(1045.1, abs=0.05)
    assert np.count_nonzero(force) == 6


@pytest.mark.published
def test_peak_pin_force_of_another_program() -> None:
    """cycloidgen 7.2.0, release note: R 50, r 4, e 1.5 mm, z_p 12, 2.5 N·m per disc: 49.859 N."""
    assert pin_forces(*CYCLOIDGEN, crank=0.0).max() == pytest.approx(49.859, abs=5e-4)


@pytest.mark.published
def test_hole_of_the_parallel_crank() -> None:
    """Textbook, 1.3: D_o = d_b + 2e; then every hole touches its roller at any crank angle."""
    made = design(load(EXAMPLE, ("effects=[]", 'ask.quantities=["ratio"]')))
    assert 2 * made.hole_radius == pytest.approx(13e-3 + 2 * 2.5e-3, rel=1e-15)
    for crank in (0.0, 1.0, 4.0):
        gap = solve_at(made, "springs", (), crank).touches["output0"].state.gap
        assert np.abs(gap).max() < 1e-16


@pytest.mark.published
def test_half_of_the_pins_can_carry() -> None:
    """Textbook, 1.1: with z2 − z1 = 1 about half of the pins are in mesh; the example has 20."""
    run = Run(
        load(EXAMPLE, ("effects=[]", 'ask.quantities=["contact_ratio", "load_sharing"]', "ask.positions=7"))
    )
    parts = run.contact_ratio.parts
    assert parts is not None
    assert {name: getattr(parts[name], "value", None) for name in ("geometric", "loaded_max")} == {
        "geometric": 10.0,
        "loaded_max": 10.0,
    }
    carrying = [getattr(parts[f"output_pins_{name}"], "value", None) for name in ("mean", "least", "most")]
    count = run.scene.drive.output_pins.count
    assert carrying == [count / 2, count // 2, (count + 1) // 2]


@pytest.mark.published
def test_specific_mass_of_the_example() -> None:
    """Textbook, 1.1: 0.02 … 0.05 kg/(N·m) for drives of this kind; the example with its casing lies inside."""
    parts = Run(load(EXAMPLE)).mass.parts
    assert parts is not None
    assert 0.02 < float(getattr(parts["specific"], "value", 0.0)) < 0.05


@pytest.mark.exact
def test_members_of_the_flank_pair_are_where_the_drive_puts_them() -> None:
    """FlankPair.nominal, which scripts use, is the pair that the drive makes: the same gaps and levers."""
    made = design(load(EXAMPLE, ("effects=[]", 'ask.quantities=["ratio"]')))
    drive = solve_at(made, "springs", (), 0.7).touches["ring0"].state
    center = made.flank.eccentricity * np.array([np.cos(0.7), np.sin(0.7)])
    disc = Member(center, -0.7 / made.flank.lobes, np.array([[0.0], [0.0], [1.0]]))
    pair = FlankPair.nominal(disc, Member(np.zeros(2), 0.0, np.zeros((3, 1))), made.flank, 0.7)
    state = pair.at(np.zeros(1))
    assert state.gap == pytest.approx(drive.gap, abs=1e-15)
    assert state.arms[:, 0] == pytest.approx(
        made.flank.lever(made.flank.contact_parameter(np.arange(20), 0.7))
    )
    assert state.point == pytest.approx(drive.point, abs=1e-15)

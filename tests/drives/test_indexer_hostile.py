"""Indexers out of all proportion: what is said of them is true, quick, and names what to change."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.drives.indexer_cases import run_of
from tests.drives.test_indexer_published import number
from trochoid.drives.indexer.pin import LARGE
from trochoid.drives.indexer.reactions import HARMONICS, lines_of
from trochoid.drives.indexer.shaken import longer
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.readable import readable
from trochoid.results import text
from trochoid.run import Run
from trochoid.scene.overrides import Override

FREE = "relative_turning_time = 0.2902"
EFFECTS = 'effects=[{type="elastic_contact"},{type="clearance"},{type="inertia"}]'
LOAD = ("drive.output_shaft.inertia=0.02", "drive.wheel.inertia=0.02", 'operation.input_speed="60 rad/s"')


def coarse(*overrides: str | Override) -> Run:
    return run_of(FREE, EFFECTS, "drive.wheel.thickness=12", *LOAD, *overrides)


def rigid(*overrides: str | Override) -> Run:
    return coarse('accuracy.model="rigid_wheel"', *overrides)


@pytest.mark.property
def test_a_load_that_never_moves() -> None:
    """A shaft of 1 N*m/rad cannot overcome 2 N*m within 90°: not settled, and a warning names what would serve."""
    run = rigid("drive.output_shaft.stiffness=1")
    found = run.residual_vibration
    row = found.parts["indexer"]  # type: ignore[index]
    assert str(row["settling_time"].value).startswith("not settled: friction holds it off by 100 % of")  # type: ignore[union-attr, index]
    assert row["left_at_next_index"].value == "held by friction"  # type: ignore[union-attr, index]
    assert abs(number(found, "indexer", "held_off_by_friction")) == pytest.approx(324000.0)
    said = [x for x in run.outcome.warnings if "which never moves" in x]
    assert len(said) == 1
    assert "by 90°, 100 % of the swing" in said[0]
    assert f"stiffness {readable(2.0 / (0.01 * math.pi / 2))} N*m/rad at least" in said[0]


@pytest.mark.property
def test_harmonics_reach_beyond_the_fastest_mode() -> None:
    """A light wheel on its pin rings above 400 times the arm's speed: there its input torque is raised most."""
    run = rigid(
        "drive.wheel.inertia=0.002", "drive.output_shaft.inertia=0.0001", 'operation.input_speed="16 rad/s"'
    )
    x = run.stages.shaken["indexer"]
    assert lines_of(x) > x.fastest / x.speed > HARMONICS
    order = number(run.reactions, "indexer_elastic", "input_torque_harmonic_most_raised")
    modes = run.natural_frequencies
    low, high = (number(modes, "indexer", f"mode_1_{end}_in_index") for end in ("least", "largest"))
    assert order > HARMONICS
    assert 0.8 * low < order * x.speed / (2.0 * math.pi) < 1.2 * high


@pytest.mark.exact
def test_a_stiff_shaft_is_rigid() -> None:
    """From 1000 times the contact's stiffness on the march is that of wheel and load in one, bit by bit."""
    stiff, none = (rigid(*x).stages.shaken["indexer"] for x in (["drive.output_shaft.stiffness=1e12"], []))
    np.testing.assert_array_equal(stiff.fine.index.lag, none.fine.index.lag)
    np.testing.assert_array_equal(stiff.fine.dwell.lag, none.fine.dwell.lag)
    assert stiff.stiffer > 1000.0


@pytest.mark.property
def test_overloads_are_refused_before_finite_elements() -> None:
    """Rigid forces tell: no wheel is meshed for a pin that would yield by more than a centimetre."""
    for absurd in ("operation.input_speed=1e5", "operation.output_torque=1e6"):
        run = coarse(absurd)
        with pytest.raises(
            Infeasible, match=r"pin_radius = 4 mm: under \d+ N, .* \d+ N are the most that serve"
        ):
            _ = run.mesh_stiffness
        assert "bodies" not in vars(run.stages)


@pytest.mark.property
def test_foils_count_as_rigid() -> None:
    """A wheel much thinner than its slots are long is not meshed; named elastic it is refused with the least."""
    run = coarse(
        "drive.wheel.thickness=0.01", 'operation.input_speed="1 rad/s"', "operation.output_torque=0.1"
    )
    assert run.stages.bodies.fine is None
    assert "wheel.thickness = 0.01 mm beside slots" in run.stages.bodies.refusal
    named = coarse(
        "drive.wheel.thickness=0.1", 'operation.input_speed="1 rad/s"', 'accuracy.model="elastic_wheel"'
    )
    with pytest.raises(Infeasible, match=r"finite elements are for 0\.\d+ mm and more"):
        _ = named.stages.bodies


@pytest.mark.property
def test_play_has_its_limits() -> None:
    """Slots widened by the play run into each other; a pin that strikes too hard is refused with a play that serves."""
    with pytest.raises(Infeasible, match=r"pin.play = 200 mm: .* must be less than"):
        _ = rigid("drive.pin.play=200").mesh_stiffness
    pair = rigid("drive.pin.play=0.5").stages.pairs["indexer"]
    full = replace(pair, law=replace(pair.law, top=LARGE))
    with pytest.raises(
        Infeasible, match=r"give pin.play about 0.12 mm, or about 0.5 times the operation.input_speed"
    ):
        longer(full, 2.0 * full.law.largest)  # half the force: half the speed, a quarter of the play
    assert longer(pair, 2.0 * pair.law.largest).law.top == 4.0 * pair.law.top


@pytest.mark.property
def test_hard_knocks_are_wide_contacts() -> None:
    """A pin that crosses 8 mm in a hundredth of a second presses far beyond Hertz's contacts: a warning says so."""
    run = rigid("drive.pin.play=8", "operation.input_speed=2000", "operation.output_torque=0")
    _ = run.dynamic_factor
    assert any("under the largest pin force of the march" in said for said in run.outcome.warnings)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("value", "shown"),
    [(100.0, "100"), (1450.4, "1450"), (1e6, "1000000"), (29834.0, "29800"), (0.00123456, "0.00123")],
)
def test_numbers_in_messages(value: float, shown: str) -> None:
    """Three digits, no powers of ten."""
    assert readable(value) == shown


@pytest.mark.exact
def test_small_values_with_small_errors() -> None:
    """Powers of ten instead of rows of zeros."""
    assert text.value_and_error(0.0002908878019, 1e-12) == ("2.908878019×10⁻⁴", "0.000000010×10⁻⁴")

"""Scenes of RV drives: valid ones, one message for each fault, and nothing but faults whatever is written."""

from __future__ import annotations

import re
from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.drives.rv.feasible import faults
from trochoid.faults import SceneFaults
from trochoid.kinematics.errors import Infeasible
from trochoid.run import Run
from trochoid.scene import read
from trochoid.starter import starter

TEXT = starter("rv")


@pytest.mark.property
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("z_sun = 12", "z_sum = 12", 'drive.first_stage.z_sum: unknown key; did you mean "z_sun"?'),
        ("z_sun = 12", "z_sun = 5", "drive.first_stage.z_sun: given 5; need a whole number from 6 to 500"),
        ("z_planet = 36", "", "drive.first_stage.z_planet: missing; need a whole number from 6 to 1000"),
        ("cranks = 2", "cranks = 1", "drive.first_stage.cranks: given 1; need a whole number from 2 to 6"),
        ("lobes = 39", "lobes = 38", "drive.cycloid.lobes: given 38; need pins - 1 = 39"),
        (
            "module = 1.5",
            'module = "1.5 N"',
            'drive.first_stage.module: given "1.5 N" (force); need a length in mm',
        ),
        ("module = 1.5", "module = 0", "drive.first_stage.module: given 0 mm; need a length greater than 0"),
        (
            "pressure_angle = 20",
            "pressure_angle = 40",
            "drive.first_stage.pressure_angle: given 40 deg; need an angle",
        ),
        ("# x_sun = 0.4", "x_sun = 9", "drive.first_stage.x_sun: given 9; need a number of -3 or more"),
        (
            'fixed = "ring"',
            'fixed = "disc"',
            'drive.fixed: given "disc"; need one of "ring", "carrier", "sun"',
        ),
        (
            "[-16, 16]",
            "[16, -16]",
            "drive.crankshaft.bearing_positions: given 16 and -16 mm; need two places",
        ),
        ("[drive.ring]", "[drive.rings]", 'drive.rings: unknown key; did you mean "ring"?'),
        (
            '"contact_ratio"',
            '"blocking_contour"',
            '"blocking_contour" is not offered by rv; it offers: ratio',
        ),
        ('"ratio"', '"ratoi"', 'ask.quantities.0: unknown quantity "ratoi"; did you mean "ratio"?'),
    ],
)
def test_one_mistake_gives_its_message(old: str, new: str, said: str) -> None:
    """Every fault names its key, what was given and what is allowed."""
    assert TEXT.count(old) >= 1
    with pytest.raises(SceneFaults) as caught:
        read(TEXT.replace(old, new, 1), source="s.toml")
    found = [str(fault) for fault in caught.value.faults]
    assert any(re.search(re.escape(said), each) for each in found), found


LENGTHS = (
    "cycloid.pin_circle_radius",
    "cycloid.pin_radius",
    "cycloid.eccentricity",
    "cycloid.bore_radius",
    "cycloid.face_width",
    "first_stage.module",
    "first_stage.center_distance",
    "first_stage.face_width",
    "arm_bearing.hole_radius",
    "arm_bearing.roller_radius",
    "crankshaft.radius",
    "crankshaft.planet_position",
    "carrier.pillars.radius",
    "carrier.pillars.circle_radius",
    "ring.outer_radius",
)
COUNTS = (
    "first_stage.z_sun",
    "first_stage.z_planet",
    "first_stage.cranks",
    "cycloid.discs",
    "arm_bearing.rollers",
)


@pytest.mark.property
@settings(max_examples=60, deadline=None)
@given(
    lengths=st.dictionaries(st.sampled_from(LENGTHS), st.floats(-1, 1e4), max_size=3),
    counts=st.dictionaries(st.sampled_from(COUNTS), st.integers(-1, 300), max_size=2),
    shifts=st.dictionaries(st.sampled_from(("first_stage.x_sun", "first_stage.x_planet")), st.floats(-4, 4)),
    pins=st.sampled_from([None, 4, 11, 40, 200]),
)
def test_whatever_is_written_is_answered_or_refused(
    lengths: dict[str, float], counts: dict[str, int], shifts: dict[str, float], pins: int | None
) -> None:
    """The result is numbers, or faults of the scene, or a reason why the drive cannot be built: nothing else."""
    values: dict[str, float] = {**lengths, **counts, **shifts}
    overrides = [f"drive.{key}={value!r}" for key, value in values.items()]
    if pins is not None:
        overrides += [f"drive.cycloid.pins={pins}", f"drive.cycloid.lobes={pins - 1}"]
    scene = None
    with suppress(SceneFaults):
        scene = read(TEXT, overrides)
    if scene is None:
        return
    run = Run(scene)
    assert run.ratio.value is not None
    reasons = faults(run.stages.design)
    assert all(len(reason) > 20 for reason in reasons)
    if reasons:
        with pytest.raises(Infeasible):
            _ = run.stages.feasible
        return
    for quantity in (run.profile, run.geometry_quality, run.contact_ratio, run.balance, run.mass):
        assert quantity.parts

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
from trochoid.run import Run, plan
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


ADVISED = "the nearest that can be built: "
STAGE = {
    "z_sun": st.integers(6, 60),
    "z_planet": st.integers(6, 120),
    "cranks": st.integers(2, 6),
    "module": st.floats(0.5, 4.0),
    "center_distance": st.floats(20.0, 60.0),
    "x_sun": st.floats(-3.0, 3.0),
    "x_planet": st.floats(-3.0, 3.0),
}


@pytest.mark.property
@settings(max_examples=40, deadline=None)
@given(data=st.data(), keys=st.sets(st.sampled_from(sorted(STAGE)), min_size=1, max_size=3))
def test_advice_works_when_typed_in(data: st.DataObject, keys: set[str]) -> None:
    """The numbers of the message, put back into the scene: `check` passes, or states what the message stated."""
    overrides = ['effects=[{type="inertia"}]', 'ask.quantities=["profile"]']
    overrides += [f"drive.first_stage.{key}={data.draw(STAGE[key], key)!r}" for key in sorted(keys)]
    said = refusal(overrides)
    advice = next((line for line in said if line.startswith(ADVISED)), None)
    if advice is None:
        wrong = any(re.search("first_stage:|assembled|collide|coaxial", line) for line in said)
        assert not wrong or "no first stage near can be built" in said[-1], said
        return
    then = refusal(overrides + [f"drive.{each}" for each in advice.removeprefix(ADVISED).split(", ")])
    assert all(f"and with these: {each}" in said for each in then), (said, then)


@pytest.mark.property
@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("carrier.outer_radius=10", "pillars stick out of the carrier; it must be at least 49 mm"),
        ("carrier.pillars.circle_radius=20", ""),
        ("ring.width=1", "must reach all discs; it must be at least the width of the pack, 19 mm"),
        ("first_stage.z_planet=80", "the nearest that can be built: first_stage.z_planet = 44"),
        (
            "first_stage.center_distance=40",
            'built: first_stage.center_distance = "38.7 mm", first_stage.x_sun',
        ),
        ("first_stage.center_distance=30", "more than a·cos α = 33.8289 mm"),
        ("first_stage.cranks=5", "the nearest that can be built: first_stage.cranks = 3"),
        ("first_stage.z_sun=500", "no first stage near can be built"),
    ],
)
def test_what_does_not_go_together_is_refused(override: str, said: str) -> None:
    """Bodies that stick out of each other, and stages with what near them can be built."""
    found = "\n".join(refusal([f"drive.{override}"]))
    assert said in found
    assert bool(found)
    assert found.count("the nearest that can be built") <= 1


@pytest.mark.property
@pytest.mark.parametrize(
    ("key", "value"), [("carrier.thickness", 1e19), ("ring.width", 1e9), ("arm_bearing.clearance", 1e7)]
)
def test_lengths_have_limits(key: str, value: float) -> None:
    with pytest.raises(SceneFaults, match="at most 100000"):
        read(TEXT, [f"drive.{key}={value!r}"])


@pytest.mark.property
@pytest.mark.filterwarnings("error")
def test_a_bore_of_no_size_weighs_nothing() -> None:
    """A hole whose area underflows takes nothing away, and says nothing."""
    full, bored = (Run(read(TEXT, [f"drive.cycloid.bore_radius={r}"])).mass for r in ("1e-6", "1e-300"))
    assert full.parts is not None
    assert bored.parts is not None
    assert bored.parts["discs"].value == pytest.approx(full.parts["discs"].value, rel=1e-12)  # type: ignore[union-attr]


def refusal(overrides: list[str]) -> list[str]:
    """Why `check` refuses the starter with these overrides; nothing if it does not."""
    scene = read(TEXT, overrides)
    try:
        plan(scene)
    except Infeasible as reason:
        return str(reason).splitlines()
    return []

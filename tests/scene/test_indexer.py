"""Scenes of indexers: valid ones, one message for each fault, and nothing but faults whatever is written."""

from __future__ import annotations

import re
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from trochoid.faults import SceneFaults
from trochoid.kinematics.errors import Infeasible
from trochoid.results.outcome import Quantity
from trochoid.run import Run, plan
from trochoid.scene import NEEDS, read
from trochoid.starter import starter

TEXT = starter("indexer")
FREE = "relative_turning_time = 0.2902"
MARCHED = (
    "dynamic_factor",
    "residual_vibration",
    "reactions",
    "vibration_velocity",
    "vibration_zone",
)  # scenes out of all proportion take too many steps


@pytest.mark.property
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("ratio = 4", "ratoi = 4", 'drive.ratoi: unknown key; did you mean "ratio"?'),
        ("ratio = 4", "ratio = 1", "drive.ratio: given 1; need a whole number from 2 to 20"),
        ("ratio = 4", "ratio = 3.5", "drive.ratio: given 3.5; need a whole number from 2 to 20"),
        ('train = "hypo"', 'train = "meta"', 'drive.train: given "meta"; need one of "hypo", "epi"'),
        (
            "swing_angle = 90",
            "swing_angle = 360",
            "drive.swing_angle: given 360 deg; need an angle of 1 or more",
        ),
        (
            "swing_angle = 90",
            'swing_angle = "90 mm"',
            'drive.swing_angle: given "90 mm" (length); need an angle',
        ),
        (
            "axis_angle = 90",
            "axis_angle = 180",
            "drive.axis_angle: given 180 deg; need an angle of 1 or more and of",
        ),
        ("axis_angle = 90", "", "drive.axis_angle: missing; need an angle"),
        (FREE, "", "drive.pin_ratio: missing, and relative_turning_time too; give one of the two"),
        (
            FREE,
            FREE + "\npin_ratio = 0.5",
            "drive.pin_ratio: given beside relative_turning_time = 0.2902; give one",
        ),
        (
            FREE,
            "relative_turning_time = 1",
            "drive.relative_turning_time: given 1; need a number greater than 0",
        ),
        (FREE, "pin_ratio = 0", "drive.pin_ratio: given 0; need a number of 0.001 or more"),
        (
            "hub_radius = 25",
            "hub_radius = -1",
            "drive.wheel.hub_radius: given -1 mm; need a length of 0 or more",
        ),
        ("[drive.wheel]", "[drive.weel]", 'drive.weel: unknown key; did you mean "wheel"?'),
        (
            'type = "inertia"',
            'type = "friction"',
            '"friction" is not an effect of indexer drives; it has "elastic_contact", "clearance", "inertia"',
        ),
        ("[[effects]]\n# Pin", "# Pin", "effects"),
        ('"ratio"', '"stress_max"', '"stress_max" is not offered by indexer; it offers: ratio'),
        ('"solutions"', '"solution"', 'unknown quantity "solution"; did you mean "solutions"?'),
    ],
)
def test_one_fault_one_message(old: str, new: str, said: str) -> None:
    """Each mistake is found at its key, with what was given and what is allowed."""
    text = TEXT.replace(old, new, 1)
    assert text != TEXT
    with pytest.raises(SceneFaults) as caught:
        read(text)
    assert any(said in str(fault) for fault in caught.value.faults), [str(x) for x in caught.value.faults]


@pytest.mark.property
@pytest.mark.parametrize(
    ("given", "said"),
    [
        (
            "drive.relative_turning_time=0.2",
            r"pass through the wheel's axis; no swing near has .* room for pin and wheel; .* k = 0\.25 has",
        ),
        (
            "drive.relative_turning_time=0.8",
            r"no other swing has one either: change k or i; with this swing k = 0\.495",
        ),
        ('drive.train="epi"', r'; all else the same, train = "hypo", place = "near" serves'),
        ("drive.pin_radius=90", r"pin_radius \+ wheel.slot_clearance = 90.5 mm: .* less than 86.0038 mm"),
        ("drive.wheel.hub_radius=80", r"wheel.hub_radius = 80 mm: .* it must be less than 72.\d+ mm"),
        (
            "drive.wheel.hub_radius=120",
            r"hub would hold the whole sphere; it must be less than sphere_radius = 100 mm",
        ),
        ("drive.wheel.slot_length=20", r"strike the bottom of its slot; it must be at least 20.23\d* mm"),
        ("drive.wheel.slot_length=90", r"slots would cut the hub; it must be less than 75.46\d* mm"),
        (
            "drive.wheel.thickness=200",
            r"beyond the centre of the sphere; it must be less than 2 sphere_radius = 200 mm",
        ),
        (
            "drive.swing_angle=3",
            r"neighbouring slots, 3° apart, run into each other; it must be less than \d",
        ),
    ],
)
def test_infeasible(given: str, said: str) -> None:
    """`check` and `run` say what binds and the nearest feasible value."""
    free = ("drive.relative_turning_time=0.35",) if "swing" in given else ()
    scene = read(TEXT, (given, *free))
    with pytest.raises(Infeasible, match=said):
        plan(scene)
    with pytest.raises(Infeasible, match=said):
        _ = Run(scene).outcome


@pytest.mark.property
@given(
    swing=st.floats(40.0, 300.0),
    duration=st.floats(0.1, 0.6),
    ratio=st.integers(2, 6),
    train=st.sampled_from(["hypo", "epi"]),
)
@settings(max_examples=20, deadline=None)
@example(swing=59.0, duration=0.5, ratio=3, train="hypo")
def test_advice_works_when_typed_in(swing: float, duration: float, ratio: int, train: str) -> None:
    """A swing or k that a refusal names makes an indexer that `check` takes, wheel and all."""
    given = [
        f"drive.swing_angle={swing!r}",
        f"drive.relative_turning_time={duration!r}",
        f"drive.ratio={ratio}",
        f'drive.train="{train}"',
        "drive.pin_radius=2",
    ]
    scene, said = read(TEXT, given), ""
    try:
        plan(scene)
    except Infeasible as refusal:
        said = str(refusal)
    if (named := re.search(r"(?:nearest swing|pin and wheel) is ([\d.]+)°", said)) is not None:
        plan(read(TEXT, [*given, f"drive.swing_angle={named[1]}"]))
    if (named := re.search(r"with this swing k = ([\d.]+) has one", said)) is not None:
        plan(read(TEXT, [*given, f"drive.relative_turning_time={named[1]}"]))


@pytest.mark.property
@pytest.mark.parametrize(
    "key", ["drive.pin_radius", "drive.wheel.hub_radius", "drive.wheel.slot_length", "drive.wheel.thickness"]
)
def test_named_limits_hold(key: str) -> None:
    """Just inside the value that a refusal names the wheel can be built, just outside it cannot."""
    wrong = {"drive.pin_radius": 60, "drive.wheel.hub_radius": 80, "drive.wheel.slot_length": 90}.get(
        key, 250
    )
    held = "drive.pin.overhang=0"
    with pytest.raises(Infeasible) as caught:
        plan(read(TEXT, (f"{key}={wrong}", held)))
    named = re.findall(r"(?:less than|at least) (?:2 sphere_radius = )?([\d.]+) mm", str(caught.value))
    limit = min(map(float, named))
    plan(read(TEXT, (f"{key}={limit * (1 - 1e-4)}", held)))
    with pytest.raises(Infeasible):
        plan(read(TEXT, (f"{key}={limit * (1 + 1e-4)}", held)))


angles = st.floats(1.0, 179.0) | st.sampled_from([30.0, 45.0, 60.0, 90.0, 120.0])


@st.composite
def scenes(draw: st.DrawFn) -> tuple[str, list[str]]:
    free = draw(st.booleans())
    value = (
        draw(st.floats(0.01, 0.99) | st.sampled_from([0.25, 0.5])) if free else 10 ** draw(st.floats(-3, 3))
    )
    text = TEXT if free else TEXT.replace(FREE, f"pin_ratio = {value!r}")
    values = {
        "drive.ratio": draw(st.integers(2, 7)),
        "drive.train": f'"{draw(st.sampled_from(["hypo", "epi"]))}"',
        "drive.swing_angle": draw(angles | st.floats(180.0, 359.0)),
        "drive.axis_angle": draw(angles),
        "drive.pin_radius": 10 ** draw(st.floats(-3, 2.5)),
        "drive.sphere_radius": 10 ** draw(st.floats(-1, 4)),
        "drive.wheel.hub_radius": draw(st.floats(0.0, 200.0)),
        "operation.output_torque": draw(st.sampled_from([0.0, 1e-6, 2.0, 1e6])),
        "ask.positions": draw(st.integers(1, 60)),
        **draw(
            st.sampled_from(
                [
                    {"accuracy.model": '"rigid_wheel"'},
                    {"accuracy.facets_per_lobe": 4},
                ]  # half-spaces, a coarse mesh
            )
        ),
        "ask.quantities": [x for x in NEEDS["indexer"] if x not in MARCHED],
    }
    if free:
        values["drive.relative_turning_time"] = value
    return text, [f"{key}={value}" for key, value in values.items()]


def numbers(quantity: object) -> list[float]:
    if isinstance(quantity, Quantity):
        if quantity.parts is not None:
            return [x for part in quantity.parts.values() for x in numbers(part)]
        return [quantity.value] if isinstance(quantity.value, float) else []
    assert isinstance(quantity, dict)
    return [x for part in quantity.values() for x in numbers(part)]


@pytest.mark.property
@given(scene=scenes())
@settings(max_examples=15, deadline=None)
def test_numbers_or_a_reason(scene: tuple[str, list[str]]) -> None:
    """Whatever can be read gives finite numbers whose checks hold, or Infeasible with a reason."""
    loaded = read(*scene)
    refused, made = "", None
    try:
        made = Run(loaded).outcome
    except Infeasible as refusal:
        refused = str(refusal)
    if made is None:
        assert re.search(r"near|must be|has one|give ρ|change", refused), refused
        return
    assert all(check.ok for check in made.checks), [x for x in made.checks if not x.ok]
    for quantity in made.quantities.values():
        assert np.isfinite(numbers(quantity)).all()


@pytest.mark.property
@given(text=st.text(max_size=40), place=st.integers(0, len(TEXT)))
@settings(max_examples=60, deadline=None)
def test_garbage_is_a_fault(text: str, place: int) -> None:
    """Text put anywhere into the scene leaves a scene or faults, no other exception."""
    with suppress(SceneFaults):
        read(TEXT[:place] + text + TEXT[place:])

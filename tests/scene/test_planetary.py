"""Scenes of planetary sets: what is read, what is refused, and that nothing else can happen."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.faults import SceneFaults
from trochoid.kinematics.errors import Infeasible
from trochoid.run import Run, plan
from trochoid.scene import NEEDS, Override, Scene, load, read

EXAMPLE = Path(__file__).parents[2] / "examples" / "planetary.toml"
TEXT = EXAMPLE.read_text(encoding="utf-8")
RIGID = 'effects=[{type="inertia"}]'
CHEAP = ("ratio", "profile", "geometry_quality", "contact_ratio", "reactions", "bearing_loads")


@pytest.mark.exact
def test_the_example_in_si() -> None:
    """Fields of the contract arrive in SI; what is left out has its default."""
    d = load(EXAMPLE).drive
    assert (d.z_sun, d.z_planet, d.z_ring, d.planets) == (20, 30, 80, 4)
    assert (d.x_sun, d.x_planet, d.x_ring) == (0.5, 0.634, 1.768)
    assert (d.module, d.center_distance, d.face_width) == (0.002, 0.052, 0.02)
    assert d.pressure_angle == math.radians(20)
    assert (d.ring_cutter.z, d.ring_cutter.x) == (25, 0.15)
    assert (d.fixed, d.driving, d.driven) == ("ring", "sun", "carrier")
    assert load(EXAMPLE, ['drive.module="0.25 in"']).drive.module == pytest.approx(6.35e-3)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("fixed", "driving", "driven"),
    [("ring", "sun", "carrier"), ("sun", "ring", "carrier"), ("carrier", "sun", "ring")],
)
def test_the_usual_choice_of_members(fixed: str, driving: str, driven: str) -> None:
    text = TEXT.replace('fixed = "ring"', f'fixed = "{fixed}"').replace('driving = "sun"\n', "")
    d = read(text).drive
    assert (d.driving, d.driven) == (driving, driven)


@pytest.mark.property
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("z_sun = 20", "z_sum = 20", 'drive.z_sum: unknown key; did you mean "z_sun"?'),
        ("z_sun = 20", "z_sun = 2", "drive.z_sun: given 2; need a whole number from 3 to 1000"),
        ("z_sun = 20", "z_sun = 20.5", "drive.z_sun: given 20.5; need a whole number"),
        (
            "z_ring = 80",
            "z_ring = 30",
            "drive.z_ring: given 30; need more than z_planet = 30, usually near z_sun + 2 z_planet = 80",
        ),
        ("planets = 4", "planets = 0", "drive.planets: given 0; need a whole number from 1 to 24"),
        ("module = 2", "module = 0", "drive.module: given 0 mm; need a length of 0.01 or more"),
        ("module = 2", 'module = "2 kg"', 'drive.module: given "2 kg" (mass); need a length in mm'),
        ("pressure_angle = 20", "pressure_angle = 60", "drive.pressure_angle: given 60 deg; need an angle"),
        (
            "center_distance = 52",
            "center_distance = -52",
            "drive.center_distance: given -52 mm; need a length greater",
        ),
        ("x_sun = 0.5", 'x_sun = "0.5 mm"', 'drive.x_sun: given the text "0.5 mm"; need a number'),
        ("x_sun = 0.5", "x_sun = nan", "drive.x_sun: given nan; need a finite number"),
        (
            'driving = "sun"',
            'driving = "ring"',
            'drive.driving: given "ring", which is fixed; need "sun" or "carrier"',
        ),
        (
            'fixed = "ring"',
            'fixed = "planet"',
            'drive.fixed: given "planet"; need one of "sun", "ring", "carrier"',
        ),
        ("z = 25", "zz = 25", "drive.ring_cutter.zz: unknown key"),
        ("z = 25", "z = 0", "drive.ring_cutter.z: given 0; need a whole number from 3 to 999"),
        (
            'type = "inertia"',
            'type = "friction"',
            'effects.4.type: "friction" is not an effect of planetary drives',
        ),
        ('"mass"', '"balance"', 'ask.quantities.20: "balance" is not offered by planetary; it offers: ratio'),
    ],
)
def test_a_mistake_gives_a_message_at_its_line(old: str, new: str, said: str) -> None:
    """Contract: file, line, key, what was given, what is allowed."""
    assert TEXT.count(old) >= 1
    changed = TEXT.replace(old, new, 1)
    with pytest.raises(SceneFaults) as caught:
        read(changed, source="s.toml")
    found = [str(fault) for fault in caught.value.faults]
    where = next(each for each in found if said in each)
    line = int(re.match(r"s\.toml:(\d+): ", where)[1])  # type: ignore[index]
    assert new in changed.splitlines()[line - 1]


@pytest.mark.property
@pytest.mark.parametrize("table", ["drive.ring_cutter", "operation", "ask"])
def test_missing_tables_are_named(table: str) -> None:
    without = re.sub(rf"^\[{re.escape(table)}\]\n(?:[^\[\n].*\n|    .*\n|\]\n)*", "", TEXT, flags=re.M)
    with pytest.raises(SceneFaults, match=re.escape(f"missing table [{table}]")):
        read(without)


def asked(scene_text: str, overrides: list[str], quantities: tuple[str, ...] = CHEAP) -> dict[str, Any]:
    scene: Scene[Any] = read(
        scene_text, [RIGID, *overrides, Override(("ask", "quantities"), list(quantities), "test")]
    )
    run = Run(scene)
    return {name: run.quantity(name) for name in quantities}


@pytest.mark.property
@pytest.mark.parametrize(
    ("overrides", "said"),
    [
        (["drive.planets=3"], r"no multiple of 3\nthe nearest that can be built: planets = 4$"),
        (
            ["drive.planets=5"],
            r"5 planets of radius 33 mm .* collide: .*\nthe nearest that can be built: planets = 4$",
        ),
        (["drive.center_distance=51"], r"20 and 30 teeth stand 52\.0006 mm apart .* not coaxial"),
        (
            ["drive.center_distance=40"],
            r"need more than a·cos α = 46\.9846 mm\nthe nearest that can be built: center_distance = \"49",
        ),
        (
            ["drive.z_ring=81"],
            r"30 and 81 teeth stand .* not coaxial\nthe nearest that can be built: z_ring = 80, x_sun",
        ),
        (["drive.x_sun=-0.4", "drive.x_planet=1.534", "drive.x_ring=2.668"], r"undercut of the sun"),
        (
            ["drive.ring_cutter.z=90"],
            r"cutter of 90 teeth for a ring of 80: it needs less(.|\n)*ring_cutter.z = 6",
        ),
        (
            ["drive.limits.contact_ratio=1.4"],
            r"contact ratio of sun and planet: 1\.29764, .* ≥ 1\.4\nthe nearest that can be built: center_distance = ",
        ),
        (
            ["drive.limits.contact_ratio=1.8"],
            r"no set near it can be built .*contact ratio of sun and planet: no",
        ),
        (
            ["drive.sun.bore_radius=19"],
            r"sun\.bore_radius = 19 mm: nothing is left .* less than the root radius 18\.5",
        ),
        (["drive.planet.bore_radius=40"], r"planet\.bore_radius = 40 mm"),
        (
            ["drive.ring.outer_radius=80"],
            r"ring\.outer_radius = 80 mm: .* more than the root radius 85\.5796 mm",
        ),
        (["drive.root_rounding=0.45"], r"root_rounding = 0\.45: .* at most .* = 0\.38"),
        (["drive.roller_diameter=1"], r"rollers of 1 mm: take them larger than"),
    ],
)
def test_impossible_sets_are_refused_with_what_binds(overrides: list[str], said: str) -> None:
    """`run` says why and the nearest that would do; `check` says the same."""
    with pytest.raises(Infeasible, match=said):
        asked(TEXT, overrides)
    with pytest.raises(Infeasible, match=said):
        plan(read(TEXT, overrides))


ODD = st.one_of(st.floats(-3.0, 3.0), st.floats(-1e9, 1e9), st.sampled_from([0.0, 1e-12, 1e-3, 1e3, 1e300]))
FIELDS = {
    "z_sun": st.integers(1, 60),
    "z_planet": st.integers(1, 60),
    "z_ring": st.integers(3, 200),
    "planets": st.integers(1, 9),
    "module": st.one_of(st.floats(0.1, 10.0), ODD),
    "pressure_angle": st.one_of(st.floats(10.0, 30.0), ODD),
    "addendum": st.one_of(st.floats(0.5, 1.5), ODD),
    "root_clearance": st.one_of(st.floats(0.0, 0.5), ODD),
    "center_distance": st.one_of(st.floats(20.0, 120.0), ODD),
    "x_sun": st.one_of(st.floats(-1.0, 2.0), st.floats(-50.0, 50.0), ODD),
    "x_planet": st.one_of(st.none(), st.floats(-1.0, 2.0), st.floats(-50.0, 50.0), ODD),
    "x_ring": st.one_of(st.none(), st.floats(-1.0, 4.0), st.floats(-50.0, 50.0), ODD),
    "face_width": ODD,
    "roller_diameter": st.one_of(st.none(), st.floats(1.0, 6.0), ODD),
    "ring_cutter.z": st.integers(2, 80),
    "ring_cutter.x": ODD,
    "ring_cutter.tip_rounding": st.one_of(st.floats(0.0, 1.0), ODD),
    "fixed": st.sampled_from(["sun", "ring", "carrier"]),
    "driving": st.sampled_from(["sun", "ring", "carrier"]),
}


@pytest.mark.property
@given(data=st.data(), keys=st.sets(st.sampled_from(sorted(FIELDS)), max_size=6))
@settings(max_examples=120, deadline=None)
def test_whatever_is_written_ends_in_numbers_or_in_reasons(data: st.DataObject, keys: set[str]) -> None:
    """Numbers, or SceneFaults, or Infeasible with a reason; never another exception, never a silent nan."""
    values = {key: data.draw(FIELDS[key], key) for key in sorted(keys)}
    dropped = [key for key, value in values.items() if value is None]
    text = re.sub(rf"^({'|'.join(dropped)}) = .*\n", "", TEXT, flags=re.M) if dropped else TEXT
    overrides = [
        f"drive.{key}={value!r}".replace("'", '"') for key, value in values.items() if value is not None
    ]
    try:
        found = asked(text, overrides)
    except (SceneFaults, Infeasible):
        return
    for name, quantity in found.items():
        for value in numbers(quantity):
            assert math.isfinite(value), name


ADVISED = "the nearest that can be built: "


@pytest.mark.property
@given(
    data=st.data(),
    keys=st.sets(
        st.sampled_from(
            ["z_sun", "z_planet", "z_ring", "planets", "center_distance", "x_sun", "x_planet", "x_ring"]
        ),
        min_size=1,
        max_size=4,
    ),
)
@settings(max_examples=40, deadline=None)
def test_advice_works_when_typed_in(data: st.DataObject, keys: set[str]) -> None:
    """The numbers of the message, put back into the scene: `check` passes, or states another reason."""
    values = {key: data.draw(FIELDS[key], key) for key in sorted(keys)}
    overrides = [RIGID, 'ask.quantities=["profile"]']
    overrides += [f"drive.{key}={value!r}" for key, value in values.items() if value is not None]
    try:
        said = refusal(overrides)
    except SceneFaults:
        return
    if said is None:
        return
    advice = next((line for line in said if line.startswith(ADVISED)), None)
    if advice is None:
        assert "no set near it can be built" in said[-1] or "bore_radius" in said[0]
        return
    then = refusal(overrides + [f"drive.{each}" for each in advice.removeprefix(ADVISED).split(", ")])
    assert then is None or not any(line.startswith(ADVISED) for line in then)
    assert then is None or f"and with these: {then[0]}" in said or "base circles" in said[0]


def refusal(overrides: list[str]) -> list[str] | None:
    """Why `check` refuses the example with these overrides, None if it does not; raises SceneFaults."""
    scene: Scene[Any] = read(TEXT, overrides)
    try:
        plan(scene)
    except Infeasible as reason:
        return str(reason).splitlines()
    return None


def numbers(part: Any) -> list[float]:
    """All numbers among nested parts."""
    if isinstance(part, dict):
        return [value for inner in part.values() for value in numbers(inner)]
    if part.parts is not None:
        return numbers(part.parts)
    return [] if isinstance(part.value, str) or part.value is None else [float(part.value)]


@pytest.mark.property
def test_needs_of_the_drive_are_its_quantities() -> None:
    from trochoid.drives.planetary.answers import QUANTITIES
    from trochoid.drives.planetary.plan import STAGES_OF

    assert set(QUANTITIES) == set(NEEDS["planetary"]) == set(STAGES_OF)

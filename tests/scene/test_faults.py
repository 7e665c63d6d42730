"""Bad scenes: one clear message for each fault, at its line, and all of them at once."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.faults import Fault, SceneFaults, listed
from trochoid.kinematics.errors import SceneError
from trochoid.scene import KINDS, NEEDS, Override, Scene, load, read
from trochoid.scene.lines import key_lines
from trochoid.scene.needs import EFFECTS_OF
from trochoid.starter import starter

EFFECTS = EFFECTS_OF["khv"]


def faults_of(text: str, *overrides: str | Override) -> tuple[Fault, ...]:
    with pytest.raises(SceneFaults) as caught:
        read(text, overrides, source="s.toml")
    return caught.value.faults


@pytest.mark.property
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("pins = 20", "pinz = 20", 'drive.pinz: unknown key; did you mean "pins"?'),
        ("pins = 20", "pins = 3", "drive.pins: given 3; need a whole number from 4 to 1000"),
        ("pins = 20", "pins = 20.0", "drive.pins: given 20.0; need a whole number"),
        ("pins = 20", 'pins = "20"', 'drive.pins: given "20"; need a whole number'),
        ("pins = 20", "", "drive.pins: missing; need a whole number"),
        ("lobes = 19", "lobes = 18", "drive.lobes: given 18; need pins - 1 = 19"),
        (
            "pin_radius = 5",
            'pin_radius = "5 kg"',
            'drive.pin_radius: given "5 kg" (mass); need a length in mm',
        ),
        (
            "pin_radius = 5",
            'pin_radius = "5 mn"',
            'drive.pin_radius: given "5 mn": unknown unit "mn"; need a length',
        ),
        ("pin_radius = 5", "pin_radius = nan", "drive.pin_radius: given nan; need a finite number"),
        ("pin_radius = 5", "pin_radius = [5]", "drive.pin_radius: given a list of one; need a length in mm"),
        (
            "eccentricity = 2.5",
            "eccentricity = 0",
            "drive.eccentricity: given 0 mm; need a length greater than 0",
        ),
        ("discs = 2", "discs = true", "drive.discs: given true; need a whole number from 1 to 12"),
        ('fixed = "ring"', 'fixed = "disc"', 'drive.fixed: given "disc"; need one of "ring", "output"'),
        ('type = "khv"', 'type = "worm"', f'drive.type: given "worm"; this version knows {listed(KINDS)}'),
        ('type = "khv"', "", f"drive.type: missing; need the kind of drive: {listed(KINDS)}"),
        (
            'material = "steel"',
            'material = "stel"',
            'drive.material: no material "stel"; did you mean "steel"?',
        ),
        (
            "disc_gap = 2",
            "damping_ratio = 2",
            "drive.damping_ratio: unknown key here; it belongs to [operation]",
        ),
        (
            "input_speed = 1500",
            "input_speed = 0",
            "operation.input_speed: given 0 rpm; need a rotational speed greater",
        ),
        (
            "output_torque = 400",
            "output_torque = -1",
            "operation.output_torque: given -1 N*m; need a torque of 0 or more",
        ),
        (
            "output_torque = 400",
            'output_torque = "400 N"',
            'operation.output_torque: given "400 N" (force); need a torque',
        ),
        ("[operation]", "[operatoin]", 'operatoin: unknown key; did you mean "operation"?'),
        ("[drive.ring]", "[ring]", "ring: unknown key here; it belongs to [drive]"),
        (
            "[-22, 22]",
            "[22, -22]",
            "drive.input_shaft.bearing_positions: given 22 and -22 mm; need two places",
        ),
        (
            "[-22, 22]",
            "[-22]",
            "drive.input_shaft.bearing_positions: given a list of one; need a list of 2, each a length",
        ),
        (
            "[0.06, 0.06, 0.08]",
            "[0.06, 0, 1]",
            "casing.inertia.1: given 0 kg*m^2; need a moment of inertia greater than 0",
        ),
        (
            "[0, -10, 0]",
            "[0, -10, 0, 0]",
            "casing.center: given a list of 4; need a list of 3, each a length in mm",
        ),
        (
            'type = "inertia"',
            'type = "inertja"',
            'effects.4.type: unknown effect "inertja"; did you mean "inertia"?',
        ),
        ('type = "inertia"', 'typ = "inertia"', "effects.4.type: missing; need one of"),
        ('type = "inertia"', 'type = "clearance"', 'effects.4.type: "clearance" stands twice in effects'),
        ('"ratio"', '"ratoi"', 'ask.quantities.0: unknown quantity "ratoi"; did you mean "ratio"?'),
        (
            '"ratio"',
            '"mesh_stiffness"',
            'ask.quantities.0: "mesh_stiffness" is not offered by khv; it offers: ratio, ',
        ),
        ('"ratio"', '"mass"', 'ask.quantities.25: "mass" stands twice in ask.quantities'),
        ('"ratio"', "3", "ask.quantities.0: given 3; need a text"),
        ("positions = 60", "positions = 0", "ask.positions: given 0; need a whole number from 1 to 100000"),
        (
            "tolerance = 1e-2",
            "tolerance = 1",
            "accuracy.tolerance: given 1; need a number greater than 0 and less than 1",
        ),
        (
            "tolerance = 1e-2",
            'model = "springs"',
            'ask.quantities.8: "stress_max" is not in accuracy.model = "springs"',
        ),
        ('name = "foot"', 'name = "output bearing"', 'casing.points.1.name: "output bearing" stands twice'),
    ],
)
def test_one_mistake_gives_one_message_at_its_line(example: str, old: str, new: str, said: str) -> None:
    """Contract: one message per fault with file, line, key, what was given, what is allowed."""
    assert example.count(old) >= 1
    changed = example.replace(old, new, 1)
    found = [str(fault) for fault in faults_of(changed)]
    if new in (
        'type = "clearance"',
        'typ = "inertia"',
        "",
    ):  # what is gone is noted by others, or has no line of its own
        assert any(re.match(rf"s\.toml:\d+: {re.escape(said)}", each) for each in found), found
        return
    assert len(found) == 1, found
    where, message = found[0].split(": ", 1)
    assert message.startswith(said)
    assert (
        new in changed.splitlines()[int(where.removeprefix("s.toml:")) - 1]
        or "stands twice" in said
        or "springs" in said
    )


@pytest.mark.property
def test_missing_tables_are_named(example: str) -> None:
    """Each required table that is taken out is the one that is asked for."""
    for table in (
        "drive.output_pins",
        "drive.eccentric_bearing",
        "drive.ring",
        "drive.input_shaft",
        "operation",
        "ask",
    ):
        without = re.sub(rf"^\[{re.escape(table)}\]\n(?:[^\[\n].*\n|    .*\n|\]\n)*", "", example, flags=re.M)
        assert without != example
        assert [fault.message for fault in faults_of(without)] == [f"missing table [{table}]"]


@pytest.mark.property
def test_each_misspelt_key_is_found_with_its_right_name() -> None:
    """Every key and table of the starter without its second letter: one fault, that names the right one."""
    lines = starter("khv").splitlines()
    keys = [
        (i, m) for i, line in enumerate(lines) if (m := re.match(r"(\[+[\w.]*?|)(\w{4,})(?=\]| = )", line))
    ]
    assert len(keys) > 60
    tried = 0
    for number, match in keys:
        name = match[2]
        if name == "steel" or name == "type":  # a name of the user's own; the key that chooses the table
            continue
        start = match.start(2)
        wrong = lines[number][: start + 1] + lines[number][start + 2 :]
        if match[1].startswith("[["):
            continue  # a list may be given in several places
        found = faults_of("\n".join([*lines[:number], wrong, *lines[number + 1 :]]))
        assert [fault.message for fault in found if "unknown key" in fault.message] == [
            f'unknown key; did you mean "{name}"?'
        ], wrong
        assert found[0].where == f"s.toml:{number + 1}"
        tried += 1
    assert tried > 50


ALL_AT_ONCE = """
driv = 3                                    # BAD
[drive]
type = "khv"
pins = 20
lobes = 18                                  # BAD
pin_circle_radius = "80 kg"                 # BAD
pin_radius = "5 Nm"                         # BAD
eccentricity = 0                            # BAD
discs = 2.0                                 # BAD
face_width = "ten"                          # BAD
bore_radius = true                          # BAD
fixed = "casing"                            # BAD
materiel = "x"                              # BAD
plane = 3                                   # BAD
disc_gap = inf                              # BAD
output_pins = { count = 1, circle_radius = 52, roller_radius = "6.5" }  # BAD BAD
ring.outer_radius = "100 mm"
ring.width = -26                            # BAD

[drive.eccentric_bearing]
rollers = 16
roller_radius = [3.5]                       # BAD
roller_length = 9
[drive.input_shaft]
radius = 15
length = 70
bearing_positions = [
    -22,
    "22 s",                                 # BAD
]
bearing_stiffness = "3 N*m/rad"             # BAD
[drive.output_flange]
outer_radius = 60
thickness = 3
bearing_positions = [20, 20]                # BAD
bearing_stiffness = 3e5

[materials.steel]
poissons_ratio = 0.5                        # BAD
[materials."grey iron"]                     # BAD
youngs_modulus = 110000
poissons_ratio = 0.26

[operation]
input_speed = "25 Hz"                       # BAD
output_torque = -400                        # BAD

[casing]
mass = 0                                    # BAD
inertia = [1, 2]                            # BAD
rigid_support = "yes"                       # BAD
[[casing.mounts]]
position = [0, 0, 0]
stiffness = [1, 1, 1]
[[casing.mounts]]
position = 3                                # BAD
stiffness = [1, -1, 3]                      # BAD

[[effects]]
type = "elastic_contct"                     # BAD
[[effects]]
type = "inertia"
mass = 3                                    # BAD
[[effects]]
type = 4                                    # BAD

[ask]
quantities = [
    "ratio",
    "rato",                                 # BAD
    "vibration_zone",                       # BAD
]
positions = 0                               # BAD
[accuracy]
model = "spring"                            # BAD
"""


@pytest.mark.property
def test_all_faults_are_told_at_once() -> None:
    """A line has as many faults as it has marks BAD, others have none; in the order of the file."""
    marked = {i: line.count("BAD") for i, line in enumerate(ALL_AT_ONCE.splitlines(), 1) if "BAD" in line}
    numbers = [int(fault.where.removeprefix("s.toml:")) for fault in faults_of(ALL_AT_ONCE)]
    assert {number: numbers.count(number) for number in numbers} == marked
    assert numbers == sorted(numbers)


@pytest.mark.property
@pytest.mark.parametrize("quantity", NEEDS["khv"])
@pytest.mark.parametrize("effect", EFFECTS)
def test_quantity_without_its_effect_names_both(example: str, quantity: str, effect: str) -> None:
    """Design: a quantity that needs an effect that the scene lacks is an error that names both."""
    asked = Override(("ask", "quantities"), [quantity], f"--ask {quantity}")
    others = Override(("effects",), [{"type": each} for each in EFFECTS if each != effect], "test")
    text = example
    if effect not in NEEDS["khv"][quantity]:
        assert not read(text, [asked, others]).has(effect)
        return
    (fault,) = faults_of(text, asked, others)
    assert fault.where == f"--ask {quantity}"
    assert fault.message.startswith(f'"{quantity}" needs the effect "{effect}", which the scene lacks')


@pytest.mark.property
def test_casing_on_mounts_needs_casing_and_mounts(example: str) -> None:
    """The effect without its table, and without a mount, is a fault; points may be left out."""
    start, end = example.index("[casing]"), example.index("[[effects]]")
    (no_casing,) = faults_of(example[:start] + example[end:])
    assert no_casing.message == '"casing_on_mounts" needs the table [casing], which is missing'
    (no_mounts,) = faults_of(example, "casing.mounts=[]")
    assert no_mounts.message == '"casing_on_mounts" needs at least one [[casing.mounts]]'
    assert read(example, ["casing.points=[]"]).casing is not None


@pytest.mark.property
@pytest.mark.parametrize("model", ["level0", "strips"])
def test_elastic_models_need_elastic_contact(example: str, model: str) -> None:
    """A rung with elastic discs is refused where the scene has rigid ones; "springs" is not."""
    ask = Override(("ask", "quantities"), ["load_sharing"], "test")
    (fault,) = faults_of(example, "effects=[]", f"accuracy.model={model}", ask)
    assert fault.where == f"--set accuracy.model={model}"
    assert fault.message.startswith(f'"{model}" needs the effect "elastic_contact", which the scene lacks')
    assert read(example, ["effects=[]", "accuracy.model=springs", ask]).accuracy.model == "springs"


@pytest.mark.property
@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("a = \n[drive\npins = 3\npins = 4\nb = 'x\n", [1, 2, 4, 5]),
        ("a = [1,\nb = 2\nc = 3\n", [2]),  # the wake of the open bracket is not reported again
        ("a = 1\na = 2\nb = 00\n", [2, 3]),
        ("[drive]\r\npins = \r\n", [2]),
        ("x", [1]),
    ],
)
def test_lines_that_are_not_toml_are_listed(text: str, lines: list[int]) -> None:
    """TOML v1.0.0: bare values, duplicate keys, open brackets and quotes."""
    found = faults_of(text.replace("\r\n", "\n"))
    assert [fault.where for fault in found] == [f"s.toml:{line}" for line in lines]
    assert all(fault.message.startswith("not TOML: ") for fault in found)


@pytest.mark.property
@pytest.mark.parametrize(
    "text", ["a = " + "[" * 100_000, "a = " + "9" * 10_000, "\0", "a = 1979-05-27", "ask = 3"]
)
def test_odd_texts_are_scene_errors(text: str) -> None:
    """Nesting, digits, control characters, dates: all end as a fault."""
    assert faults_of(text)


@pytest.mark.property
def test_files_that_cannot_be_read(tmp_path: Any) -> None:
    """No such file, a folder, not UTF-8: each says so with its path."""
    binary = tmp_path / "b.toml"
    binary.write_bytes(b"\xff\xfe")
    for path, said in [
        (tmp_path / "n.toml", "no such file"),
        (tmp_path, "cannot be read"),
        (binary, "not a text in UTF-8"),
    ]:
        with pytest.raises(SceneError, match=said) as caught:
            load(path)
        assert str(caught.value).startswith(str(path))


KEYS = st.sampled_from(
    [".".join(map(str, key)) for key in key_lines(starter("khv")) if key] + ["zzz", "drive.zzz"]
)
JUNK = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=8)
    | st.sampled_from([*EFFECTS, "khv"]),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text(max_size=6) | st.just("type"), inner, max_size=3)
    ),
    max_leaves=6,
)


@pytest.mark.property
@settings(deadline=None, max_examples=300)
@given(changes=st.lists(st.tuples(KEYS, JUNK), min_size=1, max_size=3))
def test_any_content_is_a_scene_or_a_list_of_faults(changes: list[tuple[str, Any]]) -> None:
    """Whatever stands at whatever key: a Scene, or faults with a place and a message."""
    keys = [tuple(int(p) if p.isdigit() else p for p in key.split(".")) for key, _ in changes]
    overrides = [Override(key, value, "test") for key, (_, value) in zip(keys, changes, strict=True)]
    try:
        assert isinstance(read(starter("khv"), overrides), Scene)
    except SceneFaults as error:
        unclear = [
            fault for fault in error.faults if not (fault.where and fault.message) or "\n" in str(fault)
        ]
        assert not unclear

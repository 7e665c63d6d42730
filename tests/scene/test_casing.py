"""[casing]: what rigid and elastic casings demand, each fault with its key and a clear message."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.clock import Clock
from trochoid.drives.khv.stages import Stages
from trochoid.faults import SceneFaults
from trochoid.kinematics.errors import Infeasible
from trochoid.scene import Scene, load, read
from trochoid.scene.casing_faults import needed
from trochoid.scene.load import build
from trochoid.scene.needs import SEATS_OF

EXAMPLE = Path(__file__).parents[2] / "examples" / "casing.toml"
TEXT = EXAMPLE.read_text(encoding="utf-8")
NO_BOX = re.sub(r"\[casing\.box\]\n(?:.+\n)+", "", TEXT)
DRIVE, FILE = NO_BOX.split("[casing]")
FILE = FILE.replace("mesh_edge = 20", 'mesh_file = "pyproject.toml"')
for _line in ("wall", "boss", "length", "radius"):
    FILE = re.sub(rf"^{_line} = .*\n", "", FILE, flags=re.M)
FILE = f"{DRIVE}[casing]" + re.sub(r'^(name = "(?:foot|input|ring).*)$', r'\1\nset = "any"', FILE, flags=re.M)


def without(key: str) -> str:
    """Return the example without a line of [casing] or its tables."""
    start = TEXT.index("[casing]")
    return TEXT[:start] + re.sub(rf"^{key} = .*\n", "", TEXT[start:], count=1, flags=re.M)


def faults(text: str, *overrides: str, source: str = str(EXAMPLE.parents[1] / "s.toml")) -> list[str]:
    """Return the faults, each as "key: message"."""
    with pytest.raises(SceneFaults) as raised:
        read(text, overrides, source)
    return [f"{'.'.join(map(str, fault.key))}: {fault.message}" for fault in raised.value.faults]


@pytest.mark.property
def test_box_and_file_are_read() -> None:
    """The example has a box; the place of a mesh file is relative to the scene's."""
    box = load(EXAMPLE).casing
    assert box is not None
    assert box.box is not None
    assert box.elastic
    assert box.mass is None
    assert box.box.size == (0.28, 0.26, 0.14)
    assert box.bores[0].seats == ("input shaft A", "input shaft B")
    found = read(FILE, source=str(EXAMPLE.parents[1] / "s.toml")).casing
    assert found is not None
    assert found.mesh_file == str(EXAMPLE.parents[1] / "pyproject.toml")


@pytest.mark.property
@pytest.mark.parametrize(
    ("text", "override", "said"),
    [
        (TEXT, "casing.mass=3", "casing.mass: an elastic casing has it from its body; take it away, or take elastic"),
        (TEXT, "casing.center=[0,0,1]", "casing.center: an elastic casing has it from its body"),
        (TEXT, 'casing.mesh_file="a.msh"', "casing.mesh_file: an elastic casing is a box or read from a file"),
        (TEXT, 'casing.mesh_unit="m"', "casing.mesh_unit: only a casing from a file has it"),
        (FILE, "casing.mesh_edge=3", "casing.mesh_edge: only a casing of a box has it"),
        (FILE, 'casing.mesh_file="no.msh"', "casing.mesh_file: no such file: "),
        (NO_BOX, "", "casing.elastic: an elastic casing needs the table [casing.box]"),
        (without("damping_ratio"), "", "casing.damping_ratio: missing; need the damping ratio of elastic modes"),
        (TEXT, "casing.damping_ratio=1", "casing.damping_ratio: given 1; need a number of 0 or more and less than 1"),
        (TEXT, 'casing.material="cast_irn"', 'casing.material: no material "cast_irn"; did you mean "cast_iron"?'),
        (TEXT, "casing.material=foo", 'casing.material: no material "foo"; known: cast_iron, steel. Or add the table'),
        (without("elastic"), "", "casing.box: only an elastic casing has it: add elastic = true"),
        (without("elastic"), "", "casing.mounts.0.radius: only an elastic casing has it"),
        (without("elastic"), "", "casing.inertia: missing; need a list of 3, each a moment of inertia"),
        (without("wall"), "", "casing.box.wall: missing; need a length in mm"),
        (TEXT, "casing.points=[]", "casing.points: an elastic casing is read on its surface"),
        (TEXT, "casing.points.0.name=casing_frequencies", "casing.points.0.name: "),
        (TEXT, "casing.bores=[]", 'casing.bores: no bore holds "ring", "input shaft A", '),
        (TEXT, 'casing.bores.1.holds=["ring","output flange A"]', 'casing.bores: no bore holds "output flange B"'),
        (TEXT, 'casing.bores.0.holds=["sun"]', 'casing.bores.0.holds.0: "sun" is no place where khv drives'),
        (TEXT, "casing.bores.0.holds=[]", 'casing.bores.0.name: "input cover" is no place where khv drives'),
        (TEXT, "casing.bores.0.wall=left", 'casing.bores.0.wall: given "left"; need one of "low", "high"'),
        (TEXT, "casing.bores.0.set=a", "casing.bores.0.set: only a casing from a file has it"),
        (TEXT, "casing.bores.0.name=foot 1", 'casing.mounts.0.name: "foot 1" stands twice among bores and mounts'),
        (TEXT.replace('name = "foot 2"\n', ""), "", "casing.mounts.1.name: missing; need the name of the place"),
        (TEXT.replace("radius = 12\n", "", 1), "", "casing.mounts.0.radius: missing; in a box casing, need a length"),
        (FILE, "casing.bores.0.wall=low", "casing.bores.0.wall: only a casing of a box has it"),
        (FILE, "casing.bores.0.radius=3", "casing.bores.0.radius: the place is a set of the mesh file's"),
        (FILE.replace('set = "any"\n', "", 1), "", "casing.bores.0.point: missing; in a casing from a file a place is"),
        (FILE, "casing.bores.0.direction=[0,0,0]", "casing.bores.0.direction: given 0, 0, 0; need a direction"),
        (FILE, "casing.bores.0.span=[3,1]", "casing.bores.0.span: given 3 and 1 mm; need two places, the lower first"),
    ],
)  # fmt: skip
def test_each_fault_is_named(text: str, override: str, said: str) -> None:
    """What an elastic or a rigid casing lacks, or cannot have, is said at its key."""
    found = faults(text, *([override] if override else []))
    assert any(each.startswith(said) for each in found), found


@pytest.mark.property
def test_a_third_bore_of_one_place_is_refused() -> None:
    """Two bores share a place; a third would make the shares undetermined."""
    three = ['holds = ["ring", "input shaft A", "input shaft B", "output flange A", "output flange B"]'] * 3
    text = TEXT[: TEXT.index("[[casing.bores]]")] + "".join(
        f'[[casing.bores]]\nname = "{i}"\n{holds}\nwall = "low"\nradius = 3\nboss = 5\nlength = 15\n'
        for i, holds in enumerate(three)
    )
    text += TEXT[TEXT.index("[[casing.mounts]]") :]
    assert any('"ring" is held a third time' in each for each in faults(text))


@pytest.mark.property
def test_what_floats_needs_no_bore() -> None:
    """A sun without a bearing presses nothing; fixed, or without compliant bearings, it does."""
    compliant = {"effects": [{"type": "bearing_compliance"}]}
    assert needed("planetary", {"drive": {}, **compliant}) == ("ring", "carrier")
    assert needed("planetary", {"drive": {"fixed": "sun"}, **compliant}) == SEATS_OF["planetary"]
    given_ = {"drive": {"sun": {"bearing_stiffness": 5}, "carrier": {"bearing_stiffness": 0}}, **compliant}
    assert needed("planetary", given_) == ("sun", "ring")
    assert needed("planetary", {"drive": {}}) == SEATS_OF["planetary"]


@pytest.mark.property
@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("casing.box.wall=80", "leave nothing between walls"),
        ("casing.bores.1.boss=125", "the boss of ring and output, radius 125 mm at y = 0 mm, meets a wall"),
        ("casing.mounts.0.position=[-400,-130,0]", "foot 1, radius 12 mm, is not on the base plate"),
        ("casing.bores.0.length=5", "the seat of input cover is 5 mm long"),
        ("casing.mounts.0.position=[-150,-100,-50]", "a box stands on its underside; give y = -130 mm"),
        ("casing.points.0.position=[0,500,0]", "the point cover at 0, 500, 0 mm is 370 mm off the body"),
        ("casing.mesh_edge=1000", "give mesh_edge = 46.66 mm or less"),
        ("casing.mesh_edge=0.1", "need more than 64 GiB of memory; give mesh_edge = 1.8 mm or more"),
    ],
)
def test_a_box_that_cannot_be_is_refused_before_anything_is_meshed(override: str, said: str) -> None:
    """The stage that asks whether the drive can be made names the measure; `trochoid check` runs it."""
    made = Stages(load(EXAMPLE, [override]), Clock())
    with pytest.raises(Infeasible, match=re.escape(said)):
        made.feasible  # noqa: B018
    assert set(made.clock.seconds) == {"kinematics", "geometry"}


VALUES: list[Any] = [
    None,
    True,
    "text",
    -1.0,
    0,
    5.0,
    [],
    [1.0, 2.0],
    [0, 0, 1],
    ["ring"],
    {},
    {"name": "ring"},
    "1 kg",
]
KEYS = [
    "elastic",
    "box",
    "mesh_file",
    "bores",
    "mounts",
    "points",
    "mass",
    "inertia",
    "damping_ratio",
    "material",
    "odd",
]
INNER = [
    "name",
    "holds",
    "wall",
    "radius",
    "boss",
    "set",
    "point",
    "direction",
    "span",
    "normal",
    "position",
    "size",
]


@pytest.mark.property
@given(
    st.lists(st.tuples(st.sampled_from(KEYS), st.sampled_from(VALUES)), max_size=3),
    st.lists(
        st.tuples(st.sampled_from(["bores", "mounts"]), st.sampled_from(INNER), st.sampled_from(VALUES)),
        max_size=3,
    ),
)
@settings(max_examples=150, deadline=None)
def test_whatever_is_written(outer: list[tuple[str, Any]], inner: list[tuple[str, str, Any]]) -> None:
    """The result is a scene, or faults that each have a key and a text; never another exception. None: left out."""
    raw = tomllib.loads(TEXT)
    casing = raw["casing"]
    for table, key, value in inner:
        _put(casing[table][0], key, value)
    for key, value in outer:
        _put(casing, key, value)
    scene, found = build(raw)
    assert isinstance(scene, Scene) == (not found)
    assert all(key and text for key, text in found)
    if scene is not None and scene.casing is not None and scene.casing.elastic:
        assert {n for b in scene.casing.bores for n in b.seats} == set(SEATS_OF["khv"])


def _put(table: dict[str, Any], key: str, value: Any) -> None:
    if value is None:
        table.pop(key, None)
    else:
        table[key] = value

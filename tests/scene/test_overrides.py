from __future__ import annotations

import math

import pytest

from trochoid.faults import SceneFaults
from trochoid.scene import Override, Scene, read


@pytest.mark.exact
@pytest.mark.parametrize(
    ("override", "path", "si"),
    [
        ("drive.pin_radius=4.5", "drive.pin_radius", 0.0045),
        ("drive.pin_radius=4.5 mm", "drive.pin_radius", 0.0045),
        ('drive.pin_radius="0.25 in"', "drive.pin_radius", 0.00635),
        ("drive.fixed=output", "drive.fixed", "output"),
        ("drive.output_pins.phase = 90", "drive.output_pins.phase", math.pi / 2),
        ("casing.mounts.2.stiffness.1=9", "casing.mounts.2.stiffness.1", 9000.0),
        ("casing.mounts.0.stiffness=[1, 2, 3]", "casing.mounts.0.stiffness", (1e3, 2e3, 3e3)),
        ("casing.rigid_support=true", "casing.rigid_support", True),
        ("ask.quantities=['mass']", "ask.quantities", ("mass",)),
        ("accuracy.model=level0", "accuracy.model", "level0"),
        (
            "materials.bronze={youngs_modulus=110000, poissons_ratio=0.34, density=8800}",
            "materials.bronze.density",
            8800.0,
        ),
        ("materials.steel.density=7700", "materials.steel.density", 7700.0),
        ("materials.steel.density=7700", "materials.steel.youngs_modulus", 210e9),
    ],
)
def test_override_replaces_one_value(example: str, override: str, path: str, si: object) -> None:
    """The value is TOML, else a plain text; entries of lists are counted from 0."""
    scene = read(example, [override])
    value: object = scene
    for part in path.split("."):
        if isinstance(value, tuple):
            value = value[int(part)]
        else:
            value = value[part] if isinstance(value, dict) else getattr(value, part)
    assert value == si


@pytest.mark.property
def test_lobes_follow_pins_when_left_out(example: str) -> None:
    """Without `lobes` there is one less than pins, whatever replaces them; the last override holds."""
    text = example.replace("lobes = 19\n", "")
    assert read(text).drive.lobes == 19
    assert read(text, ["drive.pins=20", "drive.pins=31"]).drive.lobes == 30


@pytest.mark.property
@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("drive.pinz=3", '--set drive.pinz=3: unknown key; did you mean "pins"?'),
        ("driv.pins=3", '--set driv.pins=3: driv: unknown key; did you mean "drive"?'),
        ("drive.pin_radius=64 kg", '--set drive.pin_radius=64 kg: given "64 kg" (mass); need a length in mm'),
        (
            "drive.pin_radius=[1, 2",
            '--set drive.pin_radius=[1, 2: given the text "[1, 2"; need a length in mm',
        ),
        ("drive.pin_radius=1\ndrive.pins=3", "--set drive.pin_radius=1\\ndrive.pins=3: given"),
        ("drive.pins.x=3", '--set drive.pins.x=3: drive.pins is 20, which has no "x"'),
        (
            "casing.mounts.4.x=1",
            '--set casing.mounts.4.x=1: casing.mounts has 4 entries, numbers 0 to 3; there is no "4"',
        ),
        ("casing.mounts.first=1", "--set casing.mounts.first=1: casing.mounts has 4 entries, numbers 0 to 3"),
        (
            "casing.points=[{name='a'}]",
            "--set casing.points=[{name='a'}]: casing.points.0.position: missing; need a list",
        ),
        (
            "drive.output_pins={count=8}",
            "--set drive.output_pins={count=8}: drive.output_pins.circle_radius: missing",
        ),
        ("drive.pins", "--set drive.pins: need KEY=VALUE with a dotted key"),
        ("=3", "--set =3: need KEY=VALUE with a dotted key"),
        ("a b=3", "--set a b=3: need KEY=VALUE with a dotted key"),
        ("a=1\nb=3", "--set a=1\\nb=3: unknown key"),
        ("drive.pins=30", "s.toml:7: drive.lobes: given 19; need pins - 1 = 29"),
    ],
)
def test_fault_names_the_override(example: str, override: str, said: str) -> None:
    """A fault that came with --set names it in place of a line; what it breaks elsewhere keeps its line."""
    with pytest.raises(SceneFaults) as caught:
        read(example, [override], source="s.toml")
    assert str(caught.value.faults[0]).startswith(said)


@pytest.mark.property
def test_override_leaves_no_trace(example: str) -> None:
    """An override of a list entry does not change the value handed in."""
    mounts = [{"position": [0, 0, 0], "stiffness": [1, 1, 1]}]
    scene = read(example, [Override(("casing", "mounts"), mounts, "test"), "casing.mounts.0.stiffness.0=5"])
    assert isinstance(scene, Scene)
    assert scene.casing is not None
    assert scene.casing.mounts[0].stiffness == (5e3, 1e3, 1e3)
    assert mounts == [{"position": [0, 0, 0], "stiffness": [1, 1, 1]}]

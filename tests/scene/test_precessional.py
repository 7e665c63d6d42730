"""Scenes of precessional drives: what is valid, what is refused and with which words."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.faults import SceneFaults, dotted
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.run import Run, plan
from trochoid.scene import NEEDS, Override, load, read
from trochoid.starter import starter

EXAMPLE = Path(__file__).parents[2] / "examples" / "precessional.toml"
TEXT = EXAMPLE.read_text(encoding="utf-8")


def changed(**values: Any) -> list[Override]:
    """Return overrides; double underscores stand for dots."""
    return [Override(tuple(name.split("__")), value, name) for name, value in values.items()]


@pytest.mark.property
def test_example_asks_for_everything() -> None:
    """Shipped scene: all quantities, SI inside, teeth inside the pins by default."""
    scene = load(EXAMPLE)
    assert scene.ask.quantities == tuple(NEEDS["precessional"])
    assert scene.drive.nutation_angle == pytest.approx(math.radians(2.5), rel=1e-15)
    assert scene.drive.satellite.bearing_distance == 0.045
    assert scene.drive.counterweight is not None
    assert scene.drive.counterweight.radius is None
    assert scene.drive.teeth is not None
    assert plan(scene).model == "slices"
    assert plan(load(EXAMPLE, changed(effects=[], ask__quantities=["ratio"]))).model == "closed forms"


@pytest.mark.property
def test_tables_that_may_be_left_out() -> None:
    """No teeth, no counterweight, no output shaft, no casing: still a scene, and one that runs."""
    text = re.sub(r"\[drive\.teeth\][^\[]*", "", TEXT)
    text = re.sub(r"# without a radius[^\n]*\n\[drive\.counterweight\][^\[]*", "", text)
    text = re.sub(r"\[casing\].*?\[\[effects\]\]", "[[effects]]", text, flags=re.S)
    text = re.sub(r"\[\[effects\]\]\ntype = \"casing_on_mounts\"", "", text)
    asked = [name for name, needs in NEEDS["precessional"].items() if "casing_on_mounts" not in needs]
    scene = read(text, [Override(("ask", "quantities"), asked, "--ask")])
    assert scene.drive.teeth is None
    assert scene.drive.counterweight is None
    assert scene.casing is None
    found = Run(scene).outcome
    assert tuple(found.quantities) == tuple(asked)
    assert found.quantities["profile"].value == "no teeth given"
    assert all(check.ok for check in found.checks)


@pytest.mark.property
@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("z_wheel = 15", "z_wheel = 1", "drive.z_wheel: given 1; need a whole number from 2 to 1000"),
        ("z_wheel = 15", "z_weel = 15", 'drive.z_weel: unknown key; did you mean "z_wheel"?'),
        ("z_satellite = 14", "z_satellite = 15", "drive.z_satellite: given 15, as many as z_wheel"),
        (
            "z_satellite = 14",
            "z_satellite = 12",
            "drive.teeth: z_wheel = 15 and z_satellite = 12: .* take z_satellite = 14",
        ),
        ("z_satellite = 14", "z_satellite = 14.5", "drive.z_satellite: given 14.5; need a whole number"),
        (
            "nutation_angle = 2.5",
            "nutation_angle = 0",
            "drive.nutation_angle: given 0 deg; need an angle of 1e-06 or more",
        ),
        (
            "nutation_angle = 2.5",
            "nutation_angle = 90",
            "drive.nutation_angle: given 90 deg; .* less than 90",
        ),
        (
            "nutation_angle = 2.5",
            'nutation_angle = "2 mm"',
            r'drive.nutation_angle: given "2 mm" \(length\); need an',
        ),
        ("mass = 2\n", "mass = 0\n", "drive.satellite.mass: given 0 kg; need a mass greater than 0"),
        ("mass = 1.2", "mass = -1.2", "drive.input_shaft.mass: given -1.2 kg; need a mass greater than 0"),
        ("mass = 0.15", "mass = 0", "drive.counterweight.mass: given 0 kg; need a mass greater than 0"),
        ("center = 40", 'center = "40 kg"', r'drive.satellite.center: given "40 kg" \(mass\); need a length'),
        (
            "center = 40",
            "center = 60",
            r"drive.satellite.inertia: .* they are about O.* must be at least 0.0144",
        ),
        (
            "inertia = [5.3e-3, 5.1e-3, 3.6e-3]",
            "inertia = [5.3e-3, 5.1e-3, 12e-3]",
            "drive.satellite.inertia: .*no body has these; the moment about z must be at most .* 0.0104",
        ),
        (
            "inertia = [5.3e-3, 5.1e-3, 3.6e-3]",
            "inertia = [9.3e-3, 5.1e-3, 3.6e-3]",
            "drive.satellite.inertia: .*no body has these; the moment about x must be at most .* 0.0087",
        ),
        (
            "inertia = [5.3e-3, 5.1e-3, 3.6e-3]",
            "inertia = [5.3e-3, 5.1e-3]",
            "drive.satellite.inertia: given a list of 2; need a list of 3",
        ),
        ("bearing_distance = 45", "bearing_distance = 0", "drive.satellite.bearing_distance: given 0 mm"),
        ("bearing_distance = 110", "", "drive.input_shaft.bearing_distance: missing; need a length"),
        ("polar_angle = 70", "polar_angle = 91", "drive.teeth.polar_angle: given 91 deg; .* at most 90"),
        (
            "pin_angle = 5",
            "pin_angle = -5",
            "drive.teeth.pin_angle: given -5 deg; need an angle greater than 0",
        ),
        (
            "outer_radius = 75",
            "outer_radius = 55",
            "drive.teeth.outer_radius: given 55 mm; .* inner_radius = 60 mm",
        ),
        ('pins_on = "ring"', 'pins_on = "wheel"', 'drive.teeth.pins_on: given "wheel"; need one of "ring"'),
        (
            'type = "inertia"',
            'type = "friction"',
            "effects.4.type: .friction. is not an effect of precessional",
        ),
        ('"balance"', '"backlash"', "ask.quantities.16: .backlash. is not offered by precessional"),
        (
            'type = "elastic_contact"',
            'type = "inertia"',
            'ask.quantities.5: "load_sharing" needs the effect "elastic_contact"',
        ),
        ("crown = 0.01", "crown = -0.01", "drive.rollers.crown: given -0.01 mm; need a length of 0 or more"),
        ("crown = 0.01", "hub = 50", "drive.rollers.hub: unknown key"),
        (
            "[operation]",
            "[drive.rim]\nweb_inner_radius = 70\nweb_outer_radius = 65\n[operation]",
            "drive.rim.web_outer_radius: given 65 mm; need more than web_inner_radius = 70 mm",
        ),
        (
            'kind = "cylindrical"',
            'kind = "roller"',
            'drive.bearing_a.kind: given "roller"; need one of "deep_groove"',
        ),
        ("outside = 42", "outside = 19", "drive.bearing_a: given outside = 19 mm; need more than bore = 20"),
        ("outside = 42\n", "", 'drive.bearing_a: kind = "cylindrical" needs outside too'),
        (
            'kind = "deep_groove"\nbore = 30',
            "bore = 30",
            "drive.bearing_b: no stiffness; need radial_stiffness, or",
        ),
        ('kind = "deep_groove"', 'kind = "tapered"', "drive.bearing_b: .*nothing without an axial load"),
        ("spread = 30", "spread = -30", "drive.bearing_b.spread: given -30 mm; need a length of 0 or more"),
        (
            "radial_load = 2000",
            'radial_load = "2 mm"',
            r'drive.bearing_a.radial_load: given "2 mm" \(length\); need a force',
        ),
        (
            "radial_stiffness = 50000",
            "radial_stiffness = 50000\nbearing_stiffness = 1e5",
            "drive.joint_o: bearing_stiffness needs the mass of the output shaft",
        ),
        ("radial_stiffness = 50000", "", "drive.joint_o.radial_stiffness: missing; need a stiffness in N/mm"),
        (
            "[operation]",
            '[accuracy]\nmodel = "strips"\n[operation]',
            'accuracy.model: "strips" is not a model of precessional drives; it has "slices"',
        ),
    ],
)
def test_faults(old: str, new: str, said: str) -> None:
    """One mistake, its message at its key."""
    assert old in TEXT
    with pytest.raises(SceneFaults) as caught:
        read(TEXT.replace(old, new, 1))
    texts = [f"{dotted(fault.key)}: {fault.message}" for fault in caught.value.faults]
    assert any(re.match(said, text) for text in texts), texts


@pytest.mark.property
@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"drive__nutation_angle": 9.0}, r"nutation_angle = 9°: out of range.* nearest feasible .* 8\.7119°"),
        (
            {"drive__teeth__pin_angle": 9.0},
            r"pin_angle = 9°: the flank is undercut; .* 8\.50875°, or .* 2\.2789°",
        ),
        ({"drive__teeth__pin_angle": 12.0}, r"pin_angle = 12°: neighbouring pins overlap; .* 11\.2665°"),
        ({"drive__teeth__lobed_member": "outside"}, r"pin_angle = 5°: the flank is undercut; .* 3\.32619°"),
    ],
)
def test_teeth_that_cannot_be_made(values: dict[str, Any], said: str) -> None:
    """`check` and `run` refuse them with the limit; the pair that is proposed at the end can be made."""
    scene = read(TEXT, changed(**values))
    with pytest.raises(Infeasible) as refusal:
        plan(scene)
    lines = str(refusal.value).splitlines()
    assert any(re.match(said, line) for line in lines), lines
    with pytest.raises(Infeasible, match="nearest pair"):
        _ = Run(scene).profile
    found = dict(re.findall(r"(nutation_angle|teeth\.\w+) = ([\d.]+)", lines[-1]))
    assert sorted(found) == ["nutation_angle", "teeth.pin_angle", "teeth.polar_angle"]
    proposed = {f"drive__{key.replace('.', '__')}": float(value) for key, value in found.items()}
    plan(read(TEXT, changed(**values | proposed)))


@pytest.mark.property
def test_other_arrangements_of_the_same_angles() -> None:
    """Lobes on the other side, or pins on the other member, are offered where they can be made, and only then."""
    wrong = changed(drive__teeth__lobed_member="outside")
    with pytest.raises(Infeasible) as refusal:
        plan(read(TEXT, wrong))
    said = re.findall(r'pins_on = "(\w+)" with lobed_member = "(\w+)"', str(refusal.value))
    assert said == [("ring", "inside"), ("satellite", "outside")]
    for pins_on, lobed in said:
        plan(read(TEXT, changed(drive__teeth__pins_on=pins_on, drive__teeth__lobed_member=lobed)))
    with pytest.raises(Infeasible):
        plan(read(TEXT, changed(drive__teeth__pins_on="satellite", drive__teeth__lobed_member="inside")))


@pytest.mark.property
def test_ratio_needs_no_teeth_that_can_be_made() -> None:
    """What does not touch the teeth is answered all the same."""
    run = Run(read(TEXT, changed(drive__nutation_angle=9.0)))
    assert run.ratio.value == -14.0
    assert run.member_speeds.parts is not None


OPEN = ("bearing_life",)  # takes the teeth's forces where they are known
CLOSED = [
    name
    for name, needs in NEEDS["precessional"].items()
    if "elastic_contact" not in needs and name not in OPEN
]
number = st.floats(-1e3, 1e3) | st.floats(0.0, 10.0)
anything = (
    number | st.integers(-3, 40) | st.sampled_from(["ring", "5 mm", "2 kg", "x", True, None, [1.0, 2.0]])
)


@pytest.mark.property
@given(
    teeth=st.tuples(st.integers(1, 40), st.integers(-2, 2)),
    angles=st.tuples(st.floats(0.01, 12.0), st.floats(5.0, 90.0), st.floats(0.05, 20.0)),
    on=st.sampled_from(["ring", "satellite"]),
    key=st.sampled_from(
        [
            "satellite__mass",
            "satellite__center",
            "satellite__bearing_distance",
            "input_shaft__mass",
            "input_shaft__offset",
            "input_shaft__bearing_distance",
            "counterweight__radius",
            "counterweight__z",
            "teeth__inner_radius",
            "input_shaft__center",
            "bearing_a__radial_load",
            "bearing_a__clearance",
            "bearing_b__spread",
            "bearing_b__axial_load",
            "bearing_b__tilt_stiffness",
            "joint_o__radial_stiffness",
        ]
    ),
    value=anything,
)
@settings(max_examples=40, deadline=None)
def test_whatever_is_written(
    teeth: tuple[int, int], angles: tuple[float, float, float], on: str, key: str, value: Any
) -> None:
    """The result is numbers, or faults, or a refusal with its reason; never another exception."""
    values = {
        "drive__z_wheel": teeth[0],
        "drive__z_satellite": teeth[0] + teeth[1],
        "drive__nutation_angle": angles[0],
        "drive__teeth__polar_angle": angles[1],
        "drive__teeth__pin_angle": angles[2],
        "drive__teeth__pins_on": on,
        f"drive__{key}": value,
    }
    reason = ""
    try:
        run = Run(read(TEXT, changed(**values)))
        quantities = [run.quantity(name) for name in CLOSED]
    except (SceneFaults, Infeasible) as refusal:
        reason = str(refusal)
        quantities = []
    assert reason or quantities
    assert all(math.isfinite(leaf) for quantity in quantities for leaf in leaves(quantity))


def leaves(quantity: Any) -> list[float]:
    """Return all numbers of a quantity."""
    parts = quantity.parts if hasattr(quantity, "parts") else quantity
    if parts is not None:
        return [leaf for part in parts.values() for leaf in leaves(part)]
    return [quantity.value] if isinstance(quantity.value, float) else []


@pytest.mark.property
def test_starter_is_the_reference_too() -> None:
    """The starter runs, with a lighter answer on its own mounts."""
    run = Run(read(starter("precessional")))
    assert run.ratio.value == -14.0
    assert leaves(run.vibration_velocity)


@pytest.mark.property
def test_resonance_without_damping_is_named() -> None:
    """A casing whose natural frequency the shaft hits, undamped, has no answer."""
    speed = 1430.0 * math.pi / 30.0
    mount = {"position": [0, 0, 0], "stiffness": [f"{25.0 * speed**2!r} N/m"] * 3}
    light = changed(drive__counterweight__radius=10.0, casing__mounts=[mount], casing__center=[0, 0, 0])
    with pytest.raises(TrochoidError, match="coincides with a natural frequency"):
        _ = Run(read(TEXT, light)).vibration_velocity

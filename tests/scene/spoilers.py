"""Ways to spoil a scene that is sound, each with the key or the reason that must be named."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.scene.random_drives import Tables, scene_of
from trochoid.drives.khv.design import Design, design
from trochoid.faults import listed, nearest
from trochoid.kinematics.cycloid import Cycloid
from trochoid.scene import KINDS, NEEDS
from trochoid.scene.needs import EFFECTS_OF, UNDER_TORQUE

LENGTHS = tuple(
    f"drive.{key}"
    for key in (
        *("pin_circle_radius", "pin_radius", "eccentricity", "face_width", "disc_gap", "bore_radius"),
        *("output_pins.circle_radius", "output_pins.roller_radius", "output_pins.hole_clearance"),
        *("eccentric_bearing.roller_radius", "eccentric_bearing.roller_length", "ring.outer_radius"),
        *(
            "input_shaft.radius",
            "input_shaft.length",
            "output_flange.outer_radius",
            "output_flange.thickness",
        ),
    )
)
OTHERS = {  # key: (noun, unit of another dimension, a value out of range)
    "drive.input_shaft.bearing_stiffness": ("a stiffness", "N/m^2", 0),
    "drive.output_pins.phase": ("an angle", "mm", None),
    "operation.input_speed": ("a rotational speed", "N", -1500),
    "operation.output_torque": ("a torque", "N", -400.0),
    "operation.damping_ratio": ("a number", None, 1.0),
    "casing.mass": ("a mass", "mm", -1),
    "accuracy.tolerance": ("a number", None, 2),
}
WHOLE = {
    "drive.pins": (3, 1001),
    "drive.discs": (0, 13),
    "drive.output_pins.count": (2, 101),
    "drive.eccentric_bearing.rollers": (2, 201),
    "ask.positions": (0, 100_001),
}
WORDS = {"drive.fixed": '"ring", "output"', "drive.type": listed(KINDS)}
TABLES = (
    "drive.output_pins",
    "drive.eccentric_bearing",
    "drive.ring",
    "drive.input_shaft",
    "operation",
    "ask",
)

EFFECTS = EFFECTS_OF["khv"]


@dataclass(frozen=True)
class Refusal:
    """What must be said: at which key, and a pattern in the message; `built` if only the geometry is wrong."""

    key: str
    said: str
    built: bool = False


Spoiler = Callable[[np.random.Generator, Tables], Refusal]


def put(raw: Tables, key: str, value: Any) -> None:
    """Put a value at a dotted key."""
    *tables, last = key.split(".")
    for table in tables:
        raw = raw[table]
    raw[last] = value


def taken(raw: Tables, key: str) -> Any:
    """Return what stands at a dotted key, and take it away."""
    *tables, last = key.split(".")
    for table in tables:
        raw = raw[table]
    return raw.pop(last)


def one_of(rng: np.random.Generator, some: Any) -> Any:
    """Return one of a sequence's values, of its own type."""
    return list(some)[int(rng.integers(len(some)))]


def wrong_type(rng: np.random.Generator, raw: Tables) -> Refusal:
    key = one_of(rng, (*LENGTHS, *OTHERS, *WHOLE, *WORDS))
    put(
        raw,
        key,
        one_of(rng, [True, [], [1, 2], {}, {"a": 1}, "", "twelve", math.nan, math.inf, -math.inf, None]),
    )
    return Refusal(key, "^given .*; (need|this version knows) ")


def wrong_dimension(rng: np.random.Generator, raw: Tables) -> Refusal:
    key = one_of(rng, (*LENGTHS, *(k for k, v in OTHERS.items() if v[1])))
    noun, unit = (
        ("a length", one_of(rng, ["kg", "N", "rad", "s", "MPa"])) if key in LENGTHS else OTHERS[key][:2]
    )
    put(raw, key, f"5 {unit}")
    return Refusal(key, rf'^given "5 {re.escape(str(unit))}" \(.*; need {noun}')


def unknown_unit(rng: np.random.Generator, raw: Tables) -> Refusal:
    key, unit = one_of(rng, LENGTHS), one_of(rng, ["mn", "milimeter", "parsnip", "m m", "mm^^2"])
    put(raw, key, f"5 {unit}")
    return Refusal(key, "given .*need a length")


def misspelt_key(rng: np.random.Generator, raw: Tables) -> Refusal:
    key = one_of(rng, (*LENGTHS, *OTHERS, *WHOLE))
    table, name = key.rsplit(".", 1)
    i = int(rng.integers(1, len(name) - 1))
    wrong = one_of(
        rng, [name[:i] + name[i + 1 :], name[:i] + name[i - 1] + name[i:], name[:i] + "x" + name[i + 1 :]]
    )
    if wrong == name or len(name) < 4:
        return misspelt_key(rng, raw)
    put(raw, f"{table}.{wrong}", taken(raw, key))
    return Refusal(f"{table}.{wrong}", rf'^unknown key.*did you mean "{name}"\?')


def key_elsewhere(rng: np.random.Generator, raw: Tables) -> Refusal:
    key, table = one_of(
        rng, [("drive.pins", "operation"), ("operation.input_speed", "drive"), ("drive.pin_radius", "ask")]
    )
    name = key.rsplit(".", 1)[1]
    put(raw, f"{table}.{name}", taken(raw, key))
    return Refusal(f"{table}.{name}", rf"^unknown key here; it belongs to \[{key.rsplit('.', 1)[0]}\]")


def missing_key(rng: np.random.Generator, raw: Tables) -> Refusal:
    free: tuple[str, ...] = (
        "drive.disc_gap",
        "drive.discs",
        "drive.output_pins.phase",
        "drive.output_pins.hole_clearance",
    )
    free += ("operation.damping_ratio", "accuracy.tolerance", "ask.positions", "drive.type")
    key = one_of(rng, [k for k in (*LENGTHS, *OTHERS, *WHOLE) if k not in free])
    taken(raw, key)
    return Refusal(key, "^missing; need ")


def missing_table(rng: np.random.Generator, raw: Tables) -> Refusal:
    key = one_of(rng, TABLES)
    taken(raw, key)
    return Refusal(key, rf"^missing table \[{key}\]")


def out_of_range(rng: np.random.Generator, raw: Tables) -> Refusal:
    key = one_of(rng, (*LENGTHS, *(k for k, v in OTHERS.items() if v[2] is not None), *WHOLE))
    value = -1e-6 if key in LENGTHS else one_of(rng, WHOLE[key]) if key in WHOLE else OTHERS[key][2]
    put(raw, key, value)
    return Refusal(key, rf"^given {re.escape(f'{value}')}.*; need a ")


def wrong_word(rng: np.random.Generator, raw: Tables) -> Refusal:
    key = one_of(rng, WORDS)
    put(raw, key, one_of(rng, ["rings", "RING", "cycloid", "x"]))
    return Refusal(key, re.escape(WORDS[key]))


def wrong_lobes(rng: np.random.Generator, raw: Tables) -> Refusal:
    pins = raw["drive"]["pins"]
    raw["drive"]["lobes"] = max(3, pins - int(rng.integers(2, 5))) if pins > 4 else pins
    return Refusal("drive.lobes", rf"need pins - 1 = {pins - 1}")


def effect_missing(rng: np.random.Generator, raw: Tables) -> Refusal:
    name = one_of(rng, [name for name, needs in NEEDS["khv"].items() if needs and name not in UNDER_TORQUE])
    effect = one_of(rng, NEEDS["khv"][name])
    raw["effects"] = [{"type": each} for each in EFFECTS if each != effect]
    raw["ask"]["quantities"] = ["ratio", name]
    return Refusal("ask.quantities.1", rf'^"{name}" needs the effect "{effect}", which the scene lacks')


def unknown_quantity(rng: np.random.Generator, raw: Tables) -> Refusal:
    name = str(one_of(rng, [each for each in NEEDS["khv"] if len(each) > 5]))
    i = int(rng.integers(1, len(name) - 1))
    wrong = name[:i] + name[i + 1 :]
    raw["ask"]["quantities"] = [wrong]
    assert nearest(wrong, tuple(NEEDS["khv"])) == name
    return Refusal("ask.quantities.0", rf'^unknown quantity "{wrong}"; did you mean "{name}"\?')


def unknown_effect(rng: np.random.Generator, raw: Tables) -> Refusal:
    name = str(one_of(rng, EFFECTS))
    wrong = name[:-2] + name[-1]
    raw["effects"], raw["ask"]["quantities"] = [{"type": wrong}], ["ratio"]
    return Refusal("effects.0.type", rf'^unknown effect "{wrong}"; did you mean "{name}"\?')


def named_twice(rng: np.random.Generator, raw: Tables) -> Refusal:
    if rng.random() < 0.5:
        raw["ask"]["quantities"] = ["ratio", "mass", "ratio"]
        return Refusal("ask.quantities.2", '^"ratio" stands twice')
    raw["effects"] = [{"type": "clearance"}, {"type": "clearance"}]
    raw["ask"]["quantities"] = ["ratio"]
    return Refusal("effects.1.type", '^"clearance" stands twice')


def model_without_effect(rng: np.random.Generator, raw: Tables) -> Refusal:
    model = one_of(rng, ["level0", "strips"])
    raw["accuracy"]["model"] = model
    return Refusal("accuracy.model", rf'^"{model}" needs the effect "elastic_contact"')


def unknown_material(rng: np.random.Generator, raw: Tables) -> Refusal:
    raw["drive"]["material"] = one_of(rng, ["steal", "stel", "teel"])
    return Refusal("drive.material", 'did you mean "steel"')


def bearings_swapped(rng: np.random.Generator, raw: Tables) -> Refusal:
    member = one_of(rng, ["input_shaft", "output_flange"])
    raw["drive"][member]["bearing_positions"].reverse()
    return Refusal(f"drive.{member}.bearing_positions", "the lower z first")


def casing_missing(rng: np.random.Generator, raw: Tables) -> Refusal:
    raw["effects"] = [{"type": "casing_on_mounts"}]
    raw["ask"]["quantities"] = ["ratio"]
    if rng.random() < 0.5:
        del raw["casing"]
        return Refusal("effects.0.type", r"needs the table \[casing\]")
    raw["casing"]["mounts"] = []
    return Refusal("effects.0.type", r"needs at least one \[\[casing.mounts\]\]")


def sizes(raw: Tables) -> Design:
    """Return the drive in SI as it was before it was spoilt."""
    return design(scene_of(raw))


def no_torque(rng: np.random.Generator, raw: Tables) -> Refusal:
    name = one_of(rng, list(UNDER_TORQUE))
    raw["effects"] = [{"type": each} for each in EFFECTS]
    raw["operation"]["output_torque"] = one_of(rng, [0, 0.0, "0 N*m"])
    raw["ask"]["quantities"] = [name]
    return Refusal("ask.quantities.0", f'^"{name}" needs operation.output_torque above 0')


def looped(rng: np.random.Generator, raw: Tables) -> Refusal:
    d = sizes(raw).drive
    raw["drive"]["eccentricity"] = f"{d.pin_circle_radius / d.pins * rng.uniform(1.0 + 1e-9, 1.5)!r} m"
    return Refusal("", r"^eccentricity = .*: it must be less than pin_circle_radius/pins = .*loops", True)


def undercut(rng: np.random.Generator, raw: Tables) -> Refusal:
    d = sizes(raw).drive
    e = 0.97 * d.pin_circle_radius / d.pins
    limit = Cycloid(d.pins, d.pins - 1, d.pin_circle_radius, d.pin_radius, e).undercut_radius
    raw["drive"]["eccentricity"] = f"{e!r} m"
    raw["drive"]["pin_radius"] = f"{limit * (1 + 10 ** rng.uniform(-9, -1))!r} m"
    said = rf"^pin_radius = .*: the flank is undercut; .* just below {re.escape(f'{1e3 * limit:.6g}')} mm"
    return Refusal("", said, True)


def modified_undercut(rng: np.random.Generator, raw: Tables) -> Refusal:
    made = sizes(raw)
    raw["effects"] = [each for each in raw["effects"] if each["type"] != "clearance"] + [
        {"type": "clearance"}
    ]
    more = made.flank.undercut_radius - made.flank.pin_radius
    raw["drive"]["modification"] = {"equidistant": f"{more * rng.uniform(1.001, 2)!r} m"}
    return Refusal("", "^modified flank: pin_radius = .*undercut", True)


def pins_overlap(rng: np.random.Generator, raw: Tables) -> Refusal:
    d = sizes(raw).drive
    raw["drive"]["eccentricity"] = f"{0.05 * d.pin_circle_radius / d.pins!r} m"
    limit = d.pin_circle_radius * math.sin(math.pi / d.pins)
    raw["drive"]["pin_radius"] = f"{limit * (1 + 10 ** rng.uniform(-9, -1.5))!r} m"
    return Refusal("", r"^pin_radius = .*neighbouring pins overlap; it must be less than", True)


def hole_of(raw: Tables, made: Design, radius: float, circle: float | None = None) -> None:
    """Give the discs holes of this radius."""
    pins = raw["drive"]["output_pins"]
    pins["roller_radius"] = f"{radius - (made.hole_radius - made.drive.output_pins.roller_radius)!r} m"
    if circle is not None:
        pins["circle_radius"] = f"{circle!r} m"


def holes_break(rng: np.random.Generator, raw: Tables) -> Refusal:
    made = sizes(raw)
    d, place = made.drive, one_of(rng, ["the flank", "the bore", "each other"])
    root = d.pin_circle_radius - d.eccentricity - d.pin_radius
    r = made.hole_radius
    if place == "the bore":
        hole_of(raw, made, r, d.bore_radius + r * rng.uniform(0.1, 0.999))
    elif place == "the flank":  # as far as the crests even
        hole_of(raw, made, r + 2 * (d.eccentricity + root - d.output_pins.circle_radius))
    else:
        hole_of(
            raw,
            made,
            d.output_pins.circle_radius * math.sin(math.pi / d.output_pins.count) * rng.uniform(1.001, 1.5),
        )
    return Refusal("", rf"^holes of radius .* break into {place} by .*; take ", True)


def bore_too_large(rng: np.random.Generator, raw: Tables) -> Refusal:
    d = sizes(raw).drive
    root = d.pin_circle_radius - d.eccentricity - d.pin_radius
    raw["drive"]["bore_radius"] = f"{root * rng.uniform(1.0 + 1e-9, 2)!r} m"
    return Refusal("", "^bore radius .*: it must lie between 0 and the root circle", True)


def rollers_overlap(rng: np.random.Generator, raw: Tables) -> Refusal:
    d = sizes(raw).drive
    pitch = math.sin(math.pi / d.eccentric_bearing.rollers)
    limit = d.bore_radius * pitch / (1 + pitch)
    raw["drive"]["eccentric_bearing"]["roller_radius"] = f"{limit * rng.uniform(1 + 1e-9, 2)!r} m"
    return Refusal("", r"rollers of radius .* overlap in a bore of radius .*; take them smaller than", True)


def rollers_too_long(rng: np.random.Generator, raw: Tables) -> Refusal:
    width = sizes(raw).drive.face_width
    raw["drive"]["eccentric_bearing"]["roller_length"] = f"{width * rng.uniform(1 + 1e-9, 3)!r} m"
    return Refusal("", r"^eccentric_bearing.roller_length = .*it must be at most face_width", True)


def shaft_too_thick(rng: np.random.Generator, raw: Tables) -> Refusal:
    made = sizes(raw)
    limit = made.race_radius - made.flank.eccentricity
    raw["drive"]["input_shaft"]["radius"] = f"{limit * rng.uniform(1 + 1e-9, 3)!r} m"
    return Refusal("", r"^input_shaft.radius = .*sticks out of its eccentrics; it must be at most", True)


def ring_too_small(rng: np.random.Generator, raw: Tables) -> Refusal:
    d = sizes(raw).drive
    raw["drive"]["ring"]["outer_radius"] = (
        f"{(d.pin_circle_radius + d.pin_radius) * rng.uniform(0.5, 1 - 1e-9)!r} m"
    )
    return Refusal("", r"^ring.outer_radius = .*it must enclose the pins, more than", True)


SPOILERS: tuple[Spoiler, ...] = (
    *(wrong_type, wrong_dimension, unknown_unit, misspelt_key, key_elsewhere, missing_key, missing_table),
    *(out_of_range, wrong_word, wrong_lobes, effect_missing, unknown_quantity, unknown_effect, named_twice),
    *(model_without_effect, unknown_material, bearings_swapped, casing_missing, no_torque),
    *(looped, undercut, modified_undercut, pins_overlap, holes_break, bore_too_large, rollers_overlap),
    *(rollers_too_long, shaft_too_thick, ring_too_small),
)

"""Units and sizes: a scene in other units is the same drive, and a drive of another size is similar to it."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from tests.drives.khv_cases import EFFECTS, EXAMPLE, drive, level_of, scene, without
from trochoid.drives.khv.contact import layout
from trochoid.drives.khv.series import solve_at
from trochoid.kinematics.types import Array
from trochoid.run import Run

GIVEN: dict[str, Any] = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))
LENGTHS = {
    "": ("pin_circle_radius", "pin_radius", "eccentricity", "face_width", "disc_gap", "bore_radius"),
    "output_pins": ("circle_radius", "roller_radius", "hole_clearance"),
    "eccentric_bearing": ("roller_radius", "roller_length", "clearance"),
    "modification": ("equidistant", "radial"),
    "ring": ("outer_radius", "width"),
    "input_shaft": ("radius", "length"),
    "output_flange": ("outer_radius", "thickness"),
}


def lengths(unit: str, factor: float) -> list[str]:
    """Return overrides that write every length of [drive] as a number × factor with a unit."""
    found = []
    for table, keys in LENGTHS.items():
        values = GIVEN["drive"][table] if table else GIVEN["drive"]
        path = ".".join(["drive", table] if table else ["drive"])
        found += [f'{path}.{key}="{values[key] * factor!r} {unit}"' for key in keys]
    for table in ("input_shaft", "output_flange"):
        places = [f"{place * factor!r} {unit}" for place in GIVEN["drive"][table]["bearing_positions"]]
        found.append(f"drive.{table}.bearing_positions={places}")
    return found


def similar(size: float, stiffness: float) -> list[str]:
    """Return the example with lengths × size and moduli × stiffness, loaded so that all strains stay the same."""
    found = lengths("mm", size)
    for table in ("input_shaft", "output_flange"):
        given = GIVEN["drive"][table]["bearing_stiffness"]
        found.append(f"drive.{table}.bearing_stiffness={given * size * stiffness!r}")
    return [
        *found,
        f"materials.steel.youngs_modulus={210e3 * stiffness!r}",
        f"materials.steel.density={7850 * stiffness / size**2!r}",
        f"operation.output_torque={400 * stiffness * size**3!r}",
    ]


def unitless(
    size: float, stiffness: float, effects: tuple[str, ...], rung: str
) -> tuple[Array, float, Array]:
    """Return forces over E L², the twist, and the flange's rotational stiffness over E L³ of a similar drive."""
    made = drive(*similar(size, stiffness), effects=effects)
    bodies = () if rung == "springs" else level_of(made).elastic
    contact = solve_at(made, rung, bodies, 0.3)
    row = layout(made, rung).names.index("output.rotation")
    force = np.concatenate([t.force for t in contact.touches.values()]) / (stiffness * size**2)
    return force, float(contact.motion[row]), contact.stiffness[row, row] / (stiffness * size**3)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("effects", "rung"),
    [
        (EFFECTS, "level0"),
        (EFFECTS, "strips"),
        (without("bearing_compliance"), "level0"),
        ((), "springs"),
        (("clearance", "bearing_compliance", "inertia"), "springs"),
    ],
)
def test_similar_drives_are_similar(effects: tuple[str, ...], rung: str) -> None:
    """No law has a length or a force of its own: a drive of another size or material, under the same strain,

    twists by the same angle, and its forces are as E L². Hertz and ISO/TS 16281 (Q ~ L^(8/9) δ^(10/9)) allow it.
    """
    force, twist, stiffness = unitless(1.0, 1.0, effects, rung)
    for size, modulus in ((25.4, 1.0), (1e-2, 1e-3)):
        other = unitless(size, modulus, effects, rung)
        assert other[0] == pytest.approx(force, abs=1e-10 * force.max())
        assert other[1] == pytest.approx(twist, rel=1e-10)
        assert other[2] == pytest.approx(stiffness, rel=1e-10)


@pytest.mark.exact
def test_units_do_not_matter() -> None:
    """Inches, pounds-force, N·mm, rad/s, GPa: every number of the scene rounds differently, no answer by 1e-10."""
    asked = (
        "ask.positions=4",
        "accuracy.facets_per_lobe=4",
        'ask.quantities=["torsional_stiffness","contact_force_max","reactions","vibration_velocity"]',
    )
    inches = (
        *lengths("in", 1 / 25.4),
        'drive.input_shaft.bearing_stiffness="3e8 N/m"',
        f'drive.output_flange.bearing_stiffness="{5e8 / 4.4482216152605 * 0.0254!r} lbf/in"',
        'materials.steel.youngs_modulus="210 GPa"',
        'materials.steel.density="7.85 g/cm^3"',
        'operation.output_torque="400000 N*mm"',
        f'operation.input_speed="{50 * np.pi!r} rad/s"',
    )
    one, other = (Run(scene(*asked, *each)) for each in ((), inches))
    mine, theirs = one.stages.contact.fine, other.stages.contact.fine
    for kind in ("ring", "output", "bearing"):
        force = getattr(mine, kind).force
        assert getattr(theirs, kind).force == pytest.approx(force, abs=1e-10 * force.max())
    assert theirs.twist == pytest.approx(mine.twist, rel=1e-10)
    assert theirs.torsional_stiffness == pytest.approx(mine.torsional_stiffness, rel=1e-10)
    for name, force in one.stages.reactions.fine.rigid.items():
        assert other.stages.reactions.fine.rigid[name] == pytest.approx(
            force, abs=1e-10 * np.abs(force).max()
        )
    speed = one.stages.vibration.fine.elastic.rms
    assert other.stages.vibration.fine.elastic.rms == pytest.approx(speed, abs=1e-8 * speed.max())

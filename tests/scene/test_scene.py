from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import pytest
from pydantic import ValidationError

import trochoid
from trochoid.scene import NEEDS, QUANTITIES
from trochoid.scene.needs import EFFECTS_OF

EFFECTS = EFFECTS_OF["khv"]

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"


@pytest.mark.published
def test_example_is_the_drive_of_the_specification() -> None:
    """The reference drive: 20 pins, 19 lobes, R 80, r 5, e 2.5 mm, two discs of 10 mm, 400 N·m, 1500 rpm."""
    scene = trochoid.load(EXAMPLE)
    d = scene.drive
    assert (d.pins, d.lobes, d.discs, d.output_pins.count) == (20, 19, 2, 8)
    lengths = (
        d.pin_circle_radius,
        d.pin_radius,
        d.eccentricity,
        d.face_width,
        d.output_pins.circle_radius,
        d.bore_radius,
    )
    assert lengths == (0.08, 0.005, 0.0025, 0.01, 0.052, 0.025)
    assert (scene.operation.output_torque, scene.operation.input_speed) == (400.0, 50 * math.pi)
    assert tuple(effect.type for effect in scene.effects) == EFFECTS
    assert scene.ask.quantities == tuple(NEEDS["khv"])
    assert (scene.ask.positions, scene.accuracy.tolerance) == (60, 0.01)
    assert scene.casing is not None
    assert len(scene.casing.mounts) == 4
    assert scene.materials["steel"].youngs_modulus == 210e9


@pytest.mark.property
def test_example_can_be_built() -> None:
    """Rollers have room; holes keep off bore, flank root and each other; bearings stand beside the discs."""
    d = trochoid.load(EXAMPLE).drive
    bearing, output = d.eccentric_bearing, d.output_pins
    pitch = d.bore_radius - bearing.clearance - bearing.roller_radius
    assert 2 * pitch * math.sin(math.pi / bearing.rollers) > 2 * bearing.roller_radius
    assert pitch - bearing.roller_radius - d.eccentricity > d.input_shaft.radius
    assert bearing.roller_length <= d.face_width
    hole = output.roller_radius + d.eccentricity + output.hole_clearance
    root = d.pin_circle_radius - d.pin_radius - d.eccentricity
    assert d.bore_radius + 0.005 < output.circle_radius - hole
    assert output.circle_radius + hole < root - 0.005
    assert output.circle_radius * math.sin(math.pi / output.count) > hole
    pack = d.discs * d.face_width / 2 + (d.discs - 1) * d.disc_gap / 2
    for positions in (d.input_shaft.bearing_positions, d.output_flange.bearing_positions):
        assert all(abs(z) > pack for z in positions)
    assert d.ring.width >= 2 * pack


@pytest.mark.property
def test_scene_is_frozen_and_dumps_si() -> None:
    """A scene cannot be changed; `model_dump` has the SI values that results.json shows."""
    scene = trochoid.load(EXAMPLE)
    with pytest.raises(ValidationError, match="frozen"):
        scene.drive.pins = 3
    dump = scene.model_dump(mode="json")
    assert dump["drive"]["pin_radius"] == 0.005
    assert dump["effects"][0] == {"type": "elastic_contact"}
    assert dump["casing"]["mounts"][0]["stiffness"] == [5e6, 8e6, 5e6]


@pytest.mark.property
def test_offered_quantities_are_known_ones() -> None:
    """What a drive offers is in the common list, and each needs effects that exist."""
    for kind, offered in NEEDS.items():
        assert set(offered) <= set(QUANTITIES)
        assert {effect for needs in offered.values() for effect in needs} <= set(EFFECTS_OF[kind])


@pytest.mark.property
def test_public_names_are_lazy() -> None:
    """`dir` lists the names before they are imported; an unknown one is an AttributeError."""
    assert {"load", "Run", "Scene", "TrochoidError"} <= set(dir(trochoid))
    assert isinstance(trochoid.load(EXAMPLE), trochoid.Scene)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        trochoid.nothing  # noqa: B018


@pytest.mark.property
def test_loading_is_light() -> None:
    """Reading a scene imports no solver, no mesher, no plotting, no units, no parser of places."""
    program = f"""if True:
        import sys, trochoid
        trochoid.load({str(EXAMPLE)!r})
        heavy = "numpy scipy gmsh skfem pyvista pint plotly xarray tree_sitter rich jinja2".split()
        print([name for name in heavy if name in sys.modules])"""
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert done.stdout == "[]\n"

"""Random drives that can be built, by a seed: sizes from 1 cm to 1 m, plays, modifications, loads, stiffnesses."""

from __future__ import annotations

import math
from itertools import count

import numpy as np

from benchmarks.run import SCENE
from trochoid.drives.khv.design import design
from trochoid.drives.khv.feasible import faults
from trochoid.kinematics.cycloid import Cycloid
from trochoid.scene import load
from trochoid.scene.drive_khv import KhvScene

OPTIONAL = ("pin_compliance", "inertia", "bearing_compliance")


def random_drive(seed: int, positions: int, pins: int = 12) -> KhvScene:
    """Return the first buildable scene that a seed leads to; discs are elastic, with up to `pins` pins.

    The tolerance is drawn from 1e-3 to 1e-2, evenly in its logarithm.
    """
    for attempt in count():
        words = _words(np.random.default_rng((seed, attempt)), pins)
        if words is None:
            continue
        scene = load(SCENE, [*words, f"ask.positions={positions}", 'ask.quantities=["ratio"]'])
        if not faults(design(scene)):
            return scene
    raise AssertionError("a seed never ends")


def _words(rng: np.random.Generator, pins: int) -> list[str] | None:
    """Draw the overrides of the example; None when the roller of the output pin has no room."""

    def between(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    def one_of(*values: float) -> float:
        return float(rng.choice(values))

    z = int(rng.integers(6, pins + 1))
    big = 10 ** between(-2, 0)  # m
    e = between(0.4, 0.85) * big / z
    limit = min(Cycloid(z, z - 1, big, 1e-6 * big, e).undercut_radius, big * math.sin(math.pi / z))
    r = between(0.3, 0.85) * limit
    root = big - e - r
    bore = between(0.3, 0.45) * root
    holes, rollers = int(rng.integers(3, 13)), int(rng.integers(8, 25))
    circle = 0.5 * (bore + root)
    play = one_of(0.0, 1e-5, 1e-4) * big
    roller = between(0.4, 0.75) * min(0.5 * (root - bore), circle * math.sin(math.pi / holes)) - e - play
    if roller < 0.01 * big:
        return None
    pitch = math.sin(math.pi / rollers)
    needle = between(0.5, 0.9) * min(0.3 * (bore - e), bore * pitch / (1 + pitch))
    width = between(0.05, 0.3) * big
    steel = (width / 0.01) * (big / 0.08) ** 2  # torques that load the drive as much as the example's
    lengths = {
        "drive.pin_circle_radius": big,
        "drive.pin_radius": r,
        "drive.eccentricity": e,
        "drive.face_width": width,
        "drive.disc_gap": between(0.01, 0.2) * width,
        "drive.bore_radius": bore,
        "drive.output_pins.circle_radius": circle,
        "drive.output_pins.roller_radius": roller,
        "drive.output_pins.hole_clearance": play,
        "drive.eccentric_bearing.roller_radius": needle,
        "drive.eccentric_bearing.roller_length": between(0.5, 1.0) * width,
        "drive.eccentric_bearing.clearance": one_of(0.0, 1e-4) * bore,
        "drive.modification.equidistant": one_of(0.0, 2e-5, 2e-4) * big,
        "drive.modification.radial": one_of(0.0, -2e-5) * big,
        "drive.pin_clearance": one_of(0.0, 1e-5) * big,
        "drive.ring.outer_radius": 1.3 * (big + r),
        "drive.input_shaft.radius": between(0.5, 0.9) * (bore - 2 * needle - e),
        "drive.output_flange.outer_radius": circle,
    }
    plain = {
        "drive.pins": z,
        "drive.lobes": z - 1,
        "drive.discs": 1 + int(rng.random() < 0.3),
        "drive.output_pins.count": holes,
        "drive.output_pins.phase": between(0, 360),
        "drive.eccentric_bearing.rollers": rollers,
        "drive.modification.rotation": one_of(0.0, 1e-3),
        "drive.fixed": "ring" if rng.random() < 0.5 else "output",
        "drive.plane": "strain" if rng.random() < 0.5 else "stress",
        "operation.output_torque": 10 ** between(1, 3) * steel,
        "operation.input_speed": 10 ** between(2, 3.5) * min(1.0, 0.08 / big),
        "accuracy.tolerance": 10 ** between(-3, -2),
    }
    shaft, flange = (1e9 * 10 ** between(-1, 1) * width / 0.01 for _ in range(2))
    far = between(2, 4) * width, between(4, 6) * width
    effects = ["elastic_contact", "clearance", *(name for name in OPTIONAL if rng.random() < 0.5)]
    return [
        *(f'{key}="{value!r} m"' for key, value in lengths.items()),
        *(f"{key}={value}" for key, value in plain.items()),
        f'drive.input_shaft.bearing_stiffness="{shaft!r} N/m"',
        f'drive.output_flange.bearing_stiffness="{flange!r} N/m"',
        f'drive.input_shaft.bearing_positions=["{-2.5 * width!r} m", "{far[0]!r} m"]',
        f'drive.output_flange.bearing_positions=["{3 * width!r} m", "{far[1]!r} m"]',
        "effects=[" + ", ".join(f'{{type="{name}"}}' for name in effects) + "]",
    ]

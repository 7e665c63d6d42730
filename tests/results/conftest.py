"""A made-up but complete outcome of a drive with 20 pins and two discs: all kinds of results, no solver."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import xarray

from trochoid.kinematics.types import Array, IntArray
from trochoid.results import (
    Arrow,
    Check,
    Drawing,
    DrawingFrame,
    Field,
    Film,
    Line,
    Outcome,
    Quantity,
    Stage,
)

PINS, LOBES, R, PIN, E = 20, 19, 0.080, 0.005, 0.0025
HOLES, HOLE_CIRCLE, ROLLER, BORE, SHAFT = 8, 0.052, 0.0075, 0.025, 0.0195
ROLLERS, TORQUE, HZ = 16, 200.0, 25.0


def circle(center: Array | tuple[float, float], radius: float, points: int = 48) -> Array:
    t = np.linspace(0.0, 2 * np.pi, points, endpoint=False)
    return np.column_stack([center[0] + radius * np.cos(t), center[1] + radius * np.sin(t)])


def profile(points: int = 19 * 24) -> Array:
    """Equidistant of the epitrochoid that the pin centre draws, pin 0 on +x at t = 0."""
    t = np.linspace(0.0, 2 * np.pi, points, endpoint=False)
    centre = np.column_stack([R * np.cos(t) - E * np.cos(PINS * t), R * np.sin(t) - E * np.sin(PINS * t)])
    slope = np.column_stack(
        [-R * np.sin(t) + PINS * E * np.sin(PINS * t), R * np.cos(t) - PINS * E * np.cos(PINS * t)]
    )
    slope /= np.linalg.norm(slope, axis=1, keepdims=True)
    return centre - PIN * np.column_stack([slope[:, 1], -slope[:, 0]])


def turned(xy: Array, angle: float, center: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(xy @ np.array([[c, s], [-s, c]]) + center)


def pin_forces(phi: float) -> Array:
    """The classical rigid sharing, F ∝ lever over the loaded half (sources §3)."""
    a = 2 * np.pi * np.arange(PINS) / PINS - phi
    ratio = E * PINS / R
    lever = E * LOBES * np.sin(a) / np.sqrt(1 + ratio**2 - 2 * ratio * np.cos(a))
    loaded = np.where(lever > 0, lever, 0.0)
    return np.asarray(TORQUE * loaded / np.sum(loaded**2))


def frame(phi: float) -> DrawingFrame:
    pins = [circle((R * np.cos(a), R * np.sin(a)), PIN, 32) for a in 2 * np.pi * np.arange(PINS) / PINS]
    lines = [Line("ring", circle((0, 0), R + 0.012, 180), group="ring")]
    arrows: list[Arrow] = []
    for disc in (0, 1):
        angle = phi + np.pi * disc
        center = E * np.array([np.cos(angle), np.sin(angle)])
        name, psi = f"disc {disc + 1}", -angle / LOBES
        lines.append(Line(name, turned(profile(), psi, center), style="body", group=name))
        lines.append(Line("bore", turned(circle((0, 0), BORE), psi, center), style="hole", group=name))
        for k in range(HOLES):
            at = HOLE_CIRCLE * np.array([np.cos(2 * np.pi * k / HOLES), np.sin(2 * np.pi * k / HOLES)])
            lines.append(
                Line(f"hole {k}", turned(circle(at, ROLLER + E), psi, center), style="hole", group=name)
            )
        pole = R / PINS * np.array([0.0, 0.0]) + E * PINS * np.array([np.cos(angle), np.sin(angle)])
        for k, force in enumerate(pin_forces(angle)):
            pin = R * np.array([np.cos(2 * np.pi * k / PINS), np.sin(2 * np.pi * k / PINS)])
            direction = (pole - pin) / np.linalg.norm(pole - pin)
            arrows.append(Arrow(pin + PIN * direction, force * direction, name, f"pin {k}"))
        bearing = 4000.0 * np.array([np.cos(angle + 2.2), np.sin(angle + 2.2)])
        arrows.append(Arrow(center, bearing, name, "eccentric bearing"))
    lines += [Line(f"pin {k}", pin, style="pin", group="ring pins") for k, pin in enumerate(pins)]
    for k in range(HOLES):
        a = 2 * np.pi * k / HOLES - phi / LOBES
        lines.append(
            Line(
                f"roller {k}",
                circle((HOLE_CIRCLE * np.cos(a), HOLE_CIRCLE * np.sin(a)), ROLLER),
                style="pin",
                group="output pins",
            )
        )
    center = E * np.array([np.cos(phi), np.sin(phi)])
    lines.append(Line("eccentric", circle(center, SHAFT), group="eccentric 1"))
    for k in range(ROLLERS):
        a = 2 * np.pi * k / ROLLERS + phi / 2
        at = center + 0.5 * (BORE + SHAFT) * np.array([np.cos(a), np.sin(a)])
        lines.append(
            Line(
                f"bearing roller {k}",
                circle(at, 0.5 * (BORE - SHAFT), 20),
                style="pin",
                group="bearing rollers",
            )
        )
    lines.append(
        Line("axis", np.array([[-0.1, 0.0], [0.1, 0.0]]), closed=False, style="center", group="axes")
    )
    lines.append(
        Line("axis", np.array([[0.0, -0.1], [0.0, 0.1]]), closed=False, style="center", group="axes")
    )
    return DrawingFrame(f"{np.degrees(phi):.1f}°", tuple(lines), tuple(arrows))


def dataset(positions: int) -> xarray.Dataset:
    phi = np.linspace(0.0, 2 * np.pi, positions, endpoint=False)
    forces = np.array([[pin_forces(p + np.pi * d) for d in (0, 1)] for p in phi])
    wave = np.cos(PINS * phi)
    angle, turn = ("input_angle",), np.column_stack([np.cos(phi), np.sin(phi)])
    rng = np.random.default_rng(7)
    frequency = HZ * np.arange(1, 31)
    spectrum = (
        2e-4
        * np.exp(1j * rng.uniform(0, 6, (30, 2, 3)))
        * np.exp(-frequency / 150)[:, None, None]
        * rng.uniform(0.3, 1, (30, 2, 3))
    )
    spectrum[12:15] = 1e-17

    def entry(
        dims: tuple[str, ...], values: Array, units: str, name: str, figure: str | None = None, **more: str
    ) -> xarray.Variable:
        return xarray.Variable(
            dims, values, {"units": units, "long_name": name} | ({"figure": figure} if figure else {}) | more
        )

    reaction = np.stack([300 * turn, 260 * turn[:, ::-1]], axis=1)
    rollers = 4000 / 4 * np.clip(np.cos(phi[:, None] + 2 * np.pi * np.arange(ROLLERS) / ROLLERS), 0, None)
    variables = {
        "pin_force": entry(
            (*angle, "disc", "pin"),
            forces,
            "N",
            "pin force",
            "Load sharing",
            caption="Force of each ring pin on its disc.",
        ),
        "share": entry(
            (*angle, "disc", "hole"),
            np.clip(
                400 * np.cos(phi[:, None, None] + np.arange(HOLES) + np.pi * np.arange(2)[:, None]), 0, None
            ),
            "N",
            "output-pin force",
            "Output pins",
        ),
        "roller_force": entry(
            (*angle, "roller"),
            rollers,
            "N",
            "roller force",
            "Bearing rollers",
            plot="heatmap",
            caption="Load of each roller of the eccentric bearing of disc 1.",
        ),
        "pressure": entry(
            (*angle, "disc"),
            1e8 * np.sqrt(forces.max(axis=2)),
            "Pa",
            "largest pressure",
            "Contact pressure",
            caption="Largest contact pressure on each disc.",
        ),
        "pressure_map": entry(
            (*angle, "disc", "pin"),
            np.where(forces > 0, 6e7 * np.sqrt(forces), np.nan),
            "Pa",
            "pressure",
            "Pressure at every pin",
            plot="heatmap",
        ),
        "stiffness": entry(
            angle, 3.4e5 * (1 + 0.01 * wave), "N*m/rad", "torsional stiffness", "Torsional stiffness"
        ),
        "transmission_error": entry(
            angle,
            1.15e-3 * (1 + 0.01 * wave),
            "rad",
            "transmission error",
            "Transmission error",
            caption="Lag of the output flange behind the ideal ratio.",
        ),
        "rigid": entry((*angle, "support", "direction"), reaction, "N", "reaction, rigid", "Reactions"),
        "elastic": entry(
            (*angle, "support", "direction"),
            reaction * (1 + 0.08 * wave[:, None, None]),
            "N",
            "reaction, elastic",
            "Reactions",
        ),
        "moment": entry((*angle, "direction"), 7 * turn, "N*m", "moment on the casing", "Reactions"),
        "velocity": entry(
            ("frequency", "point", "direction3"),
            spectrum,
            "m/s",
            "velocity",
            "Velocity spectrum",
            scale="log",
            caption="Amplitude at the multiples of the input speed.",
        ),
        "loaded": entry((*angle, "disc", "pin"), forces.astype(bool), "", "in contact"),
        "natural_frequencies": entry(("mode",), np.array([412.0, 980.0]), "Hz", "natural frequencies"),
    }
    coordinates = {
        "input_angle": xarray.Variable(angle, phi, {"units": "rad", "long_name": "input angle"}),
        "frequency": xarray.Variable(("frequency",), frequency, {"units": "Hz", "long_name": "frequency"}),
        "disc": [1, 2],
        "pin": np.arange(PINS),
        "support": ["bearing A", "bearing B"],
        "direction": ["x", "y"],
        "point": ["foot", "top"],
        "direction3": ["x", "y", "z"],
    }
    return xarray.Dataset(variables, coordinates)


def annulus(around: int, across: int) -> tuple[Array, IntArray]:
    """Quadratic triangles of a ring, mid-side nodes on the true circles (scikit-fem's node order)."""
    r, t = (
        np.linspace(BORE, R - 2 * PIN, 2 * across + 1),
        np.linspace(0, 2 * np.pi, 2 * around, endpoint=False),
    )
    radius, angle = np.meshgrid(r, t, indexing="ij")
    points = np.column_stack([(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel()])
    i, j = (2 * a.ravel() for a in np.meshgrid(np.arange(across), np.arange(around), indexing="ij"))

    def node(di: int, dj: int) -> IntArray:
        return np.asarray((i + di) * 2 * around + (j + dj) % (2 * around), dtype=np.intp)

    lower = np.array([node(0, 0), node(2, 0), node(2, 2), node(1, 0), node(2, 1), node(1, 1)])
    upper = np.array([node(0, 0), node(2, 2), node(0, 2), node(1, 1), node(1, 2), node(0, 1)])
    return points, np.hstack([lower, upper])


def bodies(phi: float, around: int, across: int) -> tuple[Field, ...]:
    points, triangles = annulus(around, across)
    made = []
    for disc in (0, 1):
        angle = np.arctan2(points[:, 1], points[:, 0]) - phi - np.pi * disc
        radius = np.linalg.norm(points, axis=1)
        swell = 2e-5 * (radius / R) ** 2 * np.cos(angle)
        displacement = np.column_stack([swell, 0.5 * swell])
        near = np.exp(3 * (np.cos(PINS * angle / 2) - 1) + 40 * (radius / (R - 2 * PIN) - 1)) * np.clip(
            np.sin(angle), 0, None
        )
        stress = 1e6 * np.column_stack(
            [-400 * near - 20, -300 * near + 30 * np.cos(angle), -210 * near, 60 * near]
        )
        data = {
            "displacement": displacement,
            "stress": stress,
            "von_mises": 0.6 * np.linalg.norm(stress, axis=1),
        }
        z = np.full(len(points), -0.006 + 0.012 * disc)
        made.append(Field(f"disc {disc + 1}", np.column_stack([points, z]), triangles, data))
    return tuple(made)


QUANTITIES = {
    "ratio": Quantity(-19.0, "", note="output against input, ring fixed"),
    "torsional_stiffness": Quantity(101.3127, "N*m/arcmin", 0.41, "strips"),
    "contact_force_max": Quantity(405.4691, "N", 0.37, "strips"),
    "contact_pressure_max": Quantity(1183.42, "MPa", 4.6, "strips"),
    "stress_max": Quantity(
        parts={
            "below_contact": Quantity(512.8, "MPa", 21.0, "strips", note="below pin 4 of disc 1"),
            "in_the_field": Quantity(171.3, "MPa", 8.0, "strips"),
        },
        note="von Mises",
    ),
    "profile": Quantity(
        parts={
            "trochoid_ratio": Quantity(0.625, "", 0.0, "exact"),
            "pitch_radius_disc": Quantity(47.5, "mm", 0.0, "exact"),
            "pitch_radius_pins": Quantity(50.0, "mm", 0.0, "exact"),
            "crest_radius": Quantity(77.5, "mm", 0.0, "exact"),
            "pin_radius_undercut_limit": Quantity(27.9, "mm", 0.0, "exact", note="larger pins cut the flank"),
        }
    ),
    "transmission_error": Quantity(0.0371, "arcmin", 0.0004, "strips", note="peak to peak"),
    "vibration_zone": Quantity(None, note="none applies: 63 W is below the 15 kW of ISO 20816-3"),
    "vibration_velocity": Quantity(
        0.858, "mm/s", model="stiffness-aware", note="rms, 10–1000 Hz, point “top”"
    ),
    "member_speeds": Quantity(
        parts={
            name: {"speed": Quantity(v, "rpm"), "relative_to_input": Quantity(v / 1500)}
            for name, v in {"input": 1500.0, "disc": -78.947368, "output": -78.947368, "ring": 0.0}.items()
        }
    ),
    "bearing_loads": Quantity(
        parts={
            "eccentric_disc_1": Quantity(6408.7, "N", 3.1),
            "eccentric_disc_2": Quantity(6408.7, "N", 3.1),
            "input_shaft_a": Quantity(312.0, "N"),
            "input_shaft_b": Quantity(260.0, "N"),
        },
        model="strips",
    ),
    "mass": Quantity(
        parts={
            "disc": Quantity(1.21, "kg"),
            "ring": Quantity(2.9, "kg"),
            "total": Quantity(7.86, "kg"),
            "specific": Quantity(0.01965, "kg/(N*m)"),
        },
        note="textbook: 0.02 to 0.05 kg/(N·m)",
    ),
}


def build(
    positions: int = 60, frames: int = 40, around: int = 24, across: int = 6, field_frames: int = 1
) -> Outcome:
    return Outcome(
        scene={
            "drive": {
                "type": "khv",
                "pins": PINS,
                "lobes": LOBES,
                "pin_circle_radius": R,
                "pin_radius": PIN,
                "eccentricity": E,
                "output_pins": {"count": HOLES, "circle_radius": HOLE_CIRCLE},
            },
            "operation": {"input_speed": 157.07963267948966, "output_torque": 400.0},
            "effects": [{"type": "elastic_contact"}, {"type": "inertia"}],
            "ask": {"quantities": list(QUANTITIES), "positions": positions},
        },
        quantities=QUANTITIES,
        stages=(
            Stage("profile", 0.012),
            Stage("mesh", 0.41),
            Stage("factor", 1.3),
            Stage("contact", 0.9),
            Stage("reactions", 0.05),
        ),
        not_needed=("efficiency",),
        warnings=("the spectrum is resolved up to 750 Hz; ask for 80 positions or more to reach 1000 Hz",),
        checks=(
            Check("force balance", 3.2e-12, 1e-9, True),
            Check("torque balance", 8.1e-13, 1e-9, True),
            Check("period of the pin forces", 2.4e-7, 1e-6, True),
        ),
        dataset=dataset(positions),
        films=(
            Film(
                "fields",
                "Stress",
                tuple((p, bodies(p, around, across)) for p in np.linspace(0.0, 0.3, field_frames)),
            ),
        ),
        drawing=Drawing(tuple(frame(p) for p in np.linspace(0.0, 2 * np.pi, frames, endpoint=False))),
        notes={
            "rigid against elastic": "The elastic ones carry the mesh frequency, for the stiffness varies."
        },
        title="Cycloid drive K-H-V, 20 pins, 19 lobes, 2 discs",
        facts={
            "ratio": Quantity("−19"),
            "pin circle radius": Quantity(80, "mm"),
            "eccentricity": Quantity(2.5, "mm"),
            "output torque": Quantity(400, "N*m"),
            "input speed": Quantity(1500, "rpm"),
        },
        not_simulated={
            "friction": "Contact forces are normal to the surfaces; there is no efficiency.",
            "misalignment": "All axes are parallel; load is even across the face width.",
        },
    )


@pytest.fixture(scope="session")
def outcome() -> Outcome:
    """A small complete outcome."""
    return build(positions=24, frames=4, field_frames=3)


@pytest.fixture(scope="session")
def build_outcome() -> Callable[..., Outcome]:
    """The builder, for other sizes."""
    return build

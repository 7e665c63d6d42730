"""The mechanism in space, and the laws of motion of indexer and Geneva wheel freed of time and swing."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np

from trochoid.drives.indexer.design import GENEVA, SHOWN, Design
from trochoid.drives.indexer.family import family
from trochoid.drives.indexer.outline import outline, to_space, turned
from trochoid.drives.indexer.stages import Stages
from trochoid.kinematics.indexer import motion
from trochoid.kinematics.indexer_slot import Slot
from trochoid.kinematics.types import Array, IntArray
from trochoid.results.plot import Axis, Plot, PlotCurve, PlotSurface

INSTANTS = (-1.0, -0.5, 0.0, 0.5)  # at the end the wheel looks as at the start
POINTS = 721
SPACE = tuple(Axis(name, "m") for name in "xyz")


def plots(stages: Stages, ran: Collection[str]) -> tuple[Plot, ...]:
    """Return the pictures of what has been computed."""
    found = [in_space(stages.design, stages.slots["indexer"])] if "geometry" in ran else []
    if "contact" in ran:
        from trochoid.drives.indexer.picture_slot import slot_plots

        found += slot_plots(stages.pairs)
    if "march" in ran and stages.response[0]:
        from trochoid.drives.indexer.picture_shaken import courses

        found += courses(stages.shaken)
    if "reactions" in ran:
        from trochoid.drives.indexer.picture_reactions import reaction_plots

        found += reaction_plots(stages.reactions)
    if "modes" in ran:
        from trochoid.drives.indexer.picture_reactions import frequencies

        found.append(frequencies(stages.modes))
    return (*found, *laws(stages.design), family(stages.design))


def in_space(design: Design, slot: Slot) -> Plot:
    """Return sphere, pin paths, pitch cones, shafts and the wheel at several instants."""
    made, radius = design.indexer, design.drive.sphere_radius
    path = made.path
    t = np.linspace(-math.pi, math.pi, POINTS)
    work = made.half_turn * np.linspace(-1.0, 1.0, POINTS // 3)
    curves = [
        PlotCurve("pin path in the index", radius * path.point(work), labels=_labels(design, work)),
        PlotCurve("pin path", radius * path.point(t), style="dashed", closed=True),
    ]
    if GENEVA in design.mechanisms:
        other = design.mechanisms[GENEVA]
        part = other.half_turn * np.linspace(-1.0, 1.0, POINTS // 3)
        curves.append(PlotCurve("Geneva wheel's pin path", radius * other.path.point(part), style="dashed"))
    shape = outline(design, slot)
    for part_of in INSTANTS:
        phi = part_of * made.half_turn
        name = f"wheel and pin at {math.degrees(phi):.4g}°"
        wheel = to_space(turned(shape, float(motion(made, phi).angle)), made)
        pin = path.point(phi) + design.pin_angle * _circle(path.point(phi), math.pi / 2)
        planet = _turned_z(np.array([[math.sin(path.arm), 0.0, math.cos(path.arm)]]), phi)
        arm = np.concatenate((np.zeros((1, 3)), 1.15 * planet, planet, path.point(phi)[None]))
        curves += [
            PlotCurve(name, radius * x, name, closed=c) for x, c in ((wheel, True), (pin, True), (arm, False))
        ]
    pole = np.array([0.0, 0.0, 1.0])
    planet_axis = np.array([math.sin(path.arm), 0.0, math.cos(path.arm)])
    cones = ((pole, path.central_cone), (planet_axis, path.planet_cone))
    curves += [
        PlotCurve("pitch circles", radius * _circle(a, x), closed=True, style="dashed") for a, x in cones
    ]
    ends = np.array([[-0.3], [1.3]])
    curves += [
        PlotCurve("drive shaft", radius * ends * pole),
        PlotCurve("wheel shaft", radius * ends * made.axis),
    ]
    caption = (
        "Entries of the legend switch the instants on and off; angles of the arm from the middle of the index. "
        "The arm's line ends at the planet's axis, from there it goes to the pin."
    )
    ball = PlotSurface("sphere", *_ball(0.995 * radius), opacity=0.13)
    return Plot("Mechanism on its sphere", SPACE, tuple(curves), (ball,), caption)


def laws(design: Design) -> tuple[Plot, ...]:
    """Return velocity, acceleration and power over an index, freed of its time and swing."""
    part = np.linspace(0.0, 1.0, POINTS)
    kinds = (("B", "velocity", 1), ("C", "acceleration", 2), ("N", "power", 3))
    made: dict[str, list[PlotCurve]] = {name: [] for name, *_ in kinds}
    for name, indexer in design.mechanisms.items():
        at = motion(indexer, indexer.half_turn * (2.0 * part - 1.0))
        T, swing = 2.0 * indexer.half_turn, indexer.swing
        for symbol, kind, power in kinds:
            sense = 1 if kind == "power" else indexer.sense
            values = sense * getattr(at, kind) * T**power / swing ** (2 if kind == "power" else 1)
            curve = np.stack((part, values), axis=-1)
            made[symbol].append(PlotCurve(SHOWN[name], curve, labels=_read(part, values)))
    titles = {
        "B": ("Velocity at equal time and swing", "B(t) = ω T/ψ"),
        "C": ("Acceleration at equal time and swing", "C(t) = ε T²/ψ"),
        "N": ("Power at equal time and swing", "N(t) = ω ε T³/ψ²"),
    }
    caption = "Over the time T of an index by the swing ψ; the largest value is the constant of that letter."
    time = Axis("t/T")
    return tuple(
        Plot(titles[name][0], (time, Axis(titles[name][1])), tuple(curves), (), caption, equal=False)
        for name, curves in made.items()
    )


def _read(part: Array, values: Array) -> tuple[str, ...]:
    return tuple(f"t/T {x:.3f}: {y:.4g}" for x, y in zip(part, values, strict=True))


def _labels(design: Design, t: Array) -> tuple[str, ...]:
    psi = np.degrees(motion(design.indexer, t).angle)
    return tuple(f"φ {x:.1f}°, ψ {y:.2f}°" for x, y in zip(np.degrees(t), psi, strict=True))


def _turned_z(points: Array, angle: float) -> Array:
    return turned(points, angle)


def _circle(axis: Array, angle: float) -> Array:
    """Points (n, 3) on the unit sphere at an angle from an axis; at π/2 unit vectors across it."""
    side = np.cross(axis, [0.0, 1.0, 0.0] if abs(axis[1]) < 0.9 else [1.0, 0.0, 0.0])
    side = side / np.linalg.norm(side)
    other = np.cross(axis, side)
    t = np.linspace(0.0, 2.0 * math.pi, 73)[:-1, None]
    circle: Array = math.cos(angle) * axis + math.sin(angle) * (np.cos(t) * side + np.sin(t) * other)
    return circle


def _ball(radius: float, rows: int = 24, columns: int = 48) -> tuple[Array, IntArray]:
    """Vertices and triangles of a sphere."""
    polar, around = np.meshgrid(
        np.linspace(0.0, math.pi, rows + 1), np.linspace(0.0, 2.0 * math.pi, columns + 1), indexing="ij"
    )
    s = np.sin(polar)
    vertices = radius * np.stack((s * np.cos(around), s * np.sin(around), np.cos(polar)), axis=-1).reshape(
        -1, 3
    )
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (i * (columns + 1) + j).ravel()
    b, c, d = a + 1, a + columns + 1, a + columns + 2
    return vertices, np.concatenate((np.stack((a, c, b), -1), np.stack((b, c, d), -1))).astype(np.intp)

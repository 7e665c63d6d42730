"""The whole drive over the input angle, both stages, in the fixed frame; the teeth of the first stage as a plot."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from trochoid.drives.disc_field import disc_field
from trochoid.drives.disc_pack import circle
from trochoid.drives.paths import Path, framed
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.stages import Stages
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.motion import PlaneMotion, flange_lead
from trochoid.kinematics.types import Array, frozen
from trochoid.results.film import Film
from trochoid.results.outcome import Arrow, Drawing
from trochoid.results.plot import Axis, Plot, PlotCurve

FLANK_POINTS, TOOTH_POINTS = 780, 24
SMALL, LARGE = 36, 120  # points of a circle
NOISE = 1e-6  # N: what rounding of gaps leaves of a contact without load
RING_PINS, SHAFTS, AXES = "ring pins", "crankshafts and eccentrics", "axes and circles"
SUN, PLANETS, PILLARS = "sun", "planets", "pillars of the carrier"


def drawing(stages: Stages, frames: int = 36) -> Drawing:
    """Return at most about `frames` pictures over one turn of the driving member; nothing is solved here.

    Once contacts are solved, these are solved positions with the forces on the discs as arrows.
    """
    if "contact" not in stages.__dict__:
        angles = np.linspace(0.0, 2 * np.pi, frames, endpoint=False)
        return framed(angles, tuple(_paths(stages.design, angles)), [()] * frames)
    series = stages.contact.fine
    within = int(np.searchsorted(series.angle, 2 * np.pi * (1 - 1e-9)))
    rows = range(0, within, max(1, -(-within // frames)))
    angles = series.angle[list(rows)]
    return framed(angles, tuple(_paths(stages.design, angles)), [_arrows(stages, row) for row in rows])


def _arrows(stages: Stages, position: int) -> tuple[Arrow, ...]:
    """Return the forces on the discs at a solved position, where they act, in the fixed frame."""
    series, design = stages.contact.fine, stages.design
    turn = float(design.speeds.members["carrier"]) * float(series.angle[position])
    c, s = math.cos(turn), math.sin(turn)
    back = np.array([[c, s], [-s, c]])
    found = []
    cranks, rollers = series.arm.force.shape[2:]
    names = {
        "ring": [f"ring pin {k + 1}" for k in range(design.flank.pins)],
        "arm": [f"roller {k + 1} of crankshaft {j + 1}" for j in range(cranks) for k in range(rollers)],
    }
    for kind, touches in (("ring", series.ring), ("arm", series.arm)):
        discs = len(design.discs)
        force = touches.force[position].reshape(discs, -1)
        point = touches.point[position].reshape(discs, -1, 2) @ back
        push = -force[..., None] * touches.normal[position].reshape(discs, -1, 2) @ back
        for i, k in np.argwhere(force > NOISE).tolist():
            found.append(Arrow(frozen(point[i, k]), frozen(push[i, k]), _name(i), names[kind][k]))
    return tuple(found)


def _paths(design: Design, angles: Array) -> Iterator[Path]:
    """Draw all members on their ideal paths; elastic motion is too small to be seen."""
    yield Path("ring", frozen(circle(design.drive.ring.outer_radius, 2 * LARGE)), "ring")
    for i in range(len(design.discs)):
        yield from _disc(design, angles, i)
    yield from _pins(design, angles)
    for j in range(len(design.crank_places)):
        yield from _crankshaft(design, angles, j)
    yield from _gears(design, angles)
    yield from _axes(design, angles)


def _turned(design: Design, member: str, angles: Array) -> PlaneMotion:
    """Motion of a member about the axis of the drive."""
    still = np.zeros((angles.size, 2))
    return PlaneMotion(frozen(still), frozen(float(design.speeds.members[member]) * angles))


def _disc(design: Design, angles: Array, i: int) -> Iterator[Path]:
    """Draw a disc in the motion of its profile; its body may lie turned by whole lobes."""
    disc, group, flank = design.discs[i], _name(i), design.flank.modified(design.modification)
    carrier = _turned(design, "carrier", angles).rotation
    center = design.eccentric(i, float(design.speeds.members["planet"]) * angles)
    lead = flange_lead(design.flank, i, len(design.discs))
    motion = PlaneMotion(frozen(center), frozen(carrier - lead))
    t = np.linspace(0.0, flank.period, flank.lobes * max(8, FLANK_POINTS // flank.lobes), endpoint=False)
    yield Path(group, frozen(motion.to_fixed(flank.point(t))), group, "body")
    bore = circle(design.drive.cycloid.bore_radius, LARGE)
    yield Path(f"{group} bore", frozen(motion.to_fixed(bore)), group, "hole")
    for name, ring in (("crank hole", design.holes(disc.body)), ("window", design.windows(disc.body))):
        if ring is None:
            continue
        places = circle(ring.circle_radius, ring.count, ring.angle0 + disc.lead)
        for k, place in enumerate(places):
            hole = motion.to_fixed(place + circle(ring.radius, SMALL))
            yield Path(f"{group} {name} {k + 1}", frozen(hole), group, "hole")


def _pins(design: Design, angles: Array) -> Iterator[Path]:
    c, ring = design.drive.cycloid, _turned(design, "ring", angles)
    for k, center in enumerate(circle(c.pin_circle_radius, c.pins)):
        pin = ring.to_fixed(center + circle(c.pin_radius, SMALL))
        yield Path(f"ring pin {k + 1}", frozen(pin), RING_PINS, "pin")
    pillars, carrier = design.drive.carrier.pillars, _turned(design, "carrier", angles)
    if pillars is not None:
        count = len(design.crank_places)
        for k, place in enumerate(circle(pillars.circle_radius, count, math.pi / count)):
            pillar = carrier.to_fixed(place + circle(pillars.radius, SMALL))
            yield Path(f"pillar {k + 1}", frozen(pillar), PILLARS, "pin")


def _crankshaft(design: Design, angles: Array, j: int) -> Iterator[Path]:
    """Draw a crankshaft, its eccentrics and the rollers on them."""
    place = _turned(design, "carrier", angles).to_fixed(design.crank_places[j][None])[:, 0]
    crank = float(design.speeds.members["planet"]) * angles
    for i in range(len(design.discs)):
        center = place + design.eccentric(i, crank)
        eccentric = PlaneMotion(frozen(center), frozen(crank))
        outline = eccentric.to_fixed(circle(design.race_radius, SMALL))
        yield Path(f"eccentric {j + 1}.{i + 1}", frozen(outline), SHAFTS)
        cage = PlaneMotion(frozen(center), frozen(cage_turn(design, angles)))
        bearing = design.drive.arm_bearing
        for k, spot in enumerate(circle(design.pitch_radius, bearing.rollers)):
            roller = cage.to_fixed(spot + circle(bearing.roller_radius, SMALL // 3))
            yield Path(f"roller {j + 1}.{i + 1}.{k + 1}", frozen(roller), f"rollers, {_name(i)}", "pin")
    shaft = PlaneMotion(frozen(place), frozen(crank))
    radius = design.drive.crankshaft.radius
    yield Path(f"crankshaft {j + 1}", frozen(shaft.to_fixed(circle(radius, SMALL))), SHAFTS)
    mark = shaft.to_fixed([[0.0, 0.0], [radius, 0.0]])
    yield Path(f"angle of crankshaft {j + 1}", frozen(mark), SHAFTS, closed=False)


def carrier_angle(design: Design, angle: float) -> float:
    """Return how far the carrier has turned at an input angle (rad); contacts are given in its frame."""
    return float(design.speeds.members["carrier"]) * angle


def stress_film(stages: Stages) -> Film:
    """Return the discs' displacement and stress at the asked position, at their axial places."""
    states = [disc.state for disc in stages.field.fine]
    turn = carrier_angle(stages.design, states[0].angle)
    bodies = tuple(disc_field(_name(i), state, turn) for i, state in enumerate(states))
    return Film("fields", "Stress and displacement of the discs", ((states[0].angle, bodies),))


def cage_turn(design: Design, angles: Array) -> Array:
    """Angle (n,) of the cages in the fixed frame: rollers roll on the eccentric and in the hole of the disc."""
    inner, outer = design.race_radius, design.drive.arm_bearing.hole_radius
    crank, disc = (float(design.speeds.members[name]) * angles for name in ("planet", "carrier"))
    return np.asarray((inner * crank + outer * disc) / (inner + outer))


def _gears(design: Design, angles: Array) -> Iterator[Path]:
    """Draw sun and planets as lines over the discs: they run in a plane of their own."""
    sun, planet = gear_outlines(design)
    yield Path(SUN, frozen(_turned(design, "sun", angles).to_fixed(sun)), SUN)
    carrier = _turned(design, "carrier", angles)
    turn = float(design.speeds.members["planet"]) * angles
    for j, place in enumerate(design.crank_places):
        motion = PlaneMotion(carrier.to_fixed(place[None])[:, 0], frozen(turn + planet_start(design, j)))
        yield Path(f"planet {j + 1}", frozen(motion.to_fixed(planet)), PLANETS)


def gear_outlines(design: Design) -> tuple[Array, Array]:
    """Points (p, 2), m, of the exact outlines of sun and planet in their own frames."""
    lines = []
    for cut, tip in zip(design.first.cuts, design.first.tips, strict=True):
        curve = GearCurve(cut, tip)
        t = np.union1d(curve.corners, np.linspace(0.0, curve.period, TOOTH_POINTS * cut.gear.teeth + 1)[:-1])
        lines.append(curve.point(t))
    return lines[0], lines[1]


def planet_start(design: Design, crank: int) -> float:
    """Angle (rad) of planet's first space at input angle 0, when the sun has a space on the x axis.

    Where crankshaft β stands, the sun's space is β behind; a planet's tooth faces it, β z_a/z_g on.
    """
    table = design.drive.first_stage
    place = 2.0 * math.pi * crank / table.cranks
    return place * (1.0 + table.z_sun / table.z_planet) + math.pi * (1.0 - 1.0 / table.z_planet)


def _axes(design: Design, angles: Array) -> Iterator[Path]:
    c, pair = design.drive.cycloid, design.first.pair
    yield Path("pin circle", frozen(circle(c.pin_circle_radius, LARGE)), AXES, "center")
    yield Path("circle of the crankshafts", frozen(circle(design.first.arm, LARGE)), AXES, "center")
    yield Path("pitch circle of the sun", frozen(circle(float(pair.pitch_radii[0]), LARGE)), AXES, "center")
    reach = 1.04 * design.drive.ring.outer_radius
    yield Path("x axis", frozen([[-reach, 0.0], [reach, 0.0]]), AXES, "center", closed=False)
    yield Path("y axis", frozen([[0.0, -reach], [0.0, reach]]), AXES, "center", closed=False)


def plots(design: Design) -> tuple[Plot, ...]:
    """Return the teeth of sun and planet in mesh, with tip, base and pitch circles."""
    sun, planet = gear_outlines(design)
    place = design.crank_places[0]
    motion = PlaneMotion(frozen(place[None]), frozen([planet_start(design, 0)]))
    curves = [
        PlotCurve("sun", frozen(sun), closed=True),
        PlotCurve("planet", frozen(motion.to_fixed(planet)[0]), closed=True),
    ]
    pair = design.first.pair
    for gear, center, tip, pitch, name in (
        (pair.first, np.zeros(2), design.first.tips[0], pair.pitch_radii[0], "sun"),
        (pair.second, place, design.first.tips[1], pair.pitch_radii[1], "planet"),
    ):
        for what, radius in (("tip", tip), ("pitch", float(pitch)), ("base", gear.base_radius)):
            line = frozen(center + circle(radius, 2 * LARGE))
            curves.append(PlotCurve(f"{what} circle, {name}", line, f"{what} circles", "dashed", closed=True))
    curves.append(PlotCurve("line of action", _line_of_action(design), style="dashed"))
    caption = "First stage: sun and planet as a standard rack cuts them, with their true fillets."
    return (
        Plot("Teeth of sun and planet", (Axis("x", "m"), Axis("y", "m")), tuple(curves), caption=caption),
    )


def _line_of_action(design: Design) -> Array:
    """Ends (2, 2) of one line of action, between the base circles."""
    pair = design.first.pair
    alpha = float(pair.operating_angle)
    away = np.array([math.cos(alpha), math.sin(alpha)])
    start = pair.first.base_radius * away
    return frozen([start, design.crank_places[0] - pair.second.base_radius * away])


def _name(disc: int) -> str:
    return f"disc {disc + 1}"

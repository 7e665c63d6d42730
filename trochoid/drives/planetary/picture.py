"""The set over the input angle: gears with their true flanks, and the forces on the planets."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from trochoid.drives.planetary.mesh_phase import period
from trochoid.drives.planetary.stages import Stages
from trochoid.geometry.planetary_curves import Poses, poses
from trochoid.kinematics.involute_curve import GearCurve
from trochoid.kinematics.types import Array, ComplexArray, frozen
from trochoid.results.outcome import Arrow, Drawing, DrawingFrame, Line

PITCHES, PER_PITCH = 5, 8  # frames
FRAMES = 36  # at the most, of solved positions
ROUND = 72  # points of a circle
HALF_TOOTH = np.array([0.1, 0.16, 0.22, 0.32, 0.42])  # ends of root, fillet and flank, and points between


def drawing(stages: Stages) -> Drawing:
    """Return pictures over some pitches of the input, with the rigid members' forces where there is a load.

    Once contacts are solved, these are solved positions of one pitch with the forces on the planets.
    """
    made, turning = stages.feasible, stages.speeds
    solved = "contact" in stages.__dict__
    if solved:
        whole = len(stages.contact.fine.angle)
        chosen = np.arange(0, whole, -(-whole // FRAMES))
        angle = stages.contact.fine.angle[chosen]
    else:
        pitch = period(made.given, float(turning.relative("sun", "carrier")))
        angle = pitch * np.arange(PITCHES * PER_PITCH) / PER_PITCH
    at = poses(made.given, *(float(turning.members[name]) * angle for name in ("carrier", "ring")))
    paths = list(_lines(stages, at))
    frames = []
    for k, turned in enumerate(angle):
        lines = tuple(
            Line(name, _xy(z if z.ndim == 1 else z[k]), closed, style, group)
            for name, z, closed, style, group in paths
        )
        arrows = _pressed(stages, at, k, int(chosen[k])) if solved else _arrows(stages, at, k)
        frames.append(DrawingFrame(f"{math.degrees(turned):.1f}°", lines, tuple(arrows)))
    return Drawing(tuple(frames))


Path = tuple[str, ComplexArray, bool, str, str]


def _lines(stages: Stages, at: Poses) -> Iterator[Path]:
    """Yield each line's name, points (points,) or (frames, points), whether it is closed, style and group."""
    made, curves = stages.feasible, stages.curves
    bore_sun, bore_planet, outer = made.bores
    yield "ring", _circle(outer), True, "body", "ring"
    yield "teeth of the ring", _teeth(curves.ring) * _turn(at.ring), True, "hole", "ring"
    yield "sun", _teeth(curves.sun) * _turn(at.sun), True, "body", "sun"
    yield "bore of the sun", _circle(bore_sun), True, "hole", "sun"
    mark = np.array([bore_sun, float(made.geometry.roots[0])], dtype=complex)
    yield "mark of the sun", mark * _turn(at.sun), False, "outline", "marks"
    teeth, bore = _teeth(curves.planet), _circle(bore_planet)
    marked = np.array([bore_planet, float(made.geometry.roots[1])], dtype=complex)
    for k in range(made.given.planets):
        center = (at.center[:, k, 0] + 1j * at.center[:, k, 1])[:, None]
        yield f"planet {k + 1}", center + teeth * _turn(at.planet[:, k]), True, "body", "planets"
        yield f"bore of planet {k + 1}", center + bore, True, "hole", "planets"
        yield f"mark of planet {k + 1}", center + marked * _turn(at.planet[:, k]), False, "outline", "marks"
        yield f"pin {k + 1}", center + 0.7 * bore, True, "pin", "pins of the carrier"
    centers = at.center[..., 0] + 1j * at.center[..., 1]
    yield "carrier", centers, True, "outline", "marks"
    sun, ring = (float(made.geometry.outer.pitch_radii[0]), float(made.geometry.inner.pitch_radii[1]))
    yield "pitch circle of the sun", _circle(sun), True, "center", "pitch circles"
    yield "pitch circle of the ring", _circle(ring), True, "center", "pitch circles"


def _teeth(curve: GearCurve) -> ComplexArray:
    """Points around a whole gear, its corners among them."""
    tooth = np.concatenate((HALF_TOOTH, 1.0 - HALF_TOOTH[::-1]))
    points = curve.point((np.arange(int(curve.period))[:, None] + tooth).ravel())
    return np.asarray(points[:, 0] + 1j * points[:, 1])


def _circle(radius: float) -> ComplexArray:
    return np.asarray(radius * np.exp(2j * math.pi * np.arange(ROUND) / ROUND))


def _turn(angle: Array) -> ComplexArray:
    return np.asarray(np.exp(1j * np.asarray(angle))[..., None])


def _xy(z: ComplexArray) -> Array:
    return frozen(np.stack((z.real, z.imag), axis=-1))


def _arrows(stages: Stages, at: Poses, frame: int) -> Iterator[Arrow]:
    """Forces on the planets at their pitch points and bearings."""
    found, set_ = stages.rigid, stages.feasible.geometry
    forward = math.copysign(1.0, found.tangential)
    sun, ring = float(set_.outer.pitch_radii[0]), float(set_.inner.pitch_radii[1])
    for k in range(stages.feasible.given.planets):
        center = complex(*at.center[frame, k])
        out = center / abs(center)
        for who, place, along, away in (
            ("sun", sun * out, forward * found.outer.tangential, found.outer.radial),
            ("ring", ring * out, forward * found.inner.tangential, -found.inner.radial),
            ("carrier", center, -found.tangential, -found.radial),
        ):
            force = out * (away + 1j * along)
            name = f"{who} on planet {k + 1}"
            yield Arrow(_xy(np.array(place)), _xy(np.array(force)), who, name)


def _pressed(stages: Stages, at: Poses, frame: int, position: int) -> Iterator[Arrow]:
    """Forces of the solved contacts on the planets, turned out of the carrier's frame; elastic motion is left out."""
    series = stages.contact.fine
    turn = complex(*at.center[frame, 0]) / abs(complex(*at.center[frame, 0]))
    for who, touches, sign in (("sun", series.sun, 1.0), ("ring", series.ring, -1.0)):
        force = touches.force[position]
        for i, j in np.argwhere(force > 0.0).tolist():
            point, normal = (complex(*v[position, i, j]) * turn for v in (touches.point, touches.normal))
            push = sign * force[i, j] * normal
            yield Arrow(_xy(np.array(point)), _xy(np.array(push)), who, f"{who} on planet {i + 1}")
    for i, held in enumerate(series.bearing[position]):
        center = complex(*at.center[frame, i])
        yield Arrow(
            _xy(np.array(center)),
            _xy(np.array(-complex(*held) * turn)),
            "carrier",
            f"carrier on planet {i + 1}",
        )

"""Equilibrium and power of what was solved, recomputed from the forces on the teeth alone."""

from __future__ import annotations

import numpy as np

from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.series import Series, Touches
from trochoid.kinematics.train import Speeds
from trochoid.kinematics.types import Array


def torques(series: Series) -> dict[str, Array]:
    """External torques (n,) in N·m on sun, ring and carrier about their displaced axes that hold the forces."""
    at = {name: series.moved(name)[:, :2] for name in ("sun", "ring", "carrier")}
    reach = series.planet_centers - at["carrier"][:, None]
    return {
        "sun": series.sun.moment(at["sun"][:, None]).sum(axis=1),
        "ring": -series.ring.moment(at["ring"][:, None]).sum(axis=1),
        "carrier": -_cross(reach, series.bearing).sum(axis=1),
    }


def planet_residual(series: Series) -> float:
    """Return the largest moment of the teeth's forces on a planet about its axis, over that of one mesh."""
    center = series.planet_centers
    sun, ring = series.sun.moment(center), series.ring.moment(center)
    return float(np.abs(sun - ring).max() / np.abs(sun).max())


def seat_residual(design: Design, series: Series) -> float:
    """Return how far the springs' forces of floating members are from what the teeth ask for, over a bearing force."""
    found, d = [], design.drive
    size = np.abs(series.bearing).max()
    for i, place in enumerate(series.places):
        rows = series.layout.planet(i, place)[:2] - series.layout.seat(place)
        seat = design.seat_stiffness(place)
        turned = isinstance(seat, np.ndarray)
        spring = series.motion @ rows.T @ seat if turned else seat * series.motion @ rows.T
        found.append(np.abs(spring - series.bearing[:, i]).max())
    members = {
        "sun": d.sun.bearing_stiffness,
        "carrier": d.carrier.bearing_stiffness,
        "ring": d.ring.bearing_stiffness,
    }
    for name, stiffness in members.items():
        if f"{name}.x" in series.layout.names:
            spring = stiffness * series.moved(name)[:, :2]
            found.append(np.abs(spring - series.members[name]).max())
    return float(max(found) / size)


def load_residual(series: Series) -> float:
    """Return how far the driven member's torque is from its load, relative to that."""
    found = torques(series)[series.layout.driven]
    if series.layout.driven == "carrier":  # its springs pull at their nominal places
        found = -_cross(series.places, series.bearing).sum(axis=1)
    return float(np.abs(found - series.load.driven).max() / abs(series.load.driven))


def torque_residual(series: Series) -> float:
    """Return the sum of all external torques about the main axis, over the largest."""
    found, members = torques(series), series.members
    total = sum(found.values())
    for name, force in members.items():  # their bearings hold them where they have gone
        total = total - _cross(series.moved(name)[:, :2], force)
    out = series.places / np.linalg.norm(series.places, axis=1, keepdims=True)
    total = total + series.load.centrifugal * _cross(series.planet_centers, out).sum(axis=1)
    return float(np.abs(total).max() / max(float(np.abs(t).max()) for t in found.values()))


def power_residual(series: Series, turning: Speeds) -> float:
    """Return what of the power is neither given out nor taken by teeth that are pressed, over the driven member's.

    At the members' ideal speeds a pair of teeth takes its force times the speed at which it closes: nothing on ideal
    flanks, a little where tip edges meet early and where relief changes the ratio.
    """
    found = torques(series)
    relative = {name: float(turning.relative(name, "carrier")) for name in ("sun", "planet", "ring")}
    given = found["sun"] * relative["sun"] + found["ring"] * relative["ring"]
    center = series.planet_centers
    taken = _closing(
        series.sun, (series.moved("sun")[:, None, :2], relative["sun"]), (center, relative["planet"])
    )
    taken += _closing(
        series.ring, (center, relative["planet"]), (series.moved("ring")[:, None, :2], relative["ring"])
    )
    through = np.abs(found["sun"] * relative["sun"]).max()
    return float(np.abs(given - taken).max() / through)


def _closing(touches: Touches, one: tuple[Array, float], two: tuple[Array, float]) -> Array:
    """Return Σ F·(closing speed) (n,) of two members about centres (n, N, 2) at their speeds."""
    speed = np.zeros(touches.force.shape)
    for (center, turn), sign in ((one, 1.0), (two, -1.0)):
        arm = touches.point - np.broadcast_to(center, (*touches.point.shape[:2], 2))[:, :, None]
        speed += sign * turn * _cross(arm, touches.normal)
    return np.asarray((touches.force * speed).sum(axis=(1, 2)))


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])

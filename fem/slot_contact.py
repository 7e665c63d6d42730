"""An elastic pin in a slot of an elastic wheel: pressure along the wall and stiffness anywhere in the slot.

Where a wall comes nearer by the angle u, a place at the distance ρ from the centre comes nearer by u ρ:

    u ρ_i = Σ_j (S_wall(α) + S_pin)_ij F_j + δ_i(F_i),   N(u, α) = Σ F_i ρ_i,

S by finite elements without the contact's own narrowness, δ that of both bodies in plane strain (see `cone_law`).
A barrel is one point contact of Hertz with a number S for each body.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_law import Side, SliceLaw
from trochoid.fem.pin_slot import Pin, Pressed, crowned
from trochoid.fem.point_contact import PointLaw
from trochoid.fem.slot_pin import PinBody
from trochoid.fem.slot_wall import Wall
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, BoolArray

PASSES = 80
RETURNS = 40  # passes after which slices let go stay apart: what they overlap by then is rounding
SETTLED = 1e-11  # of the largest force
FAINT = 1e-9  # of the largest force: laws are linearised there at the least


@dataclass(frozen=True, eq=False, slots=True)
class ElasticPair:
    """The pin's dimensions, its body, and the wall; `at` along the slot is the angle α (rad) from the wheel's axis."""

    pin: Pin
    body: PinBody
    wall: Wall

    @property
    def rho(self) -> Array:
        """Distances (f,) of slices from the centre, m; of a barrel its own."""
        if self.pin.shape == "barrel":
            return np.array([self.pin.distance])
        return self.wall.slices.middle


def press_elastic(pair: ElasticPair, angle: Array, reach: Array) -> Pressed:
    """Press the pin by angles u (n,), none negative, at angles α (n,).  Raises NotConverged."""
    own, blunt = pair.wall.at(reach)
    own = own + pair.body.own
    if pair.pin.shape == "barrel":
        return _point(pair, angle, own[:, 0, 0])
    law = _law(pair, blunt)
    rho = pair.rho
    asked = angle[:, None] * rho
    force, touching = _balanced(law, own, asked)
    slope = law.approach(np.maximum(force, 1e-300))[1]
    rate = _solved(own, slope, np.broadcast_to(rho, asked.shape), touching)
    width = np.where(touching, law.half_width(force), 0.0)
    return Pressed(force @ rho, rate @ rho, force, law.pressure(force), width, np.zeros(len(angle)))


def _law(pair: ElasticPair, blunt: Array) -> SliceLaw:
    pin, wall, body = pair.pin, pair.wall, pair.body
    rho = wall.slices.middle
    opening = math.asin(pin.radius / pin.distance)
    radius = np.full(rho.shape, pin.radius)
    if pin.shape == "cone":
        radius = rho * math.sin(opening) * math.cos(opening)
    sides = (
        Side(wall.kernel, wall.poissons_ratio, wall.ends, blunt),
        Side(body.kernel, body.poissons_ratio, body.ends, body.blunt),
    )
    return SliceLaw(wall.slices, sides, radius)


def _balanced(law: SliceLaw, own: Array, asked: Array) -> tuple[Array, BoolArray]:
    """Forces (n, f), none negative: Newton, slices that would pull are let go, those that overlap are taken in."""
    touching = asked > 0.0
    force = np.where(touching, asked / (np.abs(own).sum(axis=2).max() + 1e-30), 0.0)
    for number in range(PASSES):
        at = np.maximum(force, FAINT * np.maximum(force.max(axis=1, keepdims=True), 1e-200))
        value, slope = law.approach(at)
        found = _solved(own, slope, asked - value + slope * at, touching)
        overlap = asked - np.einsum("nij,nj->ni", own, np.maximum(found, 0.0)) > 0.0
        back = overlap & (asked > 0.0) & (number < RETURNS)
        now = np.where(touching, found > 0.0, back)
        size = np.maximum(np.abs(found).max(axis=1), 1e-300)
        change = np.abs(found - force).max(axis=1) / size
        found = np.where(now & (found <= 0.0), FAINT * size[:, None], np.maximum(found, 0.0))
        settled = bool((now == touching).all()) and bool((change <= SETTLED).all())
        force, touching = found, now
        if settled:
            return force, touching
    raise NotConverged(
        f"contact of pin and slot: forces still change by {float(change.max()):.3g} of the largest after {PASSES} "
        "passes; take a thicker pin or a smaller load"
    )


def _solved(own: Array, slope: Array, asked: Array, touching: BoolArray) -> Array:
    both = touching[:, :, None] & touching[:, None, :]
    matrix = np.where(both, own, 0.0)
    i = np.arange(own.shape[1])
    scale = float(np.abs(own[:, i, i]).mean()) or 1.0
    matrix[:, i, i] += np.where(touching, slope, scale)
    found: Array = np.linalg.solve(matrix, np.where(touching, asked, 0.0)[:, :, None])[:, :, 0]
    return found


def _point(pair: ElasticPair, angle: Array, smooth: Array) -> Pressed:
    """Hertz's point contact in series with S (n,) in m/N."""
    pin = pair.pin
    contact = crowned(pin)
    forces = np.array(
        [
            PointLaw(contact, float(s)).force(np.array([u * pin.distance]))[0]
            for u, s in zip(angle, smooth, strict=True)
        ]
    )
    yields = PointLaw(contact).approach(np.maximum(forces, 1e-300))[1] + smooth
    along, across = contact.semi_axes(forces)
    return Pressed(
        forces * pin.distance,
        np.where(forces > 0.0, pin.distance**2 / yields, 0.0),
        forces[:, None],
        np.asarray(contact.pressure(forces))[:, None],
        across[:, None],
        along,
    )

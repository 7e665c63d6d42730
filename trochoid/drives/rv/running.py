"""The drive while it runs with friction: flanks slide past the ring pins, teeth of sun and planets past each other.

Members turn as rigid ones do, so the direction of sliding is known and friction is a load: μN against the sliding, at
the ring pins. It changes the normal forces N, and these it; the contacts are solved until both agree. What the teeth
lose is a share of the power that they pass on (`tooth_loss_factor`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.anderson import fixed_points, unsettled
from trochoid.drives.rv.balance import across
from trochoid.drives.rv.bodies import Level
from trochoid.drives.rv.contact import Layout, assembly, layout, ring_turn
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.first_stage import Stage
from trochoid.drives.rv.series import turn_angles
from trochoid.fem.pair import tangent_of
from trochoid.fem.position import Assembly, Contact, Touch, solve_positions
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, frozen

POSITIONS = 8  # over a turn of the crankshafts: the mean loss is known to 1e-4 of itself
SETTLED = 1e-10  # change of the friction forces, relative to all forces
BALANCED = 1e-9  # what may be left of it where rounding does not let it settle


@dataclass(frozen=True, slots=True)
class Running:
    """What is lost at input angles (n,) in rad, J per radian of the crankshafts seen from the carrier: at ring pins
    (n, d) and teeth (n,). `residual`: how far sun and ring miss what is stored and lost at the pins, relative to the
    ring's.
    """

    angle: Array
    pins: Array
    teeth: Array
    residual: float


def run(design: Design, rung: str, level: Level) -> Running:
    """Solve the running drive at a few angles over a turn of the crankshafts. Raises NotConverged with the angle."""
    angle = np.linspace(0.0, turn_angles(design, 1)[-1], POSITIONS, endpoint=False)
    crank, motions = design.crank_angle(angle), layout(design, level.teeth, level.cranks)
    problem = assembly(design, motions, level.elastic, crank)
    found: list[Contact] = []

    def again(load: Array) -> tuple[Array, Array]:
        loaded = replace(problem, load=problem.load + load)
        found.append(solve_positions(loaded, rung == "strips", found[-1] if found else None))
        return _friction(design, motions, problem, found[-1], crank)

    try:
        _, left = fixed_points(again, np.zeros_like(problem.load), SETTLED)
    except NotConverged as fault:
        at = np.degrees(angle[fault.row or 0])
        raise NotConverged(f"running with friction, at input angle {at:.6g}°: {fault}") from fault
    if not left.max() <= BALANCED:
        effect = design.scene.friction
        given = {} if effect is None else {"ring_pins": effect.ring_pins, "teeth": effect.teeth}
        raise NotConverged(unsettled(float(angle[left.argmax()]), float(left.max()), given))
    return _gathered(design, motions, found[-1], angle, crank)


def tooth_loss_factor(stage: Stage) -> float:
    """Return H_v: the power that teeth lose is μ H_v of what they pass on (Ohlendorf; ISO/TR 14179-2).

    π(u + 1)/(z1 u) · (1 − ε_α + ε_1² + ε_2²) with the tips' shares ε_1, ε_2 of the contact ratio.
    """
    pair, pitch = stage.pair, math.pi * stage.pair.first.module * math.cos(stage.pair.first.pressure_angle)
    sine = math.sin(float(pair.operating_angle))
    one, two = (
        (float(gear.curvature_radius(tip)) - float(radius) * sine) / pitch
        for gear, tip, radius in zip((pair.first, pair.second), stage.tips, pair.pitch_radii, strict=True)
    )
    u = pair.ratio
    return math.pi * (u + 1) / (pair.first.teeth * u) * (1 - (one + two) + one**2 + two**2)


def _rates(design: Design, i: int, touch: Touch, crank: Array) -> Array:
    """Velocity (n, c, 2) of disc i past the ring at its pins, m per radian of the crankshafts seen from the carrier."""
    swing = across(design.eccentric(i, crank))[:, None]
    return np.asarray(swing - float(ring_turn(design, np.array(1.0))) * across(touch.state.point))


def _friction(
    design: Design, motions: Layout, problem: Assembly, contact: Contact, crank: Array
) -> tuple[Array, Array]:
    """Return the loads (n, k) of friction on the motions, and for each motion the size of what they are made of.

    When the carrier is driven the ring's torque is what sun and carrier leave it: losses lower it.
    """
    effect, sense = design.scene.friction, math.copysign(1.0, design.turning)
    load, size = np.zeros_like(problem.load), np.zeros_like(problem.load)
    for family in problem.families:
        if effect is None or not family.name.startswith("ring"):
            continue
        touch = contact.touches[family.name]
        speed = (
            _rates(design, int(family.name.removeprefix("ring")), touch, crank)
            * tangent_of(touch.state.normal)
        ).sum(axis=-1)
        arms = family.pair.sliding(touch.state, contact.motion)
        load -= np.einsum("nc,nck->nk", effect.ring_pins * touch.force * np.sign(sense * speed), arms)
        size += np.einsum("nc,nck->nk", touch.force, np.abs(arms))
    load[:, -1] -= _shift(design, motions, contact)
    return load, size


def _shift(design: Design, motions: Layout, contact: Contact) -> Array:
    """Return by how much the ring's torque (n,) falls short of that without losses."""
    if design.driven == "ring":
        return np.zeros(len(contact.motion))
    # teeth through which the sun gives power ask for more of it; where the ring drives they pass on less
    sun = _sun_torque(design, motions, contact) * (1 - math.copysign(_teeth_share(design), design.turning))
    return np.asarray(sun - (design.scene.operation.output_torque - design.ring_torque))


def _sun_torque(design: Design, motions: Layout, contact: Contact) -> Array:
    """Torque (n,) of the sun by the normal forces of its teeth."""
    force = motions.supports.mesh_forces(motions.of_cranks(contact.motion))
    return np.asarray(force.sum(axis=1) * design.first.pair.first.base_radius)


def _teeth_share(design: Design) -> float:
    effect = design.scene.friction
    return 0.0 if effect is None else effect.teeth * tooth_loss_factor(design.first)


def _gathered(design: Design, motions: Layout, contact: Contact, angle: Array, crank: Array) -> Running:
    effect, sense = design.scene.friction, math.copysign(1.0, design.turning)
    pins, stored = [], np.zeros(len(angle))
    for i in range(len(design.discs)):
        touch = contact.touches[f"ring{i}"]
        speed = _rates(design, i, touch, crank)
        along = np.abs((speed * tangent_of(touch.state.normal)).sum(axis=-1))
        pins.append((0.0 if effect is None else effect.ring_pins) * (touch.force * along).sum(axis=1))
        stored += sense * (touch.force * (speed * touch.state.normal).sum(axis=-1)).sum(axis=1)
        swing = across(design.eccentric(i, crank))[:, None]
        for j, place in enumerate(design.crank_places):
            rollers = contact.touches[f"arm{i}_{j}"]
            axis = place + contact.motion @ motions.crank(j, i)[:2].T
            speed = swing - across(rollers.state.point - axis[:, None])
            stored += sense * (rollers.force * (speed * rollers.state.normal).sum(axis=-1)).sum(axis=1)
    table = design.drive.first_stage
    sun = _sun_torque(design, motions, contact) * table.z_planet / table.z_sun
    ring = (design.ring_torque - _shift(design, motions, contact)) * float(ring_turn(design, np.array(1.0)))
    missing = sense * (ring - sun) - stored - np.sum(pins, axis=0)
    return Running(
        frozen(angle),
        frozen(np.stack(pins, axis=1)),
        frozen(_teeth_share(design) * np.abs(sun)),
        float(np.abs(missing / ring).max()),
    )

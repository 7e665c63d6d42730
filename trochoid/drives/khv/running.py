"""The drive while it runs with friction: at every input angle each contact slides, in a direction that is known.

Friction is then a load: μN against the sliding, at the contact. It changes the normal forces N, and these it; the
contacts are solved until both agree.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace

import numpy as np

from trochoid.drives.anderson import fixed_points, unsettled
from trochoid.drives.khv.contact import Layout, assembly, centrifugal, layout
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.sliding import Rates, disc_turning, partner_turning, rates
from trochoid.fem.pair import tangent_of
from trochoid.fem.position import Assembly, Contact, ElasticBody, Touch, solve_positions
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, frozen

SETTLED = 1e-10  # change of the friction forces, relative to all forces
BALANCED = 1e-9  # what may be left of it where rounding does not let it settle
POSITIONS = 12  # over a turn: the mean loss is known to 3e-4 of itself
FINE = 1e-3  # tolerance below which four times as many are taken


@dataclass(frozen=True, slots=True)
class Running:
    """What a running drive takes, gives and loses at input angles (n,) in rad, per radian of crank past the ring.

    `ring` and `output` (n, d, c) are losses of single contacts and `stored` (n,) goes into elastic energy, in J/rad;
    `ring_force`, `output_force` (n, d, c) in N; `input_torque` and `flange_torque` (n,) in N·m. `residual` is how far
    the work put in misses what is given, stored and lost, relative to it.
    """

    angle: Array
    ring: Array
    output: Array
    stored: Array
    ring_force: Array
    output_force: Array
    input_torque: Array
    flange_torque: Array
    residual: float

    @property
    def every_second(self) -> Running:
        """The same at every second angle."""
        arrays = {f.name: getattr(self, f.name)[::2] for f in fields(self) if f.name != "residual"}
        return replace(self, **arrays)


@dataclass(frozen=True, slots=True)
class _At:
    """Contacts at crank angles (n,) with what their surfaces do there."""

    design: Design
    motions: Layout
    problem: Assembly
    crank: Array
    contact: Contact

    @property
    def motion(self) -> Array:
        """The motion (n, k) at which contacts were looked at: the hand calculation looks at their nominal places."""
        return self.contact.motion if self.problem.follow else np.zeros_like(self.contact.motion)

    @property
    def rates(self) -> dict[str, Rates]:
        """Speeds of all surfaces."""
        states = {name: touch.state for name, touch in self.contact.touches.items()}
        return rates(self.design, self.motions, states, self.motion, self.crank)


def coefficients(design: Design) -> dict[str, float]:
    """Return the coefficient of friction of each kind of contact that slides; none without the effect."""
    friction = design.scene.friction
    return {} if friction is None else {"ring": friction.ring_pins, "output": friction.output_pins}


def kind_of(family: str) -> str:
    """Return "ring", "output" or "bearing" of the family of a disc."""
    return family.rstrip("0123456789")


def running_angles(tolerance: float) -> Array:
    """Return input angles (n,) over a turn: losses vary little, and hardly at all between them."""
    count = POSITIONS if tolerance >= FINE else 4 * POSITIONS
    return np.asarray(2 * np.pi * np.arange(count) / count)


def run(design: Design, rung: str, bodies: tuple[ElasticBody, ...], angles: Array) -> Running:
    """Solve the running drive at input angles (n,) in rad. Raises NotConverged with the angle."""
    crank, motions = angles * design.mesh_speed, layout(design, rung)
    problem = assembly(design, rung, bodies, crank)
    found: list[_At] = []

    def again(load: Array) -> tuple[Array, Array]:
        loaded = replace(problem, load=problem.load + load)
        start = found[-1].contact if found else None
        found.append(_At(design, motions, problem, crank, solve_positions(loaded, rung == "strips", start)))
        return _friction(found[-1])

    try:
        _, left = fixed_points(again, np.zeros_like(problem.load), SETTLED)
    except NotConverged as fault:
        at = np.degrees(angles[fault.row or 0])
        raise NotConverged(f"running with friction, at input angle {at:.6g}°: {fault}") from fault
    if not left.max() <= BALANCED:
        given = {f"{kind}_pins": value for kind, value in coefficients(design).items()}
        raise NotConverged(unsettled(float(angles[left.argmax()]), float(left.max()), given))
    return _gathered(found[-1], angles)


def _lost(at: _At) -> dict[str, Array]:
    """Return what single contacts (n, c) lose, J/rad, by family."""
    kinds, speeds = coefficients(at.design), at.rates
    return {
        name: kinds.get(kind_of(name), 0.0) * touch.force * np.abs(speeds[name].sliding)
        for name, touch in at.contact.touches.items()
    }


def _friction(at: _At) -> tuple[Array, Array]:
    """Return the loads (n, k) of friction on the motions, and for each motion the size of what they are made of.

    When the flange is held and the ring gives the torque, the flange's share of it falls by what is lost: with it
    the torques of input, flange and ring are in balance.
    """
    speeds, kinds = at.rates, coefficients(at.design)
    load, size = np.zeros_like(at.problem.load), np.zeros_like(at.problem.load)
    for family in at.problem.families:
        touch = at.contact.touches[family.name]
        if kind_of(family.name) in kinds:
            arms = family.pair.sliding(touch.state, at.motion)
            force = kinds[kind_of(family.name)] * touch.force * np.sign(speeds[family.name].sliding)
            load -= np.einsum("nc,nck->nk", force, arms)
            size += np.einsum("nc,nck->nk", touch.force, np.abs(arms))
    load[:, at.motions.names.index("output.rotation")] -= _flange_share(at.design, _lost(at))
    return load, size


def _flange_share(design: Design, lost: Mapping[str, Array]) -> Array:
    """Return by how much losses lower the flange's torque (n,): not at all when the flange itself gives it."""
    whole = np.sum([x.sum(axis=1) for x in lost.values()], axis=0)
    return np.asarray(whole / design.leverage if design.drive.fixed == "output" else 0.0 * whole)


def _gathered(at: _At, angles: Array) -> Running:
    lost, touches = _lost(at), at.contact.touches
    closed = [(touches[name].force * speed.closing).sum(axis=1) for name, speed in at.rates.items()]
    stored, whole = np.sum(closed, axis=0), np.sum([x.sum(axis=1) for x in lost.values()], axis=0)
    flange = at.design.flange_torque - _flange_share(at.design, lost)
    given = _input_torque(at)
    missing = np.abs(given - (flange / at.design.flank.lobes + stored + whole)) / np.abs(given)
    return Running(
        frozen(angles),
        frozen(_by_disc(at, "ring", lost.__getitem__)),
        frozen(_by_disc(at, "output", lost.__getitem__)),
        frozen(stored),
        frozen(_by_disc(at, "ring", lambda name: touches[name].force)),
        frozen(_by_disc(at, "output", lambda name: touches[name].force)),
        frozen(given),
        frozen(flange),
        float(missing.max()),
    )


def _by_disc(at: _At, kind: str, get: Callable[[str], Array]) -> Array:
    return np.stack([get(f"{kind}{i}") for i in range(len(at.design.discs))], axis=1)


def _input_torque(at: _At) -> Array:
    """Return the input's torque (n,) in N·m from the forces on the eccentrics alone: of their rollers, or, when those
    are not in the equations, what holds the discs.
    """
    total, speeds, inertia = np.zeros(len(at.crank)), at.rates, centrifugal(at.design, at.crank)
    for i in range(len(at.design.discs)):
        if at.motions.lateral:
            touch = at.contact.touches[f"bearing{i}"]
            shaft = partner_turning(at.design, at.motions, "bearing", i, at.motion)
            total -= (touch.force * (touch.state.normal * shaft.at(touch.state.point)).sum(axis=-1)).sum(
                axis=-1
            )
            continue
        push = -inertia[:, i]
        for kind in ("ring", "output"):
            push = push + _pushed(at, kind, at.contact.touches[f"{kind}{i}"], speeds[f"{kind}{i}"])
        disc = disc_turning(at.design, at.motions, i, at.motion, at.crank)
        total += (push * disc.velocity).sum(axis=-1)
    return total


def _pushed(at: _At, kind: str, touch: Touch, speed: Rates) -> Array:
    """Return the force (n, 2) of a disc on what it touches, friction with it."""
    along = (
        coefficients(at.design).get(kind, 0.0)
        * np.sign(speed.sliding)[..., None]
        * tangent_of(touch.state.normal)
    )
    return np.asarray((touch.force[..., None] * (touch.state.normal + along)).sum(axis=-2))

"""Reactions of a set that moves: what its own transmission error and varying mesh stiffness make of the forces.

The contacts give a quasi-static motion q and the tangent stiffness K at every position.  Its inertia lets the set
depart from it by y, in the frame of the carrier

    M (q̈ + ÿ) + 2 M Ω × (q̇ + ẏ) + M Ω × (Ω × (q + y)) + C ẏ + K(t) y = 0

with all harmonics coupled by K(t) (dynamics.hill) and C that of modes which are damped alike.  Flanks are taken to stay
in touch: where the force of a mesh falls below nothing, they would part, and `separation` says so.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.drives.planetary.moving import MAIN, Moving
from trochoid.drives.planetary.series import Series
from trochoid.dynamics.elastic import modal_damper
from trochoid.dynamics.floquet import fail_if_growing
from trochoid.dynamics.hill import lowered, rate, steady, varied
from trochoid.dynamics.modes import Modes, natural_modes
from trochoid.dynamics.spectrum import harmonics, highest_harmonic
from trochoid.dynamics.work import unmet
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

STILL = 1e-11  # of the largest force: what rounding leaves


@dataclass(frozen=True, slots=True)
class Resonance:
    """The line to which the members' inertia adds most: its harmonic, its frequency, that of the mode that answers most
    (Hz), and the magnification of this mode there.
    """

    harmonic: int
    frequency: float
    natural_frequency: float
    factor: float


@dataclass(frozen=True, slots=True)
class Reactions:
    """Over n positions of a pitch, in the carrier's frame; `static` is the same with elastic contact without inertia.

    `force`, `static_force` (n, 2) N by member: on the bearings of sun, ring, carrier. `torque`, `static_torque` (n,)
    N·m: from outside on them. `bearing`, `static_bearing` (n, N, 2) N: of the planets on their seats. `mesh` and
    `static_mesh` (n, 2, N) N: of sun and planets, planets and ring. `inertia` (n, F) are the inertia forces,
    `motion` (n, F) is q + y, `loss` W what damping takes, `growth` of free motions over a period; `balance`, `seats`
    and `work` are relative residuals.
    """

    speed: float
    force: Mapping[str, Array]
    static_force: Mapping[str, Array]
    torque: Mapping[str, Array]
    static_torque: Mapping[str, Array]
    bearing: Array
    static_bearing: Array
    mesh: Array
    static_mesh: Array
    inertia: Array
    motion: Array
    loss: float
    growth: float
    resonance: Resonance | None
    balance: float
    seats: float
    work: float

    @property
    def separation(self) -> bool:
        """Whether flanks part somewhere."""
        return bool((self.mesh < 0.0).any())


def reactions(set_: Moving, series: Series, damping: float) -> Reactions:
    """Return the forces of the moving set; `damping` of every mode. Raises TrochoidError, NotConverged."""
    if len(series.angle) < 3:
        raise TrochoidError("reactions over a pitch need at least 3 positions: raise ask.positions")
    stiffness, (mass, coriolis, centrifugal) = set_.stiffness(), set_.inertia()
    modes = natural_modes(mass, stiffness.mean(axis=0))
    damper, delay = modal_damper(mass, modes, damping)  # C = K̄ T
    left = -_accelerated(set_, set_.motion) * set_.mass @ set_.free
    whole, speed = stiffness + centrifugal, set_.speed
    y = steady(mass, damper + coriolis, whole, left, speed)
    grows = fail_if_growing(mass, damper + coriolis, whole, speed, "the varying stiffness of the meshes")
    rates = rate(y, speed)
    late = rates @ delay.T
    loss = float((rates * (rates @ damper)).sum(axis=1).mean())
    return _read(set_, series, (y, late), (modes, damping), loss, grows)


def _accelerated(set_: Moving, motion: Array) -> Array:
    """Return accelerations in the fixed space (n, F) along the axes of the carrier's frame."""
    turned, motion = set_.rate.T, lowered(motion, highest_harmonic(len(motion)))
    return np.asarray(
        rate(motion, set_.speed, 2) + 2.0 * rate(motion, set_.speed) @ turned + motion @ turned @ turned
    )


def _read(
    set_: Moving,
    series: Series,
    added: tuple[Array, Array],
    basis: tuple[Modes, float],
    loss: float,
    grows: float,
) -> Reactions:
    (y, late), free, whole = added, set_.free, set_.layout
    moved = y @ free.T
    inertia = -_accelerated(set_, set_.motion + moved) * set_.mass
    teeth = varied(set_.teeth @ free, y) + late @ (set_.teeth.mean(axis=0) @ free).T
    still, moving = set_.forces, set_.forces + teeth - inertia
    rows = {
        name: slice(whole.names.index(f"{name}.x"), whole.names.index(f"{name}.x") + 3)
        for name in _all(series)
    }
    count = len(series.places)
    size = float(np.abs(series.bearing).max())
    out = series.places / np.linalg.norm(series.places, axis=1, keepdims=True)

    def seats(resists: Array) -> Array:
        at = np.stack([resists[:, rows[f"planet{i}"]][:, :2] for i in range(count)], axis=1)
        return np.asarray(series.load.centrifugal * out - at)

    def outside(resists: Array, bearing: Array) -> tuple[dict[str, Array], dict[str, Array]]:
        own = {name: resists[:, rows[name]] for name in MAIN}
        force = {name: -own[name][:, :2] for name in MAIN}
        force["carrier"] = force["carrier"] + bearing.sum(axis=1)
        force = {name: np.where(np.abs(x) > STILL * size, x, 0.0) for name, x in force.items()}
        torque = {name: own[name][:, 2] for name in MAIN}
        torque["carrier"] = torque["carrier"] - _cross(series.places, bearing).sum(axis=1)
        return force, {name: _without_rounding(x) for name, x in torque.items()}

    bearing, static = seats(moving), seats(still)
    force, torque = outside(moving, bearing)
    static_force, static_torque = outside(still, static)
    mesh = np.stack([np.linalg.norm(x.resultant, axis=-1) for x in (series.sun, series.ring)], axis=1)
    pushed = np.stack([teeth[:, rows[f"planet{i}"]][:, :2] for i in range(count)], axis=1)
    resonance = _resonance(set_, basis[0], y, teeth - inertia, basis[1])
    supports = (moved + late @ free.T) @ set_.springs
    return Reactions(
        set_.speed,
        force,
        static_force,
        torque,
        static_torque,
        frozen(bearing),
        frozen(static),
        frozen(mesh + _along(series, pushed)),
        frozen(mesh),
        frozen(inertia),
        frozen(set_.motion + moved),
        loss,
        grows,
        resonance,
        _balance(teeth, size),
        float(np.abs((teeth + supports - inertia) @ free / _arms(set_, set_.names)).max()) / size,
        _work(set_, y, varied(set_.teeth @ free, y) + moved @ set_.springs, loss),
    )


def explain(found: Reactions) -> str:
    """Say in one sentence what inertia changes."""
    peak = found.resonance
    if peak is None:
        return "nothing varies over a pitch, and inertia changes nothing"
    which = (
        "at the mesh frequency"
        if peak.harmonic == 1
        else f"at harmonic {peak.harmonic} of the mesh frequency"
    )
    return (
        f"inertia adds most {which} ({peak.frequency:.4g} Hz), to which the mode at {peak.natural_frequency:.4g} Hz "
        f"answers, {peak.factor:.3g} times as much as to a force that rests"
    )


def _all(series: Series) -> tuple[str, ...]:
    return (*MAIN, *(f"planet{i}" for i in range(len(series.places))))


def _along(series: Series, pushed: Array) -> Array:
    """Return forces (n, 2, N) of both meshes that resist on a planet with `pushed` (n, N, 2), each along its normal."""
    ways = []
    for touches, idle in ((series.sun, (1.0, 0.0)), (series.ring, (0.0, 1.0))):
        way = touches.resultant.mean(axis=0)
        size = np.linalg.norm(way, axis=-1, keepdims=True)
        ways.append(
            np.where(size > 0.0, way / np.where(size > 0.0, size, 1.0), idle)
        )  # a planet may carry nothing
    lines = np.stack([-ways[0], ways[1]], axis=-1)  # the sun presses a planet, a planet presses the ring
    return np.asarray(np.linalg.solve(lines, pushed[..., None])[..., 0].transpose(0, 2, 1))


def _arms(set_: Moving, names: Sequence[str]) -> Array:
    """Return 1 m for motions that shift, a radius for those that turn: the arms of the forces on them."""
    reach = float(np.sqrt(set_.mass[2] / set_.mass[0]))
    return np.where([name.endswith(".rotation") for name in names], reach, 1.0)


def _balance(teeth: Array, size: float) -> float:
    """Return what teeth that press each other leave over of force, beside a planet's."""
    own = [teeth[:, axis::3].sum(axis=1) for axis in (0, 1)]
    return float(np.abs(own).max()) / size


def _work(set_: Moving, y: Array, springs: Array, loss: float) -> float:
    """Return what is left, over a period, of the power that the quasi-static motion's inertia and the varying stiffness
    give to the added motion and damping takes, beside the sum of their sizes.
    """
    rates, own = rate(y, set_.speed) @ set_.free.T, y @ set_.free.T
    drives = -_accelerated(set_, set_.motion) * set_.mass
    gyroscopic = -_accelerated(set_, own) * set_.mass
    return unmet(rates, (drives, gyroscopic, -springs), loss)


def _resonance(set_: Moving, modes: Modes, y: Array, added: Array, damping: float) -> Resonance | None:
    """Return the harmonic to which inertia adds most, and the mode that has most of its motion's energy."""
    if len(y) < 3 or not added.any():
        return None
    lines = np.linalg.norm(harmonics(added / _arms(set_, set_.layout.names))[1:], axis=1)
    i = int(np.argmax(lines))
    mass, _, _ = set_.inertia()
    answer = np.abs(harmonics(y)[i + 1] @ mass @ modes.shapes) * modes.angular_frequencies
    mode = int(np.argmax(answer))
    frequency, natural = (i + 1) * set_.speed / (2.0 * np.pi), float(modes.hertz[mode])
    if natural == 0.0:
        return None
    part = frequency / natural
    return Resonance(i + 1, frequency, natural, float(1.0 / abs(1.0 - part**2 + 2j * damping * part)))


def _without_rounding(torque: Array) -> Array:
    """Return a torque (n,) that is constant where only rounding lets it vary."""
    mean = torque.mean()
    return np.where(np.abs(torque - mean) > STILL * abs(mean), torque, mean)


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])

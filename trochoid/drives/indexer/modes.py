"""Natural frequencies of the output at frozen positions: the wheel on its pin, the load behind the shaft.

The arm turns at a prescribed speed and stands still for these modes. Over the index the pin's contact at the force of
the rigid drive holds the wheel, in the dwell the lock; without one nothing does, and the first mode is a turn of all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trochoid.drives.indexer.pin import Pair
from trochoid.drives.indexer.shaken import output_of
from trochoid.drives.indexer.wheel import WheelMass
from trochoid.dynamics.indexing_parts import Output
from trochoid.kinematics.types import Array
from trochoid.scene.drive_indexer import IndexerScene

HZ = 2.0 * math.pi


@dataclass(frozen=True, eq=False, slots=True)
class Modes:
    """Natural frequencies (Hz), lowest first: `index` (n, modes) at the drive angles `angle` (n,) rad at which the pin
    is loaded, `locked` and `free` (modes,) in the dwell; `stiffness` (n,) N·m/rad is what holds the wheel in the index.

    `parts` (n, modes): share of the pin's contact in each mode's strain energy, the rest is the shaft's.
    """

    angle: Array
    stiffness: Array
    index: Array
    parts: Array
    locked: Array
    free: Array
    output: Output


def modes(scene: IndexerScene, wheel: WheelMass, pairs: Mapping[str, Pair]) -> Mapping[str, Modes]:
    """Return the modes of all mechanisms whose pin carries anything."""
    return {name: _modes(scene, wheel, x) for name, x in pairs.items() if x.largest[0] > 0.0}


def _modes(scene: IndexerScene, wheel: WheelMass, pair: Pair) -> Modes:
    output = output_of(scene, wheel, pair)
    t, loaded = pair.loaded
    found = [solved(output, float(k)) for k in loaded.stiffness]
    return Modes(
        t,
        loaded.stiffness,
        np.array([x[0] for x in found]),
        np.array([x[1] for x in found]),
        solved(output, output.lock)[0],
        solved(output, 0.0)[0],
        output,
    )


def solved(output: Output, stiffness: float) -> tuple[Array, Array]:
    """Return frequencies (modes,) in Hz, and the share (modes,) of a `stiffness` that holds the wheel in the energy."""
    if output.shaft == 0.0:
        return np.array([math.sqrt(stiffness / output.inertia) / HZ]), np.ones(1)
    root = np.sqrt([output.inertia, output.load])
    k = np.array([[stiffness + output.shaft, -output.shaft], [-output.shaft, output.shaft]])
    values, vectors = np.linalg.eigh(k / root / root[:, None])
    rounding = 1e-12 * values[-1]
    values = np.where(values > rounding, values, 0.0)
    held = stiffness * vectors[0] ** 2 / output.inertia
    return np.sqrt(values) / HZ, np.divide(held, values, out=np.zeros(2), where=values > 0.0)

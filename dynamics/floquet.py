"""Does a varying stiffness excite itself?  The multipliers of one period tell (Floquet)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trochoid.dynamics.local_law import Local
from trochoid.dynamics.system import System
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray


def multipliers(system: System, locals_: Sequence[Local], slopes: Array, speed: float) -> ComplexArray:
    """Return by what every state (2n,) is multiplied in a period 2π/`speed`: unstable where one is larger than 1.

    `slopes` (N, m), N/m, are those of the local laws over the period, at equal instants: of a motion found by
    harmonic balance, or of a mesh at rest.  The state is carried from instant to instant by the exact solution of
    a constant stiffness, which errs with the square of the step.
    """
    from scipy.linalg import expm

    if len(slopes) < 4 or not speed > 0.0:
        raise TrochoidError(
            f"multipliers need 4 instants and a speed above 0, given {len(slopes)}, {speed} rad/s"
        )
    n = system.size
    size = 1.0 / np.sqrt(np.diag(system.mass))
    inverse = np.linalg.inv(system.mass * np.outer(size, size))
    directions = np.stack([each.direction for each in locals_], axis=1)
    step = 2.0 * np.pi / speed / len(slopes)
    fixed = np.zeros((2 * n, 2 * n))
    fixed[:n, n:] = step * np.eye(n)
    fixed[n:, n:] = -step * inverse @ (system.velocity_matrix * np.outer(size, size))
    carried = np.eye(2 * n)
    middle = 0.5 * (slopes + np.roll(slopes, -1, axis=0))
    for k in middle:
        stiffness = system.stiffness + (directions * k) @ directions.T
        fixed[n:, :n] = -step * inverse @ (stiffness * np.outer(size, size))
        carried = expm(fixed) @ carried
    return np.asarray(np.linalg.eigvals(carried), dtype=np.complex128)


def growth(system: System, locals_: Sequence[Local], slopes: Array, speed: float) -> float:
    """Return the largest size of a multiplier; free modes have 1.

    Above 1 the motion is unstable and grows until something that is not in the equations stops it.
    """
    return float(np.abs(multipliers(system, locals_, slopes, speed)).max())

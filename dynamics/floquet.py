"""Does a varying stiffness excite itself?  The multipliers of one period tell (Floquet)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from trochoid.dynamics.local_law import Local
from trochoid.dynamics.system import System
from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.kinematics.types import Array, ComplexArray

ROUNDING = 1e-6  # how far a multiplier may be above 1


def multipliers(mass: Array, velocity: Array, stiffness: Array, speed: float) -> ComplexArray:
    """Return by what every state (2k,) of M ÿ + V ẏ + K(t) y is multiplied in a period 2π/`speed`, rad/s.

    `mass`, `velocity` (k, k), `stiffness` (n, k, k) at equal instants.  The state is carried from instant to instant by
    the exact solution of a constant symmetric stiffness, between two halves of what velocities and the mean of the skew
    part do; that errs with the square of the step.  Raises TrochoidError for fewer
    than 3 instants and a speed that is not above 0.
    """
    if len(stiffness) < 3 or not speed > 0.0:
        raise TrochoidError(
            f"multipliers need 3 instants and a speed above 0, given {len(stiffness)}, {speed} rad/s"
        )
    from scipy.linalg import expm

    n, step = len(mass), 2.0 * np.pi / speed / len(stiffness)
    back = np.linalg.inv(np.linalg.cholesky(mass))  # to coordinates in which every mass is 1
    middle = back @ (0.5 * (stiffness + np.roll(stiffness, -1, axis=0))) @ back.T
    across = np.swapaxes(middle, 1, 2)
    squares, shapes = np.linalg.eigh(0.5 * (middle + across))
    reach = np.sqrt(max(float(np.abs(squares).max()), 1.0 / step**2))  # velocities in units of positions
    rest = np.zeros((2 * n, 2 * n))
    rest[n:, :n] = -0.5 * (middle - across).mean(axis=0) / reach
    rest[n:, n:] = -(back @ velocity @ back.T)
    half = expm(0.5 * step * rest)
    turned = np.sqrt(squares.astype(np.complex128)) * step
    cosine, sine = np.cos(turned).real, np.sinc(turned / np.pi).real * step

    def spread(values: Array) -> Array:
        return np.asarray((shapes * values[:, None]) @ np.swapaxes(shapes, 1, 2))

    each = np.empty((len(stiffness), 2 * n, 2 * n))
    each[:, :n, :n] = each[:, n:, n:] = spread(cosine)
    each[:, :n, n:], each[:, n:, :n] = spread(sine * reach), spread(-squares * sine / reach)
    each = half @ each @ half
    carried = np.eye(2 * n)
    for matrix in each:
        carried = matrix @ carried
    return np.asarray(np.linalg.eigvals(carried), dtype=np.complex128)


def growth(mass: Array, velocity: Array, stiffness: Array, speed: float) -> float:
    """Return by how much the fastest free motion grows over a period: above 1 the steady one is unstable.

    Free modes have 1.  An unstable motion grows until something that is not in the equations stops it.
    """
    return float(np.abs(multipliers(mass, velocity, stiffness, speed)).max())


def along(system: System, locals_: Sequence[Local], slopes: Array) -> tuple[Array, Array, Array]:
    """Return M, V and K(t) (n, k, k) of small motions beside one whose local laws have the `slopes` (n, m), N/m.

    Those of a motion found by harmonic balance, or of a mesh at rest, at equal instants of the period.
    """
    directions = np.stack([each.direction for each in locals_], axis=1)
    stiffness = system.stiffness + np.einsum("im,nm,jm->nij", directions, slopes, directions)
    return system.mass, system.velocity_matrix, stiffness


def fail_if_growing(mass: Array, velocity: Array, stiffness: Array, speed: float, what: str) -> float:
    """Return `growth`; raises NotConverged where `what`, as in "the stiffness of the meshes", excites itself."""
    found = multipliers(mass, velocity, stiffness, speed)
    fastest = found[int(np.argmax(np.abs(found)))]
    grows = float(np.abs(fastest))
    if grows > 1.0 + ROUNDING:
        period, turned = 2.0 * np.pi / speed, abs(float(np.angle(fastest))) / (2.0 * np.pi)
        raise NotConverged(
            f"{what} excites itself: free motions grow {grows:.4g} times over each period of {1e3 * period:.4g} ms "
            f"(at a multiple of {1.0 / period:.4g} Hz and {turned / period:.4g} Hz beside it), and there is no steady "
            "motion; change operation.input_speed or raise operation.damping_ratio"
        )
    return grows

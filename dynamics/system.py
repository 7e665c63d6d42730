"""A linear system M ẍ + (C + G) ẋ + K x = f(t): its receptance at any frequency, free modes included."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from trochoid.dynamics.modes import Modes, natural_modes
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, ComplexArray

FLAT = 1e-8  # of its scale, below which a dynamic stiffness is singular
HEARD = 1e-12  # of the largest load, below which what a free mode feels is rounding


@dataclass(frozen=True, eq=False)
class System:
    """`mass` M, symmetric `damping` C, `stiffness` K and, for spinning members, skew `gyroscopic` G, (n, n) each, SI.

    Coordinates may be metres and radians side by side; `names` (n) tell them apart in messages.
    """

    mass: Array
    damping: Array
    stiffness: Array
    gyroscopic: Array | None = None
    names: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """Number n of coordinates."""
        return len(self.mass)

    @property
    def velocity_matrix(self) -> Array:
        """C + G (n, n)."""
        return self.damping if self.gyroscopic is None else np.asarray(self.damping + self.gyroscopic)

    @cached_property
    def modes(self) -> Modes:
        """Undamped modes at standstill."""
        return natural_modes(self.mass, self.stiffness)

    def name(self, coordinate: int) -> str:
        """Return what a coordinate is called."""
        return self.names[coordinate] if self.names else f"coordinate {coordinate}"


def receptance(system: System, frequency: npt.ArrayLike, loads: Array) -> ComplexArray:
    """Return the motion (..., n, k) per unit of the loads (n, k) at angular frequencies (...), rad/s, all above 0.

    Raises TrochoidError where a load meets a resonance that nothing damps.
    """
    omega = np.asarray(frequency, dtype=np.float64)[..., None, None]
    if not np.all(omega > 0.0):
        raise TrochoidError(
            "a receptance needs frequencies above 0; what stands still is `static_receptance`"
        )
    size = 1.0 / np.sqrt(np.diag(system.mass))
    scale = np.outer(size, size)
    dynamic = (system.stiffness + 1j * omega * system.velocity_matrix - omega**2 * system.mass) * scale
    least = np.linalg.svd(dynamic, compute_uv=False)[..., -1]
    if np.any(least <= FLAT * omega[..., 0, 0] ** 2):
        place = np.unravel_index(int(np.argmin(least)), least.shape)
        raise TrochoidError(
            f"{omega[..., 0, 0][place] / 2 / np.pi:.6g} Hz is a natural frequency and nothing damps it: the "
            "motion grows for ever; give the joints damping, or change the speed"
        )
    moved = np.linalg.solve(
        dynamic, np.broadcast_to(size[:, None] * loads, (*dynamic.shape[:-1], loads.shape[1]))
    )
    return np.asarray(size[:, None] * moved, dtype=np.complex128)


def static_receptance(system: System, loads: Array) -> Array:
    """Return the motion (n, k) per unit of the loads (n, k) that stand still, without any motion of free modes.

    Loads of which a part drives a free mode have no equilibrium: their part is left out here; see `free_part`.
    """
    held = system.modes.angular_frequencies
    gain = np.divide(1.0, held**2, out=np.zeros_like(held), where=held > 0.0)
    shapes = system.modes.shapes
    return np.asarray(shapes @ (gain[:, None] * (shapes.T @ loads)))


def free_part(system: System, load: Array) -> float:
    """Return the share of a load (n,) that drives free modes: 0 where it is in equilibrium."""
    free = system.modes.angular_frequencies == 0.0
    modal = np.abs(system.modes.shapes.T @ load)
    largest = float((np.abs(system.modes.shapes.T) @ np.abs(load)).max(initial=0.0))
    felt = float(modal[free].max(initial=0.0))
    return felt / largest if felt > HEARD * largest else 0.0

"""A rigid casing on its mounts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, frozen

Triple = tuple[float, float, float]
NONE: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Mount:
    """Springs (N/m) and dampers (N·s/m) along x, y, z at `position` (m), and rotational ones if any."""

    position: Triple
    stiffness: Triple
    damping: Triple = NONE
    rotational_stiffness: Triple = NONE
    rotational_damping: Triple = NONE


@dataclass(frozen=True, slots=True)
class Casing:
    """Rigid casing: `mass` kg, `inertia` (3,) or (3, 3) kg·m² about its centre of mass `center`, `mounts`.

    A matrix of inertia has −∫xy dm off its diagonal.
    """

    mass: float
    inertia: Array | Triple
    center: Triple = NONE
    mounts: tuple[Mount, ...] = ()


def matrices(casing: Casing) -> tuple[Array, Array, Array]:
    """Return M, C, K (6, 6) on the displacement of the centre of mass and the small rotation about it."""
    mass, damping, stiffness = np.zeros((3, 6, 6))
    inertia = np.asarray(casing.inertia, dtype=np.float64)
    mass[:3, :3] = casing.mass * np.eye(3)
    mass[3:, 3:] = np.diag(inertia) if inertia.ndim == 1 else inertia
    if casing.mass <= 0.0 or np.linalg.eigvalsh(mass[3:, 3:]).min() <= 0.0:
        raise TrochoidError(
            f"casing mass and principal inertias must be positive, given {casing.mass} kg, {casing.inertia}"
        )
    for mount in casing.mounts:
        at = follow(mount.position, casing.center)
        stiffness += at.T @ np.diag(mount.stiffness) @ at
        damping += at.T @ np.diag(mount.damping) @ at
        stiffness[3:, 3:] += np.diag(mount.rotational_stiffness)
        damping[3:, 3:] += np.diag(mount.rotational_damping)
    return frozen(mass), frozen(damping), frozen(stiffness)


def follow(position: Triple, center: Triple) -> Array:
    """Return the (3, 6) map from a casing's motion to the displacement u + θ × r of a point of it."""
    x, y, z = np.subtract(position, center)
    turn = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    return np.hstack([np.eye(3), turn])

"""Hertz line contact in closed form: stress under an elliptical pressure, and the equivalent stress."""

from __future__ import annotations

import numpy as np

from trochoid.fem.material import Plane
from trochoid.kinematics.types import Array


def hertz_stress(position: Array, half_width: float, load: float) -> Array:
    """Return the stress (n, 3) σx, σz, τxz in Pa at `position` (n, 2): x along the surface, z into the body, in m.

    `half_width` in m, `load` in N/m. McEwen; Johnson, Contact Mechanics (4.49).
    """
    x, z = position[:, 0], position[:, 1]
    a = half_width
    inner = a**2 - x**2 + z**2
    root = np.sqrt(inner**2 + 4 * x**2 * z**2)
    m2, n2 = np.maximum(0.5 * (root + inner), 1e-300), np.maximum(0.5 * (root - inner), 0.0)
    m, n = np.sqrt(m2), np.sign(x) * np.sqrt(n2)
    peak = 2 * load / (np.pi * a)
    share = (z**2 + n2) / (m2 + n2)
    stress = np.stack([m * (1 + share) - 2 * z, m * (1 - share), n * (m2 - z**2) / (m2 + n2)], axis=-1)
    return np.asarray(-peak / a * stress)


def hertz_stress_in_plane(
    points: Array, center: Array, inward: Array, half_width: float, load: float
) -> Array:
    """Return the stress (n, 3) as xx, yy, xy in Pa at `points` (n, 2) of a contact at `center` with normal `inward`."""
    along = np.array([inward[1], -inward[0]])
    offset = points - center
    local = np.stack([offset @ along, np.maximum(offset @ inward, 0.0)], axis=-1)
    sx, sz, shear = hertz_stress(local, half_width, load).T
    (ax, ay), (bx, by) = along, inward
    return np.stack(
        [
            sx * ax * ax + sz * bx * bx + 2 * shear * ax * bx,
            sx * ay * ay + sz * by * by + 2 * shear * ay * by,
            sx * ax * ay + sz * bx * by + shear * (ax * by + ay * bx),
        ],
        axis=-1,
    )


def von_mises(stress: Array, plane: Plane) -> Array:
    """Return the equivalent stress (…,) of xx, yy, xy (…, 3)."""
    x, y, shear = np.moveaxis(stress, -1, 0)
    out = out_of_plane(stress, plane)
    return np.asarray(np.sqrt(0.5 * ((x - y) ** 2 + (y - out) ** 2 + (out - x) ** 2) + 3 * shear**2))


def out_of_plane(stress: Array, plane: Plane) -> Array:
    """Return the stress zz (…,) that holds the plane state."""
    return np.asarray(plane.out_of_plane * plane.poissons_ratio * (stress[..., 0] + stress[..., 1]))

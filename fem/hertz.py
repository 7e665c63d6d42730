"""Hertz line contact in closed form: stress under an elliptical pressure, and the equivalent stresses."""

from __future__ import annotations

import numpy as np

from trochoid.fem.half_plane import below, ellipse, surface_stress
from trochoid.fem.material import Plane
from trochoid.kinematics.types import Array


def hertz_stress(position: Array, half_width: float, load: float, tangential: float = 0.0) -> Array:
    """Return the stress (n, 3) σx, σz, τxz in Pa at `position` (n, 2): x along the surface, z into the body, in m.

    `half_width` in m, `load` in N/m; `tangential` in N/m along x, spread like the pressure, as in sliding.
    McEwen; Smith and Liu; Johnson, Contact Mechanics (4.49) and 7.1.
    """
    zeta = below(position)
    unit = ellipse(zeta, half_width)
    return surface_stress(zeta, unit.scaled(load), unit.scaled(tangential))


def local_position(points: Array, center: Array, inward: Array) -> Array:
    """Return positions (n, 2) along the surface and into the body, of `points` (n, 2) about a contact."""
    offset = points - center
    return np.stack([offset @ _along(inward), np.maximum(offset @ inward, 0.0)], axis=-1)


def in_plane(stress: Array, inward: Array) -> Array:
    """Turn σx, σz, τxz (n, 3) of a contact into xx, yy, xy (n, 3) of the plane."""
    sx, sz, shear = stress.T
    (ax, ay), (bx, by) = _along(inward), inward
    return np.stack(
        [
            sx * ax * ax + sz * bx * bx + 2 * shear * ax * bx,
            sx * ay * ay + sz * by * by + 2 * shear * ay * by,
            sx * ax * ay + sz * bx * by + shear * (ax * by + ay * bx),
        ],
        axis=-1,
    )


def hertz_stress_in_plane(
    points: Array, center: Array, inward: Array, half_width: float, load: float, tangential: float = 0.0
) -> Array:
    """Return the stress (n, 3) as xx, yy, xy in Pa at `points` (n, 2) of a contact at `center` with normal `inward`.

    `tangential` acts along (inward_y, −inward_x): the outward normal turned by +90°.
    """
    local = local_position(points, center, inward)
    return in_plane(hertz_stress(local, half_width, load, tangential), inward)


def von_mises(stress: Array, plane: Plane) -> Array:
    """Return the equivalent stress (…,) of xx, yy, xy (…, 3)."""
    x, y, shear = np.moveaxis(stress, -1, 0)
    out = out_of_plane(stress, plane)
    return np.asarray(np.sqrt(0.5 * ((x - y) ** 2 + (y - out) ** 2 + (out - x) ** 2) + 3 * shear**2))


def max_shear(stress: Array, plane: Plane) -> Array:
    """Return the largest shear stress (…,) of xx, yy, xy (…, 3): half the largest difference of principal stresses.

    The stress out of the plane is one of the three.
    """
    x, y, shear = np.moveaxis(stress, -1, 0)
    mean, radius = 0.5 * (x + y), np.hypot(0.5 * (x - y), shear)
    return np.asarray(np.maximum(radius, 0.5 * (radius + np.abs(mean - out_of_plane(stress, plane)))))


def out_of_plane(stress: Array, plane: Plane) -> Array:
    """Return the stress zz (…,) that holds the plane state."""
    return np.asarray(plane.out_of_plane * plane.poissons_ratio * (stress[..., 0] + stress[..., 1]))


def _along(inward: Array) -> Array:
    return np.array([inward[1], -inward[0]])

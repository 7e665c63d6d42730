"""Flamant's half-plane under a point force: the singular part of every contact compliance.

Complex form of Kolosov and Muskhelishvili. With ζ the position relative to the loaded point, turned so that
the body lies in Re ζ > 0, and f the force turned likewise, φ = −f ln ζ/(2π), ψ = f̄ ln ζ/(2π). A constant is
added so that on the straight surface the displacement along the force is exactly −2/(πE')·ln r.
"""

from __future__ import annotations

import numpy as np

from trochoid.fem.material import Plane
from trochoid.kinematics.types import Array


def displacement(plane: Plane, position: Array, inward: Array, force: Array) -> Array:
    """Return the displacement (n, 2) in m per N/m at `position` (n, 2) relative to the loaded point.

    `inward` (2,) is the unit normal into the body, along which the logarithm is cut on the far side; `force`
    (2,) in N/m.
    """
    turn = complex(inward[0], inward[1])
    z = (position[:, 0] + 1j * position[:, 1]) / turn
    f = complex(force[0], force[1]) / turn
    logarithm = np.log(z)
    u = -plane.kolosov * f * logarithm - f * logarithm.conj() + f.conjugate() * (z / z.conj() + 1)
    u *= turn / (4 * np.pi * plane.shear)
    return np.stack([u.real, u.imag], axis=-1)


def traction(position: Array, normal: Array, force: Array) -> Array:
    """Return the traction (n, 2) in Pa per N/m on a cut with unit `normal` (n, 2): the stress is purely radial."""
    distance2 = np.einsum("ni,ni->n", position, position)
    along_force = position @ force
    along_normal = np.einsum("ni,ni->n", position, normal)
    pull: Array = (-2 / np.pi * along_force * along_normal / distance2**2)[:, None] * position
    return pull


def stress(position: Array, force: Array) -> Array:
    """Return the stress (n, 3) as xx, yy, xy in Pa per N/m: −(2/π)(f·r̂)/r r̂⊗r̂."""
    distance2 = np.einsum("ni,ni->n", position, position)
    factor = -2 / np.pi * (position @ force) / distance2**2
    x, y = position[:, 0], position[:, 1]
    return np.asarray(factor[:, None] * np.stack([x * x, y * y, x * y], axis=-1))

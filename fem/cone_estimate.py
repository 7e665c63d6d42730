"""How sure a contact of rollers and rim is: the same positions on a mesh with half as many facets and layers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.cone_assembly import ConeContact
from trochoid.kinematics.types import Array

LEAST = 0.15  # of the worst number's relative error: single numbers agree by chance


@dataclass(frozen=True, eq=False, slots=True)
class ConeError:
    """Estimated relative errors of discretisation, over n positions.

    `motion` and `stiffness` (n,) in terms of the load's own work and of the largest entry, `share` (n,) of contact
    forces over the largest one, `pressure` (n,) of the largest pressure.
    """

    motion: Array
    stiffness: Array
    share: Array
    pressure: Array

    @property
    def worst(self) -> float:
        """The largest of all."""
        return float(
            max(x.max(initial=0.0) for x in (self.motion, self.stiffness, self.share, self.pressure))
        )


def estimate(fine: ConeContact, coarse: ConeContact, load: Array) -> ConeError:
    """Return half of what the meshes differ by, and no less than a share of the worst number's; `load` (n, k)."""
    work = [np.einsum("nk,nk->n", run.motion, load) for run in (fine, coarse)]
    motion = _relative(work[0], work[1], np.abs(work[0]))
    size = np.abs(fine.stiffness).max(axis=(1, 2))
    stiffness = _relative(fine.stiffness, coarse.stiffness, size[:, None, None]).max(axis=(1, 2))
    largest = fine.total.max(axis=1)
    share = _relative(fine.total, coarse.total, largest[:, None]).max(axis=1)
    peak = [run.pressure.max(axis=(1, 2)) for run in (fine, coarse)]
    pressure = _relative(peak[0], peak[1], peak[0])
    found = [0.5 * x for x in (motion, stiffness, share, pressure)]
    least = LEAST * np.max(found, axis=0)
    return ConeError(*(np.maximum(x, least) for x in found))


def _relative(fine: Array, coarse: Array, size: Array) -> Array:
    whole = np.broadcast_to(size, fine.shape)
    return np.divide(np.abs(fine - coarse), whole, out=np.zeros_like(fine), where=whole > 0.0)

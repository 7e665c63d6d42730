"""The lowest natural frequencies and modes of large sparse matrices by block Lanczos on the inverse.

A block of vectors finds as many equal frequencies as it is wide: free bodies have six at zero, symmetric ones pairs.
Every vector is kept and orthogonalised against all others, so that none is found twice.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg import eigh
from scipy.sparse import csc_matrix

from trochoid.fem.linear_solver import Solve
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array

WIDTH = 8  # vectors in a block: more than a free body has rigid motions
MOST = 1200  # vectors at the most
SHARP = 1e-8  # residual over the value itself; the value is then sharp to its square
SPENT = 1e-10  # of its size before, what is left of a vector that lies in those before it


def modes_below(
    mass: csc_matrix, solve: Solve, upper: float, least: float | None = None, many: int = MOST
) -> tuple[Array, Array, float]:
    """Return all natural frequencies (m,) up to `upper` Hz, rising, mass-normalised modes (n, m), and that limit.

    With `least` Hz the limit may be lower, between the two, once there are `many`.  `solve` is the factor of the
    stiffness, which is positive definite.  Raises NotConverged.
    """
    low = upper if least is None else min(least, upper)

    def enough(found: Array) -> bool:
        return bool(found.size and (found[-1] > upper or (found[-1] > low and len(found) > many)))

    hertz, modes = _lanczos(mass, solve, 0.0, enough)
    limit = upper
    if len(hertz) > many and low < hertz[-1] <= upper:
        limit = max(low, float(hertz[-2]))  # the last one found may have a twin that is not
    below = hertz <= limit
    return hertz[below], modes[:, below], limit


def lowest_modes(mass: csc_matrix, solve: Solve, count: int, shift: float = 0.0) -> tuple[Array, Array]:
    """Return the `count` lowest natural frequencies, Hz, and mass-normalised modes (n, count).

    `solve` is the factor of stiffness − shift·mass, positive definite (a free body needs shift < 0, rad²/s²).
    """
    hertz, modes = _lanczos(mass, solve, shift, lambda found: len(found) >= count)
    return hertz[:count], modes[:, :count]


def _lanczos(
    mass: csc_matrix, solve: Solve, shift: float, enough: Callable[[Array], bool]
) -> tuple[Array, Array]:
    """Return converged frequencies and modes, from the lowest on, once they are enough or all there are."""
    size = mass.shape[0]
    basis, weighed = np.empty((2, size, 0))
    product = np.empty((0, 0))  # of the basis with the inverse, in the mass's scalar product
    start = np.random.default_rng(1).normal(size=(size, min(WIDTH, size)))
    block, _ = _orthonormal(solve(mass @ start), basis, weighed, mass)
    while basis.shape[1] < MOST:
        basis, heavy = np.hstack([basis, block]), mass @ block
        weighed = np.hstack([weighed, heavy])
        answer = solve(heavy)
        column = weighed.T @ answer
        old, width = len(product), block.shape[1]
        product = np.block([[product, column[:old]], [column[:old].T, 0.5 * (column[old:] + column[old:].T)]])
        block, link = _orthonormal(answer, basis, weighed, mass)
        values, vectors = eigh(product)
        values, vectors = values[::-1], vectors[:, ::-1]
        residual = np.linalg.norm(link @ vectors[-width:], axis=0)
        sharp = (residual <= SHARP * values) & (values > 0.0)
        last = not block.shape[1]
        count = len(values) if last or sharp.all() else int(np.argmin(sharp))
        squares = shift + 1.0 / values[:count]
        hertz = np.asarray(np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi))
        if last or enough(hertz):
            return hertz, np.asarray(basis @ vectors[:, :count])
    raise NotConverged(
        f"{MOST} vectors do not hold the modes that are wanted, of {size} degrees of freedom; ask for those up to a "
        f"lower frequency than now (the highest found so far is {hertz[-1] if hertz.size else 0.0:.4g} Hz)"
    )


def _orthonormal(block: Array, basis: Array, weighed: Array, mass: csc_matrix) -> tuple[Array, Array]:
    """Return vectors (n, r) across the basis that span what is left of a block (n, w), and their parts in it (r, w)."""
    size = np.sqrt(np.einsum("ij,ij->j", block, mass @ block))
    left = block / size
    vectors = left - basis @ (weighed.T @ left)
    # the second time for what rounding left of the basis: a vector that then loses half was nothing else
    for least in (SPENT, 0.5):
        vectors = vectors - basis @ (weighed.T @ vectors)
        squares, turn = np.linalg.eigh(vectors.T @ (mass @ vectors))
        kept = squares > least**2
        vectors = vectors @ (turn[:, kept] / np.sqrt(squares[kept]))
    return vectors, vectors.T @ (mass @ left) * size

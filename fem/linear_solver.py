"""The one seam to sparse direct solvers: the fastest installed one wins, SuperLU always works.

CHOLMOD comes with cvxopt, which has wheels for every platform (scikit-sparse has none).
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
from scipy.sparse import csc_matrix, tril
from scipy.sparse.linalg import splu

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

Solve = Callable[[Array], Array]
BLOCK = 128  # columns solved at once: large enough for level-3 BLAS, small enough for the cache
RECOVERED = 1e-3  # of a known solution: rounding leaves 1e-8, a pivot that is rounding leaves everything


def installed() -> tuple[str, ...]:
    """Return the names of the solvers at hand, fastest first."""
    return ("cholmod", "superlu") if find_spec("cvxopt") else ("superlu",)


def factorise(matrix: csc_matrix, solver: str | None = None) -> Solve:
    """Factor a symmetric positive definite matrix; the returned function solves for columns (n, k).

    Raises TrochoidError when the matrix is not positive definite: a body that is not held.
    """
    name = solver or installed()[0]
    solve = _cholmod(matrix) if name == "cholmod" else _superlu(matrix)
    known = np.cos(np.arange(matrix.shape[0], dtype=np.float64))[:, None]
    if not np.abs(solve(matrix @ known) - known).max() < RECOVERED:
        raise TrochoidError("the stiffness matrix is singular to rounding: the body is not held")
    return solve


def _superlu(matrix: csc_matrix) -> Solve:
    try:
        factor = splu(
            matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
        )
    except RuntimeError as fault:
        raise TrochoidError(f"the stiffness matrix is singular ({fault}): the body is not held") from fault
    return lambda columns: np.asarray(factor.solve(np.ascontiguousarray(columns)))


def _cholmod(matrix: csc_matrix) -> Solve:
    from cvxopt import cholmod, spmatrix
    from cvxopt import matrix as dense

    lower = tril(matrix, format="coo")
    sparse = spmatrix(
        dense(lower.data), dense(lower.row.astype(np.int64)), dense(lower.col.astype(np.int64)), matrix.shape
    )
    factor = cholmod.symbolic(sparse)
    try:
        cholmod.numeric(sparse, factor)
    except ArithmeticError as fault:
        raise TrochoidError("the stiffness matrix is not positive definite: the body is not held") from fault

    def solve(columns: Array) -> Array:
        result = np.empty(columns.shape, order="F")
        flat = columns.reshape(len(columns), -1)
        out = result.reshape(len(columns), -1, order="F")
        for start in range(0, flat.shape[1], BLOCK):
            block = dense(np.asfortranarray(flat[:, start : start + BLOCK]))
            cholmod.solve(factor, block)
            out[:, start : start + BLOCK] = np.asarray(block)
        return result

    return solve

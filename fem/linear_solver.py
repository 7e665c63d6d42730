"""The one seam to sparse direct solvers: the fastest installed one wins, SuperLU always works.

CHOLMOD comes with cvxopt, which has wheels for every platform (scikit-sparse has none). PARDISO comes with pypardiso
and Intel's MKL, for x86 alone: it solves many columns twice as fast, but the set-up of a plane body, with its small
factors, takes as long or longer (`python -m benchmarks scaling`).
"""

from __future__ import annotations

import os
import sys
import weakref
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix, csr_matrix, tril, triu
from scipy.sparse.linalg import splu

from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

Solve = Callable[[Array], Array]
BLOCK = 128  # columns solved at once: large enough for level-3 BLAS, small enough for the cache
RECOVERED = (
    1e-3  # of a known solution: rounding leaves 1e-8; a pivot that is rounding, or a negative one, everything
)
PARDISO = {
    1: 1,
    2: 2,
    8: 0,
    24: 1,
}  # not the defaults; nested dissection, no refinement steps, two-level scheduling
NOT_HELD = "the stiffness matrix is not positive definite: the body is not held"


def installed() -> tuple[str, ...]:
    """Return the names of the solvers at hand, fastest first."""
    return tuple(name for name, (package, _) in SOLVERS.items() if find_spec(package))


def factorise(matrix: csc_matrix, solver: str | None = None) -> Solve:
    """Factor a symmetric positive definite matrix; the returned function solves for columns (n, k).

    Raises TrochoidError when the matrix is not positive definite (a body that is not held), or when no solver of that
    name is installed.
    """
    at_hand = installed()
    name = at_hand[0] if solver is None else solver
    if name not in at_hand:
        known = "" if name in SOLVERS else f" (known are {', '.join(SOLVERS)})"
        raise TrochoidError(f'no solver "{name}"{known}; installed are {", ".join(at_hand)}')
    solve = SOLVERS[name][1](matrix)
    known_answer = np.cos(np.arange(matrix.shape[0], dtype=np.float64))[:, None]
    if not np.abs(solve(matrix @ known_answer) - known_answer).max() < RECOVERED:
        raise TrochoidError(NOT_HELD)
    return solve


def _superlu(matrix: csc_matrix) -> Solve:
    try:
        factor = splu(
            matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
        )
    except RuntimeError as fault:
        raise TrochoidError(NOT_HELD) from fault
    if factor.U.diagonal().min() <= 0.0:  # pivots on the diagonal: LU is then LDLᵀ
        raise TrochoidError(NOT_HELD)
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
        raise TrochoidError(NOT_HELD) from fault

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


def _pardiso(matrix: csc_matrix) -> Solve:
    if (
        "PYPARDISO_MKL_RT" not in os.environ
    ):  # where wheels put the library: else all of the prefix is searched
        at_hand = sorted(Path(sys.prefix).glob("lib/libmkl_rt.so*"))
        if at_hand:
            os.environ["PYPARDISO_MKL_RT"] = str(at_hand[0])
    from pypardiso import PyPardisoSolver
    from pypardiso.pardiso_wrapper import PyPardisoError

    upper = csr_matrix(triu(matrix))
    upper.sort_indices()
    solver = PyPardisoSolver(mtype=2)  # symmetric positive definite, half of the matrix
    os.environ["PYPARDISO_MKL_RT"] = solver.libmkl._name  # else it searches for the library every time, 0.2 s
    for number, value in PARDISO.items():
        solver.set_iparm(number, value)
    try:
        solver.factorize(upper)
    except PyPardisoError as fault:
        raise TrochoidError(NOT_HELD) from fault
    solver.set_phase(33)

    def solve(columns: Array) -> Array:
        return np.asarray(solver._call_pardiso(upper, np.asfortranarray(columns)))

    weakref.finalize(solve, solver.free_memory, everything=True)
    return solve


# by the package that each needs, fastest first
SOLVERS: dict[str, tuple[str, Callable[[csc_matrix], Solve]]] = {
    "cholmod": ("cvxopt", _cholmod),
    "pardiso": ("pypardiso", _pardiso),
    "superlu": ("scipy", _superlu),
}

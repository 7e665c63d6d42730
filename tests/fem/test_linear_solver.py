"""Every sparse solver that is installed gives the same answer, and says when a body is not held."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_matrix, identity, random

from tests.fem.cases import STEEL, small_mesh
from trochoid.fem import linear_solver
from trochoid.fem.body import build_body
from trochoid.fem.elasticity import assemble, elements
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

solvers = pytest.mark.parametrize("solver", linear_solver.installed())


def _positive(size: int) -> csc_matrix:
    half = random(size, size, density=0.05, random_state=np.random.default_rng(1), format="csc")
    return csc_matrix(half @ half.T + identity(size))


@solvers
@pytest.mark.independent
@pytest.mark.parametrize("columns", [1, 3, linear_solver.BLOCK, 2 * linear_solver.BLOCK + 1])
def test_solution_is_that_of_dense_elimination(solver: str, columns: int) -> None:
    """numpy's dense LU on a random positive definite matrix, for columns within and beyond one block."""
    matrix = _positive(60)
    right = np.random.default_rng(2).normal(size=(60, columns))
    assert linear_solver.factorise(matrix, solver)(right) == pytest.approx(
        np.linalg.solve(matrix.toarray(), right), abs=1e-11
    )


@solvers
@pytest.mark.property
def test_factor_may_be_used_again_and_leaves_the_load_alone(solver: str) -> None:
    """The same columns twice give bit-equal answers; the caller's array is not written to."""
    solve = linear_solver.factorise(_positive(40), solver)
    right = np.asfortranarray(np.random.default_rng(3).normal(size=(40, 5)))
    before = right.copy()
    assert np.array_equal(solve(right), solve(right))
    assert np.array_equal(right, before)


@solvers
@pytest.mark.independent
def test_elastic_body_is_the_same_with_every_solver(solver: str) -> None:
    """The held disc under a random load: all solvers agree to rounding times the condition number."""
    mesh, _ = small_mesh()
    load: Array = np.random.default_rng(4).normal(size=(2 * len(mesh.points), 2))
    reference = build_body(mesh, STEEL, ("bore",), "superlu").solve(load)
    answer = build_body(mesh, STEEL, ("bore",), solver).solve(load)
    assert np.abs(answer - reference).max() < 1e-10 * np.abs(reference).max()


@solvers
@pytest.mark.property
def test_body_that_is_not_held_is_refused(solver: str) -> None:
    """The full matrix of a free body has three rigid motions: TrochoidError that says so."""
    mesh, _ = small_mesh()
    free = assemble(elements(mesh, STEEL), 2 * len(mesh.points))
    with pytest.raises(TrochoidError, match="not held"):
        linear_solver.factorise(free, solver)


@pytest.mark.property
def test_superlu_is_always_installed() -> None:
    """The seam has a solver that comes with SciPy; the fastest is first."""
    assert linear_solver.installed()[-1] == "superlu"

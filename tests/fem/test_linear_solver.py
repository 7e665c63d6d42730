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


@solvers
@pytest.mark.property
def test_indefinite_matrix_is_refused(solver: str) -> None:
    """A regular matrix with one negative eigenvalue can be factored by elimination, but is no stiffness."""
    matrix = _positive(40).tolil()
    matrix[7, 7] -= 100.0
    with pytest.raises(TrochoidError, match="not positive definite"):
        linear_solver.factorise(csc_matrix(matrix), solver)


@solvers
@pytest.mark.property
def test_caller_does_not_choose(solver: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a name the first of those installed is taken: here each one is made the first in turn."""
    taken: list[str] = []
    package, factor = linear_solver.SOLVERS[solver]

    def noted(matrix: csc_matrix) -> linear_solver.Solve:
        taken.append(solver)
        return factor(matrix)

    others = {name: entry for name, entry in linear_solver.SOLVERS.items() if name != solver}
    monkeypatch.setattr(linear_solver, "SOLVERS", {solver: (package, noted), **others})
    linear_solver.factorise(_positive(20))
    assert taken == [solver]


@pytest.mark.property
@pytest.mark.parametrize(
    ("missing", "left"),
    [
        ((), ("cholmod", "pardiso", "superlu")),
        (("pypardiso",), ("cholmod", "superlu")),
        (("cvxopt",), ("pardiso", "superlu")),
        (("pypardiso", "cvxopt"), ("superlu",)),
    ],
)
def test_fastest_installed_is_first(
    missing: tuple[str, ...], left: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The order is fixed, what is not installed drops out, and SuperLU, which comes with SciPy, is always left."""
    monkeypatch.setattr(linear_solver, "find_spec", lambda name: None if name in missing else object())
    assert linear_solver.installed() == left


@pytest.mark.property
def test_superlu_does_it_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """With neither pypardiso nor cvxopt a body is built all the same."""
    monkeypatch.setattr(linear_solver, "find_spec", lambda name: object() if name == "scipy" else None)
    mesh, _ = small_mesh()
    load = np.ones((2 * len(mesh.points), 1))
    assert np.isfinite(build_body(mesh, STEEL, ("bore",)).solve(load)).all()


@pytest.mark.property
def test_unknown_solver_is_refused() -> None:
    """The complaint lists what is known and what is installed."""
    with pytest.raises(TrochoidError, match=r'no solver "mumps" \(known are .*\); installed are .*superlu'):
        linear_solver.factorise(_positive(10), "mumps")


@pytest.mark.property
def test_solver_that_is_not_installed_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is not replaced in silence by another one."""
    monkeypatch.setattr(linear_solver, "find_spec", lambda name: object() if name == "scipy" else None)
    with pytest.raises(TrochoidError, match='no solver "cholmod"; installed are superlu'):
        linear_solver.factorise(_positive(10), "cholmod")

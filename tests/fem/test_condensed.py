"""Displacements by parts are those of whole solutions, however a body is cut and held."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_matrix, random

from tests.fem.cases import STEEL, small_mesh
from trochoid.fem import linear_solver
from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import press
from trochoid.fem.condensed import displaced, through

solvers = pytest.mark.parametrize("solver", linear_solver.installed())


def _scattered(body: Body, columns: int, seed: int) -> csc_matrix:
    rng = np.random.default_rng(seed)
    return csc_matrix(
        random(body.size, columns, density=0.01, random_state=rng, data_rvs=rng.standard_normal)
    )


@solvers
@pytest.mark.independent
@pytest.mark.parametrize("supports", [(), ("bore",)])
@pytest.mark.parametrize("size", [10**9, 700, 150])
def test_parts_give_the_whole_solution(solver: str, supports: tuple[str, ...], size: int) -> None:
    """One part, few and many, against the solution for the whole body, for loads and measures anywhere."""
    body = build_body(small_mesh()[0], STEEL, supports, solver)
    load, seen = _scattered(body, linear_solver.BLOCK + 3, 1), _scattered(body, 5, 2)
    whole = seen.T @ body.solve(load.toarray())
    assert np.abs(through(body, [seen], load, size)[0] - whole).max() < 1e-9 * np.abs(whole).max()


@pytest.mark.exact
def test_free_body_is_balanced_and_measured_from_its_mean_motion() -> None:
    """Inertia relief and mean motion taken from the whole displacement field, one load at a time."""
    body = build_body(small_mesh()[0], STEEL)
    load, seen, mean = _scattered(body, 4, 3), _scattered(body, 6, 4), np.zeros((3, 4))
    relief = body.relief
    assert relief is not None
    dense = load.toarray()
    field = body.solve(dense - relief.weighted @ np.linalg.solve(relief.gram, relief.modes.T @ dense))
    field -= relief.modes @ np.linalg.solve(relief.gram, relief.weighted.T @ field)
    whole = seen.T @ field
    assert np.abs(displaced(body, [seen], load, mean)[0] - whole).max() < 1e-9 * np.abs(whole).max()


@pytest.mark.independent
def test_compliance_does_not_depend_on_the_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    """The tables of a free disc with holes, in one part and in about ten."""
    mesh, outline = small_mesh()
    body = build_body(mesh, STEEL)
    one = press(body, outline.loops)
    monkeypatch.setattr("trochoid.fem.condensed.PART", 400)
    ten = press(body, outline.loops)
    assert np.abs(one.stations - ten.stations).max() < 1e-9 * np.ptp(one.stations)

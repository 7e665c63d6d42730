"""Zeros of trigonometric polynomials, of which all are known."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.types import Array
from trochoid.kinematics.zeros import zeros_around


def product(roots: Array, x: Array) -> Array:
    """∏ sin((x − root)/2) of an even number of roots: a trigonometric polynomial of half that degree."""
    value: Array = np.prod(np.sin(0.5 * (x[:, None] - roots)), axis=-1)
    return value


@pytest.mark.exact
@given(seed=st.integers(0, 2**32 - 1), degree=st.integers(1, 60))
@settings(max_examples=40, deadline=None)
def test_all_zeros_are_found(seed: int, degree: int) -> None:
    """Random zeros all around, as many as the degree allows, no two nearer than 1e-4 of the shortest wave."""
    rng = np.random.default_rng(seed)
    gaps = rng.exponential(size=2 * degree) + 1e-4 * 2.0 * degree
    roots = -math.pi + 2.0 * math.pi * (np.cumsum(gaps) - 0.5 * gaps[0]) / gaps.sum()
    found = zeros_around(lambda x: product(roots, x), degree)
    assert found.shape == roots.shape
    np.testing.assert_allclose(found, roots, atol=1e-7)


@pytest.mark.exact
@pytest.mark.parametrize("apart", [1e-2, 1e-3, 1e-4, 1e-5])
@pytest.mark.parametrize("degree", [3, 12, 40])
def test_close_ones_are_told_apart(apart: float, degree: int) -> None:
    """A pair beside a single one, anywhere: neither hides the other, whatever cell they fall into."""
    wave = math.pi / degree
    for place in np.random.default_rng(degree).uniform(-3.0, 3.0, 10):
        near = place + wave * np.array([0.0, apart, 0.31 * math.sqrt(apart)])
        far = place + math.pi + np.linspace(-0.5, 0.5, 2 * degree - 3)
        found = zeros_around(partial(product, np.concatenate((near, far))), degree)
        off = np.abs(np.angle(np.exp(1j * (found[:, None] - near))))
        assert (off.min(axis=0) < 0.4 * apart * wave).all()


@pytest.mark.exact
def test_none_where_there_is_none() -> None:
    """A function that stays clear of zero, and one that nearly touches it."""
    assert zeros_around(lambda x: 2.0 + np.cos(5.0 * x), 5).size == 0
    assert zeros_around(lambda x: 1.0 + 1e-9 + np.cos(5.0 * x), 5).size == 0

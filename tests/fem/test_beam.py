"""Stepped shafts as beams against closed forms."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.fem.beam import Shaft, Step, shaft
from trochoid.fem.material import Material
from trochoid.kinematics.errors import Infeasible

STEEL = Material(210e9, 0.3)
G = 210e9 / 2.6


def compliance(made: Shaft, free: list[int]) -> float:
    """Deflection of the first free place per unit of force on it, all others held."""
    rest = made.bending[np.ix_(free, free)]
    return float(np.linalg.inv(rest)[0, 0])


@pytest.mark.exact
@pytest.mark.parametrize("radius", [1e-3, 1e-2, 5e-2])
def test_beam_on_two_supports(radius: float) -> None:
    """A force in the middle: P L³/48EI and P L/(4 κ G A) of shear (Timoshenko; Cowper's κ)."""
    length, area = 0.2, math.pi * radius**2
    inertia, kappa = area * radius**2 / 4, 6 * 1.3 / (7 + 6 * 0.3)
    made = shaft([Step(0.0, length, radius)], [0.5 * length, 0.0, length], STEEL)
    expected = length**3 / (48 * 210e9 * inertia) + length / (4 * kappa * G * area)
    assert compliance(made, [0]) == pytest.approx(expected, rel=1e-9)


@pytest.mark.exact
def test_overhang_and_steps() -> None:
    """An overhang a beyond a support: P a² (L + a)/3EI, slender; a step of another radius adds up in torsion."""
    length, a, radius = 1.0, 0.3, 2e-3
    inertia = math.pi * radius**4 / 4
    made = shaft([Step(0.0, length + a, radius)], [length + a, 0.0, length], STEEL)
    assert compliance(made, [0]) == pytest.approx(a**2 * (length + a) / (3 * 210e9 * inertia), rel=1e-4)
    stepped = shaft([Step(0.0, 0.1, 0.01), Step(0.1, 0.25, 0.02)], [0.0, 0.25], STEEL)
    twist = 0.1 / (G * math.pi * 0.01**4 / 2) + 0.15 / (G * math.pi * 0.02**4 / 2)
    assert 1 / stepped.torsion[0, 0] == pytest.approx(twist, rel=1e-12)


@pytest.mark.property
@settings(max_examples=30, deadline=None)
@given(
    lengths=st.lists(st.integers(1, 50), min_size=1, max_size=5),
    radii=st.lists(st.floats(5e-3, 5e-2), min_size=5, max_size=5),
    spots=st.lists(st.integers(0, 20), min_size=3, max_size=5, unique=True),
)
def test_rigid_motions_cost_nothing(lengths: list[int], radii: list[float], spots: list[int]) -> None:
    """Shifting, tilting and turning a free shaft takes no force; its stiffness is symmetric and nowhere negative."""
    ends = 1e-3 * np.cumsum([0, *lengths])
    steps = [Step(a, b, r) for (a, b), r in zip(pairwise(ends.tolist()), radii, strict=False)]
    places = (np.array(sorted(spots)) / 20 * ends[-1]).tolist()
    made = shaft(steps, places, STEEL)
    size = np.abs(made.bending).max()
    for motion in (np.ones(len(places)), np.array(places)):
        assert np.abs(made.bending @ motion).max() <= 1e-6 * size * np.abs(motion).max()
    assert np.abs(made.torsion.sum(axis=1)).max() <= 1e-9 * np.abs(made.torsion).max()
    assert np.linalg.eigvalsh(made.bending).min() >= -1e-6 * size


@pytest.mark.property
def test_places_beyond_the_shaft_are_refused() -> None:
    """The message names the place and the ends."""
    with pytest.raises(Infeasible, match=r"place 30 mm is beyond the shaft from 0 to 20 mm"):
        shaft([Step(0.0, 0.02, 0.01)], [0.0, 0.03], STEEL)

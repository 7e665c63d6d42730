"""Friction in the hard cases: a library's quadratic program gives the same, or it is refused; no wrong number."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.fem.hard_cases import METRE, MILLIMETRE, held, line_load, rubbed
from tests.fem.qp import answer, flat, forces_of, residuals, uncertainty
from tests.fem.test_hard_matrix import CLEARANCES, COMPLEMENTARY, LOADS, RATIOS, over
from trochoid.fem.complementarity import solve
from trochoid.fem.friction import Rubbed, step
from trochoid.fem.rubbing import System
from trochoid.kinematics.errors import NotConverged

FRICTION = {f"mu {value:g}": value for value in (0.0, 0.05, 0.3, 0.6, 1.0)}
SURE = 0.3  # up to here every step must be found
PUSHES = (0.0, 0.5, 0.9, -0.3)  # sideways, of μ times the load
CONDITIONS = 1e-9  # that friction is solved to


def along(system: System, push: float) -> System:
    """Push the bar sideways."""
    (rubbing,) = system.contacts
    return replace(system, load=system.load + np.array([0.0, 0.0, push * rubbing.friction * system.load[0]]))


def check_step(system: System, before: Rubbed | None, found: Rubbed) -> None:
    """With friction bounded by μ times the pressure that was found, a quadratic program gives these forces."""
    slip = np.zeros_like(found.slip[0]) if before is None else before.slip[0]
    conditions = flat(held(system, slip, found.normal[0]))
    forces = np.concatenate([found.normal[0].ravel(), found.tangential[0].ravel()])
    reached = residuals(conditions, forces, found.motion)
    assert reached.largest <= CONDITIONS, reached
    expected, motion = answer(conditions, found.motion)
    library = residuals(conditions, expected, motion)
    assert library.largest <= COMPLEMENTARY, library
    allowed = 1e-7 * float(np.abs(expected).max()) + uncertainty(conditions, expected, motion)
    assert forces == pytest.approx(expected, abs=allowed)


def tried(system: System, before: Rubbed | None) -> Rubbed | str:
    """Return where a step ends, or why it is refused."""
    try:
        return step(system, before)
    except NotConverged as refusal:
        return str(refusal)


@pytest.mark.independent
@over("ratio", RATIOS)
@over("load", LOADS)
@over("clearance", CLEARANCES)
@over("friction", FRICTION)
def test_clearance_load_and_stiffness_with_friction(
    friction: float, clearance: float, load: float, ratio: float
) -> None:
    """Issue 3: μ 0…1; pressed, pushed, pushed further, and back: above 0.3 a step may be refused, with the reason."""
    system, state = rubbed(friction, clearance, load, ratio, METRE), None
    for push in PUSHES:
        pushed = along(system, push)
        found = tried(pushed, state)
        if isinstance(found, str):
            assert friction > SURE, found
            assert f"Coulomb's law with μ = {friction:g}" in found
            return
        check_step(pushed, state, found)
        state = found


@pytest.mark.independent
@over("load", LOADS)
@over("friction", {name: value for name, value in FRICTION.items() if value <= SURE})
def test_units_do_not_matter_with_friction(friction: float, load: float) -> None:
    """Metres or millimetres: the same forces to 1e-9."""
    forces = []
    for unit in (METRE, MILLIMETRE):
        system = rubbed(friction, 1e-6, load, 1.0, unit)
        found = step(along(system, 0.5), step(system))
        both = np.concatenate([found.normal[0], found.tangential[0]])
        forces.append(both / line_load(1.0, unit))
    assert forces[1] == pytest.approx(forces[0], abs=1e-9 * float(forces[0].max()))


@pytest.mark.independent
@pytest.mark.parametrize("share", [0.0, 1e-6, 0.3, 0.9, 1 - 1e-6])
@over("ratio", RATIOS)
@over("load", LOADS)
def test_bounds_on_both_sides(load: float, ratio: float, share: float) -> None:
    """Tresca: every strip carries between −b and b; up to almost all that the bounds allow."""
    system = rubbed(0.3, 0.0, load, ratio, METRE)
    pressure = solve(
        held(replace(system), 0 * system.contacts[0].normal.gap, 0 * system.contacts[0].normal.gap)
    )
    problem = held(system, np.zeros_like(pressure.forces[0]), pressure.forces[0])
    most = 0.3 * float(pressure.forces[0].sum())
    problem = replace(problem, load=problem.load + np.array([0.0, 0.004 * share * most, share * most]))
    found, conditions = solve(problem), flat(problem)
    reached = residuals(conditions, forces_of(found), found.motion)
    assert reached.largest <= COMPLEMENTARY, reached
    forces, motion = answer(conditions, found.motion)
    assert residuals(conditions, forces, motion).largest <= COMPLEMENTARY
    allowed = 1e-9 * float(np.abs(forces).max()) + uncertainty(conditions, forces, motion)
    assert forces_of(found) == pytest.approx(forces, abs=allowed)

"""Balance of forces and torques in any drive that can be built, and the tangent stiffness of its contacts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.drives.khv_cases import all_forces, drives, imbalance, level_of
from trochoid.drives.khv.bodies import Level
from trochoid.drives.khv.design import Design, design
from trochoid.drives.khv.series import solve_at
from trochoid.scene.drive_khv import KhvScene

SLOW = (HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.data_too_large)
BALANCE = 1e-9  # issue 2: of every position, relative


def check_position(made: Design, level: Level | None, angle: float) -> None:
    """Look at one position: everything finite, no contact pulls, all members balance, the tangent is sound."""
    bodies = () if level is None else level.elastic
    contact = solve_at(made, "springs" if level is None else "level0", bodies, angle)
    force = all_forces(contact)
    assert np.isfinite(force).all()
    assert np.isfinite(contact.motion).all()
    assert force.min() >= 0.0
    assert imbalance(made, contact, angle, classical=level is None) <= BALANCE
    assert contact.imbalance <= BALANCE
    assert contact.penetration <= BALANCE
    stiffness = contact.stiffness
    assert np.array_equal(stiffness, stiffness.T)
    size = np.sqrt(np.diag(stiffness))
    scale = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0)
    assert np.linalg.eigvalsh(stiffness * np.outer(scale, scale)).min() >= -1e-9


@pytest.mark.property
@settings(max_examples=25, deadline=None, suppress_health_check=SLOW)
@given(drives(), st.floats(0, 2 * np.pi))
def test_rigid_discs_on_springs_balance(scene: KhvScene, angle: float) -> None:
    """6…60 pins, 1…3 discs, 3…12 holes, 4…24 rollers, 10 mm to 1 m, ring or output fixed, any plays: ≤ 1e-9."""
    check_position(design(scene), None, angle)


@pytest.mark.property
@settings(max_examples=6, deadline=None, suppress_health_check=SLOW)
@given(drives(pins=40, elastic=True), st.floats(0, 2 * np.pi))
def test_elastic_discs_balance(scene: KhvScene, angle: float) -> None:
    """The same with elastic discs, which share a body or not, in plane strain or stress: ≤ 1e-9."""
    made = design(scene)
    check_position(made, level_of(made), angle)

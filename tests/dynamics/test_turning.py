"""Members in a turning frame: against points that move, and against the same rotor in the fixed frame."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from trochoid.dynamics.constraint import constraint_forces, free_motions
from trochoid.dynamics.members import Member, disc_member, joint, system
from trochoid.dynamics.system import System
from trochoid.dynamics.turning import hat, mean_over_turn, standing, turning
from trochoid.dynamics.whirl import whirl
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

SPEED = 150.0
STENCIL = np.array([-73766 / 25200, 42000 / 25200, -6000 / 25200, 1000 / 25200, -125 / 25200, 8 / 25200])


def moment(turn: Callable[[float], Array], points: Array) -> Array:
    """Σ p × p̈ at t = 0 of unit masses whose places are turn(t) @ points, by a stencil of tenth order."""
    step = 2e-4
    now = points @ turn(0.0).T
    second = STENCIL[0] * now
    for k, weight in enumerate(STENCIL[1:], 1):
        second = second + weight * (points @ turn(k * step).T + points @ turn(-k * step).T)
    return np.asarray(np.cross(now, second / step**2).sum(axis=0))


@pytest.mark.independent
@pytest.mark.parametrize("spin", [0.0, -160.7, 400.0])
def test_moment_of_a_nutating_body(spin: float) -> None:
    """Points of a round body that leans, spins and turns with the frame: the moment of a small motion besides.

    The part of the stiffness that is not symmetric, −½ (Ω × H) ×, is the one that `turning` leaves out.
    """
    lean = Rotation.from_rotvec([-0.3, 0.0, 0.0]).as_matrix()
    axis = lean @ [0.0, 0.0, 1.0]
    ring = 0.05 * np.exp(2j * np.pi * np.arange(6) / 6)
    points = np.concatenate(
        [np.column_stack([ring.real, ring.imag, 0.0 * ring.real]), [[0, 0, 0.07], [0, 0, -0.07]]]
    )
    inertia = lean @ sum((p @ p * np.eye(3) - np.outer(p, p) for p in points), np.zeros((3, 3))) @ lean.T
    start, rate, bend = np.array([1.0, -0.5, 0.3]), np.array([40.0, 90.0, -70.0]), np.array([5e4, 2e4, -8e4])

    def motion(size: float) -> Callable[[float], Array]:
        def turn(t: float) -> Array:
            small = Rotation.from_rotvec(size * (start + rate * t + 0.5 * bend * t**2)).as_matrix()
            frame = Rotation.from_rotvec([0.0, 0.0, SPEED * t]).as_matrix()
            own = Rotation.from_rotvec([0.0, 0.0, spin * t]).as_matrix()
            return np.asarray(frame @ small @ lean @ own)

        return turn

    tiny = 1e-4
    found = (moment(motion(tiny), points) - moment(motion(-tiny), points)) / (2.0 * tiny)
    frame = np.array([0.0, 0.0, SPEED])
    spinning = frame + spin * axis
    member = Member("body", 8.0, inertia, spin=(spinning[0], spinning[1], spinning[2]))
    made = turning((member,), frame)
    m, g, k = (a[3:, 3:] for a in (made.mass, made.gyroscopic, made.centrifugal))
    left_out = -0.5 * hat(np.cross(frame, inertia @ spinning))
    wanted = m @ bend + g @ rate + (k + left_out) @ start
    np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-5 * np.abs(wanted).max())


@pytest.mark.exact
def test_rotor_has_the_same_modes_in_both_frames() -> None:
    """A round rotor on round bearings: frequencies of the fixed frame less or plus the speed, by their sense."""
    rotor = (disc_member("rotor", 3.0, 0.02, 0.012, 0.0, SPEED),)
    springs = [
        joint("left", rotor, None, "rotor", (0.0, 0.0, -0.15), np.diag([2e6, 2e6, 1e6, 0.0, 0.0, 5.0]))
    ]
    springs += [
        joint("right", rotor, None, "rotor", (0.0, 0.0, 0.2), np.diag([1e6, 1e6, 0.0, 0.0, 0.0, 0.0]))
    ]
    fixed = system(rotor, springs)
    made = turning(rotor, np.array([0.0, 0.0, SPEED]))
    seen = System(made.mass, 0.0 * made.mass, fixed.stiffness + made.centrifugal, made.gyroscopic)
    found, here = whirl(fixed), whirl(seen)
    across = np.abs(found.shapes[[0, 1, 3, 4]]).max(axis=0) > 1e-6
    shift = np.where(across, found.direction(0, 1), 0.0)
    wanted = np.sort(np.abs(found.frequency - shift * SPEED / (2.0 * np.pi)))
    np.testing.assert_allclose(here.frequency, wanted, rtol=1e-7)


@pytest.mark.exact
def test_standing_body_is_the_same_in_both_frames() -> None:
    """A casing that is not round: in its mean over a turn the axial motion keeps all, the rest is round."""
    mass = np.diag([4.0, 4.0, 4.0, 0.3, 0.1, 0.2])
    made = standing(mass, np.array([0.0, 0.0, SPEED]))
    np.testing.assert_allclose(np.diag(made.mass), [4.0, 4.0, 4.0, 0.2, 0.2, 0.2], rtol=1e-14)
    np.testing.assert_allclose(made.gyroscopic, -made.gyroscopic.T, atol=1e-10)
    np.testing.assert_allclose(made.centrifugal, made.centrifugal.T, atol=1e-10)
    np.testing.assert_allclose(mean_over_turn(made.mass), made.mass, atol=1e-14)


@pytest.mark.property
def test_inertia_that_changes_is_refused() -> None:
    """A body that is not round and spins in the frame; one without inertia."""
    frame = np.array([0.0, 0.0, SPEED])
    with pytest.raises(TrochoidError, match="not round about that axis"):
        turning((Member("cam", 1.0, np.diag([1.0, 2.0, 2.5])),), frame)
    turning((Member("cam", 1.0, np.diag([1.0, 2.0, 2.5]), spin=(0.0, 0.0, SPEED)),), frame)
    with pytest.raises(TrochoidError, match="above 0"):
        turning((Member("rod", 1.0, np.diag([1.0, 1.0, 0.0])),), frame)


@pytest.mark.exact
def test_rigid_joint_passes_what_is_missing() -> None:
    """A lever on a pin: one motion is left, and the pin carries force and what the lever's moment leaves."""
    rows = np.array(
        [[1.0, 0.0, 0.5], [0.0, 1.0, 0.0]]
    )  # x, y, rotation about the centre; pin half a metre off
    mass = np.diag([2.0, 2.0, 1e-3])
    basis = free_motions(rows, mass)
    assert basis.shape == (3, 1)
    np.testing.assert_allclose(rows @ basis, 0.0, atol=1e-12)
    forces = constraint_forces(rows, mass, np.array([[3.0 + 0.0j], [4.0], [1.5]]))
    np.testing.assert_allclose(forces, [[3.0], [4.0]], rtol=1e-12)
    assert free_motions(np.zeros((0, 3)), mass).shape == (3, 3)

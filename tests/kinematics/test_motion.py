"""Poses over the crank angle: pins stay in contact and rollers in their holes, whatever member is fixed."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.motion import flange_lead, khv_motions

EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)
CHOICES = [("ring", "input"), ("output", "input"), ("input", "ring"), ("ring", "output"), ("output", "ring")]


def circle(radius: float, count: int, phase: float = 0.0) -> npt.NDArray[np.float64]:
    angle = phase + 2.0 * math.pi * np.arange(count) / count
    return radius * np.stack((np.cos(angle), np.sin(angle)), axis=-1)


@pytest.mark.property
@given(choice=st.sampled_from(CHOICES), discs=st.integers(1, 3), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_all_pins_touch_all_discs(choice: tuple[str, str], discs: int, seed: int) -> None:
    """Conjugacy in the poses: pin centres seen from a disc lie r off the flank, for every fixed member."""
    angles = np.random.default_rng(seed).uniform(-10.0, 10.0, 7)
    motions = khv_motions(EXAMPLE, angles, discs, *choice)
    pins = motions["ring"].to_fixed(circle(0.08, 20))
    for i in range(discs):
        crank = motions["input"].rotation + 2.0 * math.pi * i / discs - motions["ring"].rotation
        t = EXAMPLE.contact_parameter(np.arange(20), crank[:, None])
        seen = motions[f"disc{i}"].to_member(pins)
        np.testing.assert_allclose(seen, EXAMPLE.center_path(t), atol=1e-14)


@pytest.mark.property
@given(choice=st.sampled_from(CHOICES), discs=st.integers(1, 3), seed=st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_rollers_circle_in_their_holes(choice: tuple[str, str], discs: int, seed: int) -> None:
    """A parallel crank: with the holes ahead by `flange_lead`, each roller stays e from its hole's centre."""
    angles = np.random.default_rng(seed).uniform(-10.0, 10.0, 7)
    motions = khv_motions(EXAMPLE, angles, discs, *choice)
    rollers = motions["output"].to_fixed(circle(0.052, 8, 0.3))
    for i in range(discs):
        holes = motions[f"disc{i}"].to_fixed(circle(0.052, 8, 0.3 + flange_lead(EXAMPLE, i, discs)))
        away = motions[f"disc{i}"].center[:, None] + rollers - holes
        assert np.abs(away).max() < 1e-14
        np.testing.assert_allclose(np.linalg.norm(rollers - holes, axis=-1), EXAMPLE.eccentricity, rtol=1e-11)


@pytest.mark.property
def test_member_and_fixed_frame_invert_each_other() -> None:
    """to_member(to_fixed(p)) = p."""
    motion = khv_motions(EXAMPLE, np.linspace(0.0, 6.0, 11), 2)["disc1"]
    points = circle(0.07, 5)
    back = motion.to_member(motion.to_fixed(points))
    np.testing.assert_allclose(back, np.broadcast_to(points, back.shape), atol=1e-16)


@pytest.mark.exact
def test_two_discs_balance_each_other() -> None:
    """Opposite eccentrics: the two centres cancel at every angle; arrays are read-only."""
    motions = khv_motions(EXAMPLE, np.linspace(0.0, 6.0, 11), 2)
    np.testing.assert_allclose(motions["disc0"].center + motions["disc1"].center, 0.0, atol=1e-17)
    with pytest.raises(ValueError, match="read-only"):
        motions["disc0"].center[0, 0] = 1.0


@pytest.mark.exact
def test_half_a_turn_is_the_flange_lead_only_with_an_even_number_of_pins() -> None:
    """Up to whole lobes: so with 2 | z_p the second disc is the first one turned by half a turn (sources §3).

    With odd numbers another angle may do, if the holes repeat under it: see `distinct_discs`.
    """
    for pins, half in ((20, True), (21, False)):
        cycloid = Cycloid(pins, pins - 1, 0.08, 0.004, 0.002)
        lobe = 2.0 * math.pi / cycloid.lobes
        shift = math.remainder(math.pi - flange_lead(cycloid, 1, 2), lobe)
        assert (abs(shift) < 1e-12) is half

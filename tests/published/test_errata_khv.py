"""Errata of the textbook on planetary-cycloid drives (Fomin 2009; sources §3): each printed form fails its test."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from trochoid.drives.khv.design import Design, design
from trochoid.drives.khv.series import solve_at
from trochoid.fem.position import Contact
from trochoid.kinematics.train import rv_train, speeds
from trochoid.kinematics.types import Array
from trochoid.scene import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
RV40 = (  # the disc of an RV-40E class drive, alone, with 206 N·m and 12 output pins on 40 mm
    "drive.pins=40",
    "drive.lobes=39",
    "drive.pin_circle_radius=64",
    "drive.pin_radius=3",
    "drive.eccentricity=1.3",
    "drive.discs=1",
    "drive.output_pins.count=12",
    "drive.output_pins.circle_radius=40",
    "operation.output_torque=206",
)


def classical(*overrides: str) -> Design:
    """The example's drive with other numbers, by the hand calculation: rigid discs, equal springs."""
    return design(load(EXAMPLE, ("effects=[]", 'ask.quantities=["ratio"]', *overrides)))


def resultant(contact: Contact, family: str) -> Array:
    """Force (2,) of the disc on all contacts of one family."""
    touch = contact.touches[family]
    return np.asarray(touch.force @ touch.state.normal)


@pytest.mark.published
def test_ratio_of_the_2k_v_drive() -> None:
    """Printed: u = 1 + z2 z3/(z1 (z4 − z3)), 118 for 12/36/39/40; right: z4 in the numerator, 121.

    The printed form takes the speed of the crank as it is, where it must be relative to the carrier.
    """
    z1, z2, z3, z4 = 12, 36, 39, 40
    printed = 1 + Fraction(z2 * z3, z1 * (z4 - z3))
    right = 1 + Fraction(z2 * z4, z1 * (z4 - z3))
    found = speeds(rv_train(z1, z2, z3, z4), "ring", "sun", "carrier")
    assert found.ratio == right == 121
    assert printed == 118
    crank = found.members["planet"] / found.members["carrier"]
    relative = found.relative("planet", "carrier") / found.members["carrier"]
    assert crank == -39
    assert relative == -40
    assert 1 - relative * Fraction(z2, z1) == right
    assert 1 - crank * Fraction(z2, z1) == printed


@pytest.mark.published
def test_bearing_force_needs_the_output_pins() -> None:
    """Sources §3: |E| = 6408.7 N; 4391.4 N if ΣQ of the output pins is forgotten, and the disc is not in balance."""
    made = classical(*RV40)
    crank = 0.2
    contact = solve_at(made, "springs", (), crank)
    ring, output = resultant(contact, "ring0"), resultant(contact, "output0")
    assert np.linalg.norm(ring + output) == pytest.approx(6408.7, abs=0.05)
    assert np.linalg.norm(ring) == pytest.approx(4391.4, abs=0.05)
    # what the eccentric passes on must turn it with T/(e z_c), whose power is the output's
    tangent = np.array([-np.sin(crank), np.cos(crank)])
    needed = 206.0 / (made.flank.eccentricity * made.flank.lobes)
    assert abs((ring + output) @ tangent) == pytest.approx(needed, rel=1e-12)


@pytest.mark.published
@pytest.mark.parametrize(("count", "right"), [(8, {4: 1.0}), (12, {6: 1.0}), (7, {3: 0.5, 4: 0.5})])
def test_number_of_loaded_output_pins(count: int, right: dict[int, float]) -> None:
    """Printed: z_p/2 and z_p/2 − 1 pins carry by turns; right: an even number n has n/2, an odd one (n ± 1)/2.

    n/2 − 1 is met only at the instants when two pins stand in line with the eccentricity.
    """
    made = classical(f"drive.output_pins.count={count}", "drive.discs=1")
    against_flange = 2 * np.pi * (np.arange(56) + 0.5) / 56  # of the eccentricity; none is in line
    crank = against_flange * made.flank.lobes / made.flank.pins
    found = [int((output_forces(made, a) > 0).sum()) for a in crank]
    assert {n: found.count(n) / len(found) for n in set(found)} == right
    if count % 2 == 0:
        in_line = output_forces(made, 0.0)
        assert (in_line > 1e-9 * in_line.max()).sum() == count // 2 - 1


def output_forces(made: Design, crank: float) -> Array:
    return solve_at(made, "springs", (), float(crank)).touches["output0"].force


@pytest.mark.published
@pytest.mark.parametrize(
    ("discs", "pins", "output_pins", "alike"),
    [
        (3, 21, 9, True),
        (2, 21, 8, True),
        (2, 20, 8, True),
        (3, 20, 9, True),
        (2, 20, 7, False),
        (3, 21, 8, False),
    ],
)
def test_number_of_pins_for_several_discs(discs: int, pins: int, output_pins: int, alike: bool) -> None:
    """Printed: the number of pins must be even and a multiple of the discs'; neither is needed, nor enough.

    n | z_p and n | z_w are enough for n equal discs (sources §3); two on 21 pins and three on 20 are equal too.
    """
    numbers = (f"drive.discs={discs}", f"drive.pins={pins}", f"drive.lobes={pins - 1}")
    made = classical(*numbers, f"drive.output_pins.count={output_pins}")
    assert (len(made.hole_angles) == 1) is alike


@pytest.mark.exact
@pytest.mark.parametrize(("discs", "pins", "output_pins"), [(3, 21, 9), (2, 21, 8), (3, 20, 9)])
def test_like_discs_fit_their_rollers(discs: int, pins: int, output_pins: int) -> None:
    """One body for all discs: at any crank angle every one of its holes touches its roller, D_o = d_b + 2e."""
    numbers = (f"drive.discs={discs}", f"drive.pins={pins}", f"drive.lobes={pins - 1}")
    made = classical(*numbers, f"drive.output_pins.count={output_pins}")
    for crank in (0.0, 0.3, 2.0):
        contact = solve_at(made, "springs", (), crank)
        for i in range(discs):
            for family in (f"ring{i}", f"output{i}"):
                assert np.abs(contact.touches[family].state.gap).max() < 1e-15

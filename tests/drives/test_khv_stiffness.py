"""Torque against twist, the tangent stiffness of the drive, and what makes it stiffer."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from tests.drives.khv_cases import EFFECTS, drive, level_of, turn, without
from trochoid.drives.khv.contact import assembly, layout
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.series import Series
from trochoid.fem.position import solve_position

POSITIONS = 4
FLANGE = "drive.output_flange.bearing_stiffness={}"


@cache
def over_a_turn(*overrides: str, effects: tuple[str, ...] = EFFECTS, elastic: bool = True) -> Series:
    """Return the example's contacts on a coarse mesh."""
    made = drive(*overrides, effects=effects)
    return turn(made, level_of(made) if elastic else None, POSITIONS)


def slope(made: Design, angle: float, torque: float) -> tuple[float, float]:
    """Return a central difference of torque over twist, and the tangent, N·m/rad, with all laws held."""
    row = layout(made, "level0").names.index("output.rotation")
    problem = assembly(made, "level0", level_of(made).elastic, angle)
    middle = solve_position(problem)
    twist = []
    for step in (-torque, torque):
        load = problem.load.copy()
        load[row] += step
        twist.append(float(solve_position(replace(problem, load=load), start=middle).motion[row]))
    compliance = np.linalg.inv(middle.stiffness)
    return 2 * torque / (twist[1] - twist[0]), 1 / compliance[row, row]


@pytest.mark.exact
@pytest.mark.parametrize("effects", [EFFECTS, without("bearing_compliance"), without("clearance")])
def test_tangent_is_the_slope_of_torque_over_twist(effects: tuple[str, ...]) -> None:
    """Finite difference of ±2 N·m about 400 N·m. The tangent knows that normals turn with the motions, not that

    contacts wander over the discs, whose compliance varies from place to place: 3e-4 is left (see `fem.moving`).
    """
    for angle in (0.0, 0.37):
        found, tangent = slope(drive(effects=effects), angle, 2.0)
        assert tangent == pytest.approx(found, rel=3e-4)


@pytest.mark.property
@pytest.mark.parametrize("elastic", [True, False])
def test_more_torque_twists_more_and_stiffens(elastic: bool) -> None:
    """At every position: the twist grows with the torque; plays close and contacts widen, so the drive stiffens."""
    effects = EFFECTS if elastic else without("elastic_contact")
    torques = (1.0, 10.0, 100.0, 400.0, 2000.0)
    found = [over_a_turn(f"operation.output_torque={t}", effects=effects, elastic=elastic) for t in torques]
    for less, more in pairwise(found):
        assert (more.twist > less.twist).all()
        if elastic:
            assert (more.torsional_stiffness > less.torsional_stiffness).all()


@pytest.mark.property
def test_stiffness_is_symmetric_and_positive() -> None:
    """Action is reaction, and no motion of the loaded drive runs away."""
    for stiffness in over_a_turn().stiffness:
        size = np.sqrt(np.diag(stiffness))
        unitless = stiffness / np.outer(size, size)
        assert np.array_equal(unitless, unitless.T)
        assert np.linalg.eigvalsh(unitless).min() > 1e-6


@pytest.mark.property
@pytest.mark.parametrize(
    ("overrides", "effects"),
    [
        ((), without("pin_compliance")),
        ((), without("bearing_compliance")),
        ((FLANGE.format(1e6),), EFFECTS),
        (("materials.steel.youngs_modulus=230000",), EFFECTS),
    ],
)
def test_what_yields_less_is_stiffer(overrides: tuple[str, ...], effects: tuple[str, ...]) -> None:
    """Rigid pins, rigid bearings, stiffer bearings, a stiffer material: less twist at every position."""
    plain, stiffer = over_a_turn(), over_a_turn(*overrides, effects=effects)
    assert (stiffer.twist < plain.twist).all()
    assert (stiffer.torsional_stiffness > plain.torsional_stiffness).all()


@pytest.mark.property
def test_play_is_closed_before_anything_twists() -> None:
    """5 µm of play at the holes turn the flange by at least 5 µm over the pins' circle before they carry."""
    tight = over_a_turn("drive.output_pins.hole_clearance=0")
    loose = over_a_turn()
    assert (loose.twist > tight.twist + 5e-6 / 0.052).all()


@pytest.mark.exact
def test_twist_scales_with_all_moduli() -> None:
    """Without play and inertia, torque and moduli × 10 give the same twist, forces × 10."""
    effects = without("clearance", "inertia")
    ten = (
        "materials.steel.youngs_modulus=2100000",
        "drive.input_shaft.bearing_stiffness=3000000",
        FLANGE.format(5e6),
        "operation.output_torque=4000",
    )
    one, made = drive(effects=effects), drive(*ten, effects=effects)
    plain, other = turn(one, level_of(one), 2), turn(made, level_of(made), 2)
    assert other.twist == pytest.approx(plain.twist, rel=1e-9)
    assert other.ring.force == pytest.approx(10 * plain.ring.force, abs=1e-8 * other.ring.force.max())

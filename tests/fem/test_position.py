"""All contacts of a position together: balance, symmetry, invariance, and the path of load and twist."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.fem.cases import FLANK, STEEL, drilled_disc, held_disc, held_position, solve_held, whole_drive
from trochoid.fem.laws import LinearSpring
from trochoid.fem.pair import FlankPair, HolePair
from trochoid.fem.position import Assembly, Contact, Family, solve_position
from trochoid.kinematics.types import Array

FAMILIES = ("ring", "output", "bearing")


def _forces(contact: Contact) -> Array:
    return np.concatenate([contact.touches[name].force for name in contact.touches])


def _resultants(contact: Contact) -> tuple[Array, float]:
    """Return force and moment about the origin of all contacts on the disc, summed from points and normals."""
    total, moment = np.zeros(2), 0.0
    for touch in contact.touches.values():
        push = -touch.force[:, None] * touch.state.normal
        point = touch.state.point
        total += push.sum(axis=0)
        moment += float(np.sum(point[:, 0] * push[:, 1] - point[:, 1] * push[:, 0]))
    return total, moment


@pytest.mark.exact
@pytest.mark.parametrize("resolve", [False, True])
@pytest.mark.parametrize("crank", [0.0, 0.7, 3.0])
def test_forces_and_torques_balance(crank: float, resolve: bool) -> None:
    """The disc is in equilibrium under its contacts, the rollers carry the torque: 1e-9 of the largest force."""
    contact = solve_position(whole_drive(crank), resolve)
    force, moment = _resultants(contact)
    size = float(_forces(contact).max())
    assert np.linalg.norm(force) < 1e-9 * size
    assert abs(moment) < 1e-9 * size * 0.08
    output = contact.touches["output"]
    push, point = output.force[:, None] * output.state.normal, output.state.point
    torque = float(np.sum(point[:, 0] * push[:, 1] - point[:, 1] * push[:, 0]))
    assert torque == pytest.approx(-200.0, rel=1e-9)
    assert contact.imbalance < 1e-9
    assert contact.penetration < 1e-9


@pytest.mark.exact
@pytest.mark.parametrize("crank", [0.3, 2.0])
def test_power_of_the_load_is_that_of_the_crank(crank: float) -> None:
    """Sources §3: the bearing's force across the eccentricity is T/(e z_c) per disc, as deflections are small."""
    contact = solve_position(whole_drive(crank))
    bearing = contact.touches["bearing"]
    force = (bearing.force[:, None] * bearing.state.normal).sum(axis=0)
    across = float(force @ np.array([-np.sin(crank), np.cos(crank)]))
    assert abs(across) == pytest.approx(200.0 / (FLANK.eccentricity * FLANK.lobes), rel=5e-3)


@pytest.mark.property
@pytest.mark.parametrize(("turned", "shift"), [(1.0, (0.0, 0.0)), (0.0, (0.3, -0.2)), (-2.0, (0.1, 0.1))])
@pytest.mark.parametrize("resolve", [False, True])
def test_drive_may_be_turned_and_moved(turned: float, shift: tuple[float, float], resolve: bool) -> None:
    """The whole drive in another place: the same forces, motions in its own axes, and stiffness."""
    plain = solve_position(whole_drive(0.7), resolve)
    moved = solve_position(whole_drive(0.7, 200.0, turned, shift), resolve)
    size = float(_forces(plain).max())
    assert _forces(moved) == pytest.approx(_forces(plain), abs=2e-8 * size)
    scale = np.array([1.0, 1.0, 0.08, 0.08])
    assert moved.motion * scale == pytest.approx(
        plain.motion * scale, abs=2e-8 * np.abs(plain.motion * scale).max()
    )
    weight = np.outer(1 / scale, 1 / scale)
    assert moved.stiffness * weight == pytest.approx(
        plain.stiffness * weight, abs=1e-6 * float(np.abs(plain.stiffness * weight).max())
    )


@pytest.mark.property
def test_pins_have_no_order() -> None:
    """Pins in another order carry the same forces in that order."""
    assembly, order = held_position(held_disc(8), 0.7), np.random.default_rng(1).permutation(20)
    family = assembly.families[0]
    pair = family.pair
    assert isinstance(pair, FlankPair)
    assert pair.seat is not None
    mixed = replace(pair, pins=pair.pins[order], parameter=pair.parameter[order])
    other = solve_position(replace(assembly, families=(replace(family, pair=mixed),)))
    plain = solve_position(assembly)
    assert other.touches["ring"].force == pytest.approx(plain.touches["ring"].force[order], rel=1e-10)
    assert other.motion == pytest.approx(plain.motion, rel=1e-12)


@pytest.mark.property
def test_order_of_families_does_not_matter() -> None:
    """Ring, output and bearing in another order: the same forces by name."""
    assembly = whole_drive(0.7)
    plain, other = (
        solve_position(assembly),
        solve_position(replace(assembly, families=assembly.families[::-1])),
    )
    size = float(_forces(plain).max())
    for name in FAMILIES:
        assert other.touches[name].force == pytest.approx(plain.touches[name].force, abs=1e-9 * size)


def _springs(crank: float, torque: float = 200.0) -> Assembly:
    """Return the classical calculation: a rigid disc on springs that keeps its nominal pose."""
    assembly, spring = whole_drive(crank, torque), LinearSpring(2e8)
    families = []
    for family in assembly.families[:2]:
        pair = family.pair
        assert isinstance(pair, FlankPair | HolePair)
        rigid = (
            replace(pair, seat=None, classical=True)
            if isinstance(pair, FlankPair)
            else replace(pair, seat=None)
        )
        families.append(Family(family.name, rigid, family.kernel, 0 * family.round_side, spring))
    stiff = np.diag([1e20, 1e20, 0.0, 0.0])  # the eccentric holds the disc's centre
    return Assembly(tuple(families), (), stiff, assembly.load, follow=False)


@pytest.mark.exact
@pytest.mark.parametrize("crank", [0.0, 0.123, 5.0])
def test_springs_repeat_with_the_pins(crank: float) -> None:
    """Sources §3: the pin-force set of the rigid disc repeats every 360°/z_p of the crank, one pin further."""
    one, following = (solve_position(_springs(crank + 2 * np.pi * i / 20)) for i in (0, 1))
    first, second = one.touches["ring"].force, following.touches["ring"].force
    assert np.roll(first, 1) == pytest.approx(second, abs=1e-9 * float(first.max()))


@pytest.mark.property
def test_springs_are_linear_in_the_torque() -> None:
    """Without gaps the hand calculation knows no load: forces and twist in proportion."""
    one, five = solve_position(_springs(0.7, 100.0)), solve_position(_springs(0.7, 500.0))
    assert _forces(five) == pytest.approx(5 * _forces(one), abs=1e-9 * float(_forces(five).max()))
    assert five.motion[3] == pytest.approx(5 * one.motion[3], rel=1e-12)


@pytest.mark.property
def test_twist_grows_with_the_torque_and_stiffness_is_its_slope() -> None:
    """Contacts stiffen: each newton metre twists further, by less; the tangent is the slope of the path.

    To 2e-3: how S changes where contacts creep along the flank is not in the tangent.
    """
    torques = np.array([1.0, 10.0, 50.0, 100.0, 200.0, 400.0])
    twist = np.array([float(solve_held(8, 0.7, t).motion[0]) for t in torques])
    assert np.all(np.diff(twist) < 0)
    slope = np.diff(twist) / np.diff(torques)
    assert np.all(np.diff(slope) > 0)
    contact = solve_held(8, 0.7, 200.0)
    up, down = (float(solve_held(8, 0.7, 200.0 + s).motion[0]) for s in (0.01, -0.01))
    assert contact.stiffness[0, 0] == pytest.approx(0.02 / (down - up), rel=2e-3)


@pytest.mark.property
@pytest.mark.parametrize("crank", [0.3, 2.0])
def test_stiffness_of_the_drive_is_symmetric_and_the_slope_of_the_load(crank: float) -> None:
    """All four motions: K is symmetric, and a little more torque moves them by K⁻¹ of it."""
    contact = solve_position(whole_drive(crank))
    assert contact.stiffness == pytest.approx(
        contact.stiffness.T, abs=1e-12 * np.abs(contact.stiffness).max()
    )
    up, down = (solve_position(whole_drive(crank, 200.0 + s)).motion for s in (0.02, -0.02))
    answer = contact.stiffness @ (up - down)
    reach = np.array([1.0, 1.0, 0.08, 0.08])
    assert answer / reach == pytest.approx(np.array([0, 0, 0, 0.04]) / reach, abs=2e-3 * 0.5)


@pytest.mark.property
def test_strips_agree_with_level_0() -> None:
    """Numerics §1: for Hertzian contacts the two agree to 1e-4 in rotation and pin forces."""
    plain, strips = solve_held(8, 0.7), solve_held(8, 0.7, resolve=True)
    first, second = plain.touches["ring"], strips.touches["ring"]
    assert float(strips.motion[0]) == pytest.approx(float(plain.motion[0]), rel=1e-4)
    assert second.force == pytest.approx(first.force, abs=1e-4 * float(first.force.max()))
    pressed = first.force > 0.1 * first.force.max()
    assert second.peak[pressed] == pytest.approx(first.peak[pressed], rel=2e-3)
    assert second.half_width[pressed] == pytest.approx(first.half_width[pressed], rel=5e-3)


@pytest.mark.property
def test_neighbour_is_a_start_not_an_answer() -> None:
    """Started from another position, the same forces and motion as from nothing (contacts are placed to 10 nm)."""
    cold = solve_position(whole_drive(0.8))
    warm = solve_position(whole_drive(0.8), start=solve_position(whole_drive(0.7)))
    assert _forces(warm) == pytest.approx(_forces(cold), abs=5e-6 * float(_forces(cold).max()))
    assert warm.motion == pytest.approx(cold.motion, abs=5e-6 * float(np.abs(cold.motion).max()))


@pytest.mark.property
def test_reruns_are_bit_equal() -> None:
    """The same position twice."""
    one, two = solve_position(whole_drive(0.8), True), solve_position(whole_drive(0.8), True)
    assert np.array_equal(_forces(one), _forces(two))
    assert np.array_equal(one.motion, two.motion)


@pytest.mark.exact
@pytest.mark.parametrize("play", [1e-5, 1e-3])
def test_no_torque_and_everything_open(play: float) -> None:
    """Zero torque and pins with play: nothing touches the flank, nothing carries, no stiffness of its own."""
    contact = solve_position(held_position(held_disc(8), 0.7, torque=0.0))
    family = held_position(held_disc(8), 0.7, torque=0.0)
    pair = family.families[0].pair
    assert isinstance(pair, FlankPair)
    loose = replace(family, families=(replace(family.families[0], pair=replace(pair, play=play)),))
    opened = solve_position(loose)
    assert not opened.touches["ring"].force.any()
    assert not opened.stiffness.any()
    assert not opened.motion.any()
    assert float(contact.touches["ring"].force.max()) < 1e-6


@pytest.mark.exact
def test_huge_clearance_is_closed_by_the_torque() -> None:
    """A tenth of a millimetre of play in the grooves: the disc turns until pins touch, and they carry the torque."""
    assembly = held_position(held_disc(8), 0.7)
    pair = assembly.families[0].pair
    assert isinstance(pair, FlankPair)
    loose = replace(assembly, families=(replace(assembly.families[0], pair=replace(pair, play=1e-4)),))
    contact = solve_position(loose)
    touch = contact.touches["ring"]
    assert float(touch.force @ touch.state.arms[:, 0]) == pytest.approx(-200.0, rel=1e-9)
    assert float(touch.state.gap.min()) < 0
    assert abs(float(contact.motion[0])) > 1e-4 / 0.05


@pytest.mark.property
def test_units_do_not_matter() -> None:
    """Half a drive in metres and newtons, twice its stiffness and torque: the same motion, forces doubled (1e-10)."""
    assembly = whole_drive(0.7)
    body = drilled_disc()
    table = body.compliance
    softer = replace(
        table,
        table=table.table / 2,
        diagonal=table.diagonal / 2,
        kernel=table.kernel / 2,
        surfaces={name: replace(s, kink=s.kink / 2) for name, s in table.surfaces.items()},
    )
    families = tuple(
        replace(f, kernel=f.kernel / 2, round_side=f.round_side / 2, pair=_half_kink(f))
        for f in assembly.families
    )
    double = Assembly(families, (replace(body, compliance=softer),), assembly.springs, 2 * assembly.load)
    plain, other = solve_position(assembly), solve_position(double)
    assert _forces(other) == pytest.approx(2 * _forces(plain), abs=1e-10 * float(_forces(other).max()))
    assert other.motion == pytest.approx(plain.motion, abs=1e-10 * float(np.abs(plain.motion).max()))


def _half_kink(family: Family) -> FlankPair | HolePair:
    pair = family.pair
    assert isinstance(pair, FlankPair | HolePair)
    assert pair.seat is not None
    surface = pair.seat.surface
    return replace(pair, seat=replace(pair.seat, surface=replace(surface, kink=surface.kink / 2)))


@pytest.mark.exact
def test_pressure_of_level_0_is_hertz() -> None:
    """p0 = 2F/(πa b), a² = 4FR/(πE*b) with the pair's combined radius at each touching pin."""
    touch = solve_held(8, 0.7).touches["ring"]
    pressed = touch.force > 0
    line = touch.force[pressed] / 0.010
    half = np.sqrt(4 * line * touch.state.radius[pressed] / (np.pi * STEEL.modulus))
    assert touch.half_width[pressed] == pytest.approx(half, rel=1e-12)
    assert touch.peak[pressed] == pytest.approx(2 * line / (np.pi * half) * 0.010, rel=1e-12)

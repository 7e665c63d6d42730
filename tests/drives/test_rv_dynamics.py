"""Reactions, vibration and masses of the RV drive: statics, balances, limits, and the whole through the scene."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from tests.drives.rv_cases import THREE_CRANKS, drive, level_of, without
from trochoid.drives.casing import rigid_shaken
from trochoid.drives.rv.breakdown import PARTS
from trochoid.drives.rv.carried import carried_masses, crank_masses
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.mass import masses
from trochoid.drives.rv.mode_shapes import films
from trochoid.drives.rv.modes import campbell, lines, natural_modes
from trochoid.drives.rv.reactions import Reactions, carrier_bearings, frame_speed, on_casing, reactions
from trochoid.drives.rv.series import Series, solve_series, turn_angles
from trochoid.drives.rv.spectrum import force_lines
from trochoid.drives.rv.vibration import casing_vibration
from trochoid.drives.seats import seats_residual
from trochoid.dynamics.carried import mass_matrix
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array
from trochoid.scene.needs import SEATS_OF

POSITIONS = 24
BALANCE = 1e-9
FORCES = ("arm", "crank", "main", "ring", "sun")


@lru_cache(maxsize=8)
def solved(*overrides: str, bearings: bool = True) -> tuple[Design, Series]:
    """The example's drive, both ends of a turn of its crankshafts included, on a coarse mesh."""
    made = drive(*overrides, effects=without(*(() if bearings else ("bearing_compliance",))))
    angle = np.linspace(0.0, turn_angles(made, 1)[-1], POSITIONS + 1)
    return made, solve_series(made, "level0", level_of(made), angle)


def found(*overrides: str, bearings: bool = True) -> tuple[Design, Reactions]:
    made, series = solved(*overrides, bearings=bearings)
    return made, reactions(made, series, masses(made), 0.02)


def stiffer(series: Series, factor: float) -> Series:
    """The same forces in a drive whose every stiffness is larger."""
    held = series.motions.supports
    springs = replace(
        held,
        stiffness={part: factor * k for part, k in held.stiffness.items()},
        teeth=factor * held.teeth,
        bearing=factor * held.bearing,
        sun_spring=factor * held.sun_spring,
    )
    return replace(
        series,
        motions=replace(series.motions, supports=springs),
        motion=series.motion / factor,
        stiffness=factor * series.stiffness,
        compliance=series.compliance / factor,
    )


def change(made: Reactions) -> float:
    """Largest vector difference of elastic and rigid reactions over the largest reaction."""
    assert made.elastic is not None
    size = np.linalg.norm(made.rigid.arm, axis=-1).max()
    pairs = [(getattr(made.elastic, name), getattr(made.rigid, name)) for name in FORCES]
    return float(max(np.linalg.norm(a - b, axis=-1).max() for a, b in pairs) / size)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("overrides", "bearings"),
    [
        ((), True),
        ((), False),
        (THREE_CRANKS, True),
        (("drive.fixed=carrier",), True),
        (("drive.fixed=sun", "operation.input_speed=300"), True),
        (("drive.cycloid.discs=1", "drive.carrier.bearing_positions=[-30, 20]"), True),
    ],
)
def test_forces_on_the_casing_are_the_inertia_of_the_members(
    overrides: tuple[str, ...], bearings: bool
) -> None:
    """Newton and Euler for all members together: ring, main bearings and sun feel what masses and motions give."""
    made, at = found(*overrides, bearings=bearings)
    assert at.residual <= BALANCE
    assert (at.elastic is None) == (not bearings)
    m, e = masses(made), made.flank.eccentricity
    orbiting = m.disc.mass + made.drive.first_stage.cranks * m.eccentric.mass
    out = np.sum([made.eccentric(i, made.crank_angle(at.angle)) for i in range(len(made.discs))], axis=0)
    size = made.crank_speed**2 * orbiting * e
    assert at.casing_rigid.force[:, :2] == pytest.approx(
        made.crank_speed**2 * orbiting * out, abs=1e-9 * size
    )
    for model, whole in (("rigid", at.casing_rigid), ("elastic", at.casing)):
        places = on_casing(made, at, model)
        assert tuple(places) == SEATS_OF["rv"]
        assert seats_residual(places, whole) <= BALANCE


@pytest.mark.independent
def test_crank_bearings_by_statics_are_the_springs_of_the_contact_solution() -> None:
    """Forces by the deflection of springs and by the balance of each crankshaft agree, at a low speed."""
    made, series = solved("operation.input_speed=1")
    at = reactions(made, series, masses(made), 0.02)
    ramp = np.abs(series.arm.resultant[-1] - series.arm.resultant[0]).max()
    assert np.abs(at.rigid.crank - series.bearing_force[:-1]).max() <= ramp
    middle = POSITIONS // 2  # where the ramp that closes the record is none
    assert at.rigid.crank[middle] == pytest.approx(series.bearing_force[middle], rel=1e-6, abs=1e-3)


@pytest.mark.independent
def test_main_bearings_carry_the_couple_of_the_discs() -> None:
    """Two discs push the carrier to opposite sides: nearly no force, and their couple over the bearings' distance."""
    made, at = found()
    low, high = carrier_bearings(made)
    assert (low, high) == pytest.approx((-0.0165, 0.0165))
    on_carrier = at.rigid.crank.sum(axis=1)
    couple = on_carrier[:, 1] * 0.016 - on_carrier[:, 0] * 0.016
    total = on_carrier.sum(axis=1)
    expected = 0.5 * total + couple / (high - low)
    assert at.rigid.main[:, 1] == pytest.approx(expected, rel=1e-9)
    assert np.abs(total).max() < 0.2 * np.abs(at.rigid.main).max()


@pytest.mark.property
def test_elastic_reactions_become_rigid() -> None:
    """All stiffnesses × 1e6: no difference is left; it falls as 1/stiffness, and with the square of the speed."""
    made, series = solved()
    m = masses(made)
    real, stiff, rigid = (change(reactions(made, stiffer(series, f), m, 0.02)) for f in (1.0, 1e2, 1e6))
    assert 1e-6 < real < 1e-3  # 600 rpm of the crankshafts are slow beside 1700 Hz
    assert stiff == pytest.approx(0.01 * real, rel=0.05)
    assert rigid < 2e-6 * real
    slow = change(found("operation.input_speed=181.5")[1])
    assert slow == pytest.approx(0.01 * real, rel=0.1)


@pytest.mark.exact
def test_masses_are_all_there() -> None:
    """Rigid motions of the whole have the mass and the inertia of discs, crankshafts and carrier."""
    made, series = solved()
    m, motions = masses(made), series.motions
    matrix = mass_matrix(carried_masses(made, motions, m))
    aside = np.array([float(name.endswith(("x", "x0", "x1"))) for name in motions.names])
    moving = 2 * m.disc.mass + 2 * (2 * m.eccentric.mass + m.shaft.mass + m.planet.mass)
    # planets, bearings and sun follow by springs, all but wholly
    assert aside @ matrix @ aside == pytest.approx(moving, rel=0.15)
    places = motions.supports.places
    lumps = crank_masses(made, m, places)
    assert lumps.sum() == pytest.approx(2 * m.eccentric.mass + m.shaft.mass + m.planet.mass, rel=1e-12)
    shaft = np.array([lumps @ places - m.planet.mass * 0.026, m.shaft.mass * (26 + 16 - 19) ** -1])
    ends = ((26 - 9.5) * (26 + 9.5) / 2 - (16 - 9.5) * (16 + 9.5) / 2) * 1e-3
    assert shaft[0] == pytest.approx(shaft[1] * ends, rel=1e-12)
    twist = np.array([float(name == "ring.rotation") for name in motions.names])
    arm = made.first.arm
    expected = m.carrier.axial_inertia + 2 * m.disc.axial_inertia
    expected += 2 * arm**2 * (2 * m.eccentric.mass + m.shaft.mass + m.planet.mass)
    eccentrics = 2 * (m.eccentric.axial_inertia + m.eccentric.mass * made.flank.eccentricity**2)
    spin = m.planet.axial_inertia + m.shaft.axial_inertia + eccentrics
    expected += 2 * (4 / 3) ** 2 * spin  # planets roll on the sun by 1 + 12/36 of the carrier's angle
    assert float(twist @ matrix @ twist) * made.leverage**2 == pytest.approx(expected, rel=1e-12)


@pytest.mark.exact
def test_lines_of_a_force_are_its_half_axes() -> None:
    """A vector that runs round an ellipse twice a turn: the larger half axis, whichever way it lies."""
    turn: Array = 2 * np.pi * np.arange(16) / 16
    ellipse = np.stack([3 * np.cos(2 * turn), 1 * np.sin(2 * turn)], axis=-1) @ [[0.6, 0.8], [-0.8, 0.6]]
    lines = force_lines((ellipse + np.array([5.0, 12.0]))[:, None])
    assert lines[:4] == pytest.approx([13.0, 0.0, 3.0, 0.0], abs=1e-12)


@pytest.mark.exact
@pytest.mark.parametrize("fixed", ["ring", "carrier", "sun"])
def test_casing_feels_the_couple_at_the_speed_of_the_crankshafts(fixed: str) -> None:
    """Rigid members leave m e ω² Δz of discs and eccentrics, one line at the absolute speed of the crankshafts."""
    speed = 3000 if fixed == "sun" else 6000  # above 10 Hz
    made, at = found(f"drive.fixed={fixed}", f"operation.input_speed={speed}")
    vibration = casing_vibration(made, at, rigid_shaken(made.scene))
    size = np.abs(vibration.rigid.velocity).max(axis=(0, 1))
    assert vibration.rigid.frequencies[size.argmax()] == pytest.approx(
        abs(made.crank_speed) / (2 * np.pi), rel=1e-9
    )
    size[size.argmax()] = 0.0
    assert size.max() < 1e-9 * np.abs(vibration.rigid.velocity).max()
    assert vibration.elastic.rms_max > 0.5 * vibration.rigid.rms_max
    relative = abs(made.turning) * made.scene.operation.input_speed / (2 * np.pi)
    assert vibration.elastic.resolved_to == pytest.approx(
        relative * (POSITIONS - 1) / 2, rel=0.1 if fixed == "ring" else 0.05
    )
    assert (frame_speed(made) == 0.0) == (fixed == "carrier")


@pytest.mark.property
def test_too_few_positions_are_refused_and_too_coarse_ones_named() -> None:
    """Three positions are no record; a record that ends below 1000 Hz says how many positions reach it."""
    made, series = solved()
    short = solve_series(made, "level0", level_of(made), series.angle[:3])
    with pytest.raises(TrochoidError, match=r"raise ask\.positions"):
        reactions(made, short, masses(made), 0.02)
    said = casing_vibration(made, found()[1], rigid_shaken(made.scene)).elastic.warnings
    assert any("; 70 positions (ask.positions) cover the whole band" in each for each in said), said


@pytest.mark.independent
def test_heavy_carrier_on_the_torsional_stiffness() -> None:
    """A carrier of 1e4 kg·m²: the lowest mode is √(k/J)/2π with the tangent stiffness of each place.

    The mean stiffness of the carrier's frame, in which the load goes round, would be a twentieth too high at least.
    """
    made, series = solved()
    heavy = masses(made)
    heavy = replace(heavy, carrier=replace(heavy.carrier, axial_inertia=1e4))
    parts = carried_masses(made, series.motions, heavy)
    modes = natural_modes(made, series, heavy)
    inertia = float(mass_matrix(parts)[-1, -1])
    tangent = series.compliance - series.parts[:, PARTS.index("wandering_contacts")]
    expected = np.sqrt(1.0 / tangent[:-1] / inertia) / (2.0 * np.pi)
    assert modes.modes[0].frequency == pytest.approx(expected.mean(), rel=1e-4)
    assert (modes.lowest[0], modes.highest[0]) == pytest.approx((expected.min(), expected.max()), rel=1e-4)
    assert modes.modes[0].words.startswith("carrier turning 100 %")
    mean = series.stiffness[:-1].mean(axis=0)
    assert np.sqrt(1.0 / np.linalg.inv(mean)[-1, -1] / inertia) / (2.0 * np.pi) > 1.05 * expected.mean()


@pytest.mark.property
def test_modes_of_the_example_and_their_pictures() -> None:
    """All 19 motions have modes; means lie between the ends of the turn; planets, discs, carrier are named; films."""
    made, series = solved()
    parts = masses(made)
    modes = natural_modes(made, series, parts)
    assert (len(modes.modes), modes.free) == (len(series.motions.names), 0)
    mean = np.array([mode.frequency for mode in modes.modes])
    assert np.all(np.diff(mean) > 0.0)
    assert np.all((modes.lowest <= mean) & (mean <= modes.highest))
    words = " ".join(mode.words for mode in modes.modes)
    assert all(name in words for name in ("planets turning", "disc 1 across the axis", "carrier turning"))
    assert lines(made)["sun and planets mesh"] == pytest.approx(
        12.0 * (1.0 - float(made.speeds.members["carrier"]))
    )
    assert {"crankshafts turn", "sun and planets mesh"} <= {
        c.group for c in campbell(made, series, parts).curves
    }
    shown = films(made, series, parts, modes)
    bodies = {body.name: body for body in shown[0].frames[0][1]}
    names = [
        "disc 1",
        "disc 2",
        "crankshaft 1",
        "planet 1",
        "crankshaft 2",
        "planet 2",
        "sun",
        "carrier",
        "ring",
    ]
    assert list(bodies) == names
    assert not bodies["ring"].point_data["displacement"].any()


@pytest.mark.property
def test_work_on_the_elastic_motion_is_what_damping_takes() -> None:
    """Inertia by masses, springs by contacts, damping by modes: their work over a turn sums to nothing."""
    _, moved = found()
    assert moved.response is not None
    assert moved.response.loss > 0.0
    assert moved.work < BALANCE

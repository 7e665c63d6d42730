"""Dynamics of the precessional drive against momenta of points, power, closed forms and statics of each body."""

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.drives.precessional_cases import REFERENCE, SPEED, cloud, drives, momentum_rates, satellite_pose
from trochoid.drives.precessional.balance import (
    balance_plane,
    couple_lines,
    mean_product,
    model_difference,
    remaining_couple,
    statically_balanced,
)
from trochoid.drives.precessional.casing import (
    casing_load,
    casing_vibration,
    closed_record,
    inertia_load,
)
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.reactions import inertia_couple, reactions, tooth_couple
from trochoid.dynamics.casing import Casing
from trochoid.dynamics.spectrum import harmonics
from trochoid.dynamics.vibration import Point
from trochoid.dynamics.wrench import Wrench, balance_residual
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.nutation import Nutation, satellite_motion
from trochoid.kinematics.spherical import rotation, turn

Array = npt.NDArray[np.float64]
CRANK = np.linspace(-1.0, 9.0, 23)


def size_of(drive: PrecessionalDrive, speed: float) -> float:
    """Couple (N·m) that nothing in the drive exceeds by much."""
    weight = drive.counterweight
    arms = (
        abs(drive.shaft.product) + abs(weight.product) + weight.mass * weight.radius * (1.0 + abs(weight.z))
    )
    return speed**2 * (1.0 + drive.tooth_ratio) ** 2 * (max(drive.satellite.inertia) + arms + 1.0)


def negative(load: Wrench) -> Wrench:
    return replace(load, force=-load.force, moment=-load.moment)


@pytest.mark.exact
@given(drive=drives())
@settings(max_examples=20, deadline=None)
def test_the_points_stand_for_the_satellite(drive: PrecessionalDrive) -> None:
    """The cloud of the independent checks has the given mass, centre and inertia about O."""
    points, mass = cloud(drive.satellite)
    second = np.einsum("p,pi,pj->ij", mass, points, points)
    inertia = np.trace(second) * np.eye(3) - second
    np.testing.assert_allclose(inertia, np.diag(drive.satellite.inertia), atol=1e-12 * inertia.max())
    np.testing.assert_allclose(
        mass @ points, [0.0, 0.0, drive.satellite.mass * drive.satellite.offset], atol=1e-13
    )


@pytest.mark.exact
def test_frames_of_dynamics_and_of_teeth_are_one_motion() -> None:
    """n = (0, s, c) with y towards A is n = (s, 0, c) a quarter turn on, for crank and satellite alike."""
    quarter = rotation(2, 0.5 * math.pi)
    poses = satellite_motion(REFERENCE.nutation, CRANK).rotation
    np.testing.assert_allclose(satellite_pose(REFERENCE, CRANK), quarter @ poses @ quarter.T, atol=1e-14)


@pytest.mark.independent
@given(drive=drives())
@settings(max_examples=40, deadline=None)
def test_exact_reactions_are_the_rates_of_momentum(drive: PrecessionalDrive) -> None:
    """Multibody by points: what the casing feels is −dP/dt and −dL/dt, and the motor's power is dT/dt."""
    force, moment, power = momentum_rates(drive, CRANK, 2.0)
    found = reactions(drive, CRANK, 2.0)
    load = casing_load(found)
    size = size_of(drive, 2.0)
    np.testing.assert_allclose(load.force, -force, atol=1e-9 * size)
    np.testing.assert_allclose(load.moment, -moment, atol=1e-9 * size)
    np.testing.assert_allclose(found.torque * 2.0, power, atol=2e-9 * size)


@pytest.mark.independent
@given(drive=drives())
@settings(max_examples=30, deadline=None)
def test_casing_feels_the_sum_of_inertia_loads(drive: PrecessionalDrive) -> None:
    """Inner forces cancel: reactions on the casing and d'Alembert's loads are in balance; as printed they are not."""
    inertia = inertia_load(drive, CRANK, 3.0)
    exact, printed = (casing_load(reactions(drive, CRANK, 3.0, model)) for model in ("exact", "printed"))
    assert balance_residual([exact, negative(inertia)]) < 1e-12 / drive.joint / drive.tilt[0]
    np.testing.assert_allclose(printed.force, inertia.force, atol=1e-11 * size_of(drive, 3.0) / drive.joint)
    off = np.linalg.norm(printed.moment - inertia.moment, axis=1)
    left_out = np.abs(model_difference(drive, CRANK, 3.0)["Y_A"]) * drive.joint * drive.tilt[1]
    assert (off >= left_out - 1e-11 * size_of(drive, 3.0)).all()


@pytest.mark.exact
@given(drive=drives())
@settings(max_examples=40, deadline=None)
def test_each_body_is_in_balance(drive: PrecessionalDrive) -> None:
    """Moments about O: on the satellite of A, teeth and inertia; on the shaft of A, B, motor and inertia."""
    found = reactions(drive, CRANK, 2.0)
    s, c = drive.tilt
    size = size_of(drive, 2.0) / min(drive.joint, drive.mesh_radius) / s
    at_a = drive.joint * np.array([0.0, s, c])
    satellite = np.cross(at_a, found.joint_a) + found.mesh_couple + inertia_couple(drive, CRANK, 2.0)
    np.testing.assert_allclose(satellite, 0.0, atol=1e-12 * size)
    point = drive.mesh_radius * np.cross(tooth_couple(drive), [1.0, 0.0, 0.0])
    np.testing.assert_allclose(np.cross(-point, found.mesh), found.mesh_couple, atol=1e-12 * size)
    weight = drive.counterweight
    products = drive.shaft.product + weight.product - weight.mass * weight.radius * weight.z
    at_b = np.array([0.0, 0.0, drive.support])
    shaft = np.cross(at_a, -found.joint_a) + np.cross(at_b, found.support) + found.support_moment
    shaft[:, 0] -= products * 4.0
    shaft[:, 2] += found.torque
    np.testing.assert_allclose(shaft, 0.0, atol=1e-12 * size)


@pytest.mark.property
@given(drive=drives())
@settings(max_examples=30, deadline=None)
def test_power_balance(drive: PrecessionalDrive) -> None:
    """Teeth do no work, the joint at O turns none, so the motor gives what the satellite's energy takes."""
    s, c = drive.tilt
    q, n, k = drive.tooth_ratio, np.array([0.0, s, c]), np.array([0.0, 0.0, 1.0])
    spin = 2.0 * (k - q * n)
    found = reactions(drive, CRANK, 2.0)
    size = size_of(drive, 2.0) / s
    np.testing.assert_allclose(found.mesh_couple @ spin, 0.0, atol=1e-11 * size)
    assert abs((spin - 2.0 * (1.0 - q) * k) @ (k + n)) < 1e-12 * (1.0 + q)
    work = np.cross(drive.joint * n, found.joint_a) @ spin
    np.testing.assert_allclose(work, found.torque * 2.0, atol=1e-11 * size)
    np.testing.assert_allclose(
        inertia_couple(drive, CRANK, 2.0) @ spin, -found.torque * 2.0, atol=1e-11 * size
    )


@pytest.mark.exact
@given(drive=drives())
@settings(max_examples=40, deadline=None)
def test_closed_form_of_what_the_printed_model_leaves_out(drive: PrecessionalDrive) -> None:
    """Sources §2: ΔY_A and what follows; X_A, X_B, M_By, M_3 alike; X_O differs by the tooth force."""
    exact, printed = (reactions(drive, CRANK, 2.0, model) for model in ("exact", "printed"))
    off = model_difference(drive, CRANK, 2.0)
    close = 1e-12 * size_of(drive, 2.0) / drive.joint / drive.tilt[0]
    for name, a, b, axis in (
        ("Y_A", exact.joint_a, printed.joint_a, 1),
        ("Y_O", exact.joint_o, printed.joint_o, 1),
        ("Y_B", exact.support, printed.support, 1),
        ("M_Bx", exact.support_moment, printed.support_moment, 0),
    ):
        np.testing.assert_allclose((a - b)[:, axis], off[name], atol=close)
    np.testing.assert_allclose(exact.joint_a[:, 0], printed.joint_a[:, 0], atol=close)
    np.testing.assert_allclose(exact.support[:, 0], printed.support[:, 0], atol=close)
    np.testing.assert_allclose(exact.support_moment[:, 1], printed.support_moment[:, 1], atol=close)
    np.testing.assert_allclose(exact.torque, printed.torque, atol=close)
    close /= drive.mesh_radius
    np.testing.assert_allclose(exact.joint_o[:, 0] + exact.mesh[:, 0], printed.joint_o[:, 0], atol=close)


@pytest.mark.property
@given(drive=drives(), acceleration=st.floats(-5.0, 5.0))
@settings(max_examples=30, deadline=None)
def test_couple_of_an_accelerated_satellite(drive: PrecessionalDrive, acceleration: float) -> None:
    """M = Jε + ω×Jω with ε = α_3(k − qn) + …, against the satellite's point accelerations in the fixed frame."""
    points, mass = cloud(drive.satellite)
    motion = satellite_motion(drive.nutation, CRANK, 1.5, acceleration)
    # y towards A: points turned back by a quarter, the result forward again
    quarter = rotation(2, 0.5 * math.pi)
    own = points @ quarter
    torque = np.einsum("p,npi->ni", mass, np.cross(motion.to_fixed(own), motion.point_acceleration(own)))
    in_shaft = turn(rotation(2, -CRANK), torque) @ quarter.T
    couple = inertia_couple(drive, CRANK, 1.5, acceleration=acceleration)
    size = (2.25 + abs(acceleration)) * (1.0 + drive.tooth_ratio) ** 2 * max(drive.satellite.inertia)
    np.testing.assert_allclose(couple, -in_shaft, atol=1e-11 * size)


@pytest.mark.property
@given(drive=drives())
@settings(max_examples=30, deadline=None)
def test_period_and_scaling(drive: PrecessionalDrive) -> None:
    """Reactions repeat after π z2/z1 and not after half of it; forces go with ω_3², masses, and lengths."""
    found = reactions(drive, CRANK, 1.0)
    later = reactions(drive, CRANK + drive.reaction_period, 1.0)
    size = size_of(drive, 1.0) / drive.joint / drive.tilt[0]
    np.testing.assert_allclose(later.joint_a, found.joint_a, atol=1e-11 * size)
    np.testing.assert_allclose(later.magnitude("M_B"), found.magnitude("M_B"), atol=1e-11 * size)
    half = reactions(drive, CRANK + 0.5 * drive.reaction_period, 1.0)
    x, y, _ = drive.satellite.inertia
    mid = 0.5 * (found.torque + half.torque)
    np.testing.assert_allclose(mid, 0.0, atol=1e-11 * size)
    assert np.abs(found.torque).max() > 0.1 * drive.tooth_ratio * drive.tilt[0] ** 2 * abs(x - y) * 0.5
    faster = reactions(drive, CRANK, 7.0)
    np.testing.assert_allclose(faster.joint_o, 49.0 * found.joint_o, rtol=1e-9, atol=1e-11 * 49.0 * size)


@pytest.mark.exact
@given(drive=drives())
@settings(max_examples=30, deadline=None)
def test_lines_in_the_fixed_frame(drive: PrecessionalDrive) -> None:
    """FFT over the closed record: lines at ω_3, ω_3(2q − 1), ω_3(2q + 1) across z, 2q ω_3 about it; no others."""
    crank = closed_record(drive)
    moment = inertia_load(drive, crank, 2.0).moment
    turns, n = drive.nutation.closing_turns, crank.size
    across = np.fft.fft(moment[:, 0] + 1j * moment[:, 1]) / n
    about = harmonics(moment[:, 2])
    size = size_of(drive, 2.0)
    left, left_z = np.abs(across), np.abs(about)
    expected = np.zeros(n)
    for line in couple_lines(drive, 2.0):
        place = line.order * turns
        assert place.denominator == 1
        if line.axis == "z":
            assert left_z[int(place)] == pytest.approx(line.couple, rel=1e-9, abs=1e-11 * size)
            left_z[int(place)] = 0.0
        else:
            expected[int(place) % n] += line.couple
    if np.count_nonzero(expected) == 3:  # else two lines share an order and add as vectors
        np.testing.assert_allclose(left, expected, atol=1e-11 * size)
    np.testing.assert_allclose(left_z, 0.0, atol=1e-11 * size)


@pytest.mark.exact
@given(drive=drives())
@settings(max_examples=30, deadline=None)
def test_balance(drive: PrecessionalDrive) -> None:
    """Statically balanced: no force on the casing.  At H no mean couple, and what remains has the closed amplitude."""
    still = statically_balanced(drive)
    if still.counterweight.radius * still.counterweight.mass < 1e-4:
        return
    at = replace(still, counterweight=replace(still.counterweight, z=balance_plane(still)))
    crank = np.linspace(0.0, drive.reaction_period, 41)[:-1]
    size = size_of(at, 2.0) * (1.0 + abs(at.counterweight.z))
    load = inertia_load(at, crank, 2.0)
    np.testing.assert_allclose(load.force, 0.0, atol=1e-12 * size)
    in_shaft = turn(rotation(2, -crank), load.moment)
    np.testing.assert_allclose(in_shaft.mean(axis=0), 0.0, atol=1e-11 * size)
    assert np.abs(in_shaft[0, 0]) == pytest.approx(remaining_couple(at, 2.0), abs=1e-11 * size)


@pytest.mark.exact
@given(drive=drives())
@settings(max_examples=20, deadline=None)
def test_mean_couple_of_the_satellite(drive: PrecessionalDrive) -> None:
    """Sources §2: exact −ω_3² s[c(I_m − I_z) + q I_z], printed −ω_3² s q I_m, over a period of the reactions."""
    crank = np.linspace(0.0, drive.reaction_period, 41)[:-1]
    for model in ("exact", "printed"):
        mean = inertia_couple(drive, crank, 3.0, model).mean(axis=0)
        expected = [-9.0 * mean_product(drive, model), 0.0, 0.0]
        np.testing.assert_allclose(mean, expected, atol=1e-12 * size_of(drive, 3.0))


@pytest.mark.property
def test_a_round_satellite_gives_steady_reactions() -> None:
    """I_x = I_y: nothing varies in the frame of the shaft, the motor needs no torque, teeth carry nothing."""
    body = replace(REFERENCE.satellite, inertia=(5.2e-3, 5.2e-3, 3.6e-3))
    found = reactions(replace(REFERENCE, satellite=body), CRANK, SPEED)
    for name in ("R_A", "R_B", "R_O", "M_B"):
        assert np.ptp(found.magnitude(name)) < 1e-12 * found.magnitude(name).max()
    np.testing.assert_allclose(found.torque, 0.0, atol=1e-14)
    np.testing.assert_allclose(found.mesh_couple, 0.0, atol=1e-14)


@pytest.mark.property
@given(angle=st.floats(-math.pi, math.pi))
@settings(max_examples=20, deadline=None)
def test_vibration_does_not_depend_on_where_the_shaft_starts(angle: float) -> None:
    """Rotation invariance: the casing load later on is that of a shaft and satellite turned alike."""
    later = inertia_load(REFERENCE, CRANK + angle, SPEED).moment
    turned = turn(rotation(2, CRANK + angle), inertia_couple(REFERENCE, CRANK + angle, SPEED))
    static = inertia_load(
        replace(REFERENCE, satellite=replace(REFERENCE.satellite, inertia=(0.0, 0.0, 0.0))),
        CRANK + angle,
        SPEED,
    )
    np.testing.assert_allclose(later, turned + static.moment, atol=1e-12)


@pytest.mark.exact
def test_refusals_say_what_is_wrong() -> None:
    """Impossible inertia, negative mass, joint at O, unknown model and name, no counterweight."""
    body = REFERENCE.satellite
    with pytest.raises(TrochoidError, match=r"no body has these; .* sum of the other two, 0.0061"):
        replace(REFERENCE, satellite=replace(body, inertia=(1e-3, 5.1e-3, 9e-3)))
    with pytest.raises(TrochoidError, match=r"satellite\.mass = -1\.0 kg"):
        replace(REFERENCE, satellite=replace(body, mass=-1.0))
    with pytest.raises(TrochoidError, match=r"joint OA = 0\.0 m"):
        replace(REFERENCE, joint=0.0)
    with pytest.raises(TrochoidError, match="take 'exact' or 'printed'"):
        reactions(REFERENCE, CRANK, SPEED, "other")  # type: ignore[arg-type]
    with pytest.raises(TrochoidError, match="take one of R_A"):
        reactions(REFERENCE, CRANK, SPEED).magnitude("R_C")
    none = replace(REFERENCE, counterweight=replace(REFERENCE.counterweight, mass=0.0))
    for ask in (statically_balanced, balance_plane):
        with pytest.raises(TrochoidError, match="counterweight"):
            ask(none)


@pytest.mark.property
def test_record_is_fine_enough() -> None:
    """Eight times as many positions change no line of the vibration, for ratios from 2 to 60."""
    casing = Casing(25.0, (0.25, 0.25, 0.25))
    for fixed, satellite in ((15, 14), (3, 2), (2, 3), (40, 39), (20, 15)):
        drive = replace(REFERENCE, nutation=Nutation(fixed, satellite, 0.04))
        crank = closed_record(drive)
        fine = np.linspace(0.0, 2.0 * math.pi * drive.nutation.closing_turns, 8 * crank.size + 1)[:-1]
        few = casing_vibration(drive, SPEED, casing, (Point("end", (0.0, 0.0, 0.08)),))
        many = harmonics(inertia_load(drive, fine, SPEED).moment)
        lines = harmonics(inertia_load(drive, crank, SPEED).moment)
        np.testing.assert_allclose(lines, many[: len(lines)], atol=1e-11)
        assert np.abs(many[len(lines) :]).max() < 1e-11
        assert not few.warnings

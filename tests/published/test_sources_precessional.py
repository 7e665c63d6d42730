"""Skoibeda et al., dynamic reactions of a precessional K-H-V drive (sources §2): every number, and every erratum.

The paper gives equations and plots without data.  The numbers are those of the reference case of the sources'
README, a drive of the СО-170 class at 1430 rpm; "exact" and "printed" name the two models.
"""

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest

from tests.drives.precessional_cases import DEGREES, REFERENCE, SPEED, momentum_rates
from trochoid.drives.precessional.balance import (
    balance_plane,
    couple_lines,
    mean_product,
    model_difference,
    remaining_couple,
    rocking_velocity,
    static_moment,
    statically_balanced,
)
from trochoid.drives.precessional.casing import casing_load, casing_vibration, inertia_load
from trochoid.drives.precessional.mechanism import InputShaft, PrecessionalDrive, mass_moments
from trochoid.drives.precessional.reactions import Model, Reactions, inertia_couple, reactions
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point
from trochoid.kinematics.spherical import rotation, turn

Array = npt.NDArray[np.float64]
CASING = Casing(25.0, (0.25, 0.25, 0.25))
LEVER = Point("lever", (0.0, 0.0, 0.08))
MOUNTED = replace(CASING, mounts=(Mount((0.0, 0.0, 0.0), (4e5,) * 3, (300.0,) * 3, (2e3,) * 3, (2.0,) * 3),))
UNKNOWNS = ("X_A", "Y_A", "Z_A", "X_O", "Y_O", "X_B", "Y_B", "Z_B", "M_Bx", "M_By", "M_3")

NUMBERS: tuple[tuple[str, Model, tuple[float, float, float], float], ...] = (
    ("R_A", "exact", (116.21, 118.86, 121.19), 5e-3),
    ("R_A", "printed", (118.89, 121.37, 123.55), 5e-3),
    ("R_B", "exact", (37.96, 40.63, 42.94), 5e-3),
    ("R_B", "printed", (40.64, 43.14, 45.30), 5e-3),
    ("R_O", "exact", (37.96, 40.63, 42.94), 5e-3),
    ("R_O", "printed", (40.64, 43.14, 45.30), 5e-3),
    ("M_B", "exact", (4.847, 5.020, 5.171), 5e-4),
    ("M_B", "printed", (5.021, 5.183, 5.324), 5e-4),
)


def vibration(drive: PrecessionalDrive, casing: Casing = CASING, model: Model = "exact") -> float:
    """Velocity, mm/s rms in 10–1000 Hz, at the lever of the reference case."""
    return 1e3 * casing_vibration(drive, SPEED, casing, (LEVER,), model).rms_max


def as_unknowns(found: Reactions) -> Array:
    """The printed unknowns (11, n) out of reactions."""
    a, o, b, m = found.joint_a, found.joint_o, found.support, found.support_moment
    return np.stack((*a.T, *o.T[:2], *b.T, *m.T[:2], found.torque))


def printed_system(drive: PrecessionalDrive, crank: float) -> tuple[Array, Array]:
    """Equations (10)–(14), (19)–(24) as the paper has them, in the order of UNKNOWNS: matrix (11, 11), right side."""
    (s, c), q, OA, OB = drive.tilt, drive.tooth_ratio, drive.joint, drive.support
    i_x, i_y, _ = drive.satellite.inertia
    weight = drive.counterweight
    f = -q * crank  # (9)
    epsilon = SPEED * (q * SPEED) * s  # (2), (3)
    m_x, m_y = -i_x * epsilon * math.cos(f), i_y * epsilon * math.sin(f)  # (5)–(8)
    phi_2, phi_3, phi_5 = (m * SPEED**2 for m in mass_moments(drive))  # (4), (15), (16)
    m_3 = -drive.shaft.product * SPEED**2  # (17)
    m_5 = -(weight.product - weight.mass * weight.radius * weight.z) * SPEED**2  # (18)
    rows = (
        ({"X_O": 1, "X_A": 1}, 0.0),
        ({"Y_O": 1, "Y_A": 1}, phi_2),
        ({"Z_A": 1}, 0.0),
        ({"Y_A": -OA * c}, m_x * math.cos(f) - m_y * math.sin(f)),
        ({"X_A": OA * c}, (m_x * math.sin(f) + m_y * math.cos(f)) * c),
        ({"X_A": -1, "X_B": 1}, 0.0),
        ({"Y_A": -1, "Y_B": 1}, phi_3 - phi_5),
        ({"Z_A": -1, "Z_B": 1}, 0.0),
        ({"Y_A": OA * c, "Z_A": -OA * s, "Y_B": -OB, "M_Bx": 1}, m_3 + m_5),
        ({"X_A": -OA * c, "X_B": OB, "M_By": 1}, 0.0),
        ({"X_A": OA * s, "M_3": 1}, 0.0),
    )
    matrix = np.array([[row.get(name, 0.0) for name in UNKNOWNS] for row, _ in rows])
    return matrix, -np.array([known for _, known in rows])


@pytest.mark.published
@pytest.mark.parametrize(("name", "model", "numbers", "tolerance"), NUMBERS)
def test_reactions(name: str, model: Model, numbers: tuple[float, float, float], tolerance: float) -> None:
    """Least, mean and largest over one turn, 0…360° in steps of 1°, to all digits given."""
    size = reactions(REFERENCE, DEGREES, SPEED, model).magnitude(name)
    assert (size.min(), size.mean(), size.max()) == pytest.approx(numbers, abs=tolerance)


@pytest.mark.published
@pytest.mark.parametrize("model", ["exact", "printed"])
def test_torque_and_static_balance(model: Model) -> None:
    """M_3 = ±0.004571 N·m in both models; r5 = 26.46 mm; H = 68.716 | 69.988 mm."""
    torque = reactions(REFERENCE, np.linspace(0.0, 7.0, 20001), SPEED, model).torque
    assert (torque.min(), torque.max()) == pytest.approx((-0.004571, 0.004571), abs=5e-7)
    assert 1e3 * REFERENCE.counterweight.radius == pytest.approx(26.46, abs=5e-3)
    assert 1e3 * balance_plane(REFERENCE, model) == pytest.approx(
        {"exact": 68.716, "printed": 69.988}[model], abs=5e-4
    )


@pytest.mark.published
def test_vibration_velocity() -> None:
    """Free casing 0.858 | 0.688 mm/s; counterweight at the exact H 0.148; on mounts 1.33 mm/s."""
    assert vibration(REFERENCE) == pytest.approx(0.858, abs=5e-4)
    assert vibration(REFERENCE, model="printed") == pytest.approx(0.688, abs=5e-4)
    plane = replace(REFERENCE.counterweight, z=balance_plane(REFERENCE))
    assert vibration(replace(REFERENCE, counterweight=plane)) == pytest.approx(0.148, abs=5e-4)
    assert vibration(REFERENCE, MOUNTED) == pytest.approx(1.33, abs=5e-3)


@pytest.mark.published
def test_vibration_without_counterweight() -> None:
    """15.3 mm/s, with the casing's centre 80 mm from O, which is not stated; a force needs it, a couple does not.

    With the centre at O it is 26.1 mm/s; all other velocities are of a pure couple and stay.
    """
    none = replace(REFERENCE, counterweight=replace(REFERENCE.counterweight, mass=0.0))
    moved = replace(CASING, center=(0.0, 0.0, 0.08))
    point = Point("lever", (0.0, 0.0, 0.16))
    assert 1e3 * casing_vibration(none, SPEED, moved, (point,)).rms_max == pytest.approx(15.3, abs=0.05)
    assert vibration(none) == pytest.approx(26.06, abs=5e-3)
    assert 1e3 * casing_vibration(REFERENCE, SPEED, moved, (point,)).rms_max == pytest.approx(0.858, abs=5e-4)


@pytest.mark.published
def test_product_of_inertia_that_the_numbers_need() -> None:
    """ "I_3yz = 0 unless given" does not lead to M_B, H and v as given; 3.480e-5 kg·m² does, within its last digit.

    H alone leaves 3.480e-5 ± 2e-9.  R_A, R_B, R_O and M_3 know nothing of it.
    """
    bare = replace(REFERENCE, shaft=replace(REFERENCE.shaft, product=0.0))
    assert 1e3 * balance_plane(bare) == pytest.approx(59.949, abs=5e-4)
    assert reactions(bare, DEGREES, SPEED).magnitude("M_B").mean() == pytest.approx(5.800, abs=5e-4)
    assert vibration(bare) == pytest.approx(2.030, abs=5e-4)
    needed = 68.716e-3 * static_moment(bare) - mean_product(bare)
    assert needed == pytest.approx(REFERENCE.shaft.product, abs=2e-9)
    np.testing.assert_array_equal(
        reactions(bare, DEGREES, SPEED).joint_a, reactions(REFERENCE, DEGREES, SPEED).joint_a
    )


@pytest.mark.published
def test_main_line_in_closed_form() -> None:
    """v = m5 r5 ω_3|z5 − H|·d_z/(√2 J) is the line at ω_3: with the line at ω_3(2q − 1) it is all but 2e-4 of v."""
    main = 1e3 * rocking_velocity(REFERENCE, SPEED, 0.25, 0.08)
    side = couple_lines(REFERENCE, SPEED)[1]
    other = 1e3 * side.couple * 0.08 / (math.sqrt(2.0) * 0.25 * SPEED * abs(float(side.order)))
    assert math.hypot(main, other) == pytest.approx(vibration(REFERENCE), rel=1e-6)
    assert main == pytest.approx(0.8453, abs=5e-5)


@pytest.mark.published
def test_harmonics_and_period() -> None:
    """|R| repeats every π z2/z1; lines ω_3, ω_3(2q − 1) and a weak ω_3(2q + 1)."""
    assert REFERENCE.reaction_period == pytest.approx(math.pi * 14 / 15, rel=1e-15)
    lines = couple_lines(REFERENCE, SPEED)
    assert [abs(float(line.order)) for line in lines[:3]] == pytest.approx([1.0, 16 / 14, 44 / 14], rel=1e-15)
    assert lines[2].couple < 2e-3 * lines[1].couple
    assert remaining_couple(REFERENCE, SPEED) == pytest.approx(lines[1].couple + lines[2].couple, rel=1e-12)


@pytest.mark.published
def test_printed_model_is_what_the_paper_has() -> None:
    """All eleven equations, coded literally and solved, against the model "printed"."""
    for crank in np.linspace(0.0, 6.0, 13):
        solved = np.linalg.solve(*printed_system(REFERENCE, crank))
        found = as_unknowns(reactions(REFERENCE, crank, SPEED, "printed"))[:, 0]
        np.testing.assert_allclose(found, solved, atol=1e-11)


@pytest.mark.published
def test_erratum_sign_of_the_relative_speed() -> None:
    """(2) taken as +q ω_3 in the Euler terms: the mean couple is off by −141 %; (9) carries the sign."""
    crank = np.linspace(0.0, REFERENCE.reaction_period, 61)[:-1]
    s, c = REFERENCE.tilt
    q, n, k = REFERENCE.tooth_ratio, np.array([0.0, s, c]), np.array([0.0, 0.0, 1.0])

    def mean(sign: float) -> float:
        pose = rotation(0, -REFERENCE.nutation.angle) @ rotation(2, sign * q * crank)
        back, inertia = np.swapaxes(pose, 1, 2), np.asarray(REFERENCE.satellite.inertia)
        spin = turn(back, SPEED * (k + sign * q * n))
        twist = turn(back, SPEED**2 * sign * q * np.cross(k, n))
        return float(-turn(pose, inertia * twist + np.cross(spin, inertia * spin))[:, 0].mean())

    right = -(SPEED**2) * mean_product(REFERENCE)
    assert mean(-1.0) == pytest.approx(right, rel=1e-12)
    assert mean(1.0) / right - 1.0 == pytest.approx(-1.41, abs=5e-3)


@pytest.mark.published
def test_erratum_no_euler_terms() -> None:
    """The printed couple is not the rate of the moment of momentum; the exact one is, and ΔY_A is the difference."""
    _, rate, _ = momentum_rates(REFERENCE, DEGREES[:360:15], SPEED)
    exact, printed = (
        inertia_load(REFERENCE, DEGREES[:360:15], SPEED, m).moment for m in ("exact", "printed")
    )
    np.testing.assert_allclose(exact, -rate, atol=1e-8)
    off = turn(rotation(2, -DEGREES[:360:15]), printed + rate)[:, 0]
    assert np.abs(off).min() > 0.1
    lever = REFERENCE.joint * REFERENCE.tilt[1]
    change = model_difference(REFERENCE, DEGREES[:360:15], SPEED)["Y_A"] * lever
    np.testing.assert_allclose(off, -change, rtol=1e-6)
    assert np.abs(change / lever).max() == pytest.approx(2.68, abs=5e-3)


@pytest.mark.published
def test_erratum_eleven_equations() -> None:
    """ "Nine equations, nine unknowns": there are eleven of each, all needed; Z_O stands in none of them."""
    matrix, _ = printed_system(REFERENCE, 0.7)
    assert matrix.shape == (11, 11)
    assert np.linalg.matrix_rank(matrix) == 11
    assert all(np.linalg.matrix_rank(np.delete(matrix, row, axis=0)) == 10 for row in range(11))
    assert "Z_O" not in UNKNOWNS


@pytest.mark.published
def test_erratum_moment_of_the_support() -> None:
    """(26) prints M_B = √(M_B² + M_B² + M_B²), √3 times too much; it is √(M_Bx² + M_By²)."""
    found = reactions(REFERENCE, DEGREES, SPEED)
    right = np.hypot(found.support_moment[:, 0], found.support_moment[:, 1])
    np.testing.assert_allclose(found.magnitude("M_B"), right, rtol=1e-14)
    printed = np.sqrt(3.0 * right**2)
    assert printed.mean() == pytest.approx(8.69, abs=0.01)
    assert printed.mean() != pytest.approx(5.020, abs=1.0)


@pytest.mark.published
def test_erratum_counterweight_force_is_a_modulus() -> None:
    """(20) has + Φ_3 − Φ*: Φ_3 is algebraic, Φ* a modulus, else a balanced shaft is out of balance by 2 m5 r5 ω²."""
    found = reactions(REFERENCE, DEGREES, SPEED, "printed")
    satellite, shaft, weight = (m * SPEED**2 for m in mass_moments(REFERENCE))
    on_casing = -(found.support + found.joint_o)[:, 1]
    np.testing.assert_allclose(on_casing, 0.0, atol=1e-12)
    algebraic = found.joint_a[:, 1] - shaft - weight  # Φ* = −m5 a5 along y, in (20) as it stands
    left = -(algebraic + found.joint_o[:, 1])
    np.testing.assert_allclose(left, 2.0 * weight, rtol=1e-12)
    assert 2.0 * weight == pytest.approx(178.0, abs=0.1)
    assert satellite + shaft == pytest.approx(weight, rel=1e-12)


@pytest.mark.published
def test_erratum_sign_of_the_products_of_inertia() -> None:
    """(17), (18) need I_yz = +∫yz dm: with the tensor's −∫yz dm the couple turns round and no H balances."""
    y, z, mass = 0.01, 0.07, 0.5
    lump = replace(REFERENCE, shaft=InputShaft(mass, y, mass * y * z))
    bare = replace(REFERENCE, shaft=InputShaft(mass, y, 0.0))
    force = np.array([0.0, mass * y * SPEED**2, 0.0])
    couple = np.cross([0.0, y, z], force)  # of d'Alembert's force at the lump, in the frame of the shaft
    zero = np.zeros(1)
    change = inertia_load(lump, zero, SPEED).moment[0] - inertia_load(bare, zero, SPEED).moment[0]
    np.testing.assert_allclose(change, couple, rtol=1e-12, atol=1e-12)
    wrong = replace(REFERENCE, shaft=InputShaft(mass, y, -mass * y * z))
    change = inertia_load(wrong, zero, SPEED).moment[0] - inertia_load(bare, zero, SPEED).moment[0]
    np.testing.assert_allclose(change, -couple, rtol=1e-12, atol=1e-12)


@pytest.mark.published
def test_erratum_moments_of_inertia_about_the_centre_of_precession() -> None:
    """I_2x, I_2y are about O: those about the satellite's own centre leave m2 l2² out, and Y_A misses the momenta."""
    body = REFERENCE.satellite
    x, y, z = body.inertia
    shift = body.mass * body.offset**2
    central = replace(REFERENCE, satellite=replace(body, inertia=(x - shift, y - shift, z)))
    _, rate, _ = momentum_rates(REFERENCE, np.array([0.3]), SPEED)
    assert np.linalg.norm(inertia_load(REFERENCE, np.array([0.3]), SPEED).moment + rate) < 1e-8
    assert np.linalg.norm(inertia_load(central, np.array([0.3]), SPEED).moment + rate) > 3.0
    fell = reactions(central, DEGREES, SPEED, "printed").magnitude("R_A").mean()
    assert fell == pytest.approx(46.7, abs=0.1)


@pytest.mark.published
def test_erratum_moment_about_oa_and_tooth_force() -> None:
    """Left out: the couple about OA, which the teeth carry; so the casing load as printed is off about n."""
    n = np.array([0.0, *REFERENCE.tilt])
    exact = reactions(REFERENCE, DEGREES, SPEED)
    needed = inertia_couple(REFERENCE, DEGREES, SPEED) @ n
    x, y, _ = REFERENCE.satellite.inertia
    assert np.abs(needed).max() == pytest.approx(0.5 * SPEED**2 * REFERENCE.tilt[0] ** 2 * (x - y), rel=1e-3)
    np.testing.assert_allclose(exact.mesh_couple @ n, -needed, atol=1e-14)
    printed = reactions(REFERENCE, DEGREES, SPEED, "printed")
    assert not printed.mesh_couple.any()
    crank = DEGREES[:360]
    inertia = inertia_load(REFERENCE, crank, SPEED).moment
    for found in (exact, printed):
        load = casing_load(found).moment[:360]
        about = np.sum((load - inertia) * turn(rotation(2, crank), n), axis=1)
        assert bool(np.abs(about).max() < 1e-12) is (found is exact)


@pytest.mark.published
def test_no_erratum_cosine_in_14() -> None:
    """cos θ in (14) cancels: it stands on both sides; without it on one the motor's power misses the energy."""
    _, _, power = momentum_rates(REFERENCE, DEGREES[:360:15], SPEED)
    found = reactions(REFERENCE, DEGREES[:360:15], SPEED, "printed")
    np.testing.assert_allclose(found.torque * SPEED, power, atol=1e-8)
    wrong = found.torque * REFERENCE.tilt[1]
    assert np.abs(wrong * SPEED - power).max() > 5e-4


@pytest.mark.published
@pytest.mark.parametrize("model", ["exact", "printed"])
def test_static_balance_makes_two_reactions_alike(model: Model) -> None:
    """With full static balance the equations force R_B ≡ R_O, apart from the tooth force of the exact model."""
    found = reactions(REFERENCE, DEGREES, SPEED, model)
    np.testing.assert_allclose(found.magnitude("R_B"), found.magnitude("R_O"), rtol=1e-12)
    light = replace(REFERENCE, counterweight=replace(REFERENCE.counterweight, radius=0.02))
    apart = reactions(light, DEGREES, SPEED, model)
    assert np.abs(apart.magnitude("R_B") - apart.magnitude("R_O")).min() > 10.0
    assert statically_balanced(light) == REFERENCE
    teeth = reactions(replace(REFERENCE, mesh_radius=0.055), DEGREES, SPEED, model)
    off = np.abs(teeth.magnitude("R_B") - teeth.magnitude("R_O")).max()
    assert off < 0.01
    assert bool(off > 1e-3) is (model == "exact")


@pytest.mark.published
def test_erratum_velocity_from_one_support() -> None:
    """R_B/(√2 ω m) alone is 9 times the vibration velocity: the forces on the casing cancel, a couple remains."""
    mean = reactions(REFERENCE, DEGREES, SPEED).magnitude("R_B").mean()
    alone = 1e3 * mean / (math.sqrt(2.0) * SPEED * CASING.mass)
    assert alone / vibration(REFERENCE) == pytest.approx(9.0, abs=0.1)

"""The reference case of sources §2 and what is computed of it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from trochoid.drives.precessional.balance import (
    balance_plane,
    mean_product,
    model_difference,
    remaining_couple,
    rocking_velocity,
    statically_balanced,
)
from trochoid.drives.precessional.casing import casing_vibration
from trochoid.drives.precessional.mechanism import (
    Counterweight,
    InputShaft,
    PrecessionalDrive,
    Satellite,
    mass_moments,
)
from trochoid.drives.precessional.reactions import Model, inertia_couple, reactions
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point
from trochoid.kinematics.nutation import Nutation
from trochoid.kinematics.spherical import rotation, turn
from trochoid.sources.row import Finding

MODELS: tuple[Model, Model] = ("exact", "printed")
SPEED = 1430.0 * math.pi / 30.0
DEGREES = np.linspace(0.0, 2.0 * math.pi, 361)  # both ends of the turn, as the means of the case count
DRIVE = statically_balanced(
    PrecessionalDrive(
        Nutation(15, 14, math.radians(2.5)),
        Satellite(2.0, 0.040, (5.3e-3, 5.1e-3, 3.6e-3)),
        InputShaft(1.2, 0.4e-3, 3.48e-5),  # I_3yz: the one that the case's H needs, see the rows
        Counterweight(0.15, 26.46e-3, 75e-3),
        joint=0.045,
        support=0.110,
    )
)
BARE = replace(DRIVE, shaft=replace(DRIVE.shaft, product=0.0))
FREE = Casing(25.0, (0.25, 0.25, 0.25))
MOUNTED = replace(FREE, mounts=(Mount((0.0,) * 3, (4e5,) * 3, (300.0,) * 3, (2e3,) * 3, (2.0,) * 3),))
LEVER = Point("lever", (0.0, 0.0, 0.08))


def spread(name: str, model: Model) -> tuple[float, float, float]:
    """Least, mean and largest over one turn."""
    size = reactions(DRIVE, DEGREES, SPEED, model).magnitude(name)
    return float(size.min()), float(size.mean()), float(size.max())


def torque_range(model: Model) -> tuple[float, float]:
    """Least and largest M_3, N·m."""
    torque = reactions(DRIVE, np.linspace(0.0, 7.0, 20001), SPEED, model).torque
    return float(torque.min()), float(torque.max())


def velocity(
    drive: PrecessionalDrive = DRIVE, casing: Casing = FREE, point: Point = LEVER, model: Model = "exact"
) -> float:
    """Velocity in mm/s rms, 10 to 1000 Hz, the largest direction."""
    return 1e3 * casing_vibration(drive, SPEED, casing, (point,), model).rms_max


def at_plane_of_balance() -> PrecessionalDrive:
    """The drive with its counterweight at H."""
    return replace(DRIVE, counterweight=replace(DRIVE.counterweight, z=balance_plane(DRIVE)))


def without_counterweight(center: float) -> float:
    """Velocity with the casing's centre so far from O (m), the lever measured from it."""
    none = replace(DRIVE, counterweight=replace(DRIVE.counterweight, mass=0.0))
    point = Point("lever", (0.0, 0.0, center + 0.08))
    return velocity(none, replace(FREE, center=(0.0, 0.0, center)), point)


def mean_couple(sign: float) -> float:
    """Mean couple about x (N·m) with relative speed sign·q ω_3 about OA."""
    crank = np.linspace(0.0, DRIVE.reaction_period, 61)[:-1]
    s, c = DRIVE.tilt
    q, n, k = DRIVE.tooth_ratio, np.array([0.0, s, c]), np.array([0.0, 0.0, 1.0])
    pose = rotation(0, -DRIVE.nutation.angle) @ rotation(2, sign * q * crank)
    back, inertia = np.swapaxes(pose, 1, 2), np.asarray(DRIVE.satellite.inertia)
    spin = turn(back, SPEED * (k + sign * q * n))
    twist = turn(back, SPEED**2 * sign * q * np.cross(k, n))
    return float(-turn(pose, inertia * twist + np.cross(spin, inertia * spin))[:, 0].mean())


def mean_couples() -> Finding:
    """Closed forms against the means over a turn, both models."""
    crank = np.linspace(0.0, DRIVE.reaction_period, 61)[:-1]
    closed = [SPEED**2 * mean_product(DRIVE, m) for m in MODELS]
    mean = [-float(inertia_couple(DRIVE, crank, SPEED, m)[:, 0].mean()) for m in MODELS]
    same = bool(np.allclose(closed, mean, rtol=1e-12))
    return Finding(f"{closed[0]:.4f} and {closed[1]:.4f} N·m, as the means over a turn", same)


def remaining() -> Finding:
    """Closed form of what is left against half the range of the couple over a period."""
    crank = np.linspace(0.0, DRIVE.reaction_period, 721)
    couple = inertia_couple(DRIVE, crank, SPEED)[:, 0]
    half, closed = 0.5 * float(np.ptp(couple)), remaining_couple(DRIVE, SPEED)
    return Finding(f"{closed:.4f} N·m, as over the turn", math.isclose(half, closed, rel_tol=1e-9))


def period() -> Finding:
    """Reactions a period later, and half a period later, which must differ."""
    here, later, halfway = (
        reactions(DRIVE, DEGREES + share * DRIVE.reaction_period, SPEED).joint_a for share in (0.0, 1.0, 0.5)
    )
    repeats = bool(np.abs(later - here).max() < 1e-9 < np.abs(halfway - here).max())
    return Finding(f"{math.degrees(DRIVE.reaction_period):.0f}°", repeats)


def main_line() -> Finding:
    """The closed form of the line at ω_3 against the velocity of all lines."""
    main, all_lines = 1e3 * rocking_velocity(DRIVE, SPEED, 0.25, 0.08), velocity()
    return Finding(f"{main:.4f} of {all_lines:.4f} mm/s", 0.9 < main / all_lines < 1.0)


def alike_under_static_balance() -> Finding:
    """R_B and R_O of the printed model, statically balanced and not."""
    found = reactions(DRIVE, DEGREES, SPEED, "printed")
    off = float(np.abs(found.magnitude("R_B") - found.magnitude("R_O")).max())
    light = replace(DRIVE, counterweight=replace(DRIVE.counterweight, radius=0.02))
    loose = reactions(light, DEGREES, SPEED, "printed")
    apart = float(np.abs(loose.magnitude("R_B") - loose.magnitude("R_O")).max())
    return Finding(f"less than 1e-9 N apart; {apart:.1f} N with r5 = 20 mm", off < 1e-9 < apart)


def models_apart() -> Finding:
    """Closed form of the difference between the models against the difference."""
    change = model_difference(DRIVE, DEGREES, SPEED)["Y_A"]
    exact, printed = (reactions(DRIVE, DEGREES, SPEED, m).joint_a[:, 1] for m in MODELS)
    same = bool(np.abs(exact - printed - change).max() < 1e-9)
    return Finding(f"up to {np.abs(change).max():.2f} N, the same by both", same)


def from_one_support() -> float:
    """R_B/(√2 ω m), mm/s."""
    mean = float(reactions(DRIVE, DEGREES, SPEED).magnitude("R_B").mean())
    return 1e3 * mean / (math.sqrt(2.0) * SPEED * FREE.mass)


def own_centre() -> tuple[float, float]:
    """Mean R_A of the printed model with moments of inertia about the satellite's centre, and about O."""
    body = DRIVE.satellite
    x, y, z = body.inertia
    shift = body.mass * body.offset**2
    central = replace(DRIVE, satellite=replace(body, inertia=(x - shift, y - shift, z)))
    wrong = reactions(central, DEGREES, SPEED, "printed").magnitude("R_A").mean()
    return float(wrong), spread("R_A", "printed")[1]


def forces_on_casing() -> tuple[float, float]:
    """Largest force on the casing with (20) as printed, and with the modulus that balances."""
    found = reactions(DRIVE, DEGREES, SPEED, "printed")
    _, shaft, weight = (m * SPEED**2 for m in mass_moments(DRIVE))
    rest = found.joint_a[:, 1] + found.joint_o[:, 1] - shaft
    printed, right = (float(np.abs(rest + sign * weight).max()) for sign in (-1.0, 1.0))
    return printed, round(right, 9)


def moment_of_support() -> tuple[float, float]:
    """Mean M_B by (26) as printed, and right, N·m."""
    right = spread("M_B", "exact")[1]
    return math.sqrt(3.0) * right, right


def missing_moment() -> tuple[float, float]:
    """Amplitude of the moment about OA, N·m, which the paper leaves out."""
    needed = inertia_couple(DRIVE, DEGREES, SPEED) @ np.array([0.0, *DRIVE.tilt])
    return 0.0, float(np.abs(needed).max())


def plane_with_product(sign: float) -> float:
    """H (mm) with the shaft's product of inertia taken with this sign."""
    shaft = replace(DRIVE.shaft, product=sign * DRIVE.shaft.product)
    return 1e3 * balance_plane(replace(DRIVE, shaft=shaft))

"""Precessional drives for tests: the reference case of sources §2, random ones, and a satellite made of points."""

import math

import numpy as np
import numpy.typing as npt
from hypothesis import strategies as st

from trochoid.drives.precessional.balance import statically_balanced
from trochoid.drives.precessional.mechanism import Counterweight, InputShaft, PrecessionalDrive, Satellite
from trochoid.kinematics.nutation import Nutation
from trochoid.kinematics.spherical import rotation

Array = npt.NDArray[np.float64]
SPEED = 1430.0 * math.pi / 30.0
DEGREES = np.linspace(0.0, 2.0 * math.pi, 361)  # one turn, both ends: what the reference means are taken over

# Sources §2, reference case.  "I_3yz = 0 unless given", but M_B, H and v admit only 3.480e-5 kg·m² (m3 y3·72.5 mm).
REFERENCE = statically_balanced(
    PrecessionalDrive(
        Nutation(15, 14, math.radians(2.5)),
        Satellite(2.0, 0.040, (5.3e-3, 5.1e-3, 3.6e-3)),
        InputShaft(1.2, 0.4e-3, 3.48e-5),
        Counterweight(0.15, 26.46e-3, 75e-3),
        joint=0.045,
        support=0.110,
    )
)


@st.composite
def drives(draw: st.DrawFn) -> PrecessionalDrive:
    """Any drive: tooth numbers, nutation angle, masses, places; the satellite is a body that can exist."""
    fixed = draw(st.integers(2, 60))
    satellite = draw(st.integers(2, 60).filter(lambda z: z != fixed))
    number = st.floats(0.01, 1.0)
    a, b, h, offset = (draw(number) for _ in range(4))
    mass = draw(st.floats(0.1, 5.0))
    inertia = (b * b + offset**2 + h * h, a * a + offset**2 + h * h, a * a + b * b)
    return PrecessionalDrive(
        Nutation(fixed, satellite, draw(st.floats(0.005, 0.6))),
        Satellite(mass, offset, (mass * inertia[0], mass * inertia[1], mass * inertia[2])),
        InputShaft(draw(number), draw(st.floats(-0.1, 0.1)), draw(st.floats(-0.1, 0.1))),
        Counterweight(draw(number), draw(number), draw(st.floats(-1.0, 1.0)), draw(st.floats(-0.1, 0.1))),
        joint=draw(number),
        support=draw(st.floats(-1.0, 1.0)),
        mesh_radius=draw(number),
    )


def cloud(satellite: Satellite) -> tuple[Array, Array]:
    """Eight points (8, 3) and their masses (8,) that have the satellite's mass, centre and inertia about O."""
    x, y, z = satellite.inertia
    a, b, whole = (math.sqrt(max(0.5 * i / satellite.mass, 0.0)) for i in (y + z - x, x + z - y, x + y - z))
    h = math.sqrt(max(whole**2 - satellite.offset**2, 0.0))
    corners = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)], dtype=np.float64)
    return corners * [a, b, h] + [0.0, 0.0, satellite.offset], np.full(8, satellite.mass / 8.0)


def satellite_pose(drive: PrecessionalDrive, crank: Array) -> Array:
    """Rotation (n, 3, 3) from the satellite to the fixed frame, n = (0, s, c) in the frame of the shaft."""
    body = rotation(0, -drive.nutation.angle) @ rotation(2, -drive.tooth_ratio * crank)
    posed: Array = rotation(2, crank) @ body
    return posed


def particles(drive: PrecessionalDrive, crank: Array) -> tuple[Array, Array]:
    """Places (n, p, 3) in the fixed frame and masses (p,) of points with the inertia of the whole mechanism.

    A product of inertia is a couple of ±1 kg points at (0, ±p, ±1), less what they weigh, so masses may be negative.
    """
    own, mass = cloud(drive.satellite)
    moving = np.einsum("nij,pj->npi", satellite_pose(drive, crank), own)
    weight, shaft = drive.counterweight, drive.shaft
    extra = 0.5 * (shaft.product + weight.product)
    turning = np.array(
        [[0.0, shaft.offset, 0.0], [0.0, -weight.radius, weight.z], [0.0, extra, 1.0], [0.0, -extra, -1.0]]
    )
    posed = np.einsum("nij,pj->npi", rotation(2, crank), turning)
    return np.concatenate((moving, posed), axis=1), np.concatenate(
        (mass, [shaft.mass, weight.mass, 1.0, 1.0])
    )


def momentum_rates(drive: PrecessionalDrive, crank: Array, speed: float) -> tuple[Array, Array, Array]:
    """Rates of momentum and moment of momentum about O (n, 3), and of the kinetic energy (n,), by differences.

    Places of points at times about each position, differentiated twice with stencils of tenth order.
    """
    weights = np.array([2100.0, -600.0, 150.0, -25.0, 2.0]) / 2520.0
    step = 0.05 / (1.0 + drive.tooth_ratio)

    def velocity(at: Array) -> Array:
        parts = [
            w * (particles(drive, at + k * step)[0] - particles(drive, at - k * step)[0])
            for k, w in enumerate(weights, 1)
        ]
        return np.asarray(np.sum(parts, axis=0) * speed / step)

    def momenta(at: Array) -> Array:
        places, mass = particles(drive, at)
        moving = velocity(at)
        linear = np.einsum("p,npi->ni", mass, moving)
        angular = np.einsum("p,npi->ni", mass, np.cross(places, moving))
        energy = 0.5 * np.einsum("p,npi,npi->n", mass, moving, moving)
        return np.concatenate((linear, angular, energy[:, None]), axis=1)

    parts = [w * (momenta(crank + k * step) - momenta(crank - k * step)) for k, w in enumerate(weights, 1)]
    rates = np.asarray(np.sum(parts, axis=0) * speed / step)
    return rates[:, :3], rates[:, 3:6], rates[:, 6]

"""Speeds of K-H-V, 2K-V and 2K-H trains by inverted motion and by velocities of a compound motion.

Each of these trains has two freedoms, so that two motions of it make up all: u·one + v·two.  Inverted motion
(Willis) takes the one in which the crank or carrier stands, an ordinary train, and the one in which all turns
as a block.  Compound motion takes the carrier (crank) turning alone and the ring turning alone, and adds
velocities of points.  Neither shares anything with the constraint matrix of `kinematics.train`.
Speeds are algebraic throughout; sources §1 counts that of the planet against the sun in (6)–(8).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from trochoid.kinematics.train import Speeds, fail_if_no_choice, over_driving

Turning = Mapping[str, Fraction]


@dataclass(frozen=True, slots=True)
class Motions:
    """Two motions of a train with two freedoms: speed of each member, in any unit."""

    one: Turning
    two: Turning


def superposed(motions: Motions, fixed: str, driving: str, driven: str) -> Speeds:
    """Speeds of the superposition in which `fixed` stands, over the driving one's; raises TrochoidError."""
    fail_if_no_choice(motions.one, fixed, driving, driven)
    u, v = motions.two[fixed], -motions.one[fixed]
    turning = {member: u * motions.one[member] + v * motions.two[member] for member in motions.one}
    return over_driving(turning, fixed, driving, driven)


def _inverted(seen: Turning) -> Motions:
    """From the speeds seen from the crank or carrier: add a common turning, ω − ω_h = ω^h."""
    return Motions(seen, dict.fromkeys(seen, Fraction(1)))


def khv_inverted(pins: int, lobes: int) -> Motions:
    """Seen from the crank the disc and the ring are an internal pair on fixed axes: z_c ω_c = z_p ω_p."""
    disc, ring = Fraction(1), Fraction(lobes, pins)
    return _inverted({"input": Fraction(0), "disc": disc, "ring": ring, "output": disc})


def rv_inverted(sun: int, planet: int, lobes: int, pins: int) -> Motions:
    """Sources §1 (2): seen from the carrier z_a ω_a = −z_g ω_g and z_b ω_b = (z_b − z_f) ω_g; the disc only shifts."""
    fast = -Fraction(sun, planet)
    ring = fast * Fraction(pins - lobes, pins)
    still = Fraction(0)
    return _inverted({"sun": Fraction(1), "planet": fast, "disc": still, "ring": ring, "carrier": still})


def planetary_inverted(sun: int, planet: int, ring: int) -> Motions:
    """Seen from the carrier z_a ω_a = −z_g ω_g and z_g ω_g = z_b ω_b."""
    fast = -Fraction(sun, planet)
    outer = fast * Fraction(planet, ring)
    return _inverted({"sun": Fraction(1), "planet": fast, "ring": outer, "carrier": Fraction(0)})


def khv_compound(pins: int, lobes: int, eccentricity: Fraction = Fraction(1)) -> Motions:
    """At the pitch point e ω_h + r_c ω_c = r_p ω_p; the vector from roller to hole turns with the crank."""
    ring_radius = eccentricity * Fraction(pins, pins - lobes)
    disc_radius = ring_radius - eccentricity

    def at(crank: Fraction, ring: Fraction) -> Turning:
        disc = (ring * ring_radius - crank * eccentricity) / disc_radius
        # a hole at ρ from the disc's centre, its roller at ρ from the axis: e ω_h + ρ ω_c = ρ ω_out + e ω_h
        return {"input": crank, "disc": disc, "ring": ring, "output": disc}

    return Motions(at(Fraction(1), Fraction(0)), at(Fraction(0), Fraction(1)))


def rv_compound(
    sun: int,
    planet: int,
    lobes: int,
    pins: int,
    eccentricity: Fraction = Fraction(1),
    module: Fraction = Fraction(2),
) -> Motions:
    """Sources §1 (6)–(8), with a ring that may turn: L ω_h + e ω_g = r_b ω_b − r_A ω_f at crank end A (7),
    −L ω_h + e ω_g = r_b ω_b − r_B ω_f at B (8), r_a ω_a = L ω_h − r_g ω_g at the sun (6); r_A, r_B = r_f ∓ L.
    """
    r_a, r_g = module * sun / 2, module * planet / 2
    arm = r_a + r_g
    r_b = eccentricity * Fraction(pins, pins - lobes)
    r_f = r_b - eccentricity
    end_a, end_b = r_f - arm, r_f + arm

    def at(carrier: Fraction, ring: Fraction) -> Turning:
        disc = carrier * 2 * arm / (end_b - end_a)  # (7) − (8)
        fast = (r_b * ring - end_a * disc - arm * carrier) / eccentricity  # (7)
        first = (arm * carrier - r_g * fast) / r_a  # (6)
        return {"sun": first, "planet": fast, "disc": disc, "ring": ring, "carrier": carrier}

    return Motions(at(Fraction(1), Fraction(0)), at(Fraction(0), Fraction(1)))


def planetary_compound(sun: int, planet: int, ring: int, center_distance: Fraction = Fraction(1)) -> Motions:
    """At the two pitch points r_a ω_a = a ω_h − r_g ω_g and r_b ω_b = a ω_h + r_g′ ω_g."""
    a = center_distance
    r_a, r_g = a * Fraction(sun, sun + planet), a * Fraction(planet, sun + planet)
    r_b, r_inner = a * Fraction(ring, ring - planet), a * Fraction(planet, ring - planet)

    def at(carrier: Fraction, outer: Fraction) -> Turning:
        fast = (r_b * outer - a * carrier) / r_inner
        return {"sun": (a * carrier - r_g * fast) / r_a, "planet": fast, "ring": outer, "carrier": carrier}

    return Motions(at(Fraction(1), Fraction(0)), at(Fraction(0), Fraction(1)))

"""Bodies and drives that several test modules set up, and the closed forms they are held against."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from trochoid.fem.body import Body, build_body
from trochoid.fem.compliance import Compliance, place_stations, press, tabulate
from trochoid.fem.material import Material, Plane
from trochoid.fem.pair import FlankPair, HolePair, Member, Seat
from trochoid.fem.position import Assembly, Contact, ElasticBody, Family, solve_position
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.types import Array

STEEL = Material(210e9, 0.3, 7850.0).plane("strain")
FLANK = Cycloid(20, 19, 0.080, 0.005, 0.0025)  # the disc of the example and of the convergence study
RADIUS = 0.05  # of the circular disc, m
# 60 different crank angles: over a turn in 60 equal steps, 20 pins see only three
POSITIONS = tuple(float(p) for p in np.mod(2.399963 * np.arange(60), 2 * np.pi))


def round_loop(facets: int, radius: float = RADIUS) -> Loop:
    """Return the rim of a circular disc about the origin."""
    return Loop("rim", Circle((0.0, 0.0), radius), facets)


@lru_cache(maxsize=16)
def round_disc(facets: int, radius: float = RADIUS, plane: Plane = STEEL) -> tuple[Body, Compliance]:
    """Return a free circular disc and its compliance."""
    loop = round_loop(facets, radius)
    body = build_body(mesh_outline(Outline(loop)), plane)
    return body, press(body, [loop])


def small_mesh(facets_per_lobe: int = 3) -> tuple[Mesh, Outline]:
    """Return a coarse mesh of the disc with bore and holes."""
    outline = disc_outline(FLANK, 0.025, 8, 0.052, 0.009, 0.0, facets_per_lobe)
    return mesh_outline(outline), outline


def on_circle(radius: float, angle: Array) -> Array:
    """Return points (n, 2) of a circle about the origin."""
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def free_disc_green(plane: Plane, angle: Array) -> Array:
    """Return the radial displacement of the rim of a free disc, inwards, per unit radial line load `angle` away.

    The load is balanced by a uniform body force, displacement is measured from the disc's mean motion. With
    φ = A z^(n+1), ψ = B z^(n−1) (Muskhelishvili) a pressure p cos nθ gives the inward displacement
    (R p/4G)(κ/(n+1) + 1/(n−1)) cos nθ for n ≥ 2; n = 0 gives R p (κ−1)/4G; n = 1 with its body force leaves
    the stress σ = −b x, and R p (κ−1)/8G. Summed for a point load, p_n = 1/(πR), p_0 = 1/(2πR).
    """
    kappa, angle = plane.kolosov, np.mod(angle, 2 * np.pi)
    with np.errstate(divide="ignore"):
        logarithm = np.log(2 * np.sin(angle / 2))
    even = (kappa + 1) * (-np.cos(angle) * logarithm - 0.5 - 0.25 * np.cos(angle))
    odd = (kappa - 1) * (0.25 * np.cos(angle) + 0.5 * (np.pi - angle) * np.sin(angle))
    return np.asarray((even + odd) / (4 * np.pi * plane.shear))


def free_disc_smooth(plane: Plane, radius: float, angle: Array) -> Array:
    """Return S = `free_disc_green` plus 2/(πE') ln(chord), also at angle 0."""
    angle = np.mod(np.asarray(angle, dtype=np.float64), 2 * np.pi)
    kappa, same = plane.kolosov, np.minimum(angle, 2 * np.pi - angle) < 1e-9
    at_zero = plane.kernel * (np.log(radius) - 0.75) + (kappa - 1) / (16 * np.pi * plane.shear)
    apart = np.where(same, 1.0, angle)
    smooth = free_disc_green(plane, apart) + plane.kernel * np.log(2 * radius * np.sin(apart / 2))
    return np.asarray(np.where(same, at_zero, smooth))


def hole_in_plate_green(plane: Plane, angle: Array) -> Array:
    """Return the same for a hole in an infinite plate, displacement into the material, less a rigid motion.

    φ = A z^(1−n), ψ = B z^(−n−1): (R p/4G)(κ/(n−1) + 1/(n+1)) cos nθ, and R p/2G for n = 0; the displacement
    of n = 1 is a motion of the whole hole (with the logarithm of the distance where the plate is held).
    """
    kappa, angle = plane.kolosov, np.mod(angle, 2 * np.pi)
    with np.errstate(divide="ignore"):
        logarithm = np.log(2 * np.sin(angle / 2))
    even = (kappa + 1) * (-np.cos(angle) * logarithm - 0.5 - 0.25 * np.cos(angle))
    odd = (kappa - 1) * (0.5 + 0.25 * np.cos(angle) - 0.5 * (np.pi - angle) * np.sin(angle))
    return np.asarray((even + odd + 1.0) / (4 * np.pi * plane.shear))


@lru_cache(maxsize=8)
def held_disc(facets_per_lobe: int) -> ElasticBody:
    """Return the disc of the convergence study: no holes, 10 mm wide, held at its bore, pressed at its flank."""
    outline = disc_outline(FLANK, 0.025, 0, 0.052, 0.009, 0.0, facets_per_lobe)
    body = build_body(mesh_outline(outline), STEEL, ("bore",))
    stations, surfaces = place_stations(body, outline.loops[:1])
    return ElasticBody(tabulate(body, stations, surfaces), 0.010)


def held_position(
    disc: ElasticBody, crank_angle: float, torque: float = 200.0, turned: float = 0.0
) -> Assembly:
    """Return that disc against rigid pins at a crank angle, under a torque in N·m; `turned`: the whole drive."""
    moves = np.array([[0.0], [0.0], [1.0]])
    center = FLANK.eccentricity * np.array([np.cos(crank_angle + turned), np.sin(crank_angle + turned)])
    member = Member(center, turned - crank_angle / FLANK.lobes, moves)
    ring = Member(np.zeros(2), turned, np.zeros((3, 1)))
    pair = FlankPair.nominal(member, ring, FLANK, crank_angle, disc.compliance.surfaces["flank"])
    kernel = np.full(FLANK.pins, STEEL.kernel / disc.width)
    family = Family("ring", pair, kernel, np.zeros(FLANK.pins))
    return Assembly((family,), (disc,), np.zeros((1, 1)), np.array([-torque]))


@lru_cache(maxsize=1000)
def solve_held(
    facets_per_lobe: int, crank_angle: float, torque: float = 200.0, resolve: bool = False
) -> Contact:
    """Solve one position of the disc held at its bore."""
    return solve_position(held_position(held_disc(facets_per_lobe), crank_angle, torque), resolve)


@lru_cache(maxsize=2)
def drilled_disc(facets_per_lobe: int = 3) -> ElasticBody:
    """Return a coarse free disc with bore and eight holes, pressed on all its loops."""
    mesh, outline = small_mesh(facets_per_lobe)
    return ElasticBody(press(build_body(mesh, STEEL), outline.loops), 0.010)


def whole_drive(
    crank_angle: float,
    torque: float = 200.0,
    turned: float = 0.0,
    shift: tuple[float, float] = (0.0, 0.0),
    play: float = 0.0,
) -> Assembly:
    """Return one free disc between ring pins, output rollers and the rollers of a rigid eccentric.

    Motions: x, y, rotation of the disc and rotation of the flange, which the torque loads. `turned` and
    `shift` move the whole drive in the plane; `play` is in the ring's grooves.
    """
    disc_moves, flange_moves = np.eye(3, 4), np.zeros((3, 4))
    flange_moves[2, 3] = 1.0
    c, s = np.cos(turned), np.sin(turned)
    center = FLANK.eccentricity * on_circle(1.0, np.array([crank_angle + turned]))[0]
    turn, still = turned - crank_angle / FLANK.lobes, np.zeros((3, 4))
    # the disc's x and y turn with the drive, so that motions of equal number mean the same
    disc_moves[:2, :2] = [[c, -s], [s, c]]
    disc = Member(center + np.array(shift), turn, disc_moves)
    ring, flange = Member(np.array(shift), turned, still), Member(np.array(shift), turn, flange_moves)
    cage = Member(disc.center, turned + 0.3, still)
    body = drilled_disc()
    surfaces = body.compliance.surfaces
    flank = replace(FlankPair.nominal(disc, ring, FLANK, crank_angle, surfaces["flank"]), play=play)
    holes = on_circle(0.052, 2 * np.pi * np.arange(8) / 8)
    seats = Seat.on(0, [surfaces[f"hole{j}"] for j in range(8)])
    output = HolePair(disc, flange, holes, 0.009, holes, 0.009 - FLANK.eccentricity, seats)
    rollers = on_circle(0.025 - 0.004, 2 * np.pi * np.arange(12) / 12)
    bearing = HolePair(
        disc, cage, np.zeros((12, 2)), 0.025, rollers, 0.004, Seat.on(0, [surfaces["bore"]] * 12)
    )
    one = STEEL.kernel / body.width
    families = (
        Family("ring", flank, np.full(20, 2 * one), np.full(20, one * (np.log(2 * 0.005) - 1))),
        Family("output", output, np.full(8, 2 * one), np.full(8, one * (np.log(2 * 0.0065) - 1))),
        Family("bearing", bearing, np.full(12, one), np.zeros(12)),
    )
    return Assembly(families, (body,), np.zeros((4, 4)), np.array([0.0, 0.0, 0.0, torque]))

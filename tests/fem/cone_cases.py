"""The reference rim of sphere teeth for tests: 30 pins on a ring, 29 teeth, built once per mesh."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.cone_assembly import RIGID_ROLLER, ConeAssembly, ConeContact, Roller
from trochoid.fem.cone_body import ConeBody, cone_body
from trochoid.fem.cone_layers import layers
from trochoid.fem.cone_pair import RIGID, RollerPair, roller_pair
from trochoid.fem.cone_position import solve_cone
from trochoid.fem.cone_rim import Rim, RimMesh, RimSize, press_rim
from trochoid.fem.material import Material
from trochoid.fem.pair import FlankPair, Member
from trochoid.fem.position import Assembly, Contact, ElasticBody, Family, solve_positions
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import sector_outline
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.motion import khv_motions
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.types import Array, IntArray

STEEL = Material(210e9, 0.3)
TOOTH = SphereTooth(30, 29, math.radians(65.0), math.radians(2.5), math.radians(3.0))
SHAPE = RimShape(TOOTH, math.radians(52.0))
INNER, OUTER = 48e-3, 60e-3
SPIN = RIGID[:, 2:3]  # about the rim's own axis


@lru_cache(maxsize=6)
def rim(facets: int = 16, count: int = 5, parts: int = 1) -> Rim:
    """The full rim."""
    return press_rim(SHAPE, RimSize(INNER, OUTER), STEEL, RimMesh(facets, count, parts=parts))


def sector(facets: int = 12, count: int = 5, teeth: int = 1) -> ConeBody:
    """One or more teeth, meshed together."""
    mesh = mesh_sphere(sector_outline(SHAPE, facets, teeth))
    return cone_body(mesh, layers(INNER, OUTER, count), STEEL)


def pair(
    built: Rim,
    crank: Array,
    moves: Array = SPIN,
    rollers: IntArray | None = None,
    clearance: float = 0.0,
    relief: Array | float = 0.0,
) -> RollerPair:
    """Rollers on a rim."""
    slices = built.compliance.slices
    return roller_pair(TOOTH, crank, slices, SHAPE.start, rollers, moves, clearance, relief)


def solved(
    built: Rim,
    rollers: RollerPair,
    load: Array | float,
    springs: Array | None = None,
    roller: Roller = RIGID_ROLLER,
) -> ConeContact:
    """Solve all positions of the rollers under one load (k,) on the motions."""
    k = rollers.moves.shape[1]
    every = np.broadcast_to(np.asarray(load, dtype=np.float64), (len(rollers.crank), k))
    held = np.zeros((k, k)) if springs is None else springs
    return solve_cone(ConeAssembly(built.compliance, rollers, held, every, roller))


def plane_disc(crank: Array, torque: float, width: float) -> Contact:
    """The cycloid disc of the planar limit, its bore held, in plane stress without Poisson's ratio."""
    profile, plane = Cycloid(12, 11, 24e-3, 2e-3, 1.2e-3), Material(210e9, 0.0).plane("stress")
    outline = disc_outline(profile, 12e-3, 0, 0.0, 0.0, 0.0, 16)
    body = build_body(mesh_outline(outline), plane, supports=("bore",))
    elastic = ElasticBody(press(body, [outline.outer]), width)
    pose = khv_motions(profile, crank)["disc0"]
    disc = Member(pose.center, pose.rotation, np.array([[0.0], [0.0], [1.0]]))
    surface = elastic.compliance.surfaces["flank"]
    pins = FlankPair.nominal(disc, Member(np.zeros(2), 0.0, np.zeros((3, 1))), profile, crank, surface)
    family = Family("pins", pins, np.full(12, plane.kernel / width), np.zeros(12))
    load = np.full((len(crank), 1), torque)
    return solve_positions(Assembly((family,), (elastic,), np.zeros((1, 1)), load))

"""The reference rim of sphere teeth for tests: 30 pins on a ring, 29 teeth, built once per mesh."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from trochoid.fem.cone_body import ConeBody, cone_body
from trochoid.fem.cone_layers import layers
from trochoid.fem.cone_pair import RIGID, RollerPair, roller_pair
from trochoid.fem.cone_position import RIGID_ROLLER, ConeAssembly, ConeContact, Roller, solve_cone
from trochoid.fem.cone_rim import Rim, RimMesh, RimSize, press_rim
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import RimShape, sector_outline
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

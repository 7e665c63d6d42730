"""Sphere teeth in three dimensions: what a rim costs, and how far it is from contact resolved by finite elements.

30 pins on the ring, 29 teeth on the satellite, polar angle 65°, nutation 3°, roller half angle 2.5°, 48 to 60 mm from
the centre, rigid rollers, hub held at 50°.
"""

from __future__ import annotations

import math
import resource
import sys
from time import process_time

import numpy as np

from benchmarks.table import Row, Table
from trochoid.fem.cone_assembly import ConeAssembly, ConeContact
from trochoid.fem.cone_body import cone_body
from trochoid.fem.cone_estimate import estimate
from trochoid.fem.cone_flank import flank
from trochoid.fem.cone_layers import layers
from trochoid.fem.cone_pair import RIGID, roller_pair
from trochoid.fem.cone_position import solve_cone
from trochoid.fem.cone_resolved import Resolved, Window, resolve
from trochoid.fem.cone_rim import Rim, RimMesh, RimSize, press_rim
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import outline_of_breaks
from trochoid.geometry.sphere_refined import Focus, refined_breaks
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.types import Array, IntArray

TOOTH = SphereTooth(30, 29, math.radians(65.0), math.radians(2.5), math.radians(3.0))
SHAPE = RimShape(TOOTH, math.radians(50.0))
SIZE, STEEL, SPIN = RimSize(48e-3, 60e-3), Material(210e9, 0.3), RIGID[:, 2:3]
POSITIONS, TORQUE = 120, 135.0
FIRST, TEETH, CRANK = 3, 3, 0.3  # of the row that is resolved


def measure() -> list[Table]:
    """Measure the cost of a turn, its estimated error, and one position against the oracle."""
    return [
        _turn(),
        _oracle("one tooth", np.array([5]), 500.0),
        _oracle("two teeth", np.array([5, 6]), 800.0),
    ]


def _turn() -> Table:
    start = process_time()
    rim = press_rim(SHAPE, SIZE, STEEL)
    built = process_time()
    found = _solved(rim, POSITIONS)
    solved = process_time()
    coarse = press_rim(SHAPE, SIZE, STEEL, RimMesh().coarser)
    error = estimate(found, _solved(coarse, POSITIONS), np.full((POSITIONS, 1), TORQUE))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (
        2**20 if sys.platform == "darwin" else 2**10
    )
    pressed = (found.total > 0.0).sum(axis=1)
    rows = (
        Row("degrees of freedom of a tooth", float(rim.dofs), "", 45000),
        Row("set-up of all teeth, processor time", built - start, "s", 15.0),
        Row("peak memory", memory, "MiB", 2048.0),
        Row(f"{POSITIONS} positions, processor time", solved - built, "s", 25.0),
        Row(
            f"a position with up to {pressed.max()} contacts", 1e3 * (solved - built) / POSITIONS, "ms", 50.0
        ),
        Row("estimated error of the rotation", float(error.motion.max())),
        Row("estimated error of shares", float(error.share.max())),
        Row("estimated error of the largest pressure", float(error.pressure.max())),
    )
    return Table("a rim of 29 sphere teeth over a turn of the crank", f"{TORQUE:g} N·m, rigid rollers", rows)


def _solved(rim: Rim, count: int) -> ConeContact:
    crank = 2.0 * math.pi * np.arange(count) / count
    pair = roller_pair(TOOTH, crank, rim.compliance.slices, SHAPE.start, moves=SPIN)
    return solve_cone(ConeAssembly(rim.compliance, pair, np.zeros((1, 1)), np.full((count, 1), TORQUE)))


def _oracle(name: str, rollers: IntArray, force: float) -> Table:
    load = np.array([0.0486 * force])
    row = press_rim(SHAPE, RimSize(48e-3, 60e-3, teeth=TEETH), STEEL).compliance
    pair = roller_pair(TOOTH, np.array([CRANK]), row.slices, SHAPE.start + FIRST * SHAPE.pitch, rollers, SPIN)
    found = solve_cone(ConeAssembly(row, pair, np.zeros((1, 1)), load[None]))
    start = process_time()
    exact = _resolved(found, row.slices.middle, rollers, load)
    seconds = process_time() - start
    line = np.abs(found.force[0] / exact.line - 1.0)
    peak = np.abs(found.pressure[0] / exact.pressure.max(axis=1) - 1.0)
    share = np.abs(found.total[0] / exact.line.sum(axis=1) - 1.0)
    rows = (
        Row("degrees of freedom", float(exact.dofs), "", 350000),
        Row("processor time", seconds, "s", 180.0),
        Row("error of the approach", abs(float(found.motion[0, 0] / exact.motion[0]) - 1.0), "", 0.01),
        Row("error of the shares", float(share.max()), "", 0.01),
        Row("error of line loads but at the ends", float(line[:, 1:-1].max())),
        Row("error of line loads at the ends", float(line[:, [0, -1]].max()), "", 0.03),
        Row("error of the largest pressure of slices", float(peak.max()), "", 0.03),
    )
    return Table(
        f"slices against resolved contact, {name}", f"{force:g} N in all, facets of an eighth of b", rows
    )


def _resolved(found: ConeContact, rho: Array, rollers: IntArray, load: Array, per: int = 8) -> Resolved:
    width, place = (found.half_width[0] / rho).max(axis=1), found.state.parameter[0]
    half = math.ceil(1.4 * per)
    foci = tuple(Focus(float(p), float(w) / per, 2 * half) for p, w in zip(place, width, strict=True))
    breaks = refined_breaks(SHAPE, FIRST, TEETH, 20, foci)
    mesh = mesh_sphere(outline_of_breaks(SHAPE, breaks, 1.35), 1.35)
    body = cone_body(mesh, layers(48e-3, 60e-3, RimMesh().layers), STEEL)
    side = flank(mesh, TOOTH)
    windows = tuple(
        Window(
            int(np.argmin(np.abs(side.parameters[0] - p))) + np.arange(-half, half),
            TOOTH.center_path(TOOTH.contact_parameter(roller, CRANK)),
            TOOTH.pin_angle,
        )
        for p, roller in zip(place, rollers, strict=True)
    )
    return resolve(body, side, windows, SPIN, load)

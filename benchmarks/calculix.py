"""The same position of the same disc by the program and by CalculiX: error and time of both.

The disc of `disc` without holes, plane strain, pins rigid, at a crank angle of 0.1 rad. The program solves for 200 N·m;
CalculiX has the bore turned by the angle of the finest solution, and its moment is compared with 200 N·m. Divided by
the tangent stiffness that is, to first order, the error of the rotation under 200 N·m.
"""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from subprocess import CalledProcessError, TimeoutExpired
from time import process_time

import numpy as np

from benchmarks import ccx
from benchmarks.disc import FLANK, STEEL, TORQUE, WIDTH, positions
from benchmarks.table import Row, Table
from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.position import ElasticBody
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.kinematics.types import Array

CRANK = 0.1
LEVELS, FINEST = (12, 20), 60  # facets per lobe
PENALTIES = (
    1e7,
    1e8,
    1e9,
)  # N/mm³: E per 20 µm is the first, and the next two are ten and a hundred times that
SAME = 5e-3  # what both programs may differ by


@dataclass(frozen=True, slots=True)
class Ours:
    """Rotation in rad, stiffness in N·m/rad, pin forces (pins,) in N; processor seconds cold and warm."""

    rotation: float
    stiffness: float
    force: Array
    cold: float
    warm: float


def measure() -> list[Table]:
    """Compare, or say that CalculiX is missing."""
    finest = _ours(FINEST)
    rows: list[Row] = []
    for level in LEVELS:
        found, name = _ours(level), f"{level} facets per lobe"
        rows.append(Row(f"{name}: rotation", abs(found.rotation / finest.rotation - 1)))
        rows.append(Row(f"{name}: pin forces / the largest", _off(found.force, finest.force)))
        rows.append(Row(f"{name}: cold", found.cold, "s"))
        rows.append(Row(f"{name}: one more position", 1e3 * found.warm, "ms"))
    how = f"errors against {FINEST} facets per lobe; 20 rigid pins, {TORQUE:g} N·m, plane strain; processor time"
    return [Table("one position by the program, with strips", how, tuple(rows)), _calculix(finest)]


def _ours(level: int) -> Ours:
    start = process_time()
    outline = disc_outline(FLANK, ccx.BORE, 0, 52e-3, 9e-3, 0.0, level)
    body = build_body(mesh_outline(outline), STEEL, ("bore",))
    elastic = ElasticBody(press(body, [outline.outer]), WIDTH)
    built = process_time()
    found = positions(elastic, np.array([CRANK]), resolve=True)
    end = process_time()
    force = found.touches["pins"].force[0]
    return Ours(float(found.motion[0, 0]), float(found.stiffness[0, 0, 0]), force, end - start, end - built)


def _calculix(finest: Ours) -> Table:
    title = "the same position by CalculiX"
    if shutil.which("ccx") is None:
        return Table(
            title, "skipped: there is no ccx; on Debian or Ubuntu run: apt-get install calculix-ccx", ()
        )
    rows: list[Row] = []
    before: ccx.Solved | None = None
    nodes = 0
    for penalty in PENALTIES:
        name = f"penalty {penalty:.0e} N/mm³"
        try:
            found = ccx.solve(CRANK, finest.rotation, penalty)
        except (CalledProcessError, TimeoutExpired) as fault:
            reason = "no convergence" if isinstance(fault, CalledProcessError) else f"over {ccx.LIMIT:g} s"
            rows.append(Row(f"{name}: {reason}", np.nan))
            continue
        nodes = found.nodes
        hardest = penalty == PENALTIES[-1]
        moment, force = abs(found.moment / TORQUE - 1), _off(found.force, finest.force)
        slack = finest.stiffness * finest.rotation / TORQUE
        rows.append(Row(f"{name}: moment", moment, "", SAME if hardest else None))
        rows.append(Row(f"{name}: rotation", moment / slack))
        rows.append(Row(f"{name}: pin forces / the largest", force, "", SAME if hardest else None))
        if before is not None:
            rows.append(Row(f"{name}: change of the moment", abs(found.moment / before.moment - 1)))
        rows.append(Row(f"{name}: processor time", found.processor, "s"))
        rows.append(Row(f"{name}: wall time", found.wall, "s"))
        before = found
    how = (
        f"against the program's {FINEST} facets per lobe; {nodes} nodes of the disc in its plane, one thread"
    )
    return Table(title, how, tuple(rows))


def _off(force: Array, finest: Array) -> float:
    return float(np.abs(force - finest).max() / finest.max())

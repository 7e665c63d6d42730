"""Stress and displacement of every disc at one position, and the tension in the fillets of the first stage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.disc_field import DiscState, Pose, disc_state
from trochoid.drives.rv.bodies import Level
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.series import solve_at
from trochoid.fem.position import Contact
from trochoid.fem.stress import Press, pressed
from trochoid.fem.stress_field import StressField
from trochoid.geometry.mesh import Mesh

EDGES = ("flank", "crank_holes", "windows", "bore")


@dataclass(frozen=True, slots=True)
class DiscStress:
    """The state of a disc in the carrier's frame, and its largest von Mises stress in Pa where each kind of edge is the
    nearest.
    """

    state: DiscState
    nearest: dict[str, float]


def disc_stresses(design: Design, rung: str, level: Level, angle: float) -> tuple[DiscStress, ...]:
    """Solve one input angle (rad) and return every disc's state there. Raises NotConverged."""
    contact = solve_at(design, rung, level, angle)
    return tuple(_disc(design, level, contact, angle, i) for i in range(len(design.discs)))


def _disc(design: Design, level: Level, contact: Contact, angle: float, i: int) -> DiscStress:
    disc, motion = design.discs[i], contact.motion[3 * i : 3 * i + 3]
    turn = disc.lead - disc.crank / design.flank.lobes
    center = design.eccentric(i, design.crank_angle(np.array([angle])))[0]
    body = level.bodies[disc.body]
    pressing = presses(design, contact, i, turn + float(motion[2]))
    state = disc_state(body, pressing, Pose(center, turn, disc.z, motion), angle)
    return DiscStress(state, _nearest(body.mesh, state.field))


def presses(design: Design, contact: Contact, i: int, turn: float) -> list[Press]:
    """Return all contacts of disc i as line loads in its own frame, which stands at `turn` (rad)."""
    width, count = design.drive.cycloid.face_width, len(design.crank_places)
    ring = contact.touches[f"ring{i}"]
    found = pressed(ring, ["flank"] * len(ring.force), turn, width)
    for j in range(count):
        rollers = contact.touches[f"arm{i}_{j}"]
        hole = f"hole{(j + design.discs[i].first_hole) % count}"
        found += pressed(rollers, [hole] * len(rollers.force), turn, width)
    return found


def _nearest(mesh: Mesh, field: StressField) -> dict[str, float]:
    """Return the largest von Mises stress by the edge that lies nearest, of the edges that the disc has."""
    from scipy.spatial import cKDTree

    nodes = [np.unique(edge) for edge in mesh.edges.values()]
    kinds = np.repeat([EDGES.index(_kind(name)) for name in mesh.edges], [len(n) for n in nodes])
    used = np.unique(field.triangles)
    _, near = cKDTree(mesh.points[np.concatenate(nodes)]).query(field.points[used])
    values, of = field.von_mises[used], kinds[near]
    return {EDGES[k]: float(values[of == k].max(initial=0.0)) for k in np.unique(kinds).tolist()}


def _kind(edge: str) -> str:
    """Return the kind of a named edge of a disc."""
    return {"hole": "crank_holes", "window": "windows"}.get(edge.rstrip("0123456789"), edge)

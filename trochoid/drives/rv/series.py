"""The drive's contacts over the input angle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from trochoid.drives.rv.bodies import Level
from trochoid.drives.rv.breakdown import compliance_parts
from trochoid.drives.rv.contact import Layout, assembly, layout, side_slopes
from trochoid.drives.rv.design import Design
from trochoid.drives.unsolved import unsolved
from trochoid.fem.moving import softness
from trochoid.fem.position import Assembly, Contact, Touch, solve_positions
from trochoid.fem.rows import joined, taken
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, IntArray, frozen

CHUNK = 48  # positions side by side: enough for numpy, few enough for the cache
STRIDE = 4  # the coarser mesh level is solved at every fourth position


@dataclass(frozen=True, slots=True)
class Touches:
    """Contacts of one kind over n positions, d discs, c contacts each (rollers: d, j crankshafts, c).

    `force` N, `pressure` Pa; `point` and `normal` (…, 2) in the carrier's frame, the normal out of the disc.
    """

    force: Array
    pressure: Array
    point: Array
    normal: Array

    @property
    def resultant(self) -> Array:
        """Force (…, 2) of the discs on what they touch, N."""
        return np.asarray((self.force[..., None] * self.normal).sum(axis=-2))


@dataclass(frozen=True, slots=True)
class Series:
    """Contacts at input angles (n,) in rad, `crank` (n,) as seen from the carrier, `motion` (n, k) on the layout's
    names, with its tangent `stiffness` (n, k, k).

    `parts` (n, p): shares of the ring's compliance in rad/(N·m), see `breakdown`; `compliance` (n,) the whole, nan
    where nothing resists. `imbalance` (n,) and `penetration` (n,) are relative residuals.
    """

    rung: str
    angle: Array
    crank: Array
    motions: Layout
    ring: Touches
    arm: Touches
    motion: Array
    stiffness: Array
    compliance: Array
    parts: Array
    imbalance: Array
    penetration: Array

    @property
    def twist(self) -> Array:
        """Rotation (n,) of the ring beyond its ideal angle, with its torque, rad."""
        return np.asarray(self.motion[:, -1])

    @property
    def mesh_force(self) -> Array:
        """Normal force (n, j) of the teeth of each planet, N."""
        return self.motions.supports.mesh_forces(self.motions.of_cranks(self.motion))

    @property
    def bearing_force(self) -> Array:
        """Force (n, j, 2, 2) of each crankshaft on the carrier in its bearings A and B, N."""
        return self.motions.supports.bearing_forces(self.motions.of_cranks(self.motion))


def turn_angles(design: Design, positions: int) -> Array:
    """Return input angles (n + 1,) over one turn of the crankshafts as seen from the carrier, both ends included.

    After it everything but the rollers stands as before: the ring has turned by one pin. `positions` for each turn of
    the input, rounded to a whole multiple of STRIDE in all.
    """
    span = 2 * np.pi / abs(design.turning)
    count = STRIDE * max(1, round(positions * span / (2 * np.pi) / STRIDE))
    return np.linspace(0.0, span, count + 1)


def solve_series(
    design: Design, rung: str, level: Level, angle: Array, torque: float | None = None
) -> Series:
    """Solve positions at input angles (n,) in rad; `torque` (N·m) on the ring in place of the operation's.

    Raises NotConverged with the position.
    """
    motions, crank = layout(design, level.teeth, level.cranks), design.crank_angle(angle)
    parts: list[tuple[IntArray, Series]] = []
    for start in range(0, len(angle), CHUNK):
        rows = np.arange(start, min(start + CHUNK, len(angle)))
        problem = assembly(design, motions, level.elastic, crank[rows], torque)
        try:
            contact = solve_positions(problem, resolve=rung == "strips")
        except NotConverged as fault:
            raise unsolved(fault, angle[rows][fault.row or 0], motions.names) from fault
        parts.append((rows, _gathered(design, rung, angle[rows], problem, motions, contact)))
    return joined(parts)


def solve_at(design: Design, rung: str, level: Level, angle: float) -> Contact:
    """Solve one input angle in rad; arrays have no axis of positions. Raises NotConverged."""
    motions, crank = layout(design, level.teeth, level.cranks), design.crank_angle(np.array([angle]))
    try:
        found = solve_positions(assembly(design, motions, level.elastic, crank), resolve=rung == "strips")
    except NotConverged as fault:
        raise unsolved(fault, angle, motions.names) from fault
    return taken(found, 0)


def _gathered(
    design: Design, rung: str, angle: Array, problem: Assembly, motions: Layout, contact: Contact
) -> Series:
    discs, cranks = range(len(design.discs)), range(len(design.crank_places))
    touches, length = contact.touches, design.drive.arm_bearing.roller_length
    arms = [_touches([touches[f"arm{i}_{j}"] for j in cranks], length) for i in discs]
    soft = softness(contact.stiffness, len(motions.names) - 1)
    parts = compliance_parts(problem, motions, contact, soft, side_slopes(design))
    return Series(
        rung,
        frozen(angle),
        frozen(design.crank_angle(angle)),
        motions,
        _touches([touches[f"ring{i}"] for i in discs], design.drive.cycloid.face_width),
        Touches(*(frozen(np.stack([getattr(x, f.name) for x in arms], axis=1)) for f in fields(Touches))),
        frozen(contact.motion),
        frozen(contact.stiffness),
        frozen(soft[:, -1] + parts[:, -1]),
        frozen(parts),
        frozen(contact.imbalance),
        frozen(contact.penetration),
    )


def woven(every_fourth: Series, between: Series) -> Series:
    """Join a series at every STRIDE-th position with one at those between."""
    rows = np.arange(len(every_fourth.angle) + len(between.angle))
    return joined([(rows[::STRIDE], every_fourth), (rows[rows % STRIDE > 0], between)])


def _touches(families: Sequence[Touch], width: float) -> Touches:
    return Touches(
        frozen(np.stack([t.force for t in families], axis=1)),
        frozen(np.stack([t.peak for t in families], axis=1) / width),
        frozen(np.stack([t.state.point for t in families], axis=1)),
        frozen(np.stack([t.state.normal for t in families], axis=1)),
    )

"""The drive's contacts over one turn of the input."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.contact import assembly, layout, side_slopes
from trochoid.drives.khv.design import Design
from trochoid.drives.unsolved import unsolved
from trochoid.fem.moving import softness, wandering
from trochoid.fem.position import Contact, ElasticBody, Touch, solve_position, solve_positions
from trochoid.fem.rows import joined
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, IntArray, frozen

FAMILIES = ("ring", "output", "bearing")
CHUNK = 64  # positions side by side: enough for numpy, few enough for the cache and for progress to be seen


@dataclass(frozen=True, slots=True)
class Touches:
    """Contacts of one kind over n positions, d discs, c contacts each.

    `force` (n, d, c) N, `pressure` (n, d, c) Pa, `half_width` (n, d, c) m, `point` and `normal` (n, d, c, 2)
    in the ring's frame, the normal out of the disc.
    """

    force: Array
    pressure: Array
    half_width: Array
    point: Array
    normal: Array

    @property
    def touching(self) -> Array:
        """Number (n, d) of contacts that carry."""
        return np.asarray((self.force > 0).sum(axis=2))

    @property
    def resultant(self) -> Array:
        """Force (n, d, 2) of the discs on what they touch, N."""
        return np.asarray(np.einsum("ndc,ndci->ndi", self.force, self.normal))


@dataclass(frozen=True, slots=True)
class Series:
    """Contacts over the input angle (n,) in rad; the last position is a full turn after the first.

    `crank` (n,) angle relative to the ring, `motion` (n, k) and `stiffness` (n, k, k) on `names`; `wandering` (n,):
    compliance at the flange in rad/(N·m) beside the tangent's, of contacts that the load moves; `imbalance` and
    `penetration` are the largest relative residuals, `iterations` the most Newton steps.
    """

    rung: str
    angle: Array
    crank: Array
    names: tuple[str, ...]
    ring: Touches
    output: Touches
    bearing: Touches | None
    motion: Array
    stiffness: Array
    wandering: Array
    imbalance: float
    penetration: float
    iterations: int

    @property
    def twist(self) -> Array:
        """Rotation (n,) of the flange beyond its ideal angle, rad."""
        return np.asarray(self.motion[:, self.names.index("output.rotation")])

    @property
    def torsional_stiffness(self) -> Array:
        """Torque per rotation (n,) at the flange with the input held, N·m/rad; 0 where nothing resists."""
        row = self.names.index("output.rotation")
        yields = softness(self.stiffness, row)[:, row] + self.wandering
        return np.divide(1.0, yields, out=np.zeros_like(yields), where=yields > 0)


def solve_series(
    design: Design,
    rung: str,
    bodies: tuple[ElasticBody, ...],
    positions: int,
    progress: Callable[[int], None] = lambda done: None,
) -> Series:
    """Solve every position of one input turn, both ends included.

    Raises NotConverged with the position.
    """
    angle = np.linspace(0.0, 2 * np.pi, positions + 1)
    parts: list[tuple[IntArray, Contact]] = []
    wanders, sides = np.zeros(len(angle)), side_slopes(design, rung)
    row = layout(design, rung).names.index("output.rotation")
    for start in range(0, len(angle), CHUNK):
        rows = np.arange(start, min(start + CHUNK, len(angle)))
        problem = assembly(design, rung, bodies, angle[rows] * design.mesh_speed)
        try:
            contact = solve_positions(problem, resolve=rung == "strips")
        except NotConverged as fault:
            raise unsolved(fault, angle[rows][fault.row or 0], layout(design, rung).names) from fault
        parts.append((rows, contact))
        wanders[rows] = wandering(problem, contact, softness(contact.stiffness, row), sides)
        progress(int(rows[-1]) + 1)
    return _gathered(design, rung, angle, joined(parts), wanders)


def solve_at(
    design: Design, rung: str, bodies: tuple[ElasticBody, ...], angle: float, start: Contact | None = None
) -> Contact:
    """Solve one position at an input angle in rad; `start` is the solution of a neighbouring one."""
    problem = assembly(design, rung, bodies, angle * design.mesh_speed)
    try:
        return solve_position(problem, resolve=rung == "strips", start=start)
    except NotConverged as fault:
        raise unsolved(fault, angle, layout(design, rung).names) from fault


def _gathered(design: Design, rung: str, angle: Array, contact: Contact, wanders: Array) -> Series:
    count = len(design.discs)
    width = {"ring": design.drive.face_width, "output": design.drive.face_width}
    width["bearing"] = design.drive.eccentric_bearing.roller_length
    kinds = {
        kind: _touches([contact.touches[f"{kind}{i}"] for i in range(count)], width[kind])
        for kind in FAMILIES
        if f"{kind}0" in contact.touches
    }
    return Series(
        rung,
        frozen(angle),
        frozen(angle * design.mesh_speed),
        layout(design, rung).names,
        kinds["ring"],
        kinds["output"],
        kinds.get("bearing"),
        frozen(contact.motion),
        frozen(contact.stiffness),
        frozen(wanders),
        float(contact.imbalance.max()),
        float(contact.penetration.max()),
        int(contact.iterations.max()),
    )


def _touches(discs: Sequence[Touch], width: float) -> Touches:
    return Touches(
        frozen(np.stack([t.force for t in discs], axis=1)),
        frozen(np.stack([t.peak for t in discs], axis=1) / width),
        frozen(np.stack([t.half_width for t in discs], axis=1)),
        frozen(np.stack([t.state.point for t in discs], axis=1)),
        frozen(np.stack([t.state.normal for t in discs], axis=1)),
    )

"""The oracle of the drive: one position with every contact resolved by its own finite elements. Slow on purpose.

Discs, ring pins and output rollers have facets of a sixteenth of each contact's half width, gaps come from the true
curves, and all facets that may be pressed are unknowns of one contact problem. It is the top rung of the models.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.bodies import build_level, meshes
from trochoid.drives.khv.contact import layout, loads, springs
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.resolved_bodies import Fineness, Key, Pressed, Widths, class_of, press_all
from trochoid.drives.khv.resolved_seat import seat_half_width
from trochoid.drives.khv.series import Series, Touches, solve_at
from trochoid.drives.khv.spots import Spot, spots
from trochoid.fem.position import Contact
from trochoid.fem.resolved import Facets
from trochoid.fem.resolved_contact import (
    Resolved,
    ResolvedProblem,
    Unknowns,
    half_width,
    peak,
    solve_resolved,
)
from trochoid.kinematics.errors import NotConverged, SceneError
from trochoid.kinematics.types import Array, frozen

FAINT = 0.1  # of the largest half width of a kind: narrower contacts get the facets of this
COARSER = 1.1  # facets may be so much longer than wanted before the discs are meshed again
ROUNDS = 6
START_FACETS = 8
KINDS = ("ring", "output", "bearing")


@dataclass(frozen=True, slots=True)
class ResolvedPosition:
    """One position as a series of one, so that every number of a turn can be read from it; the most degrees of
    freedom of a disc, the number of pressure unknowns, and how often the bodies were meshed.
    """

    series: Series
    dofs: int
    unknowns: int
    rounds: int


def resolved_position(
    design: Design, angle: float, start: Contact | None = None, fineness: Fineness | None = None
) -> ResolvedPosition:
    """Solve the position at an input angle in rad; `start`, the engine's solution there, says where to refine.

    Raises SceneError for rigid discs, Infeasible where contacts lie too close to be refined, NotConverged.
    """
    if not design.scene.has("elastic_contact"):
        raise SceneError("rigid discs have nothing to resolve: list the effect elastic_contact")
    fine = fineness or Fineness()
    start = start or _level0(design, angle)
    motion, widths = start.motion, _widths(design, start)
    for number in range(1, ROUNDS + 1):
        places, pressed, found = _solve(design, angle * design.mesh_speed, widths, motion, fine)
        wanted = _wanted(places, pressed, found, widths)
        if wanted == widths:
            series = _series(design, angle, places, pressed, found)
            return ResolvedPosition(series, pressed.dofs, len(pressed.compliance), number)
        motion, widths = found.motion, wanted
    raise NotConverged(
        f"resolved contact at input angle {math.degrees(angle):.6g}°: the half widths still change after {ROUNDS} "
        "meshes; start from strips at this position"
    )


def _level0(design: Design, angle: float) -> Contact:
    level = build_level(design, START_FACETS, meshes(design, START_FACETS))
    return solve_at(design, "level0", level.elastic, angle)


def _solve(
    design: Design, crank: float, widths: Widths, motion: Array, fine: Fineness
) -> tuple[list[Spot], Pressed, Resolved]:
    motions = layout(design, "resolved")
    places = spots(design, motions, crank, motion)
    pressed = press_all(design, places, widths, fine)
    load = loads(design, motions, crank)
    problem = ResolvedProblem(pressed.contacts, pressed.compliance, springs(design, motions), load)
    return places, pressed, solve_resolved(problem, motion)


def _widths(design: Design, start: Contact) -> Widths:
    """Return the half widths to mesh for; 0 where nothing touches."""
    widths: dict[Key, float] = {}
    for kind in KINDS:
        families = [start.touches[f"{kind}{i}"] for i in range(len(design.discs))]
        least = FAINT * max(float(family.half_width.max(initial=0.0)) for family in families)
        for i, family in enumerate(families):
            for j, (width, force) in enumerate(zip(family.half_width, family.force, strict=True)):
                widths[kind, i, j] = class_of(max(float(width), least)) if force > 0 else 0.0
    return widths


def _wanted(places: Sequence[Spot], pressed: Pressed, found: Resolved, widths: Widths) -> Widths:
    """Return the half widths to mesh for next: new where a watch is pressed, a window narrow, or facets too long."""
    wanted = dict(widths)
    for kind in KINDS:
        mine = [n for n, spot in enumerate(places) if spot.kind == kind]
        force = {n: float(found.forces[n].sum()) for n in mine}
        half = {n: half_width(found.forces[n], pressed.facets[n].offset) for n in mine}
        first = max(mine, key=lambda n: force[n])
        largest = half[first] or 1.0  # rollers under their law all press by one half width: any will do
        for n in mine:
            key = places[n].kind, places[n].disc, places[n].number
            meshed, strips = widths[key], found.forces[n]
            if meshed == 0.0 and force[n] > 0.0:
                share = math.sqrt(force[n] / force[first])
                wanted[key] = class_of(largest * max(share, FAINT))
            elif len(strips) > 1 and max(strips[0], strips[-1]) > 0.0:
                wanted[key] = class_of(1.6 * max(half[n], meshed))
            elif 0.0 < half[n] < meshed / COARSER:
                least = class_of(FAINT * largest)
                wanted[key] = min(meshed, max(class_of(half[n]), least))
    return wanted


def _series(
    design: Design, angle: float, places: Sequence[Spot], pressed: Pressed, found: Resolved
) -> Series:
    ring, output, bearing = (_touches(design, kind, places, pressed, found) for kind in KINDS)
    return Series(
        rung="resolved",
        angle=frozen([angle]),
        crank=frozen([angle * design.mesh_speed]),
        names=layout(design, "resolved").names,
        ring=ring,
        output=output,
        bearing=bearing,
        motion=frozen([found.motion]),
        stiffness=frozen([found.stiffness]),
        wandering=frozen([0.0]),
        imbalance=found.imbalance,
        penetration=found.penetration,
        iterations=found.steps,
    )


def _touches(design: Design, kind: str, places: Sequence[Spot], pressed: Pressed, found: Resolved) -> Touches:
    """Return the contacts (1, d, c) of one kind."""
    shape = 1, len(design.discs), -1
    mine = [n for n, spot in enumerate(places) if spot.kind == kind]  # disc by disc
    all_ = [_touch(design, places[n], pressed.facets[n], pressed.contacts[n], found, n) for n in mine]
    force, pressure, half = (
        frozen(np.array([getattr(t, name) for t in all_]).reshape(shape))
        for name in ("force", "pressure", "half_width")
    )
    point, normal = (
        frozen(np.array([getattr(t, name) for t in all_]).reshape(*shape, 2)) for name in ("point", "normal")
    )
    return Touches(force, pressure, half, point, normal)


@dataclass(frozen=True, slots=True)
class _Touch:
    """One contact: its force is the resultant of its pressures, the normal their common direction."""

    force: float
    pressure: float
    half_width: float
    point: Array
    normal: Array


def _touch(
    design: Design, spot: Spot, facets: Facets, contact: Unknowns, found: Resolved, number: int
) -> _Touch:
    strips = found.forces[number]
    push, point = contact.facing.resultant(found.motion, strips)
    force = float(np.linalg.norm(push))
    if force == 0.0:
        normal, _ = contact.facing.resultant(found.motion, np.ones_like(strips))
        return _Touch(0.0, 0.0, 0.0, point, normal / np.linalg.norm(normal))
    wide = design.drive.eccentric_bearing.roller_length if spot.kind == "bearing" else design.drive.face_width
    single = len(strips) == 1
    half = seat_half_width(design, force) if single else half_width(strips, facets.offset)
    top = 2 * force / (math.pi * half) if single else peak(strips, facets.length)
    return _Touch(force, top / wide, half, point, push / force)

"""Refined discs, pins and rollers: the pressure unknowns of one position of the drive, and their compliance."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.drives.khv.contact import plane
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.resolved_seat import bump, has_law, roller_law, seat_half_width, spreading
from trochoid.drives.khv.spots import Spot
from trochoid.fem.resolved import (
    Facets,
    all_loads,
    direct_compliance,
    mirrored,
    refined_body,
    round_partner,
)
from trochoid.fem.resolved_contact import Unknowns
from trochoid.geometry.outline import Loop, Outline
from trochoid.geometry.refined import Window
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.types import Array

REACH = 1.5  # half widths that a window covers on each side, at least
CLASS = (
    1.1  # contacts whose half widths differ less have equal facets, and so one mesh of their round partners
)

Key = tuple[str, int, int]
Widths = Mapping[Key, float]


@dataclass(frozen=True, slots=True)
class Fineness:
    """Facets on a half width, at least, and facets per lobe away from the contacts."""

    on_half_width: int = 16
    per_lobe: int = 24


@dataclass(frozen=True, slots=True)
class Pressed:
    """Facets of every place, their `compliance` (M, M) in m/N, and the most degrees of freedom of a disc."""

    facets: tuple[Facets, ...]
    contacts: tuple[Unknowns, ...]
    compliance: Array
    dofs: int


def class_of(width: float) -> float:
    """Return the next lower half width in steps of CLASS, in m."""
    return float(CLASS ** math.floor(math.log(width) / math.log(CLASS) + 1e-9)) if width > 0 else 0.0


def press_all(design: Design, places: Sequence[Spot], widths: Widths, fine: Fineness) -> Pressed:
    """Mesh all bodies for half widths in m by kind, disc and number, and press them.

    Where the half width is 0 nothing is expected to touch, and one facet keeps watch. Raises TrochoidError.
    """
    facets: dict[int, Facets] = {}
    blocks, dofs = [], 0
    for disc in range(len(design.discs)):
        mine = [n for n, spot in enumerate(places) if spot.disc == disc]
        made, compliance, size = _disc(design, disc, [places[n] for n in mine], widths, fine)
        facets.update(zip(mine, made, strict=True))
        blocks.append((mine, compliance))
        dofs = max(dofs, size)
    ends = np.cumsum([0, *(len(facets[n].length) for n in range(len(places)))])
    total = np.zeros((ends[-1], ends[-1]))
    for mine, compliance in blocks:
        index = np.concatenate([np.arange(ends[n], ends[n + 1]) for n in mine])
        total[np.ix_(index, index)] = compliance
    partners: dict[tuple[float, float, int], Array] = {}
    for n, spot in enumerate(places):
        part = slice(ends[n], ends[n + 1])
        total[part, part] += _own(design, spot, facets[n], partners)
    every = tuple(facets[n] for n in range(len(places)))
    contacts = tuple(_unknowns(design, s, f) for s, f in zip(places, every, strict=True))
    return Pressed(every, contacts, total, dofs)


def _disc(
    design: Design, disc: int, places: Sequence[Spot], widths: Widths, fine: Fineness
) -> tuple[list[Facets], Array, int]:
    """Return the unknowns of one disc, their compliance in m/N, and its degrees of freedom."""
    outline = design.outline(design.discs[disc].body, fine.per_lobe)
    shortest = _shortest(outline)
    windows: dict[str, list[Window]] = {}
    for spot in places:
        width = widths[spot.kind, spot.disc, spot.number]
        windows.setdefault(spot.loop, []).append(_window(design, spot, width, fine, shortest[spot.loop]))
    made = refined_body(outline, windows, plane(design))
    left = {name: list(facets) for name, facets in made.facets.items()}
    facets = [left[spot.loop].pop(0) for spot in places]
    facets = [
        bump(f) if has_law(design, s) and len(f.length) > 1 else f
        for s, f in zip(places, facets, strict=True)
    ]
    return facets, direct_compliance(made.body, all_loads(facets)) / design.drive.face_width, made.body.size


def _shortest(outline: Outline) -> dict[str, float]:
    """Return the length of each loop's shortest facet, m."""

    def of(loop: Loop) -> float:
        return float(np.diff(ArcLength(loop.curve).length(loop.parameters())).min())

    return {loop.name: of(loop) for loop in outline.loops}


def _window(design: Design, spot: Spot, width: float, fine: Fineness, ordinary: float) -> Window:
    if width == 0.0:
        return Window(spot.parameter, 0.5 * ordinary, 1)
    if has_law(design, spot):
        return Window(spot.parameter, seat_half_width(design) / fine.on_half_width, 2 * fine.on_half_width)
    side = math.ceil(REACH * CLASS * fine.on_half_width)
    return Window(spot.parameter, width / fine.on_half_width, 2 * side + 1)


def _unknowns(design: Design, spot: Spot, facets: Facets) -> Unknowns:
    """Return the facets before their circle; the gap of a single one is that of its middle, where it is least."""
    law = roller_law(design) if has_law(design, spot) else None
    if len(facets.length) > 1:
        return Unknowns(spot.facing(facets.parameters, facets.weights), law)
    return Unknowns(spot.facing(facets.middle[:, None], np.ones((1, 1))), law)


def _own(
    design: Design, spot: Spot, facets: Facets, partners: dict[tuple[float, float, int], Array]
) -> Array:
    """Return the compliance (m, m) in m/N of what is not the disc: a round partner, or a load that spreads."""
    count = len(facets.length)
    if spot.kind == "bearing":
        return spreading(design, spot, facets)
    if not design.scene.has("pin_compliance"):
        return np.zeros((count, count))
    key = (spot.radius, float(f"{facets.length.mean():.9g}"), count)
    if key not in partners:
        partners[key] = round_partner(plane(design), *key)
    partner = partners[key]
    return (mirrored(partner) if spot.convex else partner) / design.drive.face_width

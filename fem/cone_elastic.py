"""What yields at the contacts of a rim: compliances at their places, and the laws of their slices."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.fem.cone_assembly import ConeAssembly
from trochoid.fem.cone_law import Side, SliceLaw
from trochoid.fem.cone_pair import ConeState
from trochoid.fem.cone_table import Weights
from trochoid.kinematics.types import Array, IntArray

NEAR = 1e-3  # of a station's width: contacts that moved less keep their compliance


@dataclass(frozen=True, eq=False, slots=True)
class Elastic:
    """Compliances at the contacts' `place` (n, C): `own` (n, C, s, s), `spread` (n, C, C) between totals, the laws.

    Per position: numbers of contacts that are or were `pressed`, and the compliance `cross` (P, s, P, s) between these.
    """

    place: Array
    own: Array
    spread: Array
    weights: Weights
    law: SliceLaw
    pressed: list[IntArray]
    cross: list[Array]


def elastic_at(assembly: ConeAssembly, state: ConeState) -> Elastic:
    """Return the compliances where contacts stand, as yet without what slices of different contacts do."""
    rim = assembly.rim
    place = rim.weights(state.place)
    own = rim.on_itself(place)
    if assembly.roller.own is not None:
        own = own + assembly.roller.own
    if assembly.roller.seat > 0.0:
        own = own + assembly.roller.seat
    count = len(state.place)
    none = [np.zeros(0, dtype=np.intp)] * count
    return Elastic(
        state.place,
        own,
        rim.spread(place),
        place,
        law_at(assembly, state, rim.blunt(place)),
        none,
        [np.zeros((0, 0, 0, 0))] * count,
    )


def law_at(assembly: ConeAssembly, state: ConeState, blunt: Array) -> SliceLaw:
    """Return what slices yield on their own; `blunt` (n, C) is the half width in rad of the elements' loads."""
    rim, roller, rho = assembly.rim, assembly.roller, assembly.rim.slices.middle
    sides = [Side(rim.kernel, rim.poissons_ratio, rim.ends, blunt[..., None] * rho)]
    if roller.kernel > 0.0 and roller.own is None:
        radius = rho * np.tan(assembly.pair.tooth.pin_angle - assembly.pair.clearance)
        sides.append(Side(roller.kernel, roller.poissons_ratio, (0.0, 0.0), None, np.log(2.0 * radius) - 1.0))
    elif roller.own is not None:
        sides.append(Side(roller.kernel, roller.poissons_ratio, roller.ends, roller.blunt))
    return SliceLaw(rim.slices, tuple(sides), rho / state.bend[..., None])


def updated(assembly: ConeAssembly, elastic: Elastic, state: ConeState, force: Array) -> Elastic:
    """Take compliances afresh where contacts moved, and between slices for those that are pressed."""
    moved = np.abs(state.place - elastic.place).max(axis=1) > NEAR * float(assembly.rim.half_width.min())
    if moved.any():
        elastic = elastic_at(assembly, state)
    pressed, cross = list(elastic.pressed), list(elastic.cross)
    for i, total in enumerate(force.sum(axis=-1)):
        touching = np.flatnonzero(total > 0.0)
        if not np.isin(touching, pressed[i]).all():
            touching = np.union1d(touching, pressed[i])
            w = elastic.weights
            at = Weights(w.tooth[i, touching], w.station[i, touching], w.value[i, touching])
            pressed[i], cross[i] = touching, assembly.rim.between(at)
    law = law_at(assembly, state, assembly.rim.blunt(elastic.weights))
    return replace(elastic, pressed=pressed, cross=cross, law=law)


def beside(elastic: Elastic, force: Array) -> Array:
    """Return what slices of other contacts press a slice by (n, C, s) beyond what their totals do."""
    found = np.zeros_like(force)
    for i, (chosen, cross) in enumerate(zip(elastic.pressed, elastic.cross, strict=True)):
        if len(chosen):
            f = force[i, chosen]
            exact = np.einsum("asbt,bt->as", cross, f, optimize=True)
            found[i, chosen] = exact - (elastic.spread[i][np.ix_(chosen, chosen)] @ f.sum(axis=-1))[:, None]
    return found


def whole(elastic: Elastic, i: int) -> Array:
    """Return the compliance (Cs, Cs) between all slices of one position, without the laws."""
    count, slices = elastic.own.shape[1:3]
    matrix = np.repeat(np.repeat(elastic.spread[i], slices, axis=0), slices, axis=1)
    matrix = matrix.reshape(count, slices, count, slices)
    chosen = elastic.pressed[i]
    if len(chosen):
        matrix[np.ix_(chosen, np.arange(slices), chosen, np.arange(slices))] = elastic.cross[i]
    number = np.arange(count)
    matrix[number, :, number] = elastic.own[i]
    return matrix.reshape(count * slices, count * slices)


def yielded(assembly: ConeAssembly, state: ConeState, force: Array) -> Array:
    """Return the approach (n, C, s) in m of pressed slices under forces, other contacts by their totals alone."""
    place = assembly.rim.weights(state.place)
    law = law_at(assembly, state, assembly.rim.blunt(place))
    own = np.einsum("ncst,nct->ncs", assembly.rim.on_itself(place), force)
    beside = np.matmul(assembly.rim.spread(place), force.sum(axis=-1)[..., None])
    return np.where(force > 0.0, own + beside + law.approach(np.maximum(force, 1e-300))[0], 0.0)

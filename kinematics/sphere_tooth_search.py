"""The sphere tooth nearest to a wanted one that can be made: over nutation, polar angle and pin angle."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.sphere_tooth_checks import largest_nutation, overlap_angle, sphere_tooth_faults
from trochoid.kinematics.sphere_tooth_clearance import clear_pin_angle
from trochoid.kinematics.types import Array

_LEAST = math.radians(1e-3)  # no nutation below this is proposed
_DIGITS = 1e-3  # ° to which proposals are rounded
_STEP = 0.45  # of the logarithm, of the first grid
_SHARES = (0.5, 0.25, 0.12, 0.06, 0.03, 0.015, 0.007)  # of it, of the smaller grids


def pin_limit(tooth: SphereTooth) -> float:
    """Largest pin angle (rad) that neither cuts the flank nor meets the next pin; 0 where the path loops."""
    if not 0.0 < tooth.nutation < largest_nutation(tooth):
        return 0.0
    return min(clear_pin_angle(tooth), overlap_angle(tooth))


def pin_limit_map(tooth: SphereTooth, nutation: Array, polar_angle: Array) -> Array:
    """`pin_limit` (m, n), rad, over polar angles (m,) and nutation angles (n,), rad; teeth and side of `tooth`.

    The margin to undercut is this less the pin angle.
    """
    return np.array(
        [
            [pin_limit(replace(tooth, nutation=float(x), polar_angle=float(a))) for x in nutation]
            for a in polar_angle
        ]
    )


def nearest_feasible(tooth: SphereTooth, margin: float = 0.02) -> SphereTooth:
    """Return the tooth with the same numbers of teeth that can be made with the least change of its three angles.

    What is least is the root of the sum of squares of the logarithms of nutation, polar angle and pin angle over
    the wanted ones; the pin stays `margin` (a share) below its limit, the nutation below its own.  A grid finds
    the valley, smaller ones follow it; angles are rounded to 0.001° where that leaves the tooth feasible.
    Returns `tooth` itself when it can be made.  Raises NotConverged when nothing is found.
    """
    if not sphere_tooth_faults(tooth):
        return tooth
    wanted = replace(
        tooth,
        polar_angle=min(max(tooth.polar_angle, 0.05), 0.5 * math.pi),
        pin_angle=max(tooth.pin_angle, 1e-5),
        nutation=max(tooth.nutation, _LEAST),
    )
    x, a = _grid(wanted)
    best = (math.inf, wanted)
    for half in (None, *_SHARES):
        if half is not None:  # about the best so far, in steps of a share of the first grid's
            near = best[1]
            spread = half * np.linspace(-1.0, 1.0, 5)
            x = near.nutation * np.exp(spread * _STEP)
            a = near.polar_angle * np.exp(spread * _STEP)
        best = _least(wanted, x, a, margin, best)
    if math.isinf(best[0]):
        raise NotConverged(
            f"no flank of {tooth.lobes} lobes for {tooth.pins} pins found near these angles; start from a smaller "
            f"nutation and a smaller pin angle"
        )
    return _rounded(best[1], margin)


def _grid(wanted: SphereTooth) -> tuple[Array, Array]:
    """Nutation and polar angles of the first grid; the wanted ones are on it."""
    down = math.ceil(math.log(max(wanted.nutation / _LEAST, 2.0)) / _STEP)
    nutation = wanted.nutation * np.exp(-_STEP * np.arange(min(down, 14)))
    fine = np.arange(-6, 7) * 0.5 * _STEP
    polar = wanted.polar_angle * np.exp(fine)
    return nutation, np.unique(np.minimum(polar, 0.5 * math.pi))


def _least(
    wanted: SphereTooth,
    nutation: Array,
    polar: Array,
    margin: float,
    best: tuple[float, SphereTooth],
) -> tuple[float, SphereTooth]:
    """Least change over a grid, and the tooth there; `best`, the least so far, where none is below it.

    The local limit of undercut is cheap and never below the global one: places are taken in the order of the
    change that it allows, until that is no longer less than one found.
    """
    for least, trial in _candidates(wanted, nutation, polar, margin, best[0]):
        if least >= best[0]:
            break
        limit = _limit(trial, margin)
        if limit <= 0.0:
            continue
        pin = min(wanted.pin_angle, limit)
        change = _change(wanted, trial, pin)
        if change < best[0]:
            best = change, replace(trial, pin_angle=pin)
    return best


def _candidates(
    wanted: SphereTooth, nutation: Array, polar: Array, margin: float, bound: float
) -> list[tuple[float, SphereTooth]]:
    """Places of a grid, those first that may need the least change, and none that needs `bound` or more."""
    found = []
    for a in polar[polar <= 0.5 * math.pi]:
        for x in nutation:
            trial = replace(wanted, nutation=float(x), polar_angle=float(a))
            if _change(wanted, trial, wanted.pin_angle) >= bound:
                continue
            if trial.nutation <= (1.0 - margin) * largest_nutation(trial):
                most = (1.0 - margin) * min(trial.undercut_angle, overlap_angle(trial))
                found.append((_change(wanted, trial, min(wanted.pin_angle, most)), trial))
    return sorted(found, key=lambda each: each[0])


def _change(wanted: SphereTooth, trial: SphereTooth, pin_angle: float) -> float:
    return math.hypot(
        math.log(trial.nutation / wanted.nutation),
        math.log(trial.polar_angle / wanted.polar_angle),
        math.log(wanted.pin_angle / pin_angle),
    )


def _limit(tooth: SphereTooth, margin: float) -> float:
    if tooth.nutation > (1.0 - margin) * largest_nutation(tooth):
        return 0.0
    return (1.0 - margin) * pin_limit(tooth)


def _rounded(tooth: SphereTooth, margin: float) -> SphereTooth:
    """Angles as one would write them, where the tooth stays feasible."""
    step = math.radians(_DIGITS)
    polar, down = round(tooth.polar_angle / step) * step, math.floor(tooth.nutation / step) * step
    written = replace(tooth, polar_angle=polar, nutation=max(down, step))
    pin = min(tooth.pin_angle, _limit(written, 0.5 * margin))
    written = replace(written, pin_angle=math.floor(pin / step * (1.0 + 1e-12)) * step)
    return tooth if sphere_tooth_faults(written) else written

"""The automatic choice: the cheapest contact model, then the coarsest mesh, that meet the scene's tolerance.

Level 0 takes every contact for one between half-planes under Hertz's pressure. How wrong that is does not depend on
the mesh (the differences on 8 and on 32 facets per lobe agree to a hundredth), so a few positions on the coarsest
level tell, where strips are affordable. The mesh follows from the error that two levels suggest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, TypeVar

from trochoid.kinematics.errors import NotConverged, TrochoidError
from trochoid.scene import Scene

MODEL_SHARE = 0.25  # of the tolerance that the model may take; the rest is the mesh's
POSITIONS = 7  # at which level 0 is compared with strips; odd, so that few of them are alike
COARSEST = 8  # facets per lobe: with 6 the order of convergence is not yet seen, and the estimate misleads
FINEST = 64

S = TypeVar("S")
M = TypeVar("M")


class TooCoarse(NotConverged):
    """Contacts were solved, but no mesh level meets the tolerance."""


@dataclass(frozen=True, slots=True)
class Chosen:
    """The rung, the mesh levels that were solved on it (the last two count), the estimated error of the number
    `of`, the largest, for the mesh, and that of the model.
    """

    rung: str
    levels: tuple[int, ...]
    error: float
    of: str
    model_error: float


def choose(
    tolerance: float,
    levels: Sequence[int],
    solve: Callable[[str, int], S],
    worst_error: Callable[[S, S], tuple[float, str]],
    model_error: Callable[[], float],
    rung: str | None = None,
    unit: str = "facets per lobe",
) -> Chosen:
    """Return the first of the `levels`, coarse to fine, whose estimated error meets the tolerance.

    `solve(rung, level)` gives the contacts over a turn, `worst_error(fine, coarse)` the largest relative error and
    whose it is, `model_error()` that of level 0, which is not asked for when the scene names a `rung`; `unit` is what a
    level counts. Raises TooCoarse when no level is fine enough.
    """
    off = 0.0
    if rung is None:
        off = model_error()
        rung, off = ("level0", off) if off <= MODEL_SHARE * tolerance else ("strips", 0.0)
    coarse = solve(rung, levels[0])
    error, name = float("inf"), ""
    for count, level in enumerate(levels[1:], start=2):
        fine = solve(rung, level)
        error, name = worst_error(fine, coarse)
        if error <= tolerance:
            return Chosen(rung, tuple(levels[:count]), error, name, off)
        coarse = fine
    raise TooCoarse(
        f"the error of {name} is estimated at {error:.1e} with {levels[-1]} {unit}, more than "
        f"accuracy.tolerance = {tolerance:g}; raise the tolerance to {rounded_up(error):.1e}, or name "
        "accuracy.facets_per_lobe and accept the error"
    )


def rounded_up(value: float) -> float:
    """Return a number above 0 rounded up to two digits: a tolerance so large is met."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.ceil(value / digit) * digit


def or_level0(best: Callable[[str | None], Chosen], named: str | None) -> tuple[Chosen, str]:
    """Return what `best(named)` chooses and ""; where strips find no solution, what level 0 does, and why.

    Strips do not cover every relief of a flank; level 0 does, with an error that is then not known. Raises what
    `best` raises when a rung is `named`, or no level is fine enough.
    """
    try:
        return best(named), ""
    except TooCoarse:
        raise
    except NotConverged as fault:
        if named is not None:
            raise
        return best("level0"), str(fault)


def doubtful(doubt: str) -> Iterator[str]:
    """Yield what a reader must know where `or_level0` took level 0, and why it did."""
    if doubt:
        yield (
            "the pressure of some contacts could not be resolved, and level0 was taken, whose error is not known here: "
            + doubt
        )


def unheeded(scene: Scene[Any]) -> Iterator[str]:
    """Yield that nothing is chosen where a scene has a tolerance and closed forms alone."""
    if not scene.has("elastic_contact") and scene.accuracy != type(scene.accuracy)():
        yield 'the table [accuracy] does nothing without the effect "elastic_contact": all answers are closed forms'


def coarsest(first: int, meshes: Callable[[int], M]) -> tuple[int, M | None]:
    """Return the coarsest level from `first` on that thin walls allow, with its meshes; the finest without any."""
    facets = first
    while 2 * facets < FINEST:
        with suppress(TrochoidError):
            return facets, meshes(facets)
        facets *= 2
    return facets, None


def first_given(given: int) -> int:
    """Return the level that tells the error of the facets per lobe that a scene names."""
    return max(3, given // 2)


def climbed(first: int, given: int | None) -> tuple[int, ...]:
    """Return the levels of a ladder, three at least: those of a run from `first` on, or those about a `given` one."""
    found = [first]
    while 2 * found[-1] <= FINEST or len(found) < 3:
        found.append(given if given is not None and len(found) == 1 else 2 * found[-1])
    return tuple(found)


def doubled(first: int) -> tuple[int, ...]:
    """Return the mesh levels that a run may try."""
    levels = [first]
    while 2 * levels[-1] <= FINEST:
        levels.append(2 * levels[-1])
    return tuple(levels)

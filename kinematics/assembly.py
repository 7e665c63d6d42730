"""Whether equal planets go together and turn: assembly, neighbours, coaxiality of 2K-H and 2K-V trains.

Each condition is a `Check` with its margin; one that fails says what binds and what near it would do.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import Pair, mesh_at, needed_shift


@dataclass(frozen=True, slots=True)
class Check:
    """One condition: how far it is from its limit in `unit`, and why it fails; `fault` is empty if it holds."""

    name: str
    margin: float
    unit: str
    fault: str = ""

    @property
    def holds(self) -> bool:
        """Whether there is nothing against it."""
        return not self.fault


def require(*checks: Check) -> None:
    """Raise Infeasible with the sentence of every check that fails."""
    faults = [check.fault for check in checks if check.fault]
    if faults:
        raise Infeasible("\n".join(faults))


def planets_assemble(
    sun: int, ring: int, planets: int, most: int | None = None, advise: bool = True
) -> Check:
    """N equally spaced planets of a 2K-H set: N | z_sun + z_ring; `planet_places` are uneven ones that fit.

    The carrier turned by 1/N brings the next planet to the first one's place; the sun has then turned
    (z_sun + z_ring)/(N z_sun) times, which must be whole teeth.  Margin: −misfit, in sun pitches.  No more than
    `most` planets, as many as have room, are advised; nothing is without `advise`.
    """
    return _divides(
        "assembly of the planets",
        planets,
        ("sun", sun),
        ("ring", ring),
        "equally spaced planets",
        most,
        advise,
    )


def cranks_assemble(
    sun: int, planet: int, cranks: int, most: int | None = None, advise: bool = True
) -> Check:
    """N equal crankshafts of a 2K-V drive with their eccentrics parallel: N | z_sun + z_planet.

    Equal means planets that stand alike to their eccentrics; else each needs its own place on its spline.
    Margin: −misfit, in pitches.  `most` and `advise` as in `planets_assemble`.
    """
    return _divides(
        "assembly of the cranks",
        cranks,
        ("sun", sun),
        ("planet", planet),
        "equal crankshafts",
        most,
        advise,
    )


def planet_places(sun: int, ring: int, planets: int) -> tuple[Fraction, ...]:
    """Places (turns of the carrier) nearest to equal spacing that can be filled: whole 1/(z_sun + z_ring)."""
    steps = sun + ring
    return tuple(Fraction(round(Fraction(k * steps, planets)), steps) for k in range(planets))


def most_beside(circle_radius: float, radius: float, clearance: float = 0.0) -> int:
    """How many equal bodies of `radius` have room side by side on a circle; lengths in m."""
    share = (radius + 0.5 * clearance) / circle_radius
    return max(1, math.ceil(math.pi / math.asin(share)) - 1) if 0.0 < share < 1.0 else 1


def neighbors_clear(
    what: str,
    count: int,
    circle_radius: float,
    radius: float,
    clearance: float = 0.0,
    advise: bool = True,
) -> Check:
    """Equal bodies of `radius` (tips of planets, eccentric bearings) side by side on a circle; lengths in m.

    2 ρ sin(π/N) > 2 r + clearance.  Margin in m.  Nothing is advised without `advise`.
    """
    name = f"neighbouring {what}"
    _fail_if_none(what, count)
    margin = (
        math.inf if count == 1 else 2.0 * (circle_radius * math.sin(math.pi / count) - radius) - clearance
    )
    if margin > 0.0:
        return Check(name, margin, "m")
    said = (
        f"{count} {what} of radius {_mm(radius)} on a circle of radius {_mm(circle_radius)} collide: they overlap by "
        f"{_mm(-margin)}"
    )
    if not advise:
        return Check(name, margin, "m", said)
    most = most_beside(circle_radius, radius, clearance)
    limit = circle_radius * math.sin(math.pi / count) - 0.5 * clearance
    smaller = f", or a radius below {_mm(limit)}" if limit > 0.0 else ""
    wider = (radius + 0.5 * clearance) / math.sin(math.pi / count)
    return Check(
        name,
        margin,
        "m",
        f"{said}; take at most {most}{smaller}, or a circle radius above {_mm(wider)}",
    )


def coaxial(mesh: Pair, center_distance: float, tolerance: float = 1e-6, advise: bool = True) -> Check:
    """Gears that mesh without play at the carrier's centre distance (m), within `tolerance` (m).

    Of a 2K-H set: the ring's mesh at the sun's distance; of a 2K-V: sun and planet at the cranks' radius.
    Margin: tolerance − |Δa|, m.  `advise`: say what this mesh by itself would need, whatever other meshes ask for.
    """
    name, found = "coaxiality", float(mesh.center_distance)
    margin = tolerance - abs(found - center_distance)
    if margin >= 0.0:
        return Check(name, margin, "m")
    one, two = mesh.first, mesh.second
    said = (
        f"{one.teeth} and {two.teeth} teeth stand {_mm(found)} apart without play, and the carrier holds them at "
        f"{_mm(center_distance)}: not coaxial"
    )
    if not advise:
        return Check(name, margin, "m", said)
    try:
        need = float(needed_shift(mesh_at(one, two, center_distance)) - mesh.side * one.shift)
        advice = f"the nearest shift of the {'ring' if two.internal else 'planet'} is {need:.6g}, or take"
    except Infeasible:
        advice = "no shift brings them there; take"
    return Check(name, margin, "m", f"{said}; {advice} a centre distance of {_mm(found)}")


def _divides(
    name: str,
    count: int,
    one: tuple[str, int],
    two: tuple[str, int],
    what: str,
    most: int | None = None,
    advise: bool = True,
) -> Check:
    _fail_if_none(what, count)
    total = one[1] + two[1]
    rest = total % count
    if rest == 0:
        return Check(name, 0.0, "pitch")
    margin = -min(rest, count - rest) / count
    said = (
        f"{count} {what} cannot be assembled: {one[0]} + {two[0]} = {total} teeth is no multiple of {count}"
    )
    if not advise:
        return Check(name, margin, "pitch", said)
    near = _nearest(count, lambda n: total % n == 0 and (most is None or n <= most))
    noun = what.split()[-1].removesuffix("s" if near == "1" else "")
    teeth = two[1] + (-rest if 2 * rest <= count else count - rest)
    teeth += count if teeth < 1 else 0
    return Check(name, margin, "pitch", f"{said}; take {near} {noun}, or a {two[0]} of {teeth} teeth")


def _nearest(value: int, fits: Callable[[int], bool]) -> str:
    """Nearest numbers below and above that fit; 1 always does, and above it may be none."""
    below = next(n for n in range(value - 1, 0, -1) if fits(n))
    above = next((n for n in range(value + 1, 3 * value + 1) if fits(n)), None)
    return str(below) if above is None else f"{below} or {above}"


def _fail_if_none(what: str, count: int) -> None:
    if count < 1:
        raise Infeasible(f"{count} {what.split()[-1]}: at least 1 is needed")


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"

"""Refuse a planetary set that cannot be made or put together: what binds, and the nearest that would do."""

from __future__ import annotations

import math

from trochoid.geometry.blocking_line import nearest_feasible
from trochoid.geometry.planetary import Planetary, PlanetarySet, planetary
from trochoid.geometry.planetary_quality import Condition, Limits, quality
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import needed_shift

COAXIAL_TOLERANCE = 1e-3  # in modules; sources print shifts with three digits


def check_planetary(given: PlanetarySet, limits: Limits | None = None) -> None:
    """Raise Infeasible with every reason why the set cannot be built; see `planetary_faults`."""
    faults = planetary_faults(given, limits)
    if faults:
        raise Infeasible("\n".join(faults))


def planetary_faults(given: PlanetarySet, limits: Limits | None = None) -> tuple[str, ...]:
    """Reasons why a set cannot be built, one sentence each; empty when it can."""
    faults = _fail_if_teeth_impossible(given)
    if faults:
        return faults
    try:
        set_ = planetary(given)
    except Infeasible as error:
        return (_out_of_reach(given, error),)
    return (
        *_fail_if_not_coaxial(given, set_),
        *_fail_if_not_assembled(given, set_),
        *_fail_if_planets_collide(given, set_),
        *_fail_if_quality_fails(given, set_, limits),
    )


def _fail_if_teeth_impossible(given: PlanetarySet) -> tuple[str, ...]:
    z1, z2, z3 = given.teeth
    faults = [
        f"{name} with {z} teeth: at least 3 are needed"
        for name, z in (("sun", z1), ("planet", z2), ("ring", z3))
        if z < 3
    ]
    if z3 <= z2:
        faults.append(
            f"ring of {z3} teeth around a planet of {z2}: it needs more than the planet, for equal modules "
            f"near z1 + 2 z2 = {z1 + 2 * z2}"
        )
    if given.planets < 1:
        faults.append(f"{given.planets} planets: at least one is needed")
    if given.cutter.teeth >= z3:
        faults.append(
            f"cutter of {given.cutter.teeth} teeth for a ring of {z3}: take one of at most {z3 - 1} teeth"
        )
    return tuple(faults)


def _out_of_reach(given: PlanetarySet, error: Infeasible) -> str:
    """What the geometry says, with the least centre distance of both meshes."""
    z1, z2, z3 = given.teeth
    least = 0.5 * given.module * max(z1 + z2, z3 - z2) * math.cos(given.pressure_angle)
    if given.center_distance > least:
        return str(error)
    ring = "" if z3 == z1 + 2 * z2 else f", or a ring of z1 + 2 z2 = {z1 + 2 * z2} teeth"
    return f"{error}; take a centre distance from {_mm(least)}{ring}"


def _fail_if_not_coaxial(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    """Condition (1) of sources §4: both meshes must ask for the same centre distance."""
    z1, z2, z3 = given.teeth
    x1, x2, _ = given.shifts
    faults = []
    for name, pair, who in (
        ("x1 + x2", set_.outer, "sun and planet"),
        ("x3 − x2", set_.inner, "planet and ring"),
    ):
        have, need = float(pair.shift), float(needed_shift(pair))
        if abs(have - need) <= COAXIAL_TOLERANCE:
            continue
        advice = f"x2 = {need - x1:.6g}" if pair is set_.outer else f"x3 = {need + x2:.6g}"
        faults.append(
            f"not coaxial: {who} have {name} = {have:.6g}, and a centre distance of {_mm(given.center_distance)} "
            f"needs {need:.6g}; take {advice}"
        )
    if faults and z3 != z1 + 2 * z2:
        faults[-1] += f", or a ring of z1 + 2 z2 = {z1 + 2 * z2} teeth"
    return tuple(faults)


def _fail_if_not_assembled(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    z1, _, z3 = given.teeth
    n, total = given.planets, z1 + z3
    if total % n == 0:
        return ()
    fitting = [k for k in range(1, _most_planets(given, set_) + 1) if total % k == 0]
    near = sorted(sorted(fitting, key=lambda k: abs(k - n))[:2])
    rest = total % n
    ring = z3 - rest if 2 * rest <= n else z3 + n - rest
    return (
        f"{n} equally spaced planets cannot be assembled: z1 + z3 = {total} is not a multiple of {n}; take "
        f"{' or '.join(map(str, near))} instead, or a ring of {ring} teeth",
    )


def _fail_if_planets_collide(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    n, tip = given.planets, float(set_.tips[1])
    apart = given.center_distance * math.sin(math.pi / n)  # half the distance of neighbours
    if n == 1 or tip < apart:
        return ()
    return (
        f"{n} planets collide: their tip radius {_mm(tip)} must be less than a_w sin(π/{n}) = {_mm(apart)}; take at "
        f"most {_most_planets(given, set_)}, or a planet with smaller tips",
    )


def _most_planets(given: PlanetarySet, set_: Planetary) -> int:
    """Planets that fit side by side."""
    share = float(set_.tips[1]) / given.center_distance
    return max(1, math.ceil(math.pi / math.asin(share)) - 1) if share < 1.0 else 1


def _fail_if_quality_fails(given: PlanetarySet, set_: Planetary, limits: Limits | None) -> tuple[str, ...]:
    failed = quality(set_, limits).failed
    if not failed:
        return ()
    near = nearest_feasible(given, limits)
    if near is None:
        advice = (
            "no shifts on the coaxiality line fulfil all conditions; change teeth, centre distance or limits"
        )
    else:
        advice = "the nearest feasible shifts are " + ", ".join(
            f"x{k} = {x:.6g}" for k, x in enumerate(near, 1)
        )
    return tuple(f"{_sentence(c)}; {_alone(c)}{advice}" for c in failed)


def _sentence(condition: Condition) -> str:
    value, limit = (_quantity(v, condition.unit) for v in (condition.value, condition.limit))
    return f"{condition.name}: {value}, and it must be {condition.relation} {limit}"


def _alone(condition: Condition) -> str:
    """What this condition by itself would need, where that is one number of the input."""
    if not condition.name.startswith("undercut"):
        return ""
    return f"its own limit is a shift of {float(condition.limit):.6g}; "


def _quantity(value: float, unit: str) -> str:
    if unit == "m":
        return _mm(float(value))
    return f"{math.degrees(value):.6g}°" if unit == "rad" else f"{float(value):.6g}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"

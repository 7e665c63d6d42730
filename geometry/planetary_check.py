"""Refuse a planetary set that cannot be made or put together: what binds, and the nearest that would do."""

from __future__ import annotations

import math

from trochoid.geometry.blocking_line import nearest_feasible
from trochoid.geometry.planetary import Planetary, PlanetarySet, planetary
from trochoid.geometry.planetary_quality import Condition, Limits, quality
from trochoid.kinematics.assembly import coaxial, most_beside, neighbors_clear, planets_assemble
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import mesh

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
        return (out_of_reach(given, error),)
    return (
        *_fail_if_not_coaxial(given, set_),
        *_fail_if_planets_do_not_fit(given, set_),
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


def out_of_reach(given: PlanetarySet, error: Infeasible) -> str:
    """Say what the geometry says, with the least centre distance of both meshes."""
    z1, z2, z3 = given.teeth
    least = 0.5 * given.module * max(z1 + z2, z3 - z2) * math.cos(given.pressure_angle)
    if given.center_distance > least:
        return str(error)
    ring = "" if z3 == z1 + 2 * z2 else f", or a ring of z1 + 2 z2 = {z1 + 2 * z2} teeth"
    return f"{error}; take a centre distance from {_mm(least)}{ring}"


def _fail_if_not_coaxial(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    """Condition (1) of sources §4: both meshes must ask for the same centre distance."""
    z1, z2, z3 = given.teeth
    faults = []
    for pair in (set_.outer, set_.inner):
        try:
            free = mesh(pair.first, pair.second)
        except Infeasible as error:
            faults.append(str(error))
            continue
        faults.append(coaxial(free, given.center_distance, COAXIAL_TOLERANCE * given.module).fault)
    found = tuple(fault for fault in faults if fault)
    if found and z3 != z1 + 2 * z2:
        return (*found[:-1], f"{found[-1]}, or a ring of z1 + 2 z2 = {z1 + 2 * z2} teeth")
    return found


def _fail_if_planets_do_not_fit(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    (z1, _, z3), n = given.teeth, given.planets
    circle, tip = given.center_distance, float(set_.tips[1])
    found = (
        planets_assemble(z1, z3, n, most_beside(circle, tip)),
        neighbors_clear("planets", n, circle, tip),
    )
    return tuple(check.fault for check in found if check.fault)


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

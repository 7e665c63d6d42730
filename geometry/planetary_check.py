"""Refuse a planetary set that cannot be made or put together: what binds, and the nearest that would do."""

from __future__ import annotations

import math

from trochoid.geometry.planetary import Planetary, PlanetarySet, planetary
from trochoid.geometry.planetary_advice import Reasons, advice
from trochoid.geometry.planetary_quality import Condition, Limits, quality
from trochoid.kinematics.assembly import coaxial, neighbors_clear, planets_assemble
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute_pair import mesh

COAXIAL_TOLERANCE = 1e-3  # in modules; sources print shifts with three digits


def check_planetary(given: PlanetarySet, limits: Limits | None = None) -> None:
    """Raise Infeasible with every reason why the set cannot be built; see `planetary_faults`."""
    faults = planetary_faults(given, limits)
    if faults:
        raise Infeasible("\n".join(faults))


def planetary_faults(
    given: PlanetarySet, limits: Limits | None = None, also: Reasons | None = None
) -> tuple[str, ...]:
    """Reasons why a set cannot be built, one sentence each, and what near it can; empty when it can.

    `also` gives reasons against a set from what is around its teeth: what is advised must satisfy it too.
    """
    found = planetary_reasons(given, limits)
    if not found:
        return ()
    if min(given.teeth) < 3 or given.teeth[2] <= given.teeth[1] or given.planets < 1:
        return found
    chosen = limits or Limits()
    return (*found, *advice(given, chosen, lambda near: planetary_reasons(near, chosen), also))


def planetary_reasons(given: PlanetarySet, limits: Limits | None = None) -> tuple[str, ...]:
    """What speaks against a set: what was given and the limit, without advice."""
    faults = _fail_if_teeth_impossible(given)
    if faults:
        return faults
    try:
        set_ = planetary(given)
    except Infeasible as error:
        return (str(error),)
    return (
        *_fail_if_planets_do_not_fit(given, set_),
        *_fail_if_not_coaxial(given, set_),
        *(_sentence(condition) for condition in quality(set_, limits).failed),
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
            f"cutter of {given.cutter.teeth} teeth for a ring of {z3}: it needs less teeth than the ring"
        )
    return tuple(faults)


def _fail_if_not_coaxial(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    """Condition (1) of sources §4: both meshes must ask for the same centre distance."""
    faults = []
    for pair in (set_.outer, set_.inner):
        try:
            free = mesh(pair.first, pair.second)
        except Infeasible as error:
            faults.append(str(error))
            continue
        tolerance = COAXIAL_TOLERANCE * given.module
        faults.append(coaxial(free, given.center_distance, tolerance, advise=False).fault)
    return tuple(fault for fault in faults if fault)


def _fail_if_planets_do_not_fit(given: PlanetarySet, set_: Planetary) -> tuple[str, ...]:
    (z1, _, z3), n = given.teeth, given.planets
    circle, tip = given.center_distance, float(set_.tips[1])
    found = (
        planets_assemble(z1, z3, n, advise=False),
        neighbors_clear("planets", n, circle, tip, advise=False),
    )
    return tuple(check.fault for check in found if check.fault)


def _sentence(condition: Condition) -> str:
    value, limit = (_quantity(v, condition.unit) for v in (condition.value, condition.limit))
    return f"{condition.name}: {value}, and it must be {condition.relation} {limit}"


def _quantity(value: float, unit: str) -> str:
    if unit == "m":
        return _mm(float(value))
    return f"{math.degrees(value):.6g}°" if unit == "rad" else f"{float(value):.6g}"


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"

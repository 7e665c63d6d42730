"""Vibration zones A…D, only by a standard in whose scope the machine is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.errors import TrochoidError

Limits = tuple[float, float, float]

# rms velocity in mm/s at the boundaries A/B, B/C, C/D
_GROUPS: dict[tuple[int, bool], Limits] = {
    (1, True): (2.3, 4.5, 7.1),
    (1, False): (3.5, 7.1, 11.0),
    (2, True): (1.4, 2.8, 4.5),
    (2, False): (2.3, 4.5, 7.1),
}
_RATINGS: dict[float, Limits] = {
    3.15: (2.0, 3.15, 5.0),
    5.0: (3.15, 5.0, 8.0),
    8.0: (5.0, 8.0, 12.5),
    12.5: (8.0, 12.5, 20.0),
    20.0: (12.5, 20.0, 31.5),
}
_GENERAL: Limits = (0.71, 1.8, 4.5)


@dataclass(frozen=True, slots=True)
class Machine:
    """What decides which standard applies: rated `power` W, shaft speeds rad/s, kind and support.

    `rating` is the vibration rating VR of ISO 20816-9 (epicyclic gear units: 8 or 12.5).
    """

    power: float
    input_speed: float
    output_speed: float
    gear_unit: bool = True
    rigid_support: bool = False
    rating: float = 8.0


@dataclass(frozen=True, slots=True)
class Zone:
    """`letter` A…D by `standard` with `limits` (A/B, B/C, C/D), m/s rms, or all None; `reason` says why.

    `guidance` are limits that a reader may compare with when no standard applies.
    """

    letter: str | None
    standard: str | None
    limits: Limits | None
    guidance: Limits | None
    reason: str


def zone(velocity: float, machine: Machine) -> Zone:
    """Return the zone of an rms velocity (m/s, worst direction), or the statement that no standard applies.

    Scopes: ISO 20816-9:2020 gear units of 10 kW to 100 MW, shafts at 30 to 12 000 r/min; ISO 20816-3:2022
    other machines above 15 kW at 120 to 30 000 r/min (group 2 up to 300 kW, group 1 above).  Raises for a
    negative or non-finite velocity and for a rating that ISO 20816-9 does not have.
    """
    if not (np.isfinite(velocity) and velocity >= 0.0):
        raise TrochoidError(f"an rms velocity must be finite and at least 0, given {velocity} m/s")
    return _gear_unit(velocity, machine) if machine.gear_unit else _other(velocity, machine)


def _gear_unit(velocity: float, machine: Machine) -> Zone:
    if machine.rating not in _RATINGS:
        raise TrochoidError(f"ISO 20816-9 has the ratings {sorted(_RATINGS)}, given {machine.rating}")
    name = "ISO 20816-9:2020"
    outside = _outside(
        machine.power, (10e3, 100e6), _rpm(machine.input_speed, machine.output_speed), (30.0, 12000.0)
    )
    if outside:
        return _none(
            f"{name} covers gear units of 10 kW to 100 MW at 30 to 12000 r/min; {outside}", machine.power
        )
    return _judge(
        velocity, name, _RATINGS[machine.rating], f"gear unit, vibration rating VR {machine.rating:g}"
    )


def _other(velocity: float, machine: Machine) -> Zone:
    name = "ISO 20816-3:2022"
    speeds = _rpm(machine.input_speed)
    outside = _outside(machine.power, (15e3, np.inf), speeds, (120.0, 30000.0))
    if outside or machine.power == 15e3:
        detail = outside or "this one has just 15 kW"
        return _none(f"{name} covers machines above 15 kW at 120 to 30000 r/min; {detail}", machine.power)
    group = 1 if machine.power > 300e3 else 2
    support = "rigid" if machine.rigid_support else "flexible"
    slow = "; below 600 r/min it measures from 2 Hz, here from 10 Hz" if min(speeds) < 600.0 else ""
    return _judge(
        velocity, name, _GROUPS[group, machine.rigid_support], f"group {group}, {support} support{slow}"
    )


def _rpm(*speeds: float) -> list[float]:
    return [abs(speed) * 30.0 / np.pi for speed in speeds]


def _outside(
    power: float, powers: tuple[float, float], speeds: list[float], limits: tuple[float, float]
) -> str:
    """Say what is out of scope; a speed on the limit, up to rounding, is inside."""
    said = []
    if not powers[0] <= power <= powers[1]:
        said.append(f"this one has {power / 1e3:.4g} kW")
    bad = [s for s in speeds if not limits[0] * (1 - 1e-9) <= s <= limits[1] * (1 + 1e-9)]
    said += [f"a shaft of this one turns at {speed:.4g} r/min" for speed in bad]
    return " and ".join(said)


def _judge(velocity: float, standard: str, limits: Limits, kind: str) -> Zone:
    metres = _metres(limits)
    letter = "ABCD"[sum(velocity > limit for limit in metres)]
    return Zone(letter, standard, metres, None, f"{standard}, {kind}")


def _none(why: str, power: float) -> Zone:
    if power > 15e3:
        return Zone(None, None, None, None, f"no standard applies: {why}")
    low = "/".join(f"{limit:g}" for limit in _GENERAL)
    return Zone(
        None,
        None,
        None,
        _metres(_GENERAL),
        f"no standard applies: {why}; the range of zone boundaries in ISO 20816-1 begins at {low} mm/s for "
        f"small machines, which is guidance, not a verdict",
    )


def _metres(limits: Limits) -> Limits:
    return limits[0] * 1e-3, limits[1] * 1e-3, limits[2] * 1e-3

"""Answers from equilibrium of rigid members, and masses."""

from __future__ import annotations

import math

from trochoid.drives.exact import RPM
from trochoid.drives.planetary.rigid import Mesh
from trochoid.drives.planetary.stages import Stages
from trochoid.results.outcome import Parts, Quantity


def reactions(s: Stages) -> Quantity:
    """Torques that act on the members from outside, power, forces in the meshes of one planet: of rigid members, and of
    elastic ones with mass.
    """
    answer = _rigid(s)
    if not s.moves:
        return answer
    from trochoid.drives.planetary.answers_dynamics import elastic_reactions

    return elastic_reactions(s, answer)


def _rigid(s: Stages) -> Quantity:
    found = s.rigid
    parts: dict[str, Quantity | Parts] = {
        name: Quantity(
            parts={
                "torque": _exact(torque, "N*m"),
                "speed": _exact(found.speeds[name] / RPM, "rpm"),
                "power": _exact(1e-3 * torque * found.speeds[name], "kW"),
            }
        )
        for name, torque in found.torques.items()
    }
    parts |= {"sun_and_planet": _mesh(found.outer), "planet_and_ring": _mesh(found.inner)}
    note = "rigid members, all planets alike; torques act from outside, positive as the input turns"
    return Quantity(parts=parts, note=note)


def _mesh(mesh: Mesh) -> Quantity:
    return Quantity(
        parts={
            "normal_force": _exact(mesh.normal, "N"),
            "tangential_force": _exact(mesh.tangential, "N"),
            "radial_force": _exact(mesh.radial, "N"),
            "pressure_angle": _exact(math.degrees(mesh.angle), "deg"),
        }
    )


def bearing_loads(s: Stages) -> Quantity:
    """Force on the bearing of each planet, and the speed of the planet on it; of elastic members over a pitch."""
    if s.scene.has("elastic_contact"):
        from trochoid.drives.planetary.answers_contact import elastic_bearing_loads

        return elastic_bearing_loads(s)
    found, on = s.rigid, float(s.speeds.relative("planet", "carrier")) * s.scene.operation.input_speed
    parts = {
        "planet_bearing": _exact(found.bearing, "N"),
        "tangential": _exact(found.tangential, "N"),
        "radial": _exact(found.radial, "N"),
        "speed": _exact(on / RPM, "rpm"),
    }
    if s.scene.has("inertia"):
        parts["centrifugal"] = _exact(found.centrifugal, "N")
    note = "planets alike and evenly spaced: nothing is left for the bearings of sun, ring and carrier"
    return Quantity(parts=parts, note=note)


def mass(s: Stages) -> Quantity:
    """Masses of the wheels and their moments of inertia about their own axes."""
    found, planets = s.masses, s.scene.drive.planets
    wheels = {"sun": (found.sun, 1), "planet": (found.planet, planets), "ring": (found.ring, 1)}
    parts: dict[str, Quantity | Parts] = {
        name: Quantity(
            parts={
                "mass": _exact(solid.mass, "kg"),
                "inertia": _exact(solid.axial_inertia, "kg*m^2"),
                "count": Quantity(float(count), model="given"),
            }
        )
        for name, (solid, count) in wheels.items()
    }
    total = sum(count * solid.mass for solid, count in wheels.values())
    parts["total"] = Quantity(parts={"mass": _exact(total, "kg")})
    return Quantity(parts=parts, note="teeth and rims over the face width, without shafts and carrier")


def _exact(value: float, unit: str) -> Quantity:
    return Quantity(value, unit, 0.0, "exact")

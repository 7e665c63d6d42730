"""The quantities of a K-H-V drive: each takes the stages it needs and nothing else."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from trochoid.drives.khv.stages import Solved, Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Quantity

ARCMIN = np.pi / 180 / 60
RPM = 2 * np.pi / 60


def ratio(s: Stages) -> Quantity:
    """Input speed over output speed, with sign."""
    return Quantity(float(s.design.speeds.ratio), "", 0.0, "exact")


def member_speeds(s: Stages) -> Quantity:
    """Absolute speeds of all members."""
    speed = s.scene.operation.input_speed / RPM
    members = {name: float(value) * speed for name, value in s.design.speeds.members.items()}
    return Quantity(parts={name: Quantity(value, "rpm", 0.0, "exact") for name, value in members.items()})


def profile(s: Stages) -> Quantity:
    """Numbers of the tooth profile."""
    flank = s.feasible.flank
    t = np.linspace(0, np.pi / flank.lobes, 2001)
    bend = flank.curvature(t)
    values = {
        "trochoid_ratio": (flank.trochoid_ratio, ""),
        "pitch_radius_disc": (1e3 * flank.eccentricity * flank.lobes, "mm"),
        "pitch_radius_pins": (1e3 * flank.eccentricity * flank.pins, "mm"),
        "crest_radius": (1e3 * (flank.pin_circle_radius + flank.eccentricity - flank.pin_radius), "mm"),
        "root_radius": (1e3 * (flank.pin_circle_radius - flank.eccentricity - flank.pin_radius), "mm"),
        "pin_radius_undercut_limit": (1e3 * flank.undercut_radius, "mm"),
        "least_convex_radius": (1e3 / float(bend.max()), "mm"),
        "least_concave_radius": (-1e3 / float(bend.min()), "mm"),
    }
    return _exact(values)


def geometry_quality(s: Stages) -> Quantity:
    """Margins of the geometry: what is left before the drive cannot be made."""
    from trochoid.geometry.check import walls

    d, flank = s.feasible.drive, s.design.flank
    wall = walls(
        flank, d.bore_radius, d.output_pins.count, d.output_pins.circle_radius, s.design.hole_radius, s.design.hole_angles[0]
    )
    between = flank.pin_circle_radius * np.sin(np.pi / flank.pins) - flank.pin_radius
    return _exact(
        {
            "undercut_margin": (1e3 * (flank.undercut_radius - flank.pin_radius), "mm"),
            "gap_between_pins": (2e3 * float(between), "mm"),
            "wall_hole_flank": (1e3 * wall.hole_to_flank, "mm"),
            "wall_hole_bore": (1e3 * wall.hole_to_bore, "mm"),
            "wall_hole_hole": (1e3 * wall.hole_to_hole, "mm"),
            "distinct_discs": (float(len(s.design.hole_angles)), ""),
        }
    )


def contact_ratio(s: Stages) -> Quantity:
    """Pins in mesh by geometry, under load when contacts are solved, and the pressure angles."""
    from trochoid.kinematics.meshing import contact_ratio as geometric

    found = geometric(s.feasible.flank)
    parts = {
        "geometric": Quantity(found.mean, "", 0.0, "exact"),
        "pressure_angle_min": Quantity(float(np.degrees(found.pressure_angle_min)), "deg", 0.0, "exact"),
        "pressure_angle_mean": Quantity(float(np.degrees(found.pressure_angle_mean)), "deg", 0.0, "exact"),
    }
    if "contact" in _asked(s):
        loaded = (s.contact.fine.ring.force > 0).sum(axis=2)
        parts["loaded_mean"] = Quantity(float(loaded.mean()), "", None, s.rung)
        parts["loaded_min"] = Quantity(float(loaded.min()), "", None, s.rung)
        parts["loaded_max"] = Quantity(float(loaded.max()), "", None, s.rung)
    return Quantity(parts=parts)


def load_sharing(s: Stages) -> Quantity:
    """How the torque is shared by the discs, and the load of one disc by its pins."""
    solved = s.contact

    def disc_share(x: Solved, fine: bool) -> float:
        series = x.fine if fine or x.coarse is None else x.coarse
        torque = np.abs(_disc_torque(s, series.ring.force, series.crank))
        total = torque.sum(axis=1, keepdims=True)
        share = np.divide(torque, total, out=np.zeros_like(torque), where=total > 0)
        return float(share.max())

    force = solved.fine.ring.force
    whole = force.sum(axis=2)
    largest = np.divide(force.max(axis=2), whole, out=np.zeros_like(whole), where=whole > 0)
    return Quantity(
        parts={
            "disc_torque_share_max": _both(s, disc_share(solved, True), disc_share(solved, False), ""),
            "pin_force_share_max": Quantity(float(largest.max()), "", None, s.rung, note="largest pin force over the sum of a disc's"),
            "loaded_pins_mean": Quantity(float((force > 0).sum(axis=2).mean()), "", None, s.rung),
            "loaded_output_pins_mean": Quantity(float((solved.fine.output.force > 0).sum(axis=2).mean()), "", None, s.rung),
        }
    )


def _disc_torque(s: Stages, force: Array, crank: Array) -> Array:
    """Torque (n, d) of the ring pins on each disc about its centre, N·m, from forces (n, d, p)."""
    flank = s.design.flank
    angle = crank[:, None, None] + np.array([d.crank for d in s.design.discs])[None, :, None]
    t = flank.contact_parameter(np.arange(flank.pins)[None, None, :], angle)
    return np.asarray((force * flank.lever(t)).sum(axis=2))


def contact_force_max(s: Stages) -> Quantity:
    """Largest force of each kind of contact."""
    return _largest(s, lambda touches: touches.force, 1.0, "N")


def contact_pressure_max(s: Stages) -> Quantity:
    """Largest contact pressure of each kind of contact."""
    return _largest(s, lambda touches: touches.pressure, 1e-6, "MPa")


def _largest(s: Stages, get: Callable[[object], Array], scale: float, unit: str) -> Quantity:
    solved = s.contact
    parts = {}
    for kind, name in (("ring", "ring_pins"), ("output", "output_pins"), ("bearing", "bearing_rollers")):
        fine = getattr(solved.fine, kind)
        if fine is not None:
            coarse = get(getattr(solved.coarse, kind)).max() * scale if solved.coarse is not None else None
            parts[name] = _both(s, float(get(fine).max() * scale), coarse, unit)
    return Quantity(parts=parts)


def stress_max(s: Stages) -> Quantity:
    """Largest von Mises stress of the discs at the stress position, in the field or below a contact."""
    largest = max(s.field, key=lambda state: state.field.largest)
    surface = max(float(state.field.von_mises.max()) for state in s.field)
    angle = float(np.degrees(largest.angle))
    return Quantity(
        parts={
            "below_contact": Quantity(1e-6 * largest.field.largest, "MPa", None, s.rung, note=f"at input angle {angle:g}°"),
            "in_the_field": Quantity(1e-6 * surface, "MPa", None, s.rung, note="largest at a node of the mesh"),
        },
        note="Hertz's stress in closed form below the contacts, added to the finite-element field",
    )


def transmission_error(s: Stages) -> Quantity:
    """Loaded transmission error of the output over a turn, and its mean, the wind-up."""
    solved = s.contact
    arcsec = ARCMIN / 60

    def swing(twist: Array) -> float:
        return float(np.ptp(twist[:-1])) / arcsec

    def mean(twist: Array) -> float:
        return float(twist[:-1].mean()) / ARCMIN

    coarse = solved.coarse.twist if solved.coarse is not None else None
    return Quantity(
        parts={
            "peak_to_peak": _both(s, swing(solved.fine.twist), None if coarse is None else swing(coarse), "arcsec"),
            "wind_up": _both(s, mean(solved.fine.twist), None if coarse is None else mean(coarse), "arcmin"),
        }
    )


def torsional_stiffness(s: Stages) -> Quantity:
    """Torque per angle at the output with the input held, mean over a turn: the tangent at the load."""
    solved = s.contact
    scale = ARCMIN * (s.scene.operation.output_torque / s.design.flange_torque if s.design.flange_torque else 1.0)
    fine = float(solved.fine.torsional_stiffness[:-1].mean()) * scale
    coarse = None if solved.coarse is None else float(solved.coarse.torsional_stiffness[:-1].mean()) * scale
    answer = _both(s, fine, coarse, "N*m/arcmin")
    note = "nothing touches: the drive does not resist" if fine == 0.0 else "tangent at the operating torque, mean over a turn"
    return Quantity(answer.value, answer.unit, answer.error, answer.model, note=note)


def bearing_loads(s: Stages) -> Quantity:
    """Load of each eccentric bearing and of its most loaded roller, and of the bearings of shaft and flange."""
    solved = s.contact
    parts: dict[str, Quantity] = {}
    for i in range(len(s.design.discs)):
        fine = _eccentric_load(s, solved, i, True)
        coarse = _eccentric_load(s, solved, i, False)
        parts[f"eccentric_{i + 1}_mean"] = _both(s, float(fine.mean()), float(coarse.mean()), "N")
        parts[f"eccentric_{i + 1}_max"] = _both(s, float(fine.max()), float(coarse.max()), "N")
    if solved.fine.bearing is not None:
        coarse_max = float(solved.coarse.bearing.force.max()) if solved.coarse and solved.coarse.bearing else None
        parts["roller_max"] = _both(s, float(solved.fine.bearing.force.max()), coarse_max, "N")
    return Quantity(parts=parts)


def _eccentric_load(s: Stages, solved: Solved, i: int, fine: bool) -> Array:
    """Force (n,) of disc i on its eccentric: what ring, output pins and inertia leave."""
    from trochoid.drives.khv.contact import centrifugal

    series = solved.fine if fine or solved.coarse is None else solved.coarse
    inertia = centrifugal(s.design, series.crank)[:, i]
    return np.asarray(np.linalg.norm(inertia - series.ring.resultant[:, i] - series.output.resultant[:, i], axis=-1))


def bearing_stiffness(s: Stages) -> Quantity:
    """Stiffness of the first eccentric bearing under its load, on a rigid and on the elastic seat."""
    from trochoid.drives.khv.seat import seat_stiffness

    found = seat_stiffness(s)
    parts: dict[str, Mapping[str, Quantity]] = {}
    for name, matrix, coarse in found:
        scale = {"xx": 1e-6, "yy": 1e-6, "xy": 1e-6}
        entries = {"xx": (0, 0), "yy": (1, 1), "xy": (0, 1)}
        parts[name] = {
            f"k_{e}": _both(s, matrix[ij] * scale[e], None if coarse is None else coarse[ij] * scale[e], "N/um")
            for e, ij in entries.items()
        }
        if matrix.shape == (4, 4):
            parts[name] = {
                **parts[name],
                "k_tilt_xx": Quantity(float(matrix[2, 2]), "N*m/rad", None, s.rung),
                "k_tilt_yy": Quantity(float(matrix[3, 3]), "N*m/rad", None, s.rung),
            }
    return Quantity(parts=parts, note="first disc, first position; rollers by ISO/TS 16281")


def reactions(s: Stages) -> Quantity:
    """Reactions of the bearings of shaft and flange over a turn, by model."""
    found = s.reactions
    parts: dict[str, dict[str, Quantity]] = {}
    for model, values in (("rigid", found.rigid), ("elastic", found.elastic)):
        if values is None:
            continue
        for member in ("shaft", "output"):
            size = np.linalg.norm(values[member], axis=-1)
            for b, place in enumerate("AB"):
                entry = {
                    "mean": Quantity(float(size[:, b].mean()), "N", None, model),
                    "min": Quantity(float(size[:, b].min()), "N", None, model),
                    "max": Quantity(float(size[:, b].max()), "N", None, model),
                }
                parts[f"{member}_{place}_{model}"] = entry
    return Quantity(parts=parts, note=found.reason)


def balance(s: Stages) -> Quantity:
    """What the eccentric discs leave unbalanced: force and couple on the casing."""
    from trochoid.drives.khv.contact import centrifugal

    made, masses = s.feasible, s.masses
    force = made.flank.eccentricity * made.crank_speed**2 * masses.disc.mass
    angles = np.array([d.crank for d in made.discs])
    vectors = force * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    z = np.array([d.z for d in made.discs])
    assert centrifugal is not None
    return Quantity(
        parts={
            "inertia_force_of_a_disc": Quantity(force, "N", None, "exact"),
            "unbalanced_force": Quantity(float(np.linalg.norm(vectors.sum(axis=0))), "N", None, "exact"),
            "unbalanced_couple": Quantity(float(np.linalg.norm((vectors * z[:, None]).sum(axis=0))), "N*m", None, "exact"),
        }
    )


def vibration_velocity(s: Stages) -> Quantity:
    """Velocity of the casing, rms 10–1000 Hz, worst direction at each point; the rigid load's beside it."""
    found = s.vibration
    parts: dict[str, Mapping[str, Quantity]] = {}
    for i, point in enumerate(found.elastic.points):
        parts[point.name] = {
            **{axis: Quantity(1e3 * float(found.elastic.rms[i, j]), "mm/s", None, _model(s)) for j, axis in enumerate("xyz")},
            "worst": Quantity(1e3 * float(found.elastic.rms[i].max()), "mm/s", None, _model(s)),
            "worst_rigid": Quantity(1e3 * float(found.rigid.rms[i].max()), "mm/s", None, "rigid"),
        }
    return Quantity(parts=parts, note=f"lines up to {found.elastic.resolved_to:.0f} Hz are resolved")


def vibration_zone(s: Stages) -> Quantity:
    """Zone by the standard that applies, or the statement that none does."""
    zone = s.vibration.zone
    return Quantity(zone.letter or "none applies", "", None, zone.standard, note=zone.reason)


def mass(s: Stages) -> Quantity:
    """Masses of all members, and the specific mass in kg per N·m of output torque."""
    from trochoid.drives.khv.mass import total_mass

    parts = total_mass(s.feasible, s.masses)
    casing = s.scene.casing.mass if s.scene.casing is not None else 0.0
    whole = sum(parts.values()) + casing
    torque = s.scene.operation.output_torque
    entries = {name: Quantity(value, "kg", None, "exact") for name, value in parts.items()}
    entries["casing"] = Quantity(casing, "kg", None, "given")
    entries["total"] = Quantity(whole, "kg", None, "exact")
    note = "specific mass needs a torque above zero"
    if torque > 0:
        note = "the textbook's range of the specific mass is 0.02 … 0.05 kg/(N·m)"
        entries["specific"] = Quantity(whole / torque, "kg/(N*m)", None, "exact")
    return Quantity(parts=entries, note=note)


def _model(s: Stages) -> str:
    return "rigid" if s.reactions.response is None else "elastic"


def _exact(values: Mapping[str, tuple[float, str]]) -> Quantity:
    return Quantity(parts={name: Quantity(value, unit, 0.0, "exact") for name, (value, unit) in values.items()})


def _both(s: Stages, fine: float, coarse: float | None, unit: str) -> Quantity:
    """Return a number with the error that its two mesh levels suggest."""
    from trochoid.drives.khv.estimate import scalar_error

    known = coarse is not None and s.contact.coarse is not None
    return Quantity(fine, unit, scalar_error(fine, coarse) if known and coarse is not None else None, s.rung)


def _asked(s: Stages) -> tuple[str, ...]:
    """Return the stages that the scene's other quantities need anyway."""
    from trochoid.drives.khv.plan import STAGES_OF

    return tuple(stage for name in s.scene.ask.quantities if name != "contact_ratio" for stage in STAGES_OF[name])


QUANTITIES: dict[str, Callable[[Stages], Quantity]] = {
    f.__name__: f
    for f in (
        ratio,
        member_speeds,
        profile,
        geometry_quality,
        contact_ratio,
        load_sharing,
        contact_force_max,
        contact_pressure_max,
        stress_max,
        transmission_error,
        torsional_stiffness,
        bearing_loads,
        bearing_stiffness,
        reactions,
        balance,
        vibration_velocity,
        vibration_zone,
        mass,
    )
}

"""Series over the input angle, spectra and the flank as one labelled dataset, in SI."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from trochoid.drives.entries import ANGLE, Entries, Entry, entry, named
from trochoid.drives.precessional.stages import Stages
from trochoid.drives.precessional.turn import FORCES, HARMONICS
from trochoid.drives.vibration_answers import comparison
from trochoid.dynamics.spectrum import harmonics
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    import xarray

FREQUENCY = "frequency"
FORCE, MOMENT, TORQUE = "Reactions", "Support moment", "Motor torque"
LINES = "Harmonics of the reactions"
COUPLE, VELOCITY = "Load on the casing", "Vibration velocity"
PER_LOBE = 40  # points of the profile
CAPTIONS = {
    FORCE: "Size of the forces in the bearing A of the satellite, the support B and the joint O: rigid by Newton and "
    "Euler, printed by the paper's equations, elastic on joints that yield. Under static balance the rigid forces in B "
    "and O are alike.",
    MOMENT: "Size of the moment M_B in the support B.",
    TORQUE: "Torque M_3 that the motor must give to keep the input speed even; rigid and printed are the same.",
    LINES: "Amplitudes of the sizes above, at multiples of twice the tooth ratio times the input speed.",
    COUPLE: "Amplitudes in the fixed frame of what all members together put on the casing, about O.",
    VELOCITY: "Amplitude of the casing's velocity by the vector sum of all reactions on it.",
}


def dataset(stages: Stages, ran: Collection[str], profile: bool) -> xarray.Dataset | None:
    """Return what the stages "reactions" and "vibration" hold where they `ran`, and the `profile`; None without any."""
    tooth = stages.design.tooth
    entries: Entries = {}
    if "contact" in ran and stages.contact is not None:
        from trochoid.drives.precessional.dataset_contact import contact_entries

        entries |= contact_entries(stages.design, stages.contact.fine)
    if "reactions" in ran:
        entries |= _reactions(stages) | _couples(stages)
    if "vibration" in ran:
        entries |= _vibration(stages)
    if profile and tooth is not None:
        entries |= _flank(tooth)
    if not entries:
        return None
    import xarray

    used = {dim for dims, *_ in entries.values() for dim in dims}
    places = _places(stages, used)
    if "contact" in ran and stages.contact is not None:
        from trochoid.drives.precessional.dataset_contact import contact_places

        places |= contact_places(stages.design, stages.contact.fine)
    return xarray.Dataset(entries, {name: place for name, place in places.items() if name in used})


def _entry(
    dims: tuple[str, ...], values: npt.ArrayLike, units: str, name: str, figure: str = "", **more: str
) -> Entry:
    """Return values in SI with what plots and scripts must know of them, the figure's caption with them."""
    caption = {"caption": CAPTIONS[figure]} if figure else {}
    return entry(dims, values, units, name, figure, **(caption | more))


def _places(stages: Stages, used: Collection[str]) -> Entries:
    """Return the coordinates of those dimensions that are used."""
    speed = stages.design.speed / (2.0 * np.pi)
    q = float(stages.design.nutation.tooth_ratio)
    places = {
        ANGLE: _entry((ANGLE,), _angles(stages), "rad", "input angle"),
        "reaction": named("reaction", FORCES, "bearing A of the satellite, support B, joint O"),
        "direction": named("direction", ("x", "y", "z"), "direction"),
        "reaction_frequency": _entry(
            ("reaction_frequency",), 2.0 * q * speed * np.arange(1, HARMONICS + 1), "Hz", "frequency"
        ),
    }
    if FREQUENCY in used:
        turns = stages.design.nutation.closing_turns
        crank = stages.reactions["rigid"].crank if "reactions" in stages.clock.seconds else None
        lines = (crank.size - 1) // 2 if crank is not None else stages.vibration.rigid.frequencies.size
        places[FREQUENCY] = _entry((FREQUENCY,), speed / turns * np.arange(1, lines + 1), "Hz", "frequency")
    if "point" in used:
        names = tuple(point.name for point in stages.vibration.rigid.points)
        places["point"] = named("point", names, "point on the casing")
    return places


def _angles(stages: Stages) -> Array:
    """Return the asked positions of one turn of the input."""
    count = stages.scene.ask.positions
    angles: Array = 2.0 * np.pi * np.arange(count) / count
    return angles


def _reactions(stages: Stages) -> Entries:
    from trochoid.drives.precessional.turn import models

    drive, speed, angle = stages.mechanism, stages.design.speed, _angles(stages)
    found = {name: at(angle) for name, at in models(drive, speed, stages.elastic).items()}
    made: Entries = {}
    for name, each in found.items():
        size = np.stack([each.magnitude(key) for key in FORCES], axis=1)
        made[f"reaction_{name}"] = _entry((ANGLE, "reaction"), size, "N", f"reaction, {name}", FORCE)
    for name, each in found.items():
        made[f"support_moment_{name}"] = _entry(
            (ANGLE,), each.magnitude("M_B"), "N*m", f"support moment M_B, {name}", MOMENT
        )
    for name, each in found.items():
        made[f"motor_torque_{name}"] = _entry(
            (ANGLE,), each.torque, "N*m", f"motor torque M_3, {name}", TORQUE
        )
    for name, turn in stages.reactions.items():
        size = np.stack([turn.lines[key] for key in FORCES], axis=1)
        dims = ("reaction_frequency", "reaction")
        made[f"reaction_lines_{name}"] = _entry(dims, size, "N", f"amplitude, {name}", LINES, scale="log")
    for name, each in found.items():
        parts = np.stack((each.joint_a, each.support, each.joint_o), axis=1)
        said = f"components of the {name} reactions in the frame of the input shaft, on the satellite, the shaft, it"
        made[f"reaction_{name}_components"] = _entry((ANGLE, "reaction", "direction"), parts, "N", said)
        said = f"components of the {name} support moment in the frame of the input shaft"
        made[f"support_moment_{name}_components"] = _entry(
            (ANGLE, "direction"), each.support_moment, "N*m", said
        )
        made[f"tooth_force_{name}"] = _entry(
            (ANGLE, "direction"), each.mesh, "N", f"tooth force on the satellite, {name}"
        )
    return made


def _couples(stages: Stages) -> Entries:
    """Return the lines of force and moment on the casing in the fixed frame."""
    made: Entries = {}
    dims = (FREQUENCY, "direction")
    for name, turn in stages.reactions.items():
        lines = np.abs(harmonics(turn.load.moment)[1:])
        made[f"casing_moment_{name}"] = _entry(dims, lines, "N*m", f"moment, {name}", COUPLE, scale="log")
    for name, turn in stages.reactions.items():
        lines = np.abs(harmonics(turn.load.force)[1:])
        made[f"casing_force_{name}"] = _entry(dims, lines, "N", f"force on the casing, {name}, amplitude")
    return made


def _vibration(stages: Stages) -> Entries:
    from trochoid.drives.precessional.vibration import models

    found, best = stages.vibration, "rigid" if stages.yielding is None else "elastic"
    dims = (FREQUENCY, "point", "direction")
    low, high = found.elastic.band
    made: Entries = {}
    for name, each in models(found, best).items():
        lines = np.moveaxis(each.velocity, -1, 0)
        figure = {"figure": VELOCITY} if name == best else {}
        made[f"vibration_velocity_{name}"] = _entry(
            dims, lines, "m/s", f"velocity, {name}", **figure, scale="log"
        )
        made[f"vibration_rms_{name}"] = _entry(
            dims[1:], each.rms, "m/s", f"rms velocity, {name}, {low:g} to {high:g} Hz"
        )
    return made | comparison(found)


def _flank(tooth: SphereTooth) -> Entries:
    """Return the flank on the unit sphere, in the frame of its body."""
    p = np.linspace(0.0, tooth.period, PER_LOBE * tooth.lobes + 1)
    dims = ("profile_point",)
    return {
        "profile_parameter": _entry(dims, p, "rad", "parameter of the flank, 2π/lobes for a lobe"),
        "profile": _entry(
            (*dims, "direction"), tooth.point(p), "", "flank on the unit sphere, in the frame of its body"
        ),
        "profile_curvature": _entry(
            dims, tooth.curvature(p), "1/rad", "geodesic curvature of the flank, positive where convex"
        ),
    }

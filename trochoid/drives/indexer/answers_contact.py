"""Answers from pin and slot as elastic bodies, the spherical Geneva wheel's beside each."""

from __future__ import annotations

import math

import numpy as np

from trochoid.drives.indexer.design import INDEXER
from trochoid.drives.indexer.pin import Pair, lash
from trochoid.drives.indexer.shaken import lock_of
from trochoid.drives.indexer.stages import Stages
from trochoid.drives.indexer.wall import ELASTIC
from trochoid.fem.pin_slot import Pressed
from trochoid.kinematics.readable import readable
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

UNLOADED = "nothing presses the pin: operation.output_torque is 0 and there is no inertia"
LINE = (
    "wheel rigid but for half-spaces; least and greatest depth of the wall taken as half and twice wall_depth give the "
    "error"
)
POINT = "wheel rigid but for Hertz's half-spaces: error not known"
MESHED = "wheel and pin bend, finite elements; errors by two meshes"


def model_of(pair: Pair) -> str:
    """Return what the contact is made of."""
    if pair.elastic is not None:
        return ELASTIC
    return "Hertz" if pair.pin.shape == "barrel" else "slices"


def note_of(pair: Pair) -> str:
    """Return what is behind a stiffness and its error."""
    if pair.elastic is not None:
        return MESHED
    return POINT if pair.pin.shape == "barrel" else LINE


def pressure_parts(pair: Pair, pressed: Pressed) -> dict[str, Quantity]:
    """Return largest pressure and the contact's half width; along the pin too where it is a point."""
    model, peak = model_of(pair), 1e-6 * float(pressed.pressure.max())
    sure = pair.differences["pressure"] if pair.coarse is not None else None
    rows = {
        "pressure": Quantity(peak, "MPa", None if sure is None else sure * peak, model),
        "half_width": Quantity(1e6 * float(pressed.half_width.max()), "um", None, model),
    }
    if pair.pin.shape == "barrel":
        rows["half_length"] = Quantity(1e3 * float(pressed.along.max()), "mm", None, model)
    else:
        rows["pressure_over_mean"] = Quantity(
            float((pressed.pressure.max(axis=-1) / pressed.pressure.mean(axis=-1))[0]), "", None, model
        )
    return rows


def contact_pressure_max(s: Stages) -> Quantity:
    """Largest pressure between pin and slot under the forces of the rigid drive."""
    rows: dict[str, Parts | Quantity] = {}
    for name, pair in s.pairs.items():
        force, at = pair.largest
        if force == 0.0:
            rows[name] = Quantity(0.0, "MPa", 0.0, "exact", note=UNLOADED)
            continue
        rows[name] = pressure_parts(pair, pair.at_largest) | {
            "at": Quantity(math.degrees(at), "deg", None, "rigid")
        }
    return Quantity(parts=rows, note=_pressure_note(s.pairs[INDEXER]))


def _pressure_note(pair: Pair) -> str:
    if pair.elastic is not None:
        return f"{MESHED}; " + ("Hertz" if pair.pin.shape == "barrel" else "sharp ends of the pin press more")
    if pair.pin.shape == "barrel":
        return POINT
    return "half-spaces, the pin bends: it presses most at its root; sharp ends press more, error not known"


def mesh_stiffness(s: Stages) -> Quantity:
    """Stiffness of pin and slot about the wheel's axis over an index, at the forces of the rigid drive."""
    rows: dict[str, Parts | Quantity] = {}
    for name, pair in s.pairs.items():
        if pair.largest[0] == 0.0:
            rows[name] = Quantity("unloaded", note=UNLOADED)
            continue
        half, model = pair.forces.indexer.half_turn, model_of(pair)
        t, over = pair.loaded
        ends = pair.state(np.array([-half, pair.largest[1], half]))
        force = np.abs(pair.forces.state(np.array([-half, half])).pin)
        at_force = float(ends.stiffness[1])
        row = {
            "at_force_max": _stiffness(pair, at_force),
            "mean": _stiffness(pair, float(over.stiffness.mean())),
            "least": _stiffness(pair, float(over.stiffness.min())),
            "least_at": Quantity(math.degrees(float(t[over.stiffness.argmin()])), "deg", None, model),
        }
        for key, i, loaded in (("at_start", 0, force[0]), ("at_end", 2, force[1])):
            if loaded > 1e-9 * pair.largest[0]:
                row[key] = _stiffness(pair, float(ends.stiffness[i]))
        lever = pair.pin.distance * math.sin(float(pair.forces.indexer.reach(pair.largest[1])))
        row |= {
            "normal": Quantity(
                1e-6 * at_force / lever**2, "N/um", _error(pair, 1e-6 * at_force / lever**2), model
            ),
            **{f"{key}_share_of_compliance": Quantity(x, "", None, model) for key, x in pair.shares.items()},
            "lag_max": Quantity(math.degrees(60.0 * float(over.lag.max())), "arcmin", None, model),
        }
        if pair.law.play > 0.0:
            row["play_at_end"] = Quantity(math.degrees(60.0 * lash(pair, half)), "arcmin", 0.0, "exact")
        rows[name] = row
    note = note_of(s.pairs[INDEXER]) + "; where the pin carries 1 % of its largest force"
    return Quantity(parts=rows, note=note)


def torsional_stiffness(s: Stages) -> Quantity:
    """Stiffness at the output, pin and shaft in series; in the dwell with the lock in place of the pin."""
    shaft = s.scene.drive.output_shaft.stiffness
    rows: dict[str, Parts | Quantity] = {}
    for name, pair in s.pairs.items():
        if pair.largest[0] == 0.0:
            rows[name] = Quantity("unloaded", note=UNLOADED)
            continue
        at_force = float(pair.state(np.array([pair.largest[1]])).stiffness[0])
        over = _series(pair.loaded[1].stiffness, shaft)
        found = {
            "at_force_max": float(_series(np.array([at_force]), shaft)[0]),
            "mean": float(over.mean()),
            "least": float(over.min()),
            "in_dwell": float(_series(np.array([lock_of(s.scene, pair)]), shaft)[0]),
        }
        row = {key: _stiffness(pair, value, shaft) for key, value in found.items()}
        if s.scene.drive.wheel.lock_stiffness is not None:
            row["in_dwell"] = Quantity(_arcmin(found["in_dwell"]), "N*m/arcmin", 0.0, "given")
        rows[name] = row
    held = (
        "given" if s.scene.drive.wheel.lock_stiffness else "taken as stiff as the pin at the end of the index"
    )
    turned = f"shaft of {readable(shaft, 6)} N·m/rad in series" if shaft else "shaft rigid"
    return Quantity(parts=rows, note=f"{turned}; lock {held}; pin held rigidly in the planet")


def _series(stiffness: Array, shaft: float | None) -> Array:
    return stiffness if shaft is None else np.asarray(1.0 / (1.0 / stiffness + 1.0 / shaft))


def _stiffness(pair: Pair, value: float, shaft: float | None = None) -> Quantity:
    softened = (
        1.0 - value / shaft if shaft else 1.0
    )  # a change of the pin's part by x % changes the whole by less
    error = _error(pair, _arcmin(value))
    return Quantity(_arcmin(value), "N*m/arcmin", None if error is None else softened * error, model_of(pair))


def _error(pair: Pair, value: float) -> float | None:
    return None if pair.doubt is None else pair.doubt * value


def _arcmin(stiffness: float) -> float:
    return stiffness * math.pi / 10800.0

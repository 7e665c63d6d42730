"""Vibration velocity of the casing that the elastic reactions shake, and the zone that a standard gives it.

The casing feels the forces of the bearings of sun, ring and carrier, in the plane of the teeth, and the torque of the
member that stands still; driving and driven torques go to other machines. Rigid members press evenly: they shake
nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from trochoid.drives.casing import Shaken
from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.reactions import Reactions
from trochoid.drives.vibration import SLOW, CasingVibration, Load, shaken
from trochoid.dynamics.vibration import Vibration, positions_for
from trochoid.dynamics.wrench import Wrench
from trochoid.kinematics.train import Speeds
from trochoid.kinematics.types import Array, frozen


def casing_vibration(design: Design, turning: Speeds, found: Reactions, casing: Shaken) -> CasingVibration:
    """Shake the casing on its mounts with all forces on it."""
    scene, d = design.scene, design.drive
    pitches = whole_pitches(design)
    sense = float(np.sign(float(turning.members["carrier"])))
    loads = {}
    for name, force, torque in (
        ("elastic", found.force, found.torque),
        (SLOW, found.static_force, found.static_torque),
    ):
        held = torque[d.fixed]
        loads[name] = Load(
            on_casing(force, held, pitches, sense), partial(by_place, force, (d.fixed, held), pitches, sense)
        )
    speed = scene.operation.input_speed
    driven = abs(float(turning.members[d.driven])) * speed
    made = shaken(scene, casing, loads, found.speed / (2.0 * np.pi) / pitches, (speed, driven))
    return made.said(lambda vibration: _warned(vibration, pitches))


def by_place(
    force: Mapping[str, Array], holds: tuple[str, Array], pitches: int, sense: float
) -> dict[str, Wrench]:
    """Return what each member about the main axis puts on the casing, the torque where the fixed one is held."""
    fixed, torque = holds
    return {
        name: on_casing({name: each}, torque if name == fixed else 0.0 * torque, pitches, sense)
        for name, each in force.items()
    }


def _warned(found: Vibration, pitches: int) -> Vibration:
    """Say how many positions over a pitch the band needs: the record is that of many pitches."""
    top = found.band[1]
    if found.resolved_to + found.frequencies[0] > top:
        return found
    need = positions_for(top, float(found.frequencies[0]) * pitches)
    said = (
        f"the positions resolve vibration up to {found.resolved_to:.4g} Hz of {top:.4g} Hz; {need} positions "
        "(ask.positions) over a pitch cover the whole band"
    )
    return replace(found, warnings=(said, *found.warnings[1:]))


def whole_pitches(design: Design) -> int:
    """Return after how many pitches the carrier's frame stands in space as before."""
    d = design.drive
    return {"ring": d.z_ring, "sun": d.z_sun, "carrier": 1}[d.fixed]


def on_casing(force: Mapping[str, Array], torque: Array, pitches: int, sense: float) -> Wrench:
    """Return what the casing feels over one turn of the carrier, or over a pitch where that stands still."""
    whole = np.sum(list(force.values()), axis=0)
    forces, torque = np.tile(whole, (pitches, 1)), np.tile(torque, pitches)
    angle = sense * 2.0 * np.pi * np.arange(len(forces)) / len(forces)
    c, s = np.cos(angle), np.sin(angle)
    x, y = forces.T
    turned = np.stack([c * x - s * y, s * x + c * y, np.zeros_like(x)], axis=1)
    moment = np.stack([0.0 * x, 0.0 * x, -torque], axis=1)
    gross = float(np.abs(turned).max(initial=0.0)), float(np.abs(moment).max(initial=0.0))
    return Wrench(frozen(turned), frozen(moment), frozen(np.zeros(3)), gross)

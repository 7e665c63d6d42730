"""Vibration velocity of the casing of an RV drive.

What members put on it repeats in the carrier's frame after a turn of the crankshafts; in the fixed one after as many
turns as bring the carrier back to a whole number of its own, so the record is as long as that.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np

from trochoid.drives.casing import Shaken
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.reactions import Reactions, on_casing
from trochoid.drives.vibration import RIGID, CasingVibration, Load, shaken
from trochoid.dynamics.carried import to_fixed
from trochoid.dynamics.vibration import Vibration
from trochoid.dynamics.wrench import Wrench

CUT = "the positions resolve"  # how the warning begins that counts positions of the whole record


def casing_vibration(design: Design, found: Reactions, casing: Shaken) -> CasingVibration:
    """Shake the casing on its mounts with all forces on it."""
    carrier = design.speeds.members["carrier"]
    each = Fraction(carrier) / abs(
        design.speeds.relative("planet", "carrier")
    )  # turns per turn of the crankshafts
    repeats, step = each.denominator, 2.0 * np.pi * float(each)
    angle = float(carrier) * found.angle

    def fixed(load: Wrench) -> Wrench:
        return to_fixed(load, angle, repeats, step)

    def by_seat(model: str) -> dict[str, Wrench]:
        return {name: fixed(load) for name, load in on_casing(design, found, model).items()}

    loads = {
        "elastic": Load(fixed(found.casing), lambda: by_seat("elastic")),
        RIGID: Load(fixed(found.casing_rigid), lambda: by_seat("rigid")),
    }
    speed = design.scene.operation.input_speed
    base = abs(design.turning) * speed / (2.0 * np.pi) / repeats
    driven = abs(float(design.speeds.members[design.driven])) * speed
    made = shaken(design.scene, casing, loads, base, (speed, driven))
    return made.said(lambda vibration: _said(design, vibration))


def _said(design: Design, found: Vibration) -> Vibration:
    """Tell how many positions of the input cover the band, where they do not."""
    kept = [said for said in found.warnings if not said.startswith(CUT)]
    if len(kept) < len(found.warnings):
        need = 2 * int(np.ceil(found.band[1] * 2.0 * np.pi / design.scene.operation.input_speed)) + 2
        kept.append(
            f"{CUT} vibration up to {found.resolved_to:.4g} Hz of {found.band[1]:.4g} Hz; {need} positions "
            "(ask.positions) cover the whole band"
        )
    return replace(found, warnings=tuple(kept))

"""Vibration velocity of the casing of an RV drive.

What members put on it repeats in the carrier's frame after a turn of the crankshafts; in the fixed one after as many
turns as bring the carrier back to a whole number of its own, so the record is as long as that.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np

from trochoid.drives.rv.design import Design
from trochoid.drives.rv.reactions import Reactions
from trochoid.drives.vibration import CasingVibration, shaken
from trochoid.dynamics.carried import to_fixed
from trochoid.dynamics.vibration import Vibration

CUT = "the positions resolve"  # how the warning begins that counts positions of the whole record


def casing_vibration(design: Design, found: Reactions) -> CasingVibration:
    """Shake the casing on its mounts with the resultant of all forces on it; raises TrochoidError without a casing."""
    carrier = design.speeds.members["carrier"]
    each = Fraction(carrier) / abs(
        design.speeds.relative("planet", "carrier")
    )  # turns per turn of the crankshafts
    repeats, step = each.denominator, 2.0 * np.pi * float(each)
    angle = float(carrier) * found.angle
    load, rigid = (to_fixed(x, angle, repeats, step) for x in (found.casing, found.casing_rigid))
    speed = design.scene.operation.input_speed
    base = abs(design.turning) * speed / (2.0 * np.pi) / repeats
    driven = abs(float(design.speeds.members[design.driven])) * speed
    made = shaken(design.scene, load, rigid, base, (speed, driven))
    return replace(made, elastic=_said(design, made.elastic), rigid=_said(design, made.rigid))


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

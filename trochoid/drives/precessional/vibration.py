"""Vibration velocity of the casing on its mounts by all models, and the zone that a standard gives it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

from trochoid.drives.casing import Shaken
from trochoid.drives.precessional.casing import casing_load, closed_record, places
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.elastic import respond
from trochoid.drives.precessional.mechanism import Counterweight, PrecessionalDrive
from trochoid.drives.precessional.members import bodies
from trochoid.drives.precessional.reactions import Reactions, reactions
from trochoid.drives.precessional.turn import MODELS
from trochoid.drives.precessional.yielding import Yielding, output_mass
from trochoid.drives.vibration import PRINTED, RIGID, UNBALANCED, CasingVibration, Load, shaken
from trochoid.dynamics.vibration import Vibration


def vibration(
    design: Design, drive: PrecessionalDrive, casing: Shaken, held: Yielding | None = None
) -> CasingVibration:
    """Shake the casing with all reactions on it: by the elastic model where joints are `held` by springs, else rigid.

    Beside it by the other models, and with the best one without counterweight.
    """
    record = closed_record(drive)
    found = {} if held is None else {"elastic": held.elastic.reactions(record)}
    found |= {name: reactions(drive, record, design.speed, model) for name, model in MODELS.items()}
    if drive.counterweight.mass > 0.0:
        found[UNBALANCED] = _unbalanced(design, drive, held)
    loads = {name: Load(casing_load(each), partial(places, each)) for name, each in found.items()}
    base = design.speed / (2.0 * math.pi * drive.nutation.closing_turns)
    made = shaken(design.scene, casing, loads, base, (design.speed, abs(design.output_speed)))
    # these loads have three lines, all of them resolved
    return made.said(lambda each: replace(each, warnings=()))


def models(found: CasingVibration, best: str) -> Mapping[str, Vibration]:
    """Return the vibrations by model, the `best` one among them."""
    others = {name: found.others[name] for name in (RIGID, PRINTED) if name in found.others}
    return {RIGID: found.rigid, **others, best: found.elastic}


def _unbalanced(design: Design, drive: PrecessionalDrive, held: Yielding | None) -> Reactions:
    """Return the reactions of the same drive, on the same joints, without its counterweight."""
    bare, record = replace(drive, counterweight=Counterweight(0.0, 0.0, 0.0)), closed_record(drive)
    if held is None:
        return reactions(bare, record, design.speed)
    moved = bodies(bare, design.speed, design.shaft_shape, held.joints, output_mass(design))
    return respond(bare, moved, design.speed, design.scene.operation.damping_ratio).reactions(record)

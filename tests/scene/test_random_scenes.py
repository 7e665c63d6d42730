"""A thousand random drives that can be built are solved, a thousand that cannot are refused with the reason."""

from __future__ import annotations

import re
from collections import Counter

import numpy as np
import pytest

from tests.drives.khv_cases import all_forces, imbalance, level_of
from tests.scene.random_drives import Tables, drawn, other_load, scene_of
from tests.scene.spoilers import SPOILERS, Refusal, Spoiler
from trochoid.clock import Clock
from trochoid.drives.khv.bodies import Level
from trochoid.drives.khv.design import Design, design
from trochoid.drives.khv.feasible import faults
from trochoid.drives.khv.series import solve_at
from trochoid.drives.khv.stages import Stages
from trochoid.faults import SceneFaults, dotted
from trochoid.kinematics.errors import Infeasible

BATCHES = 10
RIGID, FLOATING, ELASTIC = 90, 6, 4  # scenes in a batch: together a thousand in all batches
BALANCE = 1e-9
ROUNDING = 1e-14  # of a place: what is left of a force that rests on springs when nothing loads the drive


def balanced(made: Design, level: Level | None, angle: float) -> None:
    """Solve a position; fail unless all numbers are finite, nothing pulls, and every member balances."""
    bodies = () if level is None else level.elastic
    contact = solve_at(made, "springs" if level is None else "level0", bodies, angle)
    force = all_forces(contact)
    assert np.isfinite(force).all()
    assert np.isfinite(contact.motion).all()
    assert np.isfinite(contact.stiffness).all()
    assert force.min() >= 0.0
    assert max(contact.imbalance, contact.penetration) <= BALANCE
    missing = imbalance(made, contact, angle, classical=level is None)
    if force.any():
        assert missing <= BALANCE
    else:  # then it is in N
        springs = made.supports["shaft"][0] + made.supports["output"][0]
        assert made.flange_torque == 0.0
        assert missing <= ROUNDING * made.flank.pin_circle_radius * springs


@pytest.mark.property
@pytest.mark.parametrize("batch", range(BATCHES))
def test_a_thousand_drives_are_solved(batch: int) -> None:
    """10 mm to 1 m, 5…30 pins, 1…3 discs, lengths in any unit: none is refused, everything balances to 1e-9."""
    rng, done = np.random.default_rng(batch), Counter[str]()
    soft = drawn(rng, 9, None, elastic=True)
    raws = [("rigid", drawn(rng, floating=False)) for _ in range(RIGID)]
    raws += [("floating", drawn(rng, floating=True)) for _ in range(FLOATING)]
    raws += [("elastic", other_load(rng, soft)) for _ in range(ELASTIC)]
    for kind, raw in raws:
        made = design(scene_of(raw))
        assert faults(made) == ()
        balanced(made, level_of(made) if kind == "elastic" else None, float(rng.uniform(0, 2 * np.pi)))
        done[kind] += 1
    assert done.total() * BATCHES >= 1000


EACH = 35


def refused(raw: Tables, expected: Refusal) -> None:
    """Read the scene, look at its geometry when it can be read; fail unless the right thing is said."""
    if not expected.built:
        with pytest.raises(SceneFaults) as caught:
            scene_of(raw)
        said = [(dotted(fault.key), fault.message) for fault in caught.value.faults]
        assert len(said) == 1, said
        assert said[0][0] == expected.key, said
        assert re.search(expected.said, said[0][1]), (said, expected)
        return
    scene = scene_of(raw)
    with pytest.raises(Infeasible) as refusal:
        _ = Stages(scene, Clock()).feasible
    lines = str(refusal.value).splitlines()
    assert any(re.search(expected.said, line) for line in lines), (lines, expected)


@pytest.mark.property
@pytest.mark.parametrize("spoil", SPOILERS, ids=lambda spoil: spoil.__name__.replace("_", " "))
def test_a_thousand_scenes_are_refused(spoil: Spoiler) -> None:
    """One mistake of each kind in drives that could be built: the fault names its key, or what binds."""
    rng, done = np.random.default_rng(SPOILERS.index(spoil)), Counter[str]()
    for _ in range(EACH):
        raw = drawn(rng)
        expected = spoil(rng, raw)
        refused(raw, expected)
        done[expected.key] += 1
    assert done.total() * len(SPOILERS) >= 1000

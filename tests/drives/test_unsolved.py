"""Drives that are not solved: the refusal names members, and what to change in the scene."""

from __future__ import annotations

import numpy as np
import pytest

from trochoid.drives.khv.torsional import Pendulum, torsional
from trochoid.drives.unsolved import unsolved
from trochoid.kinematics.errors import NotConverged


@pytest.mark.property
def test_motions_are_said_by_name() -> None:
    """Solvers number motions; the drive knows whose they are. The position stays beside the message."""
    names = ("disc0.x", "disc0.y", "output.rotation")
    found = unsolved(NotConverged("motion 2 is out of balance, motion 7 is not", 5), np.pi, names, "; so")
    assert str(found) == "at input angle 180°: motion output.rotation is out of balance, motion 7 is not; so"
    assert found.row == 5


@pytest.mark.property
@pytest.mark.parametrize(("fails", "where"), [("steady", "at 150 rad/s"), ("sweep", "from 30 to 300 rad/s")])
def test_tiny_torque_in_a_large_backlash_is_named(
    fails: str, where: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A drive that rattles between its flanks has no steady motion to be found: torque and backlash are to blame."""
    turn = 2.0 * np.pi * np.arange(41) / 41
    made = Pendulum(0.05, 0.1, 1e-3, 7e4 * (1.0 + 0.2 * np.cos(turn)), 1e-5 * np.sin(3 * turn), 1.3e-4)

    def lost(*_: object) -> None:
        raise NotConverged("start from a neighbouring speed (sweep)")

    monkeypatch.setattr("trochoid.drives.khv.torsional.steady", lambda *_: None)
    monkeypatch.setattr(f"trochoid.drives.khv.torsional.{fails}", lost)
    with pytest.raises(NotConverged) as refusal:
        torsional(made, 150.0)
    assert where in str(refusal.value)
    assert "operation.output_torque = 0.001 N*m winds the drive up by 1.4e-08 rad" in str(refusal.value)
    assert "sweep" not in str(refusal.value)

"""Torsional vibration of K-H-V drives: creeping speed, linear limits, jumps, self-excitation, absent effects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.drives.khv_cases import scene, without
from trochoid.clock import Clock
from trochoid.drives.khv.answers_torsional import picture
from trochoid.drives.khv.stages import Stages
from trochoid.drives.khv.torsional import Pendulum, driven_inertia, law, pendulum, torsional
from trochoid.dynamics.harmonic_balance import steady
from trochoid.kinematics.errors import TrochoidError
from trochoid.run import Run

FEW = ("ask.positions=24", 'ask.quantities=["torsional_vibration"]')
STILL = without("elastic_contact", "friction", "casing_on_mounts")
PHASE = 2.0 * np.pi * np.arange(48) / 48


def stages(*words: str, effects: tuple[str, ...] = STILL) -> Stages:
    """Return stages of the example with rigid discs on springs."""
    return Stages(scene(*FEW, *words, effects=effects), Clock())


def oscillator(
    varying: float = 0.0, error: float = 0.0, half_gap: float = 0.0, ratio: float = 0.02, order: int = 10
) -> Pendulum:
    """Return a drive of 1 N·m/rad and 1 kg·m² under 0.1 N·m, with `order` periods of stiffness and error in a turn."""
    waves = np.cos(2.0 * np.pi * order * np.arange(4 * order + 8) / (4 * order + 8))
    return Pendulum(1.0, 2.0 * ratio, 0.1, 1.0 + varying * waves, error * waves, half_gap)


@pytest.mark.exact
@pytest.mark.parametrize("speed", [1e-6, 1e-2])
def test_creeping_drive_moves_as_at_rest(speed: float) -> None:
    """Near 0 rpm the lag is that of the contacts at every angle, and the torque is T, whatever the effects: inertia is
    as the square of the speed, damping as the speed.
    """
    for effects in (STILL, without("elastic_contact", "friction", "casing_on_mounts", "backlash")):
        case = stages(f"operation.input_speed={speed}", effects=effects)
        found = case.torsional
        assert found is not None
        made, lag = found.pendulum, case.contact.fine.twist[:-1]
        angles = np.linspace(0.0, 2.0 * np.pi, len(lag), endpoint=False)
        x = made.at_rest(angles)
        np.testing.assert_allclose(x - x.mean(), lag - lag.mean(), atol=0.05 * np.ptp(lag))
        assert found.torques == pytest.approx((made.torque, made.torque), rel=1e-4 * speed)
        assert found.up.max() < 1e-4 * speed * np.ptp(lag)
        assert found.swing == pytest.approx(np.ptp(made.at_rest(found.motion.phase)), rel=1e-4 * speed)
        assert made.inertia == driven_inertia(case.design, case.masses)


@pytest.mark.exact
def test_response_to_the_transmission_error() -> None:
    """Constant stiffness: peak to peak 2 e/|1 − r² + 2iζr|, r the order times the speed over √(k/J)."""
    made = oscillator(error=1e-3)
    for speed in (1e-6, 0.05, 0.1, 0.15):
        ratio = 10.0 * speed
        motion = steady(made.system, (made.local,), made.loads(speed), speed)
        wanted = 2e-3 / abs(1.0 - ratio**2 + 0.04j * ratio)
        assert np.ptp(made.lag(motion)) == pytest.approx(wanted, rel=2e-3)
        assert made.lag(motion).mean() == pytest.approx(0.1, rel=1e-9)


@pytest.mark.property
def test_play_makes_the_motion_jump(monkeypatch: pytest.MonkeyPatch) -> None:
    """A light load, play and an error that shakes the contacts apart: two motions below resonance, one without play."""
    monkeypatch.setattr("trochoid.drives.khv.torsional.SPEEDS", 25)
    shaken = oscillator(error=0.06, half_gap=1.0, ratio=0.03, order=1)
    found = torsional(shaken, 0.9)
    assert found.jumps.size > 0
    assert found.jumps.max() < 1.0
    assert torsional(replace(shaken, half_gap=0.0), 0.9).jumps.size == 0


@pytest.mark.property
def test_parametric_instability_is_flagged() -> None:
    """Mathieu: stiffness 1 + 0.4 cos 10φ, lightly damped, excites itself at 10 Ω = 2 √(k/J), not with more damping."""
    light, heavy = oscillator(varying=0.4, ratio=0.01), oscillator(varying=0.4, ratio=0.2)
    found = torsional(light, 0.2)
    assert found.tried[0] == 0.2
    assert found.growth[0] > 1.0
    # growth exponent κ√(k/J)/4 − ζ√(k/J) over one turn, κ the share that varies (first order)
    assert np.log(found.growth[0]) == pytest.approx((0.4 / 4.0 - 0.01) * 2 * np.pi / 0.2, rel=0.05)
    assert found.unstable.size > 0
    assert torsional(heavy, 0.2).unstable.size == 0


@pytest.mark.exact
def test_law_is_differentiated() -> None:
    """The slope that Newton's method uses is the derivative of the torque."""
    torque = law(oscillator(varying=0.3, error=0.01, half_gap=0.05))
    lag = np.linspace(-0.3, 0.3, 48)
    step = 1e-7
    slope = (torque(lag + step, PHASE)[0] - torque(lag - step, PHASE)[0]) / (2.0 * step)
    np.testing.assert_allclose(torque(lag, PHASE)[1], slope, atol=1e-6)


@pytest.mark.property
def test_effects_are_in_the_equations_only_when_listed() -> None:
    """Mean stiffness without the one, no play without the other; the other answers keep all their bits."""
    case = stages()
    plain = stages(effects=without("elastic_contact", "friction", "time_varying_stiffness", "backlash"))
    full, none = (pendulum(x.design, x.contact.fine, x.masses, 0.02) for x in (case, plain))
    assert np.ptp(full.stiffness) > 0.0 == np.ptp(none.stiffness)
    assert full.half_gap > 0.0 == none.half_gap
    np.testing.assert_array_equal(case.contact.fine.motion, plain.contact.fine.motion)
    assert none.mean_stiffness == pytest.approx(full.mean_stiffness, rel=1e-12)
    still = plain.torsional
    assert still is not None
    assert still.growth.size == 0


@pytest.mark.property
def test_answer_and_picture() -> None:
    """Torque round its mean far from resonance, what is not resolved, a picture over the speed."""
    run = Run(scene(*FEW, effects=STILL))
    parts = run.torsional_vibration.parts
    assert parts is not None
    note = str(run.torsional_vibration.note)
    assert "take 41 positions" in note
    assert "no parametric instability" in note
    stiff = run.stages.torsional
    assert stiff is not None
    assert stiff.torques[0] < 400.0 < stiff.torques[1]
    assert [curve.name for curve in picture(run.stages, stiff).curves] == [
        "speed rising",
        "speed of operation",
    ]
    assert [plot.title for plot in run.outcome.plots] == ["Torsional vibration"]


@pytest.mark.property
def test_drive_without_torque_is_refused() -> None:
    """No load, no mean stiffness: said with what to do."""
    case = stages()
    free = replace(case.contact.fine, stiffness=0.0 * case.contact.fine.stiffness)
    with pytest.raises(TrochoidError, match="output_torque above 0"):
        pendulum(case.design, free, case.masses, 0.02)

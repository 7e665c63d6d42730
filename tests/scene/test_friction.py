"""The effect "friction" and the quantities that follow it: what is allowed, and what is said when it is not."""

from __future__ import annotations

import pytest

from trochoid.faults import SceneFaults
from trochoid.scene import read

RATIO = 'ask.quantities=["ratio"]'


@pytest.mark.property
def test_coefficients_and_their_defaults(example: str) -> None:
    """Each kind of contact has its own; without a number both are 0.05; without the effect there is none."""
    given = read(example, ['effects=[{type="friction", ring_pins=0, output_pins=1}]', RATIO]).friction
    plain = read(example, ['effects=[{type="friction"}]', RATIO]).friction
    assert given is not None
    assert plain is not None
    assert (given.ring_pins, given.output_pins) == (0.0, 1.0)
    assert (plain.ring_pins, plain.output_pins) == (0.05, 0.05)
    assert read(example, ["effects=[]", RATIO]).friction is None


@pytest.mark.property
@pytest.mark.parametrize("wrong", ["1.01", "-0.01", '"0.05"', "true"])
def test_a_wrong_coefficient_is_named(example: str, wrong: str) -> None:
    """What was given and what is allowed, at its key."""
    with pytest.raises(SceneFaults, match=r"effects\.0\.ring_pins: given .*; need a number") as caught:
        read(example, [f'effects=[{{type="friction", ring_pins={wrong}}}]', RATIO])
    assert len(caught.value.faults) == 1


@pytest.mark.property
@pytest.mark.parametrize("quantity", ["efficiency", "power_loss"])
def test_losses_need_friction(example: str, quantity: str) -> None:
    """A quantity whose effect is missing is a fault that names both."""
    with pytest.raises(SceneFaults, match=f'"{quantity}" needs the effect "friction", which the scene lacks'):
        read(example, ['effects=[{type="clearance"}]', f'ask.quantities=["{quantity}"]'])


@pytest.mark.property
@pytest.mark.parametrize("torque", ["0", '"0 N*m"'])
@pytest.mark.parametrize("quantity", ["lost_motion", "backlash", "torsion_curve", "efficiency", "power_loss"])
def test_shares_of_no_torque_are_nothing(example: str, quantity: str, torque: str) -> None:
    """Quantities that are measured at shares of the torque need one."""
    with pytest.raises(SceneFaults, match=f'"{quantity}" needs operation.output_torque above 0'):
        read(example, [f'ask.quantities=["{quantity}"]', f"operation.output_torque={torque}"])

"""Zone limits as published, and the scope of each standard."""

from __future__ import annotations

import numpy as np
import pytest

from trochoid.dynamics.zones import Machine, zone
from trochoid.kinematics.errors import TrochoidError

FAST, SLOW = 1500.0 * np.pi / 30.0, 80.0 * np.pi / 30.0


def _machine(power: float, **changes: float | bool) -> Machine:
    values: dict[str, float | bool] = {"power": power, "input_speed": FAST, "output_speed": SLOW}
    return Machine(**(values | changes))  # type: ignore[arg-type]


@pytest.mark.published
@pytest.mark.parametrize(
    ("machine", "limits"),
    [
        (_machine(400e3, gear_unit=False, rigid_support=True), (2.3, 4.5, 7.1)),
        (_machine(400e3, gear_unit=False), (3.5, 7.1, 11.0)),
        (_machine(300e3, gear_unit=False, rigid_support=True), (1.4, 2.8, 4.5)),
        (_machine(16e3, gear_unit=False), (2.3, 4.5, 7.1)),
        (_machine(10e3, rating=3.15), (2.0, 3.15, 5.0)),
        (_machine(10e3, rating=5.0), (3.15, 5.0, 8.0)),
        (_machine(10e3), (5.0, 8.0, 12.5)),
        (_machine(10e3, rating=12.5), (8.0, 12.5, 20.0)),
        (_machine(1e6, rating=20.0), (12.5, 20.0, 31.5)),
    ],
)
def test_limits_and_letters(machine: Machine, limits: tuple[float, float, float]) -> None:
    """verification.md: ISO 20816-3 groups, ISO 20816-9 ratings; a limit belongs to the better zone."""
    for index, limit in enumerate(limits):
        assert zone(limit * 1e-3, machine).letter == "ABCD"[index]
        assert zone(limit * 1.001e-3, machine).letter == "ABCD"[index + 1]
    found = zone(0.0, machine)
    assert found.letter == "A"
    assert found.limits == pytest.approx([limit * 1e-3 for limit in limits], rel=1e-12)
    assert found.standard is not None
    assert found.standard in found.reason


@pytest.mark.published
@pytest.mark.parametrize(
    ("machine", "said"),
    [
        (_machine(3.35e3), "10 kW.*3.35 kW"),
        (_machine(15e3, gear_unit=False), "above 15 kW.*15 kW"),
        (_machine(14e3, gear_unit=False), "14 kW"),
        (_machine(12e3, output_speed=20.0 * np.pi / 30.0), "20 r/min"),
        (_machine(12e3, input_speed=13000.0 * np.pi / 30.0), "1.3e\\+04 r/min"),
    ],
)
def test_outside_every_scope(machine: Machine, said: str) -> None:
    """verification.md: a standard applies only in its scope; ISO 20816-1's 0.71/1.8/4.5 is guidance."""
    import re

    found = zone(1e-3, machine)
    assert found.letter is None
    assert found.standard is None
    assert found.limits is None
    assert found.guidance == pytest.approx((0.71e-3, 1.8e-3, 4.5e-3))
    assert re.search(said, found.reason)
    assert "no standard applies" in found.reason


@pytest.mark.exact
def test_large_machine_outside_scope_gets_no_guidance_for_small_ones() -> None:
    """200 MW: beyond ISO 20816-9, and the limits of small machines would mislead."""
    found = zone(1e-3, _machine(200e6))
    assert found.letter is None
    assert found.guidance is None


@pytest.mark.exact
def test_slow_machine_is_told_of_the_band() -> None:
    """ISO 20816-3 measures from 2 Hz below 600 r/min: the reason says so."""
    slow = _machine(50e3, gear_unit=False, input_speed=300.0 * np.pi / 30.0)
    assert "2 Hz" in zone(1e-3, slow).reason
    assert "2 Hz" not in zone(1e-3, _machine(50e3, gear_unit=False)).reason


@pytest.mark.exact
@pytest.mark.parametrize("velocity", [-1e-3, float("nan"), float("inf")])
def test_bad_velocity_is_refused(velocity: float) -> None:
    """A velocity that is none gets no zone."""
    with pytest.raises(TrochoidError, match="rms velocity"):
        zone(velocity, _machine(20e3))


@pytest.mark.exact
def test_unknown_rating_is_refused() -> None:
    """The ratings that exist are listed."""
    with pytest.raises(TrochoidError, match=r"3\.15"):
        zone(1e-3, _machine(20e3, rating=7.0))

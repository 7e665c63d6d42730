"""Nadezhdin's numbers (sources §5) reached through scenes."""

from __future__ import annotations

import math

import pytest

from tests.drives.indexer_cases import run_of
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.indexer_measure import peaks
from trochoid.results.outcome import Quantity


def number(quantity: Quantity, *names: str) -> float:
    """Return the value of a part."""
    part = quantity
    for name in names:
        part = (part.parts if isinstance(part, Quantity) else part)[name]  # type: ignore[index,assignment]
    assert isinstance(part.value, float)
    return part.value


@pytest.mark.published
def test_constants_of_the_geneva_wheel() -> None:
    """B = 2.00 and C = 5.53 at ψ_Σ = 90°: 2 and 5.52974528736, for any k of the indexer beside it."""
    for k in (0.25, 0.2902, 0.4):
        found = run_of(f"relative_turning_time = {k}").indexing_motion
        assert number(found, "geneva_wheel", "B") == pytest.approx(2.0, abs=1e-12)
        assert number(found, "geneva_wheel", "C") == pytest.approx(5.52974528736, abs=5e-12)
        assert number(found, "geneva_wheel", "relative_turning_time") == pytest.approx(0.5, abs=1e-15)


@pytest.mark.published
def test_constants_of_the_indexer() -> None:
    """Printed 1.71 and 4.77 at k = 0.25: right 1.55947 and 4.91856; 1.7100 has k = 0.2902, ρ = 0.527, C = 4.7952."""
    cusp = run_of("relative_turning_time = 0.25").indexing_motion
    assert number(cusp, "indexer", "B") == pytest.approx(1.55947, abs=5e-6)
    assert number(cusp, "indexer", "C") == pytest.approx(4.91856, abs=5e-6)
    run = run_of()
    assert number(run.indexing_motion, "indexer", "B") == pytest.approx(1.71, abs=5e-5)
    assert number(run.indexing_motion, "indexer", "C") == pytest.approx(4.7952, abs=1e-4)
    assert number(run.profile, "pin_ratio") == pytest.approx(0.527, abs=5e-4)
    assert abs(number(run.indexing_motion, "indexer", "hard_shock")) < 1e-12


@pytest.mark.published
def test_ratios_from_120_to_60_degrees() -> None:
    """Printed 1.7, 2.25, more than 3; cusps with i = 4 give 1.974, 2.077, 2.268."""
    wide, small = (
        run_of("relative_turning_time = 0.25", f"drive.swing_angle={x}").indexing_motion for x in (120, 60)
    )
    for key, ratio in (
        ("velocity_max", 1.974),
        ("acceleration_max", 2.077),
        ("acceleration_at_start", 2.268),
    ):
        assert number(wide, "indexer", key) / number(small, "indexer", key) == pytest.approx(ratio, abs=5e-4)


@pytest.mark.published
def test_an_indexer_without_soft_shock() -> None:
    """Hypo near, i = 4, k = 0.5, γ = 47.77587°, β = 2.77587°: found from its ρ, with ε0 = 0."""
    arm, pin = math.radians(47.77587), math.radians(2.77587)
    rho = math.tan(pin) * (4.0 - math.cos(arm)) / math.sin(arm)
    run = run_of(f"pin_ratio = {rho}\nplace = 'near'")
    assert number(run.profile, "arm_angle") == pytest.approx(47.77587, abs=1e-5)
    assert number(run.profile, "pin_angle") == pytest.approx(2.77587, abs=1e-5)
    # there the family of k = 1/2 is crossed by another, so that two mechanisms with this ρ are all but one
    half = [x.indexer for x in run.stages.design.solutions if abs(x.indexer.duration - 0.5) < 1e-12]
    found = min(half, key=lambda x: abs(x.path.arm - arm))
    assert found.path.arm == pytest.approx(arm, abs=1e-8)
    assert abs(peaks(found).start) < 1e-6 * peaks(found).acceleration
    chosen = run.indexing_motion
    assert number(chosen, "indexer", "relative_turning_time") == pytest.approx(0.5, abs=1e-3)
    top = number(chosen, "indexer", "acceleration_max")
    assert abs(number(chosen, "indexer", "acceleration_at_start")) < 1e-2 * top


@pytest.mark.published
@pytest.mark.parametrize(("axis_angle", "duration"), [(60, 0.3524), (90, 0.5), (120, 0.6476)])
def test_duration_of_the_geneva_wheel(axis_angle: int, duration: float) -> None:
    """Printed k = 0.5 for all; right only at 90°."""
    found = run_of("pin_ratio = 0.5", f"drive.axis_angle={axis_angle}").indexing_motion
    assert number(found, "geneva_wheel", "relative_turning_time") == pytest.approx(duration, abs=5e-5)


@pytest.mark.published
def test_a_whole_share_leaves_the_arm_free() -> None:
    """cos D = cot φ0 cot ψ0 with whole i·k: k alone says nothing, the scene must give ρ."""
    with pytest.raises(Infeasible, match="give ρ in place of k"):
        _ = run_of("relative_turning_time = 0.5").ratio

"""The hand calculation of sources §3 as the bare contact problem: springs, gaps and levers, no pose and no pair."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from trochoid.fem.complementarity import Group, Problem, Solution, solve, tangent
from trochoid.kinematics.cycloid import Cycloid, Modification, gap, gap_first_order
from trochoid.kinematics.train import khv_train, speeds
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
RV40 = Cycloid(40, 39, 0.064, 0.003, 0.0013)
GROUND = Modification(equidistant=1e-5, radial=-2e-5)
TORQUE, CRANK, STIFFNESS = 206.0, 0.2, 2e8  # N·m per disc, rad, N/m


def _pins(flank: Cycloid, crank: float) -> Array:
    """Return the flank parameters that touch the pins."""
    return flank.contact_parameter(np.arange(flank.pins), crank)


def _springs(flank: Cycloid, crank: float, torque: float, gaps: Array) -> Solution:
    """Share a torque that turns the disc against its pins; the disc can only turn."""
    arms = flank.lever(_pins(flank, crank))
    group = Group(np.full((flank.pins, 1, 1), 1 / STIFFNESS), gaps[:, None], arms[:, None, None])
    return solve(Problem((group,), np.zeros((flank.pins,) * 2), np.zeros((1, 1)), np.array([torque])))


@pytest.mark.published
def test_unmodified_flank() -> None:
    """Sources §3: F_max = 405.469 N on 20 of 40 pins; closed form F_k = T l_k/Σl² over the loaded half."""
    force = _springs(RV40, CRANK, TORQUE, np.zeros(40)).forces[0][:, 0]
    assert force.max() == pytest.approx(405.469, abs=5e-4)
    assert np.count_nonzero(force > 1e-9) == 20
    lever = np.maximum(0.0, RV40.lever(_pins(RV40, CRANK)))
    assert force == pytest.approx(TORQUE * lever / np.sum(lever**2), abs=1e-9)


@pytest.mark.published
@pytest.mark.parametrize(("exact", "peak"), [(True, 1045.1), (False, 1043.6)])
def test_modified_flank(exact: bool, peak: float) -> None:
    """Sources §3: ΔR −0.02, Δr +0.01 mm, k = 2e5 N/mm: 6 pins; F_max 1045.1 N, 1043.6 N with gaps to first order."""
    t = _pins(RV40, CRANK)
    gaps = gap(RV40, GROUND, RV40.center_path(t), t)[0] if exact else gap_first_order(RV40, GROUND, t)
    force = _springs(RV40, CRANK, TORQUE, gaps).forces[0][:, 0]
    assert force.max() == pytest.approx(peak, abs=0.05)
    assert np.count_nonzero(force > 1e-9) == 6


@pytest.mark.published
def test_peak_of_another_program() -> None:
    """cycloidgen 7.2.0, release note: R 50, r 4, e 1.5 mm, z_p 12, 2.5 N·m per disc: 49.859 N at α = 0."""
    flank = Cycloid(12, 11, 0.050, 0.004, 0.0015)
    assert _springs(flank, 0.0, 2.5, np.zeros(12)).forces[0].max() == pytest.approx(49.859, abs=5e-4)


@pytest.mark.published
def test_closed_form_of_the_stiffness() -> None:
    """Sources §3: the rotational stiffness of many equal springs is k (e z_c)² z_p/4 when K is small."""
    flank = Cycloid(200, 199, 0.080, 1e-4, 2e-5)
    arms = flank.lever(_pins(flank, 0.1))
    group = Group(np.full((200, 1, 1), 1 / STIFFNESS), np.zeros((200, 1)), arms[:, None, None])
    problem = Problem((group,), np.zeros((200, 200)), np.zeros((1, 1)), np.array([1.0]))
    found = float(tangent(problem, solve(problem))[0, 0])
    assert found == pytest.approx(STIFFNESS * (flank.eccentricity * flank.lobes) ** 2 * 200 / 4, rel=2e-2)


@pytest.mark.published
@pytest.mark.parametrize("lobes", [3, 33, 191])
def test_ratios_of_the_textbook(lobes: int) -> None:
    """Textbook, 1.1 and 1.4: 3 … 191 in one stage, 33 in Fig. 5; with one pin more u is the number of lobes."""
    assert speeds(khv_train(lobes + 1, lobes)).ratio == -lobes


@pytest.mark.published
def test_efficiency_of_the_example() -> None:
    """Textbook, 1.1: 0.80 … 0.97; the example, with rigid discs and 0.05 at pins and rollers, lies inside."""
    rigid = ('ask.quantities=["efficiency"]', 'accuracy.model="springs"', 'effects=[{type="friction"}]')
    value = Run(load(EXAMPLE, (*rigid, "ask.positions=20"))).efficiency.value
    assert isinstance(value, float)
    assert 0.80 < value < 0.97


@pytest.mark.published
@pytest.mark.parametrize("eccentricity", [1e-5, 0.5e-3, 1.3e-3])
def test_largest_force_in_closed_form(eccentricity: float) -> None:
    """Sources §3: F_max ≈ 4T/(K R z_c) of 40 pins: within 0.4 % over a pitch, for K from 0.006 to 0.81."""
    flank = Cycloid(40, 39, 0.064, 1e-3, eccentricity)
    pitch = 2 * np.pi / flank.pins
    for crank in np.linspace(0.0, pitch, 9):
        force = _springs(flank, float(crank), TORQUE, np.zeros(40)).forces[0].max()
        assert force == pytest.approx(4 * TORQUE / (flank.trochoid_ratio * 0.064 * 39), rel=4e-3)


@pytest.mark.published
def test_pin_forces_repeat() -> None:
    """Sources §3: the set of pin forces repeats every 360°/z_p of the crank, and not after half of that."""
    pitch = 2 * np.pi / RV40.pins
    here, half, later = (
        np.sort(_springs(RV40, CRANK + share * pitch, TORQUE, np.zeros(40)).forces[0][:, 0])
        for share in (0.0, 0.5, 1.0)
    )
    assert later == pytest.approx(here, abs=1e-9)
    assert np.abs(half - here).max() > 1.0

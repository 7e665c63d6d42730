"""Natural frequencies of K-H-V drives: against the torsional pendulum and the elastic response; stages; pictures."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.drives.khv_cases import EVERY_PIN_ALIKE, scene, without
from trochoid.clock import Clock
from trochoid.drives.khv.modes import assembled, lines, near, spoken
from trochoid.drives.khv.stages import Stages
from trochoid.drives.modes import Mode
from trochoid.dynamics.whirl import whirl
from trochoid.run import Run

FEW = ("ask.positions=8", "accuracy.facets_per_lobe=6", 'accuracy.model="level0"')


@pytest.fixture(scope="module")
def elastic() -> Run:
    """The example with all its effects, coarse."""
    return Run(scene(*FEW, 'ask.quantities=["natural_frequencies", "reactions"]'))


@pytest.mark.exact
def test_flange_on_the_torsional_stiffness() -> None:
    """Heavy flange, rigid discs on springs: f = √(k/J)/2π with the torsional stiffness; discs add J_d (z_p/…)² hardly."""
    inertia = 1e6
    made = scene(
        *EVERY_PIN_ALIKE,
        "ask.positions=9",
        f"drive.output_flange.inertia={inertia}",
        'ask.quantities=["natural_frequencies"]',
        effects=["inertia"],
    )
    stages = Stages(made, Clock())
    series = stages.contact.fine
    k = series.torsional_stiffness[:-1]
    assert np.ptp(k) < 1e-9 * k.mean()
    found = stages.modes.fine
    assert found.modes[0].frequency == pytest.approx(np.sqrt(k.mean() / inertia) / (2 * np.pi), rel=1e-6)
    assert next(iter(found.modes[0].shares)) == "output flange turning"
    assert "reactions" not in stages.clock.seconds


@pytest.mark.independent
def test_modes_are_those_of_the_elastic_response(elastic: Run) -> None:
    """At standstill: the frequencies that the stiffness-aware reactions amplify by; at speed, pairs part by whirl."""
    stages: Stages = elastic.stages
    response = stages.reactions.fine.response
    assert response is not None
    at = assembled(stages.design, stages.contact.fine, stages.masses)
    np.testing.assert_allclose(whirl(at(0.0)).frequency, response.natural_frequencies, rtol=1e-9)
    modes = stages.modes.fine.modes
    np.testing.assert_allclose([mode.frequency for mode in modes], response.natural_frequencies, rtol=5e-3)
    assert stages.modes.fine.free == 0
    fast = at(20.0 * stages.design.crank_speed)
    assert np.abs(whirl(fast).frequency / response.natural_frequencies - 1.0).max() > 5e-3


@pytest.mark.property
def test_modes_in_the_outcome(elastic: Run) -> None:
    """Every mode with its error and who moves; a Campbell diagram with the lines of the pins; harmonics by both models."""
    outcome = elastic.outcome
    parts: Any = outcome.quantities["natural_frequencies"].parts
    assert list(parts) == [f"mode_{i}" for i in range(1, 12 + 4)]
    assert all(part.error > 0.0 and "%" in part.note for part in parts.values())
    (plot,) = outcome.plots
    assert {"input speed", "ring pins pass, 20 per turn"} <= {curve.group for curve in plot.curves}
    data = outcome.dataset
    assert data is not None
    assert data["reaction_lines_rigid"].sizes == {"reaction_frequency": 3, "bearing": 4}
    assert data["reaction_lines_elastic"].attrs["figure"] == data["reaction_lines_rigid"].attrs["figure"]
    assert float(data["reaction_frequency"][0]) == pytest.approx(25.0)


@pytest.mark.property
def test_motions_of_no_mass_effect_are_left_out() -> None:
    """Without compliant bearings shaft and flange do not move across z: names of modes are those of the motions."""
    made = scene(*FEW, effects=without("bearing_compliance", "casing_on_mounts", "friction"))
    stages = Stages(made, Clock())
    named = {name for mode in stages.modes.fine.modes for name in mode.shares}
    assert named == {spoken(name) for name in stages.contact.fine.names}
    assert not any("shaft" in name for name in named)


@pytest.mark.property
def test_lines_and_what_is_near() -> None:
    """Pins pass z_p times a turn of the crank, seen from the ring; a mode within a tenth of a line is named."""
    stages = Stages(scene(*FEW), Clock())
    orders = lines(stages.design)
    assert orders["ring pins pass, 20 per turn"] == 20.0
    assert orders["output pins pass, 8 per turn"] == pytest.approx(8.0 * (1.0 + 1.0 / 19.0))
    modes = (Mode(100.0, {"disc 1 turning": 1.0}), Mode(510.0, {"disc 2 turning": 1.0}))
    assert near(stages.design, modes) == ["ring pins pass, 20 per turn (500 Hz) near mode 2 (510 Hz)"]
    assert modes[0].words == "disc 1 turning 100 %"

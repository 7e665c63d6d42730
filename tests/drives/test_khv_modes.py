"""Natural frequencies of K-H-V drives: the torsional pendulum, whirl in the fixed frame; stages; pictures."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests.drives.khv_cases import EVERY_PIN_ALIKE, scene, without
from trochoid.clock import Clock
from trochoid.drives.khv.eccentric import momenta
from trochoid.drives.khv.modes import lines, natural_modes, near, spoken
from trochoid.drives.khv.reactions import reactions
from trochoid.drives.khv.stages import Stages
from trochoid.drives.modes import Mode
from trochoid.kinematics.errors import NotConverged
from trochoid.run import Run

FEW = ("ask.positions=8", "accuracy.facets_per_lobe=6", 'accuracy.model="level0"')


@pytest.fixture(scope="module")
def elastic() -> Run:
    """The example with all its effects, coarse."""
    return Run(scene(*FEW, 'ask.quantities=["natural_frequencies", "reactions"]'))


@pytest.mark.exact
def test_flange_on_the_torsional_stiffness() -> None:
    """Heavy flange, rigid discs on springs: f = √(k/J)/2π with the torsional stiffness, hardly any disc."""
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
def test_heavy_flange_on_elastic_discs() -> None:
    """Elastic discs, flange of 1e4 kg·m²: √(k/J)/2π with the torsional stiffness, discs that give way in it.

    The mean stiffness of the fixed frame, in which the load goes round, would be a third too stiff, with compliant
    bearings several times.
    """
    inertia = 1e4
    rigid = without("bearing_compliance", "casing_on_mounts", "friction")
    made = scene(*FEW, "ask.positions=40", f"drive.output_flange.inertia={inertia}", effects=rigid)
    stages = Stages(made, Clock())
    k = stages.contact.fine.torsional_stiffness[:-1]
    turning = [mode for mode in stages.modes.fine.modes if next(iter(mode.shares)) == "output flange turning"]
    wanted = float(np.sqrt(k.mean() / inertia)) / (2 * np.pi)
    assert turning[0].frequency == pytest.approx(wanted, rel=0.02)
    assert turning[0].shares["output flange turning"] > 0.99
    assert stages.modes.fine.stiffness_variation < 0.5
    fixed = stages.contact.fine.stiffness[:-1].mean(axis=0)
    row = stages.contact.fine.names.index("output.rotation")
    assert 1.0 / np.linalg.inv(fixed)[row, row] > 1.25 * k.mean()


@pytest.mark.exact
def test_whirl_is_heard_in_the_fixed_frame(elastic: Run) -> None:
    """Round springs: ω of a mass is √(k/m) in either sense, of a tilting shaft [√(H² + 4 J k) ± H]/2J, H = J_p Ω."""
    stages: Stages = elastic.stages
    series = stages.contact.fine
    springs = {"x": 1e9, "y": 1e9, "rotation": 3e6, "tilt_x": 1e5, "tilt_y": 1e5}
    diagonal = np.array([springs[name.split(".")[1]] for name in series.names])
    plain = replace(series, stiffness=np.tile(np.diag(diagonal), (len(series.angle), 1, 1)))
    found = natural_modes(stages.design, plain, stages.masses)
    assert found.stiffness_variation < 1e-12
    heard = {(next(iter(mode.shares)), mode.turns): mode.frequency for mode in found.modes}
    shaft = stages.masses.shaft
    momentum = shaft.axial_inertia * stages.design.crank_speed
    root = np.sqrt(momentum**2 + 4.0 * shaft.transverse_inertia * 1e5)
    for turns, sign in (("forward", 1.0), ("backward", -1.0)):
        across = float(np.sqrt(1e9 / shaft.mass)) / (2 * np.pi)
        assert heard["input shaft across z", turns] == pytest.approx(across, rel=1e-9)
        tilting = float(root + sign * momentum) / (2.0 * shaft.transverse_inertia) / (2 * np.pi)
        assert heard["input shaft tilting", turns] == pytest.approx(tilting, rel=1e-9)


@pytest.mark.property
def test_modes_in_the_outcome(elastic: Run) -> None:
    """Every mode with its error and who moves; a Campbell diagram with the lines of the pins; harmonics."""
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


@pytest.mark.property
def test_the_named_resonance_is_a_mode_of_the_drive(elastic: Run) -> None:
    """Reactions are found where modes are, in the eccentric's frame: what they name is listed, but for its turning."""
    stages: Stages = elastic.stages
    found = stages.reactions.fine
    assert found.response is not None
    assert found.response.resonance is not None
    named, turn = found.response.resonance.natural_frequency, stages.design.crank_speed / (2.0 * np.pi)
    heard = np.array([mode.frequency for mode in stages.modes.fine.modes])
    off = np.abs(heard[:, None] + np.array([-turn, 0.0, turn]) - named)
    assert off.min() < 1e-6 * named
    assert found.response.stiffness_variation == pytest.approx(stages.modes.fine.stiffness_variation)


@pytest.mark.property
def test_work_on_the_elastic_motion_is_what_damping_takes(
    elastic: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Energy along axes that stand still; with a wrong momentum of the shaft it does not close."""
    stages: Stages = elastic.stages
    made = stages.reactions.fine
    assert made.response is not None
    assert made.response.loss > 0.0
    assert made.work < 1e-12
    names = {check.name for check in elastic.outcome.checks if check.ok}
    assert "work on the elastic motion is what damping takes" in names
    monkeypatch.setattr("trochoid.drives.khv.reactions.momenta", lambda *given: 2.0 * momenta(*given))
    wrong = reactions(stages.design, stages.contact.fine, stages.masses, 0.02)
    assert wrong.work > 1e-7


@pytest.mark.property
def test_varying_stiffness_that_excites_itself_is_refused(elastic: Run) -> None:
    """One disc's springs swing twice a turn about m Ω², undamped: Mathieu's first tongue, refused with advice."""
    stages: Stages = elastic.stages
    series, speed = stages.contact.fine, stages.design.crank_speed
    diagonal = np.array([1e9 if not name.endswith("rotation") else 3e6 for name in series.names])
    steady = np.tile(np.diag(diagonal), (len(series.angle), 1, 1))
    swung = steady.copy()
    for row in (0, 1):
        swung[:, row, row] = stages.masses.disc.mass * speed**2 * (1.0 + 0.8 * np.cos(2.0 * series.crank))
    with pytest.raises(NotConverged, match=r"excites itself.*operation.damping_ratio"):
        reactions(stages.design, replace(series, stiffness=swung), stages.masses, 0.001)
    assert (
        reactions(stages.design, replace(series, stiffness=steady), stages.masses, 0.001).response is not None
    )


@pytest.mark.property
def test_modes_as_films(elastic: Run) -> None:
    """Six films of discs, shaft, flange and ring; the ring rests."""
    films = elastic.outcome.films
    assert [film.name for film in films] == [f"mode_{i}" for i in range(1, 7)]
    first: Stages = elastic.stages
    for film, mode in zip(films, first.modes.fine.modes, strict=False):
        assert f"{mode.frequency:.5g} Hz" in film.title
        bodies = {body.name: body for body in film.frames[0][1]}
        assert list(bodies) == ["disc 1", "disc 2", "input shaft", "output flange", "ring"]
        assert not bodies["ring"].point_data["displacement"].any()
        assert any(body.point_data["displacement"].any() for body in bodies.values())

"""The ladder of a K-H-V drive and the automatic choice of its model and mesh."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tests.drives.khv_cases import EVERY_PIN_ALIKE, scene
from trochoid.accuracy import Study, study
from trochoid.accuracy.errors import leaves
from trochoid.clock import Clock
from trochoid.drives.choosing import COARSEST
from trochoid.drives.khv.choice import choose
from trochoid.drives.khv.estimate import FLOOR, SHARE, scalar_error
from trochoid.drives.khv.ladder import levels, repeated
from trochoid.drives.khv.series import Series
from trochoid.drives.khv.stages import Stages
from trochoid.geometry.disc import disc_outline
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import NotConverged
from trochoid.run import Run

LEVELS = (8, 16, 32, 64)
ASKED = "contact_force_max", "contact_pressure_max", "torsional_stiffness", "transmission_error"
SMALL = (*EVERY_PIN_ALIKE, "ask.positions=3", f"ask.quantities={list(ASKED)}")


@dataclass(frozen=True)
class Made:
    """A drive whose numbers are off by 5.12/level³, and by `model` more on level 0."""

    model: float

    def solve(self, rung: str, level: int) -> Series:
        value = 1 + 5.12 / level**3 + (self.model if rung == "level0" else 0.0)
        one = np.full((3, 1, 1), value)
        touches = SimpleNamespace(force=one, pressure=one)
        series = SimpleNamespace(
            torsional_stiffness=np.full(3, value),
            twist=np.full(3, value),
            ring=touches,
            output=touches,
            bearing=None,
        )
        return cast(Series, series)


@pytest.mark.property
@pytest.mark.parametrize("model", [0.0, 1e-4, 1e-3, 1e-2])
def test_choice_is_monotone_in_the_tolerance(model: float) -> None:
    """A smaller tolerance never picks a cheaper model or a coarser mesh, and the error stays below it."""
    drive = Made(model)
    picks = []
    for tolerance in np.geomspace(0.1, 3e-4, 25):
        chosen = choose(float(tolerance), LEVELS, drive.solve, lambda: model)
        picks.append((("level0", "strips").index(chosen.rung), chosen.levels[-1]))
        true = 5.12 / chosen.levels[-1] ** 3 + (model if chosen.rung == "level0" else 0.0)
        assert true <= tolerance
        assert chosen.error <= tolerance
    assert picks[0][1] == LEVELS[1]
    for (rung, level), (next_rung, next_level) in pairwise(picks):
        assert rung <= next_rung
        assert level <= next_level


@pytest.mark.property
def test_choice_says_what_the_finest_level_reaches() -> None:
    with pytest.raises(
        NotConverged, match=r"estimated at .* with 64 facets per lobe, more than accuracy.tolerance"
    ):
        choose(1e-6, LEVELS, Made(0.0).solve, lambda: 0.0)


@pytest.mark.property
def test_named_model_is_not_doubted() -> None:
    def never() -> float:
        raise AssertionError("the scene has named its model")

    assert choose(1e-1, LEVELS, Made(1.0).solve, never, "level0").rung == "level0"


@pytest.mark.exact
def test_no_number_is_much_better_than_the_worst() -> None:
    """Where two levels of a number agree by chance, the worst number's difference stands in."""
    assert scalar_error(-2.0, -2.1, 1e-3) == pytest.approx(SHARE * 0.1)
    assert scalar_error(-2.0, -2.0, 1e-3) == pytest.approx(SHARE * FLOOR * 2e-3)


@pytest.mark.exact
@pytest.mark.parametrize("first", [4, 5, 6, 8, 9])
@pytest.mark.parametrize(("hole", "play"), [(9e-3, 0.0), (9e-3, 12e-3), (13.4e-3, 1e-3)])
def test_levels_double_every_facet(first: int, hole: float, play: float) -> None:
    """Bore and holes too, beside thin walls as well: else two levels would not tell the error of the finer."""
    flank = Cycloid(20, 19, 80e-3, 5e-3, 2.5e-3)
    coarse, fine = (
        disc_outline(flank, 25e-3 + play, 6, 52e-3, hole, 0.0, facets) for facets in (2 * first, 4 * first)
    )
    for a, b in zip(coarse.loops, fine.loops, strict=True):
        assert len(b.parameters()) - 1 == 2 * (len(a.parameters()) - 1)
        np.testing.assert_allclose(b.parameters()[::2], a.parameters(), rtol=1e-9, atol=1e-12)


@pytest.fixture(scope="module")
def small() -> Study:
    """Return the study of a small drive on the two levels that no budget forbids."""
    return study(scene(*SMALL), 1e-3)


@pytest.mark.exact
def test_numbers_are_those_of_a_run(small: Study) -> None:
    """Each rung on the finer level against a run whose scene names them."""
    for rung in ("level0", "strips"):
        run = Run(scene(*SMALL, f"accuracy.model={rung}", f"accuracy.facets_per_lobe={2 * COARSEST}"))
        step = next(j.step for j in small.steps if (j.step.rung, j.step.level) == (rung, 2 * COARSEST))
        for name in ASKED:
            found = {path: leaf.value for path, leaf in leaves(run.quantity(name))}
            assert {path: value for path, (value, _) in step.numbers[name].items()} == pytest.approx(
                found, rel=1e-9
            )


@pytest.mark.exact
def test_choice_is_that_of_a_run(small: Study) -> None:
    stages = Run(scene(*SMALL)).stages
    assert small.choice is not None
    assert stages.contact.level is not None
    assert (small.choice.pick.rung, small.choice.pick.level) == (
        stages.rung,
        stages.contact.level.facets_per_lobe,
    )


@pytest.mark.property
def test_better_rungs_and_levels_are_nearer_to_the_reference(small: Study) -> None:
    """Springs are off by per cents, elastic discs on eight facets by less; only springs have no level."""
    by_step = {(j.step.rung, j.step.level): j for j in small.steps}
    assert set(by_step) == {("springs", None), *((r, n) for r in ("level0", "strips") for n in (8, 16))}
    force = {key: judged.errors["contact_force_max"].size for key, judged in by_step.items()}
    assert force["springs", None] > 0.02 > force["level0", 8]
    assert small.reference is by_step["strips", 16]
    assert any("--budget" in remark for remark in small.remarks)


@pytest.mark.independent
def test_level_0_gives_way_where_contacts_conform() -> None:
    """Three rollers under a heavy load: Hertz's pressure is off by more than a quarter of the tolerance."""
    words = ("drive.output_pins.count=3", "operation.output_torque=4000", *SMALL)
    stages = Stages(scene(*words, "accuracy.tolerance=1e-2"), Clock())
    off = stages.model_error(stages.level(COARSEST))
    assert 0.0025 < off < 0.1
    assert stages.rung == "strips"
    assert Stages(scene(*words, "accuracy.tolerance=0.5"), Clock()).rung == "level0"


@pytest.mark.exact
def test_levels_are_those_of_a_run_or_about_the_named_one() -> None:
    assert levels(Stages(scene(), Clock())) == (8, 16, 32, 64)
    assert levels(Stages(scene("accuracy.facets_per_lobe=12"), Clock())) == (6, 12, 24, 48)
    assert levels(Stages(scene("accuracy.facets_per_lobe=100"), Clock())) == (50, 100, 200)


@pytest.mark.exact
def test_one_position_stands_for_a_turn() -> None:
    """The mean over the repeated position is the position."""
    series = Stages(scene(*SMALL, "accuracy.model=springs"), Clock()).contact.fine
    once: Any = repeated(series)
    assert once.torsional_stiffness[:-1].mean() == pytest.approx(series.torsional_stiffness[0])
    np.testing.assert_array_equal(once.ring.force[0], series.ring.force[0])

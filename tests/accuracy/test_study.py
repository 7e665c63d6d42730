"""Climbing the ladder: errors, seconds, budget, choice and what a tenth costs, on a drive with known errors."""

from __future__ import annotations

import math

import pytest

from tests.accuracy.conftest import LEVELS, MODEL, QUANTITIES, Made, Studied, seconds_of
from trochoid.accuracy.errors import errors, modelled
from trochoid.accuracy.measure import numbers
from trochoid.kinematics.errors import NotConverged, SceneError
from trochoid.results import Quantity


@pytest.mark.exact
def test_errors_are_those_against_the_best_rung_on_the_finest_level(studied: Studied) -> None:
    """The stiffness is off by twice the error of the force; the reference tells its own from the level before, and
    what is solved on the reference's mesh has that error of the mesh besides.
    """
    found = studied()
    true = Made("strips", LEVELS[-1]).error
    assert (found.reference.step.rung, found.reference.step.level) == ("strips", LEVELS[-1])
    for judged in found.steps:
        off = Made(judged.step.rung, judged.step.level).error
        if judged.estimated:
            assert judged.errors["contact_force_max"].size == pytest.approx(true, rel=1e-3)
            continue
        beside = judged.step.level == LEVELS[-1]
        own = {name: beside * error.size for name, error in found.reference.errors.items()}
        assert judged.errors["contact_force_max"].size == pytest.approx(
            abs(off - true) / (1 + true) + own["contact_force_max"]
        )
        assert judged.errors["torsional_stiffness"].size == pytest.approx(
            2 * abs(off - true) / (1 - 2 * true) + own["torsional_stiffness"]
        )
        assert judged.worst == "torsional_stiffness"
        assert judged.errors["contact_force_max"].part == "pins"


@pytest.mark.exact
def test_seconds_are_those_of_all_that_a_step_needs(studied: Studied) -> None:
    """Rungs on one level share its bodies; each pays for them."""
    for judged in studied().steps:
        level = judged.step.level
        assert judged.step.seconds == pytest.approx(1.0 + (0.0 if level is None else seconds_of(level)))


@pytest.mark.exact
def test_what_a_rung_cannot_answer_and_closed_forms_are_left_out(studied: Studied) -> None:
    found = studied()
    springs, meshed = found.steps[0], found.steps[1]
    assert springs.step.rung == "springs"
    assert set(springs.step.numbers) == {"contact_force_max", "torsional_stiffness"}
    assert set(meshed.step.numbers) == {"contact_force_max", "torsional_stiffness", "stress_max"}


@pytest.mark.property
def test_answer_that_is_not_found_is_said_and_the_rest_kept() -> None:
    """One quantity that fails costs that quantity alone; when all do, the step fails with the first reason."""

    def lost(made: Made) -> Quantity:
        raise NotConverged("lost")

    def kept(made: Made) -> Quantity:
        return Quantity(1.0, "N", model="strips")

    made = Made("strips", 8)
    assert numbers(made, {"a": lost, "b": kept}) == ({"b": {"": (1.0, "N")}}, {"a": "lost"})
    with pytest.raises(NotConverged, match="lost"):
        numbers(made, {"a": lost})


@pytest.mark.exact
def test_best_rung_that_fails_gives_way_to_the_next(
    studied: Studied, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where strips find nothing, errors are against level 0 on its finest level, and the reader hears it."""

    def refused(made: Made) -> Quantity:
        if made.rung == "strips":
            raise NotConverged("no strips")
        return Quantity(1.0 + made.error, "N", model=made.rung)

    for name in QUANTITIES:
        if name != "ratio":
            monkeypatch.setitem(QUANTITIES, name, refused)
    found = studied()
    assert (found.reference.step.rung, found.reference.step.level) == ("level0", LEVELS[-1])
    assert {judged.step.rung for judged in found.steps} == {"springs", "level0"}
    assert any("errors are against level0" in remark for remark in found.remarks)


@pytest.mark.exact
@pytest.mark.parametrize(("budget", "finest"), [(1e-3, 16), (17.0, 16), (18.0, 32), (53.0, 32), (54.0, 64)])
def test_budget_bounds_the_finest_level(studied: Studied, budget: float, finest: int) -> None:
    """Two levels at least; a level is begun only when it is expected to fit, and the reader hears why not."""
    found = studied(budget=budget)
    assert max(judged.step.level or 0 for judged in found.steps) == finest
    assert {judged.step.rung for judged in found.steps} == set(MODEL)
    said = [remark for remark in found.remarks if "--budget" in remark]
    assert bool(said) == (finest < LEVELS[-1])


@pytest.mark.property
def test_smaller_tolerances_pick_no_worse_a_step(studied: Studied) -> None:
    """The measured error of the choice never grows as the tolerance shrinks, and stays below it."""
    last = math.inf
    for tolerance in (3e-2, 1e-2, 3e-3, 1e-3, 3e-4):
        choice = studied(tolerance).choice
        assert choice is not None
        assert choice.judged.error is not None
        assert choice.judged.error <= min(tolerance, last)
        last = choice.judged.error
        assert choice.pick.levels[-1] == choice.judged.step.level
        solved = sum(seconds_of(level) + 1.0 for level in choice.pick.levels)
        assert choice.run_seconds == pytest.approx(solved)


@pytest.mark.exact
def test_choice_beyond_the_budget_is_said(studied: Studied) -> None:
    found = studied(1e-3, budget=1.0)
    assert found.choice is None
    assert any("strips with 32 facets per lobe or finer" in remark for remark in found.remarks)
    found = studied(1e-7)
    assert found.choice is None
    assert any("no level meets the tolerance: not with 64" in remark for remark in found.remarks)


@pytest.mark.exact
def test_a_tenth_is_measured_or_else_extrapolated(studied: Studied) -> None:
    """The cheapest step that is good enough; beyond the finest, levels double and seconds grow as they last did."""
    choice = studied(3e-2).choice
    assert choice is not None
    assert choice.tenth is not None
    assert choice.judged.error is not None
    assert choice.tenth.error == pytest.approx(0.1 * choice.judged.error)
    assert (choice.tenth.rung, choice.tenth.level, choice.tenth.measured) == ("level0", 64, True)
    choice = studied(2e-3, budget=18.0).choice
    assert choice is not None
    assert choice.tenth is not None
    assert (choice.judged.step.rung, choice.judged.step.level) == ("level0", 32)
    grows = (1 + seconds_of(32)) / (1 + seconds_of(16))
    assert (choice.tenth.rung, choice.tenth.level, choice.tenth.measured) == ("strips", 64, False)
    assert choice.tenth.seconds == pytest.approx((1 + seconds_of(32)) * grows)
    found = studied(2.5e-4)  # 256 facets per lobe, which no scene may name
    assert found.choice is not None
    assert found.choice.tenth is None
    assert any("256 facets per lobe, more than the 200" in remark for remark in found.remarks)


@pytest.mark.exact
def test_independent_model_checks_the_reference(studied: Studied) -> None:
    found = studied(oracle=True)
    assert found.check is not None
    assert found.check.seconds == 40.0
    off = Made("strips", 64).error - Made("strips", 1000).error
    assert found.check.errors["contact_force_max"].size == pytest.approx(off, rel=1e-3)
    assert studied().check is None


@pytest.mark.property
def test_closed_forms_have_no_price(studied: Studied) -> None:
    with pytest.raises(SceneError, match=r"no model of the contacts stands behind ratio: .* ask for"):
        studied(ask=("ratio",))


@pytest.mark.exact
def test_error_of_a_small_part_is_relative_to_its_like() -> None:
    """A part below a tenth of the largest of its unit is measured by that tenth; nothing is divided by zero."""
    reference = {"q": {"large": (100.0, "N"), "small": (1.0, "N"), "turn": (1e-3, "rad"), "zero": (0.0, "m")}}
    found = {"q": {"large": (101.0, "N"), "small": (2.0, "N"), "turn": (1e-3, "rad"), "zero": (1.0, "m")}}
    assert errors(found, reference)["q"].size == pytest.approx(0.1)
    assert errors(found, reference)["q"].part == "small"
    assert errors(found, reference, share=0.5)["q"].size == pytest.approx(0.05)
    assert errors({"q": {"large": (math.nan, "N")}}, reference) == {}


@pytest.mark.exact
def test_numbers_of_a_model_are_found_among_parts() -> None:
    quantity = Quantity(
        parts={
            "a": {"b": Quantity(1.0, "N", model="strips"), "place": Quantity(2.0, "mm")},
            "c": Quantity(3.0, model="exact"),
            "d": Quantity("none", model="strips"),
        }
    )
    assert modelled(quantity) == {"a.b": (1.0, "N")}
    assert modelled(Quantity(4.0, "N", model="level0")) == {"": (4.0, "N")}

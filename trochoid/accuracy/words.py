"""The study in words and cells, shared by the terminal and the page."""

from __future__ import annotations

from collections.abc import Iterator

from trochoid.accuracy.study import Choice, Judged, Study
from trochoid.results import text

NONE = "–"


def percent(error: float | None) -> str:
    """Return a relative error: "41 %", "1.2 %", "0.013 %"."""
    return NONE if error is None else f"{digits(error)} %"


def digits(error: float) -> str:
    """Return a relative error in percent, two digits of it, without the sign."""
    size = 100.0 * error
    if size >= 9.95:
        return f"{size:.0f}"
    return f"{size:.2g}" if size >= 0.9999e-4 or size == 0.0 else "<0.0001"


def seconds(value: float) -> str:
    """Return seconds with two or three digits that mean something."""
    return f"{value:.2f}" if value < 9.995 else f"{value:.1f}" if value < 99.95 else f"{value:.0f}"


def level(judged: Judged) -> str:
    """Return the mesh level, a dash where there is none."""
    return NONE if judged.step.level is None else str(judged.step.level)


def step_name(study: Study, rung: str, level: int | None) -> str:
    """Return "level0 with 16 facets per lobe"."""
    return rung if level is None else f"{rung} with {level} {study.unit}"


def worst(judged: Judged) -> str:
    """Return the quantity that has the largest error, with its part."""
    name = judged.worst
    return "" if name is None else quantity(name, judged.errors[name].part)


def quantity(name: str, part: str) -> str:
    """Return "Largest contact force · ring pins"."""
    return " · ".join([text.label(name), *(part.replace("_", " ").split(".") if part else [])])


def remark(study: Study, judged: Judged) -> str:
    """Return what a reader must know of a step."""
    if judged.estimated:
        return "reference (estimated)"
    if study.choice is not None and study.choice.judged is judged:
        return f"← tolerance {study.tolerance:g} picks this"
    if judged.step.level is None:
        return "model error: no mesh helps"
    return ""


def sentences(study: Study) -> Iterator[str]:
    """Yield what the study found, a sentence each, for one who has never seen one."""
    if study.choice is not None:
        yield from _choice(study, study.choice)
    check = study.check
    if check is not None and check.errors:
        name = max(check.errors, key=lambda key: check.errors[key].size)
        yield (
            f"{check.what} ({seconds(check.seconds)} s) and the reference differ by at most "
            f"{percent(check.errors[name].size)} ({quantity(name, check.errors[name].part)})."
        )
    yield from study.remarks


def _choice(study: Study, choice: Choice) -> Iterator[str]:
    pick, judged = choice.pick, choice.judged
    name = step_name(study, pick.rung, pick.level)
    who = "The scene names" if pick.named else f"Tolerance {study.tolerance:g} picks"
    guessed = "" if pick.estimate is None else f", {percent(pick.estimate)} estimated beforehand"
    yield f"{who} {name}: error {percent(judged.error)} measured{guessed}, {seconds(judged.step.seconds)} s."
    if len(pick.levels) > 1:
        levels = " and ".join(str(level) for level in pick.levels)
        yield (
            f"A run takes {seconds(choice.run_seconds)} s: it solves {levels} {study.unit}, and tells its error "
            "from their difference."
        )
    if choice.tenth is not None:
        other = choice.tenth
        yield (
            f"A tenth of that error ({percent(other.error)}) costs {'' if other.measured else 'about '}"
            f"{seconds(other.seconds)} s: {step_name(study, other.rung, other.level)}"
            f"{'' if other.measured else ', extrapolated'}."
        )
    over = [
        f"{quantity(key, error.part)} {percent(error.size)}"
        for key, error in judged.errors.items()
        if error.size > study.tolerance
    ]
    if over:
        yield (
            f"Above the tolerance there: {'; '.join(over)}. The tolerance is for the largest forces and pressures, "
            "the stiffness and the mean twist; small differences of large numbers need a smaller one."
        )

"""TOML text to plain dictionaries, with every line that is not TOML as a fault of its own."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from trochoid.faults import Fault, SceneFaults

_PLACE = re.compile(r" \(at (?:line (\d+), column \d+|end of document)\)$")
_MOST = 20


def parse(text: str, source: str) -> dict[str, Any]:
    """Return the tables of `text`; raises SceneFaults with every line that cannot be read."""
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise SceneFaults(_syntax_faults(text, source, error)) from None


def _syntax_faults(text: str, source: str, error: Exception) -> list[Fault]:
    """Return the fault found, then those that show when its line is taken away and stand alone."""
    lines = text.split("\n")
    found: list[Fault] = []
    problem: Exception | None = error
    while problem is not None and len(found) < _MOST:
        last = max((i for i, line in enumerate(lines, 1) if line.strip()), default=1)
        message, number = _message(problem, last)
        if number is None:
            return [*found, Fault((), f"not TOML: {message}", source)]
        if found and not _stands_alone(lines[number - 1], message):
            break
        found.append(Fault((), f"not TOML: {message}", f"{source}:{number}"))
        lines[number - 1] = ""
        problem = _problem("\n".join(lines))
    return found


def _problem(text: str) -> Exception | None:
    try:
        tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        return error
    return None


def _message(error: Exception, last: int) -> tuple[str, int | None]:
    """Return what is wrong, and the line if the parser says it: `last` for the end of the text."""
    if isinstance(error, RecursionError):
        return "lists or tables nested too deeply", None
    text = str(error)
    place = _PLACE.search(text)
    if place is None:
        return ("a number with too many digits" if "digits" in text else text), None
    message = text[: place.start()]
    return message[:1].lower() + message[1:], min(int(place.group(1) or last), last)


def _stands_alone(line: str, message: str) -> bool:
    """Return whether a line is wrong by itself, and not in the wake of a bracket or quote left open above."""
    repeated = message.startswith(("cannot overwrite", "cannot declare", "cannot mutate"))
    return repeated or _problem(line) is not None

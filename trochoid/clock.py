"""Times the stages of a run; time spent in a stage that another one calls for counts for the inner one only."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter


@dataclass(frozen=True, slots=True)
class Clock:
    """Seconds by stage, in the order of first use; `announce` hears a stage's name when it begins."""

    announce: Callable[[str], None] = lambda stage: None
    seconds: dict[str, float] = field(default_factory=dict)
    _inner: list[float] = field(default_factory=list)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time the block as (part of) a stage."""
        self.announce(name)
        self.seconds.setdefault(name, 0.0)
        self._inner.append(0.0)
        begin = perf_counter()
        try:
            yield
        finally:
            spent = perf_counter() - begin
            self.seconds[name] += spent - self._inner.pop()
            if self._inner:
                self._inner[-1] += spent

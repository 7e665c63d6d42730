"""The answer stress_max: it is in the fields, where it says, and what Hertz says of the hardest contact."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from trochoid import Run
from trochoid import load as scene_of
from trochoid.drives.khv.picture import stress_film
from trochoid.results.outcome import Quantity

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
NU = 0.3


@lru_cache(maxsize=4)
def run(model: str, *more: str) -> Run:
    """Return a run of the example at one position, on coarse meshes."""
    few = ("ask.positions=1", "accuracy.facets_per_lobe=8", 'ask.quantities=["stress_max"]')
    return Run(scene_of(EXAMPLE, (*few, f'accuracy.model="{model}"', *more)))


def part(found: Run, *names: str) -> Quantity:
    """Return a part of the answer."""
    at = found.quantity("stress_max").parts
    assert at is not None
    for name in names[:-1]:
        at = at[name]  # type: ignore[assignment]
    answer = at[names[-1]]
    assert isinstance(answer, Quantity)
    return answer


def number(found: Run, *names: str) -> float:
    """Return the value of a part."""
    value = part(found, *names).value
    assert isinstance(value, float)
    return value


@pytest.mark.property
@pytest.mark.parametrize("model", ["level0", "strips"])
@pytest.mark.parametrize("fixed", ["ring", "output"])
def test_answer_is_in_the_fields(model: str, fixed: str) -> None:
    """Largest value of the files, at the node and on the disc that the answer names, also where the ring turns."""
    found = run(model, f'drive.fixed="{fixed}"', "ask.stress_position=40")
    ((_, bodies),) = stress_film(found.stages).frames
    for name in ("von_mises", "max_shear"):
        body = bodies[int(number(found, name, "disc")) - 1]
        values = body.point_data[name]
        node = int(np.argmax(np.where(np.isin(np.arange(len(values)), body.cells), values, 0.0)))
        assert number(found, name, "stress") == pytest.approx(1e-6 * values[node], rel=1e-12)
        place = [number(found, name, "x"), number(found, name, "y")]
        assert place == pytest.approx(list(1e3 * body.points[node, :2]), rel=1e-12)
        assert max(b.point_data[name][np.unique(b.cells)].max() for b in bodies) == values[node]


@pytest.mark.published
def test_stress_is_that_of_hertz_below_the_hardest_contact() -> None:
    """0.300 p0 at 0.786 a and 0.558 p0 at 0.70 a (Johnson 4.4) of the hardest contact; the disc adds 3 %."""
    found = run("strips")
    series = found.stages.contact.fine
    hard = max((series.ring, series.output), key=lambda touches: float(touches.pressure[0].max()))
    best = np.unravel_index(hard.pressure[0].argmax(), hard.pressure[0].shape)
    peak, half = float(hard.pressure[0][best]), float(hard.half_width[0][best])
    for name, share, deep in (("max_shear", 0.300283, 0.786), ("von_mises", 0.5577, 0.70)):
        assert 1e6 * number(found, name, "stress") == pytest.approx(share * peak, rel=0.03)
        assert 1e-3 * number(found, name, "depth") == pytest.approx(deep * half, rel=0.05)


@pytest.mark.independent
def test_strips_and_level_0_agree() -> None:
    """Hertzian contacts: two models of the same pressure, 0.3 % apart."""
    for name in ("von_mises", "max_shear"):
        assert number(run("strips"), name, "stress") == pytest.approx(
            number(run("level0"), name, "stress"), rel=3e-3
        )


@pytest.mark.property
def test_estimated_error() -> None:
    """Stress and depth carry the difference of two meshes; a finer one lies within it, or within 0.05 %."""
    coarse, fine = run("level0"), run("level0", "accuracy.facets_per_lobe=16")
    for name in ("von_mises", "max_shear"):
        stress = part(coarse, name, "stress")
        assert stress.error is not None
        difference = abs(number(coarse, name, "stress") - number(fine, name, "stress"))
        assert difference < max(stress.error, 5e-4 * number(fine, name, "stress"))
        assert part(coarse, name, "depth").error is not None
        assert part(coarse, name, "x").error is None

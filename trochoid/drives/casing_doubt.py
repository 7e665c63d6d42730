"""What a reader must know of an elastic casing's numbers: that one mesh tells no error, or that it is a large one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from trochoid.drives.mesh_error import Pair, scalar_error
from trochoid.drives.vibration import CasingVibration
from trochoid.drives.vibration_read import Read, frequency, told_frequencies, velocity_at
from trochoid.results.text import value_and_error
from trochoid.scene import Scene

STILL = 1e-6  # of the largest frequency: those of a body that nothing holds
Number = tuple[str, str, Read]


def casing_warnings(scene: Scene[Any], levels: Pair[CasingVibration]) -> tuple[str, ...]:
    """Return what is to be warned of: no second mesh, or errors above the tolerance of the scene."""
    found = levels.fine
    if not found.casing.elastic:
        return ()
    if found.casing.alone:
        return (
            "the casing has no coarser mesh that would tell the errors of its numbers, which have none here: "
            f"{found.casing.alone}; another casing.mesh_edge may have one",
        )
    if found.casing.edge is None or levels.coarse is None:
        return ()
    doubtful = []
    for said, unit, get in _numbers(found):
        value, error = get(found), scalar_error(get(found), get(levels.coarse))
        if error > scene.accuracy.tolerance * abs(value) > 0.0:
            shown, margin = value_and_error(value, error)
            doubtful.append((error / abs(value), f"{said}, {shown} ± {margin} {unit}"))
    if not doubtful:
        return ()
    worst, words = max(doubtful)
    more = f" and {len(doubtful) - 1} more of the casing's numbers have" if len(doubtful) > 1 else " has"
    return (
        f"{words} ({100.0 * worst:.2g} %){more} an error above accuracy.tolerance = {scene.accuracy.tolerance:g}; a "
        f"casing.mesh_edge below {1e3 * found.casing.edge:.4g} mm lowers what its mesh adds",
    )


def _numbers(found: CasingVibration) -> Iterator[Number]:
    """Yield the worst velocities at each point, mm/s, and the natural frequencies, Hz, with their names."""
    for i, point in enumerate(found.elastic.points):
        yield f"worst at {point.name}", "mm/s", velocity_at(i)
        for name in found.others:
            yield f"worst_{name} at {point.name}", "mm/s", velocity_at(i, other=name)
    hertz = told_frequencies(found)
    for i, each in enumerate(hertz):
        if each > STILL * hertz[-1]:
            yield f"mode_{i + 1} of casing_frequencies", "Hz", frequency(i)

"""The answer about stress: in the discs at one position, and in the fillets of the first stage."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.mesh_error import Pair
from trochoid.drives.rv.numbers import number
from trochoid.drives.rv.stages import Stages
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.rv.field import DiscStress
    from trochoid.fem.stress_peak import Peak


def stress_max(s: Stages) -> Quantity:
    """Largest von Mises and shear stress of the discs at the stress position, and largest tension in tooth fillets."""
    angle = float(np.degrees(s.field.fine[0].state.angle))
    near = "the strips" if s.rung == "strips" else "Hertz's pressure"
    parts: dict[str, Quantity | Parts] = {
        "von_mises": _peak(s, lambda disc: disc.state.field.von_mises_peak),
        "max_shear": _peak(s, lambda disc: disc.state.field.max_shear_peak),
        "von_mises_near": {
            edge: _number(s, s.field.map(_near(edge)), "MPa") for edge in s.field.fine[0].nearest
        },
        "root_sun": _root(s, 0),
        "root_planet": _root(s, 1),
    }
    note = (
        f"discs at input angle {angle:g}°: below the contacts from {near} in closed form, the rest by finite elements; "
        "place in the fixed frame; near: by the edge that is closest; root: tension in the fillets of the first stage "
        "over a base pitch, when all planets carry alike"
    )
    return Quantity(parts=parts, note=note)


def _near(edge: str) -> Callable[[tuple[DiscStress, ...]], float]:
    return lambda discs: 1e-6 * max(disc.nearest[edge] for disc in discs)


def _root(s: Stages, wheel: int) -> Quantity:
    both = s.roots.map(lambda found: 1e-6 * float(found[wheel].max()))
    return number(s, both.fine, both, "MPa", "level0")


def _number(s: Stages, both: Pair[float], unit: str) -> Quantity:
    return number(s, both.fine, both, unit)


def _peak(s: Stages, get: Callable[[DiscStress], Peak]) -> Parts:
    """Return the largest stress among the discs, how deep it lies, and where."""
    from trochoid.drives.disc_field import turned
    from trochoid.drives.rv.picture import carrier_angle

    peak = s.field.map(lambda discs: max((get(disc) for disc in discs), key=lambda peak: peak.value))
    i = next(k for k, disc in enumerate(s.field.fine) if get(disc) is peak.fine)
    state = s.field.fine[i].state
    x, y = 1e3 * turned(state.points[peak.fine.node, :2], carrier_angle(s.design, state.angle))
    return {
        "stress": _number(s, peak.map(lambda p: 1e-6 * p.value), "MPa"),
        "depth": _number(s, peak.map(lambda p: 1e3 * p.depth), "mm"),
        "disc": Quantity(float(1 + i)),
        "x": Quantity(float(x), "mm"),
        "y": Quantity(float(y), "mm"),
    }

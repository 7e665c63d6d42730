"""Pictures of pin and slot as elastic bodies: pressure along the pin, stiffness along the slot."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from trochoid.drives.indexer.pin import Pair, presses
from trochoid.drives.indexer.words import NAMES
from trochoid.fem.pin_slot import press
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array
from trochoid.results.plot import Axis, Plot, PlotCurve

PLACES = 61


def slot_plots(pairs: Mapping[str, Pair]) -> list[Plot]:
    """Return the pictures of all pairs whose pin carries anything."""
    loaded = {name: x for name, x in pairs.items() if x.largest[0] > 0.0}
    if not loaded:
        return []
    found = [] if any(x.pin.shape == "barrel" for x in loaded.values()) else [_pressure(loaded)]
    return [*found, _stiffness(loaded)] if any(x.elastic for x in loaded.values()) else found


def _pressure(pairs: Mapping[str, Pair]) -> Plot:
    curves = []
    for name, x in pairs.items():
        half = x.forces.indexer.half_turn
        t = np.array([-half, x.largest[1], half])
        pressed = x.state(t).pressed.pressure
        places = _distances(x)
        for row, what in zip(pressed, ("at the start", "at the largest force", "at the end"), strict=True):
            if row.max() > 0.0:
                curves.append(PlotCurve(f"{NAMES[name]}, {what}", np.stack([places, row], axis=-1)))
    caption = (
        "Largest pressure of each slice along the pin, from the end at which it is held; under the forces of the rigid "
        "drive. A sharp end presses more than its last slice says."
    )
    axes = (Axis("distance from the centre of the sphere", "m"), Axis("pressure", "Pa"))
    return Plot("Pressure along the pin", axes, tuple(curves), (), caption, equal=False)


def _distances(pair: Pair) -> Array:
    if pair.elastic is not None:
        return pair.elastic.rho
    count = press(pair.pin, np.zeros(1)).force.shape[1]
    share = (np.arange(count) + 0.5) / count - 0.5
    return np.asarray(pair.pin.distance + pair.pin.thickness * share)


def _stiffness(pairs: Mapping[str, Pair]) -> Plot:
    curves = []
    for name, x in pairs.items():
        if x.elastic is None:
            continue
        reach = np.linspace(*x.law.ends, PLACES)
        moment = np.full(PLACES, x.largest[0] * x.pin.distance)
        for what, law in (("", presses(x.pin, x.elastic)), (", rigid wheel", presses(x.pin, None))):
            u = x.law.pressed(moment, reach)
            try:
                for _ in range(3):  # the moment is nearly a line over u
                    u = u * moment / law(u, reach).moment
                slope = law(u, reach).slope / x.pin.distance**2
            except NotConverged:  # out of all proportion: what is beside has nothing to tell
                continue
            style = "dashed" if what else "line"
            curves.append(PlotCurve(f"{NAMES[name]}{what}", np.stack([reach, slope], axis=-1), style=style))
    caption = (
        "Stiffness of pin and wall along the normal of the slot under the largest pin force, from where the pin is "
        "deepest in its slot to the mouth: there the wall bends most. Dashed: a wheel that yields as half-spaces do."
    )
    axes = (Axis("angle from the wheel's axis to the pin", "rad"), Axis("stiffness", "N/m"))
    return Plot("Stiffness along the slot", axes, tuple(curves), (), caption, equal=False)

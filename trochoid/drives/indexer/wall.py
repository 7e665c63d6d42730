"""The slotted wheel and the pin of a scene as elastic bodies, on one mesh level or two."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from trochoid.drives.indexer.design import INDEXER, Design
from trochoid.drives.indexer.feasible import slot_length
from trochoid.drives.indexer.wheel import hub_angle
from trochoid.fem.cone_slices import between
from trochoid.fem.pin_slot import Pin
from trochoid.fem.slot_contact import ElasticPair
from trochoid.fem.slot_pin import PinBody, press_pin
from trochoid.fem.slot_wall import WallMesh, press_stations, wall_body
from trochoid.geometry.slotted import SlottedWheel
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.indexer_slot import Slot
from trochoid.scene.drive_indexer import IndexerScene

LEVELS = (4, 6, 9)  # facets over the wheel's thickness
AROUND = 4  # facets round the pin for each of them
RIGID, ELASTIC = "rigid_wheel", "elastic_wheel"
LEAST = 3


@dataclass(frozen=True, eq=False, slots=True)
class Bodies:
    """The pair of each mechanism on the finer of two mesh levels and on the coarser; `facets`: on the finest of all.

    None in place of pairs where the wheel is rigid; `refusal` says why, where the scene did not ask for that.
    """

    fine: Mapping[str, ElasticPair] | None
    coarse: Mapping[str, ElasticPair] | None
    facets: int = 0
    refusal: str = ""


def slotted(design: Design, slot: Slot, name: str) -> SlottedWheel:
    """Return the wheel of a mechanism, held at its hub; one without a hub half-way to the bottom of its slots."""
    drive = design.drive
    given = drive.wheel.slot_length if name == INDEXER else None
    length = given or slot_length(design, slot)
    bottom = slot.farthest - length / drive.sphere_radius + design.pin_angle
    free = bottom - design.pin_angle
    hub = hub_angle(design) or 0.5 * free
    if name != INDEXER:  # beside the drive's wheel stands one that may need a smaller hub
        hub = min(hub, 0.8 * free)
    return SlottedWheel(slot.farthest, bottom, hub, design.pin_angle, drive.swing_angle, max(1, design.slots))


@dataclass(frozen=True, slots=True)
class Maker:
    """Makes pairs on any level; the pin's body is the same for all mechanisms."""

    design: Design
    slots: Mapping[str, Slot]
    pin: Pin
    made: dict[int, PinBody] = field(default_factory=dict)

    def pair(self, name: str, facets: int) -> ElasticPair:
        """Mesh, factor and press pin and wheel of a mechanism."""
        pin, mesh, half = self.pin, WallMesh(facets), 0.5 * self.pin.thickness
        ends = pin.distance - half, pin.distance + half
        if facets not in self.made:
            layers = between(mesh.radial(ends).breaks)
            self.made[facets] = press_pin(pin, layers, max(12, AROUND * facets), mesh.parts)
        slot = self.slots[name]
        body = wall_body(slotted(self.design, slot, name), ends, slot.nearest, pin.material, mesh)
        point = pin.distance if pin.shape == "barrel" else None
        return ElasticPair(pin, self.made[facets], press_stations(body, mesh.parts, point))


def bodies(
    scene: IndexerScene,
    design: Design,
    slots: Mapping[str, Slot],
    pin: Pin,
    error: Callable[[ElasticPair, ElasticPair, str], float],
) -> Bodies:
    """Return the pairs, each on the coarsest levels that meet the tolerance, or on the finest there is.

    `error(fine, coarse, name)` is the relative error of a mechanism's stiffness.  Where the scene names no model, a
    wheel that cannot be meshed counts as rigid.
    """
    accuracy = scene.accuracy
    if accuracy.model == RIGID:
        return Bodies(None, None)
    named = accuracy.facets_per_lobe
    levels = LEVELS if named is None else (max(LEAST, 2 * named // 3), named)
    maker, most = Maker(design, slots, pin), 0
    fine: dict[str, ElasticPair] = {}
    coarse: dict[str, ElasticPair] = {}
    try:
        for name in slots:
            fine[name] = maker.pair(name, levels[0])
            for facets in levels[1:]:
                coarse[name], fine[name] = fine[name], maker.pair(name, facets)
                most = max(most, facets)
                if error(fine[name], coarse[name], name) <= accuracy.tolerance:
                    break
    except (TrochoidError, np.linalg.LinAlgError) as fault:
        if accuracy.model == ELASTIC:
            raise
        return Bodies(None, None, refusal=str(fault))
    return Bodies(fine, coarse, most)

"""The slotted wheel of a film: its finite elements with their stress, or its shape alone where it counts as rigid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.indexer.design import INDEXER, Design
from trochoid.drives.indexer.film_bodies import wheel
from trochoid.drives.indexer.outline import to_space, turned
from trochoid.drives.indexer.wall import slotted
from trochoid.fem.cone_stress import nodal_stress, stress_rule, von_mises
from trochoid.fem.cone_strip import side_displacement
from trochoid.fem.cone_surface import tooth_surface
from trochoid.fem.pin_slot import Pin
from trochoid.fem.slot_contact import ElasticPair
from trochoid.fem.slot_field import wall_displacement, wall_loads, wall_places
from trochoid.fem.slot_wall import WallMesh, wall_body
from trochoid.kinematics.indexer_slot import Slot
from trochoid.kinematics.types import Array, IntArray
from trochoid.results.film import Field, Shape

MOST_FACETS = 6  # over the wheel's thickness: finer meshes are not shown
GLASS, CLEAR = ("#7b97b3", 0.3), 0.8


@dataclass(frozen=True, eq=False, slots=True)
class Wheel:
    """Its surface, axis along z, slot towards x: `points` (k, 3) m, `cells`; what each frame does to it, if elastic.

    `deformation` (n, k, 3) m and von Mises `stress` (n, k) Pa, under a pin that presses the wall towards growing ψ;
    `at_wall` (n, layer nodes, 3) m what the wall does under the pin, at distances `rays` (layer nodes,) m.
    """

    points: Array
    cells: IntArray
    deformation: Array | None = None
    stress: Array | None = None
    at_wall: Array | None = None
    rays: Array | None = None

    def field(self, design: Design, psi: float, lag: Array, frame: int | None, way: float) -> Field:
        """Return the wheel at ψ (rad), behind by the rotation `lag` (3,), under the pin of a frame, None without.

        `way` −1 where the pin presses the other wall: all is mirrored then.
        """
        points = _placed(design, self.points, psi, way)
        cells = self.cells
        if way > 0.0:  # the wheel's frame is a mirror image of space's
            cells = cells[[0, 2, 1, 5, 4, 3][: len(cells)]]
        rigid = np.cross(lag, points)
        if self.deformation is None or self.stress is None:
            return _field(points, cells, {"displacement": rigid}, GLASS)
        moved = np.zeros_like(points)
        if frame is not None:
            moved = _placed(design, self.deformation[frame], psi, way)
        stress = np.zeros(len(points)) if frame is None else self.stress[frame]
        data = {"displacement": rigid + moved, "deformation": moved, "von_mises": stress}
        return _field(points, cells, data, (GLASS[0], CLEAR))

    def under_pin(self, design: Design, psi: float, frame: int, way: float, distance: Array) -> Array:
        """Return the deformation (k, 3), m, of the wall under the pin of a frame at distances (k,) from the centre."""
        if self.at_wall is None or self.rays is None:
            return np.zeros((len(distance), 3))
        local = [np.interp(distance, self.rays, self.at_wall[frame, :, i]) for i in range(3)]
        return _placed(design, np.stack(local, axis=-1), psi, way)


def rigid_wheel(design: Design, slot: Slot) -> Wheel:
    """Return the wheel as the scene has it."""
    solid = wheel(design, slot)
    return Wheel(solid.points, solid.cells)


def elastic_wheel(
    design: Design, slot: Slot, pin: Pin, pair: ElasticPair, facets: int, reach: Array, force: Array
) -> Wheel:
    """Return the wheel of finite elements under contacts at angles `reach` (n,) with `force` (n, f) N on slices.

    It has slots of rays, as its elements do: those of a cylinder are narrower inside than the pin by half the wheel's
    thickness over the sphere's radius.
    """
    half = 0.5 * pin.thickness
    ends = pin.distance - half, pin.distance + half
    made = wall_body(
        slotted(design, slot, INDEXER), ends, slot.nearest, pin.material, WallMesh(min(facets, MOST_FACETS))
    )
    body = made.body
    slices = None if pin.shape == "barrel" else pair.wall.slices
    moved = wall_displacement(made, wall_loads(made, slices, reach.tolist(), force))
    rule = stress_rule(body)
    surface = tooth_surface(body, tuple(body.mesh.edges))
    at = (surface.plane, surface.layer)
    rays = body.radial.nodes
    place, distance = np.repeat(wall_places(made, reach), len(rays)), np.tile(rays, len(reach))
    which = np.repeat(np.arange(len(reach)), len(rays))
    under = side_displacement(made.side, body.radial, moved, which, place, distance)
    return Wheel(
        surface.points(body),
        surface.cells,
        np.array([one[at] for one in moved]),
        np.array([von_mises(nodal_stress(rule, one)[at]) for one in moved]),
        under.reshape(len(reach), len(rays), 3),
        rays,
    )


def _placed(design: Design, vectors: Array, psi: float, way: float) -> Array:
    """Return vectors (k, 3) of the wheel's frame, mirrored where `way` is −1, in space with the wheel at ψ."""
    return to_space(turned(vectors * [1.0, way, 1.0], psi), design.indexer)


def _field(points: Array, cells: IntArray, data: dict[str, Array], look: tuple[str, float]) -> Field:
    single = {key: np.asarray(x, dtype=np.float32) for key, x in data.items()}
    shape: Shape = "triangle" if len(cells) == 3 else "triangle6"
    return Field("wheel", np.asarray(points, dtype=np.float32), cells, single, shape, *look)

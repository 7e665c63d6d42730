"""The slotted wheel of an indexer as a STEP file, and the points of its outline."""

from __future__ import annotations

from pathlib import Path

from trochoid.clock import Clock
from trochoid.scene.drive_indexer import IndexerScene


def write_wheel(scene: IndexerScene, path: Path) -> str:
    """Write the slotted wheel; raises Infeasible for one that cannot be made."""
    from trochoid.drives.indexer.design import INDEXER
    from trochoid.drives.indexer.stages import Stages
    from trochoid.drives.indexer.wall import slotted
    from trochoid.geometry.ray_solid import wheel_solid
    from trochoid.geometry.step import write_step

    stages = Stages(scene, Clock())
    made = stages.feasible
    half, radius = 0.5 * made.drive.wheel.thickness, made.drive.sphere_radius
    wheel = slotted(made, stages.slots[INDEXER], INDEXER)
    solid = wheel_solid(wheel, radius - half, radius + half)
    write_step(solid, path)
    return f"slotted wheel, {1e6 * solid.volume:.6g} cm3, its axis along z, the first slot towards x, mm"


def write_outline(scene: IndexerScene, path: Path) -> str:
    """Write the points of the wheel's outline on the sphere, m, its axis along z."""
    from trochoid.drives.indexer.design import INDEXER
    from trochoid.drives.indexer.outline import outline
    from trochoid.drives.indexer.stages import Stages
    from trochoid.results.table import write_table

    stages = Stages(scene, Clock())
    made = stages.feasible
    points = made.drive.sphere_radius * outline(made, stages.slots[INDEXER])
    return write_table(path, {f"wheel_{name} [m]": points[:, i] for i, name in enumerate("xyz")})


WRITERS = {
    ".csv": ("points of the wheel's outline", write_outline),
    ".step": ("the slotted wheel as a solid", write_wheel),
    ".stp": ("the same", write_wheel),
}

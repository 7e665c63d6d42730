"""The lobed member of a precessional drive as a STEP file: its exact flanks on the cone that holds them."""

from __future__ import annotations

from pathlib import Path

from trochoid.clock import Clock
from trochoid.kinematics.errors import Infeasible
from trochoid.scene.drive_precessional import PrecessionalScene

TOLERANCE = 1e-6  # m


def write_rim(scene: PrecessionalScene, path: Path) -> str:
    """Write the toothed rim; raises Infeasible for a drive that cannot be made, or without teeth."""
    from trochoid.drives.precessional.rim import rim_shape, toothed
    from trochoid.drives.precessional.stages import Stages
    from trochoid.geometry.ray_solid import rim_solid
    from trochoid.geometry.step import write_step

    made = Stages(scene, Clock()).feasible
    if made.tooth is None:
        raise Infeasible("nothing to write: the scene has no teeth, the table [drive.teeth]")
    _, teeth = toothed(made)
    solid = rim_solid(rim_shape(made), teeth.inner_radius, teeth.outer_radius)
    points = write_step(solid, path, TOLERANCE)
    member = "satellite" if made.tooth.pins_on == "ring" else "wheel"
    return (
        f"toothed rim of the {member}, {1e6 * solid.volume:.6g} cm3, in its own frame, mm; flanks through {points} "
        f"points, within {1e6 * TOLERANCE:g} um"
    )


WRITERS = {".step": ("the toothed rim as a solid", write_rim), ".stp": ("the same", write_rim)}

"""The theoretical flank of a cycloid disc as points."""

from __future__ import annotations

from pathlib import Path

from trochoid.clock import Clock
from trochoid.scene.drive_khv import KhvScene


def write_flank(scene: KhvScene, path: Path) -> str:
    """Write parameter, points, curvature and pressure angle, SI; raises Infeasible for a disc that cannot be made."""
    from trochoid.drives.khv.dataset import dataset
    from trochoid.drives.khv.stages import Stages
    from trochoid.results.table import write_table

    stages = Stages(scene, Clock())
    _ = stages.feasible
    found = dataset(stages, ("geometry",))
    series = {} if found is None else {str(name): values for name, values in found.data_vars.items()}
    chosen = {name: values for name, values in series.items() if name.startswith("profile")}
    return write_table(
        path, {f"{name} [{values.attrs['units']}]": values.values for name, values in chosen.items()}
    )


WRITERS = {".csv": ("points of the theoretical flank", write_flank)}

"""`trochoid export`: exact shapes as files for other programs, by the ending of the name.

Every kind writes its profiles as `.csv`; what else a kind writes stands in its folder's `export.py`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from trochoid.kinematics.errors import SceneError
from trochoid.scene import Scene

Writer = Callable[[Scene[Any], Path], str]


def export(scene: Scene[Any], path: Path) -> str:
    """Write the file and return what was written; raises SceneError for an ending that the kind does not offer."""
    offered = writers(scene.drive.type)
    ending = path.suffix.lower()
    if ending not in offered:
        known = ", ".join(f"{name} ({said})" for name, (said, _) in offered.items())
        given = f"given the ending {ending!r}" if ending else "the name has no ending"
        raise SceneError(f"--to {path}: {given}; the kind {scene.drive.type} offers {known}")
    if path.is_dir():
        raise SceneError(f"--to {path}: that is a folder; give the name of a file")
    if not path.parent.is_dir():
        raise SceneError(f"--to {path}: there is no folder {path.parent}; make it first, or name another")
    return offered[ending][1](scene, path)


def writers(kind: str) -> Mapping[str, tuple[str, Writer]]:
    """Return what each ending holds, and who writes it."""
    common: dict[str, tuple[str, Writer]] = {".csv": ("points of the profiles, SI", write_csv)}
    name = f"trochoid.drives.{kind}.export"
    own = import_module(name).WRITERS if find_spec(name) else {}
    return {**common, **own}


def write_csv(scene: Scene[Any], path: Path) -> str:
    """Write the points of all profiles of a scene, as its series have them."""
    from trochoid.results.table import write_table
    from trochoid.run import Run

    asked = scene.model_copy(
        update={"ask": scene.ask.model_copy(update={"quantities": ("profile", "geometry_quality")})}
    )
    dataset = Run(asked).outcome.dataset
    columns: dict[str, Any] = {}
    for name, values in {} if dataset is None else dataset.data_vars.items():
        if "profile" not in str(name):
            continue
        unit = values.attrs.get("units", "")
        parts = values.values.reshape(len(values), -1).T
        names = [str(name)] if len(parts) == 1 else [f"{name}_{x}" for x in values[values.dims[1]].values]
        columns |= {
            f"{each} [{unit}]" if unit else each: part for each, part in zip(names, parts, strict=True)
        }
    if not columns:
        raise SceneError(f"a {scene.drive.type} has no profile to write in this scene")
    return write_table(path, columns)

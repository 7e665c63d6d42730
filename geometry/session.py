"""The only door to gmsh: one context manager around its global state."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType

from trochoid.kinematics.errors import TrochoidError

_LOCK = threading.Lock()

_OPTIONS = {
    "General.Terminal": 0.0,
    "General.NumThreads": 1.0,
    "Mesh.RandomSeed": 1.0,
    "Mesh.MeshSizeExtendFromBoundary": 0.0,
    "Mesh.MeshSizeFromPoints": 0.0,
    "Mesh.MeshSizeFromCurvature": 0.0,
}


@contextmanager
def gmsh_session() -> Iterator[ModuleType]:
    """Yield a silent gmsh with an empty model, and finalise it whatever happens.

    One at a time in a process; others wait.  Raises TrochoidError when gmsh or a library that it needs is
    missing, or when the caller holds a gmsh session of its own (which this one would end).
    """
    with _LOCK:
        gmsh = _load()
        if gmsh.isInitialized():
            raise TrochoidError(
                "gmsh is already initialised in this process; call gmsh.finalize() before meshing"
            )
        gmsh.initialize(argv=[], readConfigFiles=False, run=False, interruptible=False)
        try:
            for name, value in _OPTIONS.items():
                gmsh.option.setNumber(name, value)
            gmsh.model.add("body")
            yield gmsh
        finally:
            gmsh.finalize()


def _load() -> ModuleType:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        raise TrochoidError(
            f"gmsh cannot be loaded ({error}); on Debian or Ubuntu run: apt-get install libglu1-mesa "
            "libxcursor1 libxft2 libxinerama1 libxrender1"
        ) from error
    module: ModuleType = gmsh
    return module

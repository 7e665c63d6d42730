"""Bodies in space over successive moments, for VTK: plain arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.types import IntArray
from trochoid.results.plot import Axis

Shape: TypeAlias = Literal["triangle", "triangle6", "quad8", "tetra10", "wedge15", "hexahedron20"]
NODES: dict[Shape, int] = {
    "triangle": 3,
    "triangle6": 6,
    "quad8": 8,
    "tetra10": 10,
    "wedge15": 15,
    "hexahedron20": 20,
}
Floats: TypeAlias = npt.NDArray[np.floating[Any]]
INPUT_ANGLE = Axis("input angle", "rad")


@dataclass(frozen=True, slots=True)
class Field:
    """State of one body.

    `points` (n, 2|3) m; `cells` (nodes, m) of one `shape`, nodes in VTK's order (of a quadratic triangle:
    vertices 0 1 2, then the middles of 01, 12, 20); `point_data`: scalars (n,), vectors (n, 2|3), and "stress" (n, 4)
    xx yy zz xy or (n, 6) xx yy zz xy yz xz.  Raises ValueError for cells of another number of nodes.

    Some names are known to the viewer: it exaggerates "displacement", or "deformation" alone where a body has that part
    of it as well, and widens narrow contacts by their "from_middle", a node's way (m) from the contact's middle line.
    Arrays of float32 are written as such, all others as float64.  Spatial films draw bodies with `opacity`, and those
    that no data colour in `color` (#rrggbb).
    """

    name: str
    points: Floats
    cells: IntArray
    point_data: Mapping[str, Floats] = field(default_factory=dict)
    shape: Shape = "triangle6"
    color: str = "#9fb3c8"
    opacity: float = 1.0

    def __post_init__(self) -> None:
        """Refuse cells that are not of the shape."""
        if len(self.cells) != NODES[self.shape]:
            raise ValueError(
                f"{self.name}: a {self.shape} has {NODES[self.shape]} nodes, not {len(self.cells)}"
            )


FieldFrame: TypeAlias = tuple[float, tuple[Field, ...]]


class Later(Sequence[FieldFrame]):
    """Frames that are made when they are first looked at: a film costs nothing where no files are written."""

    def __init__(self, make: Callable[[], Sequence[FieldFrame]]) -> None:
        """Keep what makes the frames."""
        self._make = make

    @cached_property
    def _made(self) -> Sequence[FieldFrame]:
        return self._make()

    def __len__(self) -> int:
        """Return the number of frames."""
        return len(self._made)

    @overload
    def __getitem__(self, index: int) -> FieldFrame: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[FieldFrame]: ...
    def __getitem__(self, index: int | slice) -> FieldFrame | Sequence[FieldFrame]:
        """Return a frame, or several."""
        return self._made[index]


@dataclass(frozen=True, slots=True)
class Film:
    """Bodies at successive values of `axis`, written as `<name>.pvd`; `shown` is the point data that colours them.

    `frames`: the value (in the axis' units) and the bodies; `Later` where they cost time.  `spatial`: all bodies in
    one view in perspective, with z upwards, from the side that the vector `seen_from` points to; otherwise each in a
    view of its own, seen along z.
    """

    name: str
    title: str
    frames: Sequence[FieldFrame]
    axis: Axis = INPUT_ANGLE
    shown: str = "von_mises"
    spatial: bool = False
    seen_from: tuple[float, float, float] = (1.0, -1.0, 0.7)

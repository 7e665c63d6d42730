"""Bodies in space over successive moments, for VTK: plain arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from trochoid.kinematics.types import Array, IntArray
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
INPUT_ANGLE = Axis("input angle", "rad")


@dataclass(frozen=True, slots=True)
class Field:
    """State of one body.

    `points` (n, 2|3) m; `cells` (nodes, m) of one `shape`, nodes in VTK's order (of a quadratic triangle:
    vertices 0 1 2, then the middles of 01, 12, 20); `point_data`: scalars (n,), vectors (n, 2|3), and "stress" (n, 4)
    xx yy zz xy or (n, 6) xx yy zz xy yz xz.  Raises ValueError for cells of another number of nodes.
    """

    name: str
    points: Array
    cells: IntArray
    point_data: Mapping[str, Array] = field(default_factory=dict)
    shape: Shape = "triangle6"

    def __post_init__(self) -> None:
        """Refuse cells that are not of the shape."""
        if len(self.cells) != NODES[self.shape]:
            raise ValueError(
                f"{self.name}: a {self.shape} has {NODES[self.shape]} nodes, not {len(self.cells)}"
            )


FieldFrame: TypeAlias = tuple[float, tuple[Field, ...]]


@dataclass(frozen=True, slots=True)
class Film:
    """Bodies at successive values of `axis`, written as `<name>.pvd`; `shown` is the point data that colours them.

    `frames`: the value (in the axis' units) and the bodies.  `spatial`: all bodies in one view in perspective,
    otherwise each in a view of its own, seen along z.
    """

    name: str
    title: str
    frames: tuple[FieldFrame, ...]
    axis: Axis = INPUT_ANGLE
    shown: str = "von_mises"
    spatial: bool = False

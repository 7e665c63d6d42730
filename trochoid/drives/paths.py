"""Lines of a drawing over all its frames."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.kinematics.types import Array
from trochoid.results.outcome import Arrow, Drawing, DrawingFrame, Line


@dataclass(frozen=True, slots=True)
class Path:
    """A line of the drawing over all frames: `xy` (frames, points, 2) m, or (points, 2) where it stands still."""

    name: str
    xy: Array
    group: str
    style: str = "outline"
    closed: bool = True

    def line(self, frame: int) -> Line:
        """Return the line of one frame."""
        return Line(
            self.name, self.xy if self.xy.ndim == 2 else self.xy[frame], self.closed, self.style, self.group
        )


def framed(angles: Array, paths: Sequence[Path], arrows: Sequence[tuple[Arrow, ...]]) -> Drawing:
    """Return the drawing over the input angles (n,) in rad, with the arrows of each."""
    return Drawing(
        tuple(
            DrawingFrame(f"{np.degrees(angle):.1f}°", tuple(path.line(i) for path in paths), arrows[i])
            for i, angle in enumerate(angles)
        )
    )

"""Array types shared by all wings, and the one way to freeze an array."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
ComplexArray = npt.NDArray[np.complex128]
IntArray = npt.NDArray[np.intp]
BoolArray = npt.NDArray[np.bool_]


def frozen(values: npt.ArrayLike) -> Array:
    """Return a read-only float copy of `values`, as every array at a stage border is."""
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array

"""A dataset variable taken apart into curves over one axis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    import xarray

_MANY = 40  # curves of one variable beyond which only a map is legible


@dataclass(frozen=True, slots=True)
class Curve:
    """Values `y` over `x` (SI); `place` maps each other dimension to its entry ("pin" → "pin 3")."""

    variable: str
    units: str
    x: Array
    y: Array
    x_dim: str
    x_name: str
    x_units: str
    place: Mapping[str, str]
    heat: bool
    log: bool

    @property
    def label(self) -> str:
        """The place in words: "disc 1 · pin 3"."""
        return " · ".join(self.place.values())

    @property
    def largest(self) -> float:
        """Largest magnitude, 0 when there is no number."""
        return float(np.nanmax(np.abs(self.y), initial=0.0))

    @property
    def lowest(self) -> float:
        """Smallest value, infinite when there is no number."""
        return float(np.nanmin(self.y, initial=np.inf))

    @property
    def highest(self) -> float:
        """Largest value, minus infinity when there is no number."""
        return float(np.nanmax(self.y, initial=-np.inf))

    @property
    def spectrum(self) -> bool:
        """Whether the curve has lines at single frequencies."""
        return self.x_units == "Hz"


def curves_of(variable: xarray.DataArray) -> Iterator[Curve]:
    """Yield the curves of `variable`, complex ones by their amplitude."""
    x_dim = _x_dim(variable)
    others = [str(dim) for dim in variable.dims if dim != x_dim]
    axis = variable.coords.get(x_dim)
    x = (
        np.arange(variable.sizes[x_dim], dtype=np.float64)
        if axis is None
        else np.asarray(axis.values, dtype=np.float64)
    )
    attrs = {} if axis is None else axis.attrs
    values = np.moveaxis(variable.values, variable.dims.index(x_dim), -1)
    values = np.abs(values) if np.iscomplexobj(values) else values.astype(np.float64)
    entries = [entry_names(variable, dim) for dim in others]
    heat = variable.attrs.get("plot") == "heatmap" or values[..., 0].size > _MANY
    for index in product(*(range(len(names)) for names in entries)):
        yield Curve(
            variable=str(variable.attrs.get("long_name", variable.name)),
            units=str(variable.attrs.get("units", "")),
            x=x,
            y=values[index],
            x_dim=x_dim,
            x_name=str(attrs.get("long_name", x_dim.replace("_", " "))),
            x_units=str(attrs.get("units", "")),
            place={dim: names[i] for dim, names, i in zip(others, entries, index, strict=True)},
            heat=heat and bool(others),
            log=variable.attrs.get("scale") == "log",
        )


def entry_names(variable: xarray.DataArray, dim: str) -> list[str]:
    """Return the names of the entries of a dimension: its coordinate when that is text, else "disc 1", …."""
    coordinate = variable.coords.get(dim)
    entries = range(variable.sizes[dim]) if coordinate is None else coordinate.values
    word = dim.replace("_", " ")
    return [entry if isinstance(entry, str) else f"{word} {entry:g}" for entry in entries]


def _x_dim(variable: xarray.DataArray) -> str:
    """Return the dimension along which to plot: the angle or the frequency, else the longest that has numbers."""
    dims = [str(dim) for dim in variable.dims]
    axes = [dim for dim in dims if dim in ("input_angle", "frequency", "load_torque")]
    counted = [
        dim for dim in dims if dim not in variable.coords or variable.coords[dim].dtype.kind not in "OSU"
    ]
    return axes[0] if axes else max(counted or dims, key=lambda dim: variable.sizes[dim])

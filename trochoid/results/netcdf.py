"""results.nc: series, spectra and profiles as an xarray dataset.

Written as netCDF-3 with 64-bit offsets by xarray's "scipy" engine: SciPy is needed anyway and every netCDF
reader knows the format; "h5netcdf" would bring all of HDF5 along for a file of a few hundred kilobytes.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray


def save(dataset: xarray.Dataset, path: Path) -> None:
    """Write `dataset` to `path`; complex variables as amplitude and phase."""
    real_valued(dataset).to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")


def load(path: Path) -> xarray.Dataset:
    """Return the dataset of `path`, in memory."""
    import xarray

    return xarray.load_dataset(path, engine="scipy")


def real_valued(dataset: xarray.Dataset) -> xarray.Dataset:
    """Return `dataset` with complex variables `v` replaced by `v_amplitude` (same units) and `v_phase` (rad).

    Truth values become 0 and 1, for netCDF-3 has neither.
    """
    variables = {}
    for name, variable in dataset.data_vars.items():
        if np.iscomplexobj(variable):
            attrs = dict(variable.attrs)
            long_name = attrs.pop("long_name", name)
            amplitude, phase = abs(variable), variable.copy(data=np.angle(variable.values))
            variables[f"{name}_amplitude"] = amplitude.assign_attrs(
                attrs | {"long_name": f"{long_name}, amplitude"}
            )
            variables[f"{name}_phase"] = _phase(phase, str(long_name))
        else:
            variables[str(name)] = (
                variable.astype(np.int8, keep_attrs=True) if variable.dtype == bool else variable
            )
    return dataset.drop_vars(list(dataset.data_vars)).assign(variables)


def _phase(variable: xarray.DataArray, long_name: str) -> xarray.DataArray:
    bare = variable.copy()
    bare.attrs = {"units": "rad", "long_name": f"{long_name}, phase"}
    return bare

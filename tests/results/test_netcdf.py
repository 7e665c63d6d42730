"""results.nc: what is written comes back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from trochoid.results import Outcome, netcdf


@pytest.mark.exact
def test_round_trip_keeps_values_coordinates_and_units(outcome: Outcome, tmp_path: Path) -> None:
    """float64 bit by bit, attributes and text coordinates as they were."""
    assert outcome.dataset is not None
    netcdf.save(outcome.dataset, tmp_path / "results.nc")
    loaded = netcdf.load(tmp_path / "results.nc")
    for name, variable in outcome.dataset.data_vars.items():
        if not np.iscomplexobj(variable):
            np.testing.assert_array_equal(loaded[name].values, variable.values)
            assert loaded[name].dims == variable.dims
            assert {k: v for k, v in loaded[name].attrs.items() if k != "dtype"} == variable.attrs
    assert list(loaded["support"].values) == ["bearing A", "bearing B"]
    np.testing.assert_array_equal(loaded["input_angle"].values, outcome.dataset["input_angle"].values)
    assert loaded["input_angle"].attrs["units"] == "rad"


@pytest.mark.exact
def test_complex_spectra_are_amplitude_and_phase(outcome: Outcome, tmp_path: Path) -> None:
    """v = a·exp(iφ)."""
    assert outcome.dataset is not None
    netcdf.save(outcome.dataset, tmp_path / "results.nc")
    loaded = netcdf.load(tmp_path / "results.nc")
    spectrum = loaded["velocity_amplitude"].values * np.exp(1j * loaded["velocity_phase"].values)
    np.testing.assert_allclose(spectrum, outcome.dataset["velocity"].values, rtol=1e-14)
    assert loaded["velocity_amplitude"].attrs["units"] == "m/s"
    assert loaded["velocity_phase"].attrs == {"units": "rad", "long_name": "velocity, phase"}
    assert "velocity" not in loaded
    assert "velocity" in outcome.dataset


@pytest.mark.independent
def test_another_reader_opens_it(outcome: Outcome, tmp_path: Path) -> None:
    """SciPy's own netCDF reader sees the same pin forces."""
    from scipy.io import netcdf_file

    assert outcome.dataset is not None
    netcdf.save(outcome.dataset, tmp_path / "results.nc")
    with netcdf_file(tmp_path / "results.nc", mmap=False) as file:
        np.testing.assert_array_equal(file.variables["pin_force"][:], outcome.dataset["pin_force"].values)
        assert file.variables["pin_force"].units == b"N"

"""What the dataset of a K-H-V run holds: labels, balances between its variables, and nothing that did not run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray

from trochoid.clock import Clock
from trochoid.drives.khv.dataset import dataset
from trochoid.drives.khv.stages import Stages
from trochoid.results import netcdf
from trochoid.scene import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
BEARINGS = '{type="bearing_compliance"}, {type="clearance"}, {type="inertia"}, {type="casing_on_mounts"}'
ALL = ("geometry", "contact", "reactions", "vibration")


def stages_of(*overrides: str, effects: str = BEARINGS) -> Stages:
    """The example's drive with rigid discs, which need no mesh."""
    return Stages(load(EXAMPLE, (f"effects=[{effects}]", 'ask.quantities=["ratio"]', *overrides)), Clock())


def made(stages: Stages, *wanted: str) -> xarray.Dataset:
    found = dataset(stages, wanted)
    assert found is not None
    return found


@pytest.fixture(scope="module")
def whole() -> xarray.Dataset:
    return made(stages_of("ask.positions=24"), *ALL)


@pytest.mark.property
def test_nothing_starts_that_is_not_wanted() -> None:
    """Design: only what is asked for is computed."""
    stages = stages_of("ask.positions=3")
    assert dataset(stages, ("kinematics", "mass")) is None
    profile = made(stages, "geometry")
    assert set(stages.clock.seconds) <= {"kinematics", "geometry"}
    assert "input_angle" not in profile.dims
    contact = made(stages, "contact")
    assert "contact" in stages.clock.seconds
    assert not {"mass", "reactions", "vibration"} & set(stages.clock.seconds)
    assert not [
        name for name in contact.variables if str(name).startswith(("reaction", "casing", "vibration"))
    ]


@pytest.mark.property
def test_everything_is_labelled(whole: xarray.Dataset) -> None:
    """The convention of results.outcome.Outcome: units and a name everywhere, one sentence below each figure."""
    for variable in whole.variables.values():
        assert variable.attrs["long_name"]
        assert "units" in variable.attrs
    captions: dict[str, set[str]] = {}
    for shown in whole.data_vars.values():
        if "figure" in shown.attrs:
            captions.setdefault(shown.attrs["figure"], set()).add(shown.attrs["caption"])
    assert len(captions) == 12
    assert all(len(said) == 1 and said.pop().endswith(".") for said in captions.values())


@pytest.mark.exact
def test_a_crowd_is_shown_as_a_map(whole: xarray.Dataset) -> None:
    """More than 12 traces in a row of a figure: 20 pins and 16 rollers, not 8 output pins."""
    maps = {name for name, variable in whole.data_vars.items() if variable.attrs.get("plot") == "heatmap"}
    assert maps == {"ring_pin_force", "roller_force"}


@pytest.mark.exact
def test_a_turn_has_no_end_point(whole: xarray.Dataset) -> None:
    """The 24 positions asked for, from 0."""
    np.testing.assert_allclose(whole.input_angle, 2 * np.pi * np.arange(24) / 24, atol=1e-12)


@pytest.mark.exact
def test_discs_share_the_whole_torque(whole: xarray.Dataset) -> None:
    """The shares of all discs sum to one at every position."""
    np.testing.assert_allclose(whole.disc_torque_share.sum("disc"), 1.0, rtol=1e-12)
    assert float(whole.disc_torque_share.min()) > 0.3


@pytest.mark.exact
def test_shaft_is_in_balance(whole: xarray.Dataset) -> None:
    """Newton: rigid reactions on the shaft and forces of the discs on it sum to zero, and so do their moments."""
    shaft = whole.reaction_rigid_components.sel(bearing=["input shaft A", "input shaft B"])
    discs = whole.eccentric_force_components
    size = float(np.abs(discs).max())
    assert float(np.abs(shaft.sum("bearing") + discs.sum("disc")).max()) < 1e-11 * size
    moments = (shaft * xarray.DataArray([-0.022, 0.022], dims="bearing")).sum("bearing")
    moments = moments + (discs * xarray.DataArray([-0.006, 0.006], dims="disc")).sum("disc")
    assert float(np.abs(moments).max()) < 1e-11 * size * 0.022


@pytest.mark.independent
def test_rollers_carry_what_pins_leave() -> None:
    """The force on the eccentric, found from pins and inertia, is the vector sum of the forces of its rollers."""
    stages = stages_of("ask.positions=4")
    found = made(stages, "contact")
    rollers = stages.contact.fine.bearing
    assert rollers is not None
    np.testing.assert_allclose(
        found.eccentric_force, np.linalg.norm(rollers.resultant[:-1], axis=-1), rtol=1e-9
    )


@pytest.mark.exact
def test_rms_is_that_of_the_spectrum(whole: xarray.Dataset) -> None:
    """Half the sum of the squared amplitudes between 10 and 1000 Hz."""
    band = (whole.frequency >= 10.0) & (whole.frequency <= 1000.0)
    power = 0.5 * (np.abs(whole.vibration_velocity) ** 2).where(band, 0.0).sum("frequency")
    np.testing.assert_allclose(np.sqrt(power), whole.vibration_rms, rtol=1e-12)


@pytest.mark.exact
def test_lag_and_stiffness_are_those_of_the_driven_member() -> None:
    """A flange torque of 380 N·m is 400 N·m on the ring: the same contacts, and the same work."""
    only = "ask.positions=3"
    flange = made(stages_of(only, "operation.output_torque=380", effects=""), "contact").isel(input_angle=0)
    ring = made(
        stages_of(only, "operation.output_torque=400", 'drive.fixed="output"', effects=""), "contact"
    ).isel(input_angle=0)
    np.testing.assert_allclose(ring.ring_pin_force, flange.ring_pin_force, rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(400 * ring.output_lag, 380 * flange.output_lag, rtol=1e-9)
    for found, torque in (
        (ring, 400),
        (flange, 380),
    ):  # linear springs without gaps: tangent and secant agree
        np.testing.assert_allclose(found.torsional_stiffness * found.output_lag, torque, rtol=1e-6)


@pytest.mark.exact
def test_transmission_error_has_no_mean(whole: xarray.Dataset) -> None:
    """The lag less its mean, which the caption names."""
    assert abs(float(whole.transmission_error.mean())) < 1e-12 * float(whole.output_lag.mean())
    wind_up = 60 * np.degrees(float(whole.output_lag.mean()))
    assert f"wind-up of {wind_up:.4g} arcmin" in whole.transmission_error.attrs["caption"]


@pytest.mark.exact
def test_profile_is_the_flank(whole: xarray.Dataset) -> None:
    """Crest and root of sources §3: R ± e − r = 77.5 and 72.5 mm."""
    radius = np.hypot(whole.profile_x, whole.profile_y)
    np.testing.assert_allclose([radius.max(), radius.min()], [0.0775, 0.0725], rtol=1e-12)


@pytest.mark.property
def test_it_can_be_stored(whole: xarray.Dataset, tmp_path: Path) -> None:
    """Values and labels survive results.nc, amplitudes and phases for complex ones."""
    netcdf.save(whole, tmp_path / "results.nc")
    back = netcdf.load(tmp_path / "results.nc")
    xarray.testing.assert_equal(back.ring_pin_force, whole.ring_pin_force)
    velocity = back.vibration_velocity_amplitude * np.exp(1j * back.vibration_velocity_phase)
    np.testing.assert_allclose(velocity, whole.vibration_velocity, rtol=1e-12, atol=1e-18)
    assert back.disc.attrs == whole.disc.attrs
    assert list(back.bearing.values) == list(whole.bearing.values)


@pytest.mark.exact
def test_without_torque_there_is_no_share() -> None:
    """Zero torque is valid: all numbers are finite."""
    found = made(stages_of("ask.positions=3", "operation.output_torque=0", effects=""), "contact")
    assert float(np.abs(found.disc_torque_share).max()) == 0.0
    assert all(np.isfinite(variable.values).all() for variable in found.data_vars.values())

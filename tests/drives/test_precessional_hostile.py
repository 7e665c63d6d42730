"""Rollers that wedge, seats that are too soft, few positions, many teeth: what is said of them, and what helps."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from tests.drives.test_precessional_contact import ELASTIC, TORQUE, stages
from trochoid.drives.choosing import rounded_up
from trochoid.drives.mesh_error import sampling_error
from trochoid.drives.precessional.contact import Series, pitch_angles, solve_series
from trochoid.drives.precessional.contact_stages import Solved
from trochoid.drives.precessional.dataset_contact import PASSAGE, PITCH, contact_entries, contact_places
from trochoid.drives.precessional.overload import doubts
from trochoid.drives.precessional.teeth import build_level
from trochoid.drives.precessional.wedging import said, wedged
from trochoid.kinematics.errors import Infeasible, NotConverged


def _leaning(clearance: float, **more: Any) -> tuple[Any, Solved]:
    made = stages(ELASTIC, drive__rollers__tilt=0.5, drive__rollers__clearance=clearance, **more).feasible
    level = build_level(made, 8)
    return made, Solved(solve_series(made, level, 0.0, np.array([0.0, 0.2])), None, level, None)


@pytest.mark.property
def test_leaning_rollers_wedge_and_the_clearance_that_frees_them() -> None:
    """Without load 0.5° of tilt press; the clearance that is told leaves nothing pressed, 10 % less of it does not."""
    made, found = _leaning(0.0)
    stuck = wedged(made, found, None)
    assert stuck is not None
    assert stuck.force == pytest.approx(found.fine.total.max())
    assert stuck.force > 1000.0
    words = said(made, stuck)
    clearance = float(re.findall(r"clearance = ([\d.]+)\)", words)[0])
    assert not any("undercut" in doubt for doubt in doubts(found.fine, wedged=True))
    freed, again = _leaning(clearance)
    assert wedged(freed, again, None) is None
    assert not again.fine.total.any()
    tight, pressed = _leaning(0.9 * clearance)
    assert wedged(tight, pressed, None) is not None
    assert pressed.fine.total.any()


@pytest.mark.property
def test_straight_rollers_do_not_wedge() -> None:
    """Aligned ones, crowned or not, are free, loaded or not."""
    made = stages(ELASTIC).feasible
    level = build_level(made, 8)
    series = solve_series(made, level, TORQUE, np.array([0.0]))
    assert wedged(made, Solved(series, None, level, None), None) is None


@pytest.mark.property
def test_soft_seats_are_named() -> None:
    """1e-3 N/mm under every roller: the message names the seat and a stiffness, in the scene's unit, that is solved."""
    with pytest.raises(NotConverged, match=r"rollers\.seat_stiffness") as fault:
        _seated(1e-3)
    enough = float(re.findall(r"seat_stiffness = ([\d.e+]+) or more", str(fault.value))[0])
    assert _seated(enough).residual.max() < 1e-9


def _seated(stiffness: float) -> Series:
    made = stages(ELASTIC, drive__rollers__seat_stiffness=stiffness).feasible
    return solve_series(made, build_level(made, 8), TORQUE, np.array([0.0]))


@pytest.mark.property
def test_few_positions_are_in_the_error() -> None:
    """The largest force at 6 positions is off from that at 48 by no more than the thinned series tell."""
    made = stages(ELASTIC, drive__nutation_angle=4.9).feasible
    level = build_level(made, 8)
    few, many = (solve_series(made, level, TORQUE, pitch_angles(made, n)) for n in (6, 48))
    numbers: list[Callable[[Series], float]] = [
        lambda x: float(x.total.max()),
        lambda x: float(np.ptp(x.lag)),
    ]
    for get in numbers:
        error = sampling_error(get, few, few.thinned)
        assert 0.0 < abs(get(few) - get(many)) < 1.5 * error


@pytest.mark.exact
def test_series_end_as_they_began() -> None:
    """A pitch and a passage in the dataset: their ends are there, with the values of their starts."""
    made = stages(ELASTIC).feasible
    series = solve_series(made, build_level(made, 8), TORQUE, pitch_angles(made, 2))
    places, entries = contact_places(made, series), contact_entries(made, series)
    pitch = 2.0 * np.pi / made.nutation.fixed_teeth
    assert np.ptp(places[PITCH][1]) == pytest.approx(pitch)
    assert np.ptp(places[PASSAGE][1]) == pytest.approx(pitch * series.force.shape[1])
    for dims, values, _ in entries.values():
        if dims[0] in (PITCH, PASSAGE):
            assert len(values) == len(places[dims[0]][1])
            assert np.array_equal(values[0], values[-1])


@pytest.mark.exact
def test_more_teeth_than_memory_holds() -> None:
    """1000 teeth with elastic contact are refused before anything is solved, with the number that is possible."""
    with pytest.raises(Infeasible, match=r"elastic contact holds .* lasts for 400"):
        _ = stages(
            ELASTIC,
            drive__z_wheel=1000,
            drive__z_satellite=999,
            drive__nutation_angle=0.03,
            drive__teeth__pin_angle=0.05,
        ).feasible


@pytest.mark.exact
@pytest.mark.parametrize("error", [0.0125, 0.01301, 3.14159e-4, 0.2])
def test_advised_tolerances_are_met(error: float) -> None:
    """Rounded up to two digits, and written with them, a tolerance is no less than the error."""
    assert error <= float(f"{rounded_up(error):.1e}") <= 1.11 * error

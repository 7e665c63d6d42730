"""The resolved oracle of the drive: statics, and level 0 and strips held against it."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.drives.khv_cases import EFFECTS, EVERY_PIN_ALIKE, drive, level_of, without
from trochoid.drives.khv.contact import centrifugal
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.estimate import NUMBERS
from trochoid.drives.khv.resolved import ResolvedPosition, resolved_position
from trochoid.drives.khv.resolved_bodies import Fineness
from trochoid.drives.khv.series import Series, solve_at, solve_series
from trochoid.fem.position import Contact
from trochoid.kinematics.errors import SceneError

COARSE = Fineness(on_half_width=8, per_lobe=8)
ROLLERS_ON_SPRINGS = without("friction")
RIGID = without("friction", "bearing_compliance", "pin_compliance")  # eccentric and pins
effects_given = pytest.mark.parametrize("effects", [ROLLERS_ON_SPRINGS, RIGID], ids=["elastic", "rigid"])


def _design(effects: tuple[str, ...], *overrides: str) -> Design:
    """Return a small drive: one disc, nine pins, eight holes."""
    return drive(*EVERY_PIN_ALIKE, *overrides, effects=effects)


@cache
def _engine(rung: str, effects: tuple[str, ...]) -> Series:
    made = _design(effects)
    return solve_series(made, rung, level_of(made, 16).elastic, 1)


def _start(made: Design) -> Contact:
    return solve_at(made, "level0", level_of(made, 8).elastic, 0.0)


@cache
def _oracle(effects: tuple[str, ...]) -> ResolvedPosition:
    made = _design(effects)
    return resolved_position(made, 0.0, _start(made), COARSE)


@pytest.mark.independent
@effects_given
@pytest.mark.parametrize("rung", ["level0", "strips"])
def test_engine_against_the_oracle(rung: str, effects: tuple[str, ...]) -> None:
    """Every number that errors are estimated for, by two models that share only curves and laws, with facets of a/8.

    Measured with the elastic (rigid) partners: twist 2e-4 (2e-5), stiffness 3.5e-3 (1.4e-3), any
    force 1.4e-3 (2.8e-3) of the largest of its kind, pressures 3e-3 (3e-3). The oracle's own error is 1e-3 in
    stiffness and pressure, 3e-4 in forces and twist.
    """
    oracle, engine = _oracle(effects).series, _engine(rung, effects)
    for name, get in NUMBERS.items():
        assert get(engine) == pytest.approx(get(oracle), rel=4e-3), name
    assert engine.twist[0] == pytest.approx(oracle.twist[0], rel=5e-4)
    for kind in ("ring", "output", "bearing"):
        one, other = getattr(engine, kind).force[0], getattr(oracle, kind).force[0]
        assert one == pytest.approx(other, abs=3e-3 * other.max()), kind
        assert getattr(engine, kind).point[0] == pytest.approx(getattr(oracle, kind).point[0], abs=5e-5)


@pytest.mark.property
@effects_given
def test_discs_are_in_balance(effects: tuple[str, ...]) -> None:
    """Resultants of the pressures on the disc and its inertia: nothing is left; no facet goes through its partner."""
    oracle, made = _oracle(effects).series, _design(effects)
    assert oracle.bearing is not None
    total = -sum(kind.resultant[0, 0] for kind in (oracle.ring, oracle.output, oracle.bearing))
    total = total + centrifugal(made, oracle.crank)[0, 0]
    assert np.abs(total).max() < 1e-9 * oracle.ring.force.max()
    assert oracle.imbalance < 1e-9
    assert oracle.penetration < 1e-9


@pytest.mark.property
def test_result_does_not_depend_on_where_it_starts() -> None:
    """Started from a tenth of the torque: other contacts, other half widths; meshed again until they are its own."""
    made, faint = _design(RIGID), _design(RIGID, "operation.output_torque=40")
    coarse = Fineness(on_half_width=4, per_lobe=6)
    own = resolved_position(made, 0.0, _start(made), coarse)
    far = resolved_position(made, 0.0, _start(faint), coarse)
    assert own.rounds < far.rounds
    assert far.series.twist == pytest.approx(own.series.twist, rel=1e-3)
    for kind in ("ring", "output", "bearing"):
        one, other = getattr(far.series, kind).force, getattr(own.series, kind).force
        assert one == pytest.approx(other, abs=5e-3 * other.max()), kind


@pytest.mark.property
def test_rigid_discs_are_refused() -> None:
    """Without elastic_contact there is nothing to resolve: said, with what to do."""
    with pytest.raises(SceneError, match="elastic_contact"):
        resolved_position(_design(tuple(e for e in EFFECTS if e == "clearance")), 0.0)

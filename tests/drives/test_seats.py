"""What a drive puts on its casing, by its places: sums, and two bores that share a place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.drives.khv_cases import scene, without
from tests.drives.precessional_cases import SPEED, drives
from trochoid.clock import Clock
from trochoid.drives.khv.reactions import on_casing
from trochoid.drives.khv.stages import Stages
from trochoid.drives.precessional.casing import casing_load, closed_record, places
from trochoid.drives.precessional.mechanism import PrecessionalDrive
from trochoid.drives.precessional.reactions import reactions
from trochoid.drives.seats import on_bores, seats_residual
from trochoid.dynamics.wrench import Wrench, total
from trochoid.kinematics.errors import Infeasible
from trochoid.scene.needs import SEATS_OF

EXAMPLES = Path(__file__).parents[2] / "examples"
seeds = st.integers(0, 2**31 - 1)


def _load(seed: int) -> Wrench:
    rng = np.random.default_rng(seed)
    return total([Wrench(rng.normal(size=(5, 3)), rng.normal(size=(5, 3)), rng.normal(size=3))])


@pytest.mark.exact
@pytest.mark.parametrize("fixed", ["ring", "output"])
@pytest.mark.parametrize("springs", [True, False])
def test_khv_places_sum_to_the_resultant(fixed: str, springs: bool) -> None:
    """Ring and four bearings, rigid and with elastic members, are what the casing feels."""
    left_out = ("elastic_contact",) if springs else ("elastic_contact", "bearing_compliance")
    made = Stages(scene(f"drive.fixed={fixed}", "ask.positions=12", effects=without(*left_out)), Clock())
    found = made.reactions.fine
    for model, whole in (("rigid", found.casing_rigid), ("elastic", found.casing)):
        by_place = on_casing(made.design, found, model)
        assert tuple(by_place) == SEATS_OF["khv"]
        assert seats_residual(by_place, whole) < 1e-12
        held = by_place["ring" if fixed == "ring" else "output flange A"]
        assert held.moment[:, 2].any() == whole.moment[:, 2].any()
    pressed = by_place["input shaft B"].force
    forces = found.rigid if found.elastic is None else found.elastic
    assert pressed[:, :2] == pytest.approx(-forces["shaft"][:, 1], rel=1e-12)


@pytest.mark.exact
@given(drives())
@settings(max_examples=20, deadline=None)
def test_precessional_places_sum_to_the_resultant(drive: PrecessionalDrive) -> None:
    """Fixed wheel, bearings B and C, motor: their sum is the load on the casing."""
    found = reactions(drive, closed_record(drive), SPEED)
    by_place = places(found)
    assert tuple(by_place) == SEATS_OF["precessional"]
    assert seats_residual(by_place, casing_load(found)) < 1e-12


@pytest.mark.exact
@given(seeds)
@settings(max_examples=20, deadline=None)
def test_two_bores_share_by_the_lever(seed: int) -> None:
    """A force across the axis at a quarter of the way gives 3/4 and 1/4; any load is the sum of its shares."""
    load = _load(seed)
    bores = {"low": (0.01, 0.02, -0.1), "high": (0.01, 0.02, 0.3)}
    holds = {"low": ("shaft",), "high": ("shaft", "ring")}
    found = on_bores({"shaft": load, "ring": _load(seed + 1)}, bores, holds)
    assert seats_residual(found, total([load, _load(seed + 1)])) < 1e-12
    across = np.array([[3.0, -4.0, 0.0]])
    pure = Wrench(across, 0.0 * across, np.array([0.01, 0.02, 0.0]), (5.0, 0.0))
    shares = on_bores({"shaft": pure}, bores, holds)
    assert shares["low"].force == pytest.approx(0.75 * across)
    assert shares["high"].force == pytest.approx(0.25 * across)
    assert np.abs(shares["low"].moment).max() < 1e-15


@pytest.mark.exact
def test_loads_that_nothing_holds() -> None:
    """A place in no bore is refused when it is pressed; two bores in one place cannot share."""
    nothing = np.zeros((4, 3))
    idle, pressed = Wrench(nothing, nothing, np.zeros(3)), _load(1)
    bores = {"bore": (0.0, 0.0, 0.0), "same": (0.0, 0.0, 0.0)}
    assert set(on_bores({"ring": pressed, "sun": idle}, bores, {"bore": ("ring",)})) == {"bore"}
    with pytest.raises(Infeasible, match=r'"sun" is pressed with up to .* N, and no bore holds it'):
        on_bores({"ring": pressed, "sun": pressed}, bores, {"bore": ("ring",)})
    with pytest.raises(Infeasible, match="two bores in one place"):
        on_bores({"ring": pressed}, bores, {"bore": ("ring",), "same": ("ring",)})

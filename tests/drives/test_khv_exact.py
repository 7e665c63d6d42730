"""The K-H-V drive against closed forms: speeds, the classical hand calculation, inertia, symmetry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.drives.khv_cases import NO_PLAY, RV40, drive, level_of, scene, turn, without
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.series import Series, solve_at
from trochoid.fem.position import Contact
from trochoid.kinematics.types import Array
from trochoid.results import Quantity
from trochoid.run import Run


def number(quantity: Quantity, *parts: str) -> float:
    """Return a number out of the parts of a quantity."""
    found = quantity
    for part in parts:
        assert found.parts is not None
        inner = found.parts[part]
        assert isinstance(inner, Quantity)
        found = inner
    assert isinstance(found.value, float)
    return found.value


@pytest.mark.exact
@pytest.mark.parametrize(("fixed", "ratio", "disc"), [("ring", -19.0, -1 / 19), ("output", 20.0, 0.0)])
def test_ratio_and_speeds(fixed: str, ratio: float, disc: float) -> None:
    """Sources §3: u = −z_c with the ring fixed; with the output fixed the ring turns once in z_p turns."""
    run = Run(scene(f"drive.fixed={fixed}"))
    assert run.ratio.value == ratio
    assert number(run.member_speeds, "disc") == pytest.approx(1500 * disc, rel=1e-15)
    driven = "output" if fixed == "ring" else "ring"
    assert number(run.member_speeds, driven) == pytest.approx(1500 / ratio, rel=1e-15)
    assert number(run.member_speeds, fixed) == 0.0


def eccentric_force(contact: Contact, disc: int) -> Array:
    """Return what ring and output pins leave to the eccentric (2,), N."""
    kinds = [contact.touches[f"{kind}{disc}"] for kind in ("ring", "output")]
    return -sum((t.force @ t.state.normal for t in kinds), start=np.zeros(2))


@pytest.mark.exact
def test_classical_bearing_force_drives_with_the_input_torque() -> None:
    """Sources §3: the part of E across the eccentricity is T/(e z_c) at every angle, so that T_in = T/z_c."""
    made = drive(*RV40, effects=())
    for crank in np.linspace(0.0, 1.0, 8):
        force = eccentric_force(solve_at(made, "springs", (), crank), 0)
        across = force @ np.array([-math.sin(crank), math.cos(crank)])
        assert -across == pytest.approx(206 / (1.3e-3 * 39), rel=1e-12)


@pytest.mark.exact
def test_classical_stiffness_is_its_closed_form() -> None:
    """Sources §3: the pins hold the disc with k (e z_c)² z_p/4, the mean of k Σl² over the loaded half."""
    made = drive(*RV40, "drive.contact_stiffness=2e5", effects=())
    found = []
    for crank in np.linspace(0.0, 2 * np.pi / 40, 32, endpoint=False):
        contact = solve_at(made, "springs", (), crank)
        touch = contact.touches["output0"]
        output = 2e8 * (touch.state.arms[touch.force > 0, 0] ** 2).sum()
        found.append(contact.stiffness[0, 0] - output)
    assert np.mean(found) == pytest.approx(2e8 * (1.3e-3 * 39) ** 2 * 40 / 4, rel=1e-4)


@pytest.mark.exact
def test_pin_forces_are_levers_over_their_squares() -> None:
    """Sources §3: F_k = T l_k/Σl² over the half that the torque presses, and the same for the output pins."""
    made = drive(*RV40, effects=())
    contact = solve_at(made, "springs", (), 0.2)
    for kind, torque in (("ring0", 206.0), ("output0", 206.0)):
        touch = contact.touches[kind]
        lever = np.abs(touch.state.arms[:, 0]) * (touch.force > 0)
        assert touch.force == pytest.approx(torque * lever / (lever**2).sum(), rel=1e-10, abs=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize(
    ("discs", "force", "couple"), [(1, 1.0, 0.0), (2, 0.0, 0.012), (3, 0.0, 0.012 * math.sqrt(3))]
)
def test_inertia_of_the_discs(discs: int, force: float, couple: float) -> None:
    """Two discs: the force cancels and m e ω² (z₂ − z₁) stays; three at 120°: m e ω² √3 z; one: its force alone."""
    run = Run(scene(f"drive.discs={discs}", *NO_PLAY))
    one = number(run.mass, "discs") / discs * 2.5e-3 * (1500 * math.pi / 30) ** 2
    assert number(run.balance, "inertia_force_of_a_disc") == pytest.approx(one, rel=1e-12)
    assert number(run.balance, "unbalanced_force") == pytest.approx(force * one, rel=1e-12, abs=1e-12 * one)
    assert number(run.balance, "unbalanced_couple") == pytest.approx(couple * one, rel=1e-12, abs=1e-14 * one)


def torques(made: Design, series: Series) -> Array:
    """Return the torque (n, d) of the ring on each disc about its centre, N·m."""
    found = []
    for i, disc in enumerate(made.discs):
        crank = series.crank + disc.crank
        center = made.flank.eccentricity * np.stack([np.cos(crank), np.sin(crank)], axis=-1)
        row = series.names.index(f"disc{i}.x")
        arm = series.ring.point[:, i] - (center + series.motion[:, row : row + 2])[:, None]
        push = -series.ring.force[:, i, :, None] * series.ring.normal[:, i]
        found.append((arm[..., 0] * push[..., 1] - arm[..., 1] * push[..., 0]).sum(axis=1))
    return np.stack(found, axis=-1)


@pytest.mark.exact
def test_symmetric_drive_loads_its_discs_alike() -> None:
    """Half a turn about the axis and a mirror in the middle plane carry one disc into the other.

    That holds with even numbers of pins, output pins and rollers, and with the bearings of shaft and flange
    alike on both sides of the disc pack: the discs carry the same torque at every position. An overhung
    flange gives way more to the disc that is farther from its bearings.
    """
    even = drive("drive.output_flange.bearing_positions=[-30, 30]", effects=without("inertia"))
    shared = torques(even, turn(even, level_of(even), 5))
    assert shared[:, 0] == pytest.approx(shared[:, 1], rel=1e-9)
    overhung = drive(effects=without("inertia"))
    found = torques(overhung, turn(overhung, level_of(overhung), 5))
    assert (found[:, 1] / found[:, 0] > 1.1).all()  # disc 2 is nearer to the flange's bearings
    assert found.sum(axis=1) == pytest.approx(shared.sum(axis=1), rel=2e-4)


@pytest.mark.exact
def test_rigid_bearings_load_the_discs_alike() -> None:
    """Discs on a rigid shaft and flange, even numbers of all: the same torque on both."""
    made = drive(effects=without("bearing_compliance", "inertia"))
    shared = torques(made, turn(made, level_of(made), 5))
    assert shared[:, 0] == pytest.approx(shared[:, 1], rel=1e-9)

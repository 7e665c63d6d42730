"""What repeats over a turn, and the power that goes through: no friction, so what comes in goes out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.drives.khv_cases import (
    EVERY_PIN_ALIKE,
    RV40,
    all_forces,
    drive,
    level_of,
    scene,
    turn,
    without,
)
from trochoid.drives.khv.bodies import Level
from trochoid.drives.khv.contact import layout
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.series import solve_at
from trochoid.fem.position import Contact
from trochoid.run import Run

NO_INERTIA = without("inertia", "casing_on_mounts")
RIGID_BEARINGS = without("inertia", "casing_on_mounts", "bearing_compliance")
PITCH = 2 * np.pi / 9


@pytest.fixture(scope="module")
def level() -> Level:
    """The disc of the drive in which every pin is alike."""
    return level_of(drive(*EVERY_PIN_ALIKE), 8)


@pytest.mark.property
def test_classical_pin_forces_repeat_with_the_pins() -> None:
    """Sources §3: the set of pin forces repeats every 360°/z_p of the crank, each pin taking over from the last."""
    made = drive(*RV40, effects=())
    first, then, between = (
        solve_at(made, "springs", (), 0.1 + step * 2 * np.pi / 40).touches["ring0"].force
        for step in (0, 1, 0.5)
    )
    assert np.roll(first, 1) == pytest.approx(then, abs=1e-9 * first.max())
    assert np.abs(np.sort(between) - np.sort(first)).max() > 1e-2 * first.max()


@pytest.mark.property
@pytest.mark.parametrize("effects", [NO_INERTIA, RIGID_BEARINGS])
def test_elastic_drive_repeats_with_the_pins(level: Level, effects: tuple[str, ...]) -> None:
    """Where holes and rollers come round with the lobes, everything repeats after 360°/z_p, one pin on.

    Within the mesh, which has other triangles and stations at the next lobe.
    """
    made = drive(*EVERY_PIN_ALIKE, effects=effects)
    first, then = (solve_at(made, "level0", level.elastic, 0.1 + step * PITCH) for step in (0, 1))
    force = first.touches["ring0"].force
    assert np.roll(force, 1) == pytest.approx(then.touches["ring0"].force, abs=2e-3 * force.max())
    assert np.sort(all_forces(first)) == pytest.approx(np.sort(all_forces(then)), abs=2e-3 * force.max())
    row = layout(made, "level0").names.index("output.rotation")
    assert then.motion[row] == pytest.approx(first.motion[row], rel=2e-4)


def shaft_torque(contact: Contact) -> float:
    """Return the torque of the rollers on the shaft about its axis, by their places and forces, N·m."""
    touch = contact.touches["bearing0"]
    push = touch.force[:, None] * touch.state.normal
    at = touch.state.point
    return float((at[:, 0] * push[:, 1] - at[:, 1] * push[:, 0]).sum())


def mean_input(made: Design, level: Level, positions: int = 16) -> float:
    """Return the mean input torque over one period, N·m, against the rotation of the crank."""
    angles = PITCH * np.arange(positions) / positions
    return -float(np.mean([shaft_torque(solve_at(made, "level0", level.elastic, a)) for a in angles]))


@pytest.mark.exact
@pytest.mark.parametrize(("effects", "open_part"), [(NO_INERTIA, 1e-4), (RIGID_BEARINGS, 5e-4)])
def test_power_in_is_power_out(level: Level, effects: tuple[str, ...], open_part: float) -> None:
    """Mean input torque × z_c = output torque over a whole period, within what small deflections leave open.

    Normals turn with the rigid motions but not with the strain of the surfaces: the error is the deflection
    over the radius of curvature, and falls with the load.
    """
    heavy, light = (
        mean_input(drive(*EVERY_PIN_ALIKE, f"operation.output_torque={t}", effects=effects), level) * 8 / t
        for t in (400, 40)
    )
    assert heavy == pytest.approx(1.0, abs=open_part)
    assert light == pytest.approx(1.0, abs=0.2 * open_part)


@pytest.mark.exact
def test_driven_ring_takes_the_power_too() -> None:
    """Output fixed: T_in = T/z_p and the flange holds T z_c/z_p; the pins carry less than with the ring fixed."""
    made = drive(*RV40, "drive.fixed=output", effects=())
    assert made.flange_torque == pytest.approx(206 * 39 / 40, rel=1e-15)
    contact = solve_at(made, "springs", (), 0.2)
    touch = contact.touches["ring0"]
    push = touch.force[:, None] * touch.state.normal  # by the disc on the ring's pins
    at = touch.state.point
    on_ring = (at[:, 0] * push[:, 1] - at[:, 1] * push[:, 0]).sum()
    assert abs(on_ring) == pytest.approx(206, rel=1e-12)


@pytest.mark.property
def test_order_of_the_discs_does_not_matter() -> None:
    """The discs listed the other way round: the same forces on each, the same motions of shaft and flange."""
    made = drive()
    level = level_of(made)
    swapped = replace(made, discs=made.discs[::-1])
    one, other = (solve_at(each, "level0", level.elastic, 0.4) for each in (made, swapped))
    size = all_forces(one).max()
    for kind in ("ring", "output", "bearing"):
        for i in range(2):
            found = other.touches[f"{kind}{1 - i}"].force
            assert found == pytest.approx(one.touches[f"{kind}{i}"].force, abs=1e-7 * size)
    assert other.motion[6:] == pytest.approx(one.motion[6:], rel=1e-7, abs=1e-12)


@pytest.mark.property
def test_where_a_position_starts_from_does_not_matter() -> None:
    """A position found from its neighbour and one found from nothing agree within the tolerance of the solver."""
    made = drive()
    level = level_of(made)
    chained = turn(made, level, 8)
    cold = solve_at(made, "level0", level.elastic, float(chained.angle[3]))
    force = chained.ring.force[3, 0]
    assert cold.touches["ring0"].force == pytest.approx(force, abs=1e-6 * force.max())
    assert cold.motion == pytest.approx(chained.motion[3], abs=1e-6 * np.abs(chained.motion[3]).max())


@pytest.mark.property
def test_reruns_are_equal_to_the_bit() -> None:
    """Meshes, factors and contacts made anew give the same numbers to the last bit."""
    asked = (
        "ask.positions=4",
        "accuracy.facets_per_lobe=4",
        'ask.quantities=["torsional_stiffness","reactions","stress_max"]',
    )
    one, other = (Run(scene(*asked)).outcome for _ in range(2))
    assert one.quantities == other.quantities
    assert one.checks == other.checks

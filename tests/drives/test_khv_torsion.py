"""The torque-twist loop at held input: play, lost motion, hysteresis, stiffness, and the work of friction."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from tests.drives.khv_cases import EXAMPLE, NO_PLAY, level_of, scene, without
from tests.drives.test_khv_losses import ELASTIC, HAND, rubbing
from trochoid.drives.khv.design import design
from trochoid.drives.khv.load_path import LOST, NEAR, LoadPath, between, held_angles, load_path, path_of
from trochoid.drives.khv.torsion import Torsion, torsion
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene import load
from trochoid.scene.drive_khv import KhvScene

T = 400.0


def followed(given: KhvScene, rung: str = "level0", angles: Array | None = None) -> LoadPath:
    """Return the load path on a coarse mesh, or of rigid discs."""
    made = design(given)
    bodies = level_of(made).elastic if given.has("elastic_contact") else ()
    return load_path(
        made, rung if bodies else "springs", bodies, held_angles(made) if angles is None else angles
    )


@cache
def path(ring: float, *overrides: str, effects: tuple[str, ...] = ELASTIC) -> LoadPath:
    """Return the path with one coefficient of friction."""
    return followed(rubbing(*overrides, ring=ring, output=ring, effects=effects))


def read(found: LoadPath) -> Torsion:
    """Return the numbers of the loops."""
    return torsion(found, T)


@pytest.mark.exact
def test_play_of_the_holes_alone() -> None:
    """Rigid springs, play of the holes only: backlash = lost motion = 2 c/(ρ max|sin γ|), of the hole that is first."""
    play = 5e-6
    stiff = (
        "drive.modification.equidistant=0",
        "drive.contact_stiffness=1e12",
        "drive.eccentric_bearing.clearance=0",
    )
    given = load(
        EXAMPLE, ('effects=[{type="clearance"}]', 'ask.quantities=["ratio"]', "drive.discs=1", *stiff)
    )
    made = design(given)
    angles = np.array([0.1, 0.35])
    found = read(followed(given, angles=angles))
    pins = made.drive.output_pins
    gamma = angles[:, None] * (1 + 1 / made.flank.lobes) - 2 * np.pi * np.arange(pins.count) / pins.count
    expected = 2 * play / (pins.circle_radius * np.abs(np.sin(gamma)).max(axis=1))
    assert found.backlash == pytest.approx(expected, rel=1e-5)
    assert found.play == pytest.approx(expected, rel=1e-5)
    assert found.lost_motion == pytest.approx(expected, rel=1e-4)
    assert not found.hysteresis.any()


@pytest.mark.exact
def test_linear_drive_has_one_stiffness_and_no_loop() -> None:
    """No play, no friction, rigid discs on springs: both lines are the tangent, and the loop encloses nothing."""
    given = scene(*NO_PLAY, "drive.discs=1", "accuracy.model=springs", "ask.positions=20", effects=())
    found = read(followed(given, angles=np.array([0.0])))
    series = Run(given).stages.contact.fine
    assert found.lower == pytest.approx(series.torsional_stiffness[0], rel=1e-9)
    assert found.upper == pytest.approx(series.torsional_stiffness[0], rel=1e-9)
    assert found.lost_motion == pytest.approx(2 * LOST * T / found.lower, rel=1e-9)
    assert found.loss[0] == 0.0
    assert found.open[0] == 0.0


@pytest.mark.property
@pytest.mark.parametrize("effects", [HAND, ELASTIC])
def test_without_friction_nothing_is_lost(effects: tuple[str, ...]) -> None:
    """One twist for each torque, whatever came before; μ = 0 is bit for bit the scene without the effect."""
    free, none = (
        followed(s) for s in (scene(effects=effects), rubbing(ring=0.0, output=0.0, effects=effects))
    )
    assert np.array_equal(free.twist, none.twist)
    assert not free.lost.any()
    assert not read(free).loss.any()


@pytest.mark.property
@pytest.mark.parametrize("effects", [HAND, ELASTIC])
@pytest.mark.parametrize("mu", [0.0, 0.05, 0.3])
def test_twist_follows_the_torque(effects: tuple[str, ...], mu: float) -> None:
    """On each branch the twist grows with the torque, and its torque-twist work is positive."""
    found = path(mu, effects=effects)
    for branch, sign in ((slice(0, found.first), 1), (found.falling, -1), (found.rising, 1)):
        assert (sign * np.diff(found.twist[:, branch], axis=1) > 0).all()
    assert (np.diff(found.lost, axis=1) >= -1e-9 * found.lost[:, -1:]).all()


@pytest.mark.property
@pytest.mark.parametrize("overrides", [(), NO_PLAY])
def test_area_of_the_loop_is_what_friction_took(overrides: tuple[str, ...]) -> None:
    """The loop closes after a cycle, and encloses the work of friction within the steps of the path."""
    found = read(path(0.05, *overrides))
    assert (found.loss > 1e-3).all()
    assert found.unmet == pytest.approx(0.0, abs=0.06 * float(found.loss.max()))
    assert found.open.max() < 1e-6 * found.wind_up.min()


@pytest.mark.property
def test_smaller_steps_enclose_the_work_more_nearly() -> None:
    """Many steps of the torque: the area is the work of friction; what few steps miss of it is told."""
    made, angle = design(rubbing(effects=HAND)), np.array([0.0])
    shares = (NEAR, *np.linspace(LOST, 0.5, 20).tolist(), *np.linspace(0.5, 1.0, 20)[1:].tolist())
    coarse = read(load_path(made, "springs", (), angle))
    fine = read(load_path(made, "springs", (), angle, shares))
    assert fine.unmet[0] < 0.2 * coarse.unmet[0]
    assert fine.unmet[0] < 0.01 * fine.loss[0]
    assert fine.loss[0] == pytest.approx(coarse.loss[0], abs=float(coarse.unmet[0]))
    assert fine.lost_motion[0] == pytest.approx(coarse.lost_motion[0], rel=1e-3)


@pytest.mark.property
def test_a_symmetric_drive_twists_as_far_both_ways() -> None:
    """Held where the eccentric points at a pin and a roller, the drive is its own mirror image: θ(−T) = −θ(T)."""
    found = followed(rubbing(effects=HAND), angles=np.array([0.0]))
    fall, rise = found.twist[0, found.falling], found.twist[0, found.rising]
    assert fall == pytest.approx(-rise, abs=1e-6 * np.abs(fall).max())


@pytest.mark.property
def test_play_adds_to_lost_motion() -> None:
    """Lost motion is the backlash and what yields up to 3 %; without play little of it is left."""
    loose, tight = read(path(0.05)), read(path(0.05, *NO_PLAY))
    assert (loose.lost_motion > loose.backlash).all()
    assert (loose.backlash > 10 * tight.backlash).all()
    assert (loose.lower < loose.upper).all()


@pytest.mark.property
def test_friction_makes_a_preloaded_drive_hysteretic() -> None:
    """Flanks ground too thick press at zero torque: there friction holds the twist; without friction nothing does."""
    tight = "drive.modification.equidistant=-0.002"
    rough, smooth = read(path(0.05, tight)), read(path(0.0, tight))
    assert (rough.hysteresis > 100 * np.abs(smooth.hysteresis)).all()
    assert (rough.hysteresis > 0.1 * rough.play).all()


@pytest.mark.property
@pytest.mark.parametrize("fixed", ["ring", "output"])
def test_the_loop_is_seen_from_the_driven_member(fixed: str) -> None:
    """With the flange held the ring twists z_c/z_p as far under z_p/z_c of the flange's torque."""
    given = scene(f"drive.fixed={fixed}", effects=without("friction"))
    made = design(given)
    found = read(followed(given, angles=np.array([0.0])))
    ring = read(
        followed(
            scene(f"operation.output_torque={made.flange_torque!r}", effects=without("friction")),
            angles=np.array([0.0]),
        )
    )
    assert found.lost_motion == pytest.approx(ring.lost_motion / made.leverage, rel=1e-9)


@pytest.mark.property
def test_answers_have_errors_and_say_what_they_lack() -> None:
    """The quantities of a run: value, error, and what is not in the equations."""
    quick = ("ask.positions=4", "accuracy.facets_per_lobe=8")
    run = Run(scene(*quick, effects=("elastic_contact",)))
    assert run.lost_motion.note is not None
    assert run.lost_motion.note.endswith("without clearance and friction")
    assert isinstance(run.lost_motion.value, float)
    assert 0 < (run.lost_motion.error or 0) < 0.01 * run.lost_motion.value
    parts = run.torsion_curve.parts
    assert parts is not None
    assert {"stiffness_3_to_50_percent", "stiffness_50_to_100_percent", "hysteresis_at_zero_torque"} <= set(
        parts
    )


@pytest.mark.exact
def test_path_goes_up_down_and_up() -> None:
    """Shares of the torque in order; unloading leaves a third in each step."""
    path = path_of((NEAR, LOST, 1.0))
    assert path.tolist() == [NEAR, LOST, 1, LOST, NEAR, -NEAR, -LOST, -1, -LOST, -NEAR, NEAR, LOST, 1]
    assert between(0.1, 1.0) == [1.0]
    assert between(0.5, 0.5) == []
    steps = [1.0, *between(1.0, 0.01)]
    assert steps[-1] == 0.01
    assert min(b / a for a, b in pairwise(steps)) >= 1 / 3

"""Indexers with an elastic slotted wheel, reached through scenes: models, reactions by model, natural frequencies."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.drives.indexer_cases import run_of
from tests.drives.test_indexer_published import number
from trochoid.drives.indexer.modes import solved
from trochoid.drives.indexer.picture_reactions import frequencies
from trochoid.drives.indexer.reactions import on_bearings
from trochoid.dynamics.indexing import Index, respond
from trochoid.dynamics.indexing_parts import Output
from trochoid.dynamics.pin_law import pin_law
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene.overrides import Override

FREE = "relative_turning_time = 0.2902"
ELASTIC = 'effects=[{type="elastic_contact"},{type="inertia"}]'
RIGID_WHEEL = 'accuracy.model="rigid_wheel"'
SHAFT = ("drive.output_shaft.inertia=0.02", "drive.output_shaft.stiffness=20000")
HELD = (
    "drive.input_shaft.near_bearing=-30",
    "drive.input_shaft.far_bearing=-90",
    "drive.output_shaft.near_bearing=130",
    "drive.output_shaft.far_bearing=200",
)


def elastic(*overrides: str | Override) -> Run:
    return run_of(FREE, ELASTIC, "drive.wheel.thickness=12", *overrides)


@pytest.fixture(scope="module")
def bent() -> Run:
    return elastic(*SHAFT, *HELD)


@pytest.mark.property
def test_an_elastic_wheel_is_softer(bent: Run) -> None:
    """Softer than half-spaces everywhere, most at the mouth; shares of the compliance add up to one."""
    rigid = elastic(*SHAFT, RIGID_WHEEL)
    for name in ("indexer", "geneva_wheel"):
        for key in ("at_force_max", "mean", "at_start"):
            stiff, soft = (number(x.mesh_stiffness, name, key) for x in (rigid, bent))
            assert soft < 0.8 * stiff
        shares = [
            number(bent.mesh_stiffness, name, f"{x}_share_of_compliance") for x in ("contact", "pin", "wheel")
        ]
        assert sum(shares) == pytest.approx(1.0)
        assert min(shares) > 0.1
    start, most = (number(bent.mesh_stiffness, "geneva_wheel", x) for x in ("at_start", "at_force_max"))
    assert start < 0.4 * most
    error = bent.mesh_stiffness.parts["indexer"]["mean"].error  # type: ignore[index, union-attr]
    assert error is not None
    assert 0.0 < error < 0.01 * number(bent.mesh_stiffness, "indexer", "mean")


@pytest.mark.regression
def test_rigid_wheel_is_what_it_was() -> None:
    """Half-spaces and a beam give the numbers that they gave before the wheel could bend."""
    run = elastic(RIGID_WHEEL)
    assert number(run.mesh_stiffness, "indexer", "at_force_max") == pytest.approx(284.36807358, rel=1e-9)
    assert number(run.dynamic_factor, "geneva_wheel", "factor") == pytest.approx(1.06834090329, rel=1e-9)
    assert run.contact_pressure_max.parts["indexer"]["pressure"].model == "slices"  # type: ignore[index, union-attr]
    assert run.stages.bodies.fine is None


@pytest.mark.independent
def test_the_law_is_the_pairs(bent: Run) -> None:
    """What is marched, tabulated over place and angle, is the contact itself: force and slope within 1e-3."""
    pair = bent.stages.pairs["geneva_wheel"]
    rng = np.random.default_rng(3)
    reach = rng.uniform(pair.law.ends[0], pair.law.ends[1], 40)
    u = pair.law.top * rng.uniform(0.02, 0.6, 40) ** 2
    found = pair.press(u, reach)
    np.testing.assert_allclose(pair.law.moment(u, reach), found.moment, rtol=1e-3)
    np.testing.assert_allclose(pair.law.slope(u, reach), found.slope, rtol=5e-3)


@pytest.mark.exact
def test_bearings_balance(bent: Run) -> None:
    """Two bearings and what acts on a shaft are in balance, but for the torque about its axis."""
    made = bent.stages.reactions["indexer"]["elastic"]
    state, axis = made.state, made.forces.indexer.axis
    for load, a, places in (
        (state.on_arm, np.array([0.0, 0.0, 1.0]), (-0.03, -0.09)),
        (state.on_wheel, axis, (0.13, 0.2)),
    ):
        near, far, along = on_bearings(load, a, places)
        force = load[:, :3] + near + far + along[:, None] * a
        moment = load[:, 3:] + np.cross(places[0] * a, near) + np.cross(places[1] * a, far)
        size = np.abs(load).max()
        np.testing.assert_allclose(force, 0.0, atol=1e-12 * size)
        np.testing.assert_allclose(np.cross(moment, a), 0.0, atol=1e-12 * size)
    about = np.abs(state.on_wheel[:, 3:] @ axis)
    np.testing.assert_allclose(about, np.abs(state.torque), atol=1e-9 * about.max())


@pytest.mark.property
def test_reactions_by_model(bent: Run) -> None:
    """Elastic ones are more by the dynamic factor; energy closes; the harmonic most raised is the natural frequency."""
    found = bent.reactions
    force = number(bent.dynamic_factor, "indexer", "pin_force")
    assert number(found, "indexer_elastic", "wheel_bearing_force") == pytest.approx(force, rel=1e-9)
    rigid = number(found, "indexer", "wheel_bearing_force")
    assert force / rigid == pytest.approx(number(bent.dynamic_factor, "indexer", "factor"), rel=1e-9)
    near, far = (number(found, "indexer", f"output_{x}_bearing") for x in ("near", "far"))
    assert near > far > 0.0
    order = number(found, "indexer_elastic", "input_torque_harmonic_most_raised")
    speed = number(bent.member_speeds, "arm") / 60.0
    natural = number(bent.residual_vibration, "indexer", "natural_frequency_1")
    assert speed * order == pytest.approx(natural, rel=0.05)
    assert all(check.ok for check in bent.outcome.checks)
    titles = [plot.title for plot in bent.outcome.plots]
    for title in ("Reactions by model: indexer", "Harmonics of the input torque", "Pressure along the pin"):
        assert title in titles


@pytest.mark.exact
def test_elastic_reactions_become_rigid() -> None:
    """Without a soft shock torques come to the rigid ones as 1/k: (2π/(ω T))², 1e-6 at 1000 periods in an index."""
    inertia, duration, errors = 0.01, 0.1, []

    def sample(t: Array) -> tuple[Array, Array, Array]:
        w = 2.0 * math.pi / duration
        velocity, acceleration = 1.0 - np.cos(w * t), w * np.sin(w * t)
        return np.full_like(t, 0.5 * math.pi), velocity, acceleration

    for periods in (30.0, 95.0, 300.0, 950.0):
        k = inertia * (2.0 * math.pi * periods / duration) ** 2
        law = pin_law(lambda u, k=k: k * u, 1.0)  # type: ignore[misc]
        found = respond(Index(duration, 1e-4, sample), Output(inertia, 0.0, k), law).index
        rigid = inertia * sample(found.time)[2]
        late = found.time > 0.02 * duration
        error = np.abs(found.torque - rigid)[late]
        # the start of the acceleration's slope rings with 1/ω; what stays behind is its curvature over ω²
        smooth = np.convolve(found.torque - rigid, np.full(64, 1.0 / 64.0), "valid")
        errors.append(float(np.abs(smooth).max() / np.abs(rigid).max()))
        assert error.max() < 1.2 / periods * np.abs(rigid).max()
    assert errors[-1] < 1.5e-6
    assert errors[0] / errors[2] == pytest.approx(100.0, rel=0.3)


@pytest.mark.exact
def test_frequencies_of_two_masses() -> None:
    """Against the polynomial of the march's own output; strain shares of pin and shaft; a free wheel turns."""
    output = Output(0.01, 0.0, 1e6, 0.0, 2e4, 0.03)
    found, share = solved(output, 1e6)
    np.testing.assert_allclose(2.0 * math.pi * found, output.frequencies_at(1e6), rtol=1e-12)
    assert share[0] == pytest.approx(2e4 / (1e6 + 2e4), rel=0.02)  # nearly in series
    free, _ = solved(output, 0.0)
    assert free[0] == 0.0
    assert 2.0 * math.pi * free[1] == pytest.approx(math.sqrt(2e4 / 0.01 + 2e4 / 0.03))
    step = 1.001
    slope = np.log(solved(output, 1e6 * step)[0] / found) / math.log(step)
    np.testing.assert_allclose(slope, 0.5 * share, rtol=1e-2)


@pytest.mark.property
def test_natural_frequencies_over_the_cycle(bent: Run) -> None:
    """In the dwell those of the march; in the index between least and largest; drawn over the cycle."""
    found = bent.natural_frequencies
    for i in (1, 2):
        low, high = (number(found, "indexer", f"mode_{i}_{x}_in_index") for x in ("least", "largest"))
        locked = number(found, "indexer", f"mode_{i}_locked_in_dwell")
        assert low < high
        assert locked == pytest.approx(
            number(bent.residual_vibration, "indexer", f"natural_frequency_{i}"), rel=1e-9
        )
    parts = found.parts["indexer"]  # type: ignore[index]
    assert parts["mode_1_free_in_dwell"].value == "turns freely"  # type: ignore[index, union-attr]
    drawn = frequencies(bent.stages.modes)
    assert drawn.title == "Natural frequencies over the cycle"
    assert max(float(curve.points[:, 1].max()) for curve in drawn.curves) == pytest.approx(high)


@pytest.mark.property
def test_soft_shafts_are_marched() -> None:
    """A shaft of 0.2 N·m/rad, whose damping would be 65 times the contact's critical one, is simply solved."""
    run = elastic(
        RIGID_WHEEL,
        "drive.output_shaft.inertia=0.02",
        "drive.output_shaft.stiffness=0.2",
        "operation.output_torque=0",
    )
    x = run.stages.shaken["indexer"]
    assert x.output.damping * x.output.frequencies[-1] > 100.0
    factor, error = x.factor
    assert error < 1e-4 * factor
    assert 0.3 < factor < 0.45  # the wheel's own inertia of the two: the load stays behind
    assert x.fine.index.balance < 1e-6
    said = run.residual_vibration.parts["indexer"]["settling_time"].value  # type: ignore[index, union-attr]
    assert said == "not settled within the dwell"


@pytest.mark.property
def test_large_play_is_crossed_before_the_entry_counts() -> None:
    """The first touch comes late, and the force at the entry is that from then on."""
    loose = run_of(
        FREE,
        'effects=[{type="elastic_contact"},{type="clearance"},{type="inertia"}]',
        RIGID_WHEEL,
        "drive.pin.play=1",
        "operation.output_torque=0",
    )
    found = loose.dynamic_factor
    assert number(found, "indexer", "at_entry_over_rigid_start") > 1.0
    touch = 1e-3 * number(found, "indexer", "first_touch")
    start = number(loose.indexing_motion, "indexer", "acceleration_at_start")
    lever = math.sin(math.radians(number(loose.profile, "indexer", "rim_angle")))
    assert touch == pytest.approx(math.sqrt(2.0 * 0.5e-3 / (0.1 * lever) / start), rel=0.05)


@pytest.mark.property
def test_reactions_without_a_march() -> None:
    """An index too slow to be followed leaves the rigid reactions, and says why there are no elastic ones."""
    slow = elastic(RIGID_WHEEL, "operation.input_speed=1")
    found = slow.reactions
    assert set(found.parts or {}) == {"indexer", "geneva_wheel"}
    assert "no elastic ones (response of the wheel: the index lasts" in str(found.note)
    assert "so slow a drive is as good as rigid" in str(found.note)
    assert all(check.ok for check in slow.outcome.checks)


@pytest.mark.property
def test_a_wheel_that_cannot_be_meshed_is_rigid_with_a_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    """Unless the scene names the elastic wheel: then the fault is told."""
    from trochoid.drives.indexer import wall
    from trochoid.kinematics.errors import TrochoidError

    def refuse(*_: object) -> None:
        raise TrochoidError("no mesh")

    monkeypatch.setattr(wall, "wall_body", refuse)
    run = elastic()
    assert run.mesh_stiffness == elastic(RIGID_WHEEL).mesh_stiffness
    assert any("counts as rigid" in said for said in run.outcome.warnings)
    with pytest.raises(TrochoidError, match="no mesh"):
        _ = elastic('accuracy.model="elastic_wheel"').mesh_stiffness

"""Answers about indexers: closed forms, balances, what a run hands over."""

from __future__ import annotations

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.drives.indexer_cases import run_of
from tests.drives.test_indexer_published import number
from tests.kinematics.indexer_cases import DEGREE, pin_at, speed_of_wheel, tasks
from trochoid.drives.indexer.forces import Load, forces
from trochoid.drives.indexer.outline import flat, outline, to_space, to_wheel
from trochoid.kinematics.geneva import geneva
from trochoid.kinematics.indexer import Indexer, motion
from trochoid.kinematics.indexer_synthesis import Task, by_duration
from trochoid.results.outcome import Quantity

EXAMPLE = Path(__file__).parents[2] / "examples" / "indexer.toml"
ALL = [
    "indexing_motion",
    "solutions",
    "profile",
    "geometry_quality",
    "contact_force_max",
    "reactions",
    "mass",
]


def serving(task: Task, duration: float) -> list[Indexer]:
    return [x.indexer for x in by_duration(task, duration) if not x.fault]


@pytest.mark.independent
@given(task=tasks(), duration=st.floats(0.1, 0.9), friction=st.floats(0.0, 5.0))
@settings(max_examples=60, deadline=None)
def test_power_balances(task: Task, duration: float, friction: float) -> None:
    """Input power from forces of pin, teeth and bearings is M_f ω and the change of ½Jω²: no energy is put in."""
    for made in serving(task, duration):
        found = forces(made, Load(7.0, 0.3, friction, 0.08))
        assert found.residual() < 1e-9
        t = np.linspace(-0.9, 0.9, 7) * made.half_turn
        state = found.state(t)
        omega = np.array([speed_of_wheel(made, x) for x in t])
        np.testing.assert_allclose(
            state.input_torque, state.torque * omega, atol=1e-9 * float(np.abs(state.torque).max() + 1.0)
        )


@pytest.mark.independent
@given(task=tasks(), duration=st.floats(0.1, 0.9))
@settings(max_examples=30, deadline=None)
def test_an_index_takes_the_work_of_friction(task: Task, duration: float) -> None:
    """∫ M_in dφ over an index is M_f ψ_Σ: the wheel gives back what it was given."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    for made in serving(task, duration):
        load = Load(3.0, 0.1, 1.5, 0.1)
        state = forces(made, load).state(nodes * made.half_turn)
        work = float(weights @ state.input_torque) * made.half_turn
        top = 0.05 * (3.0 * float(np.abs(motion(made, nodes * made.half_turn).velocity).max())) ** 2
        if top < 1e3:
            assert work == pytest.approx(load.friction * task.swing, abs=1e-4 * (1.0 + top))


@pytest.mark.exact
def test_geneva_pin_force() -> None:
    """D = 90°, friction alone: F = M_f/(R sin α), α from the wheel's axis by spherical trigonometry; no tooth force."""
    wheel, load = geneva(90 * DEGREE), Load(1.0, 0.0, 3.0, 0.1)
    t = np.linspace(-1.5, 1.5, 31)
    state = forces(wheel, load).state(t)
    reach = np.arccos(math.sin(45 * DEGREE) * np.cos(t))
    np.testing.assert_allclose(state.pin, 3.0 / (0.1 * np.sin(reach)), rtol=1e-12)
    assert not state.tooth.any()
    force, at = forces(wheel, load).largest(lambda x: x.pin)
    assert force == pytest.approx(3.0 / (0.1 * math.sin(45 * DEGREE)), rel=1e-12)
    assert abs(at) < 1e-6


@pytest.mark.exact
def test_start_torque() -> None:
    """The index starts with J ε_start and friction; without the effect inertia with friction alone."""
    run = run_of()
    inertia = number(run.mass, "inertia_used")
    start = number(run.indexing_motion, "indexer", "acceleration_at_start")
    expected = inertia * start + 2.0
    assert number(run.contact_force_max, "indexer", "wheel_torque_at_start") == pytest.approx(expected)
    creeping = run_of("relative_turning_time = 0.2902", "effects=[]")
    assert number(creeping.contact_force_max, "indexer", "wheel_torque_at_start") == pytest.approx(2.0)
    still = run_of("relative_turning_time = 0.2902", "effects=[]", "operation.output_torque=0")
    assert number(still.contact_force_max, "indexer", "pin_force") == 0.0


@pytest.mark.exact
def test_inertia_of_a_shell() -> None:
    """A thin hemisphere (Geneva-like rim at 90°) has J = 2/3 m R²; a zone less."""
    run = run_of("pin_ratio = 0.527", "drive.wheel.thickness=0.001")
    mass, own = number(run.mass, "wheel"), number(run.mass, "wheel_inertia")
    rim = math.radians(number(run.profile, "indexer", "rim_angle"))
    c = math.cos(rim)
    assert mass == pytest.approx(7850 * 2 * math.pi * 0.1**2 * 1e-6 * (1 - c), rel=1e-6)
    assert own / (mass * 0.1**2) == pytest.approx((2 / 3 - c + c**3 / 3) / (1 - c), rel=1e-6)


@pytest.mark.exact
def test_speeds_and_ratio() -> None:
    """Mean speeds by counting: one index of 90° for a turn of the arm, the planet four turns back on it."""
    run = run_of()
    assert run.ratio.value == pytest.approx(4.0)
    speeds = run.member_speeds
    arm = number(speeds, "arm")
    assert number(speeds, "planet_on_arm") == pytest.approx(-4 * arm)
    assert abs(number(speeds, "wheel_mean_speed")) == pytest.approx(arm / 4)
    gamma = math.radians(number(run.profile, "arm_angle"))
    across, along = -4 * math.sin(gamma), 1 - 4 * math.cos(gamma)
    assert number(speeds, "planet") == pytest.approx(arm * math.hypot(across, along))


@pytest.mark.independent
def test_sense_of_the_wheel() -> None:
    """The example's wheel turns about its axis against the arm: by the velocity o × r of the pin's slot."""
    run = run_of()
    made = run.stages.design.indexer
    P = pin_at(made.path, 0.0).real
    v = (pin_at(made.path, 1e-6).real - P) / 1e-6
    about = float(np.cross(made.axis, P) @ v)
    assert math.copysign(1.0, about) == run.stages.design.turns == -1
    assert number(run.member_speeds, "wheel_mean_speed") < 0.0


@pytest.mark.exact
def test_all_solutions_are_listed() -> None:
    """By ρ all are there, in either train, with the reason where one does not serve; one is marked as chosen."""
    run = run_of("pin_ratio = 0.527")
    parts = run.solutions.parts
    assert parts is not None
    assert list(parts) == [f"solution_{k}" for k in range(1, 17)]
    assert len(parts) == len(run.stages.design.solutions)
    said = [
        tuple(str(row[key].value) for key in ("train", "place", "serves"))  # type: ignore[union-attr, index]
        for row in parts.values()
    ]
    assert [row for row in said if row[2] == "chosen"] == said[:1] == [("hypo", "near", "chosen")]
    serve = {row[:2] for row in said if row[2] in ("yes", "chosen")}
    assert serve == {("hypo", "near"), ("epi", "near"), ("hypo", "far"), ("epi", "far")}
    reasons = {row[2] for row in said} - {"yes", "chosen"}
    assert reasons == {"no, turns back on its way", "no, pin comes back in the dwell"}


@pytest.mark.exact
def test_nothing_but_rounding_is_shown_as_nothing() -> None:
    """No hard shock is 0; all keys of the answers are plain identifiers."""
    run = run_of()
    for name in ("indexer", "geneva_wheel"):
        assert number(run.indexing_motion, name, "hard_shock") == 0.0
    for quantity in (run.solutions, run.member_speeds, run.indexing_motion):
        assert all(key.isidentifier() for key in quantity.parts or {})


@pytest.mark.property
@pytest.mark.parametrize("train", ["hypo", "epi"])
@pytest.mark.parametrize("place", ["near", "far"])
def test_chosen_as_asked(train: str, place: str) -> None:
    """Train and place pick among the solutions."""
    run = run_of(f'pin_ratio = 0.527\nplace = "{place}"', f'drive.train="{train}"', "drive.pin_radius=1")
    path = run.profile.parts["path"]  # type: ignore[index]
    assert isinstance(path, Quantity)
    assert str(path.value).startswith(f"{train}trochoid, pin {place}")


@pytest.mark.property
def test_outcome_is_whole() -> None:
    """Series, drawing, pictures and checks of the whole example; ends of the index are shown from both sides."""
    run = run_of("relative_turning_time = 0.2902", f"ask.quantities={ALL}")
    made = run.outcome
    assert all(check.ok for check in made.checks)
    assert len(made.checks) == 5
    assert not made.warnings
    data = made.dataset
    assert data is not None
    assert list(data.mechanism.values) == ["indexer", "Geneva wheel"]
    epsilon = data.wheel_acceleration.sel(mechanism="indexer")
    half = 0.2902 * math.pi
    jump = float(np.abs(epsilon.sel(input_angle=half - 1e-9, method="nearest")))
    assert jump == pytest.approx(number(run.indexing_motion, "indexer", "acceleration_at_start"), rel=1e-6)
    assert float(epsilon.sel(input_angle=half + 1e-9, method="nearest")) == 0.0
    assert float(np.ptp(data.wheel_angle.values[:, 0])) == pytest.approx(math.pi / 2)
    assert np.isfinite(data.pin_force.values).all()
    assert float(np.abs(data.pin_force).max()) <= number(run.contact_force_max, "indexer", "pin_force") * (
        1 + 1e-12
    )
    assert made.plots[0].title == "Mechanism on its sphere"
    assert len(made.plots) == 8
    assert made.drawing is not None
    assert "solution_verdict" in data


@pytest.mark.property
def test_warnings() -> None:
    """A cusp whose pin comes back out, and a swing that no turn is made of, are said."""
    said = run_of("relative_turning_time = 0.25", 'ask.quantities=["profile"]').outcome.warnings
    assert len(said) == 1
    assert "turns the resting wheel by 4.7" in said[0]
    odd = run_of("pin_ratio = 0.5", "drive.swing_angle=100").outcome.warnings
    assert odd == (
        "3.6 swings make a turn of the wheel: it can index on and on in one sense only if a whole number does, "
        "as with swing_angle = 90",
    )


@pytest.mark.exact
def test_pressure_angles_of_the_geneva_wheel() -> None:
    """D = 90°, ψ_Σ = 90°: from the angle at the pin in the spherical triangle of both axes and the pin."""
    found = run_of().geometry_quality
    # pin at φ: its path is square to the arm, the slot's normal square to the circle from o; the angle between
    # both circles in the triangle with sides 45°, 90° and α follows from sin x = sin φ/sin α
    edge = math.radians(60.0)
    low, high = 0.0, 0.5 * math.pi
    for _ in range(60):
        phi = 0.5 * (low + high)
        alpha = math.acos(math.cos(phi) / math.sqrt(2.0))
        low, high = (low, phi) if math.sin(phi) / math.sin(alpha) > math.sin(edge) else (phi, high)
    assert number(found, "geneva_wheel", "share_of_index_above_60_deg") == pytest.approx(
        1 - 2 * low / math.pi
    )


@pytest.mark.exact
def test_outline_of_the_wheel() -> None:
    """On the sphere, within rim and bottom of the slots, four slots; back and forth between frames; true distances."""
    run = run_of()
    made, travel = run.stages.feasible, run.stages.slots["indexer"]
    shape = outline(made, travel)
    np.testing.assert_allclose(np.linalg.norm(shape, axis=-1), 1.0, atol=1e-14)
    reach = np.arccos(shape[:, 2])
    assert reach.max() == pytest.approx(travel.farthest, abs=1e-12)
    assert reach.min() == pytest.approx(travel.nearest - made.pin_angle, abs=1e-6)
    assert np.count_nonzero(np.diff((reach < travel.farthest - 1e-3).astype(int)) == 1) == 4
    np.testing.assert_allclose(to_wheel(to_space(shape, made.indexer), made.indexer), shape, atol=1e-15)
    np.testing.assert_allclose(np.linalg.norm(flat(shape, 0.1), axis=-1), 0.1 * reach, atol=1e-12)


@pytest.mark.property
def test_a_question_loads_only_what_it_needs() -> None:
    """`ratio` alone brings neither xarray nor plotly nor scipy's optimizers."""
    code = (
        "import sys; from trochoid import Run, load\n"
        f"run = Run(load({str(EXAMPLE)!r}, ('ask.quantities=[\"ratio\"]',))); run.outcome\n"
        "heavy = {'xarray', 'plotly', 'scipy.optimize', 'rich', 'gmsh', 'skfem'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
        "assert list(run.clock.seconds) == ['synthesis'], run.clock.seconds"
    )
    subprocess.run([sys.executable, "-c", code], check=True)

"""The running drive with friction: sliding speeds, losses, efficiency, and its limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.drives.khv_cases import EXAMPLE, NO_PLAY, drives, level_of
from trochoid.drives.khv.contact import assembly, layout
from trochoid.drives.khv.design import Design, design
from trochoid.drives.khv.running import Running, run
from trochoid.drives.khv.sliding import rates
from trochoid.fem.position import solve_positions
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene import Friction, load
from trochoid.scene.drive_khv import KhvScene

HAND = ("clearance",)  # the hand calculation: rigid discs on equal springs, their centres held
ELASTIC = ("elastic_contact", "pin_compliance", "clearance", "bearing_compliance", "inertia")
ANGLES = 2 * np.pi * np.arange(6) / 6


def rubbing(
    *overrides: str, ring: float = 0.05, output: float = 0.05, effects: tuple[str, ...] = ELASTIC
) -> KhvScene:
    """Return the example with friction and other values."""
    friction = f'{{type="friction", ring_pins={ring}, output_pins={output}}}'
    others = [f'{{type="{name}"}}' for name in effects]
    listed = f"effects=[{', '.join([*others, friction])}]"
    return load(EXAMPLE, (listed, 'ask.quantities=["ratio"]', *overrides))


def running(scene: KhvScene, angles: Array = ANGLES, rung: str = "level0") -> tuple[Design, Running]:
    """Return the running drive on a coarse mesh, or of rigid discs."""
    made = design(scene)
    bodies = level_of(made).elastic if scene.has("elastic_contact") else ()
    return made, run(made, rung if bodies else "springs", bodies, angles)


@pytest.mark.exact
@pytest.mark.parametrize("overrides", [NO_PLAY, ("drive.fixed=output", *NO_PLAY)])
def test_sliding_speeds_of_the_ideal_drive(overrides: tuple[str, ...]) -> None:
    """Flank past pin: (R S − r)/z_c, distance to the pitch point times the disc's spin; hole past roller: e z_p/z_c."""
    made = design(rubbing(*overrides, effects=HAND))
    crank, motions, flank = ANGLES * made.mesh_speed, layout(made, "springs"), made.flank
    problem = assembly(made, "springs", (), crank)
    states = {f.name: f.pair.at(np.zeros_like(problem.load)) for f in problem.families}
    found = rates(made, motions, states, np.zeros_like(problem.load), crank)
    for i, disc in enumerate(made.discs):
        K, phase = flank.trochoid_ratio, 2 * np.pi * np.arange(flank.pins) / flank.pins
        S = np.sqrt(1 + K**2 - 2 * K * np.cos(phase - (crank + disc.crank)[:, None]))
        ring, output = found[f"ring{i}"], found[f"output{i}"]
        expected = (flank.pin_circle_radius * S - flank.pin_radius) / flank.lobes
        assert np.abs(ring.sliding) == pytest.approx(expected, rel=1e-9)
        assert np.abs(output.sliding) == pytest.approx(
            flank.eccentricity * flank.pins / flank.lobes, rel=1e-9
        )
        assert np.abs(ring.closing).max() < 1e-12
        assert np.abs(output.closing).max() < 1e-12


@pytest.mark.independent
def test_sliding_is_what_material_points_do() -> None:
    """Speeds against difference quotients of two points, one fixed to the disc and one to its partner."""
    made = design(rubbing())
    crank, motions, h = np.array([0.3]), layout(made, "level0"), 1e-6
    problem = assembly(made, "level0", level_of(made).elastic, crank)
    contact = solve_positions(problem)
    states = {name: touch.state for name, touch in contact.touches.items()}
    found = rates(made, motions, states, contact.motion, crank)

    def gone(name: str, member: str, at: Array) -> Array:
        """Return the velocity of the material at points (c, 2): where it is a turn h of the crank later and earlier."""
        i = int(name[-1])
        disc, moved = made.discs[i], contact.motion[0]
        where = []
        for angle in (crank[0] + h, crank[0] - h):
            turn = crank[0] + disc.crank, angle + disc.crank
            e, z = made.flank.eccentricity, made.flank.lobes
            if member == "disc":
                own = motions.rows(f"disc{i}")[:2] @ moved
                old, new = (e * np.array([np.cos(t), np.sin(t)]) + own for t in turn)
                spin = -(angle - crank[0]) / z
            else:
                rows = {"ring": None, "output": "output", "bearing": "shaft"}[member]
                old = new = np.zeros(2) if rows is None else motions.rows(rows, disc.z)[:2] @ moved
                spin = {"ring": 0.0, "output": -(angle - crank[0]) / z, "bearing": angle - crank[0]}[member]
            c, s = np.cos(spin), np.sin(spin)
            where.append(new + (at - old) @ np.array([[c, s], [-s, c]]))
        return np.asarray(where[0] - where[1]) / (2 * h)

    for name, state in states.items():
        kind, point, normal = name[:-1], state.point[0], state.normal[0]
        apart = gone(name, "disc", point) - gone(name, kind, point)
        along = np.stack([-normal[:, 1], normal[:, 0]], axis=1)
        assert found[name].sliding[0] == pytest.approx((apart * along).sum(axis=1), abs=1e-9)
        assert found[name].closing[0] == pytest.approx((apart * normal).sum(axis=1), abs=1e-9)


@pytest.mark.property
@pytest.mark.parametrize("fixed", ["ring", "output"])
@pytest.mark.parametrize("effects", [HAND, ELASTIC, ("bearing_compliance", "clearance")])
def test_power_in_is_power_out_and_lost(effects: tuple[str, ...], fixed: str) -> None:
    """Torque of the input by the forces on its eccentrics against output, stored and lost work, at every position."""
    _, found = running(rubbing(f"drive.fixed={fixed}", ring=0.1, output=0.03, effects=effects))
    assert found.residual < 1e-9
    assert (found.ring.sum(axis=2) > 0).all()
    assert np.abs(found.stored).mean() < 2e-3 * found.input_torque.mean()


@pytest.mark.property
def test_torques_of_input_output_and_ring_balance() -> None:
    """With the flange held the ring gives the scene's torque: input and flange carry it together."""
    made, found = running(rubbing("drive.fixed=output", effects=HAND))
    assert found.input_torque + found.flange_torque == pytest.approx(400.0, rel=1e-9)
    assert made.scene.operation.output_torque == 400.0


@pytest.mark.exact
def test_no_friction_is_the_frictionless_drive() -> None:
    """μ = 0: the same contact forces to the last bit, nothing lost, and an efficiency of exactly 1."""
    scene = rubbing(ring=0.0, output=0.0)
    made, found = running(scene)
    plain = solve_positions(assembly(made, "level0", level_of(made).elastic, ANGLES * made.mesh_speed))
    assert np.array_equal(found.ring_force[:, 0], plain.touches["ring0"].force)
    assert not found.ring.any()
    assert Run(rubbing("ask.positions=4", ring=0.0, output=0.0, effects=HAND)).efficiency.value == 1.0


@pytest.mark.exact
def test_small_friction_loses_what_the_hand_formula_says() -> None:
    """Hand calculation at small μ: Σ μ F_k (R S_k − r)/z_c with F_k = T l_k/Σl², and μ ΣQ e z_p/z_c (sources §3)."""
    mu = 1e-6
    scene = rubbing(*NO_PLAY, "drive.discs=1", ring=mu, output=mu, effects=())
    made, found = running(scene)
    flank, pins = made.flank, made.drive.output_pins
    for n, crank in enumerate(ANGLES):
        K, z = flank.trochoid_ratio, flank.lobes
        phi = 2 * np.pi * np.arange(flank.pins) / flank.pins - crank
        S = np.sqrt(1 + K**2 - 2 * K * np.cos(phi))
        lever = np.maximum(flank.eccentricity * z * np.sin(phi) / S, 0.0)
        other = np.maximum(-flank.eccentricity * z * np.sin(phi) / S, 0.0)
        by_hand = []
        for side in (lever, other):  # the half that the load torque presses on
            force = 400 * side / (side**2).sum()
            by_hand.append(mu * (force * (flank.pin_circle_radius * S - flank.pin_radius)).sum() / z)
        assert found.ring[n].sum() == pytest.approx(
            min(by_hand, key=lambda x: abs(x - found.ring[n].sum())), rel=1e-5
        )
        gamma = (
            crank * (1 + 1 / z) - 2 * np.pi * np.arange(pins.count) / pins.count
        )  # eccentric against rollers
        share = np.maximum(np.sin(gamma), 0.0)
        force = 400 * share / (pins.circle_radius * (share**2).sum())
        assert found.output[n].sum() == pytest.approx(
            mu * force.sum() * flank.eccentricity * flank.pins / z, rel=1e-5
        )


@pytest.mark.property
def test_more_friction_loses_more() -> None:
    """Efficiency falls with each coefficient, and lies in the textbook's range 0.80 … 0.97 (sources §3)."""

    def efficiency(ring: float, output: float) -> float:
        scene = rubbing("ask.positions=4", "accuracy.facets_per_lobe=4", ring=ring, output=output)
        value = Run(scene).efficiency.value
        assert isinstance(value, float)
        return value

    base, more_ring, more_output = efficiency(0.03, 0.03), efficiency(0.06, 0.03), efficiency(0.03, 0.06)
    assert 0.80 < base < 0.97
    assert more_ring < base
    assert more_output < base


@pytest.mark.property
def test_strips_lose_what_level0_loses() -> None:
    """Resolved pressure changes the losses by less than 1e-3 of them."""
    scene = rubbing()
    (_, one), (_, other) = running(scene, ANGLES[:2]), running(scene, ANGLES[:2], "strips")
    assert other.ring.sum() == pytest.approx(one.ring.sum(), rel=1e-3)
    assert other.residual < 1e-9


@pytest.mark.property
def test_a_drive_that_locks_is_refused() -> None:
    """Far too much friction: no balance while running, and the message says what to do."""
    with pytest.raises(NotConverged, match=r"ring_pins = 1, .* may lock \(take coefficients up to 0\.3\)"):
        running(rubbing(ring=1.0, output=1.0))


@pytest.mark.property
def test_every_second_position() -> None:
    """Half of the positions are those at every second angle, with all their numbers."""
    _, found = running(rubbing(effects=HAND))
    half = found.every_second
    assert np.array_equal(half.angle, ANGLES[::2])
    assert np.array_equal(half.ring, found.ring[::2])
    assert replace(half, residual=0.0).residual == 0.0


@pytest.mark.property
@settings(max_examples=15, deadline=None)
@given(drives(pins=30), st.sampled_from([0.0, 0.02, 0.1, 0.3]))
def test_random_drives_run(given_scene: KhvScene, mu: float) -> None:
    """Any drive that can be built runs with friction up to 0.3, its power in balance at every position."""
    rubs = Friction(type="friction", ring_pins=mu, output_pins=mu)
    made = design(given_scene.model_copy(update={"effects": (*given_scene.effects, rubs)}))
    found = run(made, "springs", (), np.array([0.0, 2.0]))
    assert found.residual < 1e-8
    assert (found.ring >= 0).all()
    assert (mu == 0) == (not found.ring.any())

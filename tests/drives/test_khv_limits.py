"""Physics of the whole K-H-V chain: limits, balances, symmetries, and what effects do and do not change."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import trochoid
from trochoid.drives.khv.contact import assembly
from trochoid.drives.khv.outcome import disc_residual, torque_residual
from trochoid.drives.khv.stages import Stages
from trochoid.fem.position import solve_position
from trochoid.kinematics.types import Array

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
TORQUES = (1e-3, 1.0, 1e2, 400.0, 1e4)
QUICK = ("accuracy.facets_per_lobe=8", "ask.positions=12")
TIGHT = (
    "drive.modification.equidistant=0",
    "drive.output_pins.hole_clearance=0",
    "drive.eccentric_bearing.clearance=0",
)


def stages(*overrides: str) -> Stages:
    """Stages of the example with other values, on a coarse mesh if discs are elastic."""
    rigid = any(each.startswith("effects=") and "elastic_contact" not in each for each in overrides)
    quick = QUICK[1:] if rigid else QUICK
    made: Stages = trochoid.Run(trochoid.load(str(EXAMPLE), [*quick, *overrides])).stages
    return made


def stiffer(factor: float) -> tuple[str, ...]:
    """Overrides that multiply every stiffness of the example."""
    return (
        f"materials.steel.youngs_modulus={210000 * factor}",
        f"drive.input_shaft.bearing_stiffness={300000 * factor}",
        f"drive.output_flange.bearing_stiffness={500000 * factor}",
    )


def difference(s: Stages) -> float:
    """Largest difference of elastic from rigid reactions over the largest reaction."""
    found = s.reactions.fine
    assert found.elastic is not None
    apart = max(np.abs(found.elastic[m] - found.rigid[m]).max() for m in ("shaft", "output"))
    return float(apart / np.abs(found.rigid["shaft"]).max())


@pytest.mark.property
def test_elastic_reactions_become_rigid() -> None:
    """All stiffnesses × 1e6: elastic reactions are rigid ones within 1e-3, and the difference falls as 1/stiffness."""
    real, stiff, rigid = (difference(stages(*TIGHT, *stiffer(f))) for f in (1.0, 1e2, 1e6))
    assert real > 1e-4
    assert stiff == pytest.approx(real / 1e2, rel=0.5)
    assert rigid < 1e-3 * real


@pytest.mark.exact
def test_two_discs_balance_in_force_not_in_couple() -> None:
    """Discs at 180°: m e ω² cancels, the couple m e ω² (z₂ − z₁) stays and turns with the crank."""
    s = stages()
    load = s.reactions.fine.casing_rigid
    couple = s.design.disc_solid.mass * 0.0025 * s.design.crank_speed**2 * 0.012
    assert np.abs(load.force).max() < 1e-9
    assert np.linalg.norm(load.moment[:, :2], axis=1) == pytest.approx(couple, rel=1e-9)


@pytest.mark.property
@pytest.mark.parametrize(
    "overrides",
    [
        ("drive.fixed=output",),
        ("drive.discs=3", "drive.pins=13", "drive.lobes=12", "drive.input_shaft.radius=14"),
        ("drive.discs=1", "drive.output_pins.count=5"),
        ("drive.pins=41", "drive.lobes=40", "drive.eccentricity=1", "drive.pin_radius=3"),
        ("accuracy.model=strips", "operation.output_torque=4000"),
    ],
)
def test_forces_and_torques_balance(overrides: tuple[str, ...]) -> None:
    """Every disc and the flange are in equilibrium at every position, recomputed from the contacts, ≤ 1e-9."""
    s = stages("ask.positions=4", *overrides)
    assert s.contact.fine.imbalance < 1e-9
    assert max(disc_residual(s, i) for i in range(len(s.design.discs))) < 1e-9
    assert torque_residual(s) < 1e-9
    assert s.reactions.fine.residual < 1e-9


@pytest.mark.property
def test_units_do_not_matter() -> None:
    """The example's drive written in inches, N and pounds gives the same twist and forces within 1e-10."""
    inches = (
        f'drive.pin_circle_radius="{80 / 25.4!r} in"',
        f'drive.pin_radius="{0.5!r} cm"',
        'drive.eccentricity="2500 um"',
        'operation.output_torque="400000 N*mm"',
        'operation.input_speed="1500 rpm"',
        'materials.steel.youngs_modulus="210 GPa"',
    )
    one, other = stages().contact.fine, stages(*inches).contact.fine
    assert other.twist == pytest.approx(one.twist, rel=1e-10)
    assert other.ring.force == pytest.approx(one.ring.force, abs=1e-10 * one.ring.force.max())


@pytest.mark.property
def test_pin_forces_repeat_with_the_pins() -> None:
    """Equal springs: the set of ring-pin forces repeats after 360°/z_p of the crank (sources §3)."""
    s = stages("ask.positions=40", *_without("elastic_contact", "bearing_compliance"))
    force = np.sort(s.contact.fine.ring.force[:, 0], axis=1)
    assert force[2] == pytest.approx(force[0], abs=1e-9 * force.max())
    assert np.abs(force[1] - force[0]).max() > 1e-3 * force.max()


@pytest.mark.property
@pytest.mark.parametrize("gone", [(), ("bearing_compliance",)])
def test_torsional_stiffness_is_the_slope_of_the_torque(gone: tuple[str, ...]) -> None:
    """Against scenes of ±0.01 % of the torque at every position, laws that depend on it among them: 1e-5 (strips come
    into contact one by one: 1e-3 with them).
    """
    given = ("accuracy.model=level0", *(_without(*gone) if gone else ()))
    s = stages(*given)
    level, rung = s.contact.level, s.rung
    low, high = (
        stages(*given, f"operation.output_torque={400.0 * (1.0 + x)}").series(level, rung).twist
        for x in (-1e-4, 1e-4)
    )
    assert s.contact.fine.torsional_stiffness == pytest.approx(2e-4 * 400.0 / (high - low), rel=1e-5)


@pytest.mark.property
def test_torsional_stiffness_of_rigid_discs_is_the_slope_of_the_torque() -> None:
    """With the springs of the classical calculation held at those of the operation's torque, over ±0.1 % of it."""
    s = stages(*_without("elastic_contact", "bearing_compliance"))
    for i in (0, 5):
        problem = assembly(s.design, s.rung, (), float(s.contact.fine.crank[i]))
        step = np.zeros_like(problem.load)
        row = s.contact.fine.names.index("output.rotation")
        step[row] = 0.4
        low, high = (
            solve_position(replace(problem, load=problem.load + x * step)).motion[row] for x in (-1, 1)
        )
        assert s.contact.fine.torsional_stiffness[i] == pytest.approx(0.8 / (high - low), rel=1e-9)


@pytest.mark.property
def test_twist_grows_with_torque() -> None:
    """More torque, more twist, over seven decades."""
    twists = [
        stages("ask.positions=1", "accuracy.model=level0", f"operation.output_torque={t}").contact.fine.twist[
            0
        ]
        for t in TORQUES
    ]
    assert np.all(np.diff(twists) > 0)


@pytest.mark.property
def test_stiffness_is_symmetric_and_positive() -> None:
    """Action is reaction, and no motion of the loaded drive runs away."""
    for k in stages().contact.fine.stiffness:
        size = np.sqrt(np.diag(k))
        scaled = k / np.outer(size, size)
        assert np.array_equal(scaled, scaled.T)
        assert np.linalg.eigvalsh(scaled).min() > 1e-6


@pytest.mark.property
def test_equal_discs_share_equally() -> None:
    """With rigid bearings both discs carry half the load on average over a turn; an overhung flange changes that."""
    rigid = stages(*_without("bearing_compliance")).contact.fine
    whole = rigid.ring.force[:-1].sum(axis=(0, 2))
    assert whole[0] == pytest.approx(whole[1], rel=1e-2)
    overhung = stages().contact.fine.ring.force[:-1].sum(axis=(0, 2))
    assert overhung.max() / overhung.min() > 1.05


@pytest.mark.property
def test_an_effect_that_is_not_listed_is_not_in_the_equations() -> None:
    """Without "clearance" a modified flank is the theoretical one bit for bit, and the run says so."""
    given, none = stages(*_without("clearance")), stages(*TIGHT)
    assert np.array_equal(given.contact.fine.ring.force, none.contact.fine.ring.force)
    still = stages(*_without("casing_on_mounts"))
    assert np.array_equal(still.contact.fine.twist, stages().contact.fine.twist)


@pytest.mark.property
def test_reruns_are_equal_to_the_bit() -> None:
    """The same scene gives the same numbers to the last bit."""
    one, other = stages().contact.fine, stages().contact.fine
    assert np.array_equal(one.motion, other.motion)
    assert np.array_equal(one.ring.force, other.ring.force)


def mean_input_torque(s: Stages) -> Array:
    """Torque of the eccentrics' forces about the axis, N·m, at every position."""
    series, found = s.contact.fine, s.reactions.fine
    angle = series.crank[:-1, None] + np.array([d.crank for d in s.design.discs])
    x, y = (s.design.flank.eccentricity * f(angle) for f in (np.cos, np.sin))
    return np.asarray((x * found.eccentric[..., 1] - y * found.eccentric[..., 0]).sum(axis=1))


@pytest.mark.property
def test_power_in_is_power_out() -> None:
    """No friction: the mean input torque is the output torque over the ratio, within what a turn leaves open."""
    s = stages(*TIGHT, *_without("bearing_compliance"))
    assert np.abs(mean_input_torque(s)).mean() == pytest.approx(400 / 19, rel=5e-3)


def _without(*effects: str) -> tuple[str, ...]:
    """Override that lists all effects of the example but these."""
    every = (
        "elastic_contact",
        "pin_compliance",
        "clearance",
        "bearing_compliance",
        "inertia",
        "casing_on_mounts",
    )
    kept = ", ".join(f'{{type = "{e}"}}' for e in every if e not in effects)
    return (f"effects=[{kept}]",) + (('ask.quantities=["load_sharing"]',) if effects else ())

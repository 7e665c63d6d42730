"""Rigid against elastic: what stiffness feeds back into the reactions, and how it goes away."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.drives.khv_cases import EFFECTS, NO_PLAY, scene, without
from trochoid.drives.khv.contact import centrifugal
from trochoid.drives.khv.reactions import Reactions
from trochoid.drives.khv.stages import Stages
from trochoid.run import Run

ASKED = ("ask.positions=12", "accuracy.facets_per_lobe=4", 'ask.quantities=["reactions"]')


def stiffer(factor: float) -> tuple[str, ...]:
    """Return overrides that multiply every stiffness of the example."""
    return (
        f"materials.steel.youngs_modulus={210000 * factor}",
        f"drive.input_shaft.bearing_stiffness={300000 * factor}",
        f"drive.output_flange.bearing_stiffness={500000 * factor}",
    )


@cache
def run(*overrides: str, effects: tuple[str, ...] = EFFECTS) -> Run:
    """Return a run of the example at 12 positions on a coarse mesh."""
    return Run(scene(*ASKED, *overrides, effects=effects))


def stages(made: Run) -> Stages:
    """Return the stages of a run by their type."""
    found = made.stages
    assert isinstance(found, Stages)
    return found


def reactions(made: Run) -> Reactions:
    """Return the reactions on the finer level."""
    return stages(made).reactions.fine


def difference(found: Reactions) -> float:
    """Return the largest difference of elastic from rigid reactions over the largest reaction."""
    assert found.elastic is not None
    apart = max(np.abs(found.elastic[m] - found.rigid[m]).max() for m in ("shaft", "output"))
    return float(apart / np.abs(found.rigid["shaft"]).max())


@pytest.mark.property
def test_elastic_reactions_become_rigid() -> None:
    """Issue 2: all stiffnesses × 1e6, no play: elastic reactions are the rigid ones within 1e-3 (here 1e-9).

    The difference is the inertia of the elastic motion, and that motion falls as 1/stiffness, but for the
    logarithm of Hertz contacts that become narrower.
    """
    real, stiff, rigid = (difference(reactions(run(*NO_PLAY, *stiffer(f)))) for f in (1.0, 1e2, 1e6))
    assert real > 1e-4
    assert stiff == pytest.approx(real / 1e2, rel=0.5)
    assert rigid == pytest.approx(stiff / 1e4, rel=1.5)
    assert rigid < 1e-3


@pytest.mark.property
def test_difference_falls_with_the_square_of_the_speed() -> None:
    """Accelerations are as ω²: at a tenth of the speed a hundredth of the difference, far below resonance."""
    effects = without("elastic_contact")
    fast, slow = (
        difference(reactions(run(*NO_PLAY, f"operation.input_speed={n}", effects=effects))) for n in (300, 30)
    )
    assert slow == pytest.approx(fast / 100, rel=0.1)


@pytest.mark.exact
def test_elastic_forces_on_the_casing_are_the_inertia_of_the_motion() -> None:
    """Newton: what elastic and rigid casing loads differ by is −Σ m ẍ of the members' elastic motion."""
    found, made = reactions(run()), stages(run())
    assert found.response is not None
    pins = 8 * made.masses.output_pin.mass
    masses = {
        "disc": made.masses.disc.mass,
        "shaft": made.masses.shaft.mass,
        "output": made.masses.flange.mass + pins,
    }
    total = np.zeros((12, 2))
    for name, acceleration in zip(made.contact.fine.names, found.response.acceleration.T, strict=True):
        member, motion = name.split(".")
        if motion in ("x", "y"):
            total[:, "xy".index(motion)] -= masses[member.rstrip("0123456789")] * acceleration
    apart = found.casing.force[:, :2] - found.casing_rigid.force[:, :2]
    assert np.abs(total).max() > 1e-3
    assert apart == pytest.approx(total, abs=1e-9 * np.abs(total).max())


@pytest.mark.property
def test_the_reason_is_stated() -> None:
    """Issue 2: the reactions differ for a stated physical reason; without compliance there is none to state."""
    elastic = run().outcome.notes["Rigid and elastic reactions"]
    assert "inertia of that motion adds to the loads" in elastic
    rigid = run(effects=without("bearing_compliance"))
    assert "nothing to feed back" in rigid.outcome.notes["Rigid and elastic reactions"]
    assert reactions(rigid).elastic is None


@pytest.mark.exact
def test_two_discs_cancel_in_force_not_in_couple() -> None:
    """The forces m e ω² of two discs at 180° cancel; the couple m e ω² (z₂ − z₁) stays and turns with the crank."""
    load, made = reactions(run()).casing_rigid, stages(run())
    couple = made.masses.disc.mass * 2.5e-3 * (50 * np.pi) ** 2 * 0.012
    assert np.abs(load.force).max() < 1e-9 * couple / 0.012
    crank = made.contact.fine.angle[:-1]
    turning = couple * np.stack([np.sin(crank), -np.cos(crank)], axis=-1)  # (z₁ − z₂) k × (cos, sin)
    assert load.moment[:, :2] == pytest.approx(turning, abs=1e-9 * couple)


@pytest.mark.exact
def test_without_inertia_no_member_has_mass_in_the_equations() -> None:
    """No inertia: no centrifugal force, and the answers do not know the speed or the density."""
    asked = 'ask.quantities=["bearing_loads","torsional_stiffness"]'
    effects = without("inertia", "casing_on_mounts", "elastic_contact")
    plain = run(asked, effects=effects)
    assert not centrifugal(stages(plain).design, np.linspace(0, 6, 5)).any()
    heavy = run(asked, "operation.input_speed=9000", "materials.steel.density=20000", effects=effects)
    assert heavy.outcome.quantities == plain.outcome.quantities
    moving = run(asked, "operation.input_speed=9000", effects=without("elastic_contact"))
    assert moving.bearing_loads != plain.bearing_loads

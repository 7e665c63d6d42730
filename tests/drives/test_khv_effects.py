"""Effects and stages: what is not listed is not in the equations, and what is not asked for is not computed."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tests.drives.khv_cases import EFFECTS, NO_PLAY, drive, level_of, scene, turn, without
from trochoid.clock import Clock
from trochoid.drives.khv.answers import QUANTITIES
from trochoid.drives.khv.plan import STAGES_OF
from trochoid.drives.khv.series import Series
from trochoid.drives.khv.stages import Stages
from trochoid.results import Outcome
from trochoid.run import Run, plan

CONTACT = (
    'ask.quantities=["contact_force_max","contact_pressure_max","torsional_stiffness","bearing_stiffness"]'
)
QUICK = ("ask.positions=4", "accuracy.facets_per_lobe=4")


@cache
def outcome(*overrides: str, effects: tuple[str, ...] = EFFECTS) -> Outcome:
    """Return a run of the example at 4 positions on a coarse mesh."""
    return Run(scene(*QUICK, CONTACT, *overrides, effects=effects)).outcome


@pytest.mark.property
@pytest.mark.parametrize("elastic", [True, False])
def test_clearance_not_listed_is_no_clearance(elastic: bool) -> None:
    """Plays and modification given but "clearance" not listed: bit for bit the drive without any, and it is said."""
    play = (
        "drive.modification.equidistant=0.02",
        "drive.modification.radial=-0.01",
        "drive.modification.rotation=0.05",
        "drive.pin_clearance=0.01",
        "drive.output_pins.hole_clearance=0.05",
        "drive.eccentric_bearing.clearance=0.02",
    )
    missing = ("clearance",) if elastic else ("clearance", "elastic_contact")
    given, none = (outcome(*o, effects=without(*missing)) for o in (play, NO_PLAY))
    assert given.quantities == none.quantities
    assert any('"clearance" is not listed' in said for said in given.warnings)
    assert not any('"clearance" is not listed' in said for said in none.warnings)
    listed = outcome(*play, effects=EFFECTS if elastic else without("elastic_contact"))
    assert listed.quantities != none.quantities


@pytest.mark.property
def test_no_play_listed_is_no_clearance() -> None:
    """The effect "clearance" with all plays zero changes nothing."""
    assert outcome(*NO_PLAY).quantities == outcome(*NO_PLAY, effects=without("clearance")).quantities


@pytest.mark.property
def test_listed_friction_costs_nothing_until_an_answer_follows_it() -> None:
    """Discs are pressed along their flanks only for answers with friction; asked for later, these are the same."""
    asked, other = (
        Stages(scene(*QUICK, f'ask.quantities=["{name}"]', 'accuracy.model="level0"'), Clock())
        for name in ("efficiency", "torsional_stiffness")
    )
    assert asked.contact.level is not None
    assert asked.contact.level.rubs
    assert other.contact.level is not None
    assert not other.contact.level.rubs
    assert QUANTITIES["efficiency"](other) == QUANTITIES["efficiency"](asked)
    assert QUANTITIES["torsional_stiffness"](other) == QUANTITIES["torsional_stiffness"](asked)


@pytest.mark.property
def test_the_casing_does_not_touch_the_contacts() -> None:
    """Leaving out "casing_on_mounts" changes no number of the contacts."""
    plain, still = outcome(), outcome(effects=without("casing_on_mounts"))
    assert still.quantities == plain.quantities
    assert set(still.not_simulated) - set(plain.not_simulated) == {"casing_on_mounts"}


@cache
def series(*overrides: str, effects: tuple[str, ...]) -> Series:
    """Return contacts over a turn."""
    made = drive(*overrides, effects=effects)
    return turn(made, level_of(made), 4)


@pytest.mark.property
def test_rigid_pins_share_less() -> None:
    """Pins that do not yield: a stiffer drive, and the most loaded pin carries more."""
    soft, rigid = (series(effects=without("inertia", *e)) for e in ((), ("pin_compliance",)))
    assert (rigid.twist < soft.twist).all()
    assert (rigid.torsional_stiffness > soft.torsional_stiffness).all()
    assert (rigid.ring.force.max(axis=(1, 2)) > soft.ring.force.max(axis=(1, 2))).all()


@pytest.mark.property
def test_clearance_loads_fewer_pins_more() -> None:
    """Modification and plays: fewer pins carry, the largest force grows, and the flange turns further."""
    fit, loose = (series(effects=e) for e in (without("clearance"), EFFECTS))
    assert loose.ring.touching.sum() < fit.ring.touching.sum()
    assert loose.ring.force.max() > fit.ring.force.max()
    assert (loose.twist > fit.twist).all()


@pytest.mark.property
def test_inertia_presses_discs_outwards() -> None:
    """With inertia the forces on both eccentrics change by about m e ω²; the pins take the rest of it."""
    fast = "operation.input_speed=3000"
    still, moving = series(effects=without("inertia")), series(fast, effects=EFFECTS)
    size = drive(fast).eccentric_mass * 2.5e-3 * (100 * np.pi) ** 2
    assert still.bearing is not None
    assert moving.bearing is not None
    change = np.linalg.norm(moving.bearing.resultant - still.bearing.resultant, axis=-1)
    assert change.min() > 0.2 * size
    assert change.max() < 1.2 * size


@pytest.mark.property
@pytest.mark.parametrize("name", list(STAGES_OF))
def test_only_stages_asked_for_run(name: str) -> None:
    """The clock has the stages that the plan announces for a quantity, and no other but the figures."""
    rigid = () if name == "stress_max" else ("accuracy.model=springs",)
    asked = scene(*QUICK, *rigid, f'ask.quantities=["{name}"]')
    found = Run(asked).outcome
    ran = {stage.name for stage in found.stages} - {"figures"}
    announced = {stage.name for stage in plan(asked).stages if stage.needed}
    assert ran == announced
    assert announced <= set(STAGES_OF[name])
    assert set(found.not_needed) == {stage.name for stage in plan(asked).stages} - announced


@pytest.mark.property
def test_quantities_are_attributes() -> None:
    """The same names in Python, computed once, whatever is asked for; others are no attribute."""
    made = Run(scene())
    assert made.ratio == made.quantity("ratio")
    assert set(made.clock.seconds) == {"kinematics"}
    with pytest.raises(AttributeError, match="no quantity"):
        _ = made.mesh_stiffness

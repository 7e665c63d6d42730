"""Elastic contact of planetary sets: sharing, floating, errors, phasing, balances, and the whole through a scene."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.drives.planetary_cases import (
    ELASTIC,
    ERRORS,
    EXAMPLE,
    FLOATING,
    INERTIA,
    RELIEF,
    SMALL,
    level_of,
    series_of,
    stages_of,
    text,
)
from trochoid.drives.planetary import balance
from trochoid.drives.planetary.contact import Load, angles
from trochoid.drives.planetary.meshes import meshes
from trochoid.drives.planetary.picture import drawing
from trochoid.drives.planetary.roots import roots
from trochoid.drives.planetary.series import solve_series
from trochoid.drives.planetary.stages import Solved
from trochoid.faults import SceneFaults
from trochoid.kinematics.errors import Infeasible, NotConverged, SceneError
from trochoid.results import Quantity
from trochoid.run import Run, plan
from trochoid.scene import NEEDS, Override, read

WRONG_PLACE = "drive.planet.position_errors=[0.02]"


@pytest.mark.property
@pytest.mark.parametrize(
    ("torque", "seat"), [(1.0, 2e5), (1e-3, 2e5), (1.0, 2e7), (200.0, 1e9), (200.0, 2e11)]
)
def test_planets_without_load_are_no_fault(torque: float, seat: float) -> None:
    """One planet 20 µm ahead under a stiff sun: with little torque, or in seats up to 1e6 times stiffer, it carries
    more than its share or all, in equilibrium.
    """
    given = (
        "drive.planet.position_errors=[-0.02]",
        "drive.sun.bearing_stiffness=1e6",
        f"drive.planet.bearing_stiffness={seat}",
    )
    s = stages_of(*given, effects=(ELASTIC, FLOATING, ERRORS))
    full, torque = s.load, torque / 200.0
    load = Load(full.driven * torque, full.sun * torque, 0.0)
    series = solve_series(s.feasible, s.speeds, level_of(), load, angles(s.feasible, s.speeds, 3), "level0")
    assert series.imbalance < 1e-9
    assert balance.load_residual(series) < 1e-9
    assert (series.shares[:, 0] > 0.6).all()
    if torque < 0.01:
        assert not series.sun.force[:, 1:].any()
        assert series.shares[:, 0] == pytest.approx(1.0, abs=1e-12)


@pytest.mark.property
def test_seats_too_soft_for_the_load_are_said_so() -> None:
    """Planets that would move farther than they are large: NotConverged says that what holds them is too soft."""
    given = ("operation.output_torque=1e5", "drive.planet.bearing_stiffness=2")
    with pytest.raises(NotConverged, match="too soft for the load"):
        series_of(*given, effects=(ELASTIC, FLOATING), positions=2)


@pytest.mark.property
@pytest.mark.parametrize(
    ("effects", "overrides"),
    [
        ((ELASTIC,), ()),
        ((ELASTIC, FLOATING, ERRORS, INERTIA), (WRONG_PLACE,)),
        ((ELASTIC, FLOATING, ERRORS), (WRONG_PLACE, "drive.sun.bearing_stiffness=50000")),
        ((ELASTIC,), ('drive.fixed="carrier"',)),
        ((ELASTIC, FLOATING), ('drive.driving="carrier"',)),
        ((ELASTIC,), ('drive.fixed="sun"', 'drive.driving="ring"')),
    ],
)
def test_members_and_power_balance(effects: tuple[str, ...], overrides: tuple[str, ...]) -> None:
    """Recomputed from the forces on the teeth: every member in equilibrium, power closed, ≤ 1e-9."""
    stages, series = series_of(*overrides, effects=effects)
    assert series.imbalance < 1e-9
    assert balance.planet_residual(series) < 1e-9
    assert balance.load_residual(series) < 1e-9
    assert balance.torque_residual(series) < 1e-9
    assert balance.power_residual(series, stages.speeds) < 1e-9
    if series.layout.floating:
        assert balance.seat_residual(stages.feasible, series) < 1e-9
    found = balance.torques(series)
    for (
        name,
        torque,
    ) in stages.rigid.torques.items():  # elastic motion and errors of 20 µm change arms a little
        assert found[name] == pytest.approx(np.full(6, torque), rel=3e-3)


@pytest.mark.exact
def test_equal_planets_share_evenly() -> None:
    """By symmetry; nothing is left for the members' bearings; all tooth numbers are multiples of three."""
    _, series = series_of()
    assert series.shares == pytest.approx(np.full((6, 3), 1.0 / 3.0), abs=1e-9)
    size = np.abs(series.bearing).max()
    for force in series.members.values():
        assert np.abs(force).max() < 1e-9 * size


@pytest.mark.exact
def test_the_mean_force_of_a_mesh_is_its_torque_over_the_base_radius() -> None:
    """Where all contacts lie on the involutes, the forces of a mesh add up to T/(N r_b), in the ring as well."""
    stages, series = series_of(relief=0.03, effects=(ELASTIC, RELIEF))
    base = level_of("edge", 0.03).wheels[0].flank.base_radius
    wanted = stages.load.sun / (3 * base)
    for touches in (series.sun, series.ring):
        assert touches.force.sum(axis=2) == pytest.approx(np.full((6, 3), wanted), rel=2e-3)


@pytest.mark.independent
def test_an_error_loads_held_planets_as_their_springs_say() -> None:
    """Sun and planets' seats held: a planet e ahead on its orbit opens both its meshes by e cos α_w.

    With the meshes' own stiffness, solved one by one, its force falls by 2 e cos α_w k, less what the output gives.
    """
    error = 4e-6
    stages, series = series_of("drive.planet.position_errors=[0.004]", effects=(ELASTIC, ERRORS))
    made = meshes(stages.feasible, level_of(), stages.load, 6)
    soft = [float((p.force.sum(axis=1) / p.error).mean()) for p in (made.outer, made.inner)]
    k = 1.0 / (1.0 / soft[0] + 1.0 / soft[1])
    cosine = math.cos(float(stages.feasible.geometry.outer.operating_angle))
    drop = 2.0 * error * cosine * k * (1.0 - 1.0 / 3.0)
    base = level_of().wheels[0].flank.base_radius
    found = stages.load.sun / base * (1.0 / 3.0 - series.shares[:, 0].mean())
    # a mesh by itself twists the planet against its bore, two of them do not: 10 % of a mesh's compliance
    assert found == pytest.approx(drop, rel=0.15)


@pytest.mark.independent
def test_a_floating_sun_evens_out_three_planets() -> None:
    """Three forces on a free sun balance only if they are equal: errors move it, and do not load planets unevenly."""
    _, held = series_of(WRONG_PLACE, "drive.sun.bearing_stiffness=1e9", effects=(ELASTIC, FLOATING, ERRORS))
    _, free = series_of(WRONG_PLACE, effects=(ELASTIC, FLOATING, ERRORS))
    assert np.abs(held.shares - 1.0 / 3.0).max() > 0.05
    assert np.abs(free.shares - 1.0 / 3.0).max() < 2e-3
    assert 5e-6 < np.hypot(*free.moved("sun")[:, :2].T).mean() < 40e-6


@pytest.mark.exact
def test_planets_out_of_phase_follow_each_other() -> None:
    """19/17/53: planet i does what planet 0 does, a third of a pitch (i·z_sun/3) earlier in the sun's mesh."""
    _, series = series_of(phased=True, positions=9)
    for touches in (series.sun, series.ring):
        total = touches.force.max(axis=2)
        for i in (1, 2):
            rolled = [np.abs(np.roll(total[:, 0], shift) - total[:, i]).max() for shift in range(9)]
            assert min(rolled) < 1e-6 * total.max()
            assert int(np.argmin(rolled)) in (3, 6)
    # all together repeat three times in a pitch, the output with them
    assert series.lag == pytest.approx(np.roll(series.lag, 3), rel=1e-9)
    assert np.ptp(series.lag) > 1e-2 * series.lag.mean()


@pytest.mark.property
def test_fixing_another_member_changes_no_force() -> None:
    """The same sun torque with the ring or the carrier fixed: the meshes do not know which stands still.

    The wind-up turns the one or the other, and the contacts by it along their paths: 1e-4 rad, some thousandths.
    """
    _, ring = series_of("operation.output_torque=200")
    _, carrier = series_of('drive.fixed="carrier"', "operation.output_torque=150")
    for one, other in ((ring.sun, carrier.sun), (ring.ring, carrier.ring)):
        assert other.force == pytest.approx(one.force, rel=5e-3, abs=5.0)


@pytest.mark.property
def test_turning_the_load_round_mirrors_the_set() -> None:
    """The carrier drives: the other flanks carry, with the same forces at the mirrored positions.

    The wind-up now turns the sun, four times as far: contacts stand elsewhere on their paths by as much.
    """
    angle = np.array([0.0, 0.05, 0.13])
    _, one = series_of(at=angle)
    stages, other = series_of('drive.driving="carrier"', "operation.output_torque=50", at=-angle / 4.0)
    assert stages.load.sun == pytest.approx(-50.0)
    assert other.sun.force.max(axis=2) == pytest.approx(one.sun.force.max(axis=2), rel=5e-3)


@pytest.mark.property
def test_a_ring_free_to_bend_makes_the_set_softer() -> None:
    """Outer edge held or torque taken evenly: the rim then bends inward between the planets."""
    _, edge = series_of()
    _, evenly = series_of(held="evenly")
    assert float(evenly.torsional_stiffness.mean()) < 0.9 * float(edge.torsional_stiffness.mean())
    assert evenly.shares == pytest.approx(np.full((6, 3), 1.0 / 3.0), abs=1e-8)


@pytest.mark.property
def test_tip_relief_takes_the_edges_pressure_away() -> None:
    """Edges that meet early have several times the pressure; 10 µm of relief take that away."""
    positions = 24
    _, sharp = series_of(positions=positions)
    _, eased = series_of(effects=(ELASTIC, RELIEF), relief=0.01, positions=positions)
    assert eased.sun.pressure.max() < 0.6 * sharp.sun.pressure.max()
    assert eased.lag.mean() > sharp.lag.mean()


@pytest.mark.property
def test_the_stiffness_is_the_slope_of_the_lag() -> None:
    """Two loads nearby, by differences, at every position: contacts that wander along the flanks are in it."""
    _, less = series_of("operation.output_torque=199.98", effects=(ELASTIC, FLOATING))
    _, more = series_of("operation.output_torque=200.02", effects=(ELASTIC, FLOATING))
    _, at = series_of(effects=(ELASTIC, FLOATING))
    assert 0.04 / (more.lag - less.lag) == pytest.approx(at.torsional_stiffness, rel=2e-4)


@pytest.mark.independent
def test_level_0_agrees_with_resolved_pressure() -> None:
    """Strips on the same coupling; 0.5 % of the lag and 1 % of the pressure inside the flanks."""
    found = [
        series_of(effects=(ELASTIC, RELIEF), relief=0.01, rung=rung, positions=3)[1]
        for rung in ("level0", "strips")
    ]
    assert found[0].lag == pytest.approx(found[1].lag, rel=5e-3)
    assert found[0].sun.pressure.max() == pytest.approx(found[1].sun.pressure.max(), rel=1e-2)


@pytest.mark.property
def test_inertia_presses_floating_planets_outward() -> None:
    """m ω² a joins the teeth's forces on every bearing; held planets hand it to the carrier all the same."""
    stages, series = series_of("operation.input_speed=9000", effects=(ELASTIC, FLOATING, INERTIA))
    out = series.places / np.linalg.norm(series.places, axis=1, keepdims=True)
    radial = np.einsum("nix,ix->ni", series.bearing, out)
    assert stages.load.centrifugal > 100.0
    assert radial == pytest.approx(np.full(radial.shape, stages.load.centrifugal), rel=0.02)


@pytest.mark.exact
def test_shafts_twist_by_the_torques_that_they_carry() -> None:
    """By hand: T_sun = T/4, T_ring = 3T/4; each adds T_m²/(T k) to the wind-up, nothing to any force."""
    given = (
        "drive.sun.torsional_stiffness=20000",
        "drive.ring.torsional_stiffness=2e6",
        "drive.carrier.torsional_stiffness=3e5",
    )
    _, rigid = series_of(effects=(ELASTIC, FLOATING), positions=2)
    _, found = series_of(*given, effects=(ELASTIC, FLOATING), positions=2)
    more = 50.0**2 / 200.0 / 20000.0 + 150.0**2 / 200.0 / 2e6 + 200.0 / 3e5
    assert found.lag - rigid.lag == pytest.approx(np.full(2, more), rel=1e-9)
    assert 1.0 / found.torsional_stiffness - 1.0 / rigid.torsional_stiffness == pytest.approx(
        np.full(2, more / 200.0)
    )
    assert found.sun.force == pytest.approx(rigid.sun.force, rel=1e-12)
    _, unheeded = series_of(*given, positions=2)
    assert unheeded.twists == {}


@pytest.mark.property
def test_root_stress_follows_the_load() -> None:
    """Alike for all planets; half the torque has half of it, but for where contacts stand."""
    found = []
    for torque in (100, 200):
        stages, series = series_of(f"operation.output_torque={torque}", positions=3)
        found.append(roots(stages.feasible, stages.speeds, level_of(), series))
    half, whole = found
    assert whole.planet == pytest.approx(np.repeat(whole.planet[:, :1], 3, axis=1), rel=1e-6)
    for one, two in ((half.sun, whole.sun), (half.planet, whole.planet), (half.ring, whole.ring)):
        assert two == pytest.approx(2.0 * one, rel=0.03)
    # F_t/(b m) times form and stress concentration, 2 to 3.5 for these teeth
    nominal = stages.load.sun / (3 * 18.5e-3) / (20e-3 * 2e-3)
    assert 1.5 * nominal < whole.sun.max() < 4.0 * nominal


@pytest.mark.property
def test_arrows_of_the_solved_contacts_hold_each_planet() -> None:
    """Forces in the drawing, turned into the fixed frame: no resultant on any planet."""
    stages, series = series_of(effects=(ELASTIC, FLOATING))
    stages.__dict__["contact"] = Solved(series, None, level_of(), None)
    for frame in drawing(stages).frames:
        for planet in (1, 2, 3):
            acting = [a for a in frame.arrows if a.label.endswith(f"planet {planet}")]
            assert len(acting) >= 3
            assert np.abs(sum(a.vector for a in acting)).max() < 1e-6 * max(
                np.abs(a.vector).max() for a in acting
            )


@pytest.mark.property
def test_a_run_has_numbers_with_errors_and_checks_that_hold() -> None:
    """Everything through the scene on two levels: every number of the contacts has its error and its model."""
    names = [name for name, needs in NEEDS["planetary"].items() if needs] + ["bearing_loads"]
    asked = Override(("ask", "quantities"), names, "test")
    needle = 'drive.planet.bearing={kind="needle", bore=14, outside=22, width=16}'
    scene = read(
        text(SMALL),
        [asked, needle, "ask.positions=6", "accuracy.facets_per_lobe=12", 'accuracy.model="level0"'],
    )
    made = Run(scene).outcome
    assert all(check.ok for check in made.checks)
    assert len(made.checks) == 12
    stiffness = made.quantities["torsional_stiffness"]
    assert stiffness.model == "level0"
    assert stiffness.error is not None
    assert 0.0 < stiffness.error < 0.01 * float(stiffness.value or 0.0)
    assert made.dataset is not None
    assert {"planet_torque_share", "transmission_error", "mesh_stiffness_sun_planet"} <= set(
        made.dataset.data_vars
    )
    assert "Load along the paths of contact" in [plot.title for plot in made.plots]
    for variable in made.dataset.variables.values():
        assert variable.attrs["long_name"]


@pytest.mark.property
@pytest.mark.parametrize("quantity", [name for name, needs in NEEDS["planetary"].items() if needs])
def test_quantities_of_contact_need_its_effect(quantity: str) -> None:
    """Design: an error that names both."""
    with pytest.raises(SceneFaults, match=f'"{quantity}" needs the effects? "elastic_contact"'):
        read(text(SMALL), ["effects=[]", Override(("ask", "quantities"), [quantity], "test")])


@pytest.mark.property
def test_what_cannot_be_is_refused() -> None:
    """No torque, too few facets, errors for some of the planets only, a model of other drives."""
    with pytest.raises(SceneFaults, match=r"needs operation\.output_torque above 0: no flank is pressed"):
        stages_of("operation.output_torque=0")
    with pytest.raises(Infeasible, match=r"2 planets cannot centre a sun that floats; take 3 or more"):
        stages_of("drive.planets=2", effects=(ELASTIC, FLOATING)).feasible  # noqa: B018
    with pytest.raises(
        Infeasible, match=r"a sharp edge has no contact law|tip rounding .* leaves no involute"
    ):
        stages_of("drive.tip_rounding=5").feasible  # noqa: B018
    with pytest.raises(SceneError, match=r"facets_per_lobe: given 6; .* at least 10"):
        stages_of("accuracy.facets_per_lobe=6").levels  # noqa: B018
    with pytest.raises(
        SceneFaults, match=r"given 4 position_errors; need at most one for each of the 3 planets"
    ):
        stages_of("drive.planet.position_errors=[0.01, 0, 0, 0]")
    with pytest.raises(
        SceneFaults, match=r'"springs" is not a model of planetary drives; it has "level0", "strips"'
    ):
        stages_of('accuracy.model="springs"')


@pytest.mark.property
def test_check_plans_the_contacts() -> None:
    """`trochoid check` knows what the contacts need, and solves nothing."""
    made = plan(read(text(SMALL), ['ask.quantities=["bearing_loads"]']))
    needed = {stage.name for stage in made.stages if stage.needed}
    assert {"bodies", "contact", "forces", "mass"} <= needed
    assert "blocking" not in needed
    rigid = plan(read(text(SMALL), ["effects=[]", 'ask.quantities=["bearing_loads"]']))
    assert "contact" not in {stage.name for stage in rigid.stages if stage.needed}


@pytest.mark.property
def test_a_planet_far_behind_carries_nothing() -> None:
    """0.2 mm behind the others it stays out of mesh: two share the torque, its roots have no tension."""
    found = Run(
        read(
            EXAMPLE.read_text(encoding="utf-8"),
            (
                'ask.quantities=["load_sharing", "stress_max"]',
                "ask.positions=4",
                "accuracy.facets_per_lobe=10",
                "drive.planet.position_errors=[0.2]",
            ),
        )
    )
    assert found.load_sharing.parts is not None
    of_planets = found.load_sharing.parts["mean_share_of_the_torque"]
    inner = of_planets.parts if isinstance(of_planets, Quantity) else of_planets
    assert inner is not None
    shares = [float(getattr(each, "value", -1.0)) for each in inner.values()]
    assert min(shares) == 0.0
    assert sum(shares) == pytest.approx(1.0, abs=1e-9)
    assert found.stress_max.parts

"""Rolling bearings of a scene: geometry from their tables, seats by finite elements, loads and stiffness that agree."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.drives.rv_cases import drive as rv_drive
from trochoid.clock import Clock
from trochoid.drives.khv.bearings import loads as khv_loads
from trochoid.drives.khv.stages import Stages as KhvStages
from trochoid.drives.planetary.bearings import local
from trochoid.drives.planetary.design import design as planetary_design
from trochoid.drives.precessional.bearings import Carried
from trochoid.drives.precessional.stages import Stages as PrecessionalStages
from trochoid.drives.precessional.tooth_loads import ToothLoads
from trochoid.drives.precessional.yielding import depends_on_load, period
from trochoid.drives.rolling import endured, faults, held, rolling, sized
from trochoid.drives.rolling_answers import life_parts, stiffness_parts
from trochoid.drives.rolling_seat import Seated, SeatLevels, seat_levels, seated
from trochoid.drives.rv.supports import supports
from trochoid.fem.bearing_equilibrium import solve as solve_rigid
from trochoid.fem.rolling_assumed import assumed_ball_bearing, assumed_roller_bearing
from trochoid.fem.rolling_ball import BallBearing
from trochoid.fem.rolling_roller import RollerRow
from trochoid.fem.seat import plain_rollers, seat_compliance
from trochoid.fem.seat_equilibrium import solve_seated
from trochoid.kinematics.errors import Infeasible
from trochoid.scene import load
from trochoid.scene.drive_precessional import Support
from trochoid.scene.materials import Material
from trochoid.scene.rolling import RollingBearing, Seat

EXAMPLES = Path(__file__).parents[2] / "examples"
STEEL = {"steel": Material(youngs_modulus=210000, poissons_ratio=0.3, density=7850)}
ROUND = 1500.0 * np.stack([np.cos(np.arange(12) * np.pi / 6), np.sin(np.arange(12) * np.pi / 6)], axis=1)


def table(kind: str = "cylindrical", **values: Any) -> RollingBearing:
    """Return a bearing table, sizes in mm."""
    sizes: dict[str, Any] = {"bore": 20, "outside": 42, "width": 12}
    return RollingBearing(kind=kind, **(sizes | values))  # type: ignore[arg-type]


# --- geometry ---------------------------------------------------------------------------------------------------------


@pytest.mark.exact
def test_tables_are_bearings_of_the_library() -> None:
    """Boundary dimensions are assumed, what is given besides takes its place; an inner geometry needs none."""
    assert rolling(table("deep_groove")) == assumed_ball_bearing(20e-3, 42e-3, 12e-3)
    assert rolling(table()) == assumed_roller_bearing(20e-3, 42e-3, 12e-3)
    assert rolling(table(straight_rollers=True)).drop == ()  # type: ignore[union-attr]
    own: dict[str, Any] = {"bore": None, "outside": None, "width": None}
    groove = {"inner_groove": 11.63 / 22.23, "outer_groove": 11.63 / 22.23, "axial_load": 1000}
    sizes = {"elements": 16, "element_diameter": 22.23, "pitch_diameter": 125.26, "contact_angle": 40}
    found = rolling(table("angular_contact", **own, **groove, **sizes))
    assert isinstance(found, BallBearing)
    assert found.groove_distance == pytest.approx(2 * 11.63e-3 - 22.23e-3, rel=1e-12)
    assert found.balls == 16
    assert found.contact_angle == pytest.approx(np.radians(40))
    row = rolling(
        table("needle", **own, elements=24, element_diameter=2.5, pitch_diameter=30, element_length=16)
    )
    assert isinstance(row, RollerRow)
    assert (row.rollers, row.roller_diameter, row.pitch_diameter, row.length) == (24, 2.5e-3, 30e-3, 16e-3)
    both = rolling(table("tapered", axial_load=100, pitch_diameter=30.5, elements=12, clearance=-0.01))
    assert (both.pitch_diameter, both.clearance) == (30.5e-3, -1e-5)


@pytest.mark.property
def test_misfits_are_named_with_what_would_fit() -> None:
    """Elements that overlap, a ring without wall, rollers longer than their ring: one sentence for each bearing."""
    tables = {
        "a": table(elements=60),
        "b": table("deep_groove", elements=40),
        "c": table(seat=Seat(thickness=5), element_diameter=10.9, elements=6),
        "d": table(seat=Seat(thickness=5), element_length=13),
        "e": table(),
        "f": None,
    }
    found = faults(tables)
    assert [reason.split(".")[0].split(":")[0] for reason in found] == ["a", "b", "c", "d"]
    assert "overlap" in found[0]
    assert "nearest feasible number of rollers is" in found[0]
    assert "leaves no outer ring; need at least" in found[2]
    assert "element_length = 13 mm is more than width = 12 mm" in found[3]


@pytest.mark.property
@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"kind": "deep_groove", "width": 0.1}, "the width of a bearing lies between 2.2 and 44 mm"),
        ({"bore": 1, "outside": 1000}, "the outside of a bearing lies between 1.03 and 6 mm"),
        (
            {"kind": "needle", "bore": 200, "outside": 206.5, "width": 3},
            "elements of 2.275 mm .* more than 200",
        ),
        ({"clearance": 1}, r"clearance = 1 mm with elements of 5.94 mm: .* need 0.594 mm at most"),
        ({"kind": "deep_groove", "clearance": -0.7}, "so loose or so tight; need 0.66 mm at most"),
    ],
)
def test_sizes_that_no_bearing_has(values: dict[str, Any], said: str) -> None:
    """Outside of the proportions of ISO 15 nothing is assumed; play and press fit are a share of the elements."""
    with pytest.raises(Infeasible, match=said):
        rolling(table(**values))


# --- stiffness under loads --------------------------------------------------------------------------------------------


@pytest.mark.property
def test_load_that_goes_round_leaves_no_direction() -> None:
    """Mean over a turn of the load: isotropic; a given radial load takes the place of its size, not its direction."""
    found = held("X", table("deep_groove"), ROUND)
    np.testing.assert_allclose(found.mean[0, 0], found.mean[1, 1], rtol=1e-3)
    assert abs(found.mean[0, 1]) < 1e-3 * found.radial
    assert found.extremes[0] > 1.1 * found.radial  # along the load it is stiffer than across
    given = held("X", table("deep_groove", radial_load=1500), 1e-3 * ROUND)
    np.testing.assert_allclose(given.mean, found.mean, rtol=1e-9, atol=1e-9 * found.radial)


@pytest.mark.property
def test_bearing_that_resists_nothing_is_refused_by_name() -> None:
    """Play and no load: not a stiffness of zero, but a refusal that says what helps; each of that does."""
    loose = {"clearance": 0.02}
    with pytest.raises(Infeasible, match=r"shaft bearing resists nothing.*radial_load.*preload.*a stiffness"):
        held("shaft bearing", table("deep_groove", **loose), np.zeros((1, 2)))
    assert held("X", table("deep_groove", **loose, radial_load=100), np.zeros((1, 2))).radial > 0.0
    assert held("X", table("deep_groove", clearance=-0.005), np.zeros((1, 2))).radial > 0.0
    with pytest.raises(Infeasible, match=r"shaft bearing: .*cannot pass the load"):
        held("shaft bearing", table("tapered", axial_load=10), ROUND)


@pytest.mark.property
def test_load_that_no_bearing_carries_is_refused_by_name() -> None:
    """Beyond 10 GPa a Hertz pressure means nothing; a ball off its groove is told in N and µm."""
    with pytest.raises(Infeasible, match=r"^shaft: \d+ GPa on a raceway under .* axial one of 1e\+09 N"):
        held("shaft", table("deep_groove", axial_load=1e9), ROUND)
    tilting = np.array([[1426.6451791294848, 0.0, 0.0, 30.0, 0.0]])
    said = r"^shaft: .*\(F_x, F_y, F_z\) = \(1427, 0, 426.6\) N .*a ball would leave .* \([-., \d]+\) µm and .* µrad"
    with pytest.raises(Infeasible, match=said):
        held("shaft", table("angular_contact", axial_load=426.6451791294848), tilting, upright=False)


@pytest.mark.exact
def test_given_force_leaves_the_moment() -> None:
    """`radial_load` is the force's size alone, however small the force was, `moment_load` the moment's."""
    loads = np.array([[0.0, -1e-3, 0.0, 3.0, 4.0]])
    given = {"kind": "deep_groove", "bore": 30, "outside": 55, "width": 13, "spread": 30}
    force = sized(Support(**given, radial_load=2000), loads)  # type: ignore[arg-type]
    np.testing.assert_allclose(force, [[0.0, -2000.0, 0.0, 3.0, 4.0]], rtol=1e-15)
    both = sized(Support(**given, radial_load=2000, moment_load=10), loads)  # type: ignore[arg-type]
    np.testing.assert_allclose(both, [[0.0, -2000.0, 0.0, 6.0, 8.0]], rtol=1e-15)


@pytest.mark.exact
def test_teeth_load_the_bearings_in_the_frame_of_the_shaft() -> None:
    """Statics, written anew there: with n = (0, s, c), M_B = (A − B) × R_A is what the shaft needs at B."""
    s, c, arm, support = np.sin(0.1), np.cos(0.1), 0.06, 0.11
    a = np.array([300.0, -700.0, 50.0])  # on the satellite, in the crank's frame, n = (s, 0, c)
    moment = np.cross([arm * s, 0.0, arm * c - support], a)
    teeth = ToothLoads(a[None], -0.5 * a[None], a[None], moment[None], moment[None, 2], moment)
    none = np.zeros((1, 2))
    found = Carried(none, none, none, none).beside(teeth)
    turned = np.array([700.0, 300.0, 50.0])
    np.testing.assert_allclose(found.a[0], turned[:2], rtol=1e-14)
    np.testing.assert_allclose(found.b[0], -turned[:2], rtol=1e-14)
    wanted = np.cross([0.0, arm * s, arm * c - support], turned)
    np.testing.assert_allclose(found.b_moment[0], -wanted[:2], rtol=1e-13)


@pytest.mark.property
def test_axial_load_alone() -> None:
    """A preload along the axis holds the shaft across it and leaves no direction; life and safety are those of F_a."""
    found = held("X", table("angular_contact", axial_load=500), np.zeros((1, 2)))
    assert found.mean[0, 0] == pytest.approx(found.mean[1, 1], rel=1e-3)
    assert found.mean[2, 2] > 0.0
    parts = life_parts(found, 100.0)
    assert parts["radial_load_max"].value == 0.0
    assert parts["axial_load"].value == 500.0
    assert {"static_safety", "L10", "L10r", "L10r_hours"} <= parts.keys()


@pytest.mark.property
def test_centrifugal_force_counts_where_it_is_asked_for() -> None:
    """Balls that go round press the outer race more, and the bearing lasts less; standing still nothing changes."""
    plain = held("X", table("deep_groove"), ROUND)
    still = held("X", table("deep_groove", centrifugal=True), ROUND, None, (0.0, 0.0))
    np.testing.assert_array_equal(still.mean, plain.mean)
    fast = held("X", table("deep_groove", centrifugal=True), ROUND, None, (4000.0, 0.0))
    assert fast.duty.element_load > 1.01 * plain.duty.element_load
    assert endured(fast).reference < endured(plain).reference


@pytest.mark.property
def test_nothing_infinite_is_answered() -> None:
    """A preloaded bearing without load has no equivalent load: safety and basic life are left out."""
    parts = life_parts(held("X", table("deep_groove", clearance=-0.005), np.zeros((1, 2))), 100.0)
    assert "static_safety" not in parts
    assert "L10" not in parts
    assert all(np.isfinite(each.value) for each in parts.values())  # type: ignore[arg-type]


# --- seats ------------------------------------------------------------------------------------------------------------


def seat_at(load_: float = 2000.0, materials: Any = STEEL, **values: Any) -> Seated:
    """Return what a seat leaves of a bearing in it."""
    levels = seat_levels(table(seat=Seat(**values)), materials)
    assert levels is not None
    return seated("X", levels, load_)


def levels_at(materials: Any = STEEL, **values: Any) -> SeatLevels:
    """Return a seat by finite elements."""
    levels = seat_levels(table(seat=Seat(**values)), materials)
    assert levels is not None
    return levels


@pytest.mark.property
def test_thinner_housing_is_softer() -> None:
    """On four supports: the rigid ring is too stiff, the thinner the wall the more; the error is well below that."""
    thick, thin = seat_at(thickness=12), seat_at(thickness=3)
    assert 5.0 < thick.too_stiff < thin.too_stiff
    assert thin.too_stiff_error < 0.02 * thin.too_stiff
    assert thin.largest > 1.0


@pytest.mark.exact
def test_seat_a_million_times_stiffer_is_rigid() -> None:
    """Compliance of the seat × 10⁻⁶: displacement and 4×4 stiffness on a rigid ring within 1e-6."""
    levels = levels_at(thickness=3)
    rollers = plain_rollers(levels.row)
    matrix = 1e-6 * seat_compliance(rollers, levels.at(levels.facets), 2000.0)
    push = 2000.0 * np.array([np.cos(0.007), np.sin(0.007)])
    soft, hard = solve_seated(rollers, matrix, push), solve_rigid(rollers, np.append(push, [0.0, 0.0]))
    np.testing.assert_allclose(soft.displacement, hard.displacement[:2], rtol=1e-6)
    unit = np.array([1.0, 1.0, rollers.length, rollers.length])
    off = (soft.stiffness - hard.stiffness) / np.outer(unit, unit)
    assert np.abs(off).max() < 1e-6 * hard.stiffness[0, 0]


@pytest.mark.exact
def test_housing_a_million_times_stiffer_only_holds_the_ring() -> None:
    """Modulus of the housing × 10⁶ and × 10⁸: the outer ring alone is left, the same within 1e-6."""
    stiff = {
        name: Material(youngs_modulus=f"{210e9 * factor} Pa", poissons_ratio=0.3, density=7850)  # type: ignore[arg-type]
        for name, factor in (("a", 1e6), ("b", 1e8))
    }
    one, two = (seat_at(materials=stiff, thickness=6, material=name, supports=0) for name in stiff)
    assert one.along == pytest.approx(two.along, rel=1e-6)
    assert one.across == pytest.approx(two.across, rel=1e-6)
    assert (
        abs(one.too_stiff) < 20.0
    )  # a ring that is held at its outside has hardly more or less than the standard's


@pytest.mark.independent
def test_joined_ring_and_housing_are_one_wall() -> None:
    """Steel in steel, all round held: meshed as one wall, or as two bodies where the housing is a hair wider."""
    one, two = seat_at(thickness=6, supports=0), seat_at(thickness=6, supports=0, width=12.0 * (1 + 1e-9))
    assert two.along == pytest.approx(one.along, rel=2e-3)


@pytest.mark.property
def test_seat_scales_the_matrix_in_the_frame_of_the_load() -> None:
    """Symmetric, positive semi-definite, along each load times its share; said as a number with an error."""
    levels = levels_at(thickness=4)
    bearing = levels.table
    found = held("X", bearing, ROUND, levels)
    assert found.seat is not None
    bare = held("X", bearing, ROUND)
    np.testing.assert_allclose(found.stiffness, np.swapaxes(found.stiffness, 1, 2), atol=1e-6 * found.radial)
    assert np.linalg.eigvalsh(found.stiffness)[:, 0].min() > -1e-6 * found.radial
    assert found.extremes[0] == pytest.approx(found.seat.along * bare.extremes[0], rel=1e-12)
    said = stiffness_parts(found)["rigid_ring_over_flexible"]
    assert said.value == pytest.approx(100.0 * (1.0 / found.seat.along - 1.0))
    assert said.error is not None


@pytest.mark.property
@pytest.mark.parametrize("force", [1e-6, 1.0, 2e3])
def test_error_of_the_rigid_ring_reaches_to_zero(force: float) -> None:
    """No housing stiffens a bearing: where the seat's law has less than the standard's, the error says as much."""
    levels = levels_at(thickness=30, supports=0)
    found = seated("X", levels, force)
    assert found.too_stiff + found.too_stiff_error >= 0.0
    assert found.laws < (0.01 if force > 1e3 else 0.15)


# --- drives -----------------------------------------------------------------------------------------------------------

SHAFT = 'drive.input_shaft.bearing={kind="deep_groove", bore=30, outside=55, width=13}'


@pytest.mark.property
def test_khv_loads_and_stiffnesses_agree() -> None:
    """Solved with the stiffnesses that the shaft's bearings end with, their loads give these stiffnesses again."""
    text = (EXAMPLES / "cycloid.toml").read_text().replace("bearing_stiffness = 300000\n", "", 1)
    from trochoid.scene import read

    made = KhvStages(read(text, [SHAFT, 'ask.quantities=["bearing_stiffness"]']), Clock()).feasible
    pair = made.bearings.rolling["shaft"]
    for one, stiffness in zip(pair, made.supports["shaft"], strict=True):
        assert one.radial == pytest.approx(stiffness, rel=1e-9)
    assert made.supports["output"] == (5e8, 5e8)
    from dataclasses import replace

    from trochoid.drives.khv.bearings import ABOUT, POSITIONS, _member
    from trochoid.drives.khv.contact import assembly, layout
    from trochoid.fem.position import solve_positions

    again = replace(made, supported=made.supports)
    crank = 2 * np.pi * np.arange(POSITIONS) / POSITIONS * made.mesh_speed
    motion = solve_positions(assembly(again, "springs", (), crank)).motion
    names = layout(made, "springs").names
    for one, stiffness in zip(
        _member(again, names, motion, "shaft", None), made.supports["shaft"], strict=True
    ):
        assert one.radial == pytest.approx(stiffness, rel=ABOUT)
    # both bearings balance what the discs put on the shaft, which is the load of neither by itself
    forces = khv_loads(again, names, motion, "shaft")
    assert np.linalg.norm(forces.sum(axis=0), axis=1).max() < np.linalg.norm(forces, axis=2).max()


@pytest.mark.exact
def test_given_stiffness_stands_in_the_place_of_the_computed_one() -> None:
    """With both, the number counts and no bearing is solved for the contacts: supports as of the number alone."""
    plain, both = (
        KhvStages(load(EXAMPLES / "cycloid.toml", extra), Clock()).feasible for extra in ((), (SHAFT,))
    )
    assert plain.supports == both.supports
    assert both.supports["shaft"] == (3e8, 3e8)


@pytest.mark.exact
def test_rv_cranks_stand_in_equal_springs() -> None:
    """Rolling bearings that are alike in all directions are the spring of the same number, to the last bits."""
    made = rv_drive()
    given = made.drive.crankshaft.bearing_stiffness
    assert given is not None
    bare = made.drive.crankshaft.model_copy(update={"bearing_stiffness": None})
    from dataclasses import replace

    scene = made.scene.model_copy(update={"drive": made.drive.model_copy(update={"crankshaft": bare})})
    rolled = supports(replace(made, scene=scene), 1e8, given * np.tile(np.eye(2), (2, 1, 1)))
    np.testing.assert_allclose(rolled.total, supports(made, 1e8).total, rtol=1e-9)
    along = np.stack([np.diag([2.0, 1.0])] * 2) * given
    leaning = supports(replace(made, scene=scene), 1e8, along).bearing
    for j, place in enumerate(made.crank_places):
        out = place / np.linalg.norm(place)
        assert float(out @ leaning[j, 0] @ out) == pytest.approx(2.0 * given)


@pytest.mark.property
def test_planet_is_held_along_its_force() -> None:
    """The bearing is stiffest along the planet's force, which turns with its place; without a table a number counts."""
    needle = 'drive.planet.bearing={kind="needle", bore=20, outside=32, width=20}'
    given = r"bearing_stiffness = 200000\n|\[drive.planet.bearing\]\n(\w+ = .*\n)+"
    text = re.sub(given, "", (EXAMPLES / "planetary.toml").read_text())
    from trochoid.scene import read

    made = planetary_design(read(text, [needle]))
    seat = made.planet_seat
    assert seat is not None
    force = seat.bearing.duty.loads[0, :2]
    values, axes = np.linalg.eigh(seat.stiffness)
    assert abs(axes[:, 1] @ force) == pytest.approx(np.linalg.norm(force), rel=1e-3)
    assert values[1] > 1.05 * values[0] > 0.0
    for angle in (0.0, 1.0, 4.0):
        place = 0.052 * np.array([np.cos(angle), np.sin(angle)])
        axes_ = local(place)
        np.testing.assert_allclose(
            axes_ @ seat.at(place) @ axes_.T, seat.stiffness, rtol=1e-9, atol=1e-6 * values[1]
        )
    usual = planetary_design(read(text, ['ask.quantities=["bearing_loads"]']))
    assert usual.seat_stiffness(np.array([0.05, 0.0])) == 2e8
    assert usual.planet_seat is None


BARE = [
    'drive.bearing_a={kind="cylindrical", bore=20, outside=42, width=12}',
    'drive.bearing_b={kind="deep_groove", bore=30, outside=55, width=13, spread=30}',
    "drive.output_shaft={mass=1.5}",
    'drive.bearing_c={kind="deep_groove", bore=45, outside=75, width=16, number=2}',
    'ask.quantities=["bearing_stiffness", "bearing_life", "reactions", "natural_frequencies"]',
]


@pytest.mark.property
def test_precessional_loads_and_stiffnesses_agree() -> None:
    """A, B, C under the members' inertia alone: their loads are the mean reactions of the drive that stands on them."""
    stages = PrecessionalStages(load(EXAMPLES / "precessional.toml", BARE), Clock())
    found = stages.yielding
    assert found is not None
    assert depends_on_load(found.joints)
    mean = Carried.by(found.elastic.reactions(period(stages.mechanism))).mean
    used = {joint.name: joint.bearings for joint in found.joints.all}
    np.testing.assert_allclose(used["A"][0].duty.loads[0, :2], mean.a[0], rtol=1e-4, atol=1e-3)
    np.testing.assert_allclose(2.0 * used["C"][0].duty.loads[0, :2], mean.c[0], rtol=1e-4, atol=1e-3)
    both = sum(one.duty.loads[0, :2] for one in used["B"])
    np.testing.assert_allclose(both, mean.b[0], rtol=1e-4, atol=1e-3)
    assert set(stages.bearings) == {"A", "B", "C"}
    # the output shaft moves on C alone across z
    joint = found.joints.c
    assert joint is not None
    np.testing.assert_allclose(joint.stiffness[:2, :2], 2.0 * used["C"][0].mean[:2, :2], rtol=1e-12)
    assert joint.rigid == (2, 3, 4, 5)


@pytest.mark.property
def test_precessional_seat_softens_and_is_said() -> None:
    """A thin housing at A: less stiffness there, nowhere else, and the answer names how much a rigid ring is wrong."""
    from trochoid.run import Run

    effects = 'effects=[{type="bearing_compliance"}, {type="inertia"}]'
    plain = [
        effects,
        "drive.bearing_a.straight_rollers=true",
        'ask.quantities=["bearing_stiffness", "bearing_life"]',
    ]
    seat = [*plain, "drive.bearing_a.seat={thickness=4}"]
    rigid, soft = (Run(load(EXAMPLES / "precessional.toml", extra)) for extra in (plain, seat))
    one, two = (dict[str, Any](run.bearing_stiffness.parts or {}) for run in (rigid, soft))
    assert two["a"]["radial"].value < 0.9 * one["a"]["radial"].value
    for name in ("radial", "tilt"):
        assert two["b"][name].value == one["b"][name].value
    assert two["a"]["rigid_ring_over_flexible"].value > 10.0
    assert two["a"]["rigid_ring_over_flexible"].error is not None
    lives = dict[str, Any](soft.bearing_life.parts or {})
    assert set(lives) == {"a", "b_1", "b_2"}
    assert lives["a"]["L10r"].value > 0.0

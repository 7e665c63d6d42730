"""The RV drive through its scene against closed forms: speeds, geometry, conditions of assembly, masses, motions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.drives.rv_cases import EXAMPLE, drive, part, scene
from trochoid.drives.rv.picture import gear_outlines, planet_start
from trochoid.kinematics.errors import Infeasible
from trochoid.run import Run, plan
from trochoid.scene import load, read
from trochoid.scene.needs import NEEDS


@pytest.mark.published
@pytest.mark.parametrize(("fixed", "ratio"), [("ring", 121.0), ("carrier", -120.0), ("sun", 121 / 120)])
def test_ratios_of_the_sources(fixed: str, ratio: float) -> None:
    """Sources §1, teeth 12/36/39/40: 121, −120, 121/120 for the three fixed members, through the scene."""
    run = Run(scene(f"drive.fixed={fixed}"))
    assert run.ratio.value == ratio
    assert part(run.member_speeds, fixed) == 0.0


@pytest.mark.published
def test_speeds_of_the_sources() -> None:
    """Sources §1: ω_g/ω_a = −39/121, ω_f = ω_h = ω_a/121."""
    speeds = Run(scene("operation.input_speed=1210")).member_speeds
    assert part(speeds, "planet") == pytest.approx(-390.0, rel=1e-15)
    for member in ("disc", "carrier"):
        assert part(speeds, member) == pytest.approx(10.0, rel=1e-15)


@pytest.mark.published
def test_example_is_of_the_class() -> None:
    """The reference drive: 12/36, 40 pins, 39 lobes, R 64, r 3, e 1.3 mm, ratio 121, 412 N·m; it asks for all."""
    found = load(EXAMPLE)
    c, f = found.drive.cycloid, found.drive.first_stage
    assert (f.z_sun, f.z_planet, c.pins, c.lobes, c.discs) == (12, 36, 40, 39, 2)
    assert (c.pin_circle_radius, c.pin_radius, c.eccentricity) == (0.064, 0.003, 0.0013)
    assert found.operation.output_torque == 412.0
    assert found.ask.quantities == tuple(NEEDS["rv"])


@pytest.mark.exact
def test_torques_of_the_three_members_balance() -> None:
    """Torques are as 1 : i − 1 : −i: the ring carries 120/121 of the carrier's, or all of its own."""
    assert drive().ring_torque == pytest.approx(412 * 120 / 121, rel=1e-15)
    assert drive("drive.fixed=carrier").ring_torque == 412.0
    assert drive("drive.fixed=sun").ring_torque == pytest.approx(412 * 120 / 121, rel=1e-15)


@pytest.mark.exact
def test_first_stage_closed_forms() -> None:
    """Shifts ±x leave the centre distance m(z_a + z_g)/2 and α_w = 20°; by default the least that avoids undercut."""
    profile = Run(scene()).profile
    assert part(profile, "first_stage", "center_distance") == pytest.approx(36.0, rel=1e-14)
    assert part(profile, "first_stage", "operating_pressure_angle") == pytest.approx(20.0, rel=1e-12)
    assert part(profile, "sun", "tip_diameter") == pytest.approx(1.5 * (12 + 2 * 1.4), rel=1e-13)
    raw = load(EXAMPLE).model_dump()["drive"]["first_stage"]
    assert raw["x_sun"] == 0.4
    text = EXAMPLE.read_text().replace("x_sun = 0.4\n", "").replace("x_planet = -0.4\n", "")
    chosen = Run(read(text)).profile
    assert part(chosen, "sun", "shift") == 0.3  # 1 − 6 sin² 20° = 0.2981
    assert part(chosen, "planet", "shift") == -0.3


@pytest.mark.exact
def test_given_centre_distance_decides_the_shift_of_the_planet() -> None:
    """x_Σ = z_Σ (inv α_w − inv α)/(2 tan α) with cos α_w = a cos α/a_w."""
    text = EXAMPLE.read_text().replace("x_planet = -0.4\n", "center_distance = 36.3\n")
    profile = Run(read(text)).profile
    alpha = math.radians(20)
    operating = math.acos(36 / 36.3 * math.cos(alpha))
    inv = math.tan(operating) - operating - math.tan(alpha) + alpha
    assert part(profile, "planet", "shift") == pytest.approx(48 * inv / (2 * math.tan(alpha)) - 0.4, rel=1e-9)
    assert part(profile, "first_stage", "center_distance") == pytest.approx(36.3, rel=1e-14)


@pytest.mark.exact
def test_balance_of_two_and_three_discs() -> None:
    """Opposite discs leave no force and the couple F·pitch; three discs, a third of a turn apart, no force either."""
    two = Run(scene()).balance
    assert part(two, "unbalanced_force") == 0.0
    force = part(two, "inertia_force_with_eccentrics")
    assert part(two, "unbalanced_couple") == pytest.approx(force * 0.010, rel=1e-12)
    one = Run(scene("drive.cycloid.discs=1")).balance
    assert part(one, "unbalanced_force") == pytest.approx(
        part(one, "inertia_force_with_eccentrics"), rel=1e-14
    )
    mass = part(Run(scene()).mass, "discs") / 2
    speed = 1815 * 39 / 121 * math.pi / 30  # of the crankshafts
    assert part(one, "inertia_force_of_a_disc") == pytest.approx(mass * 1.3e-3 * speed**2, rel=1e-12)


@pytest.mark.exact
@pytest.mark.parametrize("cranks", [2, 3])
def test_teeth_of_the_drawing_do_not_cut_into_each_other(cranks: int) -> None:
    """Each planet stands so that no point of its outline lies inside the sun's teeth at the start of the drawing."""
    made = drive(f"drive.first_stage.cranks={cranks}")
    planet = gear_outlines(made)[1]
    gear = made.first.pair.first
    for j, place in enumerate(made.crank_places):
        turn = planet_start(made, j)
        c, s = math.cos(turn), math.sin(turn)
        points = planet @ np.array([[c, s], [-s, c]]) + place
        radius, angle = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
        inside = (radius > gear.base_radius) & (radius < made.first.tips[0])
        space = np.abs((angle[inside] * 12 / (2 * np.pi) + 0.5) % 1.0 - 0.5) * 2 * np.pi / 12
        assert inside.sum() > 10
        assert (gear.flank_angle(radius[inside]) - space).min() > -1e-9


@pytest.mark.property
@pytest.mark.parametrize(
    ("override", "said"),
    [
        (
            "drive.first_stage.cranks=5",
            r"5 equal crankshafts cannot be assembled: sun \+ planet = 48(.|\n)*built: first_stage.cranks = 3",
        ),
        ("drive.first_stage.cranks=4", "4 planets of radius 27.9 mm on a circle of radius 36 mm collide"),
        (
            "drive.first_stage.x_sun=0.2;drive.first_stage.x_planet=-0.2",
            "undercut of the sun: 0.2 must be ≥ 0.29813\nthe nearest that can be built: first_stage.x_sun = 0.299",
        ),
        (
            "drive.first_stage.center_distance=36.5",
            "not coaxial\n(.|\n)*the nearest that can be built: first_stage.x_planet = -0.04998",
        ),
        ("drive.first_stage.center_distance=30", "the base circles need more than"),
        ("drive.cycloid.eccentricity=1.7", "it must be less than pin_circle_radius/pins = 1.6 mm"),
        (
            "drive.cycloid.pin_radius=4.7",
            "the flank is undercut; the nearest feasible pin_radius is just below 4.6",
        ),
        ("drive.arm_bearing.hole_radius=24", "crank holes .* break into the flank by 0.3 mm"),
        ("drive.carrier.pillars.radius=22", "windows of radius 24 mm .* break into the flank"),
        ("drive.cycloid.bore_radius=20", "break into the bore by 1 mm"),
        ("drive.arm_bearing.rollers=16", "overlap in a bore of radius 17 mm; take them smaller than"),
        ("drive.arm_bearing.roller_length=10", "it must be at most cycloid.face_width = 9 mm"),
        ("drive.crankshaft.radius=10", "it must be at most raceway radius less eccentricity = 9.698 mm"),
        ("drive.crankshaft.planet_position=10", "the planets cut into the discs; .* 14 mm"),
        ("drive.crankshaft.bearing_positions=[-5,16]", "on both sides of the discs, at -9.5 mm or below"),
        ("drive.ring.outer_radius=66", "it must enclose the pins, more than 67 mm"),
    ],
)
def test_what_cannot_be_built_is_refused(override: str, said: str) -> None:
    """Every reason is one sentence with what binds and the nearest feasible value, by run and by check."""
    with pytest.raises(Infeasible, match=said):
        _ = Run(scene(*override.split(";"))).geometry_quality
    with pytest.raises(Infeasible, match=said):
        plan(scene(*override.split(";")))


@pytest.mark.property
def test_only_the_stages_that_a_question_needs_run() -> None:
    """A ratio does not look at the geometry, even of a drive that cannot be built."""
    run = Run(scene("drive.cycloid.bore_radius=20"))
    assert run.ratio.value == 121.0
    assert set(run.stages.clock.seconds) == {"kinematics"}


@pytest.mark.property
def test_drawing_has_both_stages_and_closes() -> None:
    """Every frame has the same lines, and discs that touch their pins without cutting into them."""
    from trochoid.drives.rv.picture import drawing

    run = Run(scene())
    _ = run.geometry_quality
    frames = drawing(run.stages, 4).frames
    names = [line.name for line in frames[0].lines]
    assert {"sun", "planet 1", "planet 2", "disc 1", "disc 2", "ring pin 40", "pillar 2"} <= set(names)
    assert all([line.name for line in frame.lines] == names for frame in frames)
    flank, design = run.stages.design.flank, run.stages.design
    for (
        frame
    ) in frames:  # discs touch their pins: no pin centre is nearer to the flank than r − Δr of the grinding
        for i in range(2):
            disc = next(line for line in frame.lines if line.name == f"disc {i + 1}").xy
            for k in range(40):
                center = next(line for line in frame.lines if line.name == f"ring pin {k + 1}").xy.mean(
                    axis=0
                )
                nearest = np.linalg.norm(disc - center, axis=1).min()
                assert nearest > flank.pin_radius - 1e-6
        pins = np.array([ln.xy.mean(axis=0) for ln in frame.lines if ln.name.startswith("ring pin")])
        disc = next(line for line in frame.lines if line.name == "disc 1").xy
        away = np.linalg.norm(disc[None] - pins[:, None], axis=-1).min(axis=1)
        assert (away < flank.pin_radius + design.modification.equidistant + 2e-5).all()


@pytest.mark.property
def test_check_lists_the_stages_that_the_effects_have() -> None:
    """Without elastic contact nothing is meshed; without friction nothing is lost."""

    def stages(*effects: str) -> set[str]:
        return {stage.name for stage in plan(scene('ask.quantities=["mass"]', effects=effects)).stages}

    assert stages("inertia") == {"kinematics", "geometry", "mass"}
    of_contact = {"mesh", "teeth", "bodies", "contact", "stress", "reversal"}
    assert stages("elastic_contact") == {*stages("inertia"), *of_contact}
    assert stages("elastic_contact", "friction") == {*stages("elastic_contact"), "losses"}

"""Closed forms of planetary sets, reached through the scene: the source's numbers, equilibrium, pictures."""

from __future__ import annotations

import math
import subprocess
import sys
from decimal import ROUND_HALF_UP, Decimal
from itertools import permutations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.drives.planetary_cases import stages_of as small_stages
from trochoid.clock import Clock
from trochoid.drives.planetary.dataset import dataset
from trochoid.drives.planetary.mesh_phase import period, places
from trochoid.drives.planetary.picture import drawing
from trochoid.drives.planetary.plots import plots
from trochoid.drives.planetary.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "planetary.toml"
TABLE_1 = {  # sources §4, Table 1, mm: sun, planet, ring; what the source has with another planet tip or +x is below
    "reference_diameter": ("40.000", "60.000", "160.000"),
    "tip_diameter": ("45.464", "66.000", "162.652"),
    "root_diameter": ("37.000", "57.536", "171.159"),
    "pitch_diameter": ("41.600", "62.400", "166.400"),
    "constant_chord": ("3.417", "3.589", "0.501"),
    "constant_chord_height": ("2.110", "2.347", "-1.417"),
    "rho_at_chord": ("8.658", "12.170", "27.095"),
    "rho_active_end": ("5.126", "9.493", "39.436"),
    "span": ("16.005", "28.277", "72.559"),
    "span_teeth": ("3", "5", "12"),
    "rho_at_span": ("8.002", "14.138", "36.279"),
    "rho_tip": ("12.788", "17.155", "31.025"),
    "roller_circle_diameter": ("42.864", "63.412", "165.034"),
    "roller_diameter": ("3.464", "3.464", "3.464"),
    "rho_at_roller": ("8.569", "12.778", "35.757"),
    "size_over_rollers": ("46.328", "66.876", "161.570"),
    "tooth_thickness": ("3.870", "4.065", "0.568"),
    "rho_involute_end": ("3.917", "8.120", "40.697"),
    "tip_thickness": ("1.304", "1.372", "1.616"),
}
MESHES = {
    ("sun_and_planet", "ratio"): "1.50",
    ("sun_and_planet", "contact_ratio"): "1.298",
    ("sun_and_planet", "least_shift_of_sun_without_undercut"): "-0.170",
    ("sun_and_planet", "least_shift_of_planet_without_undercut"): "-0.755",
    ("planet_and_ring", "contact_ratio"): "1.424",
    ("planet_and_ring", "contact_ratio_with_that_tip"): "1.450",
    ("planet_and_ring", "planet_tip_diameter_of_this_mesh_alone"): "66.159",
    ("planet_and_ring", "rho_active_end_of_ring_with_that_tip"): "39.588",
}


def stages_of(*overrides: str) -> Stages:
    return Stages(load(EXAMPLE, overrides), Clock())


def answers(*names: str, overrides: tuple[str, ...] = ()) -> dict[str, Any]:
    """The answers by name, parts as nested dictionaries of values."""
    run = Run(load(EXAMPLE, overrides))
    return {name: values(run.quantity(name)) for name in names}


def values(part: Any) -> Any:
    if isinstance(part, dict):
        return {name: values(inner) for name, inner in part.items()}
    return values(part.parts) if part.parts is not None else part.value


def digits(value: float, printed: str) -> str:
    return str(Decimal(f"{value:.9f}").quantize(Decimal(printed), ROUND_HALF_UP))


@pytest.mark.published
def test_table_1_through_the_scene() -> None:
    """Sources §4: every row of Table 1; rows with errata as they are right."""
    found = answers("profile")["profile"]
    for name, printed in TABLE_1.items():
        for wheel, number in zip(("sun", "planet", "ring"), printed, strict=True):
            assert digits(found[wheel][name], number) == number, (wheel, name)
    for (mesh, name), number in MESHES.items():
        assert digits(found[mesh][name], number) == number, (mesh, name)
    angle = found["sun_and_planet"]["operating_pressure_angle"]
    assert round(angle * 3600) == 25 * 3600 + 22 * 60 + 16
    for wheel, (d, m, s) in {"sun": (28, 43, 40), "planet": (27, 14, 9), "ring": (24, 21, 6)}.items():
        assert math.floor(3600 * found[wheel]["roller_pressure_angle"]) == 3600 * d + 60 * m + s


@pytest.mark.published
def test_blocking_contour_through_the_scene() -> None:
    """Sources §4: areas, volume, both ends of the line with what binds; the set's own shifts make the line."""
    found = answers("blocking_contour")["blocking_contour"]
    assert found["sun_and_planet"]["area"] == pytest.approx(2.0870, abs=1e-4)
    assert found["planet_and_ring"]["area"] == pytest.approx(10.0670, abs=1e-4)
    assert found["body"]["volume"] == pytest.approx(10.8081, abs=1e-4)
    line = found["coaxial_line"]
    low, high = line["lower_end"], line["upper_end"]
    assert [low[f"x_{k}"] for k in ("sun", "planet", "ring")] == pytest.approx(
        (-0.0961, 1.2301, 2.3641), abs=5e-5
    )
    assert [high[f"x_{k}"] for k in ("sun", "planet", "ring")] == pytest.approx(
        (1.1957, -0.0617, 1.0723), abs=5e-5
    )
    assert (low["binding"], high["binding"]) == ("ring tip in planet fillet", "planet tip in sun fillet")
    assert found["largest_contact_ratio"]["lesser_contact_ratio"] == pytest.approx(1.303, abs=5e-4)


@pytest.mark.exact
def test_boundaries_of_the_contours_are_in_the_dataset() -> None:
    """Lengths by condition are those of the polygons, whose shoelace area is the one that is answered."""
    run = Run(load(EXAMPLE, ['effects=[{type="inertia"}]', 'ask.quantities=["blocking_contour"]']))
    area = values(run.quantity("blocking_contour"))["sun_and_planet"]["area"]
    data = run.outcome.dataset
    assert data is not None
    points = data["sun_and_planet_boundary_points"].values
    which = data["sun_and_planet_boundary"].values
    total = covered = 0.0
    for k in np.unique(which):
        ring = points[which == k]
        after = np.roll(ring, -1, axis=0)
        total += float(np.hypot(*(after - ring).T).sum())
        covered += 0.5 * float((ring[:, 0] * after[:, 1] - ring[:, 1] * after[:, 0]).sum())
    lengths = data["sun_and_planet_boundary_length"]
    assert float(lengths.sum()) == pytest.approx(total, rel=1e-12)
    assert covered == pytest.approx(area, abs=1e-3)
    assert {str(x) for x in lengths["sun_and_planet_condition"].values} >= {"undercut of the sun"}


@pytest.mark.exact
def test_best_shifts_are_best_in_a_run_of_their_own() -> None:
    """Put into the scene, each choice has the value that was promised, and equal sliding is equal."""
    found = answers("blocking_contour")["blocking_contour"]

    def with_shifts(name: str) -> dict[str, Any]:
        return answers(
            "profile",
            "contact_ratio",
            overrides=tuple(f"drive.x_{k}={found[name][f'x_{k}']!r}" for k in ("sun", "planet", "ring")),
        )

    contact = with_shifts("largest_contact_ratio")["contact_ratio"]
    lesser = min(contact[mesh]["transverse"] for mesh in contact)
    assert lesser == pytest.approx(found["largest_contact_ratio"]["lesser_contact_ratio"], rel=1e-12)
    sliding = with_shifts("equal_specific_sliding")["profile"]["sun_and_planet"]
    promised = found["equal_specific_sliding"]["specific_sliding"]
    assert sliding["specific_sliding_sun"] == pytest.approx(promised, abs=1e-8)
    assert sliding["specific_sliding_planet"] == pytest.approx(promised, abs=1e-8)
    wheels = with_shifts("thickest_tips")["profile"]
    thinnest = min(wheels[wheel]["tip_thickness"] for wheel in ("sun", "planet", "ring"))
    assert thinnest == pytest.approx(found["thickest_tips"]["thinnest_tip"], rel=1e-12)


@pytest.mark.exact
def test_all_conditions_with_their_margins() -> None:
    """23 conditions; as the source's shifts are rounded up, sun and planet are 0.55 µm too tight, which is said."""
    quality = answers("geometry_quality")["geometry_quality"]
    assert len(quality) == 23
    assert quality["planet_tip_in_ring_fillet"] == pytest.approx(1.26173, abs=1e-5)
    assert quality["backlash_of_sun_and_planet"] == pytest.approx(-0.5525, abs=1e-4)
    said = Run(load(EXAMPLE, ['ask.quantities=["geometry_quality"]'])).outcome.warnings
    assert any("0.55 µm too tight" in line and "x_planet = 0.6335961" in line for line in said)
    assert any("0.55 µm of play" in line and "x_ring = 1.767596" in line for line in said)


@pytest.mark.exact
def test_shifts_left_out_mesh_without_play() -> None:
    """Default of x_planet and x_ring: what the centre distance asks for; then there is nothing to warn of."""
    text = (
        EXAMPLE.read_text(encoding="utf-8").replace("x_planet = 0.634\n", "").replace("x_ring = 1.768\n", "")
    )
    from trochoid.scene import read

    run = Run(read(text, ['ask.quantities=["profile"]']))
    found = values(run.quantity("profile"))
    assert found["planet"]["shift"] == pytest.approx(0.6335961, abs=1e-7)
    assert found["ring"]["shift"] == pytest.approx(1.7671923, abs=1e-7)
    assert abs(found["sun_and_planet"]["backlash"]) < 1e-6
    assert run.outcome.warnings == ()


@pytest.mark.property
@pytest.mark.parametrize(("fixed", "driving", "driven"), list(permutations(("sun", "ring", "carrier"))))
def test_torques_and_powers_of_any_choice(fixed: str, driving: str, driven: str) -> None:
    """T_in·i = T_out, the fixed member holds the rest, powers sum to nothing, and (1 − i) is the basic ratio −z3/z1."""
    torque = 250.0
    found = answers(
        "ratio",
        "member_speeds",
        "reactions",
        overrides=(
            f'drive.fixed="{fixed}"',
            f'drive.driving="{driving}"',
            f"operation.output_torque={torque}",
            'effects=[{type="inertia"}]',
            'ask.quantities=["reactions"]',
        ),
    )
    ratio, parts = found["ratio"], found["reactions"]
    assert parts[driving]["torque"] == pytest.approx(torque / abs(ratio), rel=1e-12)
    assert parts[driven]["torque"] == pytest.approx(-math.copysign(torque, ratio), rel=1e-12)
    members = ("sun", "ring", "carrier")
    assert sum(parts[name]["torque"] for name in members) == pytest.approx(0.0, abs=1e-9 * torque)
    assert sum(parts[name]["power"] for name in members) == pytest.approx(0.0, abs=1e-12 * torque)
    assert parts[fixed]["power"] == 0.0
    speed = found["member_speeds"]
    # Willis
    assert speed["sun"] - speed["carrier"] == pytest.approx(
        -80 / 20 * (speed["ring"] - speed["carrier"]), rel=1e-12
    )
    assert speed["planet_on_carrier"] == pytest.approx(
        -20 / 30 * (speed["sun"] - speed["carrier"]), rel=1e-12
    )


def about(arm: Array, force: Array) -> float:
    return float(arm[0] * force[1] - arm[1] * force[0])


@pytest.mark.independent
def test_every_planet_is_in_equilibrium_in_the_drawing() -> None:
    """The forces that the drawing shows: no resultant but the centrifugal one, no moment; the sun's give its torque."""
    stages = stages_of()
    frames = drawing(stages).frames
    mass = stages.masses.planet.mass
    for frame in frames[:: len(frames) // 4]:
        torque = 0.0
        for planet in range(1, 5):
            acting = [a for a in frame.arrows if a.label.endswith(f"planet {planet}")]
            (bearing,) = (a for a in acting if a.group == "carrier")
            center = bearing.origin
            centrifugal = mass * (stages.rigid.speeds["carrier"]) ** 2 * center
            assert sum(a.vector for a in acting) + centrifugal == pytest.approx(np.zeros(2), abs=1e-9)
            moment = sum(about(a.origin - center, a.vector) for a in acting)
            assert moment == pytest.approx(0.0, abs=1e-9)
            torque += sum(about(a.origin, a.vector) for a in acting if a.group == "sun")
        assert torque == pytest.approx(stages.rigid.torques["sun"], rel=1e-12)


@pytest.mark.property
def test_the_drawing_moves_as_the_members_do() -> None:
    """Same lines in every frame; ring still, sun and planets turned by their speeds; nothing leaves the ring."""
    stages = stages_of()
    frames = drawing(stages).frames
    names = [line.name for line in frames[0].lines]
    assert all([line.name for line in frame.lines] == names for frame in frames)
    turn = math.radians(360 / 20 / (1 - 1 / 5) / 8)  # an eighth of a pitch
    for name, speed in (("sun", 1.0), ("teeth of the ring", 0.0)):
        first, second = (
            complex(*next(line for line in frames[k].lines if line.name == name).xy[7]) for k in (0, 1)
        )
        assert second == pytest.approx(first * np.exp(1j * speed * turn), rel=1e-12)
    outer = max(float(np.hypot(*line.xy.T).max()) for line in frames[3].lines)
    assert outer == pytest.approx(94e-3)


@pytest.mark.independent
@pytest.mark.parametrize("forward", [True, False])
def test_mean_number_of_pairs_is_the_contact_ratio(forward: bool) -> None:
    """Counted along the paths over one pitch of the meshes, for the contact ratios of the circles."""
    stages = stages_of()
    made = stages.feasible
    angle = np.linspace(0.0, period(made.given, 0.8), 20001)[:-1]
    found = places(made.given, made.geometry, 0.2 * angle, 0.0 * angle, forward)
    tips = [float(tip) for tip in made.geometry.tips]
    wanted = (made.geometry.outer.contact_ratio(*tips[:2]), made.geometry.inner.contact_ratio(*tips[1:]))
    for place, ratio in zip(found, wanted, strict=True):
        assert place.touching.sum(axis=-1).mean(axis=0) == pytest.approx(np.full(4, ratio), abs=1e-3)


@pytest.mark.independent
def test_phase_steps_are_those_of_the_paths() -> None:
    """19/17/53 with three planets: where pairs stand on their paths in one mesh, and in the next planet's."""
    stages = small_stages(effects=(), phased=True)
    found = values(Run(stages.scene).quantity("contact_ratio"))
    made = stages.feasible
    pitch = math.pi * 2e-3 * math.cos(math.radians(20))
    angle = np.array([0.0123])
    both = places(made.given, made.geometry, 0.2 * angle, 0.0 * angle)
    for place, name in zip(both, ("sun_and_planet", "planet_and_ring"), strict=True):
        step = found[name]["phase_step"]
        assert step == pytest.approx(2.0 / 3.0)
        for planet in (1, 2):
            ahead = (place.rho[0, planet, 0] - place.rho[0, 0, 0]) / pitch - planet * step
            assert ahead == pytest.approx(round(ahead), abs=1e-9)


@pytest.mark.independent
def test_contacts_lie_on_both_flanks() -> None:
    """The contact points of the sun's mesh, as points of the sun's and of the planet's exact curve, coincide."""
    stages = stages_of("drive.x_planet=0.6335961427", "drive.x_ring=1.7671922854")
    made = stages.feasible
    from trochoid.geometry.planetary_curves import poses

    carrier = np.linspace(0.0, 0.3, 7)
    at = poses(made.given, carrier)
    (outer, _) = places(made.given, made.geometry, carrier, 0.0 * carrier)
    sun, planet = made.geometry.gears[:2]
    curve = stages.curves.planet
    t = np.linspace(0.0, 30.0, 60001)
    points, normals = (vectors @ np.array([1.0, 1j]) for vectors in (curve.point(t), curve.normal(t)))
    for k in range(7):
        angle = float(made.geometry.outer.operating_angle)
        direction = np.exp(1j * (carrier[k] + 0.5 * math.pi - angle))  # in which the sun pushes planet 1
        foot = sun.base_radius * np.exp(1j * (carrier[k] - angle))
        for rho in outer.rho[k, 0][outer.touching[k, 0]]:
            here = foot + rho * direction
            center = complex(*at.center[k, 0])
            local = (here - center) * np.exp(-1j * at.planet[k, 0])
            assert abs(local) == pytest.approx(
                math.hypot(planet.base_radius, float(made.geometry.outer.of_first(rho)))
            )
            nearest = int(np.abs(points - local).argmin())
            away = (local - points[nearest]) * normals[nearest].conjugate()
            assert abs(away.imag) < 1e-5  # along the flank, half the distance of the points
            assert abs(away.real) < 1e-8  # across it, what the chord leaves


@pytest.mark.independent
def test_masses_by_polygons() -> None:
    """Areas within fine polygons through the exact curves, times width and density."""
    stages = stages_of()
    for name, solid, bore, sign in (
        ("sun", stages.masses.sun, 10e-3, 1.0),
        ("planet", stages.masses.planet, 17e-3, 1.0),
        ("ring", stages.masses.ring, 94e-3, -1.0),
    ):
        curve = getattr(stages.curves, name)
        x, y = curve.point(np.linspace(0.0, curve.period, 400 * int(curve.period) + 1)).T
        area = 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))
        assert solid.mass == pytest.approx(7850 * 0.02 * sign * (area - math.pi * bore**2), rel=1e-5)


@pytest.mark.property
def test_dataset_is_labelled_and_its_ends_are_the_answers() -> None:
    stages = stages_of()
    found = dataset(stages, ("profiles",))
    for variable in found.variables.values():
        assert variable.attrs["long_name"]
        assert "units" in variable.attrs
    profile = answers("profile")["profile"]
    assert float(found["specific_sliding_sun"][0]) == pytest.approx(
        profile["sun_and_planet"]["specific_sliding_sun"]
    )
    assert float(found["specific_sliding_planet_on_sun"][-1]) == pytest.approx(
        profile["sun_and_planet"]["specific_sliding_planet"]
    )
    assert float(found["specific_sliding_ring"][-1]) == pytest.approx(
        profile["planet_and_ring"]["specific_sliding_ring"]
    )


@pytest.mark.property
def test_blocking_pictures_name_what_bounds() -> None:
    """Each condition that binds is a curve of its plane, each face of the body too; the line lies in all three."""
    stages = stages_of()
    planes = plots(stages, ("blocking",))
    assert [len(plot.axes) for plot in planes] == [2, 2, 3]
    for plot, contour in zip(planes, (stages.blocking.outer, stages.blocking.inner), strict=False):
        names = {curve.name for curve in plot.curves}
        assert names == set(contour.binding) | {"coaxial shifts", "this set", "best shifts"}
    assert {face.name for face in planes[2].surfaces} <= set(
        stages.blocking.outer.binding + stages.blocking.inner.binding
    )
    line = next(curve for curve in planes[2].curves if curve.name == "coaxial shifts")
    assert line.points[:, 0] + line.points[:, 1] == pytest.approx([1.134, 1.134])


@pytest.mark.property
def test_only_what_is_asked_for_runs() -> None:
    """A ratio needs no geometry; the quality of the geometry no contours and no curves."""
    for name, stages in (("ratio", {"kinematics"}), ("geometry_quality", {"kinematics", "geometry"})):
        made = Run(load(EXAMPLE, [f'ask.quantities=["{name}"]'])).outcome
        assert {stage.name for stage in made.stages} == stages
        assert made.dataset is None
        assert made.drawing is None
    code = (
        "import sys; from trochoid.run import Run; from trochoid.scene import load;"
        f"Run(load({str(EXAMPLE)!r}, ['ask.quantities=[\"geometry_quality\"]'])).outcome;"
        "heavy = {'scipy', 'xarray', 'plotly', 'gmsh', 'skfem', 'pandas'} & set(sys.modules); assert not heavy, heavy"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.property
def test_inertia_adds_what_the_orbit_throws_out() -> None:
    """m ω² a on each planet's bearing with the effect, nothing without it."""
    asked = 'ask.quantities=["bearing_loads"]'
    still = answers("bearing_loads", overrides=(asked, "effects=[]"))["bearing_loads"]
    moving = answers("bearing_loads", overrides=(asked, 'effects=[{type="inertia"}]'))["bearing_loads"]
    assert still["radial"] == pytest.approx(0.0, abs=1e-9)
    mass = answers("mass")["mass"]["planet"]["mass"]
    assert moving["radial"] == pytest.approx(mass * (300 * math.pi / 30) ** 2 * 52e-3, rel=1e-12)
    assert moving["planet_bearing"] == pytest.approx(math.hypot(moving["tangential"], moving["radial"]))

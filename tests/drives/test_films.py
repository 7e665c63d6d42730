"""Films of the drives in space: what they show is what the solvers found, in the poses of the mechanism."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import pytest

from tests.drives.indexer_cases import run_of
from tests.drives.test_precessional_contact import solved as series_of
from tests.drives.test_precessional_contact import stages
from trochoid.drives.indexer import films as indexer_films
from trochoid.drives.indexer.film_bodies import pin, planet
from trochoid.drives.indexer.film_wheel import elastic_wheel
from trochoid.drives.indexer.wall import slotted
from trochoid.drives.precessional.contact_stages import Solved
from trochoid.drives.precessional.design import Design
from trochoid.drives.precessional.film_bodies import rolled
from trochoid.drives.precessional.films import contact_film
from trochoid.drives.precessional.teeth import build_level
from trochoid.drives.solids import Solid, frustum, joined, revolved, rod, tube
from trochoid.fem.slot_field import wall_loads
from trochoid.fem.slot_wall import WallMesh, wall_body
from trochoid.kinematics.curve import ArcLength
from trochoid.kinematics.indexer import motion
from trochoid.kinematics.indexer_slot import slot_normal
from trochoid.kinematics.nutation import satellite_motion
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.types import Array
from trochoid.results.film import Field, Film
from trochoid.run import Run

INDEXER = (
    "relative_turning_time = 0.2902",
    'effects=[{type="elastic_contact"},{type="inertia"}]',
    "drive.wheel.thickness=12",
    'accuracy.model="rigid_wheel"',
)


@lru_cache(maxsize=3)
def precessional(pins_on: str = "ring", torque: float = 100.0) -> tuple[Design, Solved, Film]:
    """A coarse rim, a few positions."""
    made = stages(drive__teeth__pins_on=pins_on, accuracy__facets_per_lobe=12)
    level = build_level(made.feasible, 12)
    found = Solved(series_of(made, level, torque, tilt=4e4), None, level, None)
    return made.feasible, found, contact_film(made.feasible, found)


def body(film: Film, frame: int, name: str) -> Field:
    return next(each for each in film.frames[frame][1] if each.name == name)


def load(field: Field) -> tuple[Array, Array]:
    """Areas times pressure (m,), N, and places (m, 3) of the triangles."""
    corner = np.asarray(field.points, dtype=np.float64)[field.cells]
    area = 0.5 * np.linalg.norm(np.cross(corner[1] - corner[0], corner[2] - corner[0]), axis=-1)
    return area * np.asarray(field.point_data["contact_pressure"])[field.cells].mean(axis=0), corner.mean(
        axis=0
    )


def volume(solid: Solid) -> float:
    a, b, c = solid.points[solid.cells]
    return float(np.einsum("mi,mi->m", a, np.cross(b, c)).sum() / 6.0)


def row_of(design: Design, solved: Solved, frame: int, frames: int) -> tuple[int, int]:
    steps = design.nutation.fixed_teeth * len(solved.fine.crank)
    return divmod(round(steps * frame / frames), len(solved.fine.crank))


@pytest.mark.exact
@pytest.mark.parametrize("pins_on", ["ring", "satellite"])
def test_pressure_adds_up_to_the_forces(pins_on: str) -> None:
    """In each frame the pressure over all contacts is the sum of forces; rollers carry theirs, by number."""
    design, solved, film = precessional(pins_on)
    series = solved.fine
    for frame in range(len(film.frames)):
        shift, row = row_of(design, solved, frame, len(film.frames))
        force, _ = load(body(film, frame, "contacts"))
        assert force.sum() == pytest.approx(series.total[row].sum(), rel=0.012)
        rollers = np.asarray(body(film, frame, "rollers").point_data["roller_force"]).reshape(
            series.total.shape[1], -1
        )
        assert (np.ptp(rollers, axis=1) == 0.0).all()
        np.testing.assert_allclose(rollers[:, 0], np.roll(series.total[row], shift), rtol=1e-6)


@pytest.mark.exact
@pytest.mark.parametrize("pins_on", ["ring", "satellite"])
def test_members_move_as_the_mechanism_does(pins_on: str) -> None:
    """Nodes of the toothed body and rollers' axes follow rotation matrices; contacts lie on both."""
    design, solved, film = precessional(pins_on)
    pins = design.tooth.pin_angle if design.tooth else 0.0
    lobed = "satellite" if pins_on == "ring" else "wheel"
    first = np.asarray(body(film, 0, lobed).points, dtype=np.float64)
    held = np.asarray(body(film, 0, "rollers").points, dtype=np.float64)
    pose = satellite_motion(design.nutation, [angle for angle, _ in film.frames]).rotation
    for frame in (1, 7):
        turned = pose[frame] @ pose[0].T
        still = np.eye(3)
        moved, pinned = (turned, still) if pins_on == "ring" else (still, turned)
        found = np.asarray(body(film, frame, lobed).points, dtype=np.float64)
        np.testing.assert_allclose(found, first @ moved.T, atol=1e-7)
        rollers = np.asarray(body(film, frame, "rollers").points, dtype=np.float64)
        middles = rollers.reshape(len(held) // 66, 66, 3).mean(axis=1)
        np.testing.assert_allclose(
            middles, held.reshape(middles.shape[0], 66, 3).mean(axis=1) @ pinned.T, atol=1e-7
        )
        contacts = body(film, frame, "contacts")
        middle = np.abs(np.asarray(contacts.point_data["from_middle"])).max(axis=1) == 0.0
        axes = middles / np.linalg.norm(middles, axis=1)[:, None]
        points = np.asarray(contacts.points, dtype=np.float64)[middle]
        points /= np.linalg.norm(points, axis=1)[:, None]
        off = np.arccos(points @ axes.T).min(axis=1) - pins
        # the satellite is drawn where it ideally is, contacts where they are once it has rolled under load
        tilt = float(np.linalg.norm(solved.fine.motion, axis=1).max())
        assert np.abs(off).max() < 1.5 * tilt


@pytest.mark.exact
def test_a_pitch_later_all_has_moved_by_one_tooth() -> None:
    """Five pitches of 15 are a third of a turn: the same fields there, on the fifth tooth and roller on."""
    design, _, film = precessional()
    assert len(film.frames) == 18
    third = rotation(2, 2.0 * math.pi / 3.0)
    one, other = (body(film, frame, "satellite") for frame in (0, 6))
    teeth = design.nutation.satellite_teeth

    def by_tooth(field: Field, name: str) -> Array:
        values = np.asarray(field.point_data[name] if name else field.points, dtype=np.float64)
        return values.reshape(teeth, -1, *values.shape[1:])

    for name in ("", "displacement", "deformation"):
        before, after = by_tooth(one, name), by_tooth(other, name)
        np.testing.assert_allclose(
            after, np.roll(before, 5, axis=0) @ third.T, atol=3e-7 * np.abs(before).max()
        )
    np.testing.assert_array_equal(
        by_tooth(other, "von_mises"), np.roll(by_tooth(one, "von_mises"), 5, axis=0)
    )


@pytest.mark.exact
def test_displacement_is_rotation_and_deformation() -> None:
    """What is left of the displacement without deformation is one rotation about O, the solver's."""
    _, solved, film = precessional()
    field = body(film, 0, "satellite")
    points = np.asarray(field.points, dtype=np.float64)
    rigid = np.asarray(field.point_data["displacement"], dtype=np.float64) - field.point_data["deformation"]
    np.testing.assert_allclose(
        np.linalg.norm(points + rigid, axis=1), np.linalg.norm(points, axis=1), atol=1e-8
    )
    first_order = np.cross(solved.fine.motion[0], points)
    angle = float(np.linalg.norm(solved.fine.motion[0]))
    assert np.abs(rigid - first_order).max() < angle**2 * 0.08
    assert np.abs(np.asarray(field.point_data["deformation"])).max() > 1e-8


@pytest.mark.property
def test_torque_the_other_way_is_the_mirror_image() -> None:
    """At input angle 0 the drive is symmetric about the plane of the crank: pressures, stress and contacts mirrored."""
    _, solved, film = precessional()
    _, reverse, other = precessional(torque=-100.0)
    force, place = load(body(film, 0, "contacts"))
    turned, there = load(body(other, 0, "contacts"))
    mirrored = (turned @ there) * [1.0, -1.0, 1.0]
    np.testing.assert_allclose(force @ place, mirrored, atol=1e-3 * np.abs(mirrored).max())
    np.testing.assert_allclose(
        solved.fine.total[0], np.roll(reverse.fine.total[0][::-1], 1), rtol=1e-3, atol=0.1
    )
    stress = [np.asarray(body(each, 0, "satellite").point_data["von_mises"]) for each in (film, other)]
    assert stress[0].max() == pytest.approx(stress[1].max(), rel=0.05)


@pytest.mark.exact
def test_rollers_roll() -> None:
    """In a turn of the crank a roller rolls along one tooth, but for whole turns of the contact about it."""
    design, solved, _ = precessional()
    tooth = design.tooth
    assert tooth is not None
    ends = np.array([0.0, 2.0 * math.pi])
    spun = rolled(design, solved.fine, ends)
    assert np.abs(spun[0]).max() == 0.0
    flank = float(np.diff(ArcLength(tooth).length(np.array([0.0, 2.0 * math.pi / tooth.lobes])))[0])
    turns = (np.abs(spun[1]) - flank / math.sin(tooth.pin_angle)) / (2.0 * math.pi)
    np.testing.assert_allclose(turns, np.round(turns.mean()), atol=0.02)


@pytest.mark.exact
def test_no_torque_no_contacts() -> None:
    """The film still shows the drive; nothing is pressed, nothing moves."""
    _, _, film = precessional(torque=0.0)
    names = {each.name for _, bodies in film.frames for each in bodies}
    assert "contacts" not in names
    assert np.abs(np.asarray(body(film, 3, "satellite").point_data["von_mises"])).max() == 0.0


@lru_cache(maxsize=4)
def indexer(*overrides: str) -> tuple[Run, Film]:
    run = run_of(*INDEXER, *overrides)
    made = run.stages
    return run, indexer_films.contact_film(made.feasible, made.slots["indexer"], made.pairs["indexer"])


SHAPES = [
    (),
    ('drive.pin.shape="cone"',),
    ('drive.pin.shape="barrel"', "drive.pin.crown_radius=300"),
]


@pytest.mark.exact
@pytest.mark.parametrize("shape", SHAPES)
def test_pressure_of_the_pin_adds_up_to_its_force(shape: tuple[str, ...]) -> None:
    """Over the index, in every frame; none in the dwell."""
    run, film = indexer(*shape)
    pair = run.stages.pairs["indexer"]
    half = run.stages.design.indexer.half_turn
    for frame in (0, 3, 12, 27):
        angle = film.frames[frame][0]
        wanted = abs(float(pair.forces.state(np.array([angle])).pin[0]))
        if wanted > 1e-3 * pair.largest[0]:
            force, _ = load(body(film, frame, "contacts"))
            # slices along the pin end between nodes: half a slice's change of load at both ends
            assert force.sum() == pytest.approx(wanted, rel=0.02)
    assert film.frames[-1][0] > half
    assert all(each.name != "contacts" for each in film.frames[-1][1])


@pytest.mark.property
@pytest.mark.parametrize("shape", SHAPES[:2])
def test_pin_has_room_in_its_slot(shape: tuple[str, ...]) -> None:
    """In all frames the wheel's nodes are outside the pin, and some are on it: the slot is as wide as the pin."""
    run, film = indexer(*shape)
    design = run.stages.design
    radius, sphere = design.drive.pin_radius, design.drive.sphere_radius
    for angle, _ in film.frames[:28:3]:
        frame = [a for a, _ in film.frames].index(angle)
        points = np.asarray(body(film, frame, "wheel").points, dtype=np.float64)
        axis = design.indexer.path.point(np.asarray(angle))
        along = points @ axis
        distance = np.linalg.norm(points - along[:, None] * axis, axis=1)
        free = distance / (radius * along / sphere if shape else radius)
        assert free[along > 0.0].min() > 1.0 - 2e-3


@pytest.mark.exact
def test_wheel_lags_as_the_pair_says() -> None:
    """Displacement of the wheel: its lag times the distance from its axis, against the motion while it is driven."""
    run, film = indexer()
    made = run.stages.design.indexer
    frame = 3
    angle = film.frames[frame][0]
    field = body(film, frame, "wheel")
    lag = float(run.stages.pairs["indexer"].state(np.array([angle])).lag[0])
    points = np.asarray(field.points, dtype=np.float64)
    moved = np.asarray(field.point_data["displacement"], dtype=np.float64)
    arm = points - (points @ made.axis)[:, None] * made.axis
    np.testing.assert_allclose(
        np.linalg.norm(moved, axis=1), lag * np.linalg.norm(arm, axis=1), rtol=1e-4, atol=1e-12
    )
    later = motion(made, np.array([angle, angle + 1e-3])).angle
    velocity = -np.cross(made.axis, points) * float(later[1] - later[0])  # ψ grows about −o
    force = float(run.stages.pairs["indexer"].forces.state(np.array([angle])).pin[0])
    assert np.sign(np.sum(moved * velocity)) == -np.sign(force)


@pytest.mark.exact
def test_wheel_weighs_as_its_zone_without_slots() -> None:
    """Volume of the drawn wheel: the zone of the shell less four slots, which it is less by 1 to 5 %."""
    run, film = indexer()
    field = body(film, 0, "wheel")
    found = volume(Solid(np.asarray(field.points, dtype=np.float64), field.cells))
    density = next(iter(run.stages.scene.materials.values())).density
    zone = run.stages.wheel.mass / density
    assert 0.93 * zone < found < 0.995 * zone


@pytest.mark.exact
def test_solids_are_closed_and_outside_out() -> None:
    """Volumes of rod, cone, ring and bar; bodies of the indexer are not inside out."""
    x, z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    turn = math.sin(2.0 * math.pi / 48) * 48 / (2.0 * math.pi)  # of a polygon of 48 corners
    assert volume(rod(x, x + 2.0 * z, 0.5)) == pytest.approx(turn * math.pi * 0.25 * 2.0)
    assert volume(joined([rod(x, 3.0 * x, 0.1)] * 2)) == pytest.approx(2.0 * turn * math.pi * 0.01 * 2.0)
    ring = revolved(((1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0)), z)
    assert volume(ring) == pytest.approx(turn * math.pi * 3.0)
    cone = frustum(x, 0.3, 1.0, 2.0, 48)
    base = math.cos(0.3) * math.sin(0.3) ** 2
    assert volume(cone) == pytest.approx(turn * math.pi / 3.0 * base * (8.0 - 1.0))
    t = np.linspace(0.0, 1.0, 60)
    arc = np.stack([np.sin(t), 0.0 * t, np.cos(t)], axis=-1)
    assert volume(tube(arc, 0.05)) == pytest.approx(math.pi * 0.0025, rel=0.02)
    run, _ = indexer()
    design = run.stages.design
    disc = planet(design, z)
    assert disc is not None
    assert volume(disc) > 0.0
    assert volume(pin(design, x)) > 0.0


@pytest.mark.exact
def test_elastic_wheel_carries_the_pin() -> None:
    """Torque of the nodal forces: sin α times the pin's moment; under the pin the wall gives way, hub and frame stay.

    In the other half of the index the pin presses the other wall: the mirror image.
    """
    run = run_of(*INDEXER[:3], 'accuracy.model="elastic_wheel"', "accuracy.facets_per_lobe=4")
    made = run.stages
    design, pair = made.feasible, made.pairs["indexer"]
    assert pair.elastic is not None
    t = np.array([-0.6, 0.6]) * design.indexer.half_turn
    reach, force = design.indexer.reach(t), pair.state(t).pressed.force
    assert np.prod(pair.forces.state(t).pin) < 0.0
    half = 0.5 * pair.pin.thickness
    ends = pair.pin.distance - half, pair.pin.distance + half
    slot = made.slots["indexer"]
    body = wall_body(slotted(design, slot, "indexer"), ends, slot.nearest, pair.pin.material, WallMesh(4))
    loads = wall_loads(body, pair.elastic.wall.slices, reach.tolist(), force)
    nodes = loads.reshape(len(body.body.mesh.points), 3, -1, 2)
    points = body.body.mesh.points[:, :, None] * body.body.radial.nodes
    torque = np.einsum("nr,nrp->p", points[:, 0], nodes[:, 1]) - np.einsum(
        "nr,nrp->p", points[:, 1], nodes[:, 0]
    )
    wanted = np.sin(reach) * (force @ pair.elastic.wall.slices.middle)
    np.testing.assert_allclose(torque, wanted, rtol=2e-3)
    shape = elastic_wheel(design, slot, pair.pin, pair.elastic, 4, reach, force)
    assert shape.deformation is not None
    assert shape.stress is not None
    distance = np.array([pair.pin.distance])
    for frame, way in ((0, 1.0), (1, -1.0)):
        psi = float(motion(design.indexer, t[frame]).angle)
        under = shape.under_pin(design, psi, frame, way, distance)[0]
        push = way * slot_normal(design.indexer, t[frame])
        assert under @ push > 0.9 * np.linalg.norm(under)
        field = shape.field(design, psi, np.zeros(3), frame, way)
        points = np.asarray(field.points, dtype=np.float64)
        pressed = points[np.asarray(field.point_data["von_mises"]).argmax()]
        pin_axis = design.indexer.path.point(t[frame])
        assert np.linalg.norm(pressed - (pressed @ pin_axis) * pin_axis) < 2.0 * design.drive.pin_radius
        hub = np.linalg.norm(np.cross(points, design.indexer.axis), axis=1) / np.linalg.norm(points, axis=1)
        held = hub < 1.001 * math.sin(slotted(design, slot, "indexer").hub)
        assert held.any()
        assert np.abs(np.asarray(field.point_data["deformation"])[held]).max() == 0.0

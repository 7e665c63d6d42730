"""Planetary sets that move: modes, reactions with inertia, the casing's vibration, load over the face width."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

from tests.drives.planetary_cases import (
    ELASTIC,
    ERRORS,
    FLOATING,
    INERTIA,
    SMALL,
    level_of,
    series_of,
    stages_of,
    text,
)
from trochoid.drives.casing import rigid_shaken
from trochoid.drives.planetary import answers_dynamics, answers_forces
from trochoid.drives.planetary.answers_contact import load_sharing
from trochoid.drives.planetary.contact import Layout, centers
from trochoid.drives.planetary.face import faces
from trochoid.drives.planetary.headline import not_simulated
from trochoid.drives.planetary.meshes import matings, meshes
from trochoid.drives.planetary.mode_shapes import films
from trochoid.drives.planetary.modes import SetModes, assembled, campbell, natural_modes
from trochoid.drives.planetary.moving import MAIN, Moving, moving
from trochoid.drives.planetary.moving_entries import moving_entries
from trochoid.drives.planetary.reactions import Reactions, reactions
from trochoid.drives.planetary.stages import Solved, Stages
from trochoid.drives.planetary.vibration import by_place, casing_vibration, on_casing, whole_pitches
from trochoid.drives.seats import seats_residual
from trochoid.dynamics.members import disc_member
from trochoid.dynamics.spectrum import harmonics
from trochoid.dynamics.supports import Support
from trochoid.dynamics.turning import turning
from trochoid.dynamics.whirl import whirl
from trochoid.faults import SceneFaults
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array
from trochoid.run import plan
from trochoid.scene import Override, read
from trochoid.scene.needs import SEATS_OF

SHAFTS = ("drive.sun.torsional_stiffness=20000", "drive.ring.torsional_stiffness=500000")


def lumped(planets: int) -> Moving:
    """Lin and Parker's set: rigid wheels on springs, rotations as lengths on base circles."""
    members = (*MAIN, *(f"planet{i}" for i in range(planets)))
    layout = Layout(tuple(f"{m}.{a}" for m in members for a in ("x", "y", "rotation")), "carrier", True)
    count = len(layout.names)
    masses = {"sun": (0.4, 0.39), "ring": (2.35, 3.0), "carrier": (5.43, 6.29)}
    pairs = [masses.get(m, (0.66, 0.61)) for m in members]
    supports = [Support(m, layout.rows(m)[:2], 1e8 * np.eye(2)) for m in MAIN]
    supports.append(Support("ring shaft", layout.rows("ring")[2:], np.array([[1e9]])))
    teeth, alpha = np.zeros((count, count)), np.radians(24.6)
    for i in range(planets):
        psi = 2.0 * np.pi * i / planets
        planet = layout.rows(f"planet{i}")
        radial = np.cos(psi) * planet[0] + np.sin(psi) * planet[1]
        orbit = np.cos(psi) * planet[1] - np.sin(psi) * planet[0]
        seat = layout.seat(np.array([np.cos(psi), np.sin(psi)]))
        supports.append(Support(f"planet{i}", planet[:2] - seat, 1e8 * np.eye(2)))
        for wheel, turn, sense in (("sun", psi - alpha, 1.0), ("ring", psi + alpha, -1.0)):
            x, y, u = layout.rows(wheel)
            deflection = np.cos(turn) * y - np.sin(turn) * x + u + sense * planet[2]
            deflection = deflection - sense * np.sin(alpha) * radial - np.cos(alpha) * orbit
            teeth += 5e8 * np.outer(deflection, deflection)
    still = np.zeros((1, count))
    return Moving(
        layout,
        layout.names,
        np.eye(count),
        np.array([x for m, j in pairs for x in (m, m, j)]),
        np.zeros((count, count)),
        tuple(supports),
        teeth[None],
        still,
        still,
        1.0,
    )


def of_kind(found: SetModes, kind: str) -> Array:
    return np.array([mode.frequency for mode in found.modes if mode.turns == kind])


@pytest.mark.independent
@pytest.mark.parametrize("planets", [3, 4, 5, 6])
def test_modes_have_the_structure_of_lin_and_parker(planets: int) -> None:
    """J. Vib. Acoust. 121 (1999) 316: six rotational modes, one of them free, six translational pairs, and N − 3 times
    the three planet modes, those of one planet between sun, ring and carrier that stand still.
    """
    found = natural_modes(lumped(planets))
    assert found.free == 1
    assert len(of_kind(found, "rotational")) == 5
    pairs = of_kind(found, "translational")
    assert len(pairs) == 12
    assert pairs[::2] == pytest.approx(pairs[1::2], rel=1e-9)
    alpha = np.radians(24.6)
    sun = np.array([-np.sin(alpha), -np.cos(alpha), 1.0])  # radial, along the orbit, rotation
    ring = np.array([np.sin(alpha), -np.cos(alpha), -1.0])
    alone = 5e8 * (np.outer(sun, sun) + np.outer(ring, ring)) + np.diag([1e8, 1e8, 0.0])
    mass = np.diag([0.66, 0.66, 0.61])
    single = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(mass, alone)).real)) / (2.0 * np.pi)
    assert of_kind(found, "planet mode") == pytest.approx(np.repeat(single, planets - 3), rel=1e-9)


@pytest.mark.independent
def test_rotational_modes_are_those_of_one_planet_and_its_share_of_the_rest() -> None:
    """A reduced problem of six: all planets alike, main members only turn."""
    planets, alpha = 4, np.radians(24.6)
    found = of_kind(natural_modes(lumped(planets)), "rotational")
    # sun, ring, carrier turning; radial, along the orbit, rotation of a planet
    sun = np.array([1.0, 0.0, 0.0, -np.sin(alpha), -np.cos(alpha), 1.0])
    ring = np.array([0.0, 1.0, 0.0, np.sin(alpha), -np.cos(alpha), -1.0])
    radial, orbit = np.eye(6)[3], np.eye(6)[4] - np.eye(6)[2]
    stiffness = planets * 5e8 * (np.outer(sun, sun) + np.outer(ring, ring))
    stiffness += planets * 1e8 * (np.outer(radial, radial) + np.outer(orbit, orbit))
    stiffness[1, 1] += 1e9
    mass = np.array([0.39, 3.0, 6.29, planets * 0.66, planets * 0.66, planets * 0.61])
    squares = np.sort(np.linalg.eigvals(stiffness / mass[:, None]).real)
    assert found == pytest.approx(np.sqrt(squares[1:]) / (2.0 * np.pi), rel=1e-9)


@lru_cache(maxsize=16)
def moved(
    *overrides: str,
    effects: tuple[str, ...] = (ELASTIC, FLOATING, INERTIA),
    positions: int = 12,
    phased: bool = False,
    relief: float = 0.0,
) -> tuple[Stages, Moving, Reactions]:
    """The small set on one mesh level."""
    stages, series = series_of(*overrides, effects=effects, positions=positions, phased=phased, relief=relief)
    level = level_of(relief=relief, phased=phased)
    made = moving(stages.feasible, stages.speeds, stages.masses, series, level)
    return stages, made, reactions(made, series, stages.scene.operation.damping_ratio)


@pytest.mark.exact
@pytest.mark.parametrize("phased", [False, True])
def test_modes_of_solved_contacts_have_their_symmetry(phased: bool) -> None:
    """Planets alike, in phase or not: with the carrier at rest pairs of one frequency, each mode of one kind."""
    _, set_, _ = moved(phased=phased)
    found = whirl(assembled(set_, 0.0)).frequency
    modes = natural_modes(set_)
    kinds = [mode.turns for mode in modes.modes]
    # carrier turning and three motions of a planet; shifts of sun and carrier and three of a planet
    assert (kinds.count("rotational"), kinds.count("translational")) == (4, 2 * 5)
    assert np.abs(modes.kinds.max(axis=1) - 1.0).max() < 1e-6
    pairs = np.flatnonzero(np.diff(found) < 1e-6 * found[1:])
    assert len(pairs) == 5


@pytest.mark.property
@pytest.mark.parametrize(
    ("effects", "overrides"),
    [
        ((ELASTIC, INERTIA), ()),
        ((ELASTIC, FLOATING, INERTIA), SHAFTS),
        ((ELASTIC, FLOATING, INERTIA, ERRORS), ("drive.planet.position_errors=[0.02]", *SHAFTS)),
        ((ELASTIC, INERTIA), ('drive.fixed="carrier"',)),
        ((ELASTIC, FLOATING, INERTIA), ('drive.fixed="sun"', 'drive.driving="ring"', *SHAFTS)),
        ((ELASTIC, FLOATING, INERTIA), ('drive.driving="carrier"',)),
    ],
)
def test_forces_and_work_of_the_moving_set_balance(
    effects: tuple[str, ...], overrides: tuple[str, ...]
) -> None:
    """Newton's second and third law and the work over a period, ≤ 1e-9; mean torques are those of equilibrium."""
    stages, set_, found = moved(*overrides, effects=effects)
    assert max(found.balance, found.seats, found.work) < 1e-9
    assert found.loss > 0.0
    assert found.growth < 1.0
    driven = stages.scene.drive.driven
    assert found.torque[driven] == pytest.approx(np.full(12, stages.rigid.torques[driven]), rel=1e-9)
    for name in MAIN:
        assert found.torque[name].mean() == pytest.approx(stages.rigid.torques[name], rel=5e-3)
    # all forces on the casing together are the inertia of all members, with that of planets in their places
    whole = sum(found.force.values())
    loads = np.stack([found.inertia[:, axis::3].sum(axis=1) for axis in (0, 1)], axis=1)
    places = centers(stages.feasible)
    loads = loads + stages.load.centrifugal * (places / np.linalg.norm(places, axis=1)[:, None]).sum(axis=0)
    assert whole == pytest.approx(loads, abs=1e-9 * np.abs(found.bearing).max())
    assert set_.motion.shape == found.motion.shape


@pytest.mark.independent
def test_the_carriers_frame_has_the_inertia_of_turning_members() -> None:
    """Matrices of members in space in a frame that turns (dynamics.turning): their parts in the plane."""
    stages, set_, _ = moved()
    omega = 0.25 * stages.scene.operation.input_speed
    bodies = tuple(disc_member("", m, j, 0.5 * j, 0.0, omega) for m, j in set_.mass.reshape(-1, 3)[:, 1:])
    whole = turning(bodies, np.array([0.0, 0.0, omega]))
    plane = np.array([6 * i + axis for i in range(len(bodies)) for axis in (0, 1, 5)])
    pick = np.ix_(plane, plane)
    free = set_.free
    for found, matrix in zip(set_.inertia(), (whole.mass, whole.gyroscopic, whole.centrifugal), strict=True):
        wanted = free.T @ matrix[pick] @ free
        assert found == pytest.approx(wanted, abs=1e-12 * np.abs(wanted).max())


@pytest.mark.property
def test_elastic_reactions_become_rigid() -> None:
    """All stiffnesses × 1e4: torques, meshes and bearings of the rigid set within 1e-6, and the rest falls as 1/k."""

    def apart(factor: float) -> float:
        words = (
            f"materials.steel.youngs_modulus={210000.0 * factor!r}",
            *(
                f"drive.{name}.bearing_stiffness={200000.0 * factor!r}"
                for name in ("sun", "planet", "carrier")
            ),
            f"drive.sun.torsional_stiffness={20000.0 * factor!r}",
        )
        stages = stages_of(*words, effects=(ELASTIC, FLOATING, INERTIA))
        level = stages.level(6)
        series = stages.series(level, "level0", 8)
        made = moving(stages.feasible, stages.speeds, stages.masses, series, level)
        found, rigid = reactions(made, series, 0.02), stages.rigid
        bearing = np.linalg.norm(found.bearing, axis=-1) / rigid.bearing - 1.0
        mesh = found.mesh / rigid.outer.normal - 1.0
        torque = [found.torque[name] / rigid.torques[name] - 1.0 for name in MAIN]
        left = [np.abs(force).max() / rigid.bearing for force in found.force.values()]
        return float(max(np.abs(bearing).max(), np.abs(mesh).max(), np.abs(torque).max(), *left))

    soft, stiff = apart(1e2), apart(1e4)
    assert stiff < 1e-6
    assert stiff == pytest.approx(1e-2 * soft, rel=0.3)  # Hertz is not linear


@pytest.mark.independent
def test_a_set_that_creeps_has_no_inertia() -> None:
    """At a thousandth of the speed the forces are those without inertia, and what is left falls with its square."""

    def added(speed: float) -> float:
        _, _, found = moved(f"operation.input_speed={speed}", *SHAFTS, effects=(ELASTIC, FLOATING, INERTIA))
        return float(np.abs(found.mesh - found.static_mesh).max())

    assert added(1.5) == pytest.approx(1e-2 * added(15.0), rel=1e-2)
    assert added(1.5) < 1e-4 * added(1500.0)


CASING = (
    "casing={mass=10, inertia=[0.1,0.1,0.2], mounts=[{position=[100,0,0], stiffness=[3000,4000,5000]},"
    "{position=[-100,0,0], stiffness=[3000,4000,5000]}], points=[{name='side', position=[50,0,0]}]}"
)


@pytest.mark.independent
def test_equal_planets_shake_the_casing_by_torque_alone() -> None:
    """v = ω T/(k − J ω²) · arm at each harmonic of the torque that the ring hands on; bearings feel nothing."""
    stages, _, found = moved(CASING, effects=(ELASTIC, FLOATING, INERTIA))
    shaken = casing_vibration(stages.feasible, stages.speeds, found, rigid_shaken(stages.scene)).elastic
    assert whole_pitches(stages.feasible) == 54
    stiffness = 2.0 * 4e6 * 0.1**2
    for h in (1, 2, 3):
        omega = h * found.speed
        torque = np.abs(harmonics(found.torque["ring"]))[h]
        at = int(np.argmin(np.abs(shaken.frequencies - omega / (2.0 * np.pi))))
        assert np.abs(shaken.velocity[0, 1, at]) == pytest.approx(
            abs(omega * torque / (stiffness - 0.2 * omega**2) * 0.05), rel=1e-6
        )
    assert np.abs(shaken.velocity[0, 0]).max() < 1e-6 * np.abs(shaken.velocity[0, 1]).max()


@pytest.mark.exact
@pytest.mark.parametrize("fixed", ["ring", "carrier"])
def test_what_members_put_on_the_casing_is_its_load(fixed: str) -> None:
    """Sun, ring and carrier at their places sum to the resultant, the fixed one's torque among them."""
    stages, _, found = moved(f"drive.fixed={fixed}", CASING, effects=(ELASTIC, FLOATING, INERTIA))
    torque, pitches = found.torque[fixed], whole_pitches(stages.feasible)
    whole = on_casing(found.force, torque, pitches, 1.0)
    places = by_place(found.force, (fixed, torque), pitches, 1.0)
    assert tuple(places) == SEATS_OF["planetary"]
    assert seats_residual(places, whole) < 1e-12
    assert np.abs(places[fixed].moment).max() == pytest.approx(np.abs(torque).max(), rel=1e-12)


@pytest.mark.exact
def test_flanks_without_lead_carry_evenly() -> None:
    stages = stages_of("drive.lead.slices=5")
    found = faces(stages.feasible, level_of(), stages.load, 3)
    assert found.outer.factor == pytest.approx(np.ones(3), rel=1e-9)
    assert found.inner.factor == pytest.approx(np.ones(3), rel=1e-9)


@pytest.mark.independent
def test_misaligned_flanks_carry_as_springs_beside_each_other() -> None:
    """K = 1 + F_β c b/(2 F) while all of the width carries, with the mesh's own stiffness per width c."""
    stages = stages_of("drive.lead.slices=15", "drive.lead.sun_and_planet.misalignment=0.002")
    found = faces(stages.feasible, level_of(), stages.load, 4)
    path = meshes(stages.feasible, level_of(), stages.load, 4).outer
    force = matings(stages.feasible, level_of(), stages.load)[0].normal_force
    ends = 14.0 / 15.0  # of the outermost slices' middles
    wanted = 1.0 + 0.5 * ends * 2e-6 * path.stiffness / force
    assert wanted.max() < 2.0
    assert found.outer.factor == pytest.approx(wanted, rel=0.03)
    assert found.inner.factor == pytest.approx(np.ones(4), rel=1e-9)


@pytest.mark.property
def test_what_is_not_listed_is_not_there() -> None:
    """Without inertia, and without a lead: the parts of before, and no stage of the moving set would run."""
    stages = stages_of(effects=(ELASTIC,))
    assert set(answers_forces.reactions(stages).parts or {}) == {*MAIN, "sun_and_planet", "planet_and_ring"}
    assert "bodies" not in stages.clock.seconds
    asked = Override(("ask", "quantities"), ["reactions", "load_sharing", "torsional_stiffness"], "test")

    def needed(*overrides: str) -> set[str]:
        made = plan(read(text(SMALL), [asked, *overrides]))
        return {stage.name for stage in made.stages if stage.needed}

    new = {"face", "dynamics", "reactions"}
    assert not needed(f"effects=[{ELASTIC}]") & new
    assert needed("drive.lead.slices=9") >= new


@pytest.mark.property
def test_answers_of_the_moving_set() -> None:
    """Both models, harmonics, kinds of modes, velocities with a zone, the load over the width; each has its picture."""
    effects = (ELASTIC, FLOATING, INERTIA, '{type="casing_on_mounts"}')
    stages, series = series_of("drive.lead.planet_and_ring.crown=0.004", effects=effects, positions=8)
    stages.__dict__["contact"] = Solved(series, None, level_of(), None)
    made = answers_forces.reactions(stages).parts or {}
    assert set(made) == {"rigid", "elastic"}
    modes = answers_dynamics.natural_frequencies(stages)
    assert len(modes.parts or {}) == 14
    velocity = answers_dynamics.vibration_velocity(stages).parts or {}
    assert set(velocity) == {"output bearing", "foot"}
    assert answers_dynamics.vibration_zone(stages).note
    factor = load_sharing(stages).parts or {}
    assert {"sun_and_planet", "planet_and_ring"} == set(factor["face_load_factor"])  # type: ignore[arg-type]
    entries, coordinates = moving_entries(stages, ("reactions", "vibration", "face"))
    assert {dim for dims, *_ in entries.values() for dim in dims} >= set(coordinates)
    assert "Only the face load factor" in not_simulated(stages.scene)["load over the face width"]
    assert campbell(stages.moving.fine, stages.scene.operation.input_speed).curves


@pytest.mark.property
def test_a_varying_stiffness_that_excites_itself_is_refused() -> None:
    """Weak damping at twice a natural frequency: there is no steady motion to report."""
    _, set_, _ = moved()
    swing = set_.teeth * (1.0 + 0.5 * np.cos(2.0 * np.pi * np.arange(12) / 12))[:, None, None]
    first = natural_modes(set_).modes[0].frequency
    _, series = series_of(effects=(ELASTIC, FLOATING, INERTIA), positions=12)
    wild = replace(set_, teeth=swing, speed=2.0 * 2.0 * np.pi * first)
    with pytest.raises(
        NotConverged, match=r"excites itself: free motions grow .* change operation.input_speed"
    ):
        reactions(wild, series, 1e-4)


@pytest.mark.property
@pytest.mark.parametrize(
    ("word", "said"),
    [
        ("drive.lead.slices=2", "given 2; need a whole number from 3 to 101"),
        (
            "drive.lead.sun_and_planet.misalignment=11",
            "given 11 mm; need a length of -10 or more and of at most 10",
        ),
        ("drive.lead.planet_and_ring.crown=-0.1", "given -0.1 mm; need a length of 0 or more"),
        ("drive.lead.sun.crown=0.1", "unknown key"),
        ("drive.carrier.mass=0", "given 0 kg; need a mass greater than 0"),
    ],
)
def test_what_cannot_be_written(word: str, said: str) -> None:
    with pytest.raises(SceneFaults, match=said):
        stages_of(word)


@pytest.mark.property
def test_modes_as_films() -> None:
    """Sun, ring, carrier and planets on their circle; each wheel's middle moves as in the mode, all in one scale."""
    stages, set_ = stages_of(), lumped(3)
    modes = natural_modes(set_)
    film = films(stages.feasible, stages.curves, set_, modes)[1]
    bodies = [frame[1] for frame in film.frames]
    assert [body.name for body in bodies[0]] == ["sun", "ring", "carrier", "planet 1", "planet 2", "planet 3"]
    for body in bodies[0][3:]:
        reach = np.hypot(*body.points[:, :2].mean(axis=0))
        assert reach == pytest.approx(stages.feasible.drive.center_distance, rel=1e-3)
    wheels = [0, 1, 3, 4, 5]
    means = np.array(
        [
            bodies[0][i].point_data["displacement"].mean(axis=0)[:2]
            - 1j * bodies[3][i].point_data["displacement"].mean(axis=0)[:2]
            for i in wheels
        ]
    )
    wanted = (set_.free @ modes.shapes[:, 1]).reshape(-1, 3)[wheels, :2]
    factor = np.vdot(wanted, means) / np.vdot(wanted, wanted)
    assert means == pytest.approx(factor * wanted, abs=0.02 * float(np.abs(means).max()))

"""Modes as films: members move as rigid bodies, phases follow each other, what rests rests; files stay small."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.clock import Clock
from trochoid.drives.disc_pack import circle
from trochoid.drives.mode_film import (
    AROUND,
    BYTES,
    FRAMES,
    MOST,
    SHARE,
    Part,
    Swing,
    joined,
    mode_films,
    plate,
    solid,
    tube,
)
from trochoid.drives.precessional.mode_shapes import films as precessional_films
from trochoid.drives.precessional.stages import Stages as Precessional
from trochoid.kinematics.types import Array
from trochoid.results import vtk
from trochoid.results.film import Film
from trochoid.scene import load

PRECESSIONAL = Path(__file__).parents[2] / "examples" / "precessional.toml"
MIDDLE = np.array([0.02, -0.01, 0.05])


def parts() -> list[Part]:
    """A cylinder, a ring, a flat disc, and a member of two solids."""
    about = np.zeros(3)
    both = joined("both", [solid("", 0.01, -0.05, 0.05, MIDDLE), tube("", (0.03, 0.02), 0.0, 0.01, MIDDLE)])
    disc = plate("disc", circle(0.04, 16) + MIDDLE[:2], 0.01, 0.05, MIDDLE)
    return [
        solid("cylinder", 0.02, 0.0, 0.1, about),
        tube("ring", (0.06, 0.05), -0.01, 0.01, about),
        disc,
        both,
    ]


def swing(seed: int) -> Swing:
    """A mode in which everything moves but the ring."""
    first, second = np.random.default_rng(seed).normal(size=(2, 4, 6))
    motion = first + 1j * second
    motion[:, 3:] *= 20.0
    motion[1] = 0.0
    return Swing(1, "100 Hz", motion)


def moved(film: Film, frame: int, body: int) -> Array:
    return np.asarray(film.frames[frame][1][body].point_data["displacement"], dtype=np.float64)


@pytest.mark.property
@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_members_move_as_rigid_bodies(seed: int) -> None:
    """Distances do not change to first order: (p − q) · (u(p) − u(q)) = 0 for any two points of a member."""
    (film,) = mode_films(parts(), [swing(seed)])
    for frame in (0, 5):
        for i, part in enumerate(parts()):
            u = moved(film, frame, i)
            apart, faster = part.points - part.points[0], u - u[0]
            size = np.abs(u).max() * np.abs(apart).max() + 1e-12
            assert np.abs((apart * faster).sum(axis=1)).max() < 3e-6 * size


@pytest.mark.exact
def test_phases_follow_each_other() -> None:
    """12 frames, the end left out; a quarter on is −Im U; half a period on the displacement is reversed."""
    mode = swing(3)
    (film,) = mode_films(parts(), [mode], "seen from here")
    assert [np.degrees(value) for value, _ in film.frames] == pytest.approx([30.0 * k for k in range(FRAMES)])
    assert film.name == "mode_1"
    assert film.shown == "displacement"
    assert film.spatial
    assert "100 Hz; seen from here" in film.title
    for i, part in enumerate(parts()):
        whole = part.moved(mode.motion[i])
        start, quarter = moved(film, 0, i), moved(film, 3, i)
        assert moved(film, 6, i) == pytest.approx(-start, abs=1e-9)
        # one complex factor for all: size and phase of the picture
        if np.abs(whole).any():
            factor = (start - 1j * quarter).ravel() @ np.conj(whole.ravel()) / np.vdot(whole, whole)
            assert (factor * whole).real == pytest.approx(start, abs=1e-7)
            assert (factor * whole).imag == pytest.approx(-quarter, abs=1e-7)


@pytest.mark.exact
def test_size_whirl_and_rest() -> None:
    """The largest displacement is SHARE of the half size at some phase; a whirl keeps its size; what rests is 0."""
    bodies = parts()[:2]
    circling = np.zeros((2, 6), dtype=np.complex128)
    circling[0, :2] = 1.0, -1.0j
    (film,) = mode_films(bodies, [Swing(1, "", circling)])
    for frame in range(FRAMES):
        size = np.linalg.norm(moved(film, frame, 0), axis=1)
        assert size == pytest.approx(np.full(len(size), SHARE * 0.06), rel=1e-6)
        assert not moved(film, frame, 1).any()
    angle = np.unwrap([np.arctan2(*moved(film, frame, 0)[0, 1::-1]) for frame in range(FRAMES)])
    assert np.diff(angle) == pytest.approx(np.full(FRAMES - 1, 2 * np.pi / FRAMES), rel=1e-5)
    (still,) = mode_films(bodies, [Swing(1, "", 0.0 * circling)])
    assert not moved(still, 0, 0).any()


@pytest.mark.property
def test_few_modes_and_small_files(tmp_path: Path) -> None:
    """At most MOST films, fewer where they were larger than BYTES in all; what is written is no larger than told."""
    modes = [Swing(i + 1, "", swing(i).motion) for i in range(9)]
    films = mode_films(parts(), modes)
    assert [film.name for film in films] == [f"mode_{i + 1}" for i in range(MOST)]
    for film in films:
        vtk.save(film, tmp_path)
    assert sum(path.stat().st_size for path in tmp_path.rglob("*.vtu")) < BYTES
    fine = plate("fine", circle(0.1, 5000), 0.01, 0.0, np.zeros(3))
    swings = [Swing(i + 1, "", np.ones((1, 6), dtype=complex)) for i in range(3)]
    (alone,) = mode_films([fine], swings)
    assert "1 films, more were too large" in alone.title


@pytest.mark.property
def test_bodies_of_a_precessional_drive() -> None:
    """Members swing about their centres; the satellite leans by the nutation angle; none of the casing alone."""
    stages = Precessional(load(PRECESSIONAL, ('ask.quantities=["natural_frequencies"]',)), Clock())
    found = stages.modes
    films = precessional_films(stages.design, found)
    assert found.members == ("satellite", "input shaft", "casing")
    assert found.motions.shape == (len(found.modes), 3, 6)
    assert [body.name for body in films[0].frames[0][1]] == list(found.members)
    sizes = [np.linalg.norm(moved(films[0], frame, 2), axis=1).max() for frame in range(FRAMES)]
    assert len(films) == MOST
    assert "satellite turning" in films[0].title
    assert [film.name for film in films] == [
        f"mode_{i}" for i in range(7, 13)
    ]  # six of the casing on its mounts
    assert max(sizes) > 0.0
    body = films[0].frames[0][1][0]
    outer = body.points[:AROUND].astype(np.float64)  # the lower rim of the leaning ring
    normal = np.linalg.svd(outer - outer.mean(axis=0))[2][2]
    assert np.degrees(np.arccos(abs(normal[2]))) == pytest.approx(2.5, rel=1e-4)

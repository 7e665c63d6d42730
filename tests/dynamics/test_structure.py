"""An elastic casing: wave closed forms, the rigid limit, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from types import MappingProxyType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.solid_cases import CASING, bar
from trochoid.dynamics.casing import Mount
from trochoid.dynamics.structure import Place, Structure, elastic_casing, rigid_casing
from trochoid.dynamics.vibration import Point, vibrate
from trochoid.dynamics.wrench import Wrench, total
from trochoid.fem.material import Material
from trochoid.fem.reduction import Reduced, reduce
from trochoid.fem.solid import solid_body
from trochoid.fem.solid_interface import interfaces_of
from trochoid.geometry.casing_box import centers
from trochoid.geometry.casing_mesh import mesh_casing
from trochoid.kinematics.errors import TrochoidError

seeds = st.integers(0, 2**31 - 1)
PLACES = {"top": (0.0, 0.125, 0.0), "side": (0.15, 0.03, 0.02), "bearing": (0.0, 0.06, -0.1)}
POINTS = tuple(Point(name, at) for name, at in PLACES.items())
MOUNTS = {
    name: Mount(centers(CASING)[name], (2e6, 3e6, 1.5e6), (300.0, 250.0, 200.0), (1e3,) * 3, (2.0,) * 3)
    for name in ("foot 1", "foot 2", "foot 3")
}
HERTZ = 7.0
LINES = 71  # up to 490 Hz


@cache
def casing(stiffer: float = 1.0) -> Reduced:
    body = solid_body(mesh_casing(CASING, 0.05), Material(stiffer * 200e9, 0.3, 7800.0))
    return reduce(body, interfaces_of(body, centers(CASING)))


@cache
def structure(stiffer: float = 1.0) -> Structure:
    return elastic_casing(casing(stiffer), MOUNTS, PLACES, 0.01)


def _loads(seed: int) -> dict[str, Wrench]:
    rng = np.random.default_rng(seed)
    return {
        name: Wrench(
            100.0 * rng.normal(size=(2 * LINES, 3)), 5.0 * rng.normal(size=(2 * LINES, 3)), rng.normal(size=3)
        )
        for name in ("input", "output")
    }


@pytest.mark.property
@settings(max_examples=10, deadline=None)
@given(seeds)
def test_a_million_times_stiffer_is_rigid(seed: int) -> None:
    """E × 10⁶: velocities and mount frequencies of the rigid casing within 10⁻⁵ (elastic parts fall with 1/E)."""
    loads, rigid = _loads(seed), rigid_casing(casing(), MOUNTS)
    found = vibrate(structure(1e6), loads, HERTZ, POINTS)
    expected = vibrate(rigid, loads, HERTZ, POINTS)
    size = np.abs(expected.velocity).max()
    assert found.velocity == pytest.approx(expected.velocity, abs=1e-5 * size)
    assert found.natural_frequencies[:6] == pytest.approx(expected.natural_frequencies, rel=1e-6)


@pytest.mark.property
def test_elastic_casings_tend_to_the_rigid_one() -> None:
    """The difference falls in proportion to 1/E, and is there at E."""
    loads, rigid = _loads(1), rigid_casing(casing(), MOUNTS)
    expected = vibrate(rigid, loads, HERTZ, POINTS).velocity
    differences = [
        np.abs(vibrate(structure(by), loads, HERTZ, POINTS).velocity - expected).max()
        for by in (1.0, 1e2, 1e4)
    ]
    assert differences[0] > 1e-3 * np.abs(expected).max()
    assert differences[1] / differences[2] == pytest.approx(100.0, rel=0.02)


@pytest.mark.exact
def test_forces_that_cancel_still_breathe() -> None:
    """Equal and opposite forces on two bores: the rigid casing is silent, the elastic one is not."""
    force = np.zeros((2 * LINES, 3))
    force[:, 2] = 1e3 * np.cos(2.0 * np.pi * 3.0 * np.arange(2 * LINES) / (2 * LINES))
    axis = np.array([0.01, 0.0, 0.0])
    loads = {"input": Wrench(force, 0 * force, axis), "output": Wrench(-force, 0 * force, axis)}
    assert vibrate(rigid_casing(casing(), MOUNTS), loads, HERTZ, POINTS).rms_max < 1e-15
    assert vibrate(structure(), loads, HERTZ, POINTS).rms_max > 1e-7


@cache
def _bar() -> Reduced:
    size = (1.0, 0.05, 0.05)
    body = solid_body(bar(size, (16, 1, 1)), Material(200e9, 0.0, 8000.0))
    ends = {"left": (0.0, 0.025, 0.025), "right": (1.0, 0.025, 0.025)}
    return reduce(body, interfaces_of(body, ends), 20e3)


@pytest.mark.exact
def test_waves_in_a_bar() -> None:
    """ν = 0, force at one end of a free bar: v = iω F/(EAk) · −cot kL there, −1/sin kL at the other end."""
    free = elastic_casing(_bar(), {}, {"left": (0.0, 0.02, 0.03), "right": (1.0, 0.02, 0.03)}, 0.0)
    base, count = 90.0, 60
    phi = 2.0 * np.pi * np.arange(count) / count
    force = np.zeros((count, 3))
    force[:, 0] = sum(np.cos(h * phi) for h in range(1, 20))
    points = (Point("left", (0.0, 0.02, 0.03)), Point("right", (1.0, 0.02, 0.03)))
    found = vibrate(free, {"right": Wrench(force, 0 * force, np.array([0.0, 0.025, 0.025]))}, base, points)
    omega = 2.0 * np.pi * base * np.arange(1, 20)
    k = omega / 5000.0
    expected = 1j * omega / (200e9 * 0.0025 * k) * np.array([-1.0 / np.sin(k), -1.0 / np.tan(k)])
    assert found.velocity[:, 0, :19] == pytest.approx(expected, abs=3e-3 * np.abs(expected[0]).min())
    assert np.abs(found.velocity[:, 1:, :19]).max() < 1e-6 * np.abs(expected).max()


@pytest.mark.exact
def test_damping_of_an_elastic_mode() -> None:
    """At the first resonance of a free bar the elastic part is F φ²/(2ζω): its damping ratio alone limits it."""
    velocity = []
    hertz = elastic_casing(_bar(), {}, {}, 0.0)
    first = next(f for f in np.sqrt(np.diag(hertz.stiffness)) / (2.0 * np.pi) if abs(f - 2500.0) < 2.0)
    phi = 2.0 * np.pi * np.arange(8) / 8
    force = np.stack([np.cos(phi), 0 * phi, 0 * phi], axis=1)
    load = {"left": Wrench(force, 0 * force, np.array([0.0, 0.025, 0.025]))}
    for ratio in (0.001, 0.002):
        damped = elastic_casing(_bar(), {}, {"end": (1.0, 0.025, 0.025)}, ratio)
        found = vibrate(damped, load, first, (Point("end", (1.0, 0.025, 0.025)),), (10.0, 4000.0))
        velocity.append(abs(found.velocity[0, 0, 0]))
    # modal mass ρAL/2 with unit amplitude at the ends: v = F/(2ζω ρAL/2)
    assert velocity[0] == pytest.approx(1.0 / (0.001 * 2.0 * np.pi * first * 20.0), rel=2e-3)
    assert velocity[0] / velocity[1] == pytest.approx(2.0, rel=1e-2)


@pytest.mark.property
def test_rigid_casing_sums_its_seats_to_the_bit() -> None:
    """Loads by seat on a rigid casing are their vector sum."""
    loads, rigid = _loads(4), rigid_casing(casing(), MOUNTS)
    by_seat = vibrate(rigid, loads, HERTZ, POINTS)
    summed = vibrate(rigid, total(tuple(loads.values())), HERTZ, POINTS)
    assert np.array_equal(by_seat.velocity, summed.velocity)


@pytest.mark.property
def test_matrices_are_symmetric_and_positive() -> None:
    """K and C of an elastic casing on mounts; without mounts and damping: zero for the six rigid coordinates."""
    found = structure()
    for matrix in (found.stiffness, found.damping):
        assert np.array_equal(matrix, matrix.T)
        assert np.linalg.eigvalsh(matrix).min() > -1e-9 * np.abs(matrix).max()
    free = elastic_casing(casing(), {}, {}, 0.02)
    assert not free.stiffness[:6].any()
    assert not free.damping[:6].any()
    hertz = np.sqrt(np.diag(free.stiffness)[6:])
    assert np.diag(free.damping)[6:] == pytest.approx(0.04 * hertz, rel=1e-12)


@pytest.mark.property
def test_held_feet_are_very_stiff_mounts() -> None:
    """Springs, also of rotation, a million times as stiff as the casing: velocities of held feet within 1e-5."""
    stiff = {
        name: Mount(mount.position, (1e15,) * 3, (0.0,) * 3, (1e12,) * 3) for name, mount in MOUNTS.items()
    }
    sprung = elastic_casing(casing(), stiff, PLACES, 0.0)
    held = elastic_casing(casing(), {}, PLACES, 0.0, held=tuple(MOUNTS))
    found, expected = (vibrate(each, _loads(5), HERTZ, POINTS) for each in (sprung, held))
    size = np.abs(expected.velocity).max()
    assert found.velocity == pytest.approx(expected.velocity, abs=1e-5 * size)
    assert held.mass.shape[0] == casing().size - 6 * len(MOUNTS)


@pytest.mark.exact
def test_few_modes_are_reported() -> None:
    """Modes up to 500 Hz for a band up to 1000 Hz: a warning; up to 2000 Hz: none about it."""
    short = replace(structure(), upper=500.0)
    said = vibrate(short, _loads(2), HERTZ, POINTS).warnings
    assert any("modes up to 500 Hz" in text for text in said)
    assert not any("modes up to" in text for text in vibrate(structure(), _loads(2), HERTZ, POINTS).warnings)


@pytest.mark.exact
@pytest.mark.parametrize("ratio", [1.0, 1.0 + 1e-10])
def test_undamped_resonance_is_refused(ratio: float) -> None:
    """A coordinate of 25 Hz without damping, excited at 25 Hz: refused; excited at 50 Hz: solved."""
    omega = 2.0 * np.pi * 25.0 * ratio
    seat = Place((0.0, 0.0, 0.0), np.eye(6))
    places = MappingProxyType({"seat": seat})
    alone = Structure(np.eye(6), np.zeros((6, 6)), np.diag([omega**2] + [1.0] * 5), places, places)
    phi = 2.0 * np.pi * np.arange(12) / 12
    points = (Point("seat", (0.0, 0.0, 0.0)),)
    for order, refused in ((1, True), (2, False)):
        force = np.stack([np.cos(order * phi), 0 * phi, 0 * phi], axis=1)
        load = {"seat": Wrench(force, 0 * force, np.zeros(3))}
        if refused:
            with pytest.raises(TrochoidError, match=r"harmonic 1 \(25 Hz\).*no damping"):
                vibrate(alone, load, 25.0, points)
        else:
            found = vibrate(alone, load, 25.0, points)
            w = 2.0 * np.pi * 50.0
            assert abs(found.velocity[0, 0, 1]) == pytest.approx(w / (w**2 - omega**2), rel=1e-9)


@pytest.mark.exact
def test_what_an_elastic_casing_must_be_told() -> None:
    """Where loads act, where it is read, which feet stand on mounts, a ratio that damps: each refusal names it."""
    loads = _loads(3)
    with pytest.raises(TrochoidError, match="where its loads act"):
        vibrate(structure(), loads["input"], HERTZ, POINTS)
    with pytest.raises(TrochoidError, match="loads act at inpt; the casing has input"):
        vibrate(structure(), {"inpt": loads["input"]}, HERTZ, POINTS)
    with pytest.raises(TrochoidError, match="no seat"):
        vibrate(structure(), {}, HERTZ, POINTS)
    with pytest.raises(TrochoidError, match="not read at lid; its points are top"):
        vibrate(structure(), loads, HERTZ, (Point("lid", (0.0, 0.0, 0.0)),))
    short = Wrench(loads["input"].force[:9], loads["input"].moment[:9], np.zeros(3))
    with pytest.raises(TrochoidError, match="equally long"):
        vibrate(structure(), {**loads, "input": short}, HERTZ, POINTS)
    with pytest.raises(TrochoidError, match="no interface 'foot 9'"):
        elastic_casing(casing(), {"foot 9": MOUNTS["foot 1"]}, PLACES, 0.01)
    for ratio in (-0.1, 1.0):
        with pytest.raises(TrochoidError, match="damping ratio"):
            elastic_casing(casing(), MOUNTS, PLACES, ratio)

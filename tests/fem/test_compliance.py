"""Tabulated compliance against the circular disc in closed form, and the spline that reads it between stations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from tests.fem.cases import (
    RADIUS,
    STEEL,
    free_disc_green,
    free_disc_smooth,
    on_circle,
    round_disc,
    small_mesh,
)
from trochoid.fem.body import build_body
from trochoid.fem.compliance import Compliance, Surface, Weights, press, surface_weights
from trochoid.fem.laws import HertzLine
from trochoid.fem.material import Material, Plane
from trochoid.fem.pair import Seat
from trochoid.kinematics.types import Array


def _errors(facets: int, between: float, plane: Plane = STEEL) -> tuple[float, float]:
    """Return the largest errors of S(x, x) and S(x, y) in units of 2/(πE'), a share of the way between stations."""
    _, compliance = round_disc(facets, plane=plane)
    surface = compliance.surfaces["rim"]
    place = surface.positions + between * surface.length / facets
    angle = place / RADIUS
    found = compliance.smooth(surface_weights(surface, place), on_circle(RADIUS, angle))
    error = np.abs(found - free_disc_smooth(plane, RADIUS, angle[:, None] - angle)) / plane.kernel
    own = np.diag(error).copy()
    np.fill_diagonal(error, 0.0)
    return float(own.max()), float(error.max())


@pytest.mark.exact
def test_closed_form_of_the_disc_is_the_sum_of_its_series() -> None:
    """The closed form in `cases` against its own Fourier series (Muskhelishvili, § 80), 2e5 terms."""
    angle, n = np.array([0.3, 1.0, 2.5, np.pi]), np.arange(2, 200_001)
    kappa, shear = STEEL.kolosov, STEEL.shear
    weight = kappa / (n + 1) + 1 / (n - 1)
    series = np.array([np.sum(weight * np.cos(n * a)) for a in angle])
    series = (series + 0.5 * (kappa - 1) * (1 + np.cos(angle))) / (4 * np.pi * shear)
    assert series == pytest.approx(free_disc_green(STEEL, angle), abs=1e-4 * STEEL.kernel)


@pytest.mark.exact
@pytest.mark.parametrize(
    "plane", [STEEL, Material(1.0, 0.45).plane("strain"), Material(70e9, 0.0).plane("stress")]
)
def test_circular_disc_at_the_stations(plane: Plane) -> None:
    """24 facets round a disc give S(x, x) to 5e-5 of the logarithm's factor, for any Poisson's ratio."""
    own, other = _errors(24, 0.0, plane)
    assert own < 5e-5
    assert other < 1.5e-4


@pytest.mark.exact
def test_circular_disc_converges_at_the_stations() -> None:
    """Facets halved: S(x, x) falls with the fourth power while D spans the disc, S(x, y) with the third."""
    coarse, fine = _errors(12, 0.0), _errors(24, 0.0)
    assert np.log2(coarse[0] / fine[0]) > 3.5
    assert np.log2(coarse[1] / fine[1]) > 2.5


@pytest.mark.exact
@pytest.mark.parametrize("facets", [48, 96])
def test_what_the_patch_leaves_does_not_vanish(facets: int) -> None:
    """D is a fixed number of facets wide and the mesh grows beyond it: 1e-3 of the logarithm's factor stays."""
    assert max(_errors(facets, 0.0)) < 1e-3


@pytest.mark.exact
def test_circular_disc_between_the_stations() -> None:
    """The spline: S(x, x) as good as at the stations; next to x = y, θ² ln θ is left in S, with the second power."""
    errors = np.array([_errors(facets, 0.5) for facets in (12, 24, 48)])
    assert errors[1:, 0].max() < 1e-4
    assert errors[2, 1] < 1.2e-3
    assert np.log2(errors[:-1, 1] / errors[1:, 1]) == pytest.approx(2.0, abs=0.25)


@pytest.mark.exact
@pytest.mark.parametrize("load", [1e4, 1e7])
def test_disc_squeezed_by_two_contacts(load: float) -> None:
    """Johnson, Contact Mechanics (5.57): a diameter shortens by 2 P (2/πE')(ln(4R/a) − ½) under two line loads P."""
    _, compliance = round_disc(24)
    surface = compliance.surfaces["rim"]
    place = surface_weights(surface, np.array([0.2, 0.2 + np.pi]) * RADIUS)
    coupling = compliance.between(place, on_circle(RADIUS, np.array([0.2, 0.2 + np.pi])))
    law = HertzLine(np.array([STEEL.kernel]), np.array([RADIUS]))
    half_width = float(law.half_width(np.array([load]))[0])
    approach = law.approach(np.array([load]))[0][0] + load * coupling[0].sum()
    johnson = load * STEEL.kernel * (np.log(4 * RADIUS / half_width) - 0.5)
    assert approach == pytest.approx(johnson, rel=5e-5)


@pytest.mark.property
def test_table_is_symmetric_as_far_as_the_mesh_allows() -> None:
    """Betti: S(x, y) = S(y, x); what the raw columns miss of it is reported and falls with the mesh."""
    coarse, fine = round_disc(12)[1], round_disc(24)[1]
    assert np.array_equal(fine.stations, fine.stations.T)
    assert fine.asymmetry < 0.5 * coarse.asymmetry < 5e-4


@pytest.mark.property
def test_every_station_of_a_round_disc_is_alike() -> None:
    """S of a circular disc is circulant; gmsh's mesh is not, so the spread is a discretisation error."""
    stations = round_disc(24)[1].stations
    count = len(stations)
    for apart in (0, 1, 6, 12):
        ring = stations[np.arange(count), (np.arange(count) + apart) % count]
        assert np.ptp(ring) < 1.5e-4 * STEEL.kernel


@pytest.fixture(scope="module")
def drilled() -> Compliance:
    mesh, outline = small_mesh()
    return press(build_body(mesh, STEEL), outline.loops)


@pytest.mark.property
def test_contacts_between_surfaces_are_reciprocal(drilled: Compliance) -> None:
    """Points on flank, bore and two holes, at stations and between: symmetric, with the logarithm off the diagonal."""
    rng = np.random.default_rng(5)
    names = ("flank", "bore", "hole0", "hole5")
    parts = [
        surface_weights(drilled.surfaces[n], rng.uniform(0, drilled.surfaces[n].length, 4)) for n in names
    ]
    points = rng.normal(size=(16, 2)) * 0.05
    found = drilled.between(Weights.joined(parts), points)
    smooth = drilled.smooth(Weights.joined(parts), points)
    assert np.abs(found - found.T).max() < 1e-12 * np.abs(found).max()
    distance = np.linalg.norm(points[:, None] - points, axis=-1) + np.eye(16)
    assert found == pytest.approx(smooth - STEEL.kernel * np.log(distance), rel=1e-12, abs=1e-24)


@pytest.mark.property
def test_equal_surfaces_share_their_weights(drilled: Compliance) -> None:
    """A seat on several holes reads each one's own table: the same weights as surface by surface."""
    names = ["hole2", "hole7", "hole0"]
    surfaces = [drilled.surfaces[n] for n in names]
    place = np.array([s.positions[0] for s in surfaces]) + np.array([1e-3, -2e-2, 0.0])
    shared = Seat.on(0, surfaces).weights(place)
    for i, surface in enumerate(surfaces):
        own = surface_weights(surface, place[i : i + 1])
        assert np.array_equal(shared.columns[i], own.columns[0])
        assert shared.values[i] == pytest.approx(own.values[0], abs=1e-9)
        assert shared.surface[i] == own.surface[0]


def _uneven() -> tuple[Surface, Array]:
    rng = np.random.default_rng(6)
    positions = np.sort(rng.uniform(0.5, 2.5, 15))
    return Surface("loop", positions, 2.4, 7, 0.0), rng.normal(size=15)


@pytest.mark.independent
def test_spline_is_the_periodic_cubic_spline_of_scipy() -> None:
    """Collocated at uneven stations and read anywhere on the loop: scipy's CubicSpline with periodic ends."""
    surface, values = _uneven()
    at = surface_weights(surface, surface.positions)
    matrix = np.zeros((15, 15))
    np.add.at(matrix, (np.arange(15)[:, None], at.columns - surface.first), at.values)
    coefficients = np.linalg.solve(matrix, values)
    place = np.linspace(-3.0, 7.0, 200)
    weights = surface_weights(surface, place)
    found = np.einsum("na,na->n", coefficients[weights.columns - surface.first], weights.values)
    turn = np.append(surface.positions, surface.positions[0] + surface.length)
    reference = CubicSpline(turn, np.append(values, values[0]), bc_type="periodic")
    wrapped = turn[0] + np.mod(place - turn[0], surface.length)
    assert found == pytest.approx(reference(wrapped), abs=1e-9)


@pytest.mark.property
def test_splines_sum_to_one() -> None:
    """A constant table reads as that constant everywhere."""
    surface, _ = _uneven()
    assert surface_weights(surface, np.linspace(-5, 5, 301)).values.sum(axis=1) == pytest.approx(np.ones(301))

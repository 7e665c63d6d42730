"""Bodies of rays: stiffness, superelements and symmetry against closed forms and against direct solutions."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse import csc_matrix, hstack

from tests.fem.cone_cases import INNER, OUTER, SHAPE, STEEL, TOOTH, sector
from tests.kinematics.sphere_cases import EXAMPLES
from trochoid.fem.cone_body import ConeBody, cone_body, factored, product, read
from trochoid.fem.cone_flank import flank, load_at
from trochoid.fem.cone_layers import integrals, layers, matrices
from trochoid.fem.cone_ring import full_rim, row_of_teeth
from trochoid.fem.cone_sector import Sector, condense, station_loads
from trochoid.fem.cone_stiffness import cone_stiffness
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import roller_outline, sector_outline
from trochoid.geometry.sphere_rim import RimShape
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.spherical_curve import SmallCircle
from trochoid.kinematics.types import Array, IntArray


def places(body: ConeBody) -> Array:
    """Nodes (n, 3, layer nodes) of a body, m."""
    return np.asarray(body.mesh.points[:, :, None] * body.radial.nodes)


def inner_dofs(body: ConeBody) -> IntArray:
    """Degrees of freedom inside."""
    inside = np.ones((len(body.mesh.points), 3, body.radial.count), dtype=bool)
    inside[np.unique(np.concatenate([e.ravel() for e in body.mesh.edges.values()]))] = False
    inside[:, :, [0, -1]] = False
    return np.flatnonzero(inside.ravel())


@pytest.mark.exact
def test_patch_and_rigid_motions() -> None:
    """A linear field leaves no force on any inner node of the curved mesh; a rotation leaves none anywhere."""
    body = sector()
    gradient = np.random.default_rng(1).normal(size=(3, 3))
    force = body.stiffness @ np.einsum("ij,njl->nil", gradient, places(body)).ravel()
    assert np.abs(force[inner_dofs(body)]).max() < 1e-12 * np.abs(force).max()
    turned = body.stiffness @ np.einsum("ij,njl->nil", gradient - gradient.T, places(body)).ravel()
    assert np.abs(turned).max() < 1e-12 * np.abs(force).max()
    assert np.abs(body.stiffness - body.stiffness.T).max() < 1e-15 * np.abs(body.stiffness).max()


@pytest.mark.exact
def test_radial_matrices() -> None:
    """∫ρ² ρ' ρ' = (b³ − a³)/3, ∫ρ·1·… of polynomials of the layers' degree, to rounding."""
    radial = layers(0.5, 0.7, 3)
    found, rho, one = matrices(radial), radial.nodes, np.ones(radial.count)
    assert rho @ found.steep @ rho == pytest.approx((0.7**3 - 0.5**3) / 3, rel=1e-13)
    assert rho**2 @ found.mixed @ one == pytest.approx(2 * (0.7**3 - 0.5**3) / 3, rel=1e-13)
    assert rho**2 @ found.plain @ rho == pytest.approx((0.7**4 - 0.5**4) / 4, rel=1e-13)
    assert integrals(radial).sum() == pytest.approx(0.2, rel=1e-14)
    assert rho @ integrals(radial) == pytest.approx(np.diff(radial.breaks**2) / 2, rel=1e-13)


def _lame_error(facets: int, count: int) -> float:
    """Largest relative error of the radial displacement of a thick sphere under inner pressure."""
    a, b, pressure = 0.5, 1.0, 1e6
    mesh = mesh_sphere(roller_outline(0.4, facets))
    radial = layers(a, b, count, grading=1.0)
    stiffness, size = cone_stiffness(mesh, radial, STEEL), (len(mesh.points), 3, radial.count)
    e, nu = STEEL.youngs_modulus, STEEL.poissons_ratio
    rho = radial.nodes
    exact = pressure * a**3 / (e * (b**3 - a**3)) * ((1 - 2 * nu) * rho + (1 + nu) * b**3 / (2 * rho**2))
    wanted = (mesh.points[:, :, None] * exact).ravel()
    held = np.zeros(size, dtype=bool)
    held[np.unique(mesh.edges["flank"])] = True
    held[:, :, 0] = True
    free = np.flatnonzero(~held.ravel())
    known = np.where(held.ravel(), wanted, 0.0)
    solve = factored(ConeBody(mesh, radial, STEEL, stiffness, held.ravel()), ~held.ravel())
    found = known.copy()
    found[free] = solve(-(stiffness @ known)[free][:, None])[:, 0]
    return float(np.abs(found - wanted).max() / np.abs(wanted).max())


@pytest.mark.exact
def test_thick_sphere_under_pressure() -> None:
    """Lamé's sphere, free of stress outside: given the rim of a cap and its inner sphere, the rest converges to it."""
    coarse, fine = _lame_error(8, 3), _lame_error(16, 6)
    assert fine < 3e-4
    assert coarse / fine > 6.0  # nearly third order


def condensed(body: ConeBody, degree: int = 6) -> Sector:
    """One tooth of the rim."""
    return condense(body, station_loads(flank(body.mesh, TOOTH), body), SHAPE.pitch, degree)


@pytest.mark.independent
def test_superelements_in_a_row_are_the_body_meshed_whole() -> None:
    """Three condensed teeth against three teeth in one mesh, all loads on all teeth."""
    body = sector(12, 3)
    side, whole = flank(body.mesh, TOOTH), sector(12, 3, teeth=3)
    row = row_of_teeth(condensed(body), 3)
    long = flank(whole.mesh, TOOTH)
    columns = [
        load_at(long, c + m * side.length, w)
        for m in range(3)
        for c, w in zip(side.centers, side.half_width, strict=True)
    ]
    depth = integrals(body.radial)
    loads = product(hstack(columns, format="csc"), depth / depth.sum(axis=0))
    inner = np.flatnonzero(~whole.held)
    exact, _ = read(factored(whole, ~whole.held), loads[inner], csc_matrix((len(inner), 0)))
    count = 12 * 3
    largest = exact.max()
    for m in range(3):
        for n in range(3):
            block = exact[m * count : (m + 1) * count, n * count : (n + 1) * count]
            error = np.abs(row.table[row.pair[m, n]] - block).max() / largest
            assert error < (2e-2 if abs(m - n) < 2 else 1e-3), (m, n)
    inside = np.arange(2 * 3, 10 * 3)  # the two stations beside each cut feel its polynomials
    middle = exact[count : 2 * count, count : 2 * count][np.ix_(inside, inside)]
    found = row.table[row.pair[1, 1]][np.ix_(inside, inside)]
    assert np.abs(found - middle).max() < 4e-3 * largest


@pytest.mark.independent
def test_an_outer_rim_with_a_web_meshed_whole() -> None:
    """The same for two teeth of a wheel outside its pins, held over the middle third of its hub alone."""
    tooth = EXAMPLES[2]
    shape, radial, web = RimShape(tooth, 1.5), layers(INNER, OUTER, 3, (52e-3, 56e-3)), (52e-3, 56e-3)
    one, two = (
        cone_body(mesh_sphere(sector_outline(shape, 10, teeth)), radial, STEEL, web=web) for teeth in (1, 2)
    )
    side, long = flank(one.mesh, tooth), flank(two.mesh, tooth)
    row = row_of_teeth(condense(one, station_loads(side, one), shape.pitch, 6), 2)
    at = [(m, k) for m in range(2) for k in (3, 6)]
    columns = [load_at(long, side.centers[k] + m * side.length, side.half_width[k]) for m, k in at]
    depth = integrals(radial)
    loads = product(hstack(columns, format="csc"), depth / depth.sum(axis=0))
    inner = np.flatnonzero(~two.held)
    exact, _ = read(factored(two, ~two.held), loads[inner], csc_matrix((len(inner), 0)))
    s = depth.shape[1]
    for i, (m, k) in enumerate(at):
        for j, (n, other) in enumerate(at):
            found = row.table[row.pair[m, n]][k * s : (k + 1) * s, other * s : (other + 1) * s]
            block = exact[i * s : (i + 1) * s, j * s : (j + 1) * s]
            assert np.abs(found - block).max() < 8e-3 * exact.max(), (m, k, n, other)


@pytest.mark.exact
def test_harmonics_are_the_closed_chain() -> None:
    """Block-circulant sums against one dense matrix of all cuts of a closed rim."""
    one = condensed(sector(8, 3), 2)
    z, t, count = 29, len(one.stiffness) // 2, len(one.pull)
    matrix, load = np.zeros((z * t, z * t)), np.zeros((z * count, z * t))
    for m in range(z):
        cuts = np.concatenate([np.arange(t) + m * t, np.arange(t) + (m + 1) % z * t])
        matrix[np.ix_(cuts, cuts)] += one.stiffness
        load[m * count : (m + 1) * count, cuts] += one.pull
    first = load[:count] @ cho_solve(cho_factor(matrix), load.T)
    rim = full_rim(one, z)
    raw = first.reshape(count, z, count).transpose(1, 0, 2)
    raw[0] += one.own
    # loads within the tooth have one part only
    alone = [s for s in range(8) if (one.loads.station == s).sum() == 1]
    rows = np.concatenate([np.flatnonzero(one.loads.station == s)[0] * 3 + np.arange(3) for s in alone])
    kept = np.concatenate([s * 3 + np.arange(3) for s in alone])
    for other in (0, 1, 14, 28):
        found = rim.table[rim.pair[0, other]][np.ix_(kept, kept)]
        assert found == pytest.approx(raw[other][np.ix_(rows, rows)], abs=1e-12 * raw[0].max())


@pytest.mark.property
def test_coupling_is_symmetric_and_positive() -> None:
    """Maxwell and Betti over all teeth; a mirrored tooth has the mirrored table."""
    rim = full_rim(condensed(sector(8, 3), 3), 29)
    for m, n in ((0, 0), (0, 1), (3, 20)):
        one, other = rim.table[rim.pair[m, n]], rim.table[rim.pair[n, m]]
        assert np.abs(one - other.T).max() < 1e-12 * rim.table.max()
    assert np.linalg.eigvalsh(rim.table[rim.pair[0, 0]]).min() > 0.0
    table = rim.table[rim.pair[0, 0]].reshape(8, 3, 8, 3)
    assert np.abs(table - table[::-1, :, ::-1]).max() < 3e-2 * table.max()  # triangles are not mirrored


@pytest.mark.exact
def test_loads_press_with_one_newton() -> None:
    """The half ellipse integrates to the normal at its center, cut at the ends of a sector or not."""
    body = sector(12, 3)
    side = flank(body.mesh, TOOTH)
    for center, half in ((5.3, 0.02), (0.2, 0.03), (11.9, 0.03)):
        at = side.ends[int(center)] + center % 1 * (side.ends[int(center) + 1] - side.ends[int(center)])
        total = np.zeros(3)
        for shift in (-1, 0, 1):
            part = load_at(side, at - shift * side.length, half).toarray().reshape(-1, 3).sum(axis=0)
            total += rotation(2, shift * SHAPE.pitch) @ part
        assert total == pytest.approx(-side.normal_at(at), abs=1e-5)


@pytest.mark.exact
def test_johnson_cylinder_without_poisson() -> None:
    """A solid cylinder pressed from two sides yields (2/(πE))(ln(4r/b) − ½) on each (Johnson, 5.57); ν = 0, so that
    a finite one is plane.
    """
    material, rho, r = Material(210e9, 0.0), 1.0, 2.5e-3
    mesh = mesh_sphere(roller_outline(r / rho, 64))
    radial = layers(rho - 4e-3, rho + 4e-3, 2)
    side = flank(mesh, SmallCircle((1.0, 0.0, 0.0), r / rho))
    half = float(side.half_width[0])
    at = (float(side.centers[0]), float(side.centers[0]) + 0.5 * side.length)
    plane = [
        sum((load_at(side, c + k * side.length, half) for k in (-1, 1)), load_at(side, c, half)) for c in at
    ]
    depth = integrals(radial).sum(axis=1, keepdims=True)
    both = csc_matrix(product(csc_matrix(plane[0] + plane[1]), depth / depth.sum()))
    body = cone_body(mesh, radial, material, held=("flank",))
    held = np.zeros((len(mesh.points), 3, radial.count), dtype=bool)
    middle = int(np.argmax(mesh.points[:, 0]))
    held[middle, :, 0], held[middle, 1:, -1] = True, True
    apart = int(np.argmax(np.abs(mesh.points[:, 1]) * (np.abs(mesh.points[:, 2]) < 1e-5)))
    held[apart, 2, 0] = True
    free = np.flatnonzero(~held.ravel())
    own, _ = read(factored(body, ~held.ravel()), both[free], csc_matrix((len(free), 0)))
    kernel = material.plane("strain").kernel
    length, width = 8e-3, half * rho
    # mean over the load instead of its middle: ½ is ¼ more, on each side
    exact = 2 * kernel * (np.log(4 * r / width) - 0.5 - 0.25) / length
    assert float(own[0, 0]) == pytest.approx(exact, rel=3e-3)


@pytest.mark.property
def test_what_cannot_be_held_is_refused() -> None:
    """Unknown sides, webs beside the body, reaches that end within a layer, layers the wrong way round."""
    body = sector(8, 3)
    with pytest.raises(TrochoidError, match='no side "bore"'):
        cone_body(body.mesh, body.radial, STEEL, held=("bore",))
    with pytest.raises(TrochoidError, match="must be held"):
        cone_body(body.mesh, body.radial, STEEL, web=(0.07, 0.08))
    with pytest.raises(TrochoidError, match="does not end between layers"):
        station_loads(flank(body.mesh, TOOTH), body, (50.01e-3, OUTER))
    with pytest.raises(Infeasible, match="radii must be positive"):
        layers(OUTER, INNER, 3)

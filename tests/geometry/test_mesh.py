"""Second-order meshes: true boundaries, quality, numbering, determinism, and a gmsh that leaves no trace."""

import math
import signal
import subprocess
import sys

import numpy as np
import numpy.typing as npt
import pytest

from trochoid.geometry.crossing import fail_if_crossing
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mass import section
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Loop, Outline, graded_breaks
from trochoid.geometry.quality import jacobian_bounds, quality
from trochoid.geometry.session import gmsh_session
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.path import Path, Piece, polygon

SPOT = Circle((0.0, 0.0), 1.0)
EXAMPLE = Cycloid(20, 19, 0.08, 0.005, 0.0025)
DISC = disc_outline(EXAMPLE, 0.025, 8, 0.052, 0.01, 0.0, 12)


def drive(pins: int, facets: int) -> Outline:
    """Disc with bore and six holes, K = 0.6, pin at half the undercut limit."""
    thin = Cycloid(pins, pins - 1, 0.1, 1e-6, 0.06 / pins)
    pin = 0.5 * min(thin.undercut_radius, 0.1 * math.sin(math.pi / pins))
    return disc_outline(Cycloid(pins, pins - 1, 0.1, pin, 0.06 / pins), 0.03, 6, 0.055, 0.012, 0.1, facets)


def block() -> Outline:
    """Block under a contact at its top centre, with named sides."""
    shape = polygon([[-0.1, -0.2], [0.1, -0.2], [0.1, 0.0], [0.0, 0.0], [-0.1, 0.0]])
    breaks = graded_breaks(shape, np.array([3.0]), 2e-4, 0.02, 0.3, 2e-3)
    sides = {"bottom": (0.0, 1.0), "right": (1.0, 2.0), "top": (2.0, 4.0), "left": (4.0, 5.0)}
    return Outline(Loop("block", shape, breaks=breaks, sides=sides))


def half_disc() -> Outline:
    """Half a cylinder, loaded from above, refined at its lowest point."""
    shape = Path((Piece((-0.05, 0.0), (0.05, 0.0), math.pi), Piece((0.05, 0.0), (-0.05, 0.0))))
    return Outline(Loop("rim", shape, breaks=graded_breaks(shape, np.array([0.5]), 2e-4, 0.01)))


def plate_with_hole() -> Outline:
    """Far boundary at 60 hole radii, as for a conforming pin."""
    return Outline(
        Loop("far", Circle((0.0, 0.0), 0.6), 48), (Loop("hole", Circle((0.0, 0.0), 0.01, True), 96),)
    )


OUTLINES = {
    "6 lobes": drive(7, 12),
    "6 lobes coarse": drive(7, 6),
    "example": DISC,
    "40 lobes": drive(41, 8),
    "100 lobes": drive(101, 6),
    "no holes": disc_outline(EXAMPLE, 0.025, 0, 0.0, 0.0, 0.0, 12),
    "circular plate": Outline(Loop("rim", Circle((0.0, 0.0), 0.05), 60)),
    "block": block(),
    "half disc": half_disc(),
    "plate with hole": plate_with_hole(),
}


@pytest.mark.property
@pytest.mark.parametrize("name", OUTLINES)
def test_meshes_are_well_shaped(name: str) -> None:
    """Angles from 20° to 140° and no element near folding, on every outline a drive or case needs."""
    result = quality(mesh_outline(OUTLINES[name]))
    assert math.degrees(result.min_angle) > 20.0
    assert math.degrees(result.max_angle) < 140.0
    assert result.min_scaled_jacobian > 0.3


@pytest.mark.exact
def test_boundary_nodes_lie_on_the_true_curves_in_order() -> None:
    """Facets join end to start, parameters grow over one period, and mid nodes sit at half the arc length."""
    mesh = mesh_outline(DISC)
    for loop in DISC.loops:
        nodes, t = mesh.edges[loop.name], mesh.parameters[loop.name]
        np.testing.assert_array_equal(nodes[1], np.roll(nodes[0], -1))
        np.testing.assert_allclose(mesh.points[nodes], loop.curve.point(t), atol=1e-15)
        assert np.all((t[0] < t[2]) & (t[2] < t[1]))
        assert t[1, -1] - t[0, 0] == pytest.approx(loop.curve.period, rel=1e-15)
        s = ArcLength(loop.curve).length(t)
        np.testing.assert_allclose(s[2] - s[0], s[1] - s[2], rtol=1e-9)


@pytest.mark.exact
def test_all_other_mid_nodes_are_straight() -> None:
    """Each mid node that is not on a loop is the mean of its edge's ends."""
    mesh = mesh_outline(DISC)
    curved = np.concatenate([edge[2] for edge in mesh.edges.values()])
    for middle, (a, b) in zip(mesh.triangles[3:], ((0, 1), (1, 2), (0, 2)), strict=True):
        inner = ~np.isin(middle, curved)
        straight = 0.5 * (mesh.points[mesh.triangles[a]] + mesh.points[mesh.triangles[b]])
        np.testing.assert_allclose(mesh.points[middle][inner], straight[inner], atol=1e-16)


@pytest.mark.independent
def test_nodes_are_numbered_as_scikit_fem_numbers_them() -> None:
    """MeshTri2 and its P2 basis keep our node numbers, so dof = 2 node + component."""
    from skfem import Basis, ElementTriP2, ElementVector, MeshTri2

    mesh = mesh_outline(DISC)
    theirs = MeshTri2(np.ascontiguousarray(mesh.points.T), mesh.triangles[:3])
    np.testing.assert_array_equal(theirs.dofs.element_dofs, mesh.triangles)
    basis = Basis(theirs, ElementVector(ElementTriP2()))
    np.testing.assert_allclose(basis.doflocs[:, ::2].T, mesh.points, atol=1e-17)
    assert basis.doflocs.shape[1] == 2 * len(mesh.points)


def area(mesh: Mesh) -> float:
    """Area of the curved elements: the mid-side points integrate the Jacobian, a quadratic, exactly."""
    a, b, c, ab, bc, ac = mesh.points[mesh.triangles]
    total = 0.0
    for x, y in ((0.5, 0.0), (0.5, 0.5), (0.0, 0.5)):
        z = 1.0 - x - y
        dx = (1 - 4 * z) * a + (4 * x - 1) * b + 4 * (z - x) * ab + 4 * y * bc - 4 * y * ac
        dy = (1 - 4 * z) * a + (4 * y - 1) * c - 4 * x * ab + 4 * x * bc + 4 * (z - y) * ac
        total += float(np.sum(dx[:, 0] * dy[:, 1] - dx[:, 1] * dy[:, 0])) / 6.0
    return total


@pytest.mark.exact
def test_area_converges_with_the_fourth_power_of_the_facet_length() -> None:
    """Against the exact boundary integral, half the facets leave a sixteenth of the error."""
    errors = []
    for facets in (8, 16, 32):
        outline = disc_outline(EXAMPLE, 0.025, 8, 0.052, 0.01, 0.0, facets)
        errors.append(abs(area(mesh_outline(outline)) / section(outline).area - 1.0))
    rates = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert errors[0] < 1e-4
    assert rates.min() > 3.5


@pytest.mark.property
def test_jacobian_bounds_hold() -> None:
    """The determinant at random points, by differences of the map, lies between its bounds."""
    rng = np.random.default_rng(1)
    mesh = mesh_outline(OUTLINES["6 lobes coarse"])
    points = mesh.points + 3e-4 * rng.standard_normal(mesh.points.shape)  # all edges curved
    low, high = jacobian_bounds(points, mesh.triangles)
    node = points[mesh.triangles]

    def position(x: float, y: float) -> npt.NDArray[np.float64]:
        z = 1.0 - x - y
        shape = (z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * x * z, 4 * x * y, 4 * y * z)
        return np.asarray(np.tensordot(shape, node, 1))

    h = 1e-3  # central differences are exact for a quadratic map
    for x, y in rng.dirichlet((1.0, 1.0, 1.0), 50)[:, :2]:
        dx = (position(x + h, y) - position(x - h, y)) / (2.0 * h)
        dy = (position(x, y + h) - position(x, y - h)) / (2.0 * h)
        value = dx[:, 0] * dy[:, 1] - dx[:, 1] * dy[:, 0]
        assert np.all(value >= low - 1e-9 * np.abs(high))
        assert np.all(value <= high + 1e-9 * np.abs(high))


@pytest.mark.property
def test_reruns_are_equal_to_the_bit_and_arrays_are_read_only() -> None:
    """Same outline, same mesh."""
    one, two = mesh_outline(DISC), mesh_outline(DISC)
    np.testing.assert_array_equal(one.points, two.points)
    np.testing.assert_array_equal(one.triangles, two.triangles)
    for array in (one.points, one.triangles, one.edges["bore"], one.parameters["flank"]):
        assert not array.flags.writeable


@pytest.mark.property
def test_mesh_does_not_know_the_unit_of_length() -> None:
    """A drive 1000 times as large has the same triangles and 1000 times the coordinates."""
    large = Cycloid(20, 19, 80.0, 5.0, 2.5)
    one, two = mesh_outline(DISC), mesh_outline(disc_outline(large, 25.0, 8, 52.0, 10.0, 0.0, 12))
    np.testing.assert_array_equal(one.triangles, two.triangles)
    np.testing.assert_allclose(two.points, 1e3 * one.points, atol=1e-8)


@pytest.mark.exact
def test_sides_are_named_stretches_of_a_loop() -> None:
    """The sides of the block share out all its facets; the top's nodes have y = 0."""
    mesh = mesh_outline(block())
    counts = [mesh.edges[side].shape[1] for side in ("bottom", "right", "top", "left")]
    assert sum(counts) == mesh.edges["block"].shape[1]
    np.testing.assert_allclose(mesh.points[mesh.edges["top"]][..., 1], 0.0, atol=1e-17)
    np.testing.assert_allclose(mesh.points[mesh.edges["left"]][..., 0], -0.1, atol=1e-17)


@pytest.mark.property
def test_no_triangle_has_two_facets() -> None:
    """On a smooth boundary such a triangle would have an angle of 180° between them."""
    for outline in OUTLINES.values():
        mesh = mesh_outline(outline)
        facets = np.concatenate([mesh.edges[loop.name][2] for loop in outline.loops])
        assert np.isin(mesh.triangles[3:], facets).sum(axis=0).max() == 1


@pytest.mark.exact
def test_folded_elements_are_refused_by_the_name_of_their_loop() -> None:
    """Twelve facets round a thin ring bulge through its wall; the message says which loops want more."""
    ring = Outline(Loop("rim", SPOT, 12), (Loop("bore", Circle((0.0, 0.0), 0.95, True), 12),))
    with pytest.raises(TrochoidError, match=r"fold, first at .* give more facets to rim, bore"):
        mesh_outline(ring)


def ring_of(*holes: Circle) -> Outline:
    loops = (Loop(f"hole{i}", hole, 24) for i, hole in enumerate(holes))
    return Outline(Loop("rim", SPOT, 48), tuple(loops))


@pytest.mark.exact
@pytest.mark.parametrize(
    ("holes", "message"),
    [
        ((Circle((0.1, 0.0), 0.2, True), Circle((0.3, 0.0), 0.2, True)), "facets of the outline cross near"),
        ((Circle((0.9, 0.0), 0.2, True),), "facets of the outline cross near"),
        ((Circle((3.0, 0.0), 0.2, True),), "all holes must lie inside"),
        ((Circle((0.0, 0.0), 0.5, True), Circle((0.0, 0.0), 0.2, True)), "none in another"),
        (
            (Circle((0.0, 0.0), 0.5, True), Circle((0.0, 0.0), 0.5, True)),
            "facet ends of the outline coincide",
        ),
    ],
)
def test_outlines_that_are_none_are_refused(holes: tuple[Circle, ...], message: str) -> None:
    """Crossing, outside, nested, doubled holes; without the check gmsh does not return from some of them."""
    with pytest.raises(TrochoidError, match=message):
        mesh_outline(ring_of(*holes))


@pytest.mark.exact
def test_clockwise_loops_are_refused() -> None:
    """A square the wrong way round."""
    with pytest.raises(TrochoidError, match="runs clockwise"):
        mesh_outline(Outline(Loop("square", polygon([[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]), 12)))


@pytest.mark.property
def test_collinear_and_touching_sides_do_not_cross() -> None:
    """Sides on one line, as a block's, pass; a spike through a circle is found wherever it is."""
    rng = np.random.default_rng(3)
    angle = np.linspace(0.0, 2.0 * math.pi, 200, endpoint=False)
    rim = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    square = polygon([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    fail_if_crossing([rim, square.point(Loop("square", square, 80).parameters()[:-1])])
    for _ in range(20):
        at = rng.uniform(0.0, 2.0 * math.pi)
        spike = np.array([[0.9, -0.01], [1.1, 0.0], [0.9, 0.01]]) @ np.array(
            [[math.cos(at), math.sin(at)], [-math.sin(at), math.cos(at)]]
        )
        with pytest.raises(TrochoidError, match="cross near"):
            fail_if_crossing([rim, spike])


@pytest.mark.exact
def test_loops_need_different_names() -> None:
    """Otherwise one would hide the other."""
    with pytest.raises(TrochoidError, match="different names"):
        mesh_outline(Outline(Loop("a", SPOT, 12), (Loop("a", Circle((0.0, 0.0), 0.5, True), 12),)))


@pytest.mark.exact
def test_gmsh_is_silent_and_finalised_even_after_a_failure(capfd: pytest.CaptureFixture[str]) -> None:
    """A failure inside leaves no session, prints nothing, keeps Python's Ctrl-C; the next mesh works."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    opened = []

    def fail() -> None:
        with gmsh_session() as gmsh:
            opened.append((gmsh.isInitialized(), signal.getsignal(signal.SIGINT)))
            gmsh.open("/no/such/file.geo")

    with pytest.raises(Exception, match="no/such/file"):
        fail()
    assert opened == [(1, signal.default_int_handler)]
    mesh_outline(block())
    assert capfd.readouterr() == ("", "")
    assert signal.signal(signal.SIGINT, before) is signal.default_int_handler


@pytest.mark.exact
def test_a_gmsh_session_of_the_caller_is_not_ended() -> None:
    """A script that uses gmsh itself is told, and its session survives."""
    import gmsh

    gmsh.initialize(interruptible=False)
    try:
        with pytest.raises(TrochoidError, match="already initialised"):
            mesh_outline(block())
        assert gmsh.isInitialized()
    finally:
        gmsh.finalize()


@pytest.mark.exact
def test_only_meshing_loads_gmsh_and_kinematics_loads_numpy_alone() -> None:
    """Issue 2: asking for a ratio must not load gmsh, scipy or scikit-fem."""
    code = (
        "import sys, trochoid.kinematics.meshing, trochoid.kinematics.motion, trochoid.kinematics.path;"
        "import trochoid.geometry.mass, trochoid.geometry.disc, trochoid.geometry.mesh;"
        "loaded = {'gmsh', 'scipy', 'skfem', 'pydantic', 'pyvista'} & set(sys.modules);"
        "assert not loaded, loaded"
    )
    subprocess.run([sys.executable, "-c", code], check=True)

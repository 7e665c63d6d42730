"""A bearing ring pressed into its housing: one body, against a ring of both thicknesses, and in the stiff limit."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from trochoid.fem.bearing import RollerBearing
from trochoid.fem.body import build_body
from trochoid.fem.material import Material, Plane
from trochoid.fem.seat import STEEL, FlexibleSeat, seat_compliance, seat_of
from trochoid.fem.seat_equilibrium import solve_seated
from trochoid.fem.seat_error import rigid_ring_error
from trochoid.fem.seat_joined import Layer, pressed_body
from trochoid.fem.seat_ring import ring_outline
from trochoid.geometry.mesh import Mesh, mesh_outline
from trochoid.geometry.outline import Loop, Outline
from trochoid.kinematics.curve import Circle
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array

BORE, RING, WALL, WIDTH, FACETS = 25e-3, 4e-3, 6e-3, 12e-3, 80  # m
BEARING = RollerBearing(rollers=16, roller_radius=3e-3, pitch_radius=22e-3, length=10e-3)
LOAD = np.array([1000.0, -5000.0])
PLANE = STEEL.plane("stress")
CENTER = (0.0, 0.0)


@lru_cache
def _ring(facets: int = FACETS) -> tuple[Mesh, Loop]:
    bore = Loop("bore", Circle(CENTER, BORE, hole=True), facets)
    return mesh_outline(Outline(Loop("fit", Circle(CENTER, BORE + RING), facets), (bore,))), bore


@lru_cache
def _housing(facets: int = FACETS) -> Mesh:
    fit = Loop("fit", Circle(CENTER, BORE + RING, hole=True), facets)
    return mesh_outline(Outline(Loop("outer", Circle(CENTER, BORE + RING + WALL), facets), (fit,)))


def _joined(housing: Plane, width: float = WIDTH, facets: int = FACETS) -> FlexibleSeat:
    mesh, bore = _ring(facets)
    parts = Layer(mesh, PLANE, WIDTH), Layer(_housing(facets), housing, width)
    return seat_of(pressed_body(*parts, "fit", ("outer",)), bore, WIDTH)


def _matrix(seat: FlexibleSeat) -> Array:
    return seat_compliance(BEARING, seat, 5000.0)


@pytest.mark.independent
def test_like_materials_are_one_thick_ring() -> None:
    """Steel ring in a steel housing of its width: a ring as thick as both, meshed as one."""
    outline = ring_outline(BORE, RING + WALL, FACETS)
    whole = seat_of(build_body(mesh_outline(outline), PLANE, ("outer",)), outline.holes[0], WIDTH)
    one, two = _matrix(_joined(PLANE)), _matrix(whole)
    assert one == pytest.approx(two, abs=5e-4 * np.ptp(two))
    seated = [solve_seated(BEARING, m, LOAD).stiffness for m in (one, two)]
    assert seated[0] == pytest.approx(seated[1], rel=2e-3, abs=2e-3 * seated[1][0, 0])


@pytest.mark.exact
def test_stiff_housing_holds_the_ring_at_its_edge() -> None:
    """The housing's modulus × 10³ and × 10⁴: the ring held at its outer edge, and what is left falls with 1/E."""
    mesh, bore = _ring()
    held = _matrix(seat_of(build_body(mesh, PLANE, ("fit",)), bore, WIDTH))
    scale = float(np.ptp(held))
    one, two, limit = (_matrix(_joined(Material(e, 0.3).plane("stress"))) for e in (210e12, 210e13, 210e16))
    # patches of the held ring stay off its edge, those of the pressed one reach it: the same to the mesh's error
    assert limit == pytest.approx(held, abs=2e-3 * scale)
    assert np.abs(one - limit).max() / np.abs(two - limit).max() == pytest.approx(10.0, rel=0.05)


@pytest.mark.property
def test_width_and_modulus_are_one_in_plane_stress() -> None:
    """A housing twice as wide is one of twice the modulus at the same Poisson's ratio."""
    double = Material(2 * STEEL.youngs_modulus, STEEL.poissons_ratio).plane("stress")
    assert _matrix(_joined(PLANE, 2 * WIDTH)) == pytest.approx(_matrix(_joined(double)), rel=1e-9)


@pytest.mark.property
def test_softer_housing_yields_more() -> None:
    """Aluminium under a steel ring: more compliance in every mode of the rollers."""
    soft, hard = _matrix(_joined(Material(70e9, 0.3).plane("stress"))), _matrix(_joined(PLANE))
    assert np.linalg.eigvalsh(soft - hard).min() > 0.0


@pytest.mark.property
def test_number_with_its_error() -> None:
    """Steel ring in aluminium: the rigid ring is too stiff, and twice the facets stay within the error."""
    light = Material(70e9, 0.33).plane("stress")
    one, two = (
        rigid_ring_error(BEARING, lambda n: _joined(light, 20e-3, n), facets, LOAD) for facets in (128, 256)
    )
    assert one.stiffness.value > 1.0
    assert abs(one.stiffness.value - two.stiffness.value) <= one.stiffness.error
    assert one.stiffness.error < 5e-3


@pytest.mark.exact
def test_mesh_is_numbered_as_any_other() -> None:
    """Vertices before mid nodes, each side's mid node in its middle, areas of both, and named edges of both."""
    mesh, _ = _ring()
    body = pressed_body(Layer(mesh, PLANE, WIDTH), Layer(_housing(), PLANE, WIDTH), "fit", ("outer",))
    whole = body.mesh
    assert whole.triangles[3:].min() == whole.vertices
    assert len(np.unique(whole.triangles)) == len(whole.points)
    assert set(whole.edges) == {"bore", "fit", "outer"}
    assert body.parts.weight.sum() == pytest.approx(np.pi * ((BORE + RING + WALL) ** 2 - BORE**2), rel=1e-6)
    radius = np.linalg.norm(whole.points[whole.edges["fit"]], axis=-1)
    assert radius == pytest.approx(BORE + RING, rel=1e-12)
    assert (body.neighbours >= 0).sum() == body.neighbours.size - 2 * FACETS


@pytest.mark.exact
def test_what_cannot_be_joined_is_refused() -> None:
    """Other facets, no fit, nothing held, two edges of one name, no width."""
    mesh, _ = _ring()
    layer = Layer(mesh, PLANE, WIDTH)
    with pytest.raises(Infeasible, match="80 and 40 facets"):
        pressed_body(layer, Layer(_housing(40), PLANE, WIDTH), "fit", ("outer",))
    rim = mesh_outline(Outline(Loop("rim", Circle(CENTER, 0.1), 24)))
    with pytest.raises(TrochoidError, match='the housing has no edge "fit"; it has rim'):
        pressed_body(layer, Layer(rim, PLANE, WIDTH), "fit", ("rim",))
    with pytest.raises(TrochoidError, match="name the edges that hold"):
        pressed_body(layer, Layer(_housing(), PLANE, WIDTH), "fit", ())
    with pytest.raises(TrochoidError, match="both have an edge bore"):
        pressed_body(layer, layer, "fit", ("bore",))
    with pytest.raises(Infeasible, match="widths must be positive"):
        pressed_body(layer, Layer(_housing(), PLANE, 0.0), "fit", ("outer",))

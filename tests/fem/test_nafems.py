"""NAFEMS R0094 case 1 with two finite-element bodies, and with a pressure that the mesh resolves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest

from trochoid.fem.body import Body, build_body
from trochoid.fem.complementarity import Group, Problem, Solution, solve
from trochoid.fem.compliance import Compliance, press, surface_weights
from trochoid.fem.laws import HertzLine
from trochoid.fem.material import Material, Plane
from trochoid.fem.strips import REACH, STRIPS, strip_centres, strip_compliance
from trochoid.geometry.mesh import mesh_outline
from trochoid.geometry.outline import Loop, Outline, graded_breaks
from trochoid.kinematics.curve import ArcLength, Curve
from trochoid.kinematics.path import Path, Piece, polygon
from trochoid.kinematics.types import Array

RADIUS, LOAD = 0.05, 35e6  # m, N/m
HALF_WIDTH, PEAK = 6.2146e-3, 3585.37e6
STEEL, SOFT = Material(210e9, 0.3).plane("strain"), Material(70e9, 0.3).plane("strain")


@dataclass(frozen=True)
class Pressed:
    """A held body and its compliance; it is pressed at the parameter `focus` of its curve."""

    body: Body
    compliance: Compliance
    curve: Curve
    focus: float

    @property
    def smooth(self) -> float:
        """S(x, x) at the contact, 1/Pa."""
        place = ArcLength(self.curve).length(np.array([self.focus]))
        weights = surface_weights(self.compliance.surfaces["surface"], place)
        return float(self.compliance.smooth(weights, self.curve.point(np.array([self.focus])))[0, 0])


def _pressed(curve: Curve, focus: float, held: tuple[float, float], plane: Plane, facet: float) -> Pressed:
    breaks = graded_breaks(curve, np.array([focus]), facet, 0.02, width=1.5 * HALF_WIDTH)
    loop = Loop("surface", curve, breaks=breaks, sides={"held": held})
    body = build_body(mesh_outline(Outline(loop)), plane, ("held",))
    return Pressed(body, press(body, [loop]), curve, focus)


def _cylinder(facet: float) -> Pressed:
    """Return the lower half of the cylinder, held at its flat top."""
    half = Path((Piece((-RADIUS, 0.0), (RADIUS, 0.0), np.pi), Piece((RADIUS, 0.0), (-RADIUS, 0.0))))
    return _pressed(half, 0.5, (1.0, 2.0), STEEL, facet)


def _block(facet: float) -> Pressed:
    """Return a block of 400 × 200 mm, held at its bottom."""
    return _pressed(
        polygon([(-0.2, -0.25), (0.2, -0.25), (0.2, -0.05), (-0.2, -0.05)]), 2.5, (0.0, 1.0), SOFT, facet
    )


def _contact(cylinder: Pressed, block: Pressed, load: float) -> tuple[Solution, Array, Array]:
    """Press one on the other with strips on their common half-plane kernel and S of both; returns places, pressures."""
    kernel = np.array([STEEL.kernel + SOFT.kernel])
    reach = REACH * HertzLine(kernel, np.array([RADIUS])).half_width(np.array([load]))
    place, width = strip_centres() * reach[0], 2 * reach / STRIPS
    gap = RADIUS - np.sqrt(RADIUS**2 - place**2)
    group = Group(strip_compliance(kernel, width), gap[None], np.ones((1, STRIPS, 1)))
    coupling = np.array([[cylinder.smooth + block.smooth]])
    solution = solve(Problem((group,), coupling, np.zeros((1, 1)), np.array([load])))
    return solution, place, solution.forces[0][0] / width[0]


@pytest.mark.published
def test_nafems_cylinder_and_block_of_finite_elements() -> None:
    """NAFEMS R0094 case 1: a = 6.2146 mm within 0.5 %, p_max = 3585.37 MPa within 0.2 %, on facets of a/3."""
    solution, place, pressure = _contact(_cylinder(2e-3), _block(2e-3), LOAD)
    force = solution.forces[0][0]
    assert pressure.max() == pytest.approx(PEAK, rel=2e-3)
    assert 2 * np.sqrt((force * place**2).sum() / force.sum()) == pytest.approx(HALF_WIDTH, rel=5e-3)


def _resolved_depth(pressed: Pressed, load: float, half_width: float) -> float:
    """Return how deep a Hertz pressure, integrated over the facets of the mesh, presses its own middle in."""
    mesh, x, w = pressed.body.mesh, *np.polynomial.legendre.leggauss(12)
    x = 0.5 * (x + 1)
    shape = np.stack([(1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x)])
    slope = np.stack([4 * x - 3, 4 * x - 1, 4 - 8 * x])
    edge, middle = mesh.edges["surface"], pressed.curve.point(np.array([pressed.focus]))[0]
    into = -pressed.curve.normal(np.array([pressed.focus]))[0]
    nodes = mesh.points[edge]
    place, along = (np.einsum("aq,akc->kqc", f, nodes) for f in (shape, slope))
    share = np.maximum(0.0, 1 - np.sum((place - middle) ** 2, axis=-1) / half_width**2)
    line = 2 * load / (np.pi * half_width) * np.sqrt(share) * np.linalg.norm(along, axis=-1) * 0.5 * w
    right = np.zeros((pressed.body.size // 2, 2))
    np.add.at(right, edge, np.einsum("aq,kq->ak", shape, line)[..., None] * into)
    answer = pressed.body.solve(right.reshape(-1, 1)).reshape(-1, 2)
    return float(answer[edge[0][np.argmin(np.linalg.norm(nodes[0] - middle, axis=-1))]] @ into)


@pytest.mark.independent
@pytest.mark.parametrize("make", [_cylinder, _block])
def test_splitting_agrees_with_a_pressure_that_the_mesh_resolves(make: Callable[[float], Pressed]) -> None:
    """Depth under a Hertz pressure: closed form plus S on facets of a, against facets of a/16 that carry it."""
    coarse, fine = make(2e-3), make(0.125e-3)
    half_width, load = 2e-3, 1e6
    depth = load * (coarse.body.plane.kernel * (np.log(2 / half_width) + 0.5) + coarse.smooth)
    assert depth == pytest.approx(_resolved_depth(fine, load, half_width), rel=5e-4)


@pytest.mark.property
def test_approach_does_not_depend_on_the_mesh() -> None:
    """Facets of 4, 2 and 1 mm at the contact: the approach of the bodies converges, to 1e-4 at 2 mm."""
    found = [float(_contact(_cylinder(h), _block(h), LOAD)[0].motion[0]) for h in (4e-3, 2e-3, 1e-3)]
    assert found[1] == pytest.approx(found[2], rel=1e-4)
    assert found[0] == pytest.approx(found[2], rel=1e-3)

"""A solid body reduced to the motions of its interfaces and a few modes (Craig and Bampton 1968).

interface: nodes that move as one rigid body (a bore's seat, a foot), six coordinates each
u = Ψ q_b + Φ q_m        Ψ: static shapes of the interfaces' motions, exact for loads that stand still
                         Φ: modes with all interfaces held, up to a frequency
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, hstack, identity, kron

from trochoid.fem.linear_solver import Solve, factorise
from trochoid.fem.solid import SolidBody, rigid_motions
from trochoid.fem.solid_interface import Interface, Triple, carried, free_nodes, rigid_of
from trochoid.fem.solid_modes import modes_below
from trochoid.geometry.solid_places import patch
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array, IntArray, frozen

UPPER = 2000.0  # Hz: twice the upper end of the band 10–1000 Hz
MANY = 150  # modes that are enough above the frequency that is needed
LOST = 1e-5  # of an interface's stiffness: what a rigid motion may seem to cost; rounding leaves 1e-10


@dataclass(frozen=True, eq=False, slots=True)
class Reduced:
    """Symmetric `mass` and `stiffness` (n, n) on six coordinates of each interface and the held modes after them.

    `basis` (3p, n) gives the displacements of all p points; `held_frequencies` (n − 6 interfaces,), Hz, are those of
    the modes with all interfaces held, up to `upper` Hz.
    """

    body: SolidBody
    interfaces: tuple[Interface, ...]
    mass: Array
    stiffness: Array
    basis: Array
    held_frequencies: Array
    upper: float

    @property
    def size(self) -> int:
        """Number n of coordinates."""
        return len(self.mass)

    def columns(self, name: str) -> slice:
        """Return the six coordinates of an interface; raises TrochoidError for one that is not there."""
        for i, interface in enumerate(self.interfaces):
            if interface.name == name:
                return slice(6 * i, 6 * i + 6)
        known = ", ".join(interface.name for interface in self.interfaces)
        raise TrochoidError(f"no interface {name!r}; there are {known}")


def reduce(
    body: SolidBody,
    interfaces: Sequence[Interface],
    upper: float = UPPER,
    solver: str | None = None,
    least: float | None = None,
) -> Reduced:
    """Reduce a free body to its interfaces and the modes below `upper` Hz with all of them held.

    With `least` Hz, a body of many modes keeps those up to there and MANY at least, and fewer above.
    Rigid motions cost nothing, to rounding: what the solver leaves is taken out.  Raises Infeasible without
    interfaces, for one of fewer than three nodes or all on a line, and for two that share nodes.
    """
    free = free_nodes(body, interfaces)
    dofs = (3 * free[:, None] + np.arange(3)).ravel()
    held = csc_matrix(body.stiffness[dofs][:, dofs])
    solve = factorise(held, solver)
    shapes = _static_shapes(body, interfaces, dofs, solve)
    hertz, modes, limit = modes_below(spread(body.mass[free][:, free]), solve, upper, least, MANY)
    basis = np.zeros((body.size, shapes.shape[1] + len(hertz)))
    basis[:, : shapes.shape[1]] = shapes
    basis[dofs, shapes.shape[1] :] = modes
    mass, stiffness = _projected(body, interfaces, basis, hertz)
    return Reduced(
        body, tuple(interfaces), frozen(mass), frozen(stiffness), frozen(basis), frozen(hertz), limit
    )


def reading(reduced: Reduced, position: Triple, radius: float | None = None) -> Array:
    """Return the (6, n) map to the displacement and rotation at a point of the surface, as a sensor there reads them.

    It is the rigid motion, carried to the point, that fits the nodes of the surface near it best (`patch`); it holds
    nothing.  Raises TrochoidError when the point is off the body.
    """
    nodes = patch(reduced.body.mesh, position, radius)
    points = reduced.body.mesh.points[nodes]
    size = np.repeat([1.0, float(np.ptp(points, axis=0).max())], 3)
    rigid = rigid_motions(points, np.asarray(position)) / size
    dofs = (3 * nodes[:, None] + np.arange(3)).ravel()
    return frozen(np.linalg.pinv(rigid) @ reduced.basis[dofs] / size[:, None])


def rigid_coordinates(reduced: Reduced, about: Triple = (0.0, 0.0, 0.0)) -> Array:
    """Return the coordinates (n, 6) of unit translations and rotations about a point."""
    return frozen(rigid_of(reduced.interfaces, reduced.size, about))


def interface_stiffness(reduced: Reduced) -> Array:
    """Return the stiffness (6k, 6k) of the interfaces' motions for loads that stand still."""
    size = 6 * len(reduced.interfaces)
    return frozen(reduced.stiffness[:size, :size])


def joined(body: SolidBody, interfaces: Sequence[Interface]) -> csc_matrix:
    """Return the map (3p, 6k + f) from interfaces' coordinates and all other displacements to those of all points."""
    free = free_nodes(body, interfaces)
    dofs = (3 * free[:, None] + np.arange(3)).ravel()
    own = csc_matrix((np.ones(len(dofs)), (dofs, np.arange(len(dofs)))), shape=(body.size, len(dofs)))
    return csc_matrix(hstack([csc_matrix(carried(body, interfaces)), own]))


def spread(mass: csc_matrix) -> csc_matrix:
    """Return the mass matrix (3n, 3n) of one that is the same along each axis."""
    return csc_matrix(kron(mass, identity(3), format="csc"))


def _static_shapes(body: SolidBody, interfaces: Sequence[Interface], dofs: IntArray, solve: Solve) -> Array:
    """Return Ψ (3p, 6k): displacements of all points under unit motions of the interfaces."""
    shapes = carried(body, interfaces)
    shapes[dofs] = -solve((body.stiffness @ shapes)[dofs])
    return shapes


def _projected(
    body: SolidBody, interfaces: Sequence[Interface], basis: Array, hertz: Array
) -> tuple[Array, Array]:
    """Return the mass and stiffness on the basis: what is zero or one for exact shapes is put so."""
    size = 6 * len(interfaces)
    mass = basis.T @ body.weighed(basis)
    mass[size:, size:] = np.eye(len(hertz))
    stiffness = np.zeros_like(mass)
    shapes = basis[:, :size]
    stiffness[:size, :size] = _without_rigid(shapes.T @ (body.stiffness @ shapes), interfaces)
    stiffness[range(size, len(mass)), range(size, len(mass))] = (2.0 * np.pi * hertz) ** 2
    return 0.5 * (mass + mass.T), stiffness


def _without_rigid(stiffness: Array, interfaces: Sequence[Interface]) -> Array:
    """Take out of a stiffness (6k, 6k) what the solver's rounding makes rigid motions cost."""
    rigid = rigid_of(interfaces, len(stiffness), interfaces[0].position)
    unit = 1.0 / np.sqrt(np.diag(stiffness))  # metres and radians on one scale
    scaled = stiffness * np.outer(unit, unit)
    base, _ = np.linalg.qr(rigid / unit[:, None])
    left = scaled - base @ (base.T @ scaled)
    left = left - (left @ base) @ base.T
    lost = float(np.abs(left - scaled).max())
    if lost > LOST:
        raise TrochoidError(
            f"rigid motions of the body strain it, by {lost:.1g} of the stiffness of its interfaces: its matrix is too "
            "ill-conditioned; mesh it without very thin elements"
        )
    return np.asarray(0.5 * (left + left.T) / np.outer(unit, unit))

"""A body of rays whose displacement is a cubic along the rays away from a contact: a third of the unknowns.

A contact's slices need layers; half a thickness away what one slice has more than another has died away (de
Saint-Venant), and a plate bends there as a cubic does (parabolas are 0.5 % too stiff by Poisson's ratio).  Cubics are
taken at the nodes of the layers, so that the space is a part of that of the elements: the body is a little stiffer.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_matrix, diags_array, hstack, kron

from trochoid.fem.cone_body import ConeBody
from trochoid.fem.linear_solver import Solve, factorise, installed
from trochoid.kinematics.types import Array, BoolArray

DEGREE = 3


def smoothed(body: ConeBody, near: BoolArray, solver: str | None = None) -> tuple[Solve, int]:
    """Factor a body, cubic along the rays at those nodes (n,) of its plane mesh that are not `near`.

    Returns the function that solves for columns (free, k), as `cone_body.factored` does, and the number of unknowns.
    Nodes are held over all of the thickness or not at all.
    """
    basis = _basis(body, near)
    reduced = csc_matrix(basis.T @ body.stiffness @ basis)
    if solver is None and "pardiso" in installed():
        solver = "pardiso"
    solve, free = factorise(reduced, solver), basis[np.flatnonzero(~body.held)]
    back = free.T.tocsr()

    def solved(columns: Array) -> Array:
        return np.asarray(free @ solve(np.asfortranarray(back @ columns)))

    return solved, int(reduced.shape[0])


def _basis(body: ConeBody, near: BoolArray) -> csc_matrix:
    """Return what turns the unknowns into all degrees of freedom, held ones zero."""
    rho = body.radial.nodes
    across = 2.0 * (rho - rho[0]) / (rho[-1] - rho[0]) - 1.0
    cubic = np.polynomial.legendre.legvander(across, min(DEGREE, len(rho) - 1))
    moving = ~body.held.reshape(-1, len(rho))[:, 0]
    every = np.repeat(near, 3) & moving
    few = ~np.repeat(near, 3) & moving

    def columns(chosen: BoolArray, radial: Array) -> csc_matrix:
        picked = csc_matrix(diags_array(chosen.astype(np.float64)))[:, np.flatnonzero(chosen)]
        return csc_matrix(kron(picked, csc_matrix(radial), format="csc"))

    one, other = columns(every, np.eye(len(rho))), columns(few, cubic)
    joined = hstack([one, other], format="csc")
    order = np.argsort(joined.indices[joined.indptr[:-1]], kind="stable")
    return csc_matrix(joined[:, order])

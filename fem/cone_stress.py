"""Stress of a body of rays from its displacement, at all nodes.

Strains are most accurate at few points inside an element: three across it and two along it.  What they are there is
continued linearly to the nodes, and averaged over the elements that meet in one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from trochoid.fem.cone_body import ConeBody
from trochoid.fem.cone_stiffness import shapes
from trochoid.kinematics.spherical import rotation
from trochoid.kinematics.types import Array

_ACROSS = np.array([[1 / 6, 1 / 6], [2 / 3, 1 / 6], [1 / 6, 2 / 3]])
_ALONG = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)
_CORNERS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.5, 0.5, 0], [0, 0.5, 0.5], [0.5, 0, 0.5]])
_VOIGT = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


@dataclass(frozen=True, eq=False, slots=True)
class StressRule:
    """What turns displacements into stress: `along`, `across` (m, 3 places, 6 nodes, 3) are N A and B of the gradient.

    `value`, `slope` (layers, 2 places, 3 nodes) are L/ρ and L'; `plane` (n, 3m) and `radial` (layer nodes, 2 layers)
    bring the places' values to the nodes.
    """

    body: ConeBody
    along: Array
    across: Array
    value: Array
    slope: Array
    plane: csr_matrix
    radial: Array


def stress_rule(body: ConeBody) -> StressRule:
    """Prepare the stress of a body."""
    mesh = body.mesh
    value, by_x, by_y = shapes(_ACROSS)
    node = mesh.points[mesh.triangles]
    f, fx, fy = (np.einsum("aq,amc->mqc", s, node) for s in (value, by_x, by_y))
    volume = np.sum(f * np.cross(fx, fy), axis=-1)[..., None]
    dual = [np.cross(u, v) / volume for u, v in ((fx, fy), (fy, f), (f, fx))]
    across = np.einsum("aq,mqc->mqac", by_x, dual[1]) + np.einsum("aq,mqc->mqac", by_y, dual[2])
    along = np.einsum("aq,mqc->mqac", value, dual[0])
    low, length = body.radial.breaks[:-1, None, None], np.diff(body.radial.breaks)[:, None, None]
    x = _ALONG[:, None]
    line = np.concatenate([(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)], axis=1)
    steep = np.concatenate([4 * x - 3, 4 - 8 * x, 4 * x - 1], axis=1)
    return StressRule(
        body, along, across, line / (low + length * x), steep / length, _averages(body), _radial(body)
    )


def nodal_stress(rule: StressRule, moved: Array) -> Array:
    """Return the stress (n, layer nodes, 6), Pa, xx yy zz xy yz xz, under displacements (n, layer nodes, 3), m."""
    material = rule.body.material
    shear = material.youngs_modulus / (2.0 * (1.0 + material.poissons_ratio))
    lame = 2.0 * shear * material.poissons_ratio / (1.0 - 2.0 * material.poissons_ratio)
    layers = len(rule.value)
    index = 2 * np.arange(layers)[:, None] + np.arange(3)
    u = moved[rule.body.mesh.triangles][:, :, index]  # (6, m, layers, 3 nodes, 3)
    plain = np.einsum("lsk,amlki->amlsi", rule.value, u, optimize=True)
    steep = np.einsum("lsk,amlki->amlsi", rule.slope, u, optimize=True)
    slope = np.einsum("mqaj,amlsi->mqlsij", rule.across, plain, optimize=True)
    slope += np.einsum("mqaj,amlsi->mqlsij", rule.along, steep, optimize=True)
    trace = lame * np.trace(slope, axis1=-2, axis2=-1)
    stress = np.stack([shear * (slope[..., i, j] + slope[..., j, i]) for i, j in _VOIGT], axis=-1)
    stress[..., :3] += trace[..., None]
    places, plane = 2 * layers, rule.plane
    flat = stress.reshape(plane.shape[1], places * 6)
    nodal = np.asarray(plane @ flat).reshape(plane.shape[0], places, 6)
    return np.asarray(np.einsum("rp,npc->nrc", rule.radial, nodal, optimize=True))


def joined_at_cuts(body: ConeBody, pitch: float, stress: Array) -> Array:
    """Average the stress (teeth, n, layer nodes, 6) of neighbours along their cuts; each in the frame of its tooth."""
    left, right = body.mesh.nodes("left"), body.mesh.nodes("right")
    turned = _turned(np.roll(stress, 1, axis=0)[:, right], rotation(2, -pitch))
    found = stress.copy()
    found[:, left] = 0.5 * (stress[:, left] + turned)
    found[:, right] = _turned(np.roll(found[:, left], -1, axis=0), rotation(2, pitch))
    return found


def von_mises(stress: Array) -> Array:
    """Return the equivalent stress (...) of stresses (..., 6)."""
    xx, yy, zz, xy, yz, xz = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + xz**2)))


def _turned(stress: Array, matrix: Array) -> Array:
    """Return stresses (..., 6) turned by a rotation."""
    full = np.empty((*stress.shape[:-1], 3, 3))
    for k, (i, j) in enumerate(_VOIGT):
        full[..., i, j] = full[..., j, i] = stress[..., k]
    full = matrix @ full @ matrix.T
    return np.stack([full[..., i, j] for i, j in _VOIGT], axis=-1)


def _averages(body: ConeBody) -> csr_matrix:
    """Return the means (n, 3m) of what elements' places say at their nodes."""
    triangles = body.mesh.triangles
    count = triangles.shape[1]
    weight = np.broadcast_to(2.0 * _CORNERS - 1.0 / 3.0, (count, 6, 3))  # 1 at its own place, 0 at the others
    rows = np.broadcast_to(triangles.T[:, :, None], weight.shape)
    columns = np.broadcast_to(3 * np.arange(count)[:, None, None] + np.arange(3), weight.shape)
    size = (len(body.mesh.points), 3 * count)
    total = csr_matrix((weight.ravel(), (rows.ravel(), columns.ravel())), shape=size)
    meeting = np.bincount(triangles.ravel(), minlength=size[0])
    return csr_matrix(total.multiply(1.0 / meeting[:, None]))


def _radial(body: ConeBody) -> Array:
    """Return the means (layer nodes, 2 layers) of what layers' places say at their nodes."""
    layers = len(body.radial.breaks) - 1
    found = np.zeros((body.radial.count, 2 * layers))
    for k, x in enumerate((0.0, 0.5, 1.0)):
        share = (x - _ALONG[::-1]) / (_ALONG - _ALONG[::-1])
        for s in (0, 1):
            found[2 * np.arange(layers) + k, 2 * np.arange(layers) + s] = share[s]
    found[2 : 2 * layers : 2] *= 0.5
    return found

"""A conical roller as an elastic body of its own: a cone with a bore that its pin holds, pressed along one ray."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csc_matrix

from trochoid.fem.cone_assembly import Roller
from trochoid.fem.cone_body import cone_body, factored, product, read
from trochoid.fem.cone_flank import SPREAD, flank, load_at
from trochoid.fem.cone_layers import Layers, integrals
from trochoid.fem.cone_sharp import sharpened
from trochoid.fem.cone_slices import Slices, finer
from trochoid.fem.material import Material
from trochoid.geometry.sphere_mesh import mesh_sphere
from trochoid.geometry.sphere_outline import roller_outline
from trochoid.kinematics.spherical_curve import SmallCircle


def closed_form_roller(material: Material) -> Roller:
    """Return solid rollers that lean on their far side, in closed form."""
    return Roller(material.plane("strain").kernel, material.poissons_ratio)


def press_roller(
    layers: Slices,
    angles: tuple[float, float],
    material: Material,
    facets: int = 24,
    parts: int = 1,
    spot: float = 0.0,
) -> Roller:
    """Return a roller of half angle angles[0] on a pin of half angle angles[1] (rad), as long as the layers together.

    The pin is rigid.  Contacts have slices of a layer's `parts` and of `spot` (m), as the rim's.
    """
    angle, bore = angles
    radial = Layers(np.append(layers.inner, layers.outer[-1]))
    mesh = mesh_sphere(roller_outline(angle, facets, bore))
    body = cone_body(mesh, radial, material)
    side = flank(mesh, SmallCircle((1.0, 0.0, 0.0), angle), spread=SPREAD)
    center, half = float(side.centers[0]), float(side.half_width[0])
    plane = sum((load_at(side, center - k * side.length, half) for k in (-1, 1)), load_at(side, center, half))
    weights = integrals(radial)
    loads = product(csc_matrix(plane), weights / weights.sum(axis=0))
    inner = np.flatnonzero(~body.held)
    own, _ = read(factored(body, ~body.held), loads[inner], csc_matrix((len(inner), 0)))
    kernel = material.plane("strain").kernel
    ends, width = (float(layers.inner[0]), float(layers.outer[-1])), np.array([half])
    fine = finer(layers, parts, spot)
    own = sharpened(own[None], width, layers, fine, ends, kernel)[0]
    return Roller(kernel, material.poissons_ratio, own, ends, half * fine.middle)

"""State of a body under contacts against the disc squeezed across a diameter, in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fem.cases import RADIUS, STEEL, free_disc_green, on_circle, round_disc
from trochoid.fem import flamant
from trochoid.fem.hertz import von_mises
from trochoid.fem.stress import Press, basis, sample, solve_state
from trochoid.fem.stress_field import stress_field
from trochoid.kinematics.types import Array

LOAD, HALF_WIDTH = 1e6, 0.5e-3  # N/m, m
PEAK = 2 * LOAD / (np.pi * HALF_WIDTH)
CENTRE = np.full((1, 2), 1 / 3)


def _squeezed(angle: float, half_width: float = HALF_WIDTH) -> tuple[Press, Press]:
    """Return two opposite contacts."""
    places = np.array([angle, angle + np.pi])
    return tuple(  # type: ignore[return-value]
        Press("rim", float(t), n, LOAD, half_width)
        for t, n in zip(places, on_circle(1.0, places), strict=True)
    )


def _exact(points: Array, angle: float) -> Array:
    """Return the stress (n, 3): two Flamant fields and a uniform tension P/(πR) (Timoshenko & Goodier, art. 41)."""
    end = on_circle(RADIUS, np.array([angle, angle + np.pi]))
    total = sum(flamant.stress(points - e, -LOAD * e / RADIUS) for e in end)
    return np.asarray(total + LOAD / (np.pi * RADIUS) * np.array([1.0, 1.0, 0.0]))


@pytest.mark.exact
@pytest.mark.parametrize("angle", [0.0, 0.4, 1.234])
def test_disc_squeezed_across_a_diameter(angle: float) -> None:
    """Stress at the middle of every element farther than 20 a from the contacts, to 2 % of that at the centre."""
    body = round_disc(48)[0]
    state = solve_state(body, _squeezed(angle))
    elements = np.arange(body.mesh.triangles.shape[1])
    points, _, stress = (
        a[:, 0] for a in sample(state, elements, np.broadcast_to(basis(CENTRE), (len(elements), 1, 6)))
    )
    ends = on_circle(RADIUS, np.array([angle, angle + np.pi]))
    far = np.linalg.norm(points[:, None] - ends, axis=-1).min(axis=1) > 20 * HALF_WIDTH
    error = np.abs(stress - _exact(points, angle))[far]
    assert far.sum() > 0.5 * len(far)
    assert error.max() < 0.02 * 3 * LOAD / (np.pi * RADIUS)


@pytest.mark.published
def test_stress_at_the_centre() -> None:
    """Timoshenko & Goodier (art. 41): −6P/(πd) along the loads, 2P/(πd) across, at the centre of the disc."""
    body = round_disc(48)[0]
    state = solve_state(body, _squeezed(0.0))
    corners = body.mesh.points[body.mesh.triangles[:3].T]
    edges = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=-1)
    solved = np.linalg.solve(edges, -corners[:, 0][..., None])[..., 0]
    place = np.asarray(solved, dtype=np.float64)  # of the origin, in each triangle's own axes
    element = np.flatnonzero((place > -1e-12).all(axis=1) & (place.sum(axis=1) < 1 + 1e-12))[:1]
    points, _, stress = sample(state, element, basis(place[element])[:, None])
    assert points == pytest.approx(np.zeros((1, 1, 2)), abs=1e-12)
    expected = LOAD / (np.pi * RADIUS) * np.array([-3.0, 1.0, 0.0])
    assert stress[0, 0] == pytest.approx(expected, abs=0.02 * np.abs(expected).max())


@pytest.mark.published
def test_largest_stress_is_that_of_hertz_below_the_surface() -> None:
    """ν = 0.3, plane strain: 0.558 p0 at 0.70 a below the contact (Johnson 4.4); what is round it adds under 2 %."""
    field = stress_field(round_disc(48)[0], _squeezed(0.4))
    assert field.von_mises_peak.value == pytest.approx(0.558 * PEAK, rel=0.02)
    ends = on_circle(RADIUS, np.array([0.4, 0.4 + np.pi]))
    depth = float(np.linalg.norm(field.von_mises_peak.place - ends, axis=-1).min())
    assert depth == pytest.approx(0.70 * HALF_WIDTH, abs=0.3 * HALF_WIDTH)
    assert float(von_mises(field.stress[:, [0, 1, 3]], STEEL).max()) >= field.von_mises_peak.value * (
        1 - 1e-12
    )


@pytest.mark.exact
def test_displacement_is_that_of_the_compliance() -> None:
    """Rim points a quarter turn from two loads move outwards by the closed form of a free disc."""
    body = round_disc(48)[0]
    field = stress_field(body, _squeezed(0.0))
    where = int(np.argmin(np.linalg.norm(field.points[: len(body.mesh.points)] - [0.0, RADIUS], axis=1)))
    angle = float(np.arctan2(*field.points[where][::-1]))
    inward = LOAD * (
        free_disc_green(STEEL, np.array([angle])) + free_disc_green(STEEL, np.array([angle - np.pi]))
    )
    moved = -float(field.displacement[where] @ field.points[where]) / RADIUS
    assert moved == pytest.approx(float(inward[0]), abs=2e-4 * LOAD * STEEL.kernel)


@pytest.mark.property
def test_stress_does_not_depend_on_the_facet_that_is_pressed() -> None:
    """Pressed at a mid node, near a corner, at a corner: the largest stress stays within half a per cent."""
    body = round_disc(48)[0]
    turn = 2 * np.pi / 48
    found = [
        stress_field(body, _squeezed(turn * share)).von_mises_peak.value for share in (0.5, 0.25, 0.02, 0.0)
    ]
    assert np.ptp(found) < 5e-3 * found[0]


@pytest.mark.exact
def test_no_load_no_stress() -> None:
    """Contacts that carry nothing leave the body at rest."""
    presses = [Press("rim", 0.3, np.array([np.cos(0.3), np.sin(0.3)]), 0.0, 0.0)]
    field = stress_field(round_disc(24)[0], presses)
    assert not field.stress.any()
    assert not field.displacement.any()
    assert field.von_mises_peak.value == 0.0

"""The answer stress_max of the RV drive: in the fields where it says, Hertz below contacts, fillets of teeth."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from tests.drives.rv_cases import drive, level_of, part, whole
from trochoid.drives.rv.field import DiscStress, disc_stresses
from trochoid.drives.rv.picture import stress_film
from trochoid.drives.rv.series import solve_at
from trochoid.drives.rv.teeth import nominal_tooth_force, root_stress, teeth


@lru_cache(maxsize=1)
def stresses() -> tuple[DiscStress, ...]:
    made = drive()
    return disc_stresses(made, "level0", level_of(made, 8), 0.3)


@pytest.mark.property
def test_answer_is_in_the_fields() -> None:
    """Largest value of the files, at the node and on the disc that the answer names; bores lie round the orbits."""
    at = whole()
    ((angle, bodies),) = stress_film(at.stages).frames
    assert angle == pytest.approx(np.radians(200))
    for name in ("von_mises", "max_shear"):
        body = bodies[int(part(at.stress_max, name, "disc")) - 1]
        values = body.point_data[name]
        node = int(np.argmax(np.where(np.isin(np.arange(len(values)), body.cells), values, 0.0)))
        assert part(at.stress_max, name, "stress") == pytest.approx(1e-6 * values[node], rel=1e-12)
        place = [part(at.stress_max, name, "x"), part(at.stress_max, name, "y")]
        assert place == pytest.approx(list(1e3 * body.points[node, :2]), rel=1e-9)
        assert max(b.point_data[name][np.unique(b.cells)].max() for b in bodies) == values[node]
    drawn = at.stages.design
    for i, body in enumerate(bodies):  # discs lie where they orbit
        turn = float(drawn.speeds.members["planet"]) * angle + drawn.discs[i].crank
        middle = 1.3e-3 * np.array([np.cos(turn), np.sin(turn)])
        bore = np.linalg.norm(body.points[:, :2] - middle, axis=1).min()
        assert bore == pytest.approx(12e-3, rel=1e-9)


@pytest.mark.published
def test_stress_is_that_of_hertz_below_the_hardest_contact() -> None:
    """0.300 p0 at 0.786 a and 0.558 p0 at 0.70 a (Johnson 4.4) of the hardest contact; the disc adds 4 %."""
    made = drive()
    contact = solve_at(made, "level0", level_of(made, 8), 0.3)
    width = made.drive.cycloid.face_width
    hard = max(contact.touches.values(), key=lambda touch: float(touch.peak.max()))
    peak, half = float(hard.peak.max()) / width, float(hard.half_width[hard.peak.argmax()])
    fields_of = [disc.state.field for disc in stresses()]
    shear = max((f.max_shear_peak for f in fields_of), key=lambda p: p.value)
    mises = max((f.von_mises_peak for f in fields_of), key=lambda p: p.value)
    for at, share, deep in ((shear, 0.300283, 0.786), (mises, 0.5577, 0.70)):
        assert at.value == pytest.approx(share * peak, rel=0.04)
        assert at.depth == pytest.approx(deep * half, rel=0.06)


@pytest.mark.property
def test_every_edge_has_its_largest_stress() -> None:
    """The largest of all edges is the peak; pins and rollers press flank and crank holes far harder than free edges."""
    for disc in stresses():
        assert set(disc.nearest) == {"flank", "crank_holes", "windows", "bore"}
        assert max(disc.nearest.values()) == disc.state.field.von_mises_peak.value
        loaded = min(disc.nearest["flank"], disc.nearest["crank_holes"])
        assert loaded > 10 * max(disc.nearest["windows"], disc.nearest["bore"]) > 0


@pytest.mark.independent
def test_stress_in_the_fillets_is_about_that_of_form_factors() -> None:
    """ISO 6336-3 with the load at the tip: σ = F_t/(b m) Y_FS, Y_FS of 3.5 to 5.5; less where two pairs share.

    Both wheels feel the same force, so their stresses are of one size.
    """
    made = drive()
    found = teeth(made, 8)
    sun, planet = (float(stress.max()) for stress in root_stress(found))
    stage = made.first
    tangential = nominal_tooth_force(made) * np.cos(float(stage.pair.operating_angle))
    unit = tangential / (made.drive.first_stage.face_width * made.drive.first_stage.module)
    assert 1.5 < sun / unit < 5.5
    assert 1.5 < planet / unit < 5.5
    assert 0.5 < sun / planet < 2.0

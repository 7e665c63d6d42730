"""Compliance tables of gears: symmetry, units, convergence, and against the resolved oracle."""

from __future__ import annotations

import numpy as np
import pytest

from tests.fem.gear_cases import body, teeth_20_30
from tests.geometry.gear_cases import external, pointed
from trochoid.fem.gear_body import GearBody, press_gear
from trochoid.fem.material import Material
from trochoid.fem.surface import read_diagonal, surface_weights
from trochoid.geometry.gear_outline import Blank
from trochoid.kinematics.types import Array

STEEL = Material(210e9, 0.3).plane("strain")
SUN, PLANET, _ = teeth_20_30()


def _flank_smooth(gear: GearBody, count: int = 7) -> Array:
    """Return S(x, x) in units of 2/(πE') along a flank, its ends left out."""
    low, high = gear.flank.ends or (0.0, 1.0)
    s = np.linspace(low, high, count + 2)[1:-1]
    return read_diagonal(gear.compliance.diagonal, surface_weights(gear.flank, s)) / gear.body.plane.kernel


@pytest.mark.property
@pytest.mark.parametrize("held", [True, False])
def test_all_teeth_are_one_tooth_turned(held: bool) -> None:
    """Property: tables are symmetric and repeat from tooth to tooth to the last bit, both hands mirror each other."""
    gear = body(SUN, 10e-3, 6, held=held)
    s, n = gear.compliance.stations, len(gear.flank.positions)
    assert np.array_equal(s, s.T)
    whole = s.reshape(20, 2, n, 20, 2, n)
    turned = np.roll(whole, (1, 1), axis=(0, 3))
    assert np.array_equal(whole, turned)
    back = -np.arange(20) % 20
    assert np.array_equal(whole[back][:, ::-1][:, :, :, back][:, :, :, :, ::-1], whole)
    assert gear.asymmetry < 1e-3  # what the mesh missed of it, before it was made so


@pytest.mark.property
@pytest.mark.parametrize("tooth", [SUN, pointed()], ids=["sun", "pointed"])
def test_forces_on_all_teeth_do_positive_work(tooth: object) -> None:
    """Property: with the logarithm of a contact's width on the diagonal, the compliance of every flank is definite."""
    gear = body(SUN, 10e-3, 6) if tooth is SUN else body(pointed(), 4e-3, 6)
    n, kernel = len(gear.flank.positions), gear.body.plane.kernel
    # one contact per flank, in its middle
    rows = np.arange(n // 2, 2 * n * gear.blank.tooth.gear.teeth, n)
    points = np.stack([_station(gear, int(r)) for r in rows])
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1)
    np.fill_diagonal(apart, 0.5e-4 * np.exp(-0.5))  # ln(2/a) + ½ of a contact of a = 0.1 mm
    total = gear.compliance.stations[np.ix_(rows, rows)] - kernel * np.log(apart)
    assert np.linalg.eigvalsh(total).min() > 0


def _station(gear: GearBody, row: int) -> Array:
    n, curve = len(gear.flank.positions), gear.blank.boundary
    rho = np.sqrt(2 * gear.blank.tooth.gear.base_radius * gear.flank.positions[row % n])
    t = float(curve.parameter(rho))
    tooth, hand = divmod(row // n, 2)
    return curve.point(tooth + (1 - t if hand else t))


@pytest.mark.exact
def test_units_and_modulus_scale_the_compliance() -> None:
    """Exact: in metres or millimetres S differs by (2/πE')·ln 1000; it is in inverse proportion to E."""
    mm = press_gear(Blank(external(20, module=2.0), 10.0), STEEL, 4)
    metres = press_gear(Blank(external(20), 10e-3), STEEL, 4)
    soft = press_gear(Blank(external(20), 10e-3), Material(2.1e9, 0.3).plane("strain"), 4)
    kernel, size = STEEL.kernel, np.ptp(metres.compliance.stations)
    shift = mm.compliance.stations - metres.compliance.stations - kernel * np.log(1e3)
    assert np.abs(shift).max() < 1e-8 * size
    assert np.abs(soft.compliance.stations - 100 * metres.compliance.stations).max() < 1e-8 * 100 * size


@pytest.mark.independent
def test_coarse_teeth_carry_over_what_fine_ones_would() -> None:
    """Independent: level 6 against level 20, own flank and other teeth, in units of 2/(πE'); contacts add about 10."""
    coarse, fine = body(PLANET, 15e-3, 6), body(PLANET, 15e-3, 20)
    assert np.abs(_flank_smooth(coarse) - _flank_smooth(fine)).max() < 0.02
    for tooth in (1, 2, 15):
        ends = []
        for gear in (coarse, fine):
            n = len(gear.flank.positions)
            block = gear.compliance.stations[2 * tooth * n : (2 * tooth + 1) * n, :n] / STEEL.kernel
            s = gear.flank.positions
            ends.append([np.interp(2e-3, s, [np.interp(3e-3, s, row) for row in block])])
        assert abs(ends[0][0] - ends[1][0]) < 5e-3


@pytest.mark.independent
def test_rim_edge_is_tabulated_like_flanks() -> None:
    """Independent: even pressure widens a bore as Lamé's ring between the root's and the tip's; symmetric table."""
    gear = press_gear(Blank(external(20), 10e-3), STEEL, 6, held=False, rim=2)
    table, rim = gear.compliance.stations, gear.compliance.surfaces["rim"]
    assert np.abs(table - table.T).max() < 1e-15 * np.abs(table).max() + 1e-30
    count = len(rim.positions)
    own = table[rim.first :, rim.first :]
    assert np.allclose(np.roll(own, (count // 20, count // 20), axis=(0, 1)), own, rtol=0, atol=1e-25)
    # uniform pressure on the bore (N/m per station): Lamé's expansion, without a rigid part
    angle = rim.positions / gear.blank.rim_radius
    points = gear.blank.rim_radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1)
    width = 2 * np.pi * gear.blank.rim_radius / count
    # the mean of −ln over the station's own arc, and of the kink that S has there
    np.fill_diagonal(apart, 0.5 * width * np.exp(-1.0))
    moved = ((own - STEEL.kernel * np.log(apart)).sum(axis=1)) * width
    assert np.ptp(moved) < 0.02 * moved.mean()
    inner, root, top = gear.blank.rim_radius, 17.5e-3, 22e-3
    expansions = [
        inner / STEEL.modulus * ((o**2 + inner**2) / (o**2 - inner**2) + 0.3 / 0.7) for o in (root, top)
    ]
    assert expansions[1] < moved.mean() < expansions[0]

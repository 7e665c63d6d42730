"""Planets and cranks that go together: against phases of teeth, distances of points, and their own advice."""

import math
import re
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from trochoid.kinematics.assembly import (
    Check,
    coaxial,
    cranks_assemble,
    neighbors_clear,
    planet_places,
    planets_assemble,
    require,
)
from trochoid.kinematics.errors import Infeasible
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_pair import mesh
from trochoid.kinematics.train import planetary_train, rv_train, speeds

HALF = Fraction(1, 2)
TEETH = st.integers(5, 60)


def ring_angle(ring: int, planet: int, place: Fraction, turned: Fraction) -> Fraction:
    """Phase (in pitches) that the ring must have to mesh with a planet turned so at this place (turns)."""
    return (ring * place - planet * (place - turned) - HALF) % 1


def meshing(sun: int, planet: int, place: Fraction) -> list[Fraction]:
    """Angles (turns) at which a planet at this place meshes with a sun that has a tooth at 0."""
    first = sun * place + planet * (place + HALF) - HALF
    return [(first + tooth) / planet for tooth in range(planet)]


def fills(sun: int, planet: int, ring: int, place: Fraction) -> bool:
    """Whether a planet at this place meshes with sun and ring that another one at 0 holds."""
    needed = ring_angle(ring, planet, Fraction(0), meshing(sun, planet, Fraction(0))[0])
    return any(ring_angle(ring, planet, place, turned) == needed for turned in meshing(sun, planet, place))


@pytest.mark.independent
@given(sun=TEETH, planet=TEETH, more=TEETH, planets=st.integers(1, 8))
def test_planets_assemble_by_the_phases_of_their_teeth(
    sun: int, planet: int, more: int, planets: int
) -> None:
    """Each planet in turn: some of its angles meshes with sun and ring at once, or none does."""
    ring = planet + more
    together = all(fills(sun, planet, ring, Fraction(k, planets)) for k in range(planets))
    assert planets_assemble(sun, ring, planets).holds is together
    places = planet_places(sun, ring, planets)
    assert all(fills(sun, planet, ring, place) for place in places)
    off = max(abs(place - Fraction(k, planets)) for k, place in enumerate(places))
    assert off <= Fraction(1, 2 * (sun + ring))
    assert (off == 0) is together


@pytest.mark.independent
@given(sun=TEETH, planet=TEETH, more=TEETH, planets=st.integers(1, 8))
def test_planets_assemble_by_the_turns_of_the_sun(sun: int, planet: int, more: int, planets: int) -> None:
    """The carrier brings the next planet to the same place; the sun must then stand as before, margin included."""
    ring = planet + more
    ratio = speeds(planetary_train(sun, planet, ring), "ring", "sun", "carrier").ratio
    teeth = ratio * sun / planets
    misfit = abs(teeth - round(teeth))
    found = planets_assemble(sun, ring, planets)
    assert found.holds is (misfit == 0)
    assert found.margin == pytest.approx(-float(misfit))


@pytest.mark.independent
@given(sun=TEETH, planet=TEETH, cranks=st.integers(1, 6))
def test_cranks_assemble_by_the_phases_of_their_teeth(sun: int, planet: int, cranks: int) -> None:
    """Parallel eccentrics of equal shafts: one angle must mesh with the sun at every place."""
    angles = [{angle % 1 for angle in meshing(sun, planet, Fraction(k, cranks))} for k in range(cranks)]
    assert cranks_assemble(sun, planet, cranks).holds is bool(set.intersection(*angles))


@pytest.mark.published
def test_example_of_the_2k_v_drive() -> None:
    """Sources §1, 12/36/39/40: two, three, four cranks go together (48 teeth), five do not."""
    assert [cranks_assemble(12, 36, n).holds for n in (2, 3, 4, 5)] == [True, True, True, False]
    assert speeds(rv_train(12, 36, 39, 40), "ring", "sun", "carrier").ratio == 121


@pytest.mark.exact
@given(sun=TEETH, ring=TEETH, planets=st.integers(2, 9))
def test_advice_for_assembly_works(sun: int, ring: int, planets: int) -> None:
    """Numbers of planets and of ring teeth that the sentence names assemble."""
    check = planets_assemble(sun, ring, planets)
    assume(not check.holds)
    near = re.search(r"take ([\d or]+) planets?, or a ring of (\d+) teeth", check.fault)
    assert near
    assert all(planets_assemble(sun, ring, int(n)).holds for n in near[1].split(" or "))
    assert planets_assemble(sun, int(near[2]), planets).holds
    assert abs(int(near[2]) - ring) <= planets / 2 or ring < planets


@pytest.mark.exact
@given(
    count=st.integers(2, 12),
    circle=st.floats(0.01, 0.2),
    share=st.floats(0.05, 1.2),
    gap=st.floats(0.0, 1e-3),
)
def test_neighbors_and_their_advice(count: int, circle: float, share: float, gap: float) -> None:
    """Margin is the distance between the bodies' circles less the clearance; the advised numbers clear."""
    check = neighbors_clear("planets", count, circle, share * circle, gap)
    angle = 2.0 * math.pi * np.arange(2) / count
    points = circle * np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    distance = float(np.linalg.norm(points[1] - points[0]))
    assert check.margin == pytest.approx(distance - 2.0 * share * circle - gap, abs=1e-15)
    assert check.holds is (check.margin > 0.0)
    if check.holds:
        return
    fewer = int(re.findall(r"at most (\d+)", check.fault)[0])
    assert neighbors_clear("planets", fewer, circle, share * circle, gap).holds
    assert not neighbors_clear("planets", fewer + 1, circle, share * circle, gap).holds
    for number in re.findall(r"radius below ([\d.e-]+) mm", check.fault):
        assert neighbors_clear("planets", count, circle, 1e-3 * float(number) * (1 - 1e-5), gap).holds
    wider = 1e-3 * float(re.findall(r"circle radius above ([\d.e-]+) mm", check.fault)[0])
    assert neighbors_clear("planets", count, wider * (1 + 1e-5), share * circle, gap).holds
    assert not neighbors_clear("planets", count, wider * (1 - 1e-5), share * circle, gap).holds


@pytest.mark.published
def test_the_published_set_is_coaxial() -> None:
    """Sources §4: 20/30/80, x = 0.5/0.634/1.768: both meshes stand at 52 mm, to what three digits of x allow."""
    sun, planet = Gear(20, 2e-3, shift=0.5), Gear(30, 2e-3, shift=0.634)
    ring = Gear(80, 2e-3, shift=1.768, internal=True)
    for pair in (mesh(sun, planet), mesh(planet, ring)):
        assert coaxial(pair, 52e-3, tolerance=1e-6).holds
    assert planets_assemble(20, 80, 3).fault.endswith("take 2 or 4 planets, or a ring of 79 teeth")


@pytest.mark.exact
@given(x1=st.floats(-0.3, 0.8), x2=st.floats(0.0, 0.8), internal=st.booleans(), off=st.floats(-5e-4, 1e-3))
def test_coaxiality_and_its_advice(x1: float, x2: float, internal: bool, off: float) -> None:
    """The advised shift or centre distance makes the set coaxial."""
    teeth = 80 if internal else 36
    one, two = Gear(30, 2e-3, shift=x1), Gear(teeth, 2e-3, shift=1.0 + x2, internal=internal)
    assume(abs(abs(off) - 1e-6) > 1e-9)
    pair = mesh(one, two)
    carrier = float(pair.center_distance) + off
    check = coaxial(pair, carrier)
    assert check.holds is (abs(off) <= 1e-6)
    if check.holds:
        return
    shift = re.search(r"nearest shift of the \w+ is ([-\d.e]+), or", check.fault)
    assert shift
    better = Gear(teeth, 2e-3, shift=float(shift[1]), internal=internal)
    assert coaxial(mesh(one, better), carrier).holds
    distance = re.search(r"a centre distance of ([\d.]+) mm", check.fault)
    assert distance
    assert coaxial(pair, 1e-3 * float(distance[1])).holds


@pytest.mark.exact
def test_out_of_reach_and_none() -> None:
    """Without a shift that helps only the distance is advised; no planets at all are refused."""
    pair = mesh(Gear(12, 1.5e-3), Gear(36, 1.5e-3))
    check = coaxial(pair, 30e-3)
    assert "no shift brings them there; take a centre distance of 36 mm" in check.fault
    with pytest.raises(Infeasible, match="0 planets: at least 1 is needed"):
        planets_assemble(20, 80, 0)
    assert neighbors_clear("planets", 1, 0.05, 0.2).margin == math.inf


@pytest.mark.exact
def test_require_names_all_that_fails() -> None:
    """Both sentences, one line each; nothing where all holds."""
    good = Check("a", 1.0, "m")
    require(good)
    with pytest.raises(Infeasible, match=r"5 equal crankshafts .*\n3 planets of radius .* collide"):
        require(good, cranks_assemble(12, 36, 5), neighbors_clear("planets", 3, 0.036, 0.04))


@pytest.mark.exact
@pytest.mark.parametrize("radius", [-67.0, -1.0, 0.0])
def test_bodies_without_a_radius_have_room_for_the_one(radius: float) -> None:
    """Shifts beyond all reason leave a planet without a tip circle; what else is wrong with them is said elsewhere."""
    from trochoid.kinematics.assembly import most_beside

    assert most_beside(52.0, radius) == 1

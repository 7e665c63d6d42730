"""Speeds of any plane gear train from one constraint matrix, exactly.

At the instant when all axes lie on one line, member i moves at the place x of that line with v_i + ω_i x
across it.  A bearing at x and a rolling contact whose pitch point is x both say that two members move alike
there; a parallel crank (or an Oldham or a constant-velocity joint) says that two members turn alike.  These
rows are all there is: speeds do not depend on where on its orbit an arm stands.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType

from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.rational import Row, null_space

FRAME = "frame"


@dataclass(frozen=True, slots=True)
class Pivot:
    """A bearing that joins two members at the place `at` of the line of centres (any unit of length)."""

    a: str
    b: str
    at: Fraction = Fraction(0)


@dataclass(frozen=True, slots=True)
class Rolling:
    """Two pitch circles that roll on each other at the pitch point `at`."""

    a: str
    b: str
    at: Fraction


@dataclass(frozen=True, slots=True)
class EqualTurning:
    """A coupling through which two members turn alike, wherever their axes are."""

    a: str
    b: str


Pair = Pivot | Rolling | EqualTurning


@dataclass(frozen=True, slots=True)
class Train:
    """Members and the pairs between them; "frame" stands still and is no member."""

    members: tuple[str, ...]
    pairs: tuple[Pair, ...]


@dataclass(frozen=True, slots=True)
class Speeds:
    """Angular speed of each member over that of the driving one (algebraic), and ratio = driving/driven."""

    members: Mapping[str, Fraction]
    ratio: Fraction

    def relative(self, member: str, to: str) -> Fraction:
        """Speed of a member as seen from another one, over that of the driving member."""
        return self.members[member] - self.members[to]


def khv_train(pins: int, lobes: int) -> Train:
    """K-H-V drive: "input" crank, "disc" with lobes, "ring" of pins, "output" that turns with the disc.

    The unit of length is the eccentricity over pins − lobes, so the pitch radii are the tooth numbers.
    Raises Infeasible.
    """
    _fail_if_toothless(pins=pins, lobes=lobes)
    _fail_if_not_inside("lobes", lobes, "pins", pins)
    eccentricity = Fraction(pins - lobes)
    central = ("input", "ring", "output")
    pairs: tuple[Pair, ...] = (
        *(Pivot(FRAME, member) for member in central),
        Pivot("input", "disc", eccentricity),
        Rolling("disc", "ring", Fraction(pins)),
        EqualTurning("disc", "output"),
    )
    return Train(("input", "disc", "ring", "output"), pairs)


def rv_train(sun: int, planet: int, lobes: int, pins: int) -> Train:
    """2K-V drive (sources §1): "sun", "planet" fast on its crank, "disc", "ring" of pins, "carrier".

    The parallel cranks on which the disc sits let it turn only as the carrier does.  Lengths of the two stages
    have units of their own, half a module and the eccentricity; no speed depends on either.  Raises Infeasible.
    """
    _fail_if_toothless(sun=sun, planet=planet, lobes=lobes, pins=pins)
    _fail_if_not_inside("lobes", lobes, "pins", pins)
    axis, eccentricity = Fraction(sun + planet), Fraction(1)
    pairs: tuple[Pair, ...] = (
        *(Pivot(FRAME, member) for member in ("sun", "ring", "carrier")),
        Pivot("carrier", "planet", axis),
        Rolling("sun", "planet", Fraction(sun)),
        Pivot("planet", "disc", axis + eccentricity),
        EqualTurning("disc", "carrier"),
        Rolling("disc", "ring", eccentricity * pins / (pins - lobes)),
    )
    return Train(("sun", "planet", "disc", "ring", "carrier"), pairs)


def planetary_train(sun: int, planet: int, ring: int) -> Train:
    """2K-H set: "sun", "planet", "ring", "carrier"; the unit of length is the centre distance.

    The two meshes have pitch circles of their own on the planet, which are one only if ring = sun + 2 planet;
    other tooth numbers run with profile shift.  Raises Infeasible.
    """
    _fail_if_toothless(sun=sun, planet=planet, ring=ring)
    _fail_if_not_inside("planet", planet, "ring", ring)
    pairs: tuple[Pair, ...] = (
        *(Pivot(FRAME, member) for member in ("sun", "ring", "carrier")),
        Pivot("carrier", "planet", Fraction(1)),
        Rolling("sun", "planet", Fraction(sun, sun + planet)),
        Rolling("planet", "ring", Fraction(ring, ring - planet)),
    )
    return Train(("sun", "planet", "ring", "carrier"), pairs)


def speeds(train: Train, fixed: str = "ring", driving: str = "input", driven: str = "output") -> Speeds:
    """Speeds with one member fixed and another driving; raises TrochoidError if that cannot work."""
    fail_if_no_choice(train.members, fixed, driving, driven)
    columns = 2 * len(train.members)
    rows = [_row(train, pair) for pair in train.pairs]
    stands = [Fraction(int(j == _turning(train, fixed))) for j in range(columns)]
    free = null_space([*rows, stands], columns)
    if len(free) != 1:
        state = "locks" if not free else f"leaves {len(free)} freedoms in"
        raise TrochoidError(f"fixing {fixed} {state} the train; fix another member")
    turning = {member: free[0][_turning(train, member)] for member in train.members}
    return over_driving(turning, fixed, driving, driven)


def fail_if_no_choice(members: Iterable[str], fixed: str, driving: str, driven: str) -> None:
    """Raise TrochoidError unless these are three different ones of the members."""
    known = tuple(members)
    names = ", ".join(known)
    for name in (fixed, driving, driven):
        if name not in known:
            raise TrochoidError(f"'{name}' is no member of this train; its members are {names}")
    if len({fixed, driving, driven}) < 3:
        raise TrochoidError(
            f"fixed = {fixed}, driving = {driving}, driven = {driven}: three different members are needed; "
            f"choose among {names}"
        )


def over_driving(turning: Mapping[str, Fraction], fixed: str, driving: str, driven: str) -> Speeds:
    """Speeds over that of the driving member; raises TrochoidError where that or the driven one stands still."""
    for role, member in (("driving", driving), ("driven", driven)):
        if turning[member] == 0:
            raise TrochoidError(
                f"{role} = {member} stands still when {fixed} is fixed; choose another member"
            )
    relative = {member: turn / turning[driving] for member, turn in turning.items()}
    return Speeds(MappingProxyType(relative), 1 / relative[driven])


def _fail_if_toothless(**teeth: int) -> None:
    for name, count in teeth.items():
        if count < 1:
            raise Infeasible(f"{name} = {count}: a wheel has at least 1 tooth")


def _fail_if_not_inside(inner: str, fewer: int, outer: str, more: int) -> None:
    if fewer >= more:
        smaller = f"{inner} = {more - 1} or less, or " if more > 1 else ""
        raise Infeasible(
            f"{inner} = {fewer} inside {outer} = {more}: the inner wheel needs fewer teeth; "
            f"take {smaller}{outer} = {fewer + 1} or more"
        )


def _turning(train: Train, member: str) -> int:
    """Column of a member's angular speed; the column before it is its velocity at x = 0."""
    return 2 * train.members.index(member) + 1


def _row(train: Train, pair: Pair) -> Row:
    row = [Fraction(0)] * (2 * len(train.members))
    for member, sign in ((pair.a, 1), (pair.b, -1)):
        if member == FRAME:
            continue
        column = _turning(train, member)
        if isinstance(pair, EqualTurning):
            row[column] += sign
        else:
            row[column - 1] += sign
            row[column] += sign * pair.at
    return row

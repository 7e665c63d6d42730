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

from trochoid.kinematics.errors import TrochoidError

FRAME = "frame"

Row = list[Fraction]


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
    """
    eccentricity = Fraction(pins - lobes)
    central = ("input", "ring", "output")
    pairs: tuple[Pair, ...] = (
        *(Pivot(FRAME, member) for member in central),
        Pivot("input", "disc", eccentricity),
        Rolling("disc", "ring", Fraction(pins)),
        EqualTurning("disc", "output"),
    )
    return Train(("input", "disc", "ring", "output"), pairs)


def speeds(train: Train, fixed: str = "ring", driving: str = "input", driven: str = "output") -> Speeds:
    """Speeds with one member fixed and another driving; raises TrochoidError if that cannot work."""
    _fail_if_unknown(train, fixed, driving, driven)
    if len({fixed, driving, driven}) < 3:
        raise TrochoidError(
            f"fixed = {fixed}, driving = {driving}, driven = {driven}: three different members are needed; "
            f"choose among {', '.join(train.members)}"
        )
    columns = 2 * len(train.members)
    rows = [_row(train, pair) for pair in train.pairs]
    free = _null_space([*rows, _unit(columns, _turning(train, fixed))], columns)
    if len(free) != 1:
        state = "locks" if not free else f"leaves {len(free)} freedoms in"
        raise TrochoidError(f"fixing {fixed} {state} the train; fix another member")
    turning = {member: free[0][_turning(train, member)] for member in train.members}
    for role, member in (("driving", driving), ("driven", driven)):
        if turning[member] == 0:
            raise TrochoidError(
                f"{role} = {member} stands still when {fixed} is fixed; choose another member"
            )
    relative = {member: turn / turning[driving] for member, turn in turning.items()}
    return Speeds(MappingProxyType(relative), 1 / relative[driven])


def _fail_if_unknown(train: Train, *names: str) -> None:
    for name in names:
        if name not in train.members:
            raise TrochoidError(
                f"'{name}' is no member of this train; its members are {', '.join(train.members)}"
            )


def _turning(train: Train, member: str) -> int:
    """Column of a member's angular speed; the column before it is its velocity at x = 0."""
    return 2 * train.members.index(member) + 1


def _unit(columns: int, index: int) -> Row:
    return [Fraction(int(j == index)) for j in range(columns)]


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


def _null_space(rows: Iterable[Row], columns: int) -> list[Row]:
    """Basis of the solutions of rows·x = 0, by Gauss–Jordan elimination without rounding."""
    work = [list(row) for row in rows]
    pivots: list[int] = []
    for column in range(columns):
        done = len(pivots)
        found = next((i for i in range(done, len(work)) if work[i][column] != 0), None)
        if found is None:
            continue
        work[done], work[found] = work[found], work[done]
        scale = work[done][column]
        work[done] = [value / scale for value in work[done]]
        for i, row in enumerate(work):
            if i != done and row[column] != 0:
                factor = row[column]
                work[i] = [a - factor * b for a, b in zip(row, work[done], strict=True)]
        pivots.append(column)
    basis = []
    for free in (column for column in range(columns) if column not in pivots):
        vector = _unit(columns, free)
        for row, pivot in zip(work, pivots, strict=False):
            vector[pivot] = -row[free]
        basis.append(vector)
    return basis

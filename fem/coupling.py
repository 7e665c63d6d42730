"""What presses on contacts through the bodies that they share: the smooth compliance between all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.compliance import Compliance, Weights
from trochoid.fem.pair import Seat, State
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class ElasticBody:
    """A body as contacts see it: its compliance per unit thickness and its face width in m."""

    compliance: Compliance
    width: float


@dataclass(frozen=True, slots=True)
class Seated:
    """Contacts of one family at the positions: their state, their seat on a body (None: rigid), the smooth part (c,)
    in m/N of their round sides, and the second member's seat.
    """

    state: State
    seat: Seat | None
    round_side: Array
    far_seat: Seat | None = None

    def on(self, body: int) -> tuple[Seat, Array] | None:
        """Return the seat on a body and the arc lengths (n, c) there; None where the contacts do not press it."""
        for seat, place in ((self.seat, self.state.place), (self.far_seat, self.state.far)):
            if seat is not None and place is not None and seat.body == body:
                return seat, place
        return None


def coupling(bodies: Sequence[ElasticBody], contacts: Sequence[Seated]) -> Array:
    """Return the compliance (n, C, C) in m/N between all contacts, without the logarithm of each one on itself."""
    return _summed(bodies, contacts, 1, Compliance.between)


def rubbing_coupling(bodies: Sequence[ElasticBody], contacts: Sequence[Seated]) -> Array:
    """Return the same between normal and tangential forces (n, 2C, 2C), all normal ones first; signs as those of
    `Compliance.coupled`. Round sides yield as much along their surface as across it.

    Raises TrochoidError when a body was not pressed tangentially.
    """
    return _summed(bodies, contacts, 2, Compliance.coupled)


def _summed(
    bodies: Sequence[ElasticBody],
    contacts: Sequence[Seated],
    directions: int,
    read: Callable[[Compliance, Weights, Array], Array],
) -> Array:
    """Sum round sides and what every body passes on; `read` gives that for one body, direction after direction."""
    counts = np.cumsum([0] + [c.state.gap.shape[1] for c in contacts])
    size = int(counts[-1])
    every = np.arange(directions * size)
    total = np.zeros((len(contacts[0].state.gap), len(every), len(every)))
    total[:, every, every] = np.tile(np.concatenate([c.round_side for c in contacts]), directions)
    for number, body in enumerate(bodies):
        on = [i for i, c in enumerate(contacts) if c.on(number) is not None]
        if on:
            index = np.concatenate([np.arange(counts[i], counts[i + 1]) for i in on])
            index = np.concatenate([index + size * direction for direction in range(directions)])
            weights, points = _places([contacts[i] for i in on], number)
            total[:, index[:, None], index] += read(body.compliance, weights, points) / body.width
    return total


def _places(contacts: Sequence[Seated], body: int) -> tuple[Weights, Array]:
    seats = [found for c in contacts if (found := c.on(body)) is not None]
    weights = [seat.weights(place) for seat, place in seats]
    return Weights.joined(weights), np.concatenate([c.state.point for c in contacts], axis=1)

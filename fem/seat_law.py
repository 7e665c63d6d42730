"""Round things that touch an elastic body: rollers in its holes by ISO/TS 16281 with the hole's own seat, and pins."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.fem.bearing import iso16281_constant
from trochoid.fem.laws import HertzLine, PowerLaw
from trochoid.fem.material import Material, Plane, PlaneState
from trochoid.kinematics.types import Array


@dataclass(frozen=True, slots=True)
class RollerSeat:
    """A bearing of `rollers` between a raceway of radius `inner` and a hole of radius `outer` in a body of `width`; m.

    `plane` are the moduli of rollers and inner raceway in the plane state of the body, and of the body itself unless
    `hole` gives others.
    """

    plane: Plane
    state: PlaneState
    rollers: int
    roller_radius: float
    length: float
    inner: float
    outer: float
    width: float
    hole: Plane | None = None

    @property
    def kernel(self) -> float:
        """2/(πE') of a roller over its length, m/N."""
        return self.plane.kernel / self.length

    @property
    def hole_kernel(self) -> float:
        """2/(πE') of the body over the roller's length, m/N."""
        return self._body.kernel / self.length

    @property
    def _body(self) -> Plane:
        return self.plane if self.hole is None else self.hole

    @property
    def constant(self) -> float:
        """Load constant of a roller between its raceways, N/m^(10/9): the standard's for steel, else in
        proportion to E'.
        """
        steel = Material(210e9, 0.3).plane(self.state).modulus
        return iso16281_constant(self.length) * self.plane.modulus / steel

    @property
    def widening(self) -> float:
        """Compliance in m/N that the hole lacks because a roller's load spreads over the whole face width.

        The contact's logarithm counts with the roller's length, the body's with the face width; they meet at the
        depth that the load reaches at 45° when it has become as wide as the body.
        """
        length, width = self.length, self.width
        if length >= width:
            return 0.0
        return float(self._body.kernel * (1 / length - 1 / width) * np.log(0.5 * (width - length)))

    def seat_for_seat(self, law: PowerLaw, load: float) -> float:
        """Return what turns the seat that ISO/TS 16281 contains into none, plus the real seat's own logarithm, in m/N.

        The standard's line contact comprises both raceways in thick bodies. Its outer seat is what is left of it
        after Hertz's closed forms for the roller (both halves) and the inner raceway; the seat computed by finite
        elements takes its place. Evaluated at a typical `load` (N) of a loaded roller. A body of other moduli makes
        the contact wider or narrower, which the roller's half feels as well.
        """
        one, own, at = self.kernel, self.hole_kernel, np.array([load])
        r, inner, outer = self.roller_radius, self.inner, self.outer
        out = HertzLine(np.array([2 * one]), np.array([1 / (1 / r - 1 / outer)])).half_width(at)[0]
        real = HertzLine(np.array([one + own]), np.array([1 / (1 / r - 1 / outer)])).half_width(at)[0]
        into = HertzLine(np.array([2 * one]), np.array([1 / (1 / r + 1 / inner)])).half_width(at)[0]
        logs = np.log(4 * r / out) + np.log(4 * r / into) + np.log(4 * inner / into) - 1.5
        standard = law.approach(at)[0][0] / at[0] - one * logs
        return float(own * (np.log(2 / real) + 0.5) - standard + one * np.log(out / real))

    def typical_load(self, force: float) -> float:
        """Return a typical load (N) of a loaded roller under a bearing force (N): Stribeck's 4/Z of it."""
        least = least_load(self.plane, self.roller_radius) * self.length
        return float(max(4 * force / self.rollers, least))


def least_load(plane: Plane, radius: float) -> float:
    """Return the line load in N/m at which a contact is 1/1000 as wide as its pin: logarithms that stand for typical
    loads count from it when nothing loads the drive.
    """
    return 1e-6 * radius / (4 * plane.kernel)


def round_side(plane: Plane, count: int, radius: float, width: float, compliant: bool) -> tuple[Array, Array]:
    """Return kernel and smooth part of contacts between the disc and round pins that are held on their far side.

    Half of a cylinder pressed between two contacts (Johnson, Contact Mechanics, 5.57): (2/πE')(ln(4r/a) − ½)
    per unit line load. Pins that are not `compliant` are rigid.
    """
    one = plane.kernel / width
    if not compliant:
        return np.full(count, one), np.zeros(count)
    return np.full(count, 2 * one), np.full(count, one * (np.log(2 * radius) - 1))

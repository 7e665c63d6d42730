"""One equation of meshing for plane and sphere: what a curve leaves when a relative motion carries it.

A curve with normal n, carried by a motion whose velocity relative to the body is v, touches what it
generates where

    n · v = 0.

The body's profile is the set of these points, carried into the body's frame.  With dn/ds = κ τ, and a rigid
motion that turns a vector with dv = ω × dr, the slope of the equation along the curve is κ τ·v + n·(ω × τ);
so each contact is found by Newton's method from exact numbers.  Points of the plane are (..., 2), m, and of
the sphere (..., 3), unit vectors; the same functions serve both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.curve import Curve
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.spherical_curve import SphericalCurve
from trochoid.kinematics.types import Array


class RelativeMotion(Protocol):
    """Motion of the generating curve's frame as the generated body sees it, over a parameter φ (rad).

    `phi` broadcasts against the leading axes of points and vectors; rates are per unit φ and, like points,
    resolved in the frame of the curve.
    """

    def carry(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Points in the frame of the body."""
        ...

    def direct(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Directions in the frame of the body."""
        ...

    def velocity(self, points: Array, phi: npt.ArrayLike) -> Array:
        """Velocity v of points of the curve relative to the body."""
        ...

    def spin(self, vectors: Array, phi: npt.ArrayLike) -> Array:
        """Rate ω × vector at which the motion turns directions."""
        ...


@dataclass(frozen=True, eq=False, slots=True)
class Contacts:
    """Places where a curve touches what it generates.

    `position` (m,) counts the values of φ, `parameter` (m,) is the curve's, `point` and `normal` (m, d) are in
    the frame of the body; the normal points out of the material of the generating curve.
    """

    position: npt.NDArray[np.intp]
    parameter: Array
    point: Array
    normal: Array


def meshing(
    curve: Curve | SphericalCurve, motion: RelativeMotion, u: npt.ArrayLike, phi: npt.ArrayLike
) -> Array:
    """n·v at the curve's parameters u and the motion's φ, which broadcast; 0 at a contact."""
    product: Array = np.sum(curve.normal(u) * motion.velocity(curve.point(u), phi), axis=-1)
    return product


def meshing_slope(
    curve: Curve | SphericalCurve, motion: RelativeMotion, u: npt.ArrayLike, phi: npt.ArrayLike
) -> Array:
    """∂(n·v)/∂u = |c'| (κ τ·v + n·(ω × τ)) at the curve's parameters u and the motion's φ."""
    tangent = curve.tangent(u)
    bend = curve.curvature(u) * np.sum(tangent * motion.velocity(curve.point(u), phi), axis=-1)
    twist = np.sum(curve.normal(u) * motion.spin(tangent, phi), axis=-1)
    slope: Array = curve.speed(u) * (bend + twist)
    return slope


def contacts(
    curve: Curve | SphericalCurve,
    motion: RelativeMotion,
    phi: npt.ArrayLike,
    span: tuple[float, float] | None = None,
    samples: int = 96,
) -> Contacts:
    """All contacts of a curve at the values φ (n,), searched over one period or the parameters `span`.

    Roots are told apart by `samples` places; two that lie closer than these are missed together.
    """
    phi = np.atleast_1d(np.asarray(phi, dtype=np.float64))
    off = -0.38 * curve.period / samples  # contacts like to sit at 0, where the round must not be cut
    low, high = span if span is not None else (off, off + curve.period)
    u = np.linspace(low, high, samples + 1)
    value = meshing(curve, motion, u, phi[:, None])
    change = (value[:, :-1] < 0.0) != (value[:, 1:] < 0.0)
    row, place = np.nonzero(change)
    at = phi[row]
    root = bracketed_roots(
        lambda x: meshing(curve, motion, x, at),
        lambda x: meshing_slope(curve, motion, x, at),
        u[place],
        u[place + 1],
    )
    return Contacts(row, root, generated(curve, motion, root, at), motion.direct(curve.normal(root), at))


def contact_near(
    curve: Curve | SphericalCurve, motion: RelativeMotion, phi: npt.ArrayLike, start: npt.ArrayLike
) -> Array:
    """Parameters u (n,) of the contacts nearest to `start` (n,) at the values φ (n,), to follow one branch.

    Raises NotConverged.
    """
    at = np.asarray(phi, dtype=np.float64)
    u = np.array(np.broadcast_to(np.asarray(start, dtype=np.float64), at.shape))
    limit = curve.period / 16.0
    for _ in range(50):
        slope = meshing_slope(curve, motion, u, at)
        step = np.clip(-meshing(curve, motion, u, at) / np.where(slope == 0.0, 1.0, slope), -limit, limit)
        u = u + step
        if np.abs(step).max(initial=0.0) <= 1e-13 * curve.period:
            return u
    worst = int(np.argmax(np.abs(step)))
    raise NotConverged(
        f"no contact found from parameter {np.ravel(start)[min(worst, np.size(start) - 1)]:.6g} at φ = "
        f"{np.ravel(at)[worst]:.6g} rad; start nearer, or search the whole curve"
    )


def generated(
    curve: Curve | SphericalCurve, motion: RelativeMotion, u: npt.ArrayLike, phi: npt.ArrayLike
) -> Array:
    """Points of the curve at u, carried into the frame of the body at φ; its profile where n·v = 0."""
    return motion.carry(curve.point(u), phi)


def bracketed_roots(
    value: Callable[[Array], Array], slope: Callable[[Array], Array], low: Array, high: Array
) -> Array:
    """Roots of `value` in brackets (m,) across which it changes sign: Newton steps kept within them."""
    rising = value(low) < 0.0
    x = 0.5 * (low + high)
    for _ in range(80):
        y = value(x)
        below = (y < 0.0) == rising
        low, high = np.where(below, x, low), np.where(below, high, x)
        rate = slope(x)
        new = x - y / np.where(rate == 0.0, 1.0, rate)
        new = np.where((new <= low) | (new >= high) | (rate == 0.0), 0.5 * (low + high), new)
        step, x = np.abs(new - x), new
        if np.all((step <= 4e-16 * np.maximum(1.0, np.abs(x))) | (y == 0.0)):
            break
    return x

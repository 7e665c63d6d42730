"""Poses of members that move in a plane, over the angle of the driving member."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.train import khv_train, speeds
from trochoid.kinematics.types import Array, frozen


@dataclass(frozen=True, eq=False, slots=True)
class PlaneMotion:
    """Place of a member's frame in the fixed one: `center` (n, 2), m, and `rotation` (n,), rad."""

    center: Array
    rotation: Array

    def to_fixed(self, points: npt.ArrayLike) -> Array:
        """Carry points of the member, (p, 2) or (n, p, 2), to the fixed frame, (n, p, 2)."""
        return self._turned(np.asarray(points, dtype=np.float64), 1.0) + self.center[:, None, :]

    def to_member(self, points: npt.ArrayLike) -> Array:
        """Carry points of the fixed frame, (p, 2) or (n, p, 2), into the member's, (n, p, 2)."""
        return self._turned(np.asarray(points, dtype=np.float64) - self.center[:, None, :], -1.0)

    def _turned(self, points: Array, sign: float) -> Array:
        c, s = np.cos(self.rotation)[:, None], sign * np.sin(self.rotation)[:, None]
        x, y = points[..., 0], points[..., 1]
        return np.stack((c * x - s * y, s * x + c * y), axis=-1)


def khv_motions(
    cycloid: Cycloid,
    angles: npt.ArrayLike,
    discs: int = 1,
    fixed: str = "ring",
    driving: str = "input",
) -> Mapping[str, PlaneMotion]:
    """Motions of "input", "ring", "output", "disc0" … over the angles (n,), rad, of the driving member.

    A disc's frame is that of its profile.  Disc i runs 2π i/discs ahead on its eccentric, so its profile is
    turned by −2π i/(discs·z_c) against the flange (`flange_lead`).
    """
    angle = np.atleast_1d(np.asarray(angles, dtype=np.float64))
    driven = next(name for name in ("output", "ring", "input") if name not in (fixed, driving))
    turn = speeds(khv_train(cycloid.pins, cycloid.lobes), fixed, driving, driven).members
    origin = np.zeros((angle.size, 2))
    motions = {
        name: PlaneMotion(frozen(origin), frozen(float(turn[name]) * angle))
        for name in ("input", "ring", "output")
    }
    for i in range(discs):
        crank = float(turn["input"]) * angle + 2.0 * math.pi * i / discs
        center = cycloid.eccentricity * np.stack((np.cos(crank), np.sin(crank)), axis=-1)
        rotation = float(turn["disc"]) * angle - flange_lead(cycloid, i, discs)
        motions[f"disc{i}"] = PlaneMotion(frozen(center), frozen(rotation))
    return MappingProxyType(motions)


def flange_lead(cycloid: Cycloid, disc: int, discs: int) -> float:
    """Angle (rad) by which the flange, and so the holes, lead the profile frame of disc number `disc`."""
    return 2.0 * math.pi * disc / (discs * cycloid.lobes)

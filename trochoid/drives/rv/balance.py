"""Balances of what was solved, recomputed from the contacts and the forces of bearings and teeth alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.rv.contact import inertia, ring_turn
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.supports import pressing
from trochoid.kinematics.types import Array

if TYPE_CHECKING:
    from trochoid.drives.rv.series import Series


def disc_residual(design: Design, series: Series) -> float:
    """Return the largest sum of forces and of moments on a disc over its largest force (and the pin circle)."""
    worst = 0.0
    for i in range(len(design.discs)):
        motion = series.motion @ series.motions.disc(i)[:2].T
        center = design.eccentric(i, series.crank) + motion
        force, moment = inertia(design, i, series.crank)[0], np.zeros(len(series.angle))
        size = np.zeros(len(series.angle))
        for push, point in _on_disc(series, i):
            force = force - push.sum(axis=1)
            moment = moment - _moment(point - center[:, None], push)
            size = np.maximum(size, np.linalg.norm(push, axis=-1).max(axis=1, initial=0.0))
        size = np.where(size > 0, size, 1.0)
        unmet = np.linalg.norm(force, axis=-1), np.abs(moment) / design.flank.pin_circle_radius
        worst = max(worst, *(float((u / size).max()) for u in unmet))
    return worst


def _on_disc(series: Series, i: int) -> list[tuple[Array, Array]]:
    """Return the forces (n, c, 2) of disc i on what it touches, and where, for pins and each crankshaft's rollers."""
    found = [(series.ring.force[:, i, :, None] * series.ring.normal[:, i], series.ring.point[:, i])]
    for j in range(series.arm.force.shape[2]):
        found.append(
            (series.arm.force[:, i, j, :, None] * series.arm.normal[:, i, j], series.arm.point[:, i, j])
        )
    return found


def crank_residual(design: Design, series: Series) -> float:
    """Return the largest sum of forces, of tilting and of turning moments on a crankshaft over its largest force.

    Rollers, bearings, teeth and the inertia of the eccentrics; moments over the circle of the crankshafts. Of a rigid
    crankshaft on a rigid axis only the turning moment is free.
    """
    table, arm = design.drive.crankshaft, design.first.arm
    teeth, bearing = series.mesh_force, series.bearing_force
    rigid = "crank0.rotation" in series.motions.names
    worst = 0.0
    for j, place in enumerate(design.crank_places):
        normal = pressing(design)[j]
        forces = [(teeth[:, j, None] * normal, table.planet_position)]
        forces += [(-bearing[:, j, b], z) for b, z in enumerate(table.bearing_positions)]
        turning = -teeth[:, j] * design.first.pair.second.base_radius
        size = np.abs(teeth[:, j])
        for i, disc in enumerate(design.discs):
            axis = place + series.motion @ series.motions.crank(j, i)[:2].T
            push = series.arm.force[:, i, j, :, None] * series.arm.normal[:, i, j]
            forces.append((push.sum(axis=1) + inertia(design, i, series.crank)[1], disc.z))
            turning = turning + _moment(series.arm.point[:, i, j] - axis[:, None], push)
            size = np.maximum(size, np.linalg.norm(push, axis=-1).max(axis=1, initial=0.0))
        size = np.where(size > 0, size, 1.0)
        unmet = [np.abs(turning) / arm]
        if not rigid:
            unmet.append(np.linalg.norm(np.sum([f for f, _ in forces], axis=0), axis=-1))
            unmet.append(np.linalg.norm(np.sum([z * f for f, z in forces], axis=0), axis=-1) / arm)
        worst = max(worst, *(float((u / size).max()) for u in unmet))
    return worst


def torque_residual(design: Design, series: Series) -> float:
    """Return how far the ring pins' torque about the axis is from the ring's load, relative to the larger of it and of
    the largest pin force at the pin circle.
    """
    total, reach = np.zeros(len(series.angle)), float(series.ring.force.max(initial=0.0))
    for i in range(len(design.discs)):
        push, point = _on_disc(series, i)[0]
        total += _moment(point, push)
    size = max(design.ring_torque, reach * design.flank.pin_circle_radius) or 1.0
    return float(np.abs(total + design.ring_torque).max() / size)


def power(design: Design, series: Series) -> tuple[Array, Array, Array]:
    """Return what sun and ring give and what goes into elastic energy (n,), J per radian of the crankshafts seen from
    the carrier, which stands: the sun from the forces of its teeth, the ring from its load, the energy from how fast
    the surfaces of all contacts close while members turn rigidly.
    """
    table, turn = design.drive.first_stage, ring_turn(design, np.array(1.0))
    sun = -series.mesh_force.sum(axis=1) * design.first.pair.first.base_radius
    sun = sun * table.z_planet / table.z_sun  # it turns against its planets, and its load with them
    ring = np.full(len(series.angle), design.ring_torque * float(turn))
    stored = np.zeros(len(series.angle))
    for i in range(len(design.discs)):
        out = design.eccentric(i, series.crank)
        swing = np.stack([-out[:, 1], out[:, 0]], axis=-1)[:, None]
        groups = _on_disc(series, i)
        push, point = groups[0]
        stored += (push * (swing - float(turn) * across(point))).sum(axis=(1, 2))
        for j, (push, point) in enumerate(groups[1:]):
            axis = design.crank_places[j] + series.motion @ series.motions.crank(j, i)[:2].T
            stored += (push * (swing - across(point - axis[:, None]))).sum(axis=(1, 2))
    return sun, ring, stored


def power_residual(design: Design, series: Series) -> float:
    """Return how far the powers of sun and ring miss what is stored, relative to the larger of them."""
    sun, ring, stored = power(design, series)
    size = np.maximum(np.abs(ring), np.abs(sun))
    return float(np.abs((sun + ring - stored) / np.where(size > 0, size, 1.0)).max())


def across(vectors: Array) -> Array:
    """Return vectors (…, 2) turned by +90°."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _moment(arm: Array, force: Array) -> Array:
    """Return the sum (n,) of moments of forces (n, c, 2)."""
    return np.asarray(_cross(arm, force).sum(axis=1))

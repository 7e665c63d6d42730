"""Interfaces of a solid body: nodes that move as one rigid body, six coordinates each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from trochoid.fem.solid import SolidBody, rigid_motions
from trochoid.kinematics.errors import Infeasible, TrochoidError
from trochoid.kinematics.types import Array, IntArray

Triple = tuple[float, float, float]


@dataclass(frozen=True, eq=False, slots=True)
class Interface:
    """Nodes (k,) of a mesh that move as one rigid body; its six coordinates are those of `position` (m)."""

    name: str
    position: Triple
    nodes: IntArray


def interfaces_of(body: SolidBody, positions: Mapping[str, Triple]) -> tuple[Interface, ...]:
    """Return an interface of each named set of the mesh with its position; raises TrochoidError for an unknown set."""
    unknown = [name for name in positions if name not in body.mesh.sets]
    if unknown:
        raise TrochoidError(
            f"the mesh has no set {', '.join(map(repr, unknown))}; there are {', '.join(body.mesh.sets) or 'none'}"
        )
    return tuple(Interface(name, at, body.mesh.sets[name]) for name, at in positions.items())


def free_nodes(body: SolidBody, interfaces: Sequence[Interface]) -> IntArray:
    """Return the nodes of no interface; raises Infeasible for interfaces that cannot be rigid bodies of their own."""
    if not interfaces:
        raise Infeasible("a reduced body needs at least one interface: a bore, a foot")
    owner = np.full(len(body.mesh.points), -1)
    for i, interface in enumerate(interfaces):
        taken = owner[interface.nodes] >= 0
        if taken.any():
            other = interfaces[int(owner[interface.nodes][taken][0])].name
            raise Infeasible(
                f"interfaces {other} and {interface.name} share {int(taken.sum())} nodes, and each moves as one rigid "
                "body; make them smaller, or one interface of both"
            )
        points = body.mesh.points[interface.nodes]
        spans = (
            np.linalg.svd(points - points.mean(axis=0), compute_uv=False) if len(points) > 2 else np.zeros(3)
        )
        if spans[1] <= 1e-6 * body.mesh.extent:
            raise Infeasible(
                f"interface {interface.name} has {len(points)} nodes on a line: a rigid body needs three that are not"
            )
        owner[interface.nodes] = i
    if (owner >= 0).all():
        raise Infeasible(
            "the interfaces hold every node of the mesh: nothing is left to yield; mesh it more finely"
        )
    return np.flatnonzero(owner < 0)


def carried(body: SolidBody, interfaces: Sequence[Interface]) -> Array:
    """Return the displacements (3p, 6k) of all points that interfaces carry, others at rest."""
    moved = np.zeros((body.size, 6 * len(interfaces)))
    for i, interface in enumerate(interfaces):
        dofs = (3 * interface.nodes[:, None] + np.arange(3)).ravel()
        rigid = rigid_motions(body.mesh.points[interface.nodes], np.asarray(interface.position))
        moved[dofs, 6 * i : 6 * i + 6] = rigid
    return moved


def rigid_of(interfaces: Sequence[Interface], size: int, about: Triple) -> Array:
    """Return unit translations and rotations about a point as `size` coordinates, six of each interface first."""
    motion = np.zeros((size, 6))
    for i, interface in enumerate(interfaces):
        motion[6 * i : 6 * i + 3] = rigid_motions(np.array([interface.position]), np.asarray(about))
        motion[6 * i + 3 : 6 * i + 6, 3:] = np.eye(3)
    return motion

"""Load over the face width of both meshes of a planet, in slices that share the rotation of the wheels alone."""

from __future__ import annotations

from dataclasses import dataclass

from trochoid.drives.planetary.bodies import Level
from trochoid.drives.planetary.contact import Load
from trochoid.drives.planetary.design import Design
from trochoid.drives.planetary.meshes import matings
from trochoid.fem.gear_path import base_pitch
from trochoid.fem.gear_slices import FaceLoad, Lead, solve_face
from trochoid.kinematics.errors import TrochoidError
from trochoid.kinematics.types import Array

POSITIONS = 8  # over a base pitch


@dataclass(frozen=True, slots=True)
class Faces:
    """Load over the width of sun and planet, planet and ring; `places` (slices,) in m from the middle."""

    outer: FaceLoad
    inner: FaceLoad
    places: Array


def faces(design: Design, level: Level, load: Load, positions: int, coarser: bool = False) -> Faces:
    """Solve both meshes under an even share of the torque, centres held; `coarser`: with half of the slices.

    Raises NotConverged, Infeasible.
    """
    table = design.drive.lead
    if table is None:
        raise TrochoidError("the load over the face width needs the scene's [drive.lead] table")
    count = max(2, table.slices // 2) if coarser else table.slices
    leads = [Lead(x.misalignment, x.crown, count) for x in (table.sun_and_planet, table.planet_and_ring)]
    found = [
        solve_face(mating, base_pitch(mating, min(positions, POSITIONS)), lead)
        for mating, lead in zip(matings(design, level, load), leads, strict=True)
    ]
    return Faces(found[0], found[1], leads[0].place * design.drive.face_width)

"""The teeth of sun and planet: how stiff one mesh is over a base pitch, as elastic gears and by ISO 6336-1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trochoid.drives.rv.contact import plane
from trochoid.drives.rv.design import Design
from trochoid.drives.rv.mesh_stiffness import light, mean_stiffness
from trochoid.fem.gear_body import press_gear
from trochoid.fem.gear_mesh import Wheel
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.gear_path import Mating, Path, base_pitch, mating_assembly, solve_path
from trochoid.fem.gear_root import pair_loads, root_table, tooth_stress
from trochoid.geometry.gear_outline import Blank
from trochoid.geometry.gear_tooth import Tooth, sharpest
from trochoid.kinematics.types import Array, frozen

POSITIONS = 24  # over a base pitch
LEAST = 1e3  # N/m: a drive without load has teeth as stiff as under this one


@dataclass(frozen=True, slots=True)
class Teeth:
    """One mesh at n angles of the sun over a base pitch: tangent `stiffness` (n,) in N/m and transmission error `error`
    (n,) in m on the line of action, `pressure` (n,) in Pa, the largest; the wheels and what was solved.
    """

    angle: Array
    stiffness: Array
    error: Array
    pressure: Array
    mating: Mating
    path: Path

    @property
    def mean(self) -> float:
        """Stiffness of the mean compliance, N/m."""
        return 1.0 / float((1.0 / self.stiffness).mean())


def teeth(design: Design, facets: int) -> Teeth:
    """Solve one mesh at its nominal load; `facets` per flank.

    The sun is held at half its pitch radius, the planet at the radius of its crankshaft.
    """
    stage, width = design.first, design.drive.first_stage.face_width
    bores = 0.5 * stage.pair.first.pitch_radius, design.drive.crankshaft.radius
    wheels = []
    for cut, tip, bore in zip(stage.cuts, stage.tips, bores, strict=True):
        blank = Blank(Tooth(cut, tip, sharpest(cut.gear)), min(bore, 0.8 * cut.root_radius))
        wheels.append(Wheel.of(press_gear(blank, plane(design), facets), width))
    torque = nominal_tooth_force(design) * stage.pair.second.base_radius
    mating = Mating((wheels[0], wheels[1]), stage.arm, torque)
    angle = base_pitch(mating, POSITIONS)
    path = solve_path(mating, angle)
    return Teeth(frozen(angle), path.stiffness, path.error, frozen(path.pressure.max(axis=1)), mating, path)


def root_stress(made: Teeth) -> tuple[Array, Array]:
    """Return the largest tension (n,) in Pa in the fillets of the loaded teeth of sun and planet.

    A planet has this mesh alone; bores are held, without the stress of a fit.
    """
    pair = mating_assembly(made.mating, made.angle).families[0].pair
    assert isinstance(pair, GearPair)
    state, force = made.path.contact.touches["mesh0"].state, made.path.force
    found = []
    for second, wheel in enumerate(made.mating.wheels):
        stress = tooth_stress(
            root_table(wheel.body), pair_loads(pair, state, force, bool(second)), wheel.width
        )
        found.append(frozen(np.where(force > 0.0, stress, 0.0).max(axis=1)))
    return found[0], found[1]


def iso_stiffness(design: Design) -> float:
    """Return c_γα b of ISO 6336-1 at the nominal load, N/m."""
    table, stage = design.drive.first_stage, design.first
    ratio = float(stage.pair.contact_ratio(*stage.tips))
    load = nominal_tooth_force(design) / table.face_width
    return mean_stiffness(stage.pair, ratio) * light(load) * table.face_width


def nominal_tooth_force(design: Design) -> float:
    """Return the normal force of one planet's teeth when all planets carry alike, N; not below LEAST over the width."""
    table, c = design.drive.first_stage, design.drive.cycloid
    sun_torque = design.ring_torque * table.z_sun * (c.pins - c.lobes) / (table.z_planet * c.pins)
    alike = sun_torque / (table.cranks * design.first.pair.first.base_radius)
    return max(alike, LEAST * table.face_width)

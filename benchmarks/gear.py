"""Involute pairs: published stiffnesses, how a pair converges with its mesh, what it costs.

Bores of half the pitch radii are held. 20/30: m 2 mm, x 0.5/0.634 at 52 mm, b 38 mm, 200 N/mm along the line of action.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import process_time

import numpy as np

from benchmarks.table import Row, Table
from trochoid.fem.gear_body import press_gear
from trochoid.fem.gear_estimate import path_error
from trochoid.fem.gear_mesh import Wheel
from trochoid.fem.gear_pair import GearPair
from trochoid.fem.gear_path import Mating, Path, base_pitch, mating_assembly, solve_path
from trochoid.fem.gear_root import pair_loads, root_table, tooth_stress
from trochoid.fem.material import Material, PlaneState
from trochoid.geometry.gear_outline import Blank
from trochoid.geometry.gear_tooth import Tooth, sharpest
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.involute_pair import Pair, mesh, mesh_at
from trochoid.kinematics.rack import Rack, rack_cut

MODULE, LINE_LOAD, POSITIONS = 2e-3, 200e3, 200
LEVELS = (4, 8, 16, 32)
SINGLE = {"strain": 16.9, "stress": 15.8}  # N/(mm·µm)
# c' and c_γα of ISO 6336-1, N/(mm·µm)
ISO = {
    (20, 20): (11.487, 16.285),
    (30, 30): (12.785, 19.051),
    (17, 103): (13.247, 20.055),
    (62, 62): (14.472, 23.044),
}
ROSS = 4.096607e8  # N/m, 62/62, b 20 mm


def measure() -> list[Table]:
    """Compare with published numbers, and coarser meshes with the finest."""
    return [_published(), _iso(), _convergence()]


@dataclass(frozen=True, slots=True)
class Case:
    """A pair to build: teeth, shifts, centre distance in m (None: without play), face width, Young's modulus in Pa."""

    teeth: tuple[int, int]
    shifts: tuple[float, float]
    centers: float | None
    width: float
    modulus: float
    state: PlaneState

    @property
    def pair(self) -> Pair:
        """The gears in mesh."""
        one, two = (Gear(z, MODULE, shift=x) for z, x in zip(self.teeth, self.shifts, strict=True))
        return mesh(one, two) if self.centers is None else mesh_at(one, two, self.centers)

    def tooth(self, gear: Gear) -> Tooth:
        """Rack-cut teeth, shortened to keep the clearance."""
        tip = gear.pitch_radius + MODULE * (1.0 + float(gear.shift) - float(self.pair.tip_shortening))
        return Tooth(rack_cut(gear, Rack(MODULE)), tip, sharpest(gear))

    def mating(self, level: int) -> Mating:
        """Mesh and press both gears."""
        pair, plane = self.pair, Material(self.modulus, 0.3).plane(self.state)
        one, two = (
            Wheel.of(press_gear(Blank(self.tooth(g), 0.5 * g.pitch_radius), plane, level), self.width)
            for g in (pair.first, pair.second)
        )
        torque = LINE_LOAD * self.width * two.flank.base_radius
        return Mating((one, two), float(pair.center_distance), torque)


def sun_planet(state: PlaneState = "strain") -> Case:
    """Return the 20/30 pair."""
    return Case((20, 30), (0.5, 0.634), 52e-3, 38e-3, 210e9, state)


def _published() -> Table:
    rows = []
    for state, number in SINGLE.items():
        mating = sun_planet("strain" if state == "strain" else "stress").mating(16)
        path = solve_path(mating, base_pitch(mating, POSITIONS))
        single = (path.force > 0).sum(axis=1) == 1
        found = float(path.secant[single].mean() / 38e-3 / 1e9)
        rows.append(Row(f"20/30, plane {state}: single-pair zone", found, "N/(mm µm)"))
        rows.append(Row(f"  from {number}", abs(found / number - 1), "", 0.01))
    mating = Case((62, 62), (0.0, 0.0), None, 20e-3, 206e9, "strain").mating(8)
    mean = float(solve_path(mating, base_pitch(mating, POSITIONS)).secant.mean())
    rows += [
        Row("62/62, plane strain: mesh stiffness", mean, "N/m"),
        Row("  from ROSS's", abs(mean / ROSS - 1), "", 0.1),
    ]
    return Table("mesh stiffness of involute pairs", "F/δ, bores of half the pitch radii held", tuple(rows))


def _iso() -> Table:
    rows = []
    for teeth, (single, mean) in ISO.items():
        mating = Case(teeth, (0.0, 0.0), None, 20e-3, 206e9, "stress").mating(8)
        path = solve_path(mating, base_pitch(mating, POSITIONS))
        name, ones = f"{teeth[0]}/{teeth[1]}", (path.force > 0).sum(axis=1) == 1
        if ones.any():  # at ε = 1.79 the load brings the next tooth in before the last has left
            found = float(path.secant[ones].max() / 20e-3 / 1e9)
            rows += [
                Row(f"{name}: c'", found, "N/(mm µm)"),
                Row("  from ISO's", abs(found / single - 1), "", 0.2),
            ]
        found = float(path.secant.mean() / 20e-3 / 1e9)
        rows += [
            Row(f"{name}: c_γα", found, "N/(mm µm)"),
            Row("  from ISO's", abs(found / mean - 1), "", 0.2),
        ]
    return Table(
        "stiffness beside ISO 6336-1",
        "plane stress, 200 N/mm, x = 0; ISO's c' has a factor 0.8 in it",
        tuple(rows),
    )


def _root(mating: Mating, path: Path) -> float:
    pair = mating_assembly(mating, path.angle).families[0].pair
    assert isinstance(pair, GearPair)
    loaded = pair_loads(pair, path.contact.touches["mesh0"].state, path.force)
    return float(tooth_stress(root_table(mating.wheels[0].body), loaded, 38e-3).max())


def _convergence() -> Table:
    rows: list[Row] = []
    found: dict[int, tuple[Path, float]] = {}
    solve_path(warm := sun_planet().mating(4), base_pitch(warm, 5))  # what is imported once is not counted
    for level in LEVELS:
        start = process_time()
        mating = sun_planet().mating(level)
        angle = base_pitch(mating, POSITIONS)
        built = process_time()
        path = solve_path(mating, angle)
        cold = process_time()
        found[level] = (path, _root(mating, path))
        target = {16: 2.0}.get(level)
        rows.append(Row(f"{level} facets per flank: one base pitch, cold", cold - start, "s", target))
        rows.append(
            Row(f"{level} facets per flank: one position, warm", 1e3 * (cold - built) / POSITIONS, "ms", 1.0)
        )
    finest, root = found[LEVELS[-1]]
    for level in LEVELS[:-1]:
        path, stress = found[level]
        name, target = f"{level} facets per flank", 1e-3 if level >= 8 else None
        rows.append(
            Row(f"{name}: error of F/δ", float(np.abs(path.secant / finest.secant - 1).max()), "", target)
        )
        rows.append(
            Row(
                f"{name}: error of dF/dδ",
                float(np.abs(path.stiffness / finest.stiffness - 1).max()),
                "",
                target,
            )
        )
        ripple = np.abs((path.error - path.error.mean()) - (finest.error - finest.error.mean())).max()
        rows.append(
            Row(f"{name}: error of the ripple / ripple", float(ripple / np.ptp(finest.error)), "", target)
        )
        rows.append(
            Row(f"{name}: error of the root stress", abs(stress / root - 1), "", 1e-2 if level >= 8 else None)
        )
    coarse, fine = found[8][0], found[16][0]
    estimate, true = path_error(fine, coarse), np.abs(fine.error - finest.error)
    rows.append(
        Row(
            "levels 8 and 16: positions whose error is covered",
            float((true <= estimate.error).mean()),
            "",
            0.9,
            True,
        )
    )
    strips = solve_path(mating, finest.angle, resolve=True)
    rows.append(
        Row("level 0 from strips, tip edges too", float(np.abs(finest.error / strips.error - 1).max()))
    )
    return Table(
        "convergence of a gear pair 20/30",
        f"largest of {POSITIONS} positions, against {LEVELS[-1]} facets; CPU seconds of one thread",
        tuple(rows),
    )

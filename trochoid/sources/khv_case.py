"""The drives of sources §3 and what is computed of them."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from trochoid.drives.khv.design import Design, design
from trochoid.drives.khv.series import solve_at
from trochoid.fem.complementarity import Group, Problem, solve, tangent
from trochoid.kinematics.cycloid import Cycloid, Modification, gap, gap_first_order
from trochoid.kinematics.parallel_crank import distinct_discs, loaded_at, loaded_output_pins
from trochoid.kinematics.train import khv_train, rv_train, speeds
from trochoid.kinematics.types import Array
from trochoid.run import Run
from trochoid.scene import read
from trochoid.sources.row import Finding
from trochoid.starter import starter

FLANK = Cycloid(40, 39, 0.064, 0.003, 0.0013)  # of an RV-40E class drive
GROUND = Modification(equidistant=1e-5, radial=-2e-5)
TORQUE, CRANK, STIFFNESS = 206.0, 0.2, 2e8  # N·m per disc, rad, N/m
SAME_FLANK = (
    "drive.pins=40",
    "drive.lobes=39",
    "drive.pin_circle_radius=64",
    "drive.pin_radius=3",
    "drive.eccentricity=1.3",
    "drive.discs=1",
    "drive.output_pins.count=12",
    "drive.output_pins.circle_radius=40",
    "operation.output_torque=206",
)


def example(*overrides: str) -> Design:
    """The starter scene's drive with other numbers, rigid discs on equal springs."""
    return design(read(starter("khv"), ("effects=[]", 'ask.quantities=["ratio"]', *overrides)))


def run(*overrides: str) -> Run:
    """A run of the starter scene."""
    return Run(read(starter("khv"), overrides))


def specific_mass() -> float:
    """Mass over output torque of the starter drive with its casing, kg/(N·m)."""
    parts = run().mass.parts or {}
    return float(getattr(parts["specific"], "value", math.nan))


def efficiency() -> float:
    """Of the starter scene with rigid discs: friction 0.05 at ring pins and output rollers, none elsewhere."""
    rigid = ('ask.quantities=["efficiency"]', 'accuracy.model="springs"', 'effects=[{type="friction"}]')
    return float(run(*rigid, "ask.positions=20").efficiency.value or math.nan)


def springs(flank: Cycloid, crank: float, torque: float, gaps: Array) -> Problem:
    """Pins as equal springs against a rigid disc that can only turn."""
    arms = flank.lever(flank.contact_parameter(np.arange(flank.pins), crank))
    group = Group(np.full((flank.pins, 1, 1), 1.0 / STIFFNESS), gaps[:, None], arms[:, None, None])
    return Problem((group,), np.zeros((flank.pins,) * 2), np.zeros((1, 1)), np.array([torque]))


def pin_forces(flank: Cycloid = FLANK, crank: float = CRANK, torque: float = TORQUE, gaps: str = "") -> Array:
    """Pin forces (pins,), N; `gaps` none, "exact" or "first order"."""
    t = flank.contact_parameter(np.arange(flank.pins), crank)
    found = np.zeros(flank.pins)
    if gaps == "exact":
        found = gap(flank, GROUND, flank.center_path(t), t)[0]
    elif gaps:
        found = gap_first_order(flank, GROUND, t)
    forces: Array = solve(springs(flank, crank, torque, found)).forces[0][:, 0]
    return forces


def largest_and_count(gaps: str = "") -> tuple[float, int]:
    """Largest pin force (N) and how many pins carry."""
    forces = pin_forces(gaps=gaps)
    return float(forces.max()), int(np.count_nonzero(forces > 1e-9))


def resultants() -> tuple[Array, Array]:
    """Forces (2,) of all ring pins and of all output pins on the disc, N."""
    touches = solve_at(example(*SAME_FLANK), "springs", (), CRANK).touches
    ring, output = (
        np.asarray(touches[name].force @ touches[name].state.normal) for name in ("ring0", "output0")
    )
    return ring, output


def on_eccentric() -> tuple[float, float]:
    """Force on the eccentric without and with the output pins, N."""
    ring, output = resultants()
    return float(np.linalg.norm(ring)), float(np.linalg.norm(ring + output))


def tangential() -> Finding:
    """Force on the eccentric across it against T/(e z_c)."""
    ring, output = resultants()
    across = abs(float((ring + output) @ np.array([-math.sin(CRANK), math.cos(CRANK)])))
    closed = TORQUE / (FLANK.eccentricity * FLANK.lobes)
    return Finding(f"{across:.2f} N, T/(e z_c) = {closed:.2f} N", math.isclose(across, closed, rel_tol=1e-12))


def half_of_the_pins() -> Finding:
    """Loaded pins of the starter drive over a pitch."""
    flank = example().flank
    loaded = {int(np.count_nonzero(pin_forces(flank, a, 200.0) > 1e-9)) for a in (0.1, 0.2, 0.25)}
    return Finding(f"{max(loaded)} of {flank.pins}", loaded == {flank.pins // 2})


def approximate_largest() -> Finding:
    """The largest pin force against its closed form."""
    K = FLANK.trochoid_ratio
    about, found = 4.0 * TORQUE / (K * FLANK.pin_circle_radius * FLANK.lobes), float(pin_forces().max())
    return Finding(
        f"{about:.1f} N for {found:.1f} N, {100 * (about / found - 1):+.1f} %", abs(about / found - 1) < 4e-3
    )


def approximate_stiffness() -> Finding:
    """Rotational stiffness of many springs against its closed form."""
    flank = Cycloid(200, 199, 0.080, 1e-4, 2e-5)
    problem = springs(flank, 0.1, 1.0, np.zeros(flank.pins))
    found = float(tangent(problem, solve(problem))[0, 0])
    about = STIFFNESS * (flank.eccentricity * flank.lobes) ** 2 * flank.pins / 4.0
    close = abs(about / found - 1) < 1e-3
    return Finding(f"{'within' if close else 'more than'} 0.1 % with 200 pins, K = 0.05", close)


def undercut_limit() -> Finding:
    """The limit of the pin's radius against the least radius of curvature of its path, sampled."""
    bend = FLANK.center_path_curvature(np.linspace(0.0, 2.0 * math.pi / FLANK.lobes, 20001))
    sampled, closed = 1.0 / float(bend.max()), FLANK.undercut_radius
    return Finding(f"{1e3 * closed:.4f} mm, sampled the same", math.isclose(sampled, closed, rel_tol=1e-6))


def period() -> Finding:
    """Sorted pin forces a pin pitch later, and half of it later, which must differ."""
    pitch = 2.0 * math.pi / FLANK.pins
    here, later, half = (np.sort(pin_forces(crank=CRANK + share * pitch)) for share in (0.0, 1.0, 0.5))
    repeats = bool(np.abs(later - here).max() < 1e-6 < np.abs(half - here).max())
    return Finding(f"{math.degrees(pitch):.0f}° for {FLANK.pins} pins", repeats)


def ratios(*lobes: int) -> tuple[Fraction, ...]:
    """Ratios of drives with one pin more than lobes."""
    return tuple(speeds(khv_train(z + 1, z)).ratio for z in lobes)


def loaded(count: int) -> str:
    """Share of the turn by the number of pins that carry: "4: 100 %"."""
    steps = 28 * count  # at none of these places two pins are in line
    found = [loaded_at(count, Fraction(2 * j + 1, 2 * steps)) for j in range(steps)]
    return ", ".join(
        f"{n}: {round(100 * found.count(n) / len(found))} %" for n in sorted(set(found), reverse=True)
    )


def loaded_as_printed() -> Finding:
    """Whether the number of loaded output pins of 8 changes for more than instants."""
    right = loaded_output_pins(8)
    shown = f"8 pins: {loaded(8)}; {right.in_line} at {right.instants} instants; 7 pins: {loaded(7)}"
    return Finding(shown, right.least != right.most)


def rule_for_discs() -> Finding:
    """The printed rule against drives of n like discs on z_p pins with z_w output pins."""
    cases = ((2, 21, 8), (3, 20, 9), (2, 20, 7))
    alike = [distinct_discs(n, pins, pins - 1, holes) == 1 for n, pins, holes in cases]
    rule = [pins % 2 == 0 and pins % n == 0 for n, pins, _ in cases]
    words = [
        f"{n} discs, {pins} pins, {holes} output pins: {'alike' if same else 'not alike'}"
        for (n, pins, holes), same in zip(cases, alike, strict=True)
    ]
    return Finding("; ".join(words), alike == rule)


def ratio_of_2k_v() -> tuple[Fraction, Fraction]:
    """The printed ratio of the 2K-V drive and the right one."""
    z1, z2, z3, z4 = 12, 36, 39, 40
    right = speeds(rv_train(z1, z2, z3, z4), "ring", "sun", "carrier").ratio
    return 1 + Fraction(z2 * z3, z1 * (z4 - z3)), right

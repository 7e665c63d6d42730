"""Reactions and vibration over bearing and mount stiffness: python examples/stiffness_aware_reactions.py picture.svg

The cycloid drive, its discs rigid on springs, and the precessional drive: what stiffness does to their reactions.
"""

import argparse
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from trochoid import Run, load
from trochoid.drives.precessional.casing import casing_load, closed_record
from trochoid.drives.precessional.elastic import Elastic, respond
from trochoid.drives.precessional.members import bodies
from trochoid.drives.precessional.modes import critical_speeds, reduce
from trochoid.drives.precessional.yielding import output_mass
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point, vibrate
from trochoid.dynamics.wrench import Wrench

mpl.use("agg")
from matplotlib import pyplot as plt

options = argparse.ArgumentParser(description="One figure: reactions and vibration velocity over stiffness.")
options.add_argument("picture", type=Path)
options.add_argument("--points", type=int, default=31, help="bearing stiffnesses of the cycloid drive")
given = options.parse_args()
FOLDER = Path(__file__).parent
EFFECTS = 'effects=[{type="bearing_compliance"},{type="inertia"},{type="casing_on_mounts"}]'
BEARINGS = {"drive.input_shaft.bearing_stiffness": 3e5, "drive.output_flange.bearing_stiffness": 5e5}  # N/mm
MOUNTS = np.logspace(-3, 4, 71)  # times those of the scene
ANGLES = np.linspace(0.0, 2.0 * np.pi, 61)
figure: Any
axes: Any
figure, axes = plt.subplots(2, 2, figsize=(12, 8), layout="constrained")


def velocities(scene: Any, force: Wrench, base: float) -> list[float]:
    """Largest rms velocity (mm/s) of the casing's points over the stiffness of its mounts, as damped at any."""
    table, points = scene.casing, [Point(p.name, p.position) for p in scene.casing.points]
    found = []
    for f in MOUNTS:
        mounts = [
            Mount(m.position, tuple(f * k for k in m.stiffness), tuple(f**0.5 * c for c in m.damping))
            for m in table.mounts
        ]
        casing = Casing(table.mass, table.inertia, table.center, tuple(mounts))
        found.append(1e3 * vibrate(casing, force, base, points).rms_max)
    return found


def cycloid(factor: float) -> Any:
    """Stages of the cycloid drive, bearings of shaft and flange `factor` times as stiff; contacts are solved anew."""
    words = [f"{name}={float(factor * k)!r}" for name, k in BEARINGS.items()]
    asked = ["ask.quantities=['reactions']", "ask.positions=48"]
    return Run(load(FOLDER / "cycloid.toml", [EFFECTS, *asked, *words])).stages


def precessional(factor: float) -> Elastic:
    """Elastic motion of the precessional drive, all joints `factor` times as stiff."""
    held = stages.yielding.joints.times(float(factor))
    made = bodies(drive, design.speed, design.shaft_shape, held, output_mass(design))
    return respond(drive, made, design.speed, design.scene.operation.damping_ratio)


factors = np.logspace(-3, 2.5, given.points)
solved = [cycloid(factor) for factor in factors]
for name, member, at in (("shaft A", "shaft", 0), ("shaft B", "shaft", 1), ("flange B", "output", 1)):
    for model, style in (("elastic", "-"), ("rigid", "--")):
        forces = [getattr(s.reactions.fine, model)[member][:, at] for s in solved]
        sizes = [np.linalg.norm(force, axis=1).max() for force in forces]
        color = f"C{('shaft A', 'shaft B', 'flange B').index(name)}"
        axes[0, 0].semilogx(factors, sizes, style, color=color, label=name if model == "elastic" else None)
axes[0, 0].set(title="Cycloid drive", xlabel="stiffness of shaft and flange bearings, of the scene's")

stages: Any = Run(load(FOLDER / "precessional.toml")).stages
design, drive = stages.design, stages.mechanism
rigid = stages.reactions["rigid"]
softness = np.logspace(-3.5, 2, 6 * given.points)
moved = [precessional(factor) for factor in softness]
largest = {
    name: [each.reactions(ANGLES).magnitude(name).max() for each in moved] for name in ("R_A", "R_B", "R_O")
}
for i, (name, values) in enumerate(largest.items()):
    axes[0, 1].loglog(softness, values, color=f"C{i}", label=name)
    axes[0, 1].axhline(rigid.sizes[name].max(), ls="--", color=f"C{i}")
# with all joints f times as stiff, the critical speeds are those of the scene times the root of f
still = reduce(stages.yielding.bodies, design.speed)
for order, style in ((0.0, ":"), (2.0 * drive.tooth_ratio, "-.")):
    for place in (design.speed / np.array(critical_speeds(still, order))) ** 2:
        if place > softness[0]:
            axes[0, 1].axvline(place, ls=style, color="0.7", lw=0.9, zorder=0)
axes[0, 1].set(title="Precessional drive; grey: resonances", xlabel="stiffness of all joints, of the scene's")

scene = solved[0].scene
for i, color in ((int(np.argmin(np.abs(np.log(factors)))), "C0"), (0, "C1")):
    found, base = solved[i].reactions.fine, scene.operation.input_speed / (2.0 * np.pi)
    for model, force, style in (("elastic", found.casing, "-"), ("rigid", found.casing_rigid, "--")):
        label = f"{model}, bearings x {factors[i]:.2g}"
        axes[1, 0].loglog(MOUNTS, velocities(scene, force, base), style, color=color, label=label)
base = design.speed / (2.0 * np.pi * drive.nutation.closing_turns)
for factor in (1.0, 0.1, 0.03):
    force = casing_load(precessional(factor).reactions(closed_record(drive)))
    axes[1, 1].loglog(MOUNTS, velocities(stages.scene, force, base), label=f"elastic, joints x {factor:g}")
axes[1, 1].loglog(MOUNTS, velocities(stages.scene, rigid.load, base), "k--", label="rigid")

for ax in axes.flat:
    ax.axvline(1.0, color="0.7", lw=0.9, zorder=0)
    ax.legend(title="dashed: rigid", fontsize=9)
    ax.grid(alpha=0.3)
for upper, lower in axes.T:
    upper.set_ylabel("largest reaction (N)")
    lower.set(xlabel="stiffness of the mounts, of the scene's", ylabel="vibration velocity (mm/s rms)")
figure.savefig(given.picture)

change = [np.abs(s.reactions.fine.elastic["shaft"] - s.reactions.fine.rigid["shaft"]).max() for s in solved]
print(f"cycloid: reactions of the shaft, elastic less rigid: {change[0]:.3g} N with the softest bearings,")
print(f"  {change[-1]:.3g} N with the stiffest, where the contacts alone yield")
print(f"precessional: R_A up to {max(largest['R_A']):.4g} N at a resonance; with the stiffest joints")
print(f"  {largest['R_A'][-1]:.7g} N, rigid {rigid.sizes['R_A'].max():.7g} N")
print(f"wrote {given.picture}")

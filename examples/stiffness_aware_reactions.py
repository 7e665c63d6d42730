"""Reactions and vibration over bearing and mount stiffness: python examples/stiffness_aware_reactions.py picture.svg

The cycloid drive with rigid discs on springs, and the precessional drive: what stiffness does to their reactions.
"""

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np

from trochoid import Run, load
from trochoid.drives.precessional.members import bodies
from trochoid.drives.precessional.elastic import respond
from trochoid.drives.precessional.modes import critical_speeds, reduce
from trochoid.drives.precessional.turn import turns
from trochoid.drives.precessional.yielding import output_mass
from trochoid.dynamics.casing import Casing, Mount
from trochoid.dynamics.vibration import Point, vibrate

mpl.use("agg")
from matplotlib import pyplot as plt

options = argparse.ArgumentParser(description="One figure: reactions and vibration velocity over stiffness.")
options.add_argument("picture", type=Path)
options.add_argument("--points", type=int, default=31, help="bearing stiffnesses of the cycloid drive")
given = options.parse_args()
FOLDER = Path(__file__).parent
EFFECTS = 'effects=[{type="bearing_compliance"},{type="inertia"},{type="casing_on_mounts"}]'
MOUNTS = np.logspace(-3, 4, 141)  # times those of the scene


def velocity(scene, load_, base, factor):
    """Largest rms velocity (mm/s) of the casing's points, every mount `factor` times as stiff and evenly damped."""
    table = scene.casing
    mounts = [
        Mount(m.position, tuple(factor * k for k in m.stiffness), tuple(factor**0.5 * c for c in m.damping))
        for m in table.mounts
    ]
    casing = Casing(table.mass, table.inertia, table.center, tuple(mounts))
    return 1e3 * vibrate(casing, load_, base, [Point(p.name, p.position) for p in table.points]).rms_max


def cycloid(factor, positions=48):
    """The cycloid drive's reactions with shaft and flange bearings `factor` times as stiff; contacts are solved anew."""
    shaft, flange = (float(factor * k) for k in (3e5, 5e5))  # N/mm
    words = [f"drive.input_shaft.bearing_stiffness={shaft!r}", f"drive.output_flange.bearing_stiffness={flange!r}"]
    asked = ["ask.quantities=['reactions']", f"ask.positions={positions}"]
    return Run(load(FOLDER / "cycloid.toml", [EFFECTS, *asked, *words])).stages


def precessional(stages, factor):
    """The precessional drive's reactions by model, all joints `factor` times as stiff."""
    design, drive = stages.design, stages.mechanism
    held = stages.yielding.joints.times(factor)
    made = bodies(drive, design.speed, design.shaft_shape, held, output_mass(design))
    found = respond(drive, made, design.speed, design.scene.operation.damping_ratio)
    return turns(drive, design.speed, found), reduce(made, design.speed)


figure, ((left, right), (below_left, below_right)) = plt.subplots(2, 2, figsize=(12, 8), layout="constrained")

factors = np.logspace(-3.5, 2.5, given.points)
solved = [cycloid(factor) for factor in factors]
for member, at, name in (("shaft", 0, "shaft A"), ("shaft", 1, "shaft B"), ("output", 1, "flange B")):
    size = {
        model: [np.linalg.norm(getattr(s.reactions.fine, model)[member][:, at], axis=1).max() for s in solved]
        for model in ("elastic", "rigid")
    }
    (line,) = left.semilogx(factors, size["elastic"], label=name)
    left.semilogx(factors, size["rigid"], "--", color=line.get_color(), alpha=0.6)
change = [np.abs(s.reactions.fine.elastic["shaft"] - s.reactions.fine.rigid["shaft"]).max() for s in solved]
left.set(title="Cycloid drive", xlabel="stiffness of shaft and flange bearings, of the scene's", ylabel="largest reaction (N)")

stages = Run(load(FOLDER / "precessional.toml")).stages
factors_p = np.logspace(-4.5, 2, 261)
found = [precessional(stages, factor) for factor in factors_p]
for name in ("R_A", "R_B", "R_O"):
    (line,) = right.loglog(factors_p, [turn["elastic"].sizes[name].max() for turn, _ in found], label=name)
    right.axhline(found[-1][0]["rigid"].sizes[name].max(), ls="--", color=line.get_color(), alpha=0.6)
# a critical speed goes with the square root of a stiffness that is the same factor everywhere
speed, q = stages.design.speed, stages.mechanism.tooth_ratio
for order, style in ((0.0, ":"), (2.0 * q, "-.")):
    for critical in critical_speeds(found[-1][1], order):
        place = factors_p[-1] * (speed / critical) ** 2
        if place > factors_p[0]:
            right.axvline(place, ls=style, color="0.7", lw=0.9, zorder=0)
right.set(title="Precessional drive", xlabel="stiffness of all joints, of the scene's", ylabel="largest reaction (N)")

scene = solved[0].scene
for i, color in ((int(np.argmin(np.abs(factors - f))), c) for f, c in ((1.0, "C0"), (1e-3, "C1"))):
    found_c, base = solved[i].reactions.fine, scene.operation.input_speed / (2 * np.pi)
    for load_, style, name in ((found_c.casing, "-", "elastic"), (found_c.casing_rigid, "--", "rigid")):
        label = f"{name}, bearings x {factors[i]:.2g}"
        below_left.loglog(MOUNTS, [velocity(scene, load_, base, f) for f in MOUNTS], style, color=color, label=label)
base = speed / (2 * np.pi * stages.mechanism.nutation.closing_turns)
loads = {f"elastic, joints x {f:g}": precessional(stages, f)[0]["elastic"].load for f in (1.0, 0.1, 0.03)}
loads["rigid"] = found[-1][0]["rigid"].load
for name, load_ in loads.items():
    values = [velocity(stages.scene, load_, base, f) for f in MOUNTS]
    below_right.loglog(MOUNTS, values, "--" if name == "rigid" else "-", color="k" if name == "rigid" else None, label=name)
for axes in (below_left, below_right):
    axes.axvline(1.0, color="0.7", lw=0.9, zorder=0)
    axes.set(xlabel="stiffness of the mounts, of the scene's", ylabel="vibration velocity (mm/s rms)")
for axes, title in ((left, "dashed: rigid"), (right, "dashed: rigid; grey: resonances"), (below_left, ""), (below_right, "")):
    axes.legend(title=title, fontsize=9)
    axes.grid(alpha=0.3)
figure.savefig(given.picture)

last = solved[-1].reactions.fine
print(f"cycloid: elastic less rigid reactions of the shaft at most {change[0]:.3g} N with the softest bearings,")
print(f"  {change[-1]:.3g} N with the stiffest, where the contacts alone yield; {last.reason}")
sizes = {name: [turn["elastic"].sizes[name].max() for turn, _ in found] for name in ("R_A", "R_B")}
rigid = found[-1][0]["rigid"].sizes["R_A"].max()
print(f"precessional: R_A at most {max(sizes['R_A']):.4g} N, with the stiffest joints {sizes['R_A'][-1]:.7g}, rigid {rigid:.7g} N")
print(f"wrote {given.picture}")

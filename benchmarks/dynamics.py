"""What dynamics costs: bearing matrices, stiffness-aware reactions, harmonic balance over many speeds.

Targets are for processor time on one thread.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from benchmarks.table import Row, Table
from trochoid.clock import Clock
from trochoid.drives.khv.reactions import reactions
from trochoid.drives.khv.stages import Stages
from trochoid.dynamics.harmonic_balance import Periodic
from trochoid.dynamics.local_law import Local, varying
from trochoid.dynamics.sweep import sweep
from trochoid.dynamics.system import System
from trochoid.fem.bearing import six_by_six
from trochoid.fem.rolling import stiffness
from trochoid.fem.rolling_assumed import assumed_ball_bearing
from trochoid.fem.rolling_equilibrium import solve
from trochoid.fem.rolling_roller import RollerRow, logarithmic
from trochoid.kinematics.types import ComplexArray
from trochoid.scene import load

SCENE = Path(__file__).parents[1] / "examples" / "cycloid.toml"
PRECESSIONAL = SCENE.with_name("precessional.toml")
ROLLERS, POSITIONS, COORDINATES, HARMONICS, SPEEDS = 20, 360, 30, 10, 200
PLAY = 1e-6  # m
LOADED = 450.0  # N of the 500 N that press the teeth, varying: they leave each other
MATRIX, REACTIONS, BALANCE = 1.0, 2.0, 10.0  # ms, s, s


def measure() -> list[Table]:
    """Time bearings, reactions and harmonic balance."""
    return [_bearings(), _reactions(), _balance()]


def timed(do: Callable[[], object], repeats: int) -> tuple[float, float]:
    """Return wall and processor seconds, each the least of several times."""
    wall, processor = [], []
    for _ in range(repeats):
        start = perf_counter(), process_time()
        do()
        wall.append(perf_counter() - start[0])
        processor.append(process_time() - start[1])
    return min(wall), min(processor)


def _bearings() -> Table:
    """Stiffness of a roller bearing at a displacement; equilibrium under a load."""
    rollers = RollerRow(ROLLERS, 8e-3, 70e-3, 10e-3, drop=logarithmic(8e-3, 10e-3))
    at = np.array([0.0, 1e-5, 0.0, 1e-4, 0.0])
    ball = assumed_ball_bearing(30e-3, 55e-3, 13e-3)
    load_ = np.array([0.0, 2000.0, 0.0, 0.0, 0.0])
    matrix = timed(lambda: six_by_six(stiffness(rollers, at)), 200)
    # what dynamics asks for in one go: the matrices of a whole turn
    turn = timed(lambda: stiffness(rollers, np.tile(at, (POSITIONS, 1))), 5)
    found = timed(lambda: solve(ball, load_), 20)
    rows = (
        Row(f"6×6 stiffness of a bearing with {ROLLERS} rollers", 1e3 * matrix[1], "ms", MATRIX),
        Row("the same, wall time", 1e3 * matrix[0], "ms"),
        Row(f"each of {POSITIONS} side by side", 1e3 * turn[1] / POSITIONS, "ms"),
        Row("equilibrium of a ball bearing under a load", 1e3 * found[1], "ms"),
    )
    return Table("rolling bearings", "30 slices per roller, logarithmic profile; least of many", rows)


def _reactions() -> Table:
    """Stiffness-aware reactions once the contacts are known, and of a drive that has none."""
    effects = ("bearing_compliance", "inertia", "casing_on_mounts")
    listed = f"effects=[{','.join(f'{{type={name!r}}}' for name in effects)}]"
    stages = Stages(
        load(SCENE, [listed, f"ask.positions={POSITIONS}", 'ask.quantities=["reactions"]']), Clock()
    )
    start = process_time()
    series = stages.contact.fine
    contacts = process_time() - start
    masses = stages.masses
    wall, processor = timed(lambda: reactions(stages.design, series, masses, 0.02), 3)
    rows = [
        Row(f"cycloid drive, {POSITIONS} positions, beyond the contacts", processor, "s", REACTIONS),
        Row("the same, wall time", wall, "s"),
        Row("the contacts, rigid discs on springs", contacts, "s"),
        Row("share of the contacts", processor / contacts),
    ]
    return Table(
        "stiffness-aware reactions", f"{len(series.names)} motions, all harmonics", (*rows, *_precessional())
    )


def _precessional() -> tuple[Row, ...]:
    from trochoid.drives.precessional.stages import Stages as Precessional
    from trochoid.drives.precessional.turn import turns
    from trochoid.drives.precessional.yielding import yielding

    def made(*words: str) -> Precessional:
        return Precessional(load(PRECESSIONAL, words), Clock())

    stages, plain = made(), made('effects=[{type="inertia"}]', 'ask.quantities=["reactions"]')
    drive, speed = stages.mechanism, stages.design.speed
    elastic = timed(lambda: yielding(stages.design, drive), 3)[1]
    over = timed(lambda: turns(drive, speed, stages.elastic), 3)[1]
    rigid = timed(lambda: turns(plain.mechanism, speed, plain.elastic), 3)[1]
    return (
        Row("precessional drive: bearings under load, members on them", elastic, "s"),
        Row("its reactions over a turn by three models", over, "s"),
        Row("without the effect, by two", rigid, "s"),
    )


def _balance() -> Table:
    """A chain with two meshes whose stiffness varies and that have play, swept over the speed."""
    system, locals_, loads = chain()
    speeds = np.linspace(0.2, 1.2, SPEEDS) * float(system.modes.angular_frequencies[-1]) / HARMONICS
    found: list[tuple[Periodic, ...]] = []
    wall, processor = timed(lambda: found.append(sweep(system, locals_, loads, speeds)), 1)
    steps = sum(each.iterations for each in found[-1])
    apart = sum(bool((each.deflection < PLAY).any()) for each in found[-1])
    rows = (
        Row(f"{COORDINATES} coordinates, {HARMONICS} harmonics, {SPEEDS} speeds", processor, "s", BALANCE),
        Row("the same, wall time", wall, "s"),
        Row("Newton's steps at a speed", steps / SPEEDS),
        Row("share of the speeds at which teeth leave each other", apart / SPEEDS),
    )
    return Table("harmonic balance", "two meshes with play and varying stiffness, a sweep up", rows)


def chain() -> tuple[System, list[Local], Callable[[float], ComplexArray]]:
    """Return masses on springs to the ground and to each other, two of the links with play, and their loads."""
    n = COORDINATES
    stiffness_ = 2e8 * (np.diag(np.full(n, 2.0)) - np.eye(n, k=1) - np.eye(n, k=-1)) + 1e6 * np.eye(n)
    mass = np.eye(n)
    system = System(mass, 2e-5 * stiffness_ + 20.0 * mass, stiffness_)
    waves = 1.0 + 0.2 * np.cos(2.0 * np.pi * np.arange(32) / 32)
    locals_ = []
    for i in (9, 19):
        direction = np.zeros(n)
        direction[i], direction[i + 1] = 1.0, -1.0
        law = varying(1e8 * waves, half_gap=PLAY)
        locals_.append(Local(f"mesh {i}", direction, law, 1e8, PLAY))

    def loads(speed: float) -> ComplexArray:
        lines = np.zeros((HARMONICS + 1, n), dtype=np.complex128)
        lines[0, [9, 10, 19, 20]] = 500.0, -500.0, 500.0, -500.0
        lines[1, [9, 10]] = LOADED, -LOADED
        return lines

    return system, locals_, loads

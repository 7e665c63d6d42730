"""The torque-twist path of a drive whose input is held: from no torque to the output's, to its opposite and back."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from trochoid.drives.khv.contact import assembly, layout, plane
from trochoid.drives.khv.design import Design
from trochoid.drives.khv.running import coefficients, kind_of
from trochoid.fem.newton import ROUNDING
from trochoid.fem.position import Assembly, Contact, ElasticBody, solve_positions
from trochoid.fem.sticking import Held, begun, landed, loaded, reversed_to, smooth
from trochoid.kinematics.errors import Infeasible, NotConverged
from trochoid.kinematics.types import Array, frozen

LOST = 0.03  # share of the rated torque at which catalogues measure lost motion
NEAR = 1e-4  # share that stands for zero: the sides of the play
SHARES = (NEAR, LOST, 0.1, 0.25, 0.5, 0.75, 0.9, 0.97, 1.0)
SPLITS = 5  # of a step of the torque in two
HELD = 3  # input angles, evenly over the pitch of the pins


@dataclass(frozen=True, slots=True)
class LoadPath:
    """Twist (n, m) in rad of the driven member at held input angles (n,) in rad, along a path of m torques.

    `share` (m,) of the output torque: up to 1 (the first `first`), from 1 to −1, from −1 to 1. `lost` (n, m) in J is
    what friction has taken since the beginning.
    """

    angle: Array
    share: Array
    first: int
    twist: Array
    lost: Array

    @property
    def falling(self) -> slice:
        """The branch from 1 to −1, both ends included."""
        return slice(self.first - 1, self.first - 1 + 2 * self.first)

    @property
    def rising(self) -> slice:
        """The branch from −1 to 1, both ends included."""
        return slice(self.first + 2 * self.first - 2, None)


def path_of(shares: tuple[float, ...]) -> Array:
    """Return the path (m,): up through the shares, down to their opposites, and up again."""
    up = np.array(shares)
    branch = np.concatenate([up[::-1], -up])
    return np.concatenate([up, branch[1:], -branch[1:]])


def load_path(
    design: Design,
    rung: str,
    bodies: tuple[ElasticBody, ...],
    angles: Array,
    shares: tuple[float, ...] = SHARES,
) -> LoadPath:
    """Follow the path at input angles (n,) in rad; nothing turns, so nothing has inertia. Raises NotConverged."""
    _fail_if_faint(design)
    problem = assembly(design, rung, bodies, angles * design.mesh_speed)
    row = layout(design, rung).names.index("output.rotation")
    unit = np.zeros_like(problem.load)
    unit[:, row] = design.flange_torque
    problem, share = replace(problem, load=unit), path_of(shares)
    rubs = {kind: mu for kind, mu in coefficients(design).items() if mu > 0}
    try:
        twist, lost = _rubbed(problem, rubs, share, row) if rubs else _free(problem, rung, share, row)
    except NotConverged as fault:
        where = (
            "" if fault.row is None else f" at input angle {np.degrees(angles[fault.row % len(angles)]):.6g}°"
        )
        raise NotConverged(f"load path{where}: {fault}") from fault
    return LoadPath(frozen(angles), frozen(share), len(shares), frozen(twist / design.leverage), frozen(lost))


def _fail_if_faint(design: Design) -> None:
    """Refuse a torque of which the smallest share presses less than the coordinates' rounding does."""
    radius = design.flank.pin_circle_radius
    noise = ROUNDING * radius * design.drive.face_width / plane(design).kernel
    least = noise * radius / NEAR * design.leverage
    torque = design.scene.operation.output_torque
    if abs(torque) < least:
        raise Infeasible(
            f"load path: under {NEAR:g} of operation.output_torque = {torque:g} N·m contacts press less than rounding "
            f"does; give at least {least:.1g} N·m, or do not ask for lost motion and what goes with it"
        )


def _free(problem: Assembly, rung: str, share: Array, row: int) -> tuple[Array, Array]:
    """Without friction each torque has its own twist, whatever came before."""
    once, back = np.unique(share, return_inverse=True)
    count, resolve = len(problem.load), rung == "strips"
    rows = np.tile(np.arange(count), len(once))
    many = replace(problem.rows(rows), load=np.repeat(once, count)[:, None] * problem.load[rows])
    try:
        found = solve_positions(many, resolve).motion[:, row].reshape(len(once), count)
    except NotConverged:
        found = np.stack([descended(problem, float(part), resolve).motion[:, row] for part in once])
    twist = found.T[:, back]
    return twist, np.zeros_like(twist)


def descended(problem: Assembly, part: float, resolve: bool = False) -> Contact:
    """Solve under a share of the torque without friction: at once, or coming down from the full torque in steps.

    A drive that floats in its play is hard to find from nothing; each step finds it near the last one.
    """
    target = replace(problem, load=part * problem.load)
    try:
        return solve_positions(target, resolve)
    except NotConverged:
        if abs(part) == 1.0:
            raise
    found = None
    for share in np.geomspace(1.0, abs(part), 2 + int(np.log(1 / abs(part)))):
        found = solve_positions(replace(problem, load=np.sign(part) * share * problem.load), resolve, found)
    assert found is not None
    return found


def _rubbed(problem: Assembly, coefficients: dict[str, float], share: Array, row: int) -> tuple[Array, Array]:
    """Follow the torque step by step; where it turns round, other flanks touch. The path begins and turns at `NEAR`."""
    by_family = {
        f.name: coefficients[kind_of(f.name)] for f in problem.families if kind_of(f.name) in coefficients
    }
    free = {sign: smooth(descended(problem, sign * NEAR), problem) for sign in (1.0, -1.0)}
    here, last, held = landed(problem, begun(problem, by_family), by_family, free[1.0]), NEAR, list[Held]()
    for part in share:
        if last * part < 0:
            target = replace(problem, load=part * problem.load)
            here, last = reversed_to(target, here, by_family, free[float(np.sign(part))]), float(part)
        for next_part in between(last, float(part)):
            here = _stepped(problem, here, (last, next_part), by_family, SPLITS)
            last = next_part
        held.append(here)
    twist = np.stack([h.point.motion[:, row] for h in held], axis=1)
    return twist, np.stack([h.lost for h in held], axis=1)


def between(last: float, part: float) -> list[float]:
    """Return the shares on the way from one to another: unloading goes in steps that leave a third at the least."""
    if part == last:
        return []
    if abs(part) >= abs(last) / 3:
        return [part]
    count = int(np.ceil(np.log(last / part) / np.log(3)))
    return [float(x) for x in np.geomspace(last, part, count + 1)[1:-1]] + [part]


def _stepped(
    problem: Assembly, here: Held, step: tuple[float, float], coefficients: dict[str, float], splits: int
) -> Held:
    """Go from one share of the torque to another, in two steps where one does not find who slips."""
    last, part = step
    target = replace(problem, load=part * problem.load)
    try:
        return loaded(target, here, coefficients)
    except NotConverged:
        if splits == 0:
            raise
    middle = float(np.sign(part) * np.sqrt(last * part))
    here = _stepped(problem, here, (last, middle), coefficients, splits - 1)
    return _stepped(problem, here, (middle, part), coefficients, splits - 1)


def held_angles(design: Design) -> Array:
    """Return the input angles (n,) at which the drive is held."""
    pitch = 2 * np.pi / design.flank.pins / abs(design.mesh_speed)
    return np.asarray(pitch * np.arange(HELD) / HELD)

"""The contact problem: complementarity to rounding, against a QP library, and the invariants it must keep."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trochoid.fem.complementarity import Group, Problem, Solution, solve, tangent
from trochoid.fem.rows import joined, taken
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array


@dataclass(frozen=True)
class Dense:
    """A problem without its block structure: C, g, R over all strips."""

    compliance: Array
    gap: Array
    arms: Array

    @staticmethod
    def of(problem: Problem) -> Dense:
        counts = [g.gap.shape for g in problem.groups]
        size = sum(c * m for c, m in counts)
        total = np.zeros((len(problem.coupling), size))  # strips → totals of the contacts
        compliance, at, contact = np.zeros((size, size)), 0, 0
        for group in problem.groups:
            for local in _blocks(group):
                m = len(local)
                compliance[at : at + m, at : at + m] = local
                total[contact, at : at + m] = 1.0
                at, contact = at + m, contact + 1
        compliance += total.T @ problem.coupling @ total
        gap = np.concatenate([g.gap.ravel() for g in problem.groups])
        arms = np.concatenate([g.arms.reshape(-1, g.arms.shape[-1]) for g in problem.groups])
        return Dense(compliance, gap, arms)

    def opening(self, solution: Solution) -> Array:
        return self.compliance @ _forces(solution) + self.gap - self.arms @ solution.motion


def _blocks(group: Group) -> Array:
    assert isinstance(group.local, np.ndarray)
    return group.local


def _forces(solution: Solution) -> Array:
    return np.concatenate([f.ravel() for f in solution.forces])


def _random(seed: int, held: bool = False, ratio: float = 1.0, motions: int = 3) -> Problem:
    """Return a random problem in which the load can be carried; with `held`, springs hold the motions as well."""
    rng = np.random.default_rng(seed)
    groups = []
    for strips, stiffer in ((1, 1.0), (int(rng.integers(2, 9)), ratio)):
        contacts = int(rng.integers(2, 7))
        half = rng.normal(size=(contacts, strips, strips + 2))
        local = (half @ half.transpose(0, 2, 1) + np.eye(strips)) / stiffer
        gap = rng.uniform(-0.5, 3.0, size=(contacts, strips))
        groups.append(Group(local, gap, rng.normal(size=(contacts, strips, motions))))
    count = sum(len(g.gap) for g in groups)
    half = rng.normal(size=(count, count))
    spring = rng.normal(size=(motions, motions))
    size = sum(g.gap.size for g in groups)
    pressed = rng.uniform(0, 2, size=size) * (rng.random(size) < 0.3)
    pressed[rng.integers(size)] = 1.0  # some load at least
    arms = np.concatenate([g.arms.reshape(-1, motions) for g in groups])
    springs = spring @ spring.T + 0.1 * np.eye(motions) if held else np.zeros((motions, motions))
    return Problem(tuple(groups), 0.2 * half @ half.T, springs, arms.T @ pressed)


def _residuals(problem: Problem, solution: Solution) -> tuple[float, float, float, float]:
    """Return imbalance, tension, penetration and p·w, each relative to the sizes that it is made of."""
    dense, p = Dense.of(problem), _forces(solution)
    w = dense.opening(solution)
    unit = 1 / np.abs(dense.arms).max(axis=0)
    length = float(np.abs(dense.gap - dense.arms @ solution.motion).max())
    force = np.abs(dense.arms).T @ np.abs(p) + np.abs(problem.springs) @ np.abs(solution.motion)
    rest = dense.arms.T @ p + problem.springs @ solution.motion - problem.load
    return (
        float((np.abs(rest) * unit).max() / (force * unit).max()),
        float(-p.min() / (force * unit).max()),
        float(-w.min() / length),
        float(np.abs(p * w).max() / ((force * unit).max() * length)),
    )


def _assert_alike(problem: Problem, solution: Solution, motion: Array) -> None:
    """Compare motions where strips are pressed: where few are, a motion is free within the gaps."""
    closed = Dense.of(problem).arms @ np.stack([solution.motion, motion], axis=-1)
    first, second = closed[_forces(solution) > 1e-9].T
    assert second == pytest.approx(first, abs=1e-10 * max(1.0, float(np.abs(closed).max())))


seeds = st.integers(0, 2**32 - 1)


@pytest.mark.exact
@settings(max_examples=150)
@given(seeds, st.booleans(), st.sampled_from([1e-6, 1e-3, 1.0, 1e3, 1e6]))
def test_solution_is_complementary_to_rounding(seed: int, held: bool, ratio: float) -> None:
    """w ≥ 0, p ≥ 0, p·w = 0, Rᵀp + Ka = F, each within 1e-12, up to stiffness ratios of 1e6."""
    problem = _random(seed, held, ratio)
    assert max(_residuals(problem, solve(problem))) <= 1e-12


@pytest.mark.independent
@settings(max_examples=40, deadline=None)
@given(seeds, st.booleans())
def test_solution_is_that_of_a_quadratic_program(seed: int, held: bool) -> None:
    """cvxopt's interior point method: min ½pᵀCp + gᵀp, p ≥ 0, with Rᵀp = F, or with the energy of springs."""
    from cvxopt import matrix, solvers

    problem = _random(seed, held)
    dense = Dense.of(problem)
    size = len(dense.gap)
    quadratic, linear = dense.compliance.copy(), dense.gap.copy()
    equal: tuple[object, ...] = ()
    if held:
        soft = np.linalg.inv(problem.springs)
        quadratic += dense.arms @ soft @ dense.arms.T
        linear -= dense.arms @ soft @ problem.load
    else:
        equal = (matrix(dense.arms.T.copy()), matrix(problem.load))
    options = {"show_progress": False, "abstol": 1e-13, "reltol": 1e-13, "feastol": 1e-12}
    answer = solvers.qp(
        matrix(quadratic),
        matrix(linear),
        matrix(-np.eye(size)),
        matrix(np.zeros(size)),
        *equal,
        options=options,
    )
    found = _forces(solve(problem))
    assert found == pytest.approx(np.asarray(answer["x"]).ravel(), abs=1e-6 * max(float(found.max()), 1e-3))


@pytest.mark.property
@settings(max_examples=60)
@given(seeds, st.floats(-9, 9), st.floats(-9, 9), st.booleans())
def test_units_do_not_matter(seed: int, length: float, force: float, held: bool) -> None:
    """Metres or millimetres, newtons or meganewtons: forces and motions only change their unit (1e-10)."""
    problem, m, n = _random(seed, held), 10.0**length, 10.0**force
    scaled = Problem(
        tuple(Group(g.local * m / n, g.gap * m, g.arms) for g in problem.groups),
        problem.coupling * m / n,
        problem.springs * n / m,
        problem.load * n,
    )
    plain, other = solve(problem), solve(scaled)
    assert _forces(other) / n == pytest.approx(_forces(plain), abs=1e-10 * float(_forces(plain).max()))
    _assert_alike(problem, plain, other.motion / m)


@pytest.mark.property
@settings(max_examples=60)
@given(seeds, st.floats(-6, 6))
def test_units_of_a_rotation_do_not_matter(seed: int, size: float) -> None:
    """Radians or arc minutes: a motion's unit changes its arms, its load and its value, nothing else."""
    problem, unit = _random(seed), np.array([1.0, 1.0, 10.0**size])
    turned = Problem(
        tuple(replace(g, arms=g.arms * unit) for g in problem.groups),
        problem.coupling,
        problem.springs,
        problem.load * unit,
    )
    plain, other = solve(problem), solve(turned)
    assert _forces(other) == pytest.approx(_forces(plain), abs=1e-10 * float(_forces(plain).max()))
    _assert_alike(problem, plain, other.motion * unit)


@pytest.mark.property
@settings(max_examples=40)
@given(seeds, st.randoms(use_true_random=False))
def test_order_of_contacts_does_not_matter(seed: int, random: object) -> None:
    """Contacts of each group in another order: the same forces in that order."""
    problem, rng = _random(seed), np.random.default_rng(seed)
    orders = [rng.permutation(len(g.gap)) for g in problem.groups]
    starts = np.cumsum([0] + [len(o) for o in orders])
    order = np.concatenate([s + o for s, o in zip(starts, orders, strict=False)])
    shuffled = Problem(
        tuple(Group(_blocks(g)[o], g.gap[o], g.arms[o]) for g, o in zip(problem.groups, orders, strict=True)),
        problem.coupling[np.ix_(order, order)],
        problem.springs,
        problem.load,
    )
    plain, other = solve(problem), solve(shuffled)
    for a, b, o in zip(plain.forces, other.forces, orders, strict=True):
        assert b == pytest.approx(a[o], abs=1e-11 * float(_forces(plain).max()))


@pytest.mark.property
@settings(max_examples=40)
@given(seeds, st.booleans())
def test_action_is_reaction(seed: int, held: bool) -> None:
    """Two bodies with arms ±R, one held by springs: what the springs carry is what the load pushes with."""
    problem = _random(seed, held)
    both = Problem(
        tuple(replace(g, arms=np.concatenate([g.arms, -g.arms], axis=-1)) for g in problem.groups),
        problem.coupling,
        np.block([[problem.springs, np.zeros((3, 3))], [np.zeros((3, 3)), np.eye(3)]]),
        np.concatenate([problem.load, np.zeros(3)]),
    )
    solution = solve(both)
    carried = problem.springs @ solution.motion[:3] + solution.motion[3:]
    assert carried == pytest.approx(problem.load, abs=1e-11 * max(float(np.abs(problem.load).max()), 1e-3))


@pytest.mark.property
@settings(max_examples=40)
@given(seeds, st.booleans())
def test_warm_start_is_cold_start(seed: int, held: bool) -> None:
    """Started from the solution of another load, the same forces and motion come out."""
    problem = _random(seed, held)
    cold = solve(problem)
    for start in (solve(replace(problem, load=1.3 * problem.load)), cold):
        warm = solve(problem, start)
        assert _forces(warm) == pytest.approx(
            _forces(cold), abs=1e-11 * max(float(_forces(cold).max()), 1e-3)
        )
        _assert_alike(problem, cold, warm.motion)


@pytest.mark.property
def test_reruns_are_bit_equal() -> None:
    """No randomness, no order of threads."""
    problem = _random(12, ratio=1e3)
    first, second = solve(problem), solve(problem)
    assert all(np.array_equal(a, b) for a, b in zip(first.forces, second.forces, strict=True))
    assert np.array_equal(first.motion, second.motion)


@pytest.mark.property
@settings(max_examples=40, deadline=None)
@given(seeds, st.booleans())
def test_tangent_is_the_slope_of_the_load(seed: int, held: bool) -> None:
    """A small load more moves by K⁻¹ of it while no strip changes sides; K is symmetric, positive semi-definite."""
    problem = _random(seed, held)
    solution = solve(problem)
    stiffness = tangent(problem, solution)
    assert np.array_equal(stiffness, stiffness.T)
    values = np.linalg.eigvalsh(stiffness)
    assert values[0] > -1e-9 * max(values[-1], 1e-300)
    if values[0] < 1e-6 * values[-1] or not problem.load.any():
        return  # a motion that touching strips do not resist: the load has no neighbour
    step = 1e-7 * problem.load
    up, down = (solve(replace(problem, load=problem.load + s)) for s in (step, -step))
    if any(not np.array_equal(a, b) for a, b in zip(up.active, down.active, strict=True)):
        return  # a strip changes sides here: one-sided slopes differ
    moved = up.motion - down.motion
    assert stiffness @ moved == pytest.approx(2 * step, abs=1e-5 * float(np.abs(step).max()))


@pytest.mark.property
@settings(max_examples=30, deadline=None)
@given(seeds, st.booleans())
def test_more_load_moves_further(seed: int, held: bool) -> None:
    """The work-conjugate motion grows with the load factor (a convex problem), however the contacts change."""
    problem = _random(seed, held)
    path = [
        float(problem.load @ solve(replace(problem, load=f * problem.load)).motion)
        for f in (0.1, 0.3, 1.0, 3.0, 10.0)
    ]
    assert np.all(np.diff(path) >= -1e-9 * max(np.abs(path)))


def _one(gap: float, load: float, spring: float = 0.0) -> Problem:
    """Return one contact of compliance 2 on one motion."""
    group = Group(np.full((1, 1, 1), 2.0), np.full((1, 1), gap), np.ones((1, 1, 1)))
    return Problem((group,), np.full((1, 1), 0.5), np.full((1, 1), spring), np.array([load]))


@pytest.mark.exact
@pytest.mark.parametrize(
    ("gap", "load", "spring"), [(0.3, 2.0, 0.0), (-0.3, 2.0, 0.0), (0.3, 2.0, 4.0), (0.7, 2.0, 4.0)]
)
def test_one_contact_in_closed_form(gap: float, load: float, spring: float) -> None:
    """p = (F − K g)/(1 + K C) or 0 on a spring K, C = 2.5; without one p = F and the motion is C F + g."""
    solution = solve(_one(gap, load, spring))
    force = max(0.0, (load - spring * gap) / (1 + 2.5 * spring))
    assert float(solution.forces[0][0, 0]) == pytest.approx(force, abs=1e-12)
    motion = 2.5 * force + gap if force > 0 else load / spring
    assert float(solution.motion[0]) == pytest.approx(motion, rel=1e-12)


@pytest.mark.exact
@pytest.mark.parametrize("gap", [0.0, 1e-9, 1.0, 1e6])
def test_nothing_pressed_nothing_carried(gap: float) -> None:
    """No load, all contacts open, however far: no force, no motion, no complaint."""
    problem = _random(7)
    opened = replace(
        problem, load=np.zeros(3), groups=tuple(replace(g, gap=np.abs(g.gap) + gap) for g in problem.groups)
    )
    solution = solve(opened)
    assert not np.any(_forces(solution) > 0)
    assert not np.any(solution.motion)
    assert not np.any(tangent(opened, solution))


@pytest.mark.exact
def test_huge_clearance_is_closed_by_the_load() -> None:
    """A kilometre of play in a contact that yields a micrometre: it is closed, and the force is the load."""
    group = Group(np.full((1, 1, 1), 1e-9), np.full((1, 1), 1e3), np.ones((1, 1, 1)))
    solution = solve(Problem((group,), np.zeros((1, 1)), np.zeros((1, 1)), np.array([1e3])))
    assert float(solution.forces[0][0, 0]) == pytest.approx(1e3, rel=1e-9)
    assert float(solution.motion[0]) == pytest.approx(1e3 + 1e-6, rel=1e-15)


@pytest.mark.exact
def test_strip_that_can_never_touch() -> None:
    """An infinite gap is a strip off the edge: the rest solves as if it were not there."""
    problem = _random(3)
    whole = problem.groups[1]
    local = np.pad(_blocks(whole), ((0, 0), (0, 1), (0, 1)))
    local[:, -1, -1] = 1.0
    more = Group(
        local,
        np.concatenate([whole.gap, np.full((len(whole.gap), 1), np.inf)], axis=1),
        np.concatenate([whole.arms, np.ones((len(whole.gap), 1, 3))], axis=1),
    )
    plain, other = solve(problem), solve(replace(problem, groups=(problem.groups[0], more)))
    assert other.forces[1][:, :-1] == pytest.approx(plain.forces[1], abs=1e-11)
    assert not other.forces[1][:, -1].any()


def _idle(spring: float) -> tuple[Problem, Solution]:
    """A pressed contact and an open one, whose motion rests on a spring and starts elsewhere; contacts yield 2."""
    arms = np.array([[[1.0, 0.0]], [[0.0, 1.0]]])
    group = Group(np.full((2, 1, 1), 2.0), np.array([[0.0], [1.0]]), arms)
    problem = Problem((group,), np.zeros((2, 2)), np.diag([0.0, spring]), np.array([1.0, 0.0]))
    none = np.zeros(())
    start = Solution((), np.array([0.0, 0.5]), (np.array([[0], [-1]]),), none.astype(int), none, none)
    return problem, start


@pytest.mark.exact
@pytest.mark.parametrize("spring", [1e-6, 1e-9, 1e-10, 1e-11, 1e-12])
def test_idle_member_on_a_faint_spring_comes_home(spring: float) -> None:
    """A member that nothing presses hangs on a spring 1e12 times softer than contacts: it is no fault, Ka = 0."""
    problem, start = _idle(spring)
    solution = solve(problem, start)
    assert float(solution.forces[0][0, 0]) == pytest.approx(1.0, rel=1e-12)
    assert not solution.forces[0][1].any()
    assert spring * abs(solution.motion[1]) < 1e-13


def _carried(spring: float) -> Problem:
    """A contact of compliance 2, overlapping by 3, and a load of 1 on a member; a stiff spring joins it to another
    member on a ground spring of 0.1, and both move by about 0.83.
    """
    group = Group(np.full((1, 1, 1), 2.0), np.array([[-3.0]]), np.array([[[1.0, 0.0]]]))
    springs = np.array([[spring, -spring], [-spring, spring + 0.1]])
    return Problem((group,), np.zeros((1, 1)), springs, np.array([1.0, 0.0]))


@pytest.mark.exact
@pytest.mark.parametrize("spring", [1.0, 1e3, 1e6])
def test_stiff_spring_between_members_that_move_together(spring: float) -> None:
    """p = (F + K g)/(1 + K C) with K of both springs in series: large terms cancel to 1, and nothing lacks support."""
    solution = solve(_carried(spring))
    series = 1.0 / (1.0 / spring + 1.0 / 0.1)
    assert float(solution.forces[0][0, 0]) == pytest.approx(
        (1.0 + 3.0 * series) / (1.0 + 2.0 * series), rel=1e-9
    )


@pytest.mark.property
def test_spring_that_rounding_hides_is_refused() -> None:
    """1e12 times the contact's stiffness: the message says how stiff is too stiff, and that much is solved."""
    with pytest.raises(NotConverged, match=r"1\.0e\+12 N/m .* take 7e\+05 N/m at most"):
        solve(_carried(1e12))
    assert solve(_carried(7e5)).imbalance < 1e-9


def _opening_motion(problem: Problem) -> Problem:
    return replace(
        problem,
        load=np.array([1.0, 0.0, -5.0]),
        groups=tuple(replace(g, arms=g.arms * [1, 1, 0]) for g in problem.groups),
    )


@pytest.mark.property
@pytest.mark.parametrize(
    ("spoil", "number"),
    [(_opening_motion, 2), (lambda p: replace(_one(0.1, -3.0)), 0)],
)
def test_load_that_nothing_resists_is_refused(spoil: Callable[[Problem], Problem], number: int) -> None:
    """A motion no contact acts on, or a load that pulls a contact open: NotConverged names motion and load."""
    problem = spoil(_random(21))
    with pytest.raises(NotConverged, match=rf"motion {number} .*{problem.load[number]:g}"):
        solve(problem)


@pytest.mark.exact
def test_flat_punch_has_the_pressure_of_a_rigid_one() -> None:
    """Johnson (2.64): a rigid flat punch, p = P/(π√(a²−x²)); strips, no curvature, singular at both edges."""
    from trochoid.fem.strips import strip_centres, strip_compliance

    count = 401
    x = strip_centres(count)
    local = strip_compliance(np.array([1.0]), np.array([2.0 / count]), count)
    group = Group(local, np.zeros((1, count)), np.ones((1, count, 1)))
    solution = solve(Problem((group,), np.zeros((1, 1)), np.zeros((1, 1)), np.ones(1)))
    pressure = solution.forces[0][0] * count / 2
    inner = np.abs(x) < 0.8
    assert pressure[inner] == pytest.approx(1 / (np.pi * np.sqrt(1 - x[inner] ** 2)), rel=3e-3)


@pytest.mark.property
@pytest.mark.parametrize("stuck", [0, 1])
def test_position_that_does_not_settle_is_named_beside_one_that_does(
    stuck: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where steps run out while another position has just settled, the one that has not is named, and it alone."""
    from trochoid.fem import complementarity

    hard, easy = _carried(1e6), _carried(1.0)
    rows = [hard, easy] if stuck == 0 else [easy, hard]
    both = joined([(np.array([i]), taken(one, None)) for i, one in enumerate(rows)])
    steps = next(n for n in range(1, 60) if not _faults(both, n, monkeypatch).keys() & {1 - stuck})
    found = _faults(both, steps, monkeypatch)
    assert found.keys() == {stuck}
    assert "a spring of 1.0e+06 N/m" in found[stuck]
    with pytest.raises(NotConverged) as fault:
        complementarity.solve_all(both)
    assert fault.value.row == stuck


def _faults(problem: Problem, steps: int, monkeypatch: pytest.MonkeyPatch) -> dict[int, str]:
    """Return what is said of positions when that many proximal steps are all."""
    from trochoid.fem import complementarity

    monkeypatch.setattr(complementarity, "STEPS", steps)
    return complementarity.attempt(problem, None).faults

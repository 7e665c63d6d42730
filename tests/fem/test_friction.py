"""Friction: Cattaneo and Mindlin, superposition strip by strip, enumeration, and Coulomb's conditions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from trochoid.fem import complementarity as lcp
from trochoid.fem.friction import Rubbed, Rubbing, System, run, step
from trochoid.fem.strips import strip_centres, strip_compliance
from trochoid.kinematics.errors import NotConverged
from trochoid.kinematics.types import Array, IntArray

KERNEL, CURVE = 5e-10, 0.01  # A = Σ 2/(πE'b) in m/N, combined radius in m
PRESS = 2000.0  # N
WIDE = float(np.sqrt(2 * KERNEL * PRESS * CURVE))  # Hertz's half-width
STRIPS = 81


def cylinder(press: float, push: float, friction: float, count: int = STRIPS, reach: float = 1.1) -> System:
    """Return two cylinders pressed together, the first pushed along its tangent; motions: approach, shift."""
    offset = strip_centres(count) * reach * WIDE
    local = strip_compliance(np.array([KERNEL]), np.array([2 * reach * WIDE / count]), count)
    gap = offset[None] ** 2 / (2 * CURVE)
    ones, zeros = np.ones((1, count)), np.zeros((1, count))
    normal = lcp.Group(local, gap, np.stack([ones, zeros], axis=-1))
    tangential = lcp.Group(local, zeros, np.stack([zeros, -ones], axis=-1))
    return System(
        (Rubbing(normal, tangential, friction),), np.zeros((2, 2)), np.zeros((2, 2)), np.array([press, push])
    )


def frictionless(press: float, count: int = STRIPS) -> tuple[Array, float]:
    """Return pressures and approach under a normal load; nothing without one."""
    if press == 0.0:
        return np.zeros(count), 0.0
    found = step(cylinder(press, 0.0, 0.0, count))
    return found.normal[0][0], float(found.motion[0])


def path(pushes: Sequence[float], friction: float, press: float = PRESS) -> list[Rubbed]:
    states: list[Rubbed] = []
    for push in pushes:
        states.append(step(cylinder(press, push, friction), states[-1] if states else None))
    return states


@pytest.mark.published
@pytest.mark.parametrize("share", [0.2, 0.5, 0.9])
def test_cattaneo_mindlin(share: float) -> None:
    """Johnson, Contact Mechanics (7.22, 7.26): c/a = √(1 − Q/μP), q = μ p(x) − μ p0 (c/a) √(1 − x²/c²)."""
    mu = 0.3
    pressed = step(cylinder(PRESS, 0.0, mu, 201))
    found = step(cylinder(PRESS, share * mu * PRESS, mu, 201), pressed)
    x = strip_centres(201) * 1.1 * WIDE
    width, peak = x[1] - x[0], 2 * PRESS / (np.pi * WIDE)
    stuck = found.slip[0][0] == pressed.slip[0][0]
    inner = stuck & (found.normal[0][0] > 0)
    stick = WIDE * np.sqrt(1 - share)
    assert 0.5 * inner.sum() * width == pytest.approx(stick, abs=width)
    pressure = peak * np.sqrt(np.maximum(0.0, 1 - (x / WIDE) ** 2))
    traction = mu * (pressure - peak * stick / WIDE * np.sqrt(np.maximum(0.0, 1 - (x / stick) ** 2)))
    clear = (np.abs(np.abs(x) - WIDE) > 2 * width) & (np.abs(np.abs(x) - stick) > 2 * width)
    assert -found.tangential[0][0][clear] / width == pytest.approx(traction[clear], abs=0.01 * mu * peak)


@pytest.mark.exact
@pytest.mark.parametrize("mu", [0.05, 0.3, 1.0])
@pytest.mark.parametrize("share", [0.1, 0.6, 0.99])
def test_superposition_of_normal_contacts(mu: float, share: float) -> None:
    """Jäger (1998), Ciavarella (1998): q = μ(p(P) − p(P − Q/μ)), strip by strip; so does the tangential shift."""
    push = share * mu * PRESS
    found = path([0.0, push], mu)[1]
    (full, deep), (rest, less) = frictionless(PRESS), frictionless(PRESS - push / mu)
    assert -found.tangential[0][0] == pytest.approx(mu * (full - rest), abs=1e-9 * mu * full.max())
    assert found.motion[1] == pytest.approx(mu * (deep - less), rel=1e-9)
    assert found.normal[0][0] == pytest.approx(full, abs=1e-10 * full.max())


@pytest.mark.exact
def test_unloading_and_reversal() -> None:
    """Jäger: back from Q₁ to Q, q = q₁ − 2μ(p(P) − p(P − (Q₁ − Q)/2μ)), and likewise forward again."""
    mu, most = 0.2, 0.8 * 0.2 * PRESS
    full, deep = frictionless(PRESS)

    def masing(change: float) -> tuple[Array, float]:
        rest, less = frictionless(PRESS - change / (2 * mu))
        return 2 * mu * (full - rest), 2 * mu * (deep - less)

    states = path([0.0, most, 0.3 * most, -0.5 * most, -most, 0.1 * most, most], mu)
    peak = -states[1].tangential[0][0], states[1].motion[1]
    low = -states[4].tangential[0][0], states[4].motion[1]
    for state, start, sign, change in (
        (states[2], peak, -1, 0.7 * most),
        (states[3], peak, -1, 1.5 * most),
        (states[4], peak, -1, 2.0 * most),
        (states[5], low, 1, 1.1 * most),
        (states[6], low, 1, 2.0 * most),
    ):
        traction, shift = masing(change)
        tolerance = 1e-9 * mu * full.max()
        assert -state.tangential[0][0] == pytest.approx(start[0] + sign * traction, abs=tolerance)
        assert state.motion[1] == pytest.approx(start[1] + sign * shift, rel=1e-8)


@pytest.mark.published
def test_hysteresis_loop_of_a_line_contact() -> None:
    """Loop area under ±Q*: with Hertz's dδ/dP = A ln(2/a) and Masing's rule, W = 8∫Q dδ − 4Q*δ*."""
    mu, share = 0.25, 0.7
    most = share * mu * PRESS
    cycle = most * np.concatenate([[0.0, 1.0], 1 - np.linspace(0, 2, 41)[1:], -1 + np.linspace(0, 2, 41)[1:]])
    states = path([float(q) for q in cycle], mu)

    def rate(push: float) -> float:  # the rest of ln(2/a) is linear and leaves no area
        return -0.5 * KERNEL * float(np.log(1 - push / (mu * PRESS)))

    area = 8 * quad(lambda q: q * rate(q), 0.0, most)[0] - 4 * most * quad(rate, 0.0, most)[0]
    lost = sum(s.work for s in states[2:])
    assert lost == pytest.approx(area, rel=0.01)
    shift = np.array([s.motion[1] for s in states[1:]])
    outside = float(np.sum(0.5 * (cycle[2:] + cycle[1:-1]) * np.diff(shift)))
    assert outside == pytest.approx(lost, rel=1e-9)
    assert shift[-1] == pytest.approx(shift[0], rel=1e-9)


@pytest.mark.exact
def test_complete_stick() -> None:
    """With much friction and a stamp's flat pressure nothing slips: linear, no work, forces scale with the push."""
    count = 41
    system = cylinder(PRESS, 0.0, 50.0, count)
    flat = replace(system.contacts[0].normal, gap=np.zeros((1, count)))
    system = replace(system, contacts=(replace(system.contacts[0], normal=flat),))
    pressed = step(system)
    one, two = (step(replace(system, load=np.array([PRESS, q])), pressed) for q in (10.0, 20.0))
    assert np.array_equal(one.slip[0], pressed.slip[0])
    assert two.tangential[0] == pytest.approx(2 * one.tangential[0], rel=1e-9)
    assert one.work == 0.0
    assert -one.tangential[0][0] / 10.0 == pytest.approx(pressed.normal[0][0] / PRESS, rel=1e-9)


@pytest.mark.exact
def test_gross_slip() -> None:
    """Almost at Q = μP every strip but the middle slips with μp; beyond, no balance exists and the step is refused."""
    mu = 0.3
    pressed = step(cylinder(PRESS, 0.0, mu))
    near = step(cylinder(PRESS, (1 - 1e-9) * mu * PRESS, mu), pressed)
    assert -near.tangential[0] == pytest.approx(mu * near.normal[0], abs=1e-6 * mu * PRESS)
    with pytest.raises(NotConverged):
        step(cylinder(PRESS, 1.001 * mu * PRESS, mu), pressed)


@pytest.mark.exact
def test_order_of_loading_matters() -> None:
    """Pushed then pressed harder, or pressed harder then pushed: same loads, other tractions (Mindlin, Deresiewicz)."""
    mu, push = 0.3, 0.2 * PRESS
    one = step(
        cylinder(PRESS, push, mu), step(cylinder(0.7 * PRESS, push, mu), step(cylinder(0.7 * PRESS, 0.0, mu)))
    )
    two = step(cylinder(PRESS, push, mu), step(cylinder(PRESS, 0.0, mu)))
    assert one.normal[0] == pytest.approx(two.normal[0], abs=1e-9 * PRESS)
    assert np.abs(one.tangential[0] - two.tangential[0]).max() > 1e-2 * np.abs(two.tangential[0]).max()


@pytest.mark.property
def test_a_cycle_closes_and_its_work_is_what_is_lost() -> None:
    """Many contacts, coupled, held by a spring, twisted to and fro: the third loop is the second, work is balanced."""
    system = random_system(2, 0.3, held=True)
    pressed = (replace(x, normal=replace(x.normal, gap=0 * x.normal.gap - 5.0)) for x in system.contacts)
    system = replace(system, contacts=tuple(pressed))
    base, twist = system.load, np.zeros(len(system.load))
    twist[0] = 0.6 * np.abs(base).max()
    turns = np.concatenate([np.linspace(0, 1, 6), np.linspace(1, -1, 11)[1:], np.linspace(-1, 1, 11)[1:]])
    loop = np.concatenate([turns[1:], np.linspace(1, -1, 11)[1:], np.linspace(-1, 1, 11)[1:]])
    states = [step(replace(system, load=base))]
    for share in loop:
        states.append(step(replace(system, load=base + share * twist), states[-1]))
    first, second = states[-21], states[-1]
    assert second.motion == pytest.approx(first.motion, abs=1e-9 * np.abs(first.motion).max())
    for a, b in zip(first.tangential, second.tangential, strict=True):
        assert a == pytest.approx(b, abs=1e-9 * max(np.abs(x).max() for x in first.normal))
    cycle = states[-21:]
    touched = [tuple(np.concatenate([(p > 0).ravel() for p in s.normal])) for s in cycle]
    assert len(set(touched)) == 1  # normal contacts neither open nor close, so that trapezes are exact
    loads = base + np.append(1.0, loop[-20:])[:, None] * twist
    motions = np.array([s.motion for s in cycle])
    outside = float(np.sum(0.5 * (loads[1:] + loads[:-1]) * np.diff(motions, axis=0)))
    lost = sum(s.work for s in cycle[1:])
    assert lost > 0
    assert outside == pytest.approx(lost, rel=1e-9, abs=1e-12)


def random_system(seed: int, mu: float, held: bool = False, mixed: bool = True, contacts: int = 0) -> System:
    """Return contacts in two groups that couple normally and tangentially, whose load can be carried."""
    rng = np.random.default_rng(seed)
    motions, groups, total = 3, [], 0
    for strips in (1, int(rng.integers(2, 6))) if not contacts else (1,):
        count = contacts or int(rng.integers(2, 6))
        half = rng.normal(size=(count, strips, strips + 2))
        local = half @ half.transpose(0, 2, 1) + np.eye(strips)
        arms = np.repeat(rng.normal(size=(count, 1, motions)), strips, axis=1)
        slide = np.repeat(rng.normal(size=(count, 1, motions)), strips, axis=1)
        gap = rng.uniform(-0.5, 2.0, size=(count, strips))
        normal, along = lcp.Group(local, gap, arms), lcp.Group(local, np.zeros_like(gap), slide)
        groups.append(Rubbing(normal, along, mu))
        total += count
    half = rng.normal(size=(2 * total, 2 * total + 3))
    coupling = 0.1 * half @ half.T / total
    if not mixed:
        coupling[:total, total:] = coupling[total:, :total] = 0.0
    springs = np.diag(rng.uniform(0.5, 2.0, motions)) * (1.0 if held else 0.0)
    push = [rng.uniform(0.2, 1.0, g.normal.gap.shape) for g in groups]
    load = sum(np.einsum("cmk,cm->k", g.normal.arms, p) for g, p in zip(groups, push, strict=True))
    return System(tuple(groups), coupling, springs, np.asarray(load) * rng.uniform(0.5, 5.0))


def dense(system: System) -> tuple[Array, Array, Array]:
    """Return C, g, R over all strips, normal ones first, written out entry by entry."""
    groups = [x.normal for x in system.contacts] + [x.tangential for x in system.contacts]
    blocks, number = [], 0
    for group in groups:
        for contact in range(len(group.gap)):
            blocks.append((group.local[contact], group.gap[contact], group.arms[contact], number))  # type: ignore[index]
            number += 1
    size = sum(len(b[1]) for b in blocks)
    matrix, row = np.zeros((size, size)), 0
    for local, _, _, one in blocks:
        column = 0
        for other, _, _, two in blocks:
            part = matrix[row : row + len(local), column : column + len(other)]
            part += system.coupling[one, two] + (local if one == two else 0.0)
            column += len(other)
        row += len(local)
    return matrix, np.concatenate([b[1] for b in blocks]), np.concatenate([b[2] for b in blocks])


def violation(system: System, before: Rubbed | None, found: Rubbed) -> float:
    """Return the largest violation of balance, Signorini's and Coulomb's conditions, relative to the largest force."""
    matrix, gap, arms = dense(system)
    flat = [
        np.concatenate([a.ravel() for a in part]) for part in (found.normal, found.tangential, found.slip)
    ]
    p, q, slip = flat
    old = 0 * slip if before is None else np.concatenate([a.ravel() for a in before.slip])
    mu = np.concatenate([np.full(x.normal.gap.size, x.friction) for x in system.contacts])
    w = matrix @ np.concatenate([p, q]) + gap - arms @ found.motion
    opening, change = w[: len(p)], w[len(p) :] - old
    size = max(float(np.abs(np.concatenate([p, q, system.load])).max()), 1e-300)
    length = max(float(np.abs(gap).max()), float(np.abs(np.diag(matrix)).max()) * size)
    lost = system.load - arms.T @ np.concatenate([p, q]) - system.springs @ found.motion
    rubbing = mu > 0
    parts = [
        -p / size,
        -opening / length,
        np.minimum(np.abs(p) / size, np.abs(opening) / length),
        (np.abs(q) - mu * p) / size,
        np.minimum(np.abs(change) / length, np.abs(q + np.sign(change) * mu * p) / size)[rubbing],
        np.abs(w[len(p) :] - slip)[rubbing] / length,
        np.abs(lost) / size / max(1.0, float(np.abs(arms).max())),
    ]
    return max(float(x.max(initial=0.0)) for x in parts)


@pytest.mark.property
@settings(max_examples=150, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.0, 1.0), st.booleans(), st.floats(-1.0, 1.0))
def test_coulombs_conditions_or_a_refusal(seed: int, mu: float, held: bool, turn: float) -> None:
    """Random coupled systems, two steps, μ 0 … 1: every condition holds to 1e-9, or the step is refused."""
    system = random_system(seed, mu, held)
    before: Rubbed | None = None
    for load in (system.load, system.load * (1 + 0.5 * turn), system.load * (1 - 0.5 * turn)):
        now = replace(system, load=load)
        try:
            found = step(now, before)
        except NotConverged:
            assert mu > 0.3
            return
        assert violation(now, before, found) < 1e-9
        before = found


@pytest.mark.property
def test_few_solves_where_friction_is_small() -> None:
    """μ ≤ 0.3: always solved; nine of ten steps in six solves at the most."""
    solves = []
    for seed in range(150):
        system = random_system(seed, 0.3 * (seed % 10 + 1) / 10)
        state = step(system)
        solves.append(state.solves)
        for share in (1.1, 0.9):
            state = step(replace(system, load=share * system.load), state)
            solves.append(state.solves)
    assert np.quantile(solves, 0.9) <= 6


def enumerated(system: System, old: Array) -> list[Array]:
    """Return all forces that meet Coulomb's conditions, of every combination of statuses (one strip a contact)."""
    matrix, gap, arms = dense(system)
    count, motions = len(gap) // 2, arms.shape[1]
    gap = gap - np.concatenate([np.zeros(count), old])
    mu = np.array([x.friction for x in system.contacts for _ in range(len(x.normal.gap))])
    answers: list[Array] = []
    for status in product((None, 0, -1, 1), repeat=count):
        system_matrix = np.zeros((2 * count + motions,) * 2)
        right = np.zeros(2 * count + motions)
        for i, way in enumerate(status):
            for row, equation in ((i, "open"), (count + i, "slip")):
                if way is None:
                    system_matrix[row, row] = 1.0
                elif equation == "slip" and way != 0:
                    system_matrix[row, row], system_matrix[row, i] = 1.0, -way * mu[i]
                else:
                    system_matrix[row] = np.append(matrix[row], -arms[row])
                    right[row] = -gap[row]
        system_matrix[2 * count :, : 2 * count] = arms.T
        system_matrix[2 * count :, 2 * count :] = system.springs
        right[2 * count :] = system.load
        if np.linalg.matrix_rank(system_matrix, tol=1e-10) < len(right):
            continue
        x = np.linalg.solve(system_matrix, right)
        w = matrix @ x[: 2 * count] + gap - arms @ x[2 * count :]
        p, q, opening, change = x[:count], x[count : 2 * count], w[:count], w[count:]
        good = all(
            (opening[i] > -1e-9 if way is None else p[i] > -1e-9)
            and abs(q[i]) <= mu[i] * p[i] + 1e-9
            and (not way or way * change[i] <= 1e-9)
            for i, way in enumerate(status)
        )
        if good and not any(np.allclose(x, y, atol=1e-7) for y in answers):
            answers.append(x)
    return answers


@pytest.mark.independent
@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("mu", [0.1, 0.3, 0.8])
def test_every_combination_of_statuses(seed: int, mu: float) -> None:
    """Three or four contacts: what is found is among all solutions, which for small μ is one."""
    system = random_system(seed, mu, held=True, contacts=3 + seed % 2)
    before = step(system)
    load = system.load * np.array([1.2, 0.7, 1.1])
    after = replace(system, load=load)
    found = step(after, before)
    answers = enumerated(after, before.slip[0].ravel())
    forces = np.concatenate([found.normal[0].ravel(), found.tangential[0].ravel()])
    if mu <= 0.3:
        assert len(answers) == 1
    assert min(np.abs(a[: len(forces)] - forces).max() for a in answers) < 1e-8


@pytest.mark.exact
def test_no_friction_is_the_frictionless_answer() -> None:
    """μ = 0: bit by bit what the contact problem alone gives, step or running."""
    system = random_system(5, 0.0)
    normal = tuple(x.normal for x in system.contacts)
    count = sum(len(g.gap) for g in normal)
    plain = lcp.solve(lcp.Problem(normal, system.coupling[:count, :count], system.springs, system.load))
    for found in (step(system), run(system, [np.ones(len(g.gap), dtype=np.intp) for g in normal])):
        assert all(np.array_equal(a, b) for a, b in zip(plain.forces, found.normal, strict=True))
        assert np.array_equal(plain.motion, found.motion)
        assert found.work == 0.0
        assert not any(q.any() for q in found.tangential)


@pytest.mark.property
def test_a_contact_without_friction_beside_one_with() -> None:
    """One group at μ = 0: no tangential force there, Coulomb elsewhere, also under the dense check."""
    system = random_system(7, 0.2)
    smooth = replace(system.contacts[0], friction=0.0)
    system = replace(system, contacts=(smooth, system.contacts[1]))
    found = step(system)
    assert not found.tangential[0].any()
    assert found.tangential[1].any()
    assert violation(system, None, found) < 1e-9


@pytest.mark.property
@settings(max_examples=100, deadline=None)
@given(st.integers(0, 10**6), st.floats(0.0, 1.0), st.booleans())
def test_running(seed: int, mu: float, held: bool) -> None:
    """Every contact slides a given way: q = −σμp, Signorini, balance, or a refusal."""
    system = random_system(seed, mu, held)
    rng = np.random.default_rng(seed)
    senses: list[IntArray] = [rng.integers(-1, 2, len(x.normal.gap)) for x in system.contacts]
    try:
        found = run(system, senses)
    except NotConverged:  # whether rightly, the next test asks
        return
    matrix, gap, arms = dense(system)
    p = np.concatenate([x.ravel() for x in found.normal])
    q = np.concatenate([x.ravel() for x in found.tangential])
    w = matrix @ np.concatenate([p, q]) + gap - arms @ found.motion
    size = max(float(p.max()), float(np.abs(system.load).max()))
    length = max(float(np.abs(gap).max()), float(np.diag(matrix).max()) * size)
    for s, a, b in zip(senses, found.normal, found.tangential, strict=True):
        assert b == pytest.approx(-s[:, None] * mu * a, abs=1e-9 * size)
    assert p.min() >= -1e-9 * size
    assert w[: len(p)].min() >= -1e-9 * length
    assert np.minimum(p / size, np.abs(w[: len(p)]) / length).max() < 1e-9
    lost = system.load - arms.T @ np.concatenate([p, q]) - system.springs @ found.motion
    assert np.abs(lost).max() < 1e-9 * size * max(1.0, float(np.abs(arms).max()))


def running_answers(system: System, sense: IntArray) -> list[Array]:
    """Return all pressures that balance sliding contacts of one strip, of every combination of touching ones."""
    matrix, gap, arms = dense(system)
    count, mu = len(gap) // 2, system.contacts[0].friction
    pulled = np.vstack([np.eye(count), np.diag(-sense * mu)])
    whole = np.block([[matrix[:count] @ pulled, -arms[:count]], [arms.T @ pulled, system.springs]])
    answers: list[Array] = []
    for touching in product((True, False), repeat=count):
        own, right = whole.copy(), np.concatenate([-gap[:count], system.load])
        free = np.flatnonzero(~np.array(touching))
        own[free], right[free] = np.eye(len(right))[free], 0.0
        if np.linalg.matrix_rank(own, tol=1e-10) < len(right):
            continue
        x = np.linalg.solve(own, right)
        opening = (whole @ x)[:count] + gap[:count]
        if x[:count].min() > -1e-9 and opening.min() > -1e-9:
            answers.append(x[:count])
    return answers


@pytest.mark.independent
@pytest.mark.parametrize("mu", [0.05, 0.2, 0.5, 1.0])
@pytest.mark.parametrize("held", [False, True])
def test_running_is_refused_only_where_there_is_no_balance(mu: float, held: bool) -> None:
    """Five contacts, every combination of touching ones: what is found is among the balances; none, where refused."""
    for seed in range(20):
        system = random_system(seed, mu, held, contacts=5)
        sense = np.random.default_rng(seed).integers(-1, 2, 5)
        answers = running_answers(system, sense)
        try:
            found = run(system, [sense]).normal[0].ravel()
        except NotConverged:
            assert not answers
        else:
            assert min(np.abs(a - found).max() for a in answers) < 1e-8 * max(1.0, found.max())


@pytest.mark.property
@pytest.mark.parametrize(("newton", "metre"), [(1e3, 1e3), (1e-6, 1e-3), (1.0, 1e6)])
def test_units_do_not_matter(newton: float, metre: float) -> None:
    """Forces × newton, lengths × metre: the same answer in other units."""
    system = random_system(11, 0.25)
    contacts = tuple(
        replace(
            x,
            normal=replace(x.normal, local=x.normal.local * (metre / newton), gap=x.normal.gap * metre),  # type: ignore[arg-type, operator]
            tangential=replace(x.tangential, local=x.tangential.local * (metre / newton)),  # type: ignore[arg-type, operator]
        )
        for x in system.contacts
    )
    other = System(contacts, system.coupling * (metre / newton), system.springs, system.load * newton)
    one, two = step(system), step(other)
    one, two = (step(replace(s, load=1.1 * s.load), b) for s, b in ((system, one), (other, two)))
    for a, b in zip((*one.normal, *one.tangential), (*two.normal, *two.tangential), strict=True):
        assert b == pytest.approx(a * newton, rel=1e-8, abs=1e-9 * newton)
    assert two.motion == pytest.approx(one.motion * metre, rel=1e-8)
    assert two.work == pytest.approx(one.work * newton * metre, rel=1e-6, abs=1e-12 * newton * metre)


@pytest.mark.property
def test_the_bodies_may_be_exchanged() -> None:
    """The second body first: its tangent points the other way, slip and tangential force keep their sense, forces too.

    Both normal and tangent turn round, so C_nt keeps its sign and the slip of one past the other does as well.
    """
    system = random_system(13, 0.2)
    mirrored = tuple(
        replace(x, tangential=replace(x.tangential, arms=-x.tangential.arms)) for x in system.contacts
    )
    count = len(system.coupling) // 2
    sign = np.diag(np.repeat([1.0, -1.0], count))
    other = System(mirrored, sign @ system.coupling @ sign, system.springs, system.load)
    one, two = step(system), step(other)
    for a, b in zip(one.tangential, two.tangential, strict=True):
        assert b == pytest.approx(-a, abs=1e-9)
    for a, b in zip(one.normal, two.normal, strict=True):
        assert b == pytest.approx(a, abs=1e-9)


@pytest.mark.property
def test_order_of_contacts_does_not_matter() -> None:
    """Groups in the other order, with the coupling's rows: the same forces."""
    system = random_system(17, 0.3)
    first, second = (len(x.normal.gap) for x in system.contacts)
    order = np.concatenate([np.arange(first, first + second), np.arange(first)])
    order = np.concatenate([order, first + second + order])
    other = replace(system, contacts=system.contacts[::-1], coupling=system.coupling[np.ix_(order, order)])
    one, two = step(system), step(other)
    for a, b in zip(one.tangential, two.tangential[::-1], strict=True):
        assert b == pytest.approx(a, abs=1e-9)


@pytest.mark.property
def test_nothing_wrong_is_returned_beyond_the_limit() -> None:
    """A wedge that locks itself: a push that friction can carry in many ways is solved or refused, never violated."""
    for seed in range(40):
        system = random_system(seed, 1.0, mixed=False)
        try:
            found = step(system)
        except NotConverged:
            continue
        assert violation(system, None, found) < 1e-9

"""Drawing, fields and words of a K-H-V run: members, contacts and forces fit together in the fixed frame."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.drives.khv_cases import EFFECTS
from trochoid.clock import Clock
from trochoid.drives.khv.headline import ABSENT_EFFECTS, NEVER_SIMULATED, facts, not_simulated, title
from trochoid.drives.khv.picture import drawing, stress_film, turned_stress
from trochoid.drives.khv.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import DrawingFrame
from trochoid.scene import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"
FIXED = pytest.mark.parametrize("fixed", ["ring", "output"])


def stages_of(*overrides: str, effects: str = "") -> Stages:
    """The example's drive, with rigid discs on springs unless effects say otherwise."""
    return Stages(load(EXAMPLE, (f"effects=[{effects}]", 'ask.quantities=["ratio"]', *overrides)), Clock())


def frames_of(*overrides: str, effects: str = "") -> tuple[DrawingFrame, ...]:
    stages = stages_of(*overrides, effects=effects)
    assert stages.contact
    return drawing(stages).frames


def middle(frame: DrawingFrame, name: str, group: str = "") -> Array:
    line = next(line for line in frame.lines if line.name == name and group in ("", line.group))
    return np.asarray(line.xy.mean(axis=0))


def distance(polygon: Array, point: Array) -> float:
    """Distance of a point from a closed polygon."""
    along = np.roll(polygon, -1, axis=0) - polygon
    to = point - polygon
    share = np.clip((to * along).sum(axis=1) / (along**2).sum(axis=1), 0.0, 1.0)
    return float(np.linalg.norm(to - share[:, None] * along, axis=1).min())


def cross(a: Array, b: Array) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


@pytest.mark.exact
@FIXED
def test_forces_act_where_pins_touch_discs(fixed: str) -> None:
    """With nominal poses, as classical, each force starts on its pin, points away from it, and is on its disc."""
    discs = ("drive.discs=3", "drive.output_pins.phase=7", "ask.positions=4")
    for frame in frames_of(f'drive.fixed="{fixed}"', *discs):
        assert {arrow.group for arrow in frame.arrows} == {"disc 1", "disc 2", "disc 3"}
        for arrow in frame.arrows:
            outward = arrow.origin - middle(frame, arrow.label)
            radius = 0.005 if arrow.label.startswith("ring") else 0.0065
            assert abs(np.linalg.norm(outward) - radius) < 1e-12
            assert cross(outward, arrow.vector) == pytest.approx(0.0, abs=1e-12 * radius * 1e6)
            assert outward @ arrow.vector > 0
            edges = [line.xy for line in frame.lines if line.group == arrow.group]
            assert min(distance(edge, arrow.origin) for edge in edges) < 50e-6  # of a chord from its arc


@pytest.mark.property
@FIXED
def test_discs_are_in_balance(fixed: str) -> None:
    """Forces on a disc sum to zero, and so do moments about its centre (elastic motion is not drawn: 1e-3)."""
    effects = '{type="bearing_compliance"}'
    for frame in frames_of(f'drive.fixed="{fixed}"', "ask.positions=5", effects=effects):
        for disc in ("disc 1", "disc 2"):
            acting = [arrow for arrow in frame.arrows if arrow.group == disc]
            center = middle(frame, f"{disc} bore")
            size = sum(float(np.linalg.norm(arrow.vector)) for arrow in acting)
            assert np.linalg.norm(sum(arrow.vector for arrow in acting)) < 1e-9 * size
            turning = sum(cross(arrow.origin - center, arrow.vector) for arrow in acting)
            assert abs(turning) < 1e-3 * 0.05 * size
            assert any(arrow.label.startswith("roller") for arrow in acting)


@pytest.mark.exact
@FIXED
def test_the_fixed_member_stands_still(fixed: str) -> None:
    """Over a turn the input mark goes round once, the driven member by the ratio, the fixed one not at all."""
    first, second, *_ = frames_of(f'drive.fixed="{fixed}"', "ask.positions=4")
    angles = {
        name: np.angle(complex(*middle(second, name)) / complex(*middle(first, name)))
        for name in ("ring pin 1", "output pin 1", "input angle")
    }
    ring, output = (0.0, -1 / 19) if fixed == "ring" else (1 / 20, 0.0)
    quarter = np.pi / 2
    np.testing.assert_allclose(list(angles.values()), [ring * quarter, output * quarter, quarter], atol=1e-12)


@pytest.mark.property
def test_frames_are_alike_and_few() -> None:
    """At most 36 of the solved positions, evenly spaced; every frame has the same lines in the same order."""
    frames = frames_of("ask.positions=75")
    assert len(frames) == 25
    assert [frame.label for frame in frames[:3]] == ["0.0°", "14.4°", "28.8°"]
    assert len({tuple((line.name, line.group, line.style) for line in frame.lines) for frame in frames}) == 1


@pytest.mark.property
def test_a_drawing_solves_nothing() -> None:
    """Without solved contacts there are 36 frames and no forces, and no stage beyond kinematics runs."""
    stages = stages_of()
    frames = drawing(stages).frames
    assert len(frames) == 36
    assert not any(frame.arrows for frame in frames)
    assert set(stages.clock.seconds) == {"kinematics"}


@pytest.mark.exact
def test_no_force_without_torque() -> None:
    """What rounding leaves in the contacts of an unloaded drive is no force."""
    assert not any(frame.arrows for frame in frames_of("ask.positions=3", "operation.output_torque=0"))


@pytest.mark.exact
def test_stress_is_a_tensor() -> None:
    """σ in turned axes is Q σ Qᵀ; zz stays."""
    angle, stress = 0.7, np.array([[3.0, -1.0, 5.0, 2.0]])
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    expected = turn @ np.array([[3.0, 2.0], [2.0, -1.0]]) @ turn.T
    xx, yy, zz, xy = turned_stress(stress, angle)[0]
    np.testing.assert_allclose([[xx, xy], [xy, yy]], expected, rtol=1e-14)
    assert zz == 5.0


@pytest.fixture(scope="module")
def elastic() -> Stages:
    """Coarse elastic discs with the ring driven, stress at an angle at which the ring has turned."""
    coarse = ("accuracy.facets_per_lobe=6", "ask.positions=1", "ask.stress_position=40")
    return stages_of(*coarse, 'drive.fixed="output"', effects='{type="elastic_contact"}')


@pytest.mark.exact
def test_fields_lie_where_discs_are_drawn(elastic: Stages) -> None:
    """The bore is e(cos 40°, sin 40°) away from the axis, and −that for disc 2; z = ∓6 mm.

    With the flange fixed discs circle without turning: the hole of output pin 1 stays 52 mm right of the centre.
    """
    ((angle, bodies),) = stress_film(elastic).frames
    assert angle == pytest.approx(np.radians(40))
    for body, sign in zip(bodies, (1, -1), strict=True):
        center = sign * 0.0025 * np.array([np.cos(angle), np.sin(angle)])
        for place, radius in ((center, 0.025), (center + np.array([0.052, 0.0]), 0.009)):
            around = np.linalg.norm(body.points[:, :2] - place, axis=1)
            assert around.min() == pytest.approx(radius, abs=3e-6)  # of a quadratic edge from the circle
            assert (around < radius + 3e-6).sum() > 20
        np.testing.assert_allclose(body.points[:, 2], -0.006 * sign)


@pytest.mark.independent
def test_von_mises_belongs_to_the_stress(elastic: Stages) -> None:
    """The equivalent stress of the turned tensor, by its usual formula, is the one that is given."""
    ((_, bodies),) = stress_film(elastic).frames
    for body in bodies:
        xx, yy, zz, xy = body.point_data["stress"].T
        squares = 0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * xy**2
        np.testing.assert_allclose(np.sqrt(squares), body.point_data["von_mises"], rtol=1e-9)
        assert body.point_data["von_mises"].max() > 1e7
        in_plane = np.hypot(0.5 * (xx - yy), xy)
        largest = np.maximum(in_plane, 0.5 * (in_plane + np.abs(0.5 * (xx + yy) - zz)))
        np.testing.assert_allclose(largest, body.point_data["max_shear"], rtol=1e-9)


@pytest.mark.exact
@pytest.mark.parametrize(("fixed", "ratio"), [("ring", -19.0), ("output", 20.0)])
def test_main_data(fixed: str, ratio: float) -> None:
    """Ratio and speeds of the example by hand; power is torque times speed."""
    stages = stages_of(f'drive.fixed="{fixed}"')
    data = facts(stages)
    assert title(stages) == "Cycloid drive K-H-V 20/19"
    assert data["Ratio"].value == ratio
    assert data["Pin circle radius R"].value == 80.0
    assert data["Output speed"].value == pytest.approx(1500 / ratio)
    power = 400 * 1500 / abs(ratio) * 2 * np.pi / 60e3
    assert data["Power"].value == pytest.approx(power)
    assert set(stages.clock.seconds) == {"kinematics"}


@pytest.mark.property
def test_every_absent_effect_is_explained() -> None:
    """Each effect that scenes know has a sentence; listed ones are not among the absent."""
    assert set(ABSENT_EFFECTS) == set(EFFECTS)
    assert set(not_simulated(load(EXAMPLE))) == set(NEVER_SIMULATED)
    assert set(not_simulated(stages_of(effects='{type="inertia"}').scene)) == {
        *NEVER_SIMULATED,
        *set(EFFECTS) - {"inertia"},
    }

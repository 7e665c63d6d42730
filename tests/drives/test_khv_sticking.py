"""The load path with friction against another solver on the same path."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.drives.khv_cases import EVERY_PIN_ALIKE, drive
from trochoid.drives.khv.bodies import meshes, outlines
from trochoid.drives.khv.contact import assembly, layout, plane
from trochoid.drives.khv.load_path import load_path, path_of
from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.friction_position import Drag, drag
from trochoid.fem.position import ElasticBody

MU, SHARES = 0.08, (1e-4, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0)


@pytest.mark.independent
def test_two_solvers_follow_the_same_path() -> None:
    """Twist at every torque of a loop within 1e-3 of the largest, lost work within 5 %: what their steps leave.

    `friction_position` follows one position with the core for strips; `sticking` all positions side by side.
    """
    effects = f'{{type="elastic_contact"}}, {{type="friction", ring_pins={MU}, output_pins={MU}}}'
    made = drive(*EVERY_PIN_ALIKE, f"effects=[{effects}]")
    facets = 8
    bodies = tuple(
        ElasticBody(
            press(build_body(mesh, plane(made)), outline.loops, tangential=True), made.drive.face_width
        )
        for mesh, outline in zip(meshes(made, facets), outlines(made, facets), strict=True)
    )
    found = load_path(made, "level0", bodies, np.array([0.02]), SHARES)
    problem, row = (
        assembly(made, "level0", bodies, 0.02),
        layout(made, "level0").names.index("output.rotation"),
    )
    unit = np.zeros_like(problem.load)
    unit[row] = made.flange_torque
    steps = [replace(problem, load=share * unit) for share in path_of(SHARES)]
    path = drag(steps, Drag({f.name: MU for f in problem.families if not f.name.startswith("bearing")}))
    twist = np.array([p.motion[row] for p in path]) / made.leverage
    assert found.twist[0] == pytest.approx(twist, abs=1e-3 * float(np.abs(twist).max()))
    assert found.lost[0, -1] == pytest.approx(sum(p.work for p in path), rel=0.05)

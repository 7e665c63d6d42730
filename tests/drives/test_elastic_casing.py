"""Elastic casings through the scene: the rigid limit, mesh files, units, what is compared, what is loaded."""

from __future__ import annotations

import json
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from tests.drives.khv_cases import listed, without
from trochoid.cli import main
from trochoid.drives.casing_body import box_casing, elastic_shaken
from trochoid.drives.casing_doubt import casing_warnings
from trochoid.drives.khv.stages import Stages
from trochoid.dynamics.structure import Structure
from trochoid.dynamics.vibration import Vibration
from trochoid.geometry.casing_box import casing_places
from trochoid.geometry.casing_mesh import mesh_casing
from trochoid.geometry.solid_mesh import SolidMesh
from trochoid.kinematics.errors import TrochoidError
from trochoid.results.outcome import Quantity
from trochoid.run import Run, plan
from trochoid.scene import load

EXAMPLES = Path(__file__).parents[2] / "examples"
EXAMPLE = EXAMPLES / "casing.toml"
# rigid discs on springs, few positions, a coarse mesh: what is asked here is about the casing
SMALL = (
    listed(without("elastic_contact", "friction", "time_varying_stiffness", "backlash")),
    "ask.positions=24",
    'ask.quantities=["vibration_velocity"]',
    "casing.mesh_edge=40",
)


@cache
def run(*overrides: str) -> Run:
    return Run(load(EXAMPLE, [*SMALL, *overrides]))


def stages(made: Run) -> Stages:
    found = made.stages
    assert isinstance(found, Stages)
    return found


def worst(answer: Quantity) -> dict[str, float]:
    """Return the worst velocities at the first point, with everything ("") and without each effect."""
    assert answer.parts is not None
    part = answer.parts["cover"]
    assert not isinstance(part, Quantity)
    found = {}
    for name, each in part.items():
        if name.startswith("worst"):
            assert isinstance(each, Quantity)
            assert isinstance(each.value, float)
            found[name.removeprefix("worst").removeprefix("_")] = each.value
    return found


def same(one: Vibration, other: Vibration, tolerance: float) -> bool:
    apart = np.abs(one.velocity - other.velocity).max()
    return bool(apart <= tolerance * np.abs(one.velocity).max())


@pytest.mark.property
def test_stiff_casing_is_rigid() -> None:
    """Young's modulus × 1e6: the elastic casing's velocities are the rigid one's within 1e-5, and are not at × 1."""
    stiff = run("materials.cast_iron.youngs_modulus=110e9")
    found = stages(stiff).vibration.fine
    assert same(found.elastic, found.others["rigid_casing"], 1e-5)
    real = stages(run()).vibration.fine
    assert not same(real.elastic, real.others["rigid_casing"], 1e-2)
    assert same(real.others["rigid_casing"], found.others["rigid_casing"], 1e-9)


@pytest.mark.property
def test_what_each_effect_contributes_is_said() -> None:
    """Named comparisons beside the worst: with the scene's effects only, each with its error; checks hold."""
    made = run()
    found = worst(made.vibration_velocity)
    assert set(found) == {"", "rigid", "rigid_casing", "rigid_mounts", "free_casing"}
    assert len(set(found.values())) == len(found)
    checked = {check.name: check for check in made.outcome.checks}
    assert checked["loads on the casing's bores sum to their resultant"].value <= 1e-12
    assert all(check.ok for check in checked.values())
    data = made.outcome.dataset
    assert data is not None
    assert data["vibration_compared_1"].dims == ("frequency", "variant")


@pytest.mark.property
def test_errors_above_the_tolerance_are_warned_of() -> None:
    """On a coarse mesh the natural frequencies are off by more than 3 %: said with the worst, and with the edge."""
    [said] = [each for each in run().outcome.warnings if "accuracy.tolerance = 0.03" in each]
    assert "a casing.mesh_edge below 40 mm" in said
    levels = stages(run()).vibration
    assert not casing_warnings(load(EXAMPLE, [*SMALL, "accuracy.tolerance=0.9"]), levels)


@pytest.mark.property
def test_one_mesh_tells_no_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where edges twice as long leave the mesh as it is, there is one level: no errors, and a warning."""
    monkeypatch.setattr("trochoid.drives.casing_body.COARSER", 1.0)
    made = Run(load(EXAMPLE, SMALL))
    assert stages(made).casing.coarse is None
    assert any("no coarser mesh" in each for each in made.outcome.warnings)
    parts = made.vibration_velocity.parts
    assert parts is not None
    for group in parts.values():
        assert not isinstance(group, Quantity)
        assert all(isinstance(each, Quantity) and each.error is None for each in group.values())


@pytest.mark.property
def test_free_casing_has_no_mounts_to_leave_out() -> None:
    """Mounts without stiffness and damping: what others call free."""
    none = [f"casing.mounts.{i}.{key}=[0,0,0]" for i in range(4) for key in ("stiffness", "damping")]
    found = elastic_shaken(load(EXAMPLE, [*SMALL, *none]), stages(run()).casing_body, False)
    assert set(found.variants) == {"rigid_casing"}
    assert isinstance(found.body, Structure)
    free = stages(run()).casing.fine.variants["free_casing"]
    assert isinstance(free, Structure)
    assert np.array_equal(found.body.stiffness, free.stiffness)


@pytest.mark.property
def test_plan_knows_the_casing() -> None:
    """The casing's stages are planned where they run: both for its vibration, the body alone for its mass."""
    shaken = {stage.name for stage in plan(run().scene).stages if stage.needed}
    assert {"casing mesh", "casing"} <= shaken
    assert shaken - set(stages(run()).clock.seconds) <= {"mesh", "bodies"}
    weighed = plan(load(EXAMPLE, [*SMALL, 'ask.quantities=["mass"]'])).stages
    assert [stage.name for stage in weighed if stage.needed and "casing" in stage.name] == ["casing mesh"]
    rigid = plan(load(EXAMPLES / "cycloid.toml")).stages
    assert not [stage for stage in rigid if "casing" in stage.name]


@pytest.mark.property
def test_reruns_are_equal_to_the_bit() -> None:
    """Two runs of one scene give the same numbers."""
    one, other = stages(run()).vibration.fine, stages(Run(load(EXAMPLE, SMALL))).vibration.fine
    for name, found in one.others.items():
        assert np.array_equal(found.velocity, other.others[name].velocity), name
    assert np.array_equal(one.elastic.velocity, other.elastic.velocity)


@pytest.mark.property
def test_mass_of_all_has_the_meshed_casing() -> None:
    """The body's volume times its density: a box less its hollow, bosses, bores, base plate; bores are polygons."""
    body = stages(run()).casing_body
    box = 280 * 260 * 140 - 260 * 240 * 120 + 2 * 30 * 10 * 140
    low = np.pi * (45**2 * 15 - 30**2 * 25)
    high = np.pi * (112**2 * 75 - 100**2 * 85)
    answer = Run(load(EXAMPLE, [*SMALL, 'ask.quantities=["mass"]'])).mass
    assert answer.parts is not None
    casing = answer.parts["casing"]
    assert isinstance(casing, Quantity)
    assert casing.value == pytest.approx(7.2e-6 * (box + low + high), rel=1e-3)
    assert casing.model == "mesh"
    assert body.mesh.corners == 4


def _mesh() -> SolidMesh:
    table = load(EXAMPLE, SMALL).casing
    assert table is not None
    box = box_casing(table)
    assert box is not None
    return mesh_casing(box, 0.04)


def _written(folder: Path, scale: float, named: bool) -> None:
    """Write the box's mesh, its places as named sets of points or to be found by shape, and a scene beside it."""
    table = load(EXAMPLE, SMALL).casing
    assert table is not None
    box, mesh = box_casing(table), _mesh()
    assert box is not None
    sets = dict(mesh.sets) if named else {}
    cells = [("tetra10", mesh.elements.T)]
    meshio.Mesh(scale * mesh.points, cells, point_sets=sets).write(folder / "body.inp")
    head, tail = EXAMPLE.read_text(encoding="utf-8").split("[casing]")
    rest = tail[tail.index("[[casing.points]]") :]
    text = f'{head}[casing]\nelastic = true\nmaterial = "cast_iron"\ndamping_ratio = 0.01\nmesh_file = "body.inp"\n'
    text += f'mesh_unit = "{ {1e3: "mm", 1.0: "m", 1.0 / 0.0254: "in"}[scale] }"\n'
    places = casing_places(box)
    for bore in table.bores:
        place: Any = places[bore.name]
        at = (
            f'set = "{bore.name}"'
            if named
            else (
                f"point = {[1e3 * x for x in place.point]}\ndirection = [0, 0, 2]\nradius = {1e3 * place.radius}\n"
                f"span = {[1e3 * x for x in place.span]}"
            )
        )
        text += f'[[casing.bores]]\nname = "{bore.name}"\nholds = {json.dumps(bore.holds)}\n{at}\n'
    for mount in table.mounts:
        at = f'set = "{mount.name}"' if named else "normal = [0, 1, 0]\nradius = 12"
        text += (
            f'[[casing.mounts]]\nname = "{mount.name}"\nposition = {[1e3 * x for x in mount.position]}\n'
            f"stiffness = [5000, 8000, 5000]\ndamping = [500, 500, 500]\n{at}\n"
        )
    (folder / "scene.toml").write_text(text + rest)


@pytest.mark.property
@pytest.mark.parametrize(("scale", "named"), [(1e3, True), (1.0 / 0.0254, False)])
def test_mesh_from_a_file_is_the_box(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], scale: float, named: bool
) -> None:
    """`trochoid run` with the box's own mesh, written by meshio in mm or in inches: the box's numbers."""
    _written(tmp_path, scale, named)
    sets = [part for each in SMALL[:3] for part in ("--set", each)]
    assert main(["run", str(tmp_path / "scene.toml"), "--json", *sets]) == 0
    written = json.loads(capsys.readouterr().out)
    parts = written["quantities"]["vibration_velocity"]["parts"]["cover"]
    for name, value in worst(run().vibration_velocity).items():
        assert parts["_".join(filter(None, ("worst", name)))]["value"] == pytest.approx(value, rel=1e-6)
    assert {check["name"]: check["ok"] for check in written["checks"]}[
        "loads on the casing's bores sum to their resultant"
    ]


@pytest.mark.property
def test_what_a_mesh_file_lacks(tmp_path: Path) -> None:
    """No volume, no such set, not a mesh, the wrong unit: the run says which."""
    _written(tmp_path, 1e3, True)
    scene = tmp_path / "scene.toml"

    def said(*overrides: str) -> str:
        with pytest.raises(TrochoidError) as raised:
            stages(Run(load(scene, [*SMALL[:3], *overrides]))).casing  # noqa: B018
        return str(raised.value)

    assert "has no set 'lid'; there are " in said("casing.bores.0.set=lid")
    (tmp_path / "text.msh").write_text("no mesh")
    assert "text.msh: the mesh cannot be read" in said("casing.mesh_file=text.msh")
    mesh = _mesh()
    meshio.Mesh(mesh.points, [("triangle", mesh.facets[:3].T)]).write(tmp_path / "skin.vtu")
    assert "no solid elements" in said("casing.mesh_file=skin.vtu")
    assert "m from the body" in said("casing.mesh_unit=cm")
    assert "m from the body" in said("casing.points.0.position=[0,500,0]")


@pytest.mark.property
def test_units_do_not_matter() -> None:
    """The same box in metres: the same numbers to the bit."""
    given = [
        'casing.box.size=["0.28 m","0.26 m","0.14 m"]',
        'casing.box.wall="0.01 m"',
        'casing.mesh_edge="0.04 m"',
    ]
    made, expected = stages(run(*given)), stages(run())
    assert np.array_equal(made.casing_body.mesh.points, expected.casing_body.mesh.points)
    assert made.scene.casing == expected.scene.casing


@pytest.mark.property
def test_rigid_casings_load_no_finite_elements_of_solids() -> None:
    """A scene with a rigid casing asks for its vibration: scikit-fem and gmsh stay where they are."""
    asked = f"""
import sys
from trochoid import Run, load
effects = ['effects=[{{type="inertia"}},{{type="casing_on_mounts"}}]']
asked = ['ask.quantities=["vibration_velocity", "mass"]']
scene = load({str(EXAMPLES / "precessional.toml")!r}, effects + asked)
run = Run(scene)
assert run.vibration_velocity.parts and run.mass.parts
assert "casing" not in run.stages.clock.seconds
print([name for name in ("skfem", "gmsh", "meshio") if name in sys.modules])
"""
    done = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "[]", done.stderr

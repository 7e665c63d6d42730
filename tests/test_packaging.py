"""The map of packages, links and locks in step with the folders (shared design, "Folders")."""

import re
import subprocess
import tomllib
from collections.abc import Iterator
from fnmatch import fnmatch
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement

pytestmark = pytest.mark.property

ROOT = Path(__file__).resolve().parents[1]
WINGS = ("kinematics", "geometry", "fem", "dynamics")
PYPROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SETUPTOOLS: dict[str, Any] = PYPROJECT["tool"]["setuptools"]
LOCKS = ("requirements.lock", "requirements-dev.lock")


def _package_files() -> Iterator[tuple[str, Path]]:
    """Yield every file of the program with its package; the links in trochoid/ are not followed."""
    for top in ("trochoid", *WINGS):
        for path in sorted((ROOT / top).rglob("*")):
            inside = path.relative_to(ROOT)
            linked = top == "trochoid" and len(inside.parts) > 1 and inside.parts[1] in WINGS
            if path.is_file() and path.suffix != ".pyc" and not linked:
                folder = ".".join(inside.parent.parts)
                yield (folder if top == "trochoid" else f"trochoid.{folder}"), path


def _locked(name: str) -> dict[str, str]:
    """Return project → version of a lock file (any of them where a project is locked per Python version)."""
    text = (ROOT / name).read_text(encoding="utf-8")
    return dict(re.findall(r"^([a-z0-9-]+)==([^\s;]+)", text, flags=re.MULTILINE))


def _group(name: str) -> list[str]:
    """Return the requirements of a dependency group, those of the groups it includes too."""
    entries = PYPROJECT["dependency-groups"][name]
    included = (_group(entry["include-group"]) if isinstance(entry, dict) else [entry] for entry in entries)
    return [line for lines in included for line in lines]


def test_every_package_is_listed_by_name() -> None:
    """A folder with modules that is not listed would be missing from the wheel, silently."""
    folders = {package for package, path in _package_files() if path.suffix == ".py"}
    assert sorted(SETUPTOOLS["packages"]) == sorted(folders)


def test_every_package_says_what_it_is() -> None:
    """A folder without __init__.py would be a namespace that mypy and import-linter pass over."""
    folders = {path.parent for _, path in _package_files() if path.suffix == ".py"}
    assert [folder for folder in folders if not (folder / "__init__.py").is_file()] == []


def test_every_data_file_is_packed() -> None:
    """Files that are not Python reach the wheel only by a pattern of package-data."""
    patterns: dict[str, list[str]] = SETUPTOOLS["package-data"]
    left_out = [
        str(path)
        for package, path in _package_files()
        if path.suffix != ".py" and not any(fnmatch(path.name, glob) for glob in patterns.get(package, []))
    ]
    assert left_out == []


def test_every_data_pattern_finds_a_file() -> None:
    """A pattern that matches nothing is a file that was moved."""
    found = {(package, path.name) for package, path in _package_files()}
    for package, patterns in SETUPTOOLS["package-data"].items():
        for pattern in patterns:
            assert any(owner == package and fnmatch(name, pattern) for owner, name in found), (
                package,
                pattern,
            )


@pytest.mark.parametrize("wing", WINGS)
def test_wing_is_mapped_and_linked(wing: str) -> None:
    """Built and in-place imports meet the same folder: package-dir maps it, a relative link stands for it."""
    assert SETUPTOOLS["package-dir"][f"trochoid.{wing}"] == wing
    link = ROOT / "trochoid" / wing
    assert link.is_symlink()
    assert link.readlink() == Path("..", wing)


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="not a git checkout")
def test_links_are_committed_as_links() -> None:
    """Git records the four links as links (mode 120000), not as copies."""
    command = ["git", "ls-files", "--stage", *(f"trochoid/{wing}" for wing in WINGS)]
    staged = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    assert [line.split()[0] for line in staged] == ["120000"] * len(WINGS)


@pytest.mark.parametrize("line", PYPROJECT["project"]["dependencies"] + _group("dev"))
def test_dependency_has_a_lower_bound_only_and_is_locked(line: str) -> None:
    """pyproject.toml says what is enough, the lock what is installed; the second satisfies the first."""
    requirement = Requirement(line)
    assert [clause.operator for clause in requirement.specifier] == [">="]
    assert requirement.specifier.contains(_locked("requirements-dev.lock")[requirement.name])


def test_dependencies_to_run_are_the_same_in_both_locks() -> None:
    """What is tested is what users get."""
    assert _locked("requirements.lock").items() <= _locked("requirements-dev.lock").items()


@pytest.mark.parametrize("name", LOCKS)
def test_lock_is_exact_and_names_no_place(name: str) -> None:
    """Every locked project carries a hash, and no address or option of one machine is written down."""
    text = (ROOT / name).read_text(encoding="utf-8")
    blocks = re.split(r"^(?=[a-z0-9])", text, flags=re.MULTILINE)[1:]
    assert [block.split()[0] for block in blocks if "--hash=sha256:" not in block] == []
    assert re.findall(r"://|^--.*", text, flags=re.MULTILINE) == []


def test_one_version_everywhere() -> None:
    """pyproject.toml, the installed program, CITATION.cff and the newest entry of CHANGELOG.md agree."""
    stated = PYPROJECT["project"]["version"]
    assert version("trochoid") == stated
    assert f"\nversion: {stated}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    newest = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), flags=re.MULTILINE)
    assert newest is not None
    assert newest[1] == stated

from __future__ import annotations

from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "cycloid.toml"


@pytest.fixture(scope="session")
def example() -> str:
    """The text of the shipped scene."""
    return EXAMPLE.read_text(encoding="utf-8")

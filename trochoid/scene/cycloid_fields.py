"""What the tables of all drives with cycloid discs ask of their fields."""

from __future__ import annotations

from typing import Any

from trochoid.scene.fields import fault


def ascending(positions: tuple[float, float]) -> tuple[float, float]:
    """Return two places of bearings as they are; a fault unless the lower z comes first."""
    if not positions[0] < positions[1]:
        raise fault(
            f"given {positions[0] * 1e3:g} and {positions[1] * 1e3:g} mm; need two places, the lower z first"
        )
    return positions


def one_less_than_pins(data: dict[str, Any]) -> int:
    """Return the lobes that go with the pins of a table."""
    pins: int = data["pins"]
    return pins - 1

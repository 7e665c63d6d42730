"""What means nothing without a torque, and models that a kind of drive lacks, are told before anything is computed."""

from __future__ import annotations

from pathlib import Path

import pytest

from trochoid.faults import SceneFaults
from trochoid.scene import load

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.property
@pytest.mark.parametrize("name", ["load_sharing", "bearing_loads", "reactions", "mesh_stiffness"])
def test_planetary_contacts_need_a_torque(name: str) -> None:
    """No flank of a planetary drive is pressed without one; what asks for no contact is answered."""
    still = "operation.output_torque=0"
    with pytest.raises(
        SceneFaults, match=f'"{name}" needs operation.output_torque above 0: no flank is pressed'
    ):
        load(EXAMPLES / "planetary.toml", [still, f'ask.quantities=["{name}"]'])
    assert load(EXAMPLES / "planetary.toml", [still, 'ask.quantities=["mass", "ratio"]'])


@pytest.mark.property
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("strip", 'given "strip"; khv drives have "springs", "level0", "strips"; did you mean "strips"\\?'),
        ("mesh", 'given "mesh"; khv drives have "springs", "level0", "strips"$'),
    ],
)
def test_models_of_the_kind_alone_are_offered(name: str, said: str) -> None:
    """The nearest name, and those of this kind of drive, not all there are."""
    with pytest.raises(SceneFaults, match=said):
        load(EXAMPLES / "cycloid.toml", [f"accuracy.model={name}"])

"""[operation]: what the drive is asked to do."""

from __future__ import annotations

from typing import Annotated

from trochoid.scene import units
from trochoid.scene.fields import Fraction, Measure, Table


class Operation(Table):
    """[operation]: speed of the input (rad/s), torque at the output (N·m), modal damping ratio."""

    input_speed: Annotated[float, Measure(units.SPEED, above=0.0)]
    output_torque: Annotated[float, Measure(units.TORQUE, least=0.0)]
    damping_ratio: Fraction = 0.02

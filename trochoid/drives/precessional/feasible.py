"""Every reason why a precessional drive cannot be built; none when it can."""

from __future__ import annotations

import math

from trochoid.drives.precessional.design import Design, tooth_of
from trochoid.kinematics.sphere_tooth import SphereTooth
from trochoid.kinematics.sphere_tooth_checks import sphere_tooth_faults


def faults(design: Design) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, the nearest feasible value; last the nearest pair."""
    if design.tooth is None:
        return ()
    found = sphere_tooth_faults(design.tooth)
    if not found:
        return ()
    words = tuple(_in_words_of_the_scene(fault) for fault in found)
    return (*words, *_other_arrangements(design), _proposal(design.tooth))


def _in_words_of_the_scene(fault: str) -> str:
    return fault.replace("nutation = ", "nutation_angle = ", 1) if fault.startswith("nutation = ") else fault


def _other_arrangements(design: Design) -> tuple[str, ...]:
    """Say with which side of the pins, or with pins on which member, the angles can stay as they are."""
    from trochoid.kinematics.sphere_tooth_search import pin_limit

    teeth, found = design.teeth, []
    if teeth is None:
        return ()
    for pins_on in dict.fromkeys((teeth.pins_on, "ring", "satellite")):
        for lobed in ("inside", "outside"):
            other = tooth_of(
                design.nutation, teeth.model_copy(update={"pins_on": pins_on, "lobed_member": lobed})
            )
            if other != design.tooth and other.pin_angle < pin_limit(other):
                found.append(f'pins_on = "{pins_on}" with lobed_member = "{lobed}"')
    return (f"these angles can be kept with {', or '.join(found)}",) if found else ()


def _proposal(tooth: SphereTooth) -> str:
    """Say which pair with the same numbers of teeth is nearest and free of undercut."""
    from trochoid.kinematics.errors import NotConverged
    from trochoid.kinematics.sphere_tooth_search import nearest_feasible

    teeth = f"{tooth.pins} pins and {tooth.lobes} lobes"
    try:
        near = nearest_feasible(tooth)
    except NotConverged:
        return (
            f"no pair of {teeth} free of undercut was found near these angles; take a smaller nutation_angle"
        )
    angles = (
        ("nutation_angle", near.nutation),
        ("teeth.polar_angle", near.polar_angle),
        ("teeth.pin_angle", near.pin_angle),
    )
    said = ", ".join(f"{name} = {math.degrees(angle):.6g}" for name, angle in angles)
    return f"the nearest pair of {teeth} that can be made (least change of all three angles): {said} deg"

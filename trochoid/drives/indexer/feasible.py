"""Every reason why the wheel cannot be built; none when it can."""

from __future__ import annotations

import math
from collections.abc import Mapping

from trochoid.drives.indexer.design import Design
from trochoid.drives.indexer.wheel import hub_angle
from trochoid.kinematics.indexer_slot import Slot

SLIM = 100.0  # times its thickness, up to which slots are as long in a wheel of finite elements


def faults(design: Design, slot: Slot, play: float = 0.0) -> tuple[str, ...]:
    """Return one sentence per fault: what was given, the limit, the nearest feasible value.

    Slots are wider than the pin by the `play` (m).
    """
    return _shell(design) + _hub(design, slot) + _walls(design, slot, play) + _length(design, slot)


def pin_faults(design: Design) -> tuple[str, ...]:
    """Return why the pin cannot be held as the scene says; empty when it can."""
    d = design.drive
    most = d.sphere_radius - 0.5 * d.wheel.thickness
    if d.pin.overhang < most:
        return ()
    return (
        f"pin.overhang = {_mm(d.pin.overhang)}: the pin would be held beyond the centre of the sphere; "
        f"it must be less than sphere_radius - wheel.thickness/2 = {_mm(most)}",
    )


def play_faults(design: Design, slot: Slot) -> tuple[str, ...]:
    """Return why slots wider than the pin by its play have no room; empty where they have."""
    d, between = design.drive, between_slots(design, slot)
    if 2.0 * d.pin_radius >= between or 2.0 * d.pin_radius + d.pin.play < between:
        return ()
    return (
        f"pin.play = {_mm(d.pin.play)}: neighbouring slots, wider by that than a pin with pin_radius = "
        f"{_mm(d.pin_radius)}, run into each other; it must be less than {_mm(between - 2.0 * d.pin_radius)}",
    )


def too_thin(design: Design, slots: Mapping[str, Slot]) -> str:
    """Return why a wheel is no body for finite elements, much thinner than its slots are long; empty where it is."""
    thickness = design.drive.wheel.thickness
    length = max(slot_length(design, slot) for slot in slots.values())
    if thickness * SLIM >= length:
        return ""
    return (
        f"wheel.thickness = {_mm(thickness)} beside slots {_mm(length)} long: finite elements are for "
        f"{_mm(length / SLIM)} and more"
    )


def slot_length(design: Design, slot: Slot) -> float:
    """Length (m, on the sphere) from the rim to the bottom of the slot that the pin needs."""
    d = design.drive
    return d.sphere_radius * (slot.farthest - slot.nearest) + d.pin_radius + d.wheel.slot_clearance


def bottom_to_hub(design: Design, slot: Slot, length: float) -> float:
    """Distance (m, on the sphere) left between the bottom of a slot of this length and the hub, or the axis."""
    return design.drive.sphere_radius * (slot.farthest - hub_angle(design)) - length


def between_slots(design: Design, slot: Slot) -> float:
    """Least distance (m, on the sphere) between the middles of neighbouring slots' ends; infinite for one slot."""
    if design.slots < 2:
        return math.inf
    half = 0.5 * design.drive.swing_angle
    ends = (slot.nearest, slot.farthest)
    return design.drive.sphere_radius * min(2.0 * math.asin(math.sin(x) * math.sin(half)) for x in ends)


def _shell(design: Design) -> tuple[str, ...]:
    d = design.drive
    if d.wheel.thickness < 2.0 * d.sphere_radius:
        return ()
    return (
        f"wheel.thickness = {_mm(d.wheel.thickness)}: the shell would reach beyond the centre of the sphere; "
        f"it must be less than 2 sphere_radius = {_mm(2.0 * d.sphere_radius)}",
    )


def _hub(design: Design, slot: Slot) -> tuple[str, ...]:
    d, needed = design.drive, slot_length(design, slot)
    length = d.wheel.slot_length or needed
    left = bottom_to_hub(design, slot, length)
    if d.wheel.hub_radius >= d.sphere_radius:
        return (
            f"wheel.hub_radius = {_mm(d.wheel.hub_radius)}: the hub would hold the whole sphere; "
            f"it must be less than sphere_radius = {_mm(d.sphere_radius)}",
        )
    if left > 0.0:
        return ()
    nearest, spare = d.sphere_radius * slot.nearest, length - needed
    what = "the hub" if d.wheel.hub_radius > 0.0 else "the wheel's axis"
    if left + spare > 0.0:
        return (
            f"wheel.slot_length = {_mm(needed + spare)}: slots would cut {what}; "
            f"it must be less than {_mm(needed + spare + left)}",
        )
    bottom = nearest - d.pin_radius - d.wheel.slot_clearance
    if bottom > 0.0:
        limit = d.sphere_radius * math.sin(bottom / d.sphere_radius)
        return (
            f"wheel.hub_radius = {_mm(d.wheel.hub_radius)}: the pin comes to {_mm(nearest)} from the wheel's axis, "
            f"its slot would cut the hub; it must be less than {_mm(limit)}",
        )
    return (
        f"pin_radius + wheel.slot_clearance = {_mm(d.pin_radius + d.wheel.slot_clearance)}: the pin comes to "
        f"{_mm(nearest)} from the wheel's axis, its slot would cut it; they must be less than {_mm(nearest)}",
    )


def _walls(design: Design, slot: Slot, play: float) -> tuple[str, ...]:
    between = between_slots(design, slot)
    if 2.0 * design.drive.pin_radius < between:
        return ()
    room = between - play if play < between else between  # otherwise it is the play that has no room
    return (
        f"pin_radius = {_mm(design.drive.pin_radius)}: neighbouring slots, {math.degrees(design.drive.swing_angle):g}° "
        f"apart, run into each other; it must be less than {_mm(0.5 * room)}",
    )


def _length(design: Design, slot: Slot) -> tuple[str, ...]:
    given, needed = design.drive.wheel.slot_length, slot_length(design, slot)
    if given is None or given >= needed:
        return ()
    return (
        f"wheel.slot_length = {_mm(given)}: the pin would strike the bottom of its slot; "
        f"it must be at least {_mm(needed)}",
    )


def _mm(length: float) -> str:
    return f"{1e3 * length:.6g} mm"

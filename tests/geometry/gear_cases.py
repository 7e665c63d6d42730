"""Teeth that several tests cut: external ones, a pointed one, and a ring's."""

from __future__ import annotations

from trochoid.geometry.gear_tooth import Tooth, sharpest
from trochoid.kinematics.involute import Gear
from trochoid.kinematics.rack import Rack, rack_cut
from trochoid.kinematics.shaper import Shaper, shaper_cut

MODULE = 2e-3


def external(teeth: int, shift: float = 0.0, short: float = 0.0, module: float = MODULE) -> Tooth:
    """Return rack-cut teeth of full height, less `short` modules."""
    gear = Gear(teeth, module, shift=shift)
    tip = gear.pitch_radius + module * (1.0 + shift - short)
    return Tooth(rack_cut(gear, Rack(module)), tip, sharpest(gear))


def pointed(teeth: int = 12, shift: float = 1.0) -> Tooth:
    """Return teeth whose flanks meet at the tip circle."""
    gear = Gear(teeth, MODULE, shift=shift)
    return Tooth(rack_cut(gear, Rack(MODULE)), float(gear.point_radius), sharpest(gear))


def ring(teeth: int = 80, shift: float = 1.768) -> Tooth:
    """Return the ring of the set of sources §4: cutter z0 = 25, x0 = 0.15, d_a0 = 55.6 mm; tip circle 81.326 mm."""
    gear = Gear(teeth, MODULE, shift=shift, internal=True)
    return Tooth(shaper_cut(gear, Shaper(25, 0.15, 55.6e-3)), 81.326e-3, sharpest(gear))

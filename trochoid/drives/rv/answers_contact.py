"""Answers from the contacts over a turn of the crankshafts."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from trochoid.drives.exact import ARCMIN
from trochoid.drives.mesh_error import Pair, scalar_error
from trochoid.drives.rv.numbers import over_turn
from trochoid.drives.rv.stages import Stages
from trochoid.kinematics.types import Array
from trochoid.results.outcome import Parts, Quantity

if TYPE_CHECKING:
    from trochoid.drives.rv.reversal import Reversal
    from trochoid.drives.rv.running import Running
    from trochoid.drives.rv.series import Series, Touches
    from trochoid.drives.rv.teeth import Teeth

LINES = {"crankshaft": (1, 1), "crankshaft_twice": (2, 1), "ring_pins": (1, 0), "ring_pins_twice": (2, 0)}


def load_sharing(s: Stages) -> Quantity:
    """How the torque is shared by crankshafts and discs, and the load of a disc by its pins."""
    parts = {
        "crankshaft_share_max_input": over_turn(s, lambda x: float(_shares(x.mesh_force).max()), ""),
        "crankshaft_share_max_output": over_turn(s, lambda x: float(crank_shares(s, x).max()), ""),
        "disc_torque_share_max": over_turn(s, lambda x: float(disc_shares(s, x).max()), ""),
        "pin_force_share_max": over_turn(s, _pin_share, ""),
        "loaded_pins_mean": over_turn(s, lambda x: float((x.ring.force > 0).sum(axis=2).mean()), ""),
        "loaded_rollers_mean": over_turn(s, lambda x: float((x.arm.force > 0).sum(axis=3).mean()), ""),
    }
    note = "input: torque of the sun by its planets; output: torque of the carrier by the crank bearings"
    if _rigid(s):
        del parts["crankshaft_share_max_output"]
        note = "input: torque of the sun by its planets; what rigid crank bearings carry is not determined"
    return Quantity(parts=parts, note=note)


def _rigid(s: Stages) -> bool:
    """Whether crankshafts and their bearings are rigid, so that nothing tells the forces in the bearings."""
    return not s.scene.has("bearing_compliance")


def _shares(parts: Array) -> Array:
    whole = parts.sum(axis=1, keepdims=True)
    return np.asarray(np.divide(parts, whole, out=np.zeros_like(parts), where=whole != 0))


def crank_shares(s: Stages, series: Series) -> Array:
    """Share (n, j) of each crankshaft in the torque that the crank bearings give the carrier."""
    force, place = series.bearing_force.sum(axis=2), s.design.crank_places
    return _shares(place[:, 0] * force[..., 1] - place[:, 1] * force[..., 0])


def disc_shares(s: Stages, series: Series) -> Array:
    """Share (n, d) of each disc in the torque of the ring pins about the axis."""
    push, point = series.ring.force[..., None] * series.ring.normal, series.ring.point
    return _shares((point[..., 0] * push[..., 1] - point[..., 1] * push[..., 0]).sum(axis=2))


def _pin_share(series: Series) -> float:
    force = series.ring.force
    whole = force.sum(axis=2)
    return float(np.divide(force.max(axis=2), whole, out=np.zeros_like(whole), where=whole > 0).max())


def contact_force_max(s: Stages) -> Quantity:
    """Largest force of each kind of contact."""
    parts = _largest(s, lambda touches: touches.force, 1.0, "N")
    return Quantity(parts={**parts, "teeth": over_turn(s, lambda x: float(np.abs(x.mesh_force).max()), "N")})


def contact_pressure_max(s: Stages) -> Quantity:
    """Largest contact pressure at ring pins and rollers."""
    return Quantity(parts=_largest(s, lambda touches: touches.pressure, 1e-6, "MPa"))


def _largest(s: Stages, get: Callable[[Touches], Array], scale: float, unit: str) -> dict[str, Quantity]:
    return {
        "ring_pins": over_turn(s, lambda x: float(get(x.ring).max()) * scale, unit),
        "arm_rollers": over_turn(s, lambda x: float(get(x.arm).max()) * scale, unit),
    }


def bearing_loads(s: Stages) -> Quantity:
    """Loads of the crank bearings and of the turning-arm bearings over a turn of the crankshafts."""
    parts: dict[str, Quantity] = {}
    for b, place in enumerate("AB"):

        def mean(x: Series, b: int = b) -> float:
            return float(_crank(x)[..., b].mean())

        def largest(x: Series, b: int = b) -> float:
            return float(_crank(x)[..., b].max())

        parts[f"crank_{place}_mean"] = over_turn(s, mean, "N")
        parts[f"crank_{place}_max"] = over_turn(s, largest, "N")
    parts["arm_mean"] = over_turn(s, lambda x: float(_arm(x).mean()), "N")
    parts["arm_max"] = over_turn(s, lambda x: float(_arm(x).max()), "N")
    parts["arm_roller_max"] = over_turn(s, lambda x: float(x.arm.force.max()), "N")
    parts["main_force_max"] = over_turn(s, lambda x: _largest_of(_on_carrier(s, x)[0]), "N")
    parts["main_moment_max"] = over_turn(s, lambda x: _largest_of(_on_carrier(s, x)[1]), "N*m")
    note = "over all crankshafts and a turn of them, A at the lower z; main: what the carrier passes on to its bearings"
    if _rigid(s):
        note = "what rigid crank bearings carry is not determined; list bearing_compliance"
        parts = {name: part for name, part in parts.items() if name.startswith("arm")}
    return Quantity(parts=parts, note=note)


def _on_carrier(s: Stages, series: Series) -> tuple[Array, Array]:
    """Force (n, 2) of all crankshafts on the carrier, N, and the vector (n, 2) Σ z F of their tilting moment, N·m."""
    force = series.bearing_force.sum(axis=1)
    return force.sum(axis=1), np.einsum("b,nbx->nx", s.scene.drive.crankshaft.bearing_positions, force)


def _largest_of(vectors: Array) -> float:
    return float(np.linalg.norm(vectors, axis=-1).max())


def _crank(series: Series) -> Array:
    """Force (n, j, 2) in each crank bearing, N."""
    return np.asarray(np.linalg.norm(series.bearing_force, axis=-1))


def _arm(series: Series) -> Array:
    """Force (n, d, j) of each turning-arm bearing, N."""
    return np.asarray(np.linalg.norm(series.arm.resultant, axis=-1))


def transmission_error(s: Stages) -> Quantity:
    """Loaded transmission error of the driven member over a turn of the crankshafts, its mean, and its lines."""
    from trochoid.drives.rv.spectrum import order_of, twist_lines

    scale = 1 / (ARCMIN * s.design.leverage)
    parts: dict[str, Quantity | Parts] = {
        "peak_to_peak": over_turn(s, lambda x: float(np.ptp(x.twist)) * scale * 60, "arcsec"),
        "wind_up": over_turn(s, lambda x: float(x.twist.mean()) * scale, "arcmin"),
    }
    lines = twist_lines(s.contact.fine)
    speed = s.scene.operation.input_speed / (2 * np.pi)
    for name, (times, of_crank) in LINES.items():
        number = times if of_crank else times * s.design.flank.lobes
        if number >= len(lines):
            continue
        order = number * order_of(s.design)
        parts[name] = {
            "order": Quantity(order, "", None, "exact"),
            "frequency": Quantity(order * speed, "Hz", None, "exact"),
            "amplitude": Quantity(float(lines[number]) * scale * 60, "arcsec", None, s.rung),
        }
    resists = not np.isnan(s.contact.fine.compliance).any()
    note = "orders are multiples of the input speed" if resists else "free within its play: one angle of many"
    return Quantity(parts=parts, note=note)


def torsional_stiffness(s: Stages) -> Quantity:
    """Torque per angle at the driven member with the driving one held: the tangent at the load, mean compliance."""
    if np.isnan(s.contact.fine.compliance).any():
        return Quantity(0.0, "N*m/arcmin", 0.0, s.rung, note="nothing touches: the drive does not resist")
    scale = ARCMIN * s.design.leverage**2  # from the ring to the driven member
    answer = over_turn(s, lambda x: scale / float(x.compliance.mean()), "N*m/arcmin")
    note = "tangent at the operating torque, of the mean compliance over a turn; see stiffness_breakdown"
    return Quantity(answer.value, answer.unit, answer.error, answer.model, note=note)


def stiffness_breakdown(s: Stages) -> Quantity:
    """What each part adds to the compliance at the driven member, and its share of the whole."""
    from trochoid.drives.rv.breakdown import PARTS

    if np.isnan(s.contact.fine.compliance).any():
        return Quantity(parts={"total": torsional_stiffness(s)}, note="nothing touches: no part yields")
    scale = 1e3 / (ARCMIN * s.design.leverage**2)
    parts: dict[str, Quantity | Parts] = {}
    for p, name in enumerate(PARTS):

        def compliance(x: Series, p: int = p) -> float:
            return scale * float(x.parts[:, p].mean())

        share = 100 * float(s.contact.fine.parts[:, p].mean() / s.contact.fine.compliance.mean())
        parts[name] = {
            "compliance": over_turn(s, compliance, "arcmin/(kN*m)"),
            "share": Quantity(share, "%", None, s.rung),
        }
    parts["total"] = {
        "compliance": over_turn(s, lambda x: scale * float(x.compliance.mean()), "arcmin/(kN*m)"),
        "share": Quantity(100.0, "%", None, s.rung),
    }
    return Quantity(parts=parts, note="at the driven member; the parts add up to the total")


def mesh_stiffness(s: Stages) -> Quantity:
    """Stiffness of the teeth of one planet with the sun along the line of action, over a base pitch."""
    from trochoid.drives.rv.teeth import iso_stiffness

    iso = {"iso_6336": Quantity(1e-6 * iso_stiffness(s.feasible), "N/um", None, "c_γα·b")}
    given = s.scene.drive.first_stage.mesh_stiffness
    if given is not None:
        return Quantity(parts={"given": Quantity(1e-6 * given, "N/um", None, "given"), **iso})

    def number(get: Callable[[Teeth], float], unit: str) -> Quantity:
        fine, coarse = get(s.teeth.fine), get(s.teeth.coarse or s.teeth.fine)
        return Quantity(fine, unit, scalar_error(fine, coarse), "level0")

    parts = {
        "mean": number(lambda x: 1e-6 * x.mean, "N/um"),
        "min": number(lambda x: 1e-6 * float(x.stiffness.min()), "N/um"),
        "max": number(lambda x: 1e-6 * float(x.stiffness.max()), "N/um"),
        "transmission_error": number(lambda x: 1e6 * float(np.ptp(x.error)), "um"),
        **iso,
    }
    return Quantity(
        parts=parts, note="elastic gears at the nominal load; the drive is computed with the mean"
    )


def lost_motion(s: Stages) -> Quantity:
    """Angle of the driven member between 3 % of its torque to either side, the driving member held."""
    found = s.reversal
    stage = found.fine.first_stage / ARCMIN

    def number(get: Callable[[Reversal], float]) -> Quantity:
        both: Pair[float] = found.map(lambda x: get(x) / ARCMIN)
        coarse = both.fine if both.coarse is None else both.coarse
        return Quantity(both.fine, "arcmin", scalar_error(both.fine, coarse, s.difference), s.rung)

    return Quantity(
        parts={
            "mean": number(lambda x: float(x.total.mean())),
            "max": number(lambda x: float(x.total.max())),
            "cycloid_stage": number(lambda x: float(x.width.mean())),
            "first_stage": Quantity(stage, "arcmin", None, "exact"),
        },
        note="without friction; over held angles of a turn of the crankshafts",
    )


def efficiency(s: Stages) -> Quantity:
    """Output power over input power, mean over a turn of the crankshafts: what pins and teeth leave."""
    given = s.scene.operation.output_torque / abs(
        float(s.design.speeds.ratio)
    )  # work per radian of the input
    note = "friction at ring pins and teeth; without bearings, seals and oil"
    answer = _of_losses(s, lambda x: given / (given + _lost(s, x.pins.sum(axis=1) + x.teeth)), "")
    return Quantity(answer.value, "", answer.error, answer.model, note=note)


def power_loss(s: Stages) -> Quantity:
    """Power lost at ring pins and at the teeth of sun and planets, mean over a turn of the crankshafts."""
    speed = s.scene.operation.input_speed
    return Quantity(
        parts={
            "ring_pins": _of_losses(s, lambda x: speed * _lost(s, x.pins.sum(axis=1)), "W"),
            "teeth": _of_losses(s, lambda x: speed * _lost(s, x.teeth), "W"),
            "total": _of_losses(s, lambda x: speed * _lost(s, x.pins.sum(axis=1) + x.teeth), "W"),
        }
    )


def _lost(s: Stages, per_crank: Array) -> float:
    """Mean loss per radian of the input, from that per radian of the crankshafts."""
    return abs(s.design.turning) * float(per_crank.mean())


def _of_losses(s: Stages, get: Callable[[Running], float], unit: str) -> Quantity:
    both = s.losses.map(get)
    coarse = both.fine if both.coarse is None else both.coarse
    return Quantity(both.fine, unit, scalar_error(both.fine, coarse), s.rung)

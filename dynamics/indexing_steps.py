"""A step in time of a driven wheel by Runge and Kutta's method of fourth order."""

from __future__ import annotations

from trochoid.dynamics.indexing_parts import Grip, Output, Piece, Rates, State, Three, Torque


def rates(
    out: Output, torque: Torque, d: float, p: float, e: float, g: float, at: Three, grip: Grip
) -> Rates:
    """Return d'', e'', and the powers of the pin and of what is lost; `at`: α, ψ', ψ''."""
    reach, v, a = at
    tau = torque(d, p, reach)
    brake = 0.0 if grip.held else grip.sign * out.friction
    if out.shaft == 0.0:
        gained = 0.0 if grip.held else (tau - brake) / out.inertia
        return a - gained, 0.0, tau * (v - p), brake * (v - p)
    back = out.shaft * (e + out.damping * g)
    a1 = (tau - back) / out.inertia
    a2 = 0.0 if grip.held else (back - brake) / out.load
    return a - a1, a1 - a2, tau * (v - p), out.shaft * out.damping * g * g + brake * (v - p - g)


def runge_kutta(out: Output, torque: Torque, y: State, piece: Piece, grip: Grip) -> State:
    """Step by Runge and Kutta's method of fourth order."""
    d, p, e, g, work, loss = y
    h = piece.length
    half, sixth = 0.5 * h, h / 6.0
    start, middle, end = zip(piece.reach, piece.base, piece.drive, strict=True)
    p1, g1, w1, l1 = rates(out, torque, d, p, e, g, start, grip)
    pb, gb = p + half * p1, g + half * g1
    p2, g2, w2, l2 = rates(out, torque, d + half * p, pb, e + half * g, gb, middle, grip)
    pc, gc = p + half * p2, g + half * g2
    p3, g3, w3, l3 = rates(out, torque, d + half * pb, pc, e + half * gb, gc, middle, grip)
    pd, gd = p + h * p3, g + h * g3
    p4, g4, w4, l4 = rates(out, torque, d + h * pc, pd, e + h * gc, gd, end, grip)
    return (
        d + sixth * (p + 2.0 * (pb + pc) + pd),
        p + sixth * (p1 + 2.0 * (p2 + p3) + p4),
        e + sixth * (g + 2.0 * (gb + gc) + gd),
        g + sixth * (g1 + 2.0 * (g2 + g3) + g4),
        work + sixth * (w1 + 2.0 * (w2 + w3) + w4),
        loss + sixth * (l1 + 2.0 * (l2 + l3) + l4),
    )

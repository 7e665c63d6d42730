"""Reactions and vibration: members, masses, springs and loads.

The data flow, for one record of equally spaced positions (one input turn, or any other period):

    loads on a shaft, rotating masses ──► newton_euler ──► support reactions of rigid members
    quasi-static motion, M, K(φ) ──► elastic (hill: all harmonics) ──► Response ──► supports ──► what elasticity adds
                            └──► floquet: is it stable?         └──► work: does its energy balance?
    all that members put on the casing ──► wrench ──► casing (mounts) ──► Vibration ──► zones ──► Zone
                                             └──► balance: the sum of reactions is the sum of inertia forces

Conventions.  Axis z along the shafts, moments right-handed, SI.  A *reaction* is the force of a support on
the member; the casing feels its negative.  Inertia forces are d'Alembert's, −m a, and are loads like any
other.  Harmonic h of a record has the frequency h·(base frequency); complex amplitudes are peak values,
x(t) = Re Σ c_h exp(i h ω t).  The casing stands still while the members are analysed; its own motion is found
afterwards and does not act back.

No module here knows gears.
"""

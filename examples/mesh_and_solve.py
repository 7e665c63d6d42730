"""One cycloid disc from its profile to its stresses: python examples/mesh_and_solve.py disc.vtu"""

import sys

import meshio
import numpy as np

from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.material import Material
from trochoid.fem.pair import FlankPair, Member, Seat
from trochoid.fem.position import Assembly, ElasticBody, Family, solve_position
from trochoid.fem.stress import pressed
from trochoid.fem.stress_field import stress_field
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.kinematics.curve import ArcLength, Circle
from trochoid.kinematics.cycloid import Cycloid, Modification

PINS, LOBES, R, r, e, WIDTH, TORQUE, CRANK = 20, 19, 80e-3, 5e-3, 2.5e-3, 10e-3, 200.0, np.radians(10)  # SI
flank = Cycloid(PINS, LOBES, R, r, e)
outline = disc_outline(flank, 25e-3, 8, 52e-3, 9e-3, 0.0, facets_per_lobe=12)  # bore; 8 holes on a circle
steel = Material(youngs_modulus=210e9, poissons_ratio=0.3).plane("strain")
body = build_body(mesh_outline(outline), steel, supports=("bore",))
elastic = ElasticBody(press(body, [outline.outer]), WIDTH)

# one unknown motion, the turning of the disc; the ring and its rigid pins stand still
disc = Member(e * np.array([np.cos(CRANK), np.sin(CRANK)]), -CRANK / LOBES, np.array([[0.0], [0.0], [1.0]]))
ring = Member(np.zeros(2), 0.0, np.zeros((3, 1)))
k, centers = np.arange(PINS), Circle((0.0, 0.0), R).point(2 * np.pi * np.arange(PINS) / PINS)
seat = Seat.on(0, [elastic.compliance.surfaces["flank"]] * PINS)
start = flank.contact_parameter(k, CRANK)
pair = FlankPair(disc, ring, flank, Modification(), 0.0, centers, start, ArcLength(flank), seat)
pins = Family("pins", pair, kernel=np.full(PINS, steel.kernel / WIDTH), round_side=np.zeros(PINS))
contact = solve_position(Assembly((pins,), (elastic,), springs=np.zeros((1, 1)), load=np.array([-TORQUE])))

touch, turned = contact.touches["pins"], disc.displaced(contact.motion)[1]
print(f"rotation {1e6 * contact.motion[0]:.3f} urad, pin forces in N:", *np.round(touch.force, 2))
field = stress_field(body, pressed(touch, ["flank"] * PINS, turned, WIDTH))
points, moved = (np.pad(v, ((0, 0), (0, 1))) for v in (field.points, field.displacement))
data = {"displacement": moved, "von_mises": field.von_mises}
meshio.Mesh(points, [("triangle6", field.triangles.T)], data).write(sys.argv[1])

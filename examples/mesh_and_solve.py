"""One cycloid disc, from its profile to its stresses: python examples/mesh_and_solve.py disc.vtu"""

import sys

import meshio
import numpy as np

from trochoid.fem.body import build_body
from trochoid.fem.compliance import press
from trochoid.fem.material import Material
from trochoid.fem.pair import FlankPair, Member
from trochoid.fem.position import Assembly, ElasticBody, Family, solve_position
from trochoid.fem.stress import pressed
from trochoid.fem.stress_field import stress_field
from trochoid.geometry.disc import disc_outline
from trochoid.geometry.mesh import mesh_outline
from trochoid.kinematics.cycloid import Cycloid
from trochoid.kinematics.motion import khv_motions

crank, torque, width = np.radians(10), 200.0, 10e-3  # all in SI units
flank = Cycloid(pins=20, lobes=19, pin_circle_radius=80e-3, pin_radius=5e-3, eccentricity=2.5e-3)
outline = disc_outline(flank, 25e-3, 8, 52e-3, 9e-3, 0.0, facets_per_lobe=12)  # bore, ring of 8 holes
steel = Material(youngs_modulus=210e9, poissons_ratio=0.3).plane("strain")
body = build_body(mesh_outline(outline), steel, supports=("bore",))
elastic = ElasticBody(press(body, [outline.outer]), width)
# the disc may turn, the only motion that is not known; the ring with its rigid pins stands still
pose = khv_motions(flank, crank)["disc0"]
disc = Member(pose.center[0], pose.rotation[0], moves=np.array([[0.0], [0.0], [1.0]]))
ring = Member(np.zeros(2), 0.0, moves=np.zeros((3, 1)))
pair = FlankPair.nominal(disc, ring, flank, crank, elastic.compliance.surfaces["flank"])
pins = Family("pins", pair, kernel=np.full(20, steel.kernel / width), round_side=np.zeros(20))
contact = solve_position(Assembly((pins,), (elastic,), np.zeros((1, 1)), load=np.array([torque])))
touch, angle = contact.touches["pins"], disc.displaced(contact.motion)[1]
print(f"the disc turns by {1e6 * contact.motion[0]:.3f} urad; pin forces in N:")
print(*(f"{force:.2f}" for force in touch.force))
field = stress_field(body, pressed(touch, ["flank"] * 20, angle, width))
points, moved = (np.pad(plane, ((0, 0), (0, 1))) for plane in (field.points, field.displacement))
data = {"displacement": moved, "von_mises": field.von_mises}
meshio.Mesh(points, [("triangle6", field.triangles.T)], point_data=data).write(sys.argv[1])

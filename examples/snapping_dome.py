"""A shallow dome snaps under a force from above: every equilibrium on the way.

Under a given force the dome jumps at the maximum. The arc length follows the path beyond it, through states that a
force does not reach. It comes back to no load with the dome turned over: there is another equilibrium without a force.
"""

from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.units import kPa, mm

RADIUS, RISE, WALL = 20 * mm, 8 * mm, 1.5 * mm

disc = tg.bodies.RoundBar(radius=RADIUS, length=WALL, mirrors="yz")
mesh = tg.mesh(disc.build(), size=4 * mm)
across = np.linalg.norm(mesh.points[:, 1:], axis=1) / RADIUS
mesh = replace(mesh, points=mesh.points + np.outer(RISE * (1 - across**2), [1, 0, 0]))  # the disc is arched
rim = tg.supports.NodesAt("rim", box=((-RADIUS, -RADIUS, -RADIUS), (-WALL / 2 + 1e-5, RADIUS, RADIUS)))
stress = 3 * kPa
model = tg.Model(
    mesh,
    materials={"body": tg.from_library("dragon-skin-30", record="yeoh-chen-2018")},
    supports=[tg.Fixed(rim)],  # its lower edge, so that it can turn
    loads=[tg.Traction("ends", (-stress, 0, 0))],  # on both faces of the disc
)
first = tg.solutions.buckling_modes(model, count=1).load_factors[0]
solution = tg.solve(model, tg.ArcLength())

force = 2 * stress * np.pi * RADIUS**2
snap, crown = solution.limit_points[0], np.linalg.norm(mesh.points[:, 1:], axis=1).argmin()
moved = -solution.states[-1].displacement[crown, 0]
print(solution.message)
print(f"The dome snaps at {force * snap.load_factor:.2f} N, its crown moves by {moved / mm:.1f} mm.")
print(f"Linear buckling from rest would say {force * first:.2f} N.")
assert moved > RISE, "the dome is turned over, and no force acts"

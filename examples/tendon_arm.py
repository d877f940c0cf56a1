"""A cable along one side bends a soft bar: what friction at the guides takes of the angle.

Every section of the bar carries the tension times the distance of the cable from its axis as a moment.
"""

import numpy as np

import turgor as tg
from turgor.units import N, deg, kPa, mm

LENGTH, SIDE, TENSION, FRICTION = 80 * mm, 8 * mm, 0.4 * N, 0.3

bar = tg.bodies.Block(length=LENGTH, width=SIDE, height=SIDE, mirrors="y")
mesh = tg.mesh(bar.build(), size=5 * mm)
end = -LENGTH / 2
clamp = tg.Fixed(tg.supports.NodesAt("clamp", box=((end, -SIDE, -SIDE), (end + 1e-6, SIDE, SIDE))))
rubber = tg.Material(name="silicone", law=tg.laws.NeoHooke(C10=60 * kPa))
guides = [(x, 0, SIDE / 2) for x in np.linspace(end, -end, 9)]


def angle(friction: float) -> float:
    """Angle of the bar between its first and its last guide [rad]."""
    cable = tg.loads.Tendon(through=guides, tension=TENSION, friction=friction)
    state = tg.solve(tg.Model(mesh, {"body": rubber}, [clamp], [cable])).states[-1]
    nodes = [np.linalg.norm(mesh.points - guide, axis=1).argmin() for guide in guides[-3:-1]]
    along = np.diff((mesh.points + state.displacement)[nodes], axis=0)[0]
    return float(np.arctan2(along[2], along[0]))


free, rubbed = angle(0.0), angle(FRICTION)
moment, stiffness = TENSION * SIDE / 2, 6 * 60 * kPa * SIDE**4 / 12
formula = moment * (LENGTH * 13 / 16) / stiffness  # the last piece but one lies 13/16 of the way along
print(f"{free / deg:.1f} deg without friction, {rubbed / deg:.1f} deg with; a thin bar {formula / deg:.1f} deg.")
assert abs(free - formula) < 0.05 * formula
assert abs(rubbed - np.log(1 + FRICTION * formula) / FRICTION) < 0.05 * rubbed, "exp(-mu theta) of the tension is left"

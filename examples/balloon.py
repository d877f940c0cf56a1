"""A tube without fibers as a balloon: its pressure rises to a maximum and falls while it is filled further.

A neo-Hookean rubber balloons; one that stiffens at large stretches, as most silicones do, may not.
"""

import turgor as tg
from turgor.units import kPa, mL, mm

tube = tg.actuators.ExtendingCylinder(length=60 * mm)
mesh = tg.mesh(tube.build(), size=6 * mm)
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
model = tg.Model(mesh, materials={"body": rubber}, supports=[tg.Fixed("fixed")], loads=[])

solution = tg.solve(model, tg.VolumeControl(volume=32 * mL))
response = tg.measure(solution, tg.cavity_volume, tg.tip_displacement, tg.measures.maximum_principal_stretch)

(limit,) = solution.limit_points
volume = response.column("injected_volume")[limit.state] / mL
last = response.column("pressure")[-1] / kPa
print(f"{solution.message}")
print(f"The tube holds {limit.pressure / kPa:.1f} kPa at most, with {volume:.1f} mL more than at rest in it.")
assert last < 0.9 * limit.pressure / kPa, "beyond the limit point the pressure falls"

"""A tube is filled with water and sealed; two jaws squeeze it, and the rise of its pressure tells how hard.

Two stages: the second begins where the first one ended. A quarter is modeled; the other jaw is the mirror image of this
one.
"""

import turgor as tg
from turgor.units import N, kPa, mL, mm

tube = tg.actuators.ExtendingCylinder(length=40 * mm)
mesh = tg.mesh(tube.build(), size=6 * mm)
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
bar = tg.obstacles.Box(center=(20 * mm, 0, 18 * mm), size=(12 * mm, 40 * mm, 16 * mm), rounding=2 * mm)
model = tg.Model(
    mesh,
    materials={"body": rubber},
    supports=[tg.Fixed("fixed")],
    loads=[],
    contact=tg.Contact(obstacles=[tg.obstacles.Obstacle(name="jaw", shape=bar)]),
)

procedure = tg.Stages(
    (
        tg.Stage("fill", tg.VolumeControl(volume=1 * mL)),
        tg.Stage("squeeze", tg.Sealed(), moves={"jaw": (0, 0, -4 * mm)}),
    )
)
solution = tg.solve(model, procedure)
filled, squeezed = (next(s for s in reversed(solution.states) if s.stage == name) for name in ("fill", "squeeze"))

rise = (squeezed.pressures["cavity"] - filled.pressures["cavity"]) / kPa
force = -2 * squeezed.touches["jaw"].force.sum(axis=0)[2] / N  # of both quarters below one jaw
volume = tg.measure(solution, tg.cavity_volume).column("cavity_volume") / mL
print(f"{solution.message}")
print(f"Each jaw pushes with {force:.2f} N, which raises the pressure by {rise:.1f} kPa.")
assert abs(volume[-1] / volume[0] - 1 - 1 / volume[0]) < 1e-6, "the water stays in"

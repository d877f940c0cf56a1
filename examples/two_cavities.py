"""Two cavities, one after the other: the upper one bends the actuator down, the lower one straightens it again."""

import turgor as tg
from turgor.units import deg, kPa, mm

bender = tg.actuators.BidirectionalBender()
mesh = tg.mesh(bender.build(), size=6 * mm)
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
model = tg.Model(
    mesh,
    materials={"body": rubber, "strain_limiting_layer": paper},
    supports=[tg.Fixed("fixed")],
    loads=[
        tg.Pressure("cavity_1", 50 * kPa, history=((0, 0), (0.5, 1), (1, 1))),  # up, then constant
        tg.Pressure("cavity_2", 50 * kPa, history=((0, 0), (0.5, 0), (1, 1))),  # then up, too
    ],
)
solution = tg.solve(model)
response = tg.measure(solution, tg.bending_angle, tg.cavity_volume)

angle = response.column("bending_angle") / deg
print(f"{solution.message} Bending angle: {angle.max():.1f} deg half way, {angle[-1]:.2f} deg at the end.")
assert abs(angle[-1]) < 0.02 * angle.max(), "equal pressures above and below the middle wall do not bend it"

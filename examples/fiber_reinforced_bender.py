"""A fiber-reinforced bender: thread keeps a chamber from ballooning, paper on its flat side makes it bend."""

# %% The shape; the half with y >= 0 is modeled.
import turgor as tg
from turgor.units import deg, kPa, mm

bender = tg.actuators.FiberReinforcedBender(length=40 * mm, skin=0.0)
mesh = tg.mesh(bender.build(), size=6 * mm, cells="hexahedra")

# %% Thread goes around the round side and the flat side together; the paper resists bending too.
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
hoops = tg.Fibers(
    face=("outside", "strain_limiting_layer"),
    material=tg.from_library("kevlar-fiber"),
    diameter=0.1778 * mm,
    winding=tg.Winding(angle_from_circumference=0 * deg, spacing=3 * mm),
)

# %% Solve and measure.
model = tg.Model(
    mesh,
    materials={"body": rubber, "strain_limiting_layer": paper},
    supports=[tg.Fixed("fixed")],
    loads=[tg.Pressure("cavity", 10 * kPa)],
    reinforcements=[hoops],
)
solution = tg.solve(model)
response = tg.measure(solution, tg.bending_angle, tg.cavity_volume)
angle, volume = response.column("bending_angle")[-1] / deg, response.column("cavity_volume")
growth = 100 * (volume[-1] / volume[0] - 1)
print(f"{solution.message} Bending angle {angle:.2f} deg; the chamber grew by {growth:.0f} %.")

# %% One number to remember.
assert 3.5 < angle < 4.5, "the thread turns pressure into bending"

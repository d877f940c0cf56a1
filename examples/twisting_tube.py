"""A tube that twists: one helix of Kevlar thread around silicone, 60 degrees from the axis."""

# %% The tube: a helix has no mirror plane, so that all of it is modeled.
import turgor as tg
from turgor.units import deg, kPa, mm

tube = tg.actuators.TwistingTube(length=60 * mm)
mesh = tg.mesh(tube.build(), size=6 * mm, cells="hexahedra")

# %% The thread: its diameter is that of the library's record.
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
helix = tg.Fibers(
    face="outside",
    material=tg.from_library("kevlar-fiber"),
    diameter=0.1778 * mm,
    winding=tg.Winding(angle_from_axis=60 * deg, spacing=2 * mm, hand="right"),
)

# %% Solve and measure.
model = tg.Model(
    mesh,
    materials={"body": rubber},
    supports=[tg.Fixed("fixed")],
    loads=[tg.Pressure("cavity", 30 * kPa)],
    reinforcements=[helix],
)
solution = tg.solve(model)
response = tg.measure(solution, tg.measures.twist_angle, tg.tip_displacement)
twist = response.column("twist_angle")[-1] / deg
print(f"{solution.message} The tip turns by {twist:.1f} deg: a right-handed helix turns it to the left.")

# %% A long tube twists by 0.845 deg per mm (V20 of the verification); near its ends a tube twists a little less.
free = (tube.length - 2 * tube.cap) / mm
assert abs(twist / free + 0.845) < 0.08, "a single helix twists the tube against its hand"

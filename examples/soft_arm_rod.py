"""A hanging arm of two segments as Cosserat rods: chambers on opposite sides bend it to an S and move its tip aside."""

import numpy as np

import turgor as tg
from turgor.units import deg, g, kPa, mm

rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")

# A round arm with two chambers, which fibers keep from bulging, in front of the axis and behind it.
solid = tg.rods.RodSection.from_geometry(tg.rods.Round(radius=10 * mm), rubber)
chambers = (
    tg.rods.RodChamber(name="front", area=50 * mm**2, offset=(0, 6 * mm)),
    tg.rods.RodChamber(name="back", area=50 * mm**2, offset=(0, -6 * mm)),
)
section = tg.rods.RodSection(stiffness=solid.stiffness, mass_per_length=solid.mass_per_length, chambers=chambers)
arm = tg.rods.RodModel(
    rods=[
        tg.rods.Rod(name="upper", section=section, length=100 * mm, end="joint"),
        tg.rods.Rod(name="lower", section=section, length=100 * mm, start="joint", end="tip"),
    ],
    plates=[
        tg.rods.Plate(name="base", support="fixed", place=tg.rods.Place(turn=(0, np.pi / 2, 0))),  # x points down
        tg.rods.Plate(name="tip", mass=20 * g),
    ],
    loads=[
        tg.Gravity((0, 0, -1), history=((0, 0), (0.2, 1), (1, 1))),
        tg.rods.ChamberPressure(chamber="front", rod="upper", pressure=150 * kPa, history=((0, 0), (0.2, 0), (1, 1))),
        tg.rods.ChamberPressure(chamber="back", rod="lower", pressure=150 * kPa, history=((0, 0), (0.2, 0), (1, 1))),
    ],
)
solution = tg.rods.static(arm, at=5)

response = solution.response()
aside = response["tip_displacement_x"][-1]
joint = np.arccos(-solution.plate_axes("joint")[-1, 2, 0])
assert section.mass_per_length is not None, "the rubber has a density"
weight = 9.80665 * (2 * 100 * mm * section.mass_per_length + 20 * g)
print(f"{solution.message} The joint turns by {joint / deg:.0f} deg, the tip moves aside by {aside / mm:.0f} mm.")
assert np.isclose(solution.reaction("base")[2], weight), "the clamp carries the weight"

figure = tg.rods.plot_rods(solution, states=range(1, 6))
if __name__ == "__main__":
    figure.savefig("soft_arm_rod.png", dpi=130)

"""A fast PneuNet in ten lines: from dimensions to a bending angle; the same question as ``fast_pneunet.toml``."""

import turgor as tg
from turgor.units import deg, kPa, mm

finger = tg.FastPneuNet()
mesh = tg.mesh(finger.build(), size=3 * mm)
rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
model = tg.Model(
    mesh,
    materials={"body": rubber, "base": rubber, "strain_limiting_layer": paper},
    supports=[tg.Fixed("fixed")],
    loads=[tg.Pressure("cavity", 22.5 * kPa)],
)
solution = tg.solve(model, tg.Static())
response = tg.measure(solution, tg.bending_angle, tg.cavity_volume)

print(f"{solution.message} Bending angle: {response.column('bending_angle')[-1] / deg:.1f} deg.")
response.to_csv("response.csv")

"""Blocked force: how hard the tip of a PneuNet presses on a plate 1 mm below it."""

import turgor as tg
from turgor.units import N, kPa, mm

finger = tg.FastPneuNet(chambers=3, length=36 * mm, wall=1.5 * mm, channel_wall=1.5 * mm)
mesh = tg.mesh(finger.build(), size=5 * mm)
rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
stiff = tg.from_library("smooth-sil-950", record="neo-hooke-polygerinos-2020")
model = tg.Model(
    mesh,
    materials={"body": rubber, "base": stiff},
    supports=[tg.Fixed("fixed")],
    loads=[tg.Pressure("cavity", 15 * kPa)],
)
solution = tg.solve(tg.setups.blocked_force(model, distance=1 * mm))
response = tg.measure(solution, tg.measures.blocked_force)
force = response.column("blocked_force")[-1]

print(f"{solution.message} The tip presses with {force / N:.2f} N.")

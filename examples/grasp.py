"""Grasp: two PneuNets close around a bar; then the bar is pulled out between them."""

# %% One finger and the bar across it; its middle lies between the fingers.
import turgor as tg
from turgor.units import N, kPa, mm

finger = tg.FastPneuNet(chambers=3, length=36 * mm, wall=1.5 * mm, channel_wall=1.5 * mm)
mesh = tg.mesh(finger.build(), size=5 * mm)
rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
stiff = tg.from_library("smooth-sil-950", record="neo-hooke-polygerinos-2020")
bar = tg.obstacles.Cylinder(center=(20 * mm, 0, -9 * mm), axis=(0, 1, 0), radius=8 * mm)
model = tg.Model(
    mesh,
    materials={"body": rubber, "base": stiff},
    supports=[tg.Fixed("fixed")],
    loads=[tg.Pressure("cavity", 10 * kPa)],
    contact=tg.Contact(obstacles=[tg.obstacles.Obstacle(name="bar", shape=bar, friction=0.5)]),
)

# %% Until load factor 0.5 the fingers close, then the bar moves 3 mm away from the palm.
solution = tg.solve(tg.setups.grasp(model, object="bar", pull_distance=3 * mm), tg.Static(max_step=0.1))
response = tg.measure(solution, tg.measures.pull_distance, tg.measures.grip_force, tg.measures.holding_force)
pull = response.column("pull_distance")
grip = response.column("grip_force")[pull == 0][-1]
holding = response.column("holding_force").max()

print(f"{solution.message} Each finger grips with {grip / N:.2f} N; together they hold {holding / N:.2f} N.")

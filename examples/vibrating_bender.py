"""A bender is filled within 20 ms and swings about where it would rest: overshoot and frequency of the swing."""

import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

bender = tg.actuators.RectangularBender(length=60 * mm)
mesh = tg.mesh(bender.build(), size=6 * mm)
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
materials: dict[str, tg.Material | tg.Shell] = {"body": rubber, "base": rubber, "strain_limiting_layer": paper}
duration, filled = 0.2, 0.02
history = tg.over_time([(0, 0), (filled, 1), (duration, 1)], duration)
model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 50 * kPa, history=history)])

still = tg.solve(model)
modes = tg.natural_frequencies(model, still.states[-1], count=1)
solution = tg.solve(model, tg.Dynamic(duration=duration, stiffness_damping=1e-3, accuracy=1e-3))

response = tg.measure(solution, tg.bending_angle)
angle, time = response.column("bending_angle"), response.column("time")
rest = tg.measure(still, tg.bending_angle).column("bending_angle")[-1]
overshoot = angle.max() / rest - 1
full = time > filled
after, off = time[full], angle[full] - rest
before = np.flatnonzero(np.diff(np.sign(off)))  # crossings lie between two steps, on a straight line
crossings = after[before] - off[before] * np.diff(after)[before] / np.diff(off)[before]
swing = 0.5 * (len(crossings) - 1) / (crossings[-1] - crossings[0])
print(f"{solution.message} The bender rests at {rest / deg:.2f} deg and swings {100 * overshoot:.0f} % beyond,")
assert abs(swing / modes.frequencies[0] - 1) < 0.03, "a small swing has the frequency of the lowest mode"
print(f"with {swing:.1f} Hz; the lowest mode about its rest has {modes.frequencies[0]:.1f} Hz.")

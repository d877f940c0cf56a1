"""A bender of printed TPU is filled twice: it comes back slowly, and not quite to where it was.

The constants in time are stated to show what they do; those of a material come from tests at several rates with
unloading, see `turgor.experiments.fit_flow`.
"""

from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.units import MPa, deg, kPa, mm

law = tg.Material(name="printed TPU", law=tg.Yeoh(C10=0.8 * MPa, C20=0.05 * MPa))
network = tg.laws.BergstromBoyce(stiffness=0.5, rate=0.02, stress=0.5 * MPa, exponent=3.0)
permanent_set = tg.laws.PermanentSet(stress=40 * MPa, exponent=1.2)
rubber = replace(law, viscoelasticity=network, permanent_set=permanent_set)

# an infinitely slow pull of a strip to stretch 1.5: what stays when it is free of stress
pulled = tg.laws.stress_history(replace(law, permanent_set=permanent_set), "uniaxial", [0.0, 1.0], [1.0, 1.5])
largest = 1.5 * float(pulled.nominal_stress[-1])
stays = float(permanent_set.residual_stretch(largest))

bender = tg.actuators.RectangularBender(length=40 * mm)
mesh = tg.mesh(bender.build(), size=6 * mm)
duration = 40.0
history = tg.over_time([(0, 0), (5, 1), (10, 0), (15, 1), (20, 0), (40, 0)], duration)
load = tg.Pressure("cavity", 300 * kPa, history=history)
paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
materials: dict[str, tg.Material | tg.Shell] = {"body": rubber, "base": rubber, "strain_limiting_layer": paper}
model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [load])
solution = tg.solve(model, tg.Static(duration=duration, first_step=1 / 40, max_step=1 / 40))
response = tg.measure(solution, tg.bending_angle)
seconds, angle = response.column("time"), response.column("bending_angle") / deg
top, emptied, rested = (float(angle[np.isclose(seconds, at)][0]) for at in (15, 20, 40))

print(f"A strip pulled to a Cauchy stress of {largest / MPa:.2f} MPa stays {100 * (stays - 1):.1f} % longer.")
print(f"At 300 kPa it bends by {top:.2f} deg, emptied by {emptied:.2f} deg, and 20 s later by {rested:.2f} deg.")
assert top > emptied > rested > 0, "the bender comes back late, and not to where it was"

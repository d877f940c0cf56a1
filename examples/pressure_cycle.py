"""A bender is filled and emptied twice: how much of the work its rubber keeps, the first time and the second.

The constants in time are stated to show what they do; those of a silicone come from tests, see
`turgor.experiments.fit_history`.
"""

from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

bender = tg.actuators.RectangularBender(length=60 * mm)
mesh = tg.mesh(bender.build(), size=6 * mm)
law = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
series = tg.laws.Prony(g=(0.08, 0.05), tau=(2.0, 40.0), moduli="long_term")
rubber = replace(law, viscoelasticity=series, stress_softening=tg.laws.Mullins(r=4.0, m=5 * kPa))
paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
materials: dict[str, tg.Material | tg.Shell] = {"body": rubber, "base": rubber, "strain_limiting_layer": paper}
duration = 20.0
history = tg.over_time([(0, 0), (5, 1), (10, 0), (15, 1), (20, 0)], duration)
model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 50 * kPa, history=history)])

solution = tg.solve(model, tg.Static(duration=duration, first_step=0.02, max_step=0.02))
response = tg.measure(solution, tg.bending_angle, tg.cavity_volume)
time, pressure, volume = (response.column(name) for name in ("time", "pressure", "cavity_volume"))


def loop(start, end):
    """Work of the pressure and what of it is lost between two times [J]."""
    piece = (time >= start) & (time <= end)
    work = 0.5 * (pressure[piece][1:] + pressure[piece][:-1]) * np.diff(volume[piece])
    return work[work > 0].sum(), work.sum()


angle = response.column("bending_angle") / deg
lost = [100 * given / taken for taken, given in (loop(0, 10), loop(10, 20))]
print(f"{solution.message}")
print(f"At 50 kPa it bends by {angle[time == 5][0]:.2f} deg, and by {angle[time == 15][0]:.2f} deg the second time.")
print(f"Of the work of the air the first cycle loses {lost[0]:.1f} %, the second {lost[1]:.1f} %.")
assert lost[1] < lost[0], "stretched once, the rubber has been softened"

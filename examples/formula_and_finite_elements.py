"""A wound muscle by formula and by finite elements: the same actuator, the same rubber, two responses to compare."""

# %% The actuator, its rubber and its braid: both models take them.
import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

muscle = tg.actuators.ContractingTube(length=60 * mm)
rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
braid = tg.Fibers(
    face="outside",
    material=tg.from_library("kevlar-fiber"),
    diameter=0.1778 * mm,
    winding=tg.Winding(angle_from_axis=30 * deg, spacing=2 * mm, hand="both"),
)

# %% Finite elements: a quarter of the muscle with its end pieces.
mesh = tg.mesh(muscle.build(), size=3 * mm, cells="hexahedra")
ends = tg.from_library("smooth-sil-950", record="neo-hooke-polygerinos-2020")
model = tg.Model(
    mesh,
    materials={"body": rubber, "cap": ends},
    supports=[tg.Fixed("fixed")],
    loads=[tg.Pressure("cavity", 20 * kPa)],
    reinforcements=[braid],
)
elements = tg.measure(tg.solve(model), tg.measures.tip_displacement_x, tg.cavity_volume)

# %% Formula: a long tube with the same wall and the same threads, without the end pieces; milliseconds.
formula = tg.formulas.wound_tube(muscle, rubber, braid, elements["pressure"])
print("It assumes:", *tg.formulas.about("wound_tube").assumptions, sep="\n  ")
for finding in formula.findings:
    print(finding)

# %% Two responses with the same columns.
by_elements, by_formula = (each["tip_displacement_x_mm"][-1] for each in (elements, formula))
print(f"At 20 kPa the muscle shortens by {-by_elements:.2f} mm, a muscle without ends by {-by_formula:.2f} mm.")
assert np.isclose(by_formula, by_elements, rtol=0.1), "ends hold a muscle of 60 mm back"
assert by_formula < by_elements < 0, "and a muscle without ends shortens more"

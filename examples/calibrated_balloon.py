# %% [markdown]
# A balloon of a rubber that nobody tested: its stiffness and the offset of the gauge from one inflation, then how well
# the stretch at 60 kPa is known if the wall is cast to within 0.1 mm.

# %%
from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.units import kPa, mm


def balloon(C10, wall=5 * mm):
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=C10))
    sphere = tg.formulas.HollowSphere(inner_radius=10 * mm, wall=wall)
    return tg.formulas.thick_sphere(sphere, rubber, np.linspace(0, 80 * kPa, 41))


# %% What a rig might write: a stiffer rubber, a gauge that shows 1.5 kPa too little, noise of 0.002 in the stretch.
true = balloon(0.126e6)
noise = 0.002 * np.random.default_rng(3).standard_normal(35)
pressure, stretch = (replace(true.find(name), values=true[name][1:36]) for name in ("pressure", "inner_stretch"))
shown = replace(pressure, values=pressure.values - 1.5 * kPa)
measured = replace(true, columns=(shown, replace(stretch, values=stretch.values + noise)))

# %% Calibration
found = tg.studies.calibrate(
    tg.studies.Trial(measured=measured, function=balloon, y="inner_stretch", spread=0.002, name="rig"),
    [tg.studies.Parameter(name="C10", start=0.1e6, unit="MPa")],
    rig=["pressure_offset"],
)
print(found.summary())

# %% Uncertainty of the response
spread = tg.studies.propagate(
    balloon,
    [
        tg.studies.Spread(name="C10", mean=found.values["C10"], deviation=found.errors["C10"], label="rubber"),
        tg.studies.Spread(name="wall", mean=5 * mm, deviation=0.1 * mm),
    ],
)
print(spread.sentence("inner_stretch", at=60 * kPa))

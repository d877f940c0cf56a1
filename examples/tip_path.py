"""Path of the tip: length and wall of a bender whose tip is to be at three places at three pressures."""

# %% A bender as long as this is its section: curvature against pressure in a second.
from dataclasses import replace

import numpy as np

import turgor as tg
from turgor.units import deg, kPa, mm

PRESSURES = [20 * kPa, 30 * kPa, 40 * kPa]
PLACES = [(-1.5 * mm, 18 * mm), (-2.9 * mm, 25 * mm), (-4.8 * mm, 32 * mm)]  # along x and to the side, from rest
SILICONE = tg.Material(name="silicone", law=tg.laws.NeoHooke(C10=0.0425e6))
THREAD = tg.Material(name="thread", law=tg.laws.Hooke(E=31067e6, nu=0.36))
FLAT = "strain_limiting_layer"


def threads(face, angle, spacing):
    winding = tg.Winding(angle_from_axis=angle, spacing=spacing)
    return tg.Fibers(face=face, material=THREAD, diameter=0.1778 * mm, winding=winding, compression=1.0)


def tip(length, wall):
    finger = tg.actuators.FiberReinforcedBender(radius=8 * mm, wall=wall, base=2 * mm, skin=0.0, length=length)
    around = [threads(("outside", FLAT), 90 * deg, 3 * mm), threads(FLAT, 0 * deg, 1.2 * mm)]
    bent = tg.Section(finger, {"body": SILICONE}, reinforcements=around).solve(PRESSURES).response
    curvature = np.maximum(np.abs(bent["curvature_y"]), 1e-6)
    columns = (
        tg.experiments.Column("pressure", "kPa", bent["pressure"]),
        tg.experiments.Column("tip_displacement_x", "mm", np.sin(curvature * length) / curvature - length),
        tg.experiments.Column("tip_displacement_z", "mm", (1 - np.cos(curvature * length)) / curvature),
    )
    return replace(bent, columns=columns)


# %% The search, from the middle of the ranges.
found = tg.optimize(
    tip,
    [
        tg.studies.Factor(name="length", low=100 * mm, high=180 * mm, unit="mm"),
        tg.studies.Factor(name="wall", low=1.2 * mm, high=2.5 * mm, unit="mm"),
    ],
    [tg.studies.TipPath(PLACES, at=("pressure", PRESSURES), tolerance=0.2 * mm)],
)
print(found.summary())

# %% One number to remember.
(distance,) = found.reads()
assert found.converged and distance.value < 0.2 * mm, "the tip passes the three places"

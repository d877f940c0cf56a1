"""Whole tubes with single threads: hoops as narrow bands, so that the wall can bulge between them."""

from dataclasses import replace
from math import inf

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Setting
from turgor_guidelines.parts import elastosil, threads
from turgor_guidelines.pictures import picture_of

#: Length between the caps and thickness of these [mm], width of a band that stands for one thread [mm].
FREE, CAP, BAND = 48.0, 6.0, 1.0

#: Distances between hoops [mm], from none at all.
SPACINGS = (0.0, 16.0, 8.0, 4.0, 2.0)

#: What is computed, for the texts of studies.
SETUP = (
    "Whole tube (inner radius 6.35 mm, outer 8.35 mm, 48 mm between caps of 6 mm, one end fixed), axisymmetric, "
    "Elastosil M4601 (neo-Hookean, C10 = 0.12 MPa); each hoop of Kevlar thread of 0.1778 mm is a band of 1 mm on the "
    "outside"
)


def inflate(spacing: float, pressure: float, size: float) -> Computed:
    """Inflate a tube with a hoop every so many mm (0 for none) up to a pressure [kPa], cells of a size [mm]."""
    shape = tg.actuators.FiberReinforcedCylinder(length=(FREE + 2 * CAP) * mm, cap=CAP * mm)
    count = round(FREE / spacing) + 1 if spacing else 0
    places = [(CAP + k * spacing) * mm for k in range(count)]
    hoop = threads(spacing=BAND)
    half = BAND / 2 * mm
    model = tg.Model(
        tg.mesh(shape.build(), size=size * mm, cells="axisymmetric"),
        {"body": elastosil()},
        [tg.Fixed("fixed")],
        [tg.Pressure("cavity", pressure * kPa)],
        reinforcements=[replace(hoop, within=((x - half, -inf, -inf), (x + half, inf, inf))) for x in places],
    )
    solution = tg.solve(model, tg.Static(at=(0.2, 0.4, 0.6, 0.8)), throw=False)
    measures = ("tip_displacement_x", "cavity_volume", "principal_stretch_p99", "cracking_energy_p99")
    return Computed(response=tg.measure(solution, *measures), picture=picture_of(solution))


def inflated(setting: Setting, pressure: float) -> tuple[Run, ...]:
    """Runs for all distances between hoops."""
    size = 1.0 if setting == "quick" else 0.5
    return tuple(
        Run(
            name=f"hoops every {spacing:g} mm" if spacing else "no hoops",
            function=inflate,
            values={"spacing": spacing, "pressure": pressure, "size": size},
        )
        for spacing in SPACINGS
    )

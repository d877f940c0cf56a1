"""Wound sections of the studies on fibers: the tube of Connolly et al. (2015) and the bender of Polygerinos et al."""

import numpy as np

import turgor as tg
from turgor.guidelines.guideline import Setting
from turgor.guidelines.parts import elastosil, fabric, threads
from turgor.guidelines.sections import solved_twice
from turgor.studies.runs.run import Computed
from turgor.units import kPa, mm

#: What the tube is, for the texts of studies.
TUBE = (
    "Section of a long tube (inner radius 6.35 mm, outer 8.35 mm, closed ends), Elastosil M4601 (neo-Hookean, C10 = "
    "0.12 MPa), Kevlar threads of 0.1778 mm smeared over its outside, slack in compression"
)

#: What the bender is.
BENDER = (
    "Section of a long half-round bender (chamber radius 8 mm, wall and base 2 mm), Elastosil M4601 (neo-Hookean, C10 "
    "= 0.12 MPa), fabric of 650 N/mm along and across on the flat side, hoops of Kevlar thread of 0.1778 mm around "
    "it all"
)


def cells(setting: Setting) -> float:
    """Size of the cells of a setting [mm]; every section is solved with cells twice as large too."""
    return 1.0 if setting == "quick" else 0.5


def tube(from_axis: float, spacing: float, hand: str, pressure: float, size: float) -> Computed:
    """Inflate a wound tube.

    Parameters
    ----------
    from_axis : float [deg]
        Angle of the threads from the axis.
    spacing : float [mm]
        Distance between threads; 0 for none.
    hand : str
        ``"right"`` for a single helix, ``"both"`` for two.
    pressure : float [kPa]
        The last of 11 even steps.
    size : float [mm]
        Of the cells.

    Returns
    -------
    Computed
    """
    wound = [threads(from_axis=from_axis, spacing=spacing, hand=hand)] if spacing else []
    shape = tg.actuators.FiberReinforcedCylinder(symmetric=hand != "right" or from_axis in (0.0, 90.0))

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, {"body": elastosil()}, reinforcements=wound, size=cell)
        return section.solve(np.linspace(0, pressure * kPa, 11), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def bender(spacing: float, pressure: float, size: float) -> Computed:
    """Bend a half-round section with hoops at a distance [mm] (0 for none) up to a pressure [kPa]."""
    hoops = [threads(("outside", "strain_limiting_layer"), spacing=spacing)] if spacing else []
    shape = tg.actuators.FiberReinforcedBender(skin=0.0)

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, {"body": elastosil()}, reinforcements=[*fabric(), *hoops], size=cell)
        return section.solve(np.linspace(0, pressure * kPa, 11), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)

"""Half-round benders of the studies on single chambers, as sections: bare or in hoops, with a fabric below."""

import numpy as np

import turgor as tg
from turgor.guidelines.guideline import Setting
from turgor.guidelines.parts import elastosil, fabric, threads
from turgor.guidelines.sections import solved_twice
from turgor.studies.runs.run import Computed
from turgor.units import kPa, mm

#: What the bender is, for the texts of studies.
BENDER = (
    "Section of a long half-round bender, Elastosil M4601 (neo-Hookean, C10 = 0.12 MPa), fabric of 650 N/mm along and "
    "across on the flat side; bare, or in hoops of Kevlar thread of 0.1778 mm every 2 mm"
)

#: Names of what is around it.
BARE, HOOPED = "bare", "hoops"


def cells(setting: Setting) -> float:
    """Size of the cells of a setting [mm]; every section is solved with cells twice as large too."""
    return 1.0 if setting == "quick" else 0.5


def bend(radius: float, wall: float, base: float, hooped: bool, pressure: float, size: float) -> Computed:
    """Bend a half-round section.

    Parameters
    ----------
    radius, wall, base : float [mm]
        Of the chamber, around it and below it.
    hooped : bool
        Whether hoops are wound around it.
    pressure : float [kPa]
        The last of 11 even steps.
    size : float [mm]
        Of the cells.

    Returns
    -------
    Computed
    """
    shape = tg.actuators.FiberReinforcedBender(radius=radius * mm, wall=wall * mm, base=base * mm, skin=0.0)
    hoops = [threads(("outside", "strain_limiting_layer"))] if hooped else []

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, {"body": elastosil()}, reinforcements=[*fabric(), *hoops], size=cell)
        return section.solve(np.linspace(0, pressure * kPa, 11), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)

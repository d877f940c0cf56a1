"""Cosserat rods: sections, rods between plates, loads, equilibria, motions and natural frequencies."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.results.plots.rod_plot import plot_rods as plot_rods
    from turgor.rod.dynamic import dynamic as dynamic
    from turgor.rod.loads import ChamberPressure as ChamberPressure
    from turgor.rod.loads import LineLoad as LineLoad
    from turgor.rod.loads import PlateForce as PlateForce
    from turgor.rod.model import Place as Place
    from turgor.rod.model import Plate as Plate
    from turgor.rod.model import Rod as Rod
    from turgor.rod.model import RodModel as RodModel
    from turgor.rod.modes import RodModes as RodModes
    from turgor.rod.modes import natural_frequencies as natural_frequencies
    from turgor.rod.path import arc_length as arc_length
    from turgor.rod.path import static as static
    from turgor.rod.sections.chamber import PressureTable as PressureTable
    from turgor.rod.sections.chamber import RodChamber as RodChamber
    from turgor.rod.sections.section import RodSection as RodSection
    from turgor.rod.sections.shapes import HalfRound as HalfRound
    from turgor.rod.sections.shapes import Rectangle as Rectangle
    from turgor.rod.sections.shapes import Round as Round
    from turgor.rod.sections.shapes import Tube as Tube
    from turgor.rod.solution import RodError as RodError
    from turgor.rod.solution import RodShape as RodShape
    from turgor.rod.solution import RodSolution as RodSolution
    from turgor.rod.state import RodState as RodState
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())

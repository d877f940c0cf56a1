"""Cosserat rods: sections, rods between plates, loads, equilibria, motions and natural frequencies."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.fast_models.rod.dynamic import dynamic as dynamic
    from turgor.fast_models.rod.loads import ChamberPressure as ChamberPressure
    from turgor.fast_models.rod.loads import LineLoad as LineLoad
    from turgor.fast_models.rod.loads import PlateForce as PlateForce
    from turgor.fast_models.rod.model import Place as Place
    from turgor.fast_models.rod.model import Plate as Plate
    from turgor.fast_models.rod.model import Rod as Rod
    from turgor.fast_models.rod.model import RodModel as RodModel
    from turgor.fast_models.rod.modes import RodModes as RodModes
    from turgor.fast_models.rod.modes import natural_frequencies as natural_frequencies
    from turgor.fast_models.rod.path import arc_length as arc_length
    from turgor.fast_models.rod.path import static as static
    from turgor.fast_models.rod.sections.chamber import PressureTable as PressureTable
    from turgor.fast_models.rod.sections.chamber import RodChamber as RodChamber
    from turgor.fast_models.rod.sections.section import RodSection as RodSection
    from turgor.fast_models.rod.sections.shapes import HalfRound as HalfRound
    from turgor.fast_models.rod.sections.shapes import Rectangle as Rectangle
    from turgor.fast_models.rod.sections.shapes import Round as Round
    from turgor.fast_models.rod.sections.shapes import Tube as Tube
    from turgor.fast_models.rod.solution import RodError as RodError
    from turgor.fast_models.rod.solution import RodShape as RodShape
    from turgor.fast_models.rod.solution import RodSolution as RodSolution
    from turgor.fast_models.rod.state import RodState as RodState
    from turgor.views.plots.rod_plot import plot_rods as plot_rods
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())

"""WireTerm: the tension of a shape-memory wire, whose martensite is an internal variable."""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cables.cable_term import CableTerm, Pulled, by_length
from turgor.core.engine.term import Configuration
from turgor.core.materials.alloys.phases import Phases, WireStep
from turgor.core.model.loads.shape_memory_wire import ShapeMemoryWire

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class WireTerm(CableTerm):
    """A wire without friction, so that one stress acts along all of it.

    Parameters
    ----------
    load : ShapeMemoryWire
    heating : tuple of ShapeMemoryWire
        All loads that heat the wire; what they warm it by adds up, as one fades and another one grows in a stage.
    unit : float [N]
        Unit of forces.
    """

    load: ShapeMemoryWire
    heating: tuple[ShapeMemoryWire, ...]
    unit: float

    def temperature(self, load_factor: float) -> float:
        """Temperature at a load factor [K]."""
        return self.load.rest + sum(each.warming(load_factor) for each in self.heating)

    def answer(self, at: Configuration) -> tuple[Phases, float]:
        """Phases of the wire at the end of a step, and the derivative of its stress by its strain [Pa]."""
        stored, load = at.bonds.get(self.memory_key), self.load
        before = Phases.at_rest(load.alloy, load.rest, load.strain) if stored is None else Phases.of(stored)
        return WireStep(load.alloy, before, self.temperature(at.load_factor), load.rest).to(self.strain(at))

    def strain(self, at: Configuration) -> float:
        """Strain of the wire, from its length before it was stretched."""
        ratio = float(self.way(at)[1].sum() / self.rest_lengths.sum())
        return (1 + self.load.strain) * ratio - 1

    def pulled(self, at: Configuration) -> Pulled:
        """Directions, lengths and tensions of the pieces, of the modeled part."""
        directions, lengths = self.way(at)
        after, slope = self.answer(at)
        section = self.laid.part * pi * self.load.diameter**2 / 4 / self.unit
        rate = section * slope * (1 + self.load.strain) / self.rest_lengths.sum()
        tensions = np.full(len(lengths), section * after.stress)
        by_guides = np.broadcast_to(rate * by_length(directions), (len(lengths), len(lengths) + 1, 3))
        return Pulled(directions, lengths, tensions, by_guides)

    def remembered(self, at: Configuration) -> Array:
        """Stress, temperature and fractions at the end of a step, (4,)."""
        return self.answer(at)[0].array

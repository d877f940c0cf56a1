"""Measured: what is differentiated, and how it is read at the neighbors of a state."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.checks import check_alone
from turgor.accuracy.gradients.direct import Rates
from turgor.accuracy.gradients.equilibrium import Equilibrium
from turgor.accuracy.gradients.neighbor_models import Neighbors, Place
from turgor.core.meshing.mesh import Mesh
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.measures import as_measure
from turgor.core.solvers.pressures import pressures_of
from turgor.core.solvers.solution import Solution, State
from turgor.core.solvers.states import state_of
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: End of the name of the pressure in one cavity.
_PRESSURE = "pressure"


def chosen_measures(state: State, measures: Sequence[Measure | str]) -> tuple[Measure, ...]:
    """Return what is differentiated at a state: measures by themselves or by name, and pressures that act there.

    Parameters
    ----------
    state : State
    measures : sequence of Measure or str

    Returns
    -------
    tuple of Measure

    Raises
    ------
    TurgorError
        If there is none, one is unknown, given twice, or a sum along the path.
    """
    if not measures:
        raise TurgorError("a gradient needs a measure; name one or more, such as 'bending_angle'.")
    acting = pressures_of(state)
    pressures = {f"{face}_{_PRESSURE}": face for face in acting}
    if len(acting) == 1:
        pressures[_PRESSURE] = next(iter(acting))
    chosen: list[Measure] = []
    for each in measures:
        known = isinstance(each, str) and each in pressures
        chosen.append(_pressure_in(each, pressures[each]) if known else as_measure(each))  # type: ignore[index,arg-type]
        check_alone(chosen[-1])
    names = [each.name for each in chosen]
    for name in names:
        if names.count(name) > 1:
            raise TurgorError(f"the measure '{name}' is named twice.")
    return tuple(chosen)


def _pressure_in(name: str, face: str) -> Measure:
    return Measure(
        name=name,
        unit="kPa",
        function=lambda at: pressures_of(at.state)[face],
        definition=f"gauge pressure in {face}",
    )


@dataclass(eq=False)
class Reading:
    """Reads measures at the neighbors of a state; facts of a mesh are found once.

    Parameters
    ----------
    base : Equilibrium
    measures : tuple of Measure
    """

    base: Equilibrium
    measures: tuple[Measure, ...]
    _facts: MeshFacts | None = field(default=None)

    @cached_property
    def at_state(self) -> Array:
        """Values (m,) [SI] at the state itself, more accurate than those of the path."""
        base = self.base
        return self._read(state_of(base.system, base.at, base.state.unstable_modes))

    def along(self, solution: Solution, number: int) -> Array:
        """Values (m,) [SI] at a state; angles go on past half a turn, as along the path."""
        values = self.at_state.copy()
        for row, each in enumerate(self.measures):
            if each.unwrap:
                facts = self._facts_of(solution.model.mesh)
                path = [StateFields(state, facts) for state in solution.states[: number + 1]]
                values[row] += np.unwrap(each.read(path))[-1] - each(path[-1])
        return values

    def facts(self) -> MeshFacts:
        """Facts of the mesh of the state."""
        return self._facts_of(self.base.state.model.mesh)

    def by_number(self, neighbors: Neighbors, places: tuple[Place, ...]) -> Array:
        """Derivatives (m,) [SI] of the measures by the number itself, where nothing moves but supports."""
        return neighbors.difference(lambda each, place: self._near(each.state(place)), places)

    def slopes(self, neighbors: Neighbors, rates: Rates) -> Array:
        """Derivatives (m,) [SI] of the measures: by the number itself, and by the motion that it causes."""
        direct = self.by_number(neighbors, rates.places)
        if rates.motion is None:
            return direct
        one, other = (self._near(rates.motion.itself.state(end)) for end in rates.motion.ends)
        return direct + (one - other) / (2 * rates.motion.step)

    def _near(self, state: State) -> Array:
        """Values (m,) of a state nearby; angles do not jump by a turn."""
        values, middle = self._read(state), self.at_state
        turns = np.array([each.unwrap for each in self.measures])
        apart = values - middle
        return np.where(turns, middle + np.arctan2(np.sin(apart), np.cos(apart)), values)

    def _read(self, state: State) -> Array:
        at = StateFields(state, self._facts_of(state.model.mesh))
        return np.array([each(at) for each in self.measures])

    def _facts_of(self, mesh: Mesh) -> MeshFacts:
        if mesh is not self.base.state.model.mesh:
            return MeshFacts(mesh)
        if self._facts is None:
            self._facts = MeshFacts(self.base.state.model.mesh)
        return self._facts

"""Guide: the path of a similar model predicts the next state, so that only the requested states are solved.

A step starts from the last state plus the change of the guide's displacement from there to the next load. The guide has
the same elements, and a rubber or dimensions that differ a little.
"""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.engine.system import System
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: The two bodies fill boxes whose corners are this near to each other, as a share of the box.
ALIKE = 0.2

#: Attempts that fail from where the guide leads, after which a run goes on without it.
MOST_FAILED = 3


@dataclass(frozen=True, slots=True, eq=False)
class Guide:
    """A path in the unknowns of another system.

    Parameters
    ----------
    loads : sequence of float
        Load factors, rising.
    unknowns : sequence of (size,) array
        Scaled unknowns at them.
    exact : bool
        Whether steps go from state to state of it: between two of them it says nothing.
    """

    loads: Sequence[float]
    unknowns: Sequence[Array]
    exact: bool = False

    @staticmethod
    def of(system: System, solution: Solution) -> "Guide":
        """The states of a solution in the unknowns of a system."""
        path = [solution.states[0]]
        for state in solution.states:  # it may turn where it was interrupted by a snap
            path += [state] if state.load_factor > path[-1].load_factor else []
        return Guide([each.load_factor for each in path], [unknowns_of(system, each) for each in path])

    def leads_to(self, load: float) -> bool:
        """Whether it reaches a load factor."""
        return load <= self.loads[-1]

    def next_load(self, now: float, wanted: float) -> float:
        """Return the load factor to try next from one of now: the one that is wanted, or that of the next state."""
        return next((load for load in self.loads if load > now), wanted) if self.exact else wanted

    def misleads(self, failed: int) -> bool:
        """Whether so many attempts that failed are enough to go on without it."""
        return failed >= (1 if self.exact else MOST_FAILED)

    def at(self, load: float) -> Array:
        """Unknowns at a load factor, on the line between two states."""
        after = min(max(bisect_left(self.loads, load), 1), len(self.loads) - 1)
        low, high = self.loads[after - 1], self.loads[after]
        share = (load - low) / (high - low)
        return (1 - share) * self.unknowns[after - 1] + share * self.unknowns[after]


def check_guide(model: Model, procedure: Procedure, guide: Solution) -> None:
    """Refuse a guide that cannot lead along the path of a model.

    Raises
    ------
    TurgorError
        If the guide is no solution, the procedure is not `Static` without a duration, what acts depends on the path, or
        the guide has other elements or is of another body.
    """
    if not isinstance(guide, Solution):
        raise TurgorError(f"guide is {guide!r}; allowed is a Solution, as `solve` and `load` return it.")
    _check_guided(model, procedure)
    if len(guide.states) < 2:
        raise TurgorError("guide has no state under load; solve it first.")
    _check_same_elements(model, guide.model)
    missing = sorted(set(_names(model)) - set(_names(guide.model)))
    if missing:
        raise TurgorError(f"guide has no {missing[0]}; it is the solution of another model.")


def _check_guided(model: Model, procedure: Procedure) -> None:
    """Refuse a guide where the path depends on more than the load."""
    if why := unguided(model, procedure):
        raise TurgorError(why)


def unguided(model: Model, procedure: Procedure) -> str:
    """Say why no guide can lead along the path of a model, because that depends on more than the load; else nothing."""
    if not procedure.load_control or procedure.duration is not None:
        name = type(procedure).__name__
        name += f" with a duration of {procedure.duration:g} s" if procedure.duration is not None else ""
        return f"guide leads the steps of Static without a duration; the procedure is {name}."
    for name, each in model.region_materials.items():
        if each.remembers:
            return f"guide leaves out states, and the rubber of '{name}' remembers them; solve without it."
    if model.bonds:
        return f"guide leaves out states, and the bond '{model.bonds[0].name}' remembers them; solve without it."
    for what in filter(None, (load.path_dependent for load in model.loads)):
        return f"guide leaves out states, and {what} depends on them; solve without it."
    if (friction := max(_friction(model))) > 0:
        return f"guide leaves out states, and friction {friction:g} depends on them; solve without it."
    return ""


def _check_same_elements(model: Model, guide: Model) -> None:
    """Refuse a guide with other elements, or of a body that fills another box."""
    here, there = model.mesh, guide.mesh
    same = here.cells.shape == there.cells.shape and np.array_equal(here.cells, there.cells)
    if not same or element_of(model).mean_count != element_of(guide).mean_count:
        raise TurgorError(
            f"guide has other elements: {len(there.cells):,} instead of {len(here.cells):,}; "
            "solve the similar model on the same mesh, or with its points moved."
        )
    box, other = _box(here), _box(there)
    off = float(np.abs(box - other).max() / np.ptp(box, axis=0).max())
    if off > ALIKE:
        raise TurgorError(
            f"guide is the solution of another body: its corners are off by {off:.0%} of the size of this one; "
            f"at most {ALIKE:.0%} is allowed."
        )


def _names(model: Model) -> list[str]:
    """Motion of reference points and of bodies on springs."""
    points = [f"reference point '{name}'" for name in model.points]
    return points + [f"obstacle '{each.name}'" for each in model.contact.obstacles]


def _friction(model: Model) -> list[float]:
    itself = model.contact.self_contact
    return [0.0 if itself is None else itself.friction, *(each.friction for each in model.contact.obstacles)]


def _box(mesh: Mesh) -> Array:
    return np.stack([mesh.points.min(axis=0), mesh.points.max(axis=0)])

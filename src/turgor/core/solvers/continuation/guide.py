"""Guide: the path of a similar model says where the next state is, so that only the states asked for are solved.

A step starts from the last state plus what the guide moves from there to the next load: by the displacement on a
coarse mesh, interpolated, or by that of a design or a rubber that differs a little.
"""

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.engine.interpolation import Interpolation
from turgor.core.engine.system import System
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.restart import unknowns_of
from turgor.core.solvers.solution import Procedure, Solution, State
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: The two bodies fill boxes whose corners are this near to each other, as a share of the box.
ALIKE = 0.2

#: Between walls that touch, a coarser mesh leads steps of more than this share of the load. It has other points in
#: contact than the fine mesh, and in shorter steps the tangent of the path is the better start: with twelve states,
#: four chambers of a PneuNet took 82 iterations where the coarse mesh led all steps, 50 so, and 59 alone.
LONG_BETWEEN_WALLS = 0.15

#: So many attempts that its guide has led astray, and a run goes on without it.
ASTRAY = 3


@dataclass(frozen=True, slots=True, eq=False)
class Guide:
    """A path in the unknowns of another system.

    Parameters
    ----------
    loads : sequence of float
        Load factors, rising.
    unknowns : sequence of (size,) array
        Scaled unknowns at them.
    interpolated : bool
        Whether they come from another mesh. The stress of such states is rough, and misleads a first update.
    """

    loads: Sequence[float]
    unknowns: Sequence[Array]
    interpolated: bool = False

    @staticmethod
    def of(system: System, solution: Solution) -> "Guide":
        """Carry the states of a solution to the mesh of a system."""
        path = [solution.states[0]]
        for state in solution.states:  # it may turn where it was interrupted by a snap
            path += [state] if state.load_factor > path[-1].load_factor else []
        mesh, other = solution.model.mesh, system.model.mesh
        same = mesh.cells.shape == other.cells.shape and np.array_equal(mesh.cells, other.cells)
        same &= element_of(solution.model).mean_count == element_of(system.model).mean_count
        carried = _as_it_is if same else partial(_carried, Interpolation(mesh, other), system.model)
        unknowns = [unknowns_of(system, carried(each)) for each in path]
        return Guide([each.load_factor for each in path], unknowns, interpolated=not same)

    def leads_to(self, load: float) -> bool:
        """Whether it has come as far as a load factor."""
        return load <= self.loads[-1]

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
        the guide is of another body.
    """
    if not isinstance(guide, Solution):
        raise TurgorError(f"guide is {guide!r}; allowed is a Solution, as `solve` and `load` return it.")
    check_guided(model, procedure, "guide")
    if len(guide.states) < 2:
        raise TurgorError("guide has no state under load; solve it first.")
    check_same_body(model, guide.model.mesh, "guide")
    missing = sorted(set(_names(model)) - set(_names(guide.model)))
    if missing:
        raise TurgorError(f"guide knows no {missing[0]}; it is the solution of another model.")


def check_guided(model: Model, procedure: Procedure, key: str) -> None:
    """Refuse to lead the path of a model that depends on more than the load; ``key`` is what the user asked for.

    Raises
    ------
    TurgorError
        If the procedure is not `Static` without a duration, rubber remembers, or something rubs.
    """
    if not isinstance(procedure, Static) or procedure.duration is not None:
        name = type(procedure).__name__
        raise TurgorError(f"{key} leads the steps of Static without a duration; the procedure is {name}.")
    for name, each in model.region_materials.items():
        if each.viscoelasticity is not None or each.stress_softening is not None:
            raise TurgorError(f"{key} leaves out states, and the rubber of '{name}' remembers them; solve without it.")
    if any(coefficient > 0 for coefficient in _friction(model)):
        raise TurgorError(f"{key} leaves out states, and friction depends on them; solve without it.")


def check_same_body(model: Model, mesh: Mesh, key: str) -> None:
    """Refuse a mesh that fills another box than that of a model.

    Raises
    ------
    TurgorError
    """
    here, there = _box(model.mesh), _box(mesh)
    off = float(np.abs(here - there).max() / np.ptp(here, axis=0).max())
    if off > ALIKE:
        what = "the solution" if key == "guide" else "a mesh"
        raise TurgorError(
            f"{key} is {what} of another body: its corners are off by {off:.0%} of the size of this one; "
            f"at most {ALIKE:.0%} is allowed."
        )


def _names(model: Model) -> list[str]:
    """What else than nodes moves: reference points and bodies on springs."""
    points = [f"reference point '{name}'" for name in model.points]
    return points + [f"obstacle '{each.name}'" for each in model.contact.obstacles]


def _friction(model: Model) -> list[float]:
    itself = model.contact.self_contact
    return [0.0 if itself is None else itself.friction, *(each.friction for each in model.contact.obstacles)]


def _box(mesh: Mesh) -> Array:
    return np.stack([mesh.points.min(axis=0), mesh.points.max(axis=0)])


def _as_it_is(state: State) -> State:
    return state


def _carried(interpolation: Interpolation, model: Model, state: State) -> State:
    return replace(
        state,
        displacement=interpolation.nodal(state.displacement),
        mean_stress=interpolation.mean_stress(state.model, model, state.mean_stress),
    )

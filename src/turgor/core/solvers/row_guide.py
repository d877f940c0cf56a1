"""Row guide: a row of equal parts is led by the path of a shorter one.

Chambers in a row take equal shapes under equal pressure, up to the motion that leads from each to the next, and what
the ends do differently fades within a chamber. So the path of five of eleven chambers, found with half of the unknowns,
says where the eleven are: Newton's method starts there at each requested load, instead of finding again in small steps
what touches. Guided states are equilibria of the whole row like any other.
"""

import logging
from dataclasses import dataclass, replace
from itertools import takewhile
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.cells.element import Element, element_of
from turgor.core.engine.runtime import FEW_UNKNOWNS, MIXED, EngineOptions
from turgor.core.engine.system import System
from turgor.core.meshing.bodies.short_row import ShortRow, short_row
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.drive import kinks
from turgor.core.model.loads import pressures_among
from turgor.core.model.model import Model
from turgor.core.solvers.continuation.load_control import load_run
from turgor.core.solvers.continuation.path_follower import follow
from turgor.core.solvers.continuation.tangent_response import load_response
from turgor.core.solvers.guide import Guide, unguided
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.solution import Solution, State

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class RowGuideSettings:
    """Settings of the guide of a row.

    Parameters
    ----------
    most_loads : int
        Requested load factors at most: with more, the steps between them are short without a guide.
    meeting : float
        Share of the displacement under the full load, by the stiffness at rest, at which walls touch in a row worth
        leading. Where they never do, the path takes few steps alone.
    misfit : float
        Distance of the end of the middle part from its beginning, moved on, over the pitch, up to which parts count as
        equal: 2e-4 in the demo; with 1e-2 the guide fails where walls touch.
    """

    most_loads: int = 8
    meeting: float = 0.5
    misfit: float = 2e-3


ROW_GUIDE = RowGuideSettings()


def guide_of(
    given: Solution | None, system: System, tangent: Tangent, procedure: Procedure, options: EngineOptions
) -> Guide | None:
    """Return the guide of a path that begins at rest: that of a solution, or without one that of a shorter row.

    Parameters
    ----------
    given : Solution or None
        The path of a similar model.
    system, tangent, procedure, options
        As `row_guide` takes them.
    """
    if given is not None:
        return Guide.of(system, given)
    return row_guide(system, tangent, procedure, options)


def row_guide(system: System, tangent: Tangent, procedure: Procedure, options: EngineOptions) -> Guide | None:
    """Solve a shorter row of equal parts, and lead the whole one along its path.

    Parameters
    ----------
    system : System
    tangent : Tangent
        Whose clock runs meanwhile.
    procedure : Procedure
    options : EngineOptions

    Returns
    -------
    Guide or None
        None where the model is no such row, its parts may differ in what acts on them, or the shorter row has no path.
    """
    mixed = options.iteration == MIXED and options.linear_solver != "iterative"
    row = shorter_row(system.model, procedure) if mixed else None
    if row is None:
        return None
    led: Any = procedure  # one with steps, or no guide would lead it
    short, loads = replace(system.model, mesh=row.mesh), _loads(led)
    placed = _Placed.of(row, system.model, short)
    states = list(takewhile(placed.fits, _path(placed, replace(led, at=loads), tangent, options)))
    if not states:
        return None
    unknowns = [placed.unknowns(system, state) for state in states]
    return Guide([0.0, *(state.load_factor for state in states)], [np.zeros(system.size), *unknowns], exact=True)


def shorter_row(model: Model, procedure: Procedure) -> ShortRow | None:
    """Return the shorter row whose path leads that of a model; None where no other path does.

    It does where walls of a row of equal parts may meet, pressure alone acts, so that the parts take equal shapes, and
    the states that a guide leaves out do not matter.

    Parameters
    ----------
    model : Model
    procedure : Procedure
    """
    mesh = model.mesh
    pressed = len(pressures_among(model.loads)) == len(model.loads) and not kinks(model)
    alone = not (model.contact.obstacles or model.points or model.reinforcements or mesh.node_sets)
    large = mesh.unknown_count >= FEW_UNKNOWNS and model.contact.for_mesh(mesh) is not None
    smooth = not model.sheets_wrinkle  # where sheets wrinkle, steps follow their lines
    if not (pressed and alone and large and smooth) or procedure.remesh or unguided(model, procedure):
        return None
    return short_row(mesh) if len(_loads(procedure)) <= ROW_GUIDE.most_loads else None


def _loads(procedure: Any) -> tuple[float, ...]:
    """Load factors of the requested states, at most the longest step apart."""
    targets = sorted({*procedure.at, 1.0})
    loads: list[float] = []
    for low, high in zip([0.0, *targets], targets, strict=False):
        count = ceil((high - low) / procedure.max_step - 1e-9)
        loads += [low + (high - low) * k / count for k in range(1, count)] + [high]
    return tuple(loads)


def _path(placed: "_Placed", procedure: Any, tangent: Tangent, options: EngineOptions) -> list[State]:
    """States of the shorter row at the requested loads, as far as it gets; none where its walls stay apart."""
    system = System(placed.short)
    threads = options.threads if placed.short.mesh.unknown_count >= FEW_UNKNOWNS else 1
    solver = Tangent(system, options.linear_solver, threads, options.iteration)
    solver.clock = tangent.clock
    if not _walls_meet(system, solver):
        return []
    text = f"solving the row without {placed.row.spared} of its equal parts first: its path leads the whole"
    (options.notify or logging.getLogger("turgor").info)(text)
    problem = Problem(system=system, tangent=solver, history=system.history(step=np.inf))
    follow(load_run(problem, procedure, patient=False))
    return [state for state in problem.states if state.load_factor in procedure.at]


def _walls_meet(system: System, tangent: Tangent) -> bool:
    """Whether walls touch long before the full load, by the stiffness at rest."""
    rest = system.evaluate(np.zeros(system.size), 0.0)
    assert rest is not None
    share = ROW_GUIDE.meeting
    try:
        tangent.factor(rest)
        change = load_response(system, tangent, rest.unknowns)
    except SingularTangentError:  # the path of the whole row says what is wrong
        return False
    return system.contacts(share * change, share).touch


@dataclass(frozen=True, slots=True, eq=False)
class _Placed:
    """States of a shorter row in the places of the whole one."""

    row: ShortRow
    whole: Mesh
    short: Model
    elements: tuple[Element, Element]

    @staticmethod
    def of(row: ShortRow, whole: Model, short: Model) -> "_Placed":
        """Lead from a shorter model to the whole one."""
        return _Placed(row, whole.mesh, short, (element_of(whole), element_of(short)))

    def fits(self, state: State) -> bool:
        """Whether one motion leads from the beginning of the middle part to its end."""
        begin, end = self.row.mesh.points[self.row.ends]
        pitch = float(np.linalg.norm((end - begin).mean(axis=0)))
        begin, end = (self.row.mesh.points + state.displacement)[self.row.ends]
        turns, shifts = _motions(begin, end, 1)
        return float(np.abs(begin @ turns[1].T + shifts[1] - end).max()) <= ROW_GUIDE.misfit * pitch

    def unknowns(self, system: System, state: State) -> Array:
        """Unknowns (size,) of the whole row: each part moved on from the one that stands for it."""
        row, (whole, short) = self.row, self.elements
        places = row.mesh.points + state.displacement
        turns, shifts = _motions(places[row.ends[0]], places[row.ends[1]], row.spared)
        corners = places[row.mesh.cells[row.cells]]
        moved = np.einsum("cij,cnj->cni", turns[row.turns], corners) + shifts[row.turns][:, None]
        placed = _mean(self.whole.cells, moved, len(self.whole.points))
        stress = _mean(whole.mean, state.mean_stress[short.mean[row.cells]], whole.mean_count)
        return system.unknowns(placed - self.whole.points, stress, {})


def _motions(begin: Array, end: Array, count: int) -> tuple[Array, Array]:
    """Rotations (count + 1, 3, 3) and shifts (count + 1, 3) of the powers of a motion, from none on.

    The motion leads from ``begin`` to ``end``; its rotation is that of Kabsch (1976), doi 10.1107/S0567739476001873.
    """
    middles = begin.mean(axis=0), end.mean(axis=0)
    left, _, right = np.linalg.svd((begin - middles[0]).T @ (end - middles[1]))
    sign = np.sign(np.linalg.det(left @ right))
    turn = right.T @ np.diag([1.0, 1.0, sign]) @ left.T
    shift = middles[1] - turn @ middles[0]
    turns, shifts = [np.eye(3)], [np.zeros(3)]
    for _ in range(count):
        turns, shifts = [*turns, turn @ turns[-1]], [*shifts, turn @ shifts[-1] + shift]
    return np.array(turns), np.array(shifts)


def _mean(places: NDArray[np.int64], values: Array, count: int) -> Array:
    """Mean of the values of cells (c, n, ...) at each of ``count`` shared places; 0 where no cell has any."""
    number = np.bincount(places.ravel(), minlength=count)
    columns = values.reshape(places.size, -1).T
    total = np.stack([np.bincount(places.ravel(), each, count) for each in columns], axis=-1)
    return (total / np.maximum(number, 1)[:, None]).reshape(count, *values.shape[2:])

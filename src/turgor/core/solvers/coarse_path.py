"""Coarse path: follow the path of a model on a coarser mesh first; on its own mesh find the states asked for only.

The path on the coarse mesh has a state at every load at which a step on the fine mesh ends, because between its states
it is a line, and walls that touch do not move on lines.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.drive import kinks
from turgor.core.model.model import Model
from turgor.core.solvers.checkpoints.record import Question
from turgor.core.solvers.continuation.guide import check_guided, check_same_body
from turgor.core.solvers.continuation.step_control import StepControl
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import Iteration, Procedure, Solution, State, Timing
from turgor.foundation.errors import TurgorError

#: Folder of the coarse path in that of the run.
COARSE = "coarse"


def check_coarse(model: Model, procedure: Procedure, coarse: Mesh) -> None:
    """Refuse a coarse mesh whose path cannot lead along that of a model.

    Raises
    ------
    TurgorError
        If it is no mesh, is not coarser, is of another body or lacks one of its names, or the path depends on what was
        before.
    """
    if not isinstance(coarse, Mesh):
        raise TurgorError(f"coarse is {coarse!r}; allowed is a Mesh, as `mesh` returns it.")
    check_guided(model, procedure, "coarse")
    here, there = model.mesh.unknown_count, coarse.unknown_count
    if there >= here:
        raise TurgorError(
            f"coarse has {there:,} unknowns, and the mesh of the model {here:,}; it must have fewer. Thin walls may "
            "need as many cells on both."
        )
    check_same_body(model, coarse, "coarse")


def on_coarse_mesh(question: Question) -> Question:
    """Ask for the path on the coarse mesh of a question, with a state at each load at which a fine step ends."""
    assert question.coarse is not None and isinstance(question.procedure, Static)
    model, procedure = replace(question.model, mesh=question.coarse), question.procedure
    asked = replace(procedure, at=step_ends(procedure, kinks(model)))
    return Question(model=model, procedure=asked, options=question.options)


def step_ends(procedure: Static, turns: Sequence[float] = ()) -> tuple[float, ...]:
    """Load factors at which guided steps end, where none is cut back.

    Examples
    --------
    >>> step_ends(Static(at=(0.3,), max_step=0.5))
    (0.3, 0.8, 1.0)
    """
    control, load, ends = StepControl.of(replace(procedure, first_step=procedure.max_step), turns), 0.0, []
    while load < 1.0:
        load = control.next_load(load)
        ends.append(load)
    return tuple(ends)


def iterations_only(listeners: Listeners) -> Listeners:
    """Listen to the iterations of a coarse path: its states are none of the run, and do not end it."""
    heard = listeners.progress
    return Listeners(None if heard is None else _without_states(heard), logged=False)


def _without_states(heard: Callable[[Iteration, State | None], None]) -> Callable[[Iteration, State | None], None]:
    def hear(iteration: Iteration, _: State | None) -> None:
        heard(iteration, None)

    return hear


def led_by(coarse: Solution, fine: Solution) -> Solution:
    """Join the path on the fine mesh and the one that led it: what was done in all, and what is to be said.

    Parameters
    ----------
    coarse, fine : Solution

    Returns
    -------
    Solution
    """
    unknowns, last = coarse.model.mesh.unknown_count, coarse.states[-1].load_factor
    said = f"The path on a coarse mesh of {unknowns:,} unknowns led in {coarse.iterations} iterations"
    if not coarse.complete:
        said += f" up to load factor {last:.3g}, where it ended"
    return replace(
        fine, coarse=coarse, message=f"{fine.message} {said}.", timing=Timing.together((coarse.timing, fine.timing))
    )

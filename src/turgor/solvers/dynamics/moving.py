"""Procedures with forces besides those of the model, inertia or viscosity: their loops and their findings."""

from collections.abc import Sequence

from turgor.engine.system import System
from turgor.engine.tangent import Tangent
from turgor.finding import Finding
from turgor.solvers.dynamics.stabilization import follow_viscously
from turgor.solvers.dynamics.time_stepping import follow_motion
from turgor.solvers.energies import too_viscous, unbalanced
from turgor.solvers.listeners import Listeners
from turgor.solvers.outcomes import Outcome
from turgor.solvers.procedures.dynamic import Dynamic
from turgor.solvers.procedures.stabilized import Stabilized
from turgor.solvers.solution import Procedure, State, Step


def follow_moving(
    system: System,
    tangent: Tangent,
    procedure: Dynamic | Stabilized,
    listeners: Listeners,
    path: tuple[list[State], list[Step]],
    start: State | None = None,
) -> Outcome:
    """Follow a motion from rest, or from a state; what is found is added to ``path``."""
    if isinstance(procedure, Dynamic):
        return follow_motion(system, tangent, procedure, listeners, path, start)
    return follow_viscously(system, tangent, procedure, listeners, path, start)


def energy_findings(procedure: Procedure, states: Sequence[State]) -> tuple[Finding, ...]:
    """Say what there is to doubt about the energies of a run (L05, L06)."""
    if isinstance(procedure, Dynamic):
        return unbalanced(states)
    return too_viscous(states) if isinstance(procedure, Stabilized) else ()

"""Methods: the one list that says how each procedure is solved.

A new procedure adds its own file and one line here.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.model.model import Model
from turgor.core.solvers.continuation.load_control import follow_load
from turgor.core.solvers.energies import too_viscous, unbalanced
from turgor.core.solvers.outcomes import Outcome
from turgor.core.solvers.problem import Problem
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.core.solvers.procedures.auto import Auto
from turgor.core.solvers.procedures.dynamic import Dynamic
from turgor.core.solvers.procedures.gas_mass import GasMass
from turgor.core.solvers.procedures.stabilized import Stabilized
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.core.solvers.solution import State
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity


def _no_faces(model: Model, procedure: Any) -> tuple[str, ...]:
    return ()


def _never(model: Model) -> bool:
    return False


def _always(model: Model) -> bool:
    return True


def _can_come_to_rest(model: Model) -> bool:
    """Whether there is an obstacle or another body at which a free body can come to rest."""
    return bool(model.contact.obstacles) or len(find_bodies(model.mesh)) > 1


def _follow_arc(problem: Problem, procedure: ArcLength) -> Outcome:
    """As `follow_arc`; this import and those below stand here because a path needs the code of one procedure."""
    from turgor.core.solvers.continuation.scalar_control.arc_length import follow_arc

    return follow_arc(problem, procedure)


def _follow_volume(problem: Problem, procedure: VolumeControl) -> Outcome:
    from turgor.core.solvers.continuation.scalar_control.cavity_control import follow_volume

    return follow_volume(problem, procedure)


def _follow_gas(problem: Problem, procedure: GasMass) -> Outcome:
    from turgor.core.solvers.continuation.scalar_control.cavity_control import follow_gas

    return follow_gas(problem, procedure)


def _filled(model: Model, procedure: VolumeControl | GasMass) -> tuple[str, ...]:
    from turgor.core.solvers.continuation.scalar_control.cavity_control import controlled_faces

    return controlled_faces(model, procedure)


def _follow_auto(problem: Problem, procedure: Auto) -> Outcome:
    from turgor.core.solvers.continuation.branch_switch import follow_auto

    return follow_auto(problem, procedure)


def _follow_motion(problem: Problem, procedure: Dynamic) -> Outcome:
    from turgor.core.solvers.dynamics.time_stepping import follow_motion

    return follow_motion(problem, procedure)


def _follow_viscously(problem: Problem, procedure: Stabilized) -> Outcome:
    from turgor.core.solvers.dynamics.stabilization import follow_viscously

    return follow_viscously(problem, procedure)


def _nothing(states: Sequence[State]) -> tuple[Finding, ...]:
    return ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Method:
    """How a procedure is solved.

    Parameters
    ----------
    follow : callable
        ``follow(problem, procedure) -> Outcome`` fills the lists of the problem.
    controlled : callable
        ``controlled(model, procedure) -> names`` of the cavities whose pressure is unknown.
    may_be_free : callable
        ``may_be_free(model) -> bool``: whether supports may leave rigid motions free.
    findings : callable
        ``findings(states) -> findings`` about its energies (L05, L06).
    limit_points : Severity
        Of the finding that the path goes through limit points (L03).
    """

    follow: Callable[[Problem, Any], Outcome]
    controlled: Callable[[Model, Any], tuple[str, ...]] = _no_faces
    may_be_free: Callable[[Model], bool] = _never
    findings: Callable[[Sequence[State]], tuple[Finding, ...]] = _nothing
    limit_points: Severity = Severity.NOTE


#: How each procedure is solved; a class that is not listed is solved as the nearest class that it extends.
METHODS: Mapping[type, Method] = MappingProxyType(
    {
        Static: Method(follow=follow_load),
        VolumeControl: Method(follow=_follow_volume, controlled=_filled),
        GasMass: Method(follow=_follow_gas, controlled=_filled),
        ArcLength: Method(follow=_follow_arc),
        Auto: Method(follow=_follow_auto, limit_points=Severity.WARNING),
        Dynamic: Method(follow=_follow_motion, may_be_free=_always, findings=unbalanced),
        Stabilized: Method(follow=_follow_viscously, may_be_free=_can_come_to_rest, findings=too_viscous),
    }
)


def method_of(procedure: object) -> Method:
    """Return how a procedure is solved.

    Raises
    ------
    TurgorError
        If its class and those that it extends are not listed.
    """
    for kind in type(procedure).__mro__:
        if kind in METHODS:
            return METHODS[kind]
    known = ", ".join(kind.__name__ for kind in METHODS)
    raise TurgorError(f"{type(procedure).__name__} is no procedure that can be solved; known are {known}.")


def may_be_free(model: Model, procedure: object) -> bool:
    """Return whether supports may leave rigid motions free under a procedure: what moves or is slowed down needs none.

    Parameters
    ----------
    model : Model
    procedure : Procedure
        `Dynamic` always; `Stabilized` where there is something to come to rest at.

    Returns
    -------
    bool
    """
    return method_of(procedure).may_be_free(model)

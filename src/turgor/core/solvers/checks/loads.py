"""Checks of loads: states of bodies before the others, hardening with a shape, liquids in motion, what is weighed."""

from collections.abc import Sequence

from turgor.core.model.history import RAMP
from turgor.core.model.loads import Load
from turgor.core.model.model import Model
from turgor.core.solvers.checks.plausibility.question import Question
from turgor.foundation.finding import Finding, Severity


def states_while_loading(model: Model) -> tuple[Finding, ...]:
    """Say which states of bodies rise together with loads (L11), and which hardening has no stage (L12).

    Parameters
    ----------
    model : Model
        That of a stage, or of the run.

    Returns
    -------
    tuple of Finding
    """
    states = [load for load in model.loads if load.of_bodies and _rises(load)]
    loads = [load for load in model.loads if not load.of_bodies and _rises(load)]
    together = [_together(states[0], loads[0])] if states and loads else []
    loose = [load for load in model.loads if load.hardens and load.shape is None]
    return (*together, *(_without_stage(load) for load in loose))


def _rises(load: Load) -> bool:
    return load.history == RAMP


def _together(state: Load, load: Load) -> Finding:
    return Finding(
        code="L11",
        severity=Severity.NOTE,
        message=f"{state.label} rises together with {load.label}: at half of the load factor both have half of their "
        "value. Only the last state is that of a body in its whole state under the whole load.",
        advice="State it in a first stage, and the load in the next one; or give it a history that ends early, such as "
        "[[0, 0], [0.2, 1], [1, 1]], and the load one that begins there.",
    )


def _without_stage(load: Load) -> Finding:
    return Finding(
        code="L12",
        severity=Severity.WARNING,
        message=f"{load.label} begins in the shape of the mesh, where nothing is deformed: it makes the body stiffer "
        "from the start, and freezes no deformed shape.",
        advice="State it in the loads of a later stage, which begins in the deformed shape; or take Stiffness, if the "
        "body is stiffer from the start.",
    )


def idle_strips(questions: Sequence[Question]) -> tuple[Finding, ...]:
    """Say which liquids around slender bodies change no state, because nothing in the run has inertia (L13).

    Parameters
    ----------
    questions : sequence of Question
        Of all stages.

    Returns
    -------
    tuple of Finding
    """
    loads = [load for question in questions for load in question.model.loads]
    idle = dict.fromkeys(load.label for load in loads if load.strips is not None)
    if not idle or any(question.procedure.has_inertia for question in questions):
        return ()
    alone = all(load.strips is not None for load in loads)
    return (
        Finding(
            code="L13",
            severity=Severity.WARNING if alone else Severity.NOTE,
            message=f"{' and '.join(idle)} changes no equilibrium, only motion and natural frequencies"
            f"{'; nothing else drives the actuator' if alone else ''}.",
            advice="State the buoyancy as a HydrostaticPressure, [[loads.liquids]] in a job; or follow the motion with "
            "the procedure 'dynamic'.",
        ),
    )


def weightless_sheets(questions: Sequence[Question]) -> tuple[Finding, ...]:
    """Say which sheets on bodies have no density where others are weighed or accelerated (L14).

    Parameters
    ----------
    questions : sequence of Question
        Of all stages.

    Returns
    -------
    tuple of Finding
    """
    weighed = any(load.needs_density for each in questions for load in each.model.loads)
    if not weighed and not any(each.procedure.has_inertia for each in questions):
        return ()
    model = questions[0].model
    light = [f"'{name}'" for name in model.membranes if name not in model.sheet_masses]
    if not light:
        return ()
    return (
        Finding(
            code="L14",
            severity=Severity.NOTE,
            message=f"The sheet on {' and '.join(light)} has no density; its weight and inertia are left out.",
            advice="State one, such as density = '1400 kg/m³'.",
        ),
    )

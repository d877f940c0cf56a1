"""Check of liquids: whether one that acts in motion only has a motion."""

from collections.abc import Sequence

from turgor.core.solvers.checks.plausibility.question import Question
from turgor.foundation.finding import Finding, Severity


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
    if not idle or any(question.procedure.depends_on_path for question in questions):
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

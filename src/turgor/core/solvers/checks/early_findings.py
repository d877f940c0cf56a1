"""Early findings: everything that is known about a model before it is solved, in one call."""

from turgor.core.model.model import Model
from turgor.core.solvers.checks.contact import check_contact
from turgor.core.solvers.checks.fibers import check_fibers
from turgor.core.solvers.checks.loads import idle_strips, states_while_loading, weightless_sheets
from turgor.core.solvers.checks.materials import constants_in_doubt
from turgor.core.solvers.checks.obstacles import enclosed_obstacles, overlapping_obstacles
from turgor.core.solvers.checks.plausibility.check import implausible
from turgor.core.solvers.checks.plausibility.question import Question
from turgor.core.solvers.checks.supports import (
    added_pressures,
    check_supports,
    everything_fixed,
    fixed_cavities,
    fixed_tip,
    unloaded_cavities,
)
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.stage_sequence import questions
from turgor.foundation.finding import Finding, by_weight


def check_before_solve(model: Model, procedure: Procedure) -> tuple[Finding, ...]:
    """Refuse a model that cannot be solved; return the early findings of any other.

    A run needs one call: what it returns goes into the question that is solved.

    Parameters
    ----------
    model : Model
    procedure : Static, …, or Stages

    Returns
    -------
    tuple of Finding
        Those of `early_findings`.

    Raises
    ------
    TurgorError
        If the supports of a stage leave a rigid motion free or prescribe the whole surface of an incompressible body,
        or the procedure fills cavities that the model does not have.
    """
    for each in _questions(model, procedure):
        check_supports(each.model, inertia=each.procedure.may_be_free(each.model))
        each.procedure.controlled(each.model)
    return early_findings(model, procedure)


def early_findings(model: Model, procedure: Procedure) -> tuple[Finding, ...]:
    """Return what is known about a model and a procedure before the solve, the heaviest first.

    Parameters
    ----------
    model : Model
    procedure : Static, …, or Stages

    Returns
    -------
    tuple of Finding
        Doubtful constants, unstable laws (M04 to M07), magnitudes outside the range of the field (P01 to P06, L08),
        supports that hold everything, a cavity or the tip (B09, B27, B28), cavities without a pressure or with several
        (B03, L10), states of bodies (L11, L12), liquids that change nothing (L13), sheets without a density (L14),
        windings (B04, B05), walls and obstacles that overlap (B07, B08), obstacles in a cavity (B29).

    Raises
    ------
    TurgorError
        If a winding cannot lie on its face, or a stage changes what the model does not have.
    """
    questions = _questions(model, procedure)
    return by_weight(
        (
            *constants_in_doubt(model),
            *(finding for question in questions for finding in implausible(question)),
            *(finding for question in questions for finding in states_while_loading(question.model)),
            *everything_fixed(model),
            *fixed_cavities(model),
            *fixed_tip(model),
            *added_pressures(model),
            *(() if procedure.stages else unloaded_cavities(model)),
            *idle_strips(questions),
            *weightless_sheets(questions),
            *check_fibers(model),
            *check_contact(model),
            *overlapping_obstacles(model),
            *enclosed_obstacles(model),
        )
    )


def _questions(model: Model, procedure: Procedure) -> tuple[Question, ...]:
    """One question, or one for each stage."""
    models = questions(model, procedure)
    return tuple(Question(model=each, procedure=part) for each, part in zip(models, procedure.parts(), strict=True))

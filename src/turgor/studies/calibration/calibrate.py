"""calibrate: find parameters of a model, or of a rig, from experiments."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.studies.calibration.estimate import Estimate, estimate
from turgor.studies.calibration.objective import Objective, first_responses, rig_parameter
from turgor.studies.calibration.parameter import Parameter, check_names, values_at
from turgor.studies.calibration.result import Calibration, CalibrationStatus, Fitted, rms
from turgor.studies.calibration.search import SearchResult, search
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.calibration.trial import Data, Trial, check_taken, data_of
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.executors.run_outcome import Ended


def calibrate(
    trials: Trial | Sequence[Trial],
    free: Sequence[Parameter],
    *,
    rig: Sequence[str | Parameter] = (),
    hold_out: Sequence[Trial] = (),
    most_solves: int | None = None,
    evaluations: Evaluations | None = None,
) -> Calibration:
    """Fit parameters to one experiment or several through a model.

    The differences of all trials at the measured rows, each over its standard deviation, and those of priors are
    minimized by bounded least squares. Derivatives are those that the functions add to their responses
    (`turgor.studies.with_slopes`), as jobs do where they can be differentiated. Else they are finite differences, whose
    runs are computed at once in several processes; between them, Broyden updates do without further runs.

    Parameters
    ----------
    trials : Trial or sequence of Trial
        Experiments with the functions that compute them. A parameter of one name is the same in all of them.
    free : sequence of Parameter
        Parameters of the model.
    rig : sequence of str or Parameter
        Parameters of the rig, by the name of a compared column: ``"pressure_offset"`` is added to the measured
        pressure, ``"pressure_scale"`` multiplies it, ``"bending_angle_offset"`` is added to the measured angle. They
        cost no runs, and are the same in all trials with such a column.
    hold_out : sequence of Trial
        Experiments that are not fitted but predicted.
    most_solves : int, optional
        Runs after which the search ends; by default 5 and 10 more for each parameter of the model.
    evaluations : Evaluations, optional
        Where runs are computed and saved. By default in this process, without files, which suits formulas. With a
        folder (`saved_in`), a calibration that was killed goes on where it was: nothing is computed twice.

    Returns
    -------
    Calibration

    Raises
    ------
    TurgorError
        If a parameter is unknown, an experiment cannot be compared, or the run at the start fails.

    Examples
    --------
    A sphere with the stiffness as its parameter, measured without noise:

    >>> import numpy as np
    >>> from turgor.foundation.response import Column
    >>> from turgor.foundation.source import Source
    >>> def sphere(C10):
    ...     stretch = np.linspace(1.0, 1.3, 20)
    ...     pressure = 0.4 * C10 * (1 / stretch - 1 / stretch**7)
    ...     columns = Column("pressure", "kPa", pressure), Column("widening", "", stretch - 1)
    ...     return Response(columns=columns, source=Source(text="a sphere"))
    >>> fitted = calibrate(Trial(measured=sphere(0.12e6), function=sphere), [Parameter(name="C10", start=0.1e6)])
    >>> round(fitted.values["C10"], -2), fitted.converged
    (120000.0, True)
    """
    requested = [trials] if isinstance(trials, Trial) else list(trials)
    if not requested:
        raise TurgorError("a calibration needs a trial: an experiment and the function that computes it.")
    check_names(free)
    check_taken(requested, free)
    runs = evaluations or Evaluations()
    most = 5 + 10 * len(free) if most_solves is None else most_solves
    if most < 2 + len(free):
        raise TurgorError(f"most_solves is {most}; allowed is {2 + len(free)} or more.")
    before = len(runs.ended)
    begun, data = _paired([*requested, *(_without_slopes(each, requested) for each in hold_out)], free, runs)
    fitted, predicted = data[: len(requested)], data[len(requested) :]
    parameters = (*free, *(rig_parameter(each, fitted) for each in rig))
    check_names(parameters)
    objective = Objective(parameters=parameters, models=len(free), data=fitted, evaluations=runs)
    end = search(objective, np.array([each.coordinate(each.start) for each in parameters]), before + most)
    if objective.assumed and any(each.prior is not None for each in parameters):
        objective = objective.reweighted(end.residuals)
        end = search(objective, end.at, before + most)
    return _calibration(objective, end, predicted, begun, before)


def _without_slopes(held_out: Trial, fitted: Sequence[Trial]) -> Trial:
    """Request no derivatives of predicted trials, unless the same run serves a trial that is fitted."""
    shared = any(each.function is held_out.function and each.values == held_out.values for each in fitted)
    return held_out if shared else replace(held_out, slopes={})


def _paired(
    trials: Sequence[Trial], free: Sequence[Parameter], runs: Evaluations
) -> tuple[list[Response], tuple[Data, ...]]:
    """Compute all trials at the start, and pair their columns with the measured ones."""
    values = {each.name: each.value(each.coordinate(each.start)) for each in free}
    taken = [each.taken(free) for each in trials]
    ended = runs.of([each.run(values, names) for each, names in zip(trials, taken, strict=True)])
    begun = first_responses(ended)
    data = tuple(data_of(*each) for each in zip(trials, begun, taken, strict=True))
    for each, response in zip(data, begun, strict=True):
        _check_range(each, response)
    return begun, data


def _check_range(data: Data, begun: Response) -> None:
    """Refuse measured rows that no parameter brings within the computed range; a path that ended early may go on."""
    drive, reach = data.drive, begun.find(data.x)
    beyond = data.beyond(begun, {}, CALIBRATION.margin)
    if not (data.trial.prescribed and beyond) or begun.message:
        return
    name, measured = data.measured_x, data.trial.measured.find(data.measured_x)
    raise TurgorError(
        f"{beyond} of {len(drive)} measured rows of {data.trial.name} lie beyond the computed range of '{data.x}', "
        f"{reach.span}; measured is {measured.span}. Compute as far as was measured,",
        python="or leave these rows out with within_ranges.",
        command=f"or leave these rows out with --range {name}='{reach.span.replace(' to ', '..')}'.",
    )


def _calibration(
    objective: Objective, end: SearchResult, predicted: tuple[Data, ...], begun: Sequence[Response], before: int
) -> Calibration:
    """Compute the curves at the solution and return the calibration."""
    parameters, runs = objective.parameters, objective.evaluations
    values = values_at(parameters, end.at)
    data = (*objective.data, *predicted)
    ended = runs.of([each.trial.run(values, each.taken) for each in data])
    known = estimate(objective, end)
    start = {each.name: each.start for each in parameters}
    rig = {each.name: values[each.name] for each in parameters[objective.models :]}
    curves = [_fitted(*each, rig, start) for each in zip(data, begun, ended, strict=True)]
    fits, held_out = curves[: len(objective.data)], [each for each in curves[len(objective.data) :] if each is not None]
    own = list(runs.ended.values())[before:]
    failures = [f"{each.run.name}: {each.problem}" for each in own if each.problem]
    status = CalibrationStatus.CONVERGED
    if not end.converged:
        status = CalibrationStatus.NOT_CONVERGED
    elif known.at_bound:
        status = CalibrationStatus.AT_BOUND
    fits_ = tuple(each for each in fits if each is not None)
    message, advice = _outcome_text(status, known, fits_, len(own))
    if status is CalibrationStatus.NOT_CONVERGED:
        message, advice = _why_not(objective, end, len(own), len(failures))
    return Calibration(
        parameters=parameters, values=values, estimate=known, fits=fits_, held_out=tuple(held_out), status=status,
        message=message, advice=advice, solves=len(own), computed=sum(not each.again for each in own),
        derivatives=objective.derivatives(end.at), failures=tuple(failures),
    )  # fmt: skip


def _fitted(data: Data, begun: Response, ended: Ended, rig: dict[str, float], start: dict[str, float]) -> Fitted | None:
    """Return a trial with its curves; None where the run of a held-out trial failed."""
    if ended.result is None:
        return None
    response = ended.result.response
    return Fitted(
        data=data,
        start=begun,
        fitted=response,
        rms_start=rms(data.differences(begun, {name: value for name, value in start.items() if name in rig})),
        rms=rms(data.differences(response, rig)),
        rig=rig,
        beyond=data.beyond(response, rig),
    )


def _why_not(objective: Objective, end: SearchResult, solves: int, failed: int) -> tuple[str, str]:
    """Return why a search has not converged in plain words, and advice."""
    parameters = objective.parameters
    most = int(np.argmax(np.abs(end.step)))
    each, from_, to = parameters[most], end.at[most], end.at[most] + end.step[most]
    message = (
        f"Not converged: all {solves} runs are used up, and one more step would lower the differences by about "
        f"{100 * end.gain:.2g} %, with {each.name} from {each.shown(each.value(from_))} to "
        f"{each.shown(each.value(to))}."
    )
    if failed:
        message += f" {failed} of the runs failed."
    again = "Call it again with more runs (--most-solves, most_solves): those that are done are not repeated."
    return message, f"{again} Or start closer, narrow the bounds, or free fewer parameters."


def _outcome_text(status: CalibrationStatus, known: Estimate, fits: Sequence[Fitted], solves: int) -> tuple[str, str]:
    """Return how the calibration ended, and advice."""
    count = f"{solves} runs"
    lost = [each for each in fits if each.beyond]
    if status is CalibrationStatus.AT_BOUND:
        names = " and ".join(known.at_bound)
        message = f"Converged after {count}, with {names} at a bound."
        advice = f"Widen the bound of {names} if values beyond it make sense; else the model or the experiment is off."
    else:
        message, advice = f"Converged after {count}.", ""
    for each in lost:
        message += (
            f" {each.beyond} of {len(each.data.value)} measured rows of {each.data.trial.name} lie beyond the "
            "computed curve, which was continued straight there."
        )
        if each.fitted.message:
            message += f" It ended early: {each.fitted.message}"
    return message, advice

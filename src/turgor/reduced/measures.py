"""Measures: what is read off an answer, with the error of the mesh of the full model and that of the reduction."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.measure import measure
from turgor.core.engine.runtime import EngineOptions
from turgor.core.results.error_text import with_error
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.measures import as_measure, chosen_measures
from turgor.foundation.errors import NotSolved
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.reduced.path import solution_of
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.known_measures import KnownMeasures
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.verify import verified

Array = NDArray[np.float64]

#: Inputs at which errors of measures are computed, as shares of the ranges: seldom those of training states, at which
#: the error of the reduction is small.
SHARES = (0.236, 0.472, 0.708, 0.944)


@dataclass(frozen=True, slots=True)
class Reading:
    """A measure of an answer.

    Parameters
    ----------
    name, words, unit : str
        ``"bending_angle"``, ``"bending angle"``, and the unit in which it is shown.
    value : float [SI]
    mesh_error, reduction_error : float [SI]
        Estimated error of the mesh of the full model near these inputs, and largest known error of the reduction; nan
        where one is unknown.
    """

    name: str
    words: str
    unit: str
    value: float
    mesh_error: float
    reduction_error: float

    @property
    def text(self) -> str:
        """Value and errors, such as ``12.1 ± 1.3 deg, reduction ± 0.02 deg``."""
        known = with_error(self.value, self.mesh_error, self.unit)
        if np.isnan(self.reduction_error):
            return known
        return f"{known}, reduction ± {self.reduction_error / COLUMN_UNITS[self.unit]:.2g} {self.unit}".rstrip()


def with_measures(reduced: Reduced, names: Sequence[str] = (), options: EngineOptions | None = None) -> Reduced:
    """Compute the errors of measures at four states along the ranges of the inputs, for answers to state them.

    The error of the mesh is estimated as `measure` does, and the full model is solved at these states. This takes as
    long as some full steps.

    Parameters
    ----------
    reduced : Reduced
    names : sequence of str, optional
        What will be read off; the standard measures of the part by default.
    options : EngineOptions, optional

    Returns
    -------
    Reduced
        The same with `Reduced.measures`.
    """
    answers = _along(reduced)
    if not answers:
        return reduced
    path = solution_of(answers)
    chosen = chosen_measures(path, [as_measure(name) for name in names])
    response = measure(path, *chosen, options=options)
    chosen = tuple(each for each in chosen if each.along is None and each.name in response)
    rows = [_reduction_errors(answer, chosen, options) for answer in answers]
    known = KnownMeasures(
        names=tuple(each.name for each in chosen),
        inputs=np.array([answer.inputs for answer in answers]),
        values=np.array([response[each.name][1:] for each in chosen]).reshape(len(chosen), -1).T,
        mesh=np.array([_mesh_errors(response, each.name) for each in chosen]).reshape(len(chosen), -1).T,
        reduction=np.array(rows).reshape(len(answers), -1),
    )
    return replace(reduced, measures=known)


def readings(answer: ReducedState) -> list[Reading]:
    """Read the measures of a reduced model off an answer, each with its errors.

    Parameters
    ----------
    answer : ReducedState

    Returns
    -------
    list of Reading
        Empty where the model was saved without measures: see `with_measures`.
    """
    known, box = answer.reduced.measures, answer.reduced.inputs
    if not known.names:
        return []
    at, near = StateFields(answer.state()), known.nearest(answer.inputs, box.high - box.low)
    out = []
    for place, name in enumerate(known.names):
        each = as_measure(name)
        value = each(at)
        if each.unwrap:
            value += _whole_turns(float(known.values[near, place]) - value)
        words = Column(name, each.unit, np.zeros(0)).words
        errors = float(known.mesh[near, place]), float(known.largest[place])
        out.append(Reading(name, words, each.unit, value, *errors))
    return out


def _whole_turns(angle: float) -> float:
    """Full turns next to an angle [rad]."""
    return 2 * np.pi * round(angle / (2 * np.pi))


def _along(reduced: Reduced) -> list[ReducedState]:
    """Answers along the ranges of the inputs, as far as there are any."""
    answers, box = [], reduced.inputs
    for share in SHARES:
        try:
            answers.append(reduced.at(box.at_shares(np.full(len(box.keys), share))))
        except NotSolved:
            continue
    return answers


def _mesh_errors(response: Response, name: str) -> Array:
    """Errors (k,) of the mesh at the states after rest."""
    errors = response.mesh_error(name)
    return np.full(len(response) - 1, np.nan) if errors is None else np.asarray(errors)[1:]


def _reduction_errors(answer: ReducedState, measures: Sequence[Measure], options: EngineOptions | None) -> Array:
    """Differences (m,) of measures of an answer from those of the full model; nan where it finds no equilibrium."""
    try:
        full = verified(answer, options).state
    except NotSolved:
        return np.full(len(measures), np.nan)
    ours, true = StateFields(answer.state()), StateFields(full)
    away = [each(ours) - each(true) for each in measures]
    return np.array([abs(d - _whole_turns(d)) if m.unwrap else abs(d) for d, m in zip(away, measures, strict=True)])

"""Predictor: extrapolate the last points of a path, with the highest order that a lower one does not improve.

The residual compares extrapolations with each other, not with the last state: where a slender body turns, any of them
stretches its walls a little, and the residual of that is large although the next update removes it at once. So on the
first steps of a path, the last state is taken only where walls touch, where sheets wrinkle, or where stresses are not
linearized.
Where walls touch, the state moves on along the tangent of the path instead: the tangent contains the stiffness of the
points in contact. A polynomial through states with other points in contact presses walls far into each other or lifts
them off. Where surfaces slide with friction on a curved body, the tangent lifts them off; then the parabola of the last
two tangents is taken.

Where sheets wrinkle, the order is at most that of a parabola, and stress and strain of the sheets follow a line: each
point of a sheet has a kink in its path where it goes slack, and the residual, to which a stiff sheet adds much for
small moves, does not tell a good order from a bad one.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.terms import Contacts
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.continuation.path_points import between, unknowns_between
from turgor.core.solvers.continuation.path_run import Point
from turgor.core.solvers.continuation.settings import PREDICTOR
from turgor.core.solvers.newton.convergence import relative_residual
from turgor.core.solvers.newton.line_search import evaluate
from turgor.core.solvers.newton.newton_values import Start

Array = NDArray[np.float64]


def unbalanced_force(system: System, at: Evaluation) -> float:
    """Size of the residual at the free unknowns."""
    return float(np.linalg.norm(at.residual[~system.prescribed]))


@dataclass(frozen=True, slots=True)
class Extrapolation:
    """Comparison of extrapolations.

    Parameters
    ----------
    measure : callable
        ``measure(system, evaluation) -> float``, smaller is better.
    good : float
        One that measures less is taken without trying a lower order.
    stay : bool
        Whether the last point itself competes with the others.
    shorten : bool
        Whether those that press walls into each other are shortened, and those between walls that touch follow the
        tangent.
    """

    measure: Callable[[System, Evaluation], float]
    good: float
    stay: bool
    shorten: bool


#: Under load control the residual relative to the load says how good a prediction is.
BY_LOAD = Extrapolation(relative_residual, PREDICTOR.good_prediction, True, True)

#: Where scalars are unknown, the load itself is predicted: only the unbalanced force compares predictions.
BY_PATH = Extrapolation(unbalanced_force, 0.0, False, False)


def predicted(
    constraint: Constraint, tangent: Tangent, history: Sequence[Point], parameter: float, how: Extrapolation
) -> Start:
    """Extrapolate the history of a path to a parameter.

    Parameters
    ----------
    constraint : Constraint
    tangent : Tangent
        Whose clock runs.
    history : sequence of Point
    parameter : float
    how : Extrapolation

    Returns
    -------
    Start
    """
    system, last = constraint.scalar_unknowns.system, history[-1]
    along = _along_tangent(constraint, tangent, history, parameter) if how.shorten else None
    if along is not None:
        return along
    if system.model.sheets_wrinkle:
        history = history[-PREDICTOR.wrinkling_history :]
    best, smallest = Start(last.unknowns, last.stresses, last.scalars), np.inf
    for count in range(len(history), 0, -1):
        young = len(history) < PREDICTOR.history and _is_near(history, parameter)
        stays = how.stay and not (young and _moves_on(system, tangent, best.evaluation))
        if count == 1 and not stays and np.isfinite(smallest):
            break
        trial = _between(system, history[-count:], parameter)
        unknowns, at = trial.unknowns, evaluate(constraint, tangent, (trial.unknowns, trial.scalars), parameter)
        if at is not None and how.shorten and system.contact.parts and count > 1:
            unknowns, at = _not_deeper(constraint, tangent, last, at)
        size = np.inf if at is None else how.measure(system, at)
        if np.isfinite(smallest) and size >= smallest:
            break
        if size < smallest:
            best, smallest = Start(unknowns, trial.stresses, trial.scalars, evaluation=at), size
        if smallest <= how.good:
            break
    return best


def gentle_share(system: System, history: Sequence[Point], parameter: float) -> float:
    """Share of the way to a parameter on which no wall is pressed much deeper into another, by extrapolation.

    From a state in which new points are just inside, Newton's method finds what touches. From one in which a wall has
    gone far through another it does not, however often an update is cut.

    Parameters
    ----------
    system : System
    history : sequence of Point
        The last points of load control.
    parameter : float
        Load factor.

    Returns
    -------
    float
        1 for the whole way.
    """
    if not system.contact.parts or len(history) < 2:
        return 1.0
    last = history[-1]
    here = system.contacts(last.unknowns, last.parameter)
    along = here.touch and last.change is not None
    ahead = _ahead(last, parameter) if along else unknowns_between(history, parameter)
    return system.contact.shortening(here, system.contacts(ahead, parameter))


def _is_near(history: Sequence[Point], parameter: float) -> bool:
    """Whether a step is not much longer than the last one: after a sudden load the path takes another direction."""
    if len(history) < 2:
        return True
    before, last = history[-2].parameter, history[-1].parameter
    return parameter - last <= PREDICTOR.far * (last - before)


def _moves_on(system: System, tangent: Tangent, at: Evaluation | None) -> bool:
    """Whether Newton's method removes at once what an extrapolation stretches, so that it is better than to stay."""
    return at is not None and tangent.mixed_points and not at.contacts.touch and not system.model.sheets_wrinkle


def _knows_touch(system: System, history: Sequence[Point]) -> bool:
    """Whether walls touch at the last point and the tangent of the path is known there; not beyond a kink of loads."""
    last = history[-1]
    if not system.contact.parts or len(history) < 2 or last.change is None:
        return False
    return system.contacts(last.unknowns, last.parameter).touch


def _ahead(last: Point, parameter: float) -> Array:
    """Unknowns (size,) on the tangent of the path at a point."""
    assert last.change is not None
    return last.unknowns + (parameter - last.parameter) * last.change


def _along_tangent(
    constraint: Constraint, tangent: Tangent, history: Sequence[Point], parameter: float
) -> Start | None:
    """Move on along the tangent where walls touch; None elsewhere, or where that turns a cell inside out."""
    system, last = constraint.scalar_unknowns.system, history[-1]
    if not _knows_touch(system, history):
        return None
    here = evaluate(constraint, tangent, (last.unknowns, last.scalars), parameter)
    ahead = _ahead(last, parameter)
    at = evaluate(constraint, tangent, (ahead, last.scalars), parameter)
    if here is None or at is None:
        return None
    if at.contacts.rubs and _touching(at.contacts) < PREDICTOR.stays_on * _touching(
        system.contacts(last.unknowns, last.parameter)
    ):
        bent = _bent(history, parameter)
        along = None if bent is None else evaluate(constraint, tangent, (bent, last.scalars), parameter)
        if bent is not None and along is not None and _touching(along.contacts) > _touching(at.contacts):
            ahead, at = bent, along
    return Start(ahead, system.stresses(here, ahead - last.unknowns), last.scalars, evaluation=at)


def _touching(contacts: Contacts) -> int:
    """Number of points in contact."""
    return sum(int(each.inside.sum()) for each in contacts.gaps)


def _bent(history: Sequence[Point], parameter: float) -> Array | None:
    """Unknowns (size,) on the parabola of the last two tangents; None where one is not known.

    What slides around a drum lifts off along its tangent, by more than it is pressed in.
    """
    before, last = history[-2:]
    if before.change is None or last.change is None:
        return None
    turned = (last.change - before.change) / (last.parameter - before.parameter)
    return _ahead(last, parameter) + 0.5 * (parameter - last.parameter) ** 2 * turned


def _between(system: System, points: Sequence[Point], parameter: float) -> Start:
    """The polynomial through points, at a parameter; that of wrinkling sheets is a line through the last two."""
    trial = between(points, parameter)
    if trial.stresses is None or not system.model.sheets_wrinkle:
        return trial
    line = between(points[-2:], parameter).stresses
    assert line is not None
    return replace(trial, stresses=replace(trial.stresses, terms=line.terms))


def _not_deeper(
    constraint: Constraint, tangent: Tangent, last: Point, at: Evaluation
) -> tuple[Array, Evaluation | None]:
    """Shorten an extrapolation of load control until it presses no wall much deeper into another."""
    contact, parameter, here_ = constraint.scalar_unknowns.system.contact, at.load_factor, last.unknowns
    here = evaluate(constraint, tangent, (here_, last.scalars), parameter)
    trial: Evaluation | None = at
    for _ in range(PREDICTOR.shortenings):
        if trial is None or here is None:
            break
        share = contact.shortening(here.contacts, trial.contacts)
        if share == 1:
            return trial.unknowns, trial
        place = here_ + share * (trial.unknowns - here_)
        trial = evaluate(constraint, tangent, (place, last.scalars), parameter)
    return (here_, here) if trial is None else (trial.unknowns, trial)

"""Line search: shorten an update of Newton's method until it is allowed.

An update is too long if it turns a cell inside out, presses walls too deep into each other, or if the residual force
along it reverses where friction acts, or many times over where other points touch than before.
"""

from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.contact.part import SearchMode
from turgor.core.engine.contact.terms import Contacts
from turgor.core.engine.system import Evaluation, System
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.newton.iteration import shortened
from turgor.core.solvers.newton.settings import LINE_SEARCH

Array = NDArray[np.float64]


def evaluate(
    constraint: Constraint,
    tangent: Tangent,
    place: tuple[Array, Array],
    parameter: float,
    contacts: Contacts | None = None,
) -> Evaluation | None:
    """Evaluate the residual at unknowns and scalars on the clock; ``contacts`` are partners that stay."""
    start = perf_counter()
    how = SearchMode.FOLLOW if contacts is None else SearchMode.KEEP
    out = constraint.evaluate(place[0], parameter, place[1], contacts, how)
    tangent.clock.residual += perf_counter() - start
    return out


def line_search(
    constraint: Constraint,
    tangent: Tangent,
    step: tuple[Evaluation, Array, Array, Array],
    parameter: float,
    contacts: Contacts | None,
) -> tuple[Evaluation | None, float]:
    """Shorten an update until it is allowed.

    Parameters
    ----------
    constraint : Constraint
    tangent : Tangent
        Whose clock runs.
    step : (Evaluation, (size,) array, (k,) array, (k,) array)
        Where it begins, the update, the scalars there and their update.
    parameter : float
    contacts : Contacts or None
        Partners of contact that stay.

    Returns
    -------
    (Evaluation or None, float)
        The end of the shortened update and its length; None where even the shortest turns a cell inside out.
    """
    at, update, scalars, change = step

    def trial(length: float) -> tuple[Evaluation | None, float]:
        place = at.unknowns + length * update, scalars + length * change
        new = evaluate(constraint, tangent, place, parameter, contacts)
        return new, 0.5 if new is None else length_allowed(constraint.scalar_unknowns.system, at, new, update)

    return shortened(trial, LINE_SEARCH.shortest, LINE_SEARCH.shortest_touching)


def length_allowed(system: System, at: Evaluation, new: Evaluation, update: Array) -> float:
    """Share of an update to take: less than 1 if walls are pressed too deep, or if contact reverses the force."""
    share = system.contact.shortening(at.contacts, new.contacts)
    rubs = new.contacts.rubs or bool(system.terms.remembering)  # both have kinks
    if share < 1 or not (rubs or not new.contacts.touch_as(at.contacts)):
        return share
    free = system.moving & ~system.prescribed
    along = update[free]
    before, after = float(at.residual[free] @ along), float(new.residual[free] @ along)
    most = LINE_SEARCH.overshot if rubs else LINE_SEARCH.overshot_touching
    return 0.5 if after * before < 0 and abs(after) > most * abs(before) else 1.0

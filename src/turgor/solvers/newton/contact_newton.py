"""Newton's method where things touch: friction and the contact stiffness are renewed until nothing changes."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from turgor.engine.contact.part import Look
from turgor.engine.contact.pressure import nodal_pressure, touched_area
from turgor.engine.system import Evaluation, System
from turgor.engine.tangent import Tangent
from turgor.solvers.newton.inertia_correction import downhill
from turgor.solvers.newton.newton import NewtonResult, NewtonSettings, Report, Start, newton, relative_residual
from turgor.solvers.solution import Touch

#: Times that friction and stiffness are renewed at most.
PASSES = 20

#: A state holds if the residual is at most this many times the tolerance when what touches is searched for anew.
SEARCHED_ANEW = 10.0

#: From this pass on a state holds too if the residual is at most this much then: in the wedge of a kink between two
#: sides a point changes its partner with every search, by a gap that is next to nothing.
PATIENCE, WEDGED = 3, 1e-3


def until_settled(
    system: System,
    result: Any,
    look: Callable[[Any], Evaluation | None],
    again: Callable[[Evaluation, Any], Any],
    tolerance: float,
) -> Any:
    """Search anew what touches and renew friction and stiffness, until a result holds; iterations of all passes count.

    ``look(result)`` evaluates a result with a whole search, ``again(at, result)`` finds equilibrium from there.
    Results are `NewtonResult` or the like: dataclasses with ``evaluation``, ``converged``, ``iterations``, ``hardest``
    and ``reason``.
    """
    contact = system.contact
    if not contact.parts:
        return result
    before, iterations, hardest = contact.anchors, result.iterations, result.iterations
    for number in range(PASSES):
        at = look(result) if result.converged else None
        if at is None:
            break
        renewed, stiffened = contact.settle(at.contacts), contact.stiffen(at.contacts)
        residual = relative_residual(system, at)
        if not stiffened and residual <= SEARCHED_ANEW * tolerance:
            return replace(result, evaluation=at, iterations=iterations, hardest=hardest)
        if not (stiffened or renewed) and number >= PATIENCE and residual <= WEDGED:
            return replace(result, iterations=iterations, hardest=hardest)
        result = again(at, result)
        iterations += result.iterations
        hardest = max(hardest, result.iterations)
    if result.converged:
        reason = f"what touches did not settle in {PASSES} passes"
        result = replace(result, converged=False, reason=reason)
    contact.anchors = before
    return replace(result, iterations=iterations)


def newton_with_contact(
    system: System, tangent: Tangent, start: Start, load_factor: float, settings: NewtonSettings, report: Report
) -> NewtonResult:
    """Find equilibrium at a load factor, with all that touches."""

    def look(result: NewtonResult) -> Evaluation | None:
        last = result.evaluation
        assert last is not None
        return system.evaluate(last.unknowns, load_factor, known=last.contacts, how=Look.ANEW)

    def find(start: Start) -> NewtonResult:
        result = newton(system, tangent, start, load_factor, settings, report)
        if result.converged or tangent.plain:
            return result
        found = downhill(system, tangent, start.unknowns, load_factor, settings, report)
        iterations = result.iterations + found.iterations
        return replace(found if found.converged else result, iterations=iterations)

    def again(at: Evaluation, result: NewtonResult) -> NewtonResult:
        found = find(Start(at.unknowns, system.stresses(at)))
        return replace(found, reason=result.reason) if found.converged and not found.reason else found

    settled: NewtonResult = until_settled(system, find(start), look, again, settings.tolerance)
    return settled


def touches(system: System, at: Evaluation) -> dict[str, Touch]:
    """What every contact does in a state, in SI units, by its name."""
    length, stress = system.length, system.stress
    count = system.node_count
    out: dict[str, Touch] = {}
    for part, found in zip(system.contact.parts, at.contacts.found, strict=True):
        force = -part.forces(at.contacts.position, found)[:count]  # on the body: against the internal force
        one = Touch(
            force=force * stress * length**2,
            pressure=nodal_pressure(part, found, count) * stress,
            area=touched_area(part, found) * length**2,
            penetration=max(0.0, -float(found.gap.min(initial=0.0))) * length,
            place=found.place * length,
            share=system.contact.share_of_tolerance(part, found),
        )
        out[part.name] = one if part.name not in out else _both(out[part.name], one)
    return out


def _both(a: Touch, b: Touch) -> Touch:
    """Two parts of one contact."""
    return Touch(
        force=a.force + b.force,
        pressure=np.maximum(a.pressure, b.pressure),
        area=a.area + b.area,
        penetration=max(a.penetration, b.penetration),
        place=a.place,
        share=max(a.share, b.share),
    )

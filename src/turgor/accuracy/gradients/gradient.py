"""gradient: derivatives of measures at a state of a path."""

from collections.abc import Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np

from turgor.accuracy.gradients.checks import check_state
from turgor.accuracy.gradients.differentiated import Reading, chosen_measures
from turgor.accuracy.gradients.equilibrium import equilibrium_of
from turgor.accuracy.gradients.measure_derivatives import derived
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.accuracy.gradients.moved_mesh import on_moved_mesh
from turgor.accuracy.gradients.result import Gradient, numbers_in
from turgor.accuracy.gradients.systems import Systems
from turgor.accuracy.gradients.variation import Variation
from turgor.core.engine.runtime import FEW_UNKNOWNS, EngineOptions, use_threads
from turgor.core.results.measures.measure import Measure
from turgor.core.solvers.solution import Solution
from turgor.foundation.response import Column


def gradient(
    solution: Solution,
    measures: Measure | str | Sequence[Measure | str],
    wrt: str | Sequence[str] | Variation,
    *,
    state: int = -1,
    options: EngineOptions | None = None,
) -> Gradient:
    """Differentiate measures at a state by numbers of the model: materials, loads, thicknesses, dimensions.

    The derivative is that of the discrete solution, and nothing is solved again. The tangent is factored once more at
    the state, and each number takes a few residuals and solutions with these factors. What is left of the differences,
    ``residual``, says how accurate the derivative is.

    Parameters
    ----------
    solution : Solution
        Of `solve`.
    measures : Measure, str or sequence of them
        What is differentiated. ``"pressure"`` and ``"cavity_1_pressure"`` are measures, too, for procedures that find
        them.
    wrt : str, sequence of str, or Variation
        Numbers of the model by their keys, such as ``"materials.body.C10"``, ``"loads.pressure"`` or
        ``"materials.layer.thickness"``; two keys with a comma between them are one number. A `Variation` names any
        other numbers, such as dimensions of an actuator, with the function that makes the model of them.
    state : int
        Number of the state; the last one by default.
    options : EngineOptions, optional
        Linear solver and threads.

    Returns
    -------
    Gradient

    Raises
    ------
    TurgorError
        If the state depends on more than its equations (motion, friction, rubber that relaxes or softens), lies at a
        limit point, or a number is unknown or cannot change by little.
    """
    return gradient_with(Systems(), solution, measures, wrt, state, options)


def gradient_with(
    systems: Systems,
    solution: Solution,
    measures: Measure | str | Sequence[Measure | str],
    wrt: str | Sequence[str] | Variation,
    state: int,
    options: EngineOptions | None,
) -> Gradient:
    """Differentiate measures at one of several states; see `gradient`.

    Parameters
    ----------
    systems : Systems
        The same for all states.
    solution, measures, wrt, state, options
        Those of `gradient`. A `Variation` that gives the same model again for the same values spares its equations.

    Returns
    -------
    Gradient
    """
    began = perf_counter()
    options = options or EngineOptions()
    at = check_state(solution, state)
    chosen = chosen_measures(at, [measures] if isinstance(measures, Measure | str) else measures)
    procedure = solution.procedure.parts(at.stage)[-1]
    variation = wrt if isinstance(wrt, Variation) else model_variation(at.model, [wrt] if isinstance(wrt, str) else wrt)
    threads = options.threads if at.model.mesh.unknown_count >= FEW_UNKNOWNS else 1
    with use_threads(threads):
        base = equilibrium_of(at, procedure, replace(options, threads=threads), systems)
        reading = Reading(base, chosen)
        derivatives = derived(base, reading, on_moved_mesh(variation, at.model.mesh))
        values = reading.along(solution, state % len(solution.states))
    return Gradient(
        measures=tuple(
            Column(each.name, each.unit, np.array([value])) for each, value in zip(chosen, values, strict=True)
        ),
        numbers=numbers_in(variation.values, variation.units),
        keys=tuple(variation.values),
        values=derivatives.slopes,
        load_factor=at.load_factor,
        way=derivatives.way,
        solves=derivatives.solves,
        seconds=perf_counter() - began,
        residual=derivatives.residual,
    )

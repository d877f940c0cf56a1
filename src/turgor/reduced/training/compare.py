"""Compare: answers of a reduced model against states of full solves."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.faces import surfaces
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.foundation.errors import NotSolved
from turgor.reduced.settings import ESTIMATE, START
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.estimate import KnownErrors
from turgor.reduced.states.held_out import HeldOutErrors
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.states.spline import Spline
from turgor.reduced.training.trainer import Path

Array = NDArray[np.float64]


def compared(reduced: Reduced, path: Path, reached_only: bool) -> HeldOutErrors:
    """Compare answers with the states of a path of full solves whose inputs lie in the trained range.

    Parameters
    ----------
    reduced : Reduced
    path : Path
    reached_only : bool
        Whether the last state alone counts; so it is where some loads are no inputs, which act in part before.

    Returns
    -------
    HeldOutErrors
    """
    equations, box = reduced.equations, reduced.inputs
    fixed = bool(equations.pressures[:, 0].any() or equations.forces[:, 0].any())
    places = [len(path.inputs) - 1] if reached_only or fixed else range(len(path.inputs))
    rows = []
    for place in places:
        inputs = path.inputs[place, 1:]
        if box.outside(inputs):
            continue
        try:
            answer = reduced.at(inputs)
            errors = *errors_of(answer, path.displacements[place]), force_error(answer, path.obstacle_forces[place])
        except NotSolved:
            errors = (np.inf, np.inf, np.inf, np.inf)
        rows.append((inputs, errors))
    columns = np.array([errors for _, errors in rows]).reshape(-1, 4).T
    inputs = np.array([inputs for inputs, _ in rows]).reshape(-1, len(box.keys))
    return HeldOutErrors(inputs=inputs, displacement=columns[0], tip=columns[1], volume=columns[2], force=columns[3])


def force_error(answer: ReducedState, full: Array) -> float:
    """Largest error of the force on an obstacle, for full forces (o, 3) [N], over the largest in training."""
    reduced, forces = answer.reduced, answer.obstacle_forces
    if not len(full):
        return 0.0
    names = [obstacle.name for obstacle in reduced.model.contact.obstacles]
    none = np.zeros(3)
    away = [float(np.linalg.norm(forces.get(name, none) - true)) for name, true in zip(names, full, strict=True)]
    largest = max([1e-300, *(part.largest for part in reduced.equations.obstacles)])
    return max(away) / largest


def known_errors(reduced: Reduced, paths: Sequence[Path]) -> KnownErrors:
    """Errors of a reduced model at states of full solves, some of them where there are many.

    Where the reduced model finds nothing, and at the ends that the full model did not reach, the error counts as 1,
    with the largest indicator of the others: the body is at least as soft there.

    Parameters
    ----------
    reduced : Reduced
    paths : sequence of Path
    """
    every = [(path, place) for path in paths for place in range(len(path.inputs))]
    thinned = np.unique(np.linspace(0, len(every) - 1, min(len(every), ESTIMATE.most)).astype(int))
    r = reduced.equations.sizes[0]
    places: list[Array] = []
    errors: list[float] = []
    sizes: list[float] = []
    indicators: list[float] = []
    for path, place in (every[each] for each in thinned):
        aim = path.inputs[place]
        try:
            answer = reduced.under(aim)
            error = errors_of(answer, path.displacements[place])[0]
            size, indicator = float(np.linalg.norm(answer.y[:r])) / reduced.size, answer.indicator
        except NotSolved:
            error, size, indicator = 1.0, 1.0, np.nan
        places, errors = [*places, aim], [*errors, error]
        sizes, indicators = [*sizes, size], [*indicators, indicator]
    ends = [aim_of(reduced.inputs, path) for path in paths if not path.reached]
    ones, unknown = np.ones(len(ends)), np.full(len(ends), np.nan)
    known = np.concatenate([indicators, unknown])
    largest = float(known[np.isfinite(known)].max(initial=ESTIMATE.smallest))
    return KnownErrors(
        places=np.array([*places, *ends]) * reduced.weights,
        errors=np.concatenate([errors, ones]),
        sizes=np.concatenate([sizes, ones]),
        indicators=np.nan_to_num(known, nan=largest),
    )


def start_of(reduced: Reduced) -> Spline | None:
    """Spline through answers at training states and their derivatives; None where there are no answers.

    Parameters
    ----------
    reduced : Reduced
    """
    aims, r = reduced.trained_inputs, reduced.equations.sizes[0]
    most = max(2, START.rows // (1 + len(reduced.inputs.keys)))
    rows: list[tuple[Array, Array, Array]] = []
    for aim in aims[np.unique(np.linspace(0, len(aims) - 1, min(len(aims), most)).astype(int))]:
        try:
            y = reduced.under(aim).y
        except NotSolved:
            continue
        at = reduced.equations.at(y, aim)
        if at is None:
            continue
        rates: Array = -np.linalg.solve(at.tangent(), at.by_inputs()).astype(np.float64)
        steep = np.linalg.norm(rates[:r], axis=0) / np.where(reduced.weights > 0, reduced.weights, np.inf)
        if steep.max() <= START.steepest * reduced.size:
            rows.append((aim, y, rates))
    if not rows:
        return None
    places, values, slopes = (np.array(each) for each in zip(*rows, strict=True))
    return Spline.through(reduced.weights, places, values, slopes)


def aim_of(box: Inputs, path: Path) -> Array:
    """The share of the fixed loads, 1, and the inputs (1 + n,) to which a path goes, reached or not."""
    last = path.inputs[-1]
    values = np.where(box.places, last[1:], last[1:] / last[0])
    return box.on_path(values, 1.0)


def errors_of(answer: ReducedState, full: Array) -> tuple[float, float, float]:
    """Errors of an answer's displacement, tip and volume, for full scaled displacements (n, 3).

    Displacement and tip are shares of the largest ones in training; volume is the worst of all faces.
    """
    reduced, (largest, travel) = answer.reduced, answer.reduced.yardsticks
    mesh, length = reduced.model.mesh, reduced.scales[0]
    error = float(np.abs(answer.displacement / length - full).max())
    tip = np.zeros(3)
    if "tip" in mesh.faces:
        weights = surfaces.nodal_weights(mesh.points, mesh.face("tip"))
        tip = answer.tip / length - MeshFacts(mesh).of_whole(weights @ full / weights.sum())
    volumes = [abs(answer.volumes[face] / cavity_volume(mesh, face, full * length) - 1) for face in reduced.faces]
    return error / largest, float(np.linalg.norm(tip)) / max(travel, 1e-300), max(volumes, default=0.0)

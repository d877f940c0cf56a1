"""Where a free tip sets out: the actuator is followed for a small share of its load, with the equations of the run.

A linear solve at rest would not do: a sheet or thread that bears tension only has hardly any stiffness there.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import surfaces
from turgor.core.engine.runtime import EngineOptions
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.model import Model
from turgor.core.setups.directions import unmirrored
from turgor.core.setups.settings import BLOCKED_TIP
from turgor.core.solvers.checkpoints.record import Question
from turgor.core.solvers.listeners import Listeners
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import State
from turgor.core.solvers.solve import follow_question
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]


def first_direction(model: Model, face: str, axes: str, notify: Callable[[str], None] | None = None) -> str:
    """Find the direction along one of some axes in which a face sets out under a small share of the load.

    Parameters
    ----------
    model : Model
        The free actuator.
    face : str
        The face that moves.
    axes : str
        Axes that count, any of x, y, z.
    notify : callable, optional
        Where notices of the engine go.

    Returns
    -------
    str
        Such as ``"-z"``.

    Raises
    ------
    TurgorError
        If the face does not move, the supports leave a rigid motion free, or no equilibrium is found.
    """
    mesh, picked = model.mesh, ["xyz".index(axis) for axis in axes]
    least = ROUND_OFF.same * float(np.ptp(mesh.points))

    def stop(state: State) -> str | None:
        far = state.load_factor >= BLOCKED_TIP.first_share * (1 - ROUND_OFF.same)
        return "the tip has set out" if far and _largest(motion(mesh, face, state)[0][picked]) > least else None

    question = Question(
        model=model, procedure=Static(tolerance=BLOCKED_TIP.tolerance), options=EngineOptions(notify=notify)
    )
    path = follow_question(question, Listeners(stop=stop), None, throw=False)
    mean, whole = motion(mesh, face, path.states[-1])
    clear = BLOCKED_TIP.clear * _largest(mean)
    mean, whole = mean[picked], whole[picked]
    if not _largest(mean) > least:
        how = "under the load" if path.complete else f"before the free actuator stops ({path.message.rstrip('.')})"
        raise TurgorError(
            f"blocked_force: direction is 'free', but the face '{face}' does not set out along "
            f"{' or '.join(axes)} {how}; state the direction, such as '-z'."
        )
    axis = int(np.abs(whole if _largest(whole) > clear else mean).argmax())
    return f"{'+' if mean[axis] > 0 else '-'}{axes[axis]}"


def motion(mesh: Mesh, face: str, state: State) -> tuple[Array, Array]:
    """Displacement of a face of the whole actuator, (3,) [m]: its mean, and what all of it moves along its normal.

    A bender turns its tip, so that the middle of the face moves along the axis without being pushed there: some line
    across the face stays where it is, and the second displacement has no part along the normal. An actuator that
    extends moves the whole face, be it by what its rim moves.

    Parameters
    ----------
    mesh : Mesh
    face : str
    state : State

    Returns
    -------
    mean, whole : arrays (3,)
    """
    weights = surfaces.nodal_weights(mesh.points, mesh.face(face))
    mean = unmirrored(mesh, weights @ state.displacement / weights.sum())
    normal = outward(mesh, face)
    along = state.displacement[mesh.face_nodes(face)] @ normal
    all_of_it = 0.0 if along.min() < 0 < along.max() else float(along[np.abs(along).argmin()])
    return mean, mean + (all_of_it - mean @ normal) * normal


def outward(mesh: Mesh, face: str) -> Array:
    """Unit vector out of the tip of the whole actuator, (3,)."""
    area = unmirrored(mesh, surfaces.vector_area(mesh.points, mesh.face(face)))
    size = float(np.linalg.norm(area))
    if not size > 1e-6 * surfaces.area(mesh.points, mesh.face(face)):
        raise TurgorError(f"the face '{face}' looks nowhere, for its normals cancel; a tip needs an end face.")
    return area / size


def _largest(values: Array) -> float:
    return float(np.abs(values).max(initial=0.0))

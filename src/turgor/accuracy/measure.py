"""measure: read measures off every state of a path, each with its estimated mesh error."""

from functools import partial

from turgor.accuracy.adaptivity.mesh_error import MeshError, estimate_mesh_error
from turgor.core.engine.runtime import EngineOptions
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.measures import as_measure, chosen_measures
from turgor.core.results.measures.measures import measure as read
from turgor.core.solvers.pressures import pressures_of, stated_by_loads
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import one
from turgor.foundation.response import MESH_ERROR, Column, Response

#: The estimate by one linear solve.
LINEAR = "linear"


def measure(
    solution: Solution,
    *measures: Measure | str,
    mesh_error: bool | str = True,
    options: EngineOptions | None = None,
) -> Response:
    """Read measures off every state of a path, each with an estimate of its mesh error.

    Parameters
    ----------
    solution : Solution
        The path, complete or not.
    *measures : Measure or str
        What to read, such as `bending_angle` or its name; those of `STANDARD_MEASURES` that the part has, if none is
        given.
    mesh_error : bool or "linear"
        Whether the mesh error is estimated. It takes up to half the time of the solve, once for a solution: a few
        states are solved again on a second, finer mesh. ``"linear"`` takes one linear solve there, at the last
        state alone, where the loads are given.
    options : EngineOptions, optional
        How the engine runs on the second mesh.

    Returns
    -------
    Response
        First the drive: ``load_factor`` and, where a pressure acts, ``pressure``, or ``cavity_1_pressure`` and the like
        where faces have different ones, and what the procedure prescribed, ``injected_volume`` or
        ``gas_mass_ratio``, and in a sequence ``stage``, the number of finished stages and the load factor of this one;
        then the measures, each followed by its mesh error, such as ``bending_angle_mesh_error``. With several cavities,
        ``cavity_volume`` of all is followed by ``cavity_1_volume`` and so on; with several regions ``von_mises_p99`` by
        ``body_von_mises_p99`` and so on. The standard measures are followed by those of the procedure and of contact,
        where there is any. A moving actuator also has its ``time`` and, last, its energies.

    Raises
    ------
    TurgorError
        If a measure needs a face that the mesh does not have, or ``mesh_error`` is another word.
    """
    one(solution, Solution, "solution", "a Solution is needed, as solve(model) returns it")
    if not isinstance(mesh_error, bool) and mesh_error != LINEAR:
        raise TurgorError(f"mesh_error is {mesh_error!r}; allowed are True, False and '{LINEAR}'.")
    chosen = tuple(map(as_measure, measures))
    response = read(solution, *chosen)
    if not mesh_error:
        return response
    estimate = mesh_error_of(solution, chosen, options, linear=mesh_error == LINEAR, known=response)
    return with_mesh_error(response, estimate)


def mesh_error_of(
    solution: Solution,
    measures: tuple[Measure, ...] = (),
    options: EngineOptions | None = None,
    refined_before: bool = False,
    linear: bool = False,
    known: Response | None = None,
) -> MeshError:
    """Estimate the mesh error of all that `measure` reads, including the pressures that a procedure found.

    Parameters
    ----------
    solution : Solution
    measures : tuple of Measure
        What is read.
    options : EngineOptions, optional
    refined_before : bool
        Whether the mesh was refined where the error comes from.
    linear : bool
        Whether one linear solve is enough.
    known : Response, optional
        What was read of the path, which need not be read again.

    Returns
    -------
    MeshError
    """
    chosen = (*_unknown_pressures(solution), *chosen_measures(solution, measures))
    return estimate_mesh_error(solution, chosen, options, refined_before, linear, known)


def with_mesh_error(response: Response, estimate: MeshError) -> Response:
    """Put the column of each mesh error behind that of its measure.

    Parameters
    ----------
    response : Response
    estimate : MeshError

    Returns
    -------
    Response
    """
    columns: list[Column] = []
    for column in response.columns:
        columns.append(column)
        if column.name in estimate.errors:
            columns.append(Column(column.name + MESH_ERROR, column.unit, estimate.errors[column.name]))
    return Response(
        columns=tuple(columns),
        source=response.source,
        status=response.status,
        message=response.message,
        stages=response.stages,
    )


def _unknown_pressures(solution: Solution) -> tuple[Measure, ...]:
    """Measures of the pressures that the procedure found, by the names of their columns."""
    last = solution.states[-1]
    acting, stated = pressures_of(last), {load.face for load in solution.model.pressures}
    given = last.model is solution.model and stated_by_loads(last)
    controlled = [] if given else [name for name, value in last.pressures.items() if name not in stated and value]
    faces = list(acting) if solution.procedure.parts(last.stage)[-1].finds_load else controlled
    return tuple(
        Measure(
            name="pressure" if len(acting) == 1 else f"{face}_pressure",
            unit="kPa",
            function=partial(_pressure, face),
            definition=f"gauge pressure on {face}",
        )
        for face in faces
    )


def _pressure(face: str, at: StateFields) -> float:
    return pressures_of(at.state).get(face, 0.0)

"""Measures: each is a number read off one state; `measure` reads them along a path into a `Response`."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.element import element_of
from turgor.core.geometry.names import measured_faces
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.drive import common_pressure, pressures_at
from turgor.core.model.model import Model
from turgor.core.results.drive import stage_column
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.bond_measures import bond_measure, openings_of
from turgor.core.results.measures.contact_measures import (
    area_on,
    contact_measures_of,
    force_on,
    moment_on,
)
from turgor.core.results.measures.energies import energy_columns, time_column
from turgor.core.results.measures.field_measures import (
    OF_ANY_MESH,
    as_column,
    in_each_region,
    in_region,
)
from turgor.core.results.measures.grasping.grasp_measures import grasp_measure, grasp_measures_of
from turgor.core.results.measures.measure import Measure as Measure
from turgor.core.results.measures.measure import measures_of
from turgor.core.results.measures.point_measures import point_measure, point_measures_of
from turgor.core.results.measures.standard_measures import (
    STANDARD_MEASURES,
    bending_angle,
    cavity_volume,
    heading,
    volume_of,
)
from turgor.core.solvers.pressures import pressures_of, stated_by_loads
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.registry import Registry
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]


def measure(solution: Solution, *measures: Measure | str) -> Response:
    """Read measures off every state of a path.

    Parameters
    ----------
    solution : Solution
        The path, complete or not.
    *measures : Measure or str
        What to read, such as `bending_angle` or its name; those of `STANDARD_MEASURES` that the part has, if none is
        given.

    Returns
    -------
    Response
        First the drive: ``load_factor`` and, where a pressure acts, ``pressure``, or ``cavity_1_pressure`` and the like
        where faces have different ones, and what the procedure prescribed, ``injected_volume`` or
        ``gas_mass_ratio``, and in a sequence ``stage``, the number of finished stages and the load factor of this one;
        then the measures. With several cavities, ``cavity_volume`` of all is
        followed by ``cavity_1_volume`` and so on; with several regions ``von_mises_p99`` is followed by
        ``body_von_mises_p99`` and so on. The standard measures are followed by those of the procedure
        and of contact, where there is any. A moving actuator also has its ``time`` and, last, its energies.

    Raises
    ------
    TurgorError
        If a measure is unknown, or needs a face that the mesh does not have.
    """
    return Reader(tuple(map(as_measure, measures))).response(solution)


@dataclass(slots=True, eq=False)
class Reader:
    """Reads measures off the states of a path that grows, each state once.

    Parameters
    ----------
    measures : sequence of Measure
        `STANDARD_MEASURES` if it is empty.
    """

    measures: Sequence[Measure] = ()
    _names: tuple[str, ...] = ()
    _facts: MeshFacts | None = None
    _rows: dict[int, tuple[Array, list[float]]] = field(default_factory=dict)

    def response(self, solution: Solution, fields: PathFields | None = None) -> Response:
        """Return the measures of all states, as `measure` does; ``fields`` are those that others read, too."""
        chosen = chosen_measures(solution, self.measures)
        names = tuple(each.name for each in chosen)  # the measures of parts are made again each time
        if names != self._names:
            self._names, self._rows = names, {}
        if self._facts is None or self._facts.mesh is not solution.model.mesh:
            self._facts = MeshFacts(solution.model.mesh) if fields is None else fields.facts
        fields = fields or PathFields(solution, self._facts, most=0)
        alone = [each for each in chosen if each.along is None]
        for row, state in enumerate(solution.states):
            if id(state.displacement) not in self._rows:
                at = fields.at(row)
                self._rows[id(state.displacement)] = state.displacement, [each(at) for each in alone]
                fields.leave(row, at)
        rows = [self._rows[id(state.displacement)][1] for state in solution.states]
        table = dict(zip((each.name for each in alone), np.array(rows).reshape(len(rows), len(alone)).T, strict=True))
        path = [StateFields(state, self._facts) for state in solution.states]
        columns = list(_drive(solution))
        known = {column.name for column in columns}  # a prescribed volume is a measure, too
        for each in (each for each in chosen if each.name not in known):
            values = table[each.name] if each.along is None else each.read(path)
            columns.append(Column(each.name, each.unit, np.unwrap(values) if each.unwrap else values))
        known = {column.name for column in columns}
        columns += [column for column in energy_columns(solution) if column.name not in known]
        return Response(
            columns=tuple(columns),
            source=_source(solution),
            status=str(solution.status),
            message=solution.message,
            stages=tuple(state.stage for state in solution.states) if solution.procedure.stages else (),
        )


def chosen_measures(solution: Solution, measures: Sequence[Measure]) -> tuple[Measure, ...]:
    """Choose what `measure` reads: what is requested with its parts, or the standard measures."""
    mesh = solution.model.mesh
    fitting = fitting_measures(measured_faces(mesh.faces, mesh.cavities))
    standard = tuple(measures) in ((), STANDARD_MEASURES, fitting)
    model = solution.model
    contact = (*contact_measures_of(solution), *grasp_measures_of(solution))
    own = (*point_measures_of(model), *contact, *openings_of(model))
    requested = (*_with_value(fitting, StateFields(solution.states[0])), *own) if standard else measures
    return _with_parts(tuple(dict.fromkeys((*_driven_in_some(solution), *requested))), mesh)


def _driven_in_some(solution: Solution) -> tuple[Measure, ...]:
    """Measures of what some stages prescribe and others do not, such as the injected volume."""
    every = [name for state in solution.states for name in state.driven]
    some = (name for name in dict.fromkeys(every) if every.count(name) < len(solution.states))
    return tuple(MEASURES[name] for name in some if name in MEASURES)


def _with_value(standard: Sequence[Measure], at: StateFields) -> tuple[Measure, ...]:
    """The standard measures without the bending angle, where the part does not lie in the plane of bending."""
    try:
        for face in bending_angle.faces if bending_angle in standard else ():
            heading(at, face, at.mesh.points)
    except TurgorError:
        return tuple(each for each in standard if each is not bending_angle)
    return tuple(standard)


def fitting_measures(faces: Collection[str]) -> tuple[Measure, ...]:
    """Return the standard measures that a part with these faces has.

    Examples
    --------
    >>> [each.name for each in fitting_measures(["fixed", "outside"])][:2]
    ['principal_stretch_p99', 'maximum_principal_stretch']
    """
    return tuple(each for each in STANDARD_MEASURES if each.fits(faces))


def check_measures(model: Model, measures: Sequence[Measure | str]) -> None:
    """Try measures on the undeformed state, before the solve: a face may be missing, or the mesh be too coarse.

    Parameters
    ----------
    model : Model
    measures : sequence of Measure or str

    Raises
    ------
    TurgorError
        If one has no value there.
    """
    chosen = tuple(map(as_measure, measures))
    mesh = model.mesh
    rest = State(
        model=model, load_factor=0.0, displacement=np.zeros_like(mesh.points),
        mean_stress=np.zeros(element_of(model).mean_count), nodal_force=np.zeros_like(mesh.points),
    )  # fmt: skip
    at, fitting = StateFields(rest), fitting_measures(measured_faces(mesh.faces, mesh.cavities))
    for each in _with_value(fitting, at) if chosen in (STANDARD_MEASURES, fitting) else chosen:
        if each not in OF_ANY_MESH:  # these need no face, and stresses of a whole mesh take seconds
            each.read([at])


def as_measure(given: object) -> Measure:
    """Return a measure, given itself or by its name.

    Examples
    --------
    >>> as_measure("bending_angle") is bending_angle
    True
    >>> as_measure(3)
    Traceback (most recent call last):
    turgor.TurgorError: 3 is no measure; give one of tg.measures, such as tg.measures.bending_angle, or its name.
    """
    if isinstance(given, str):
        return find_measure(given)
    if not isinstance(given, Measure):
        raise TurgorError(
            f"{given!r} is no measure; give one of tg.measures, such as tg.measures.bending_angle, or its name."
        )
    return given


def find_measure(name: str) -> Measure:
    """Return the ready-made measure of a name; an unknown name fails with the near match.

    Examples
    --------
    >>> find_measure("bending_angle").unit
    'deg'
    """
    if name in MEASURES:
        return MEASURES[name]
    for called in (in_region, bond_measure, _of_cavity, point_measure, grasp_measure):
        measure = called(name)
        if measure is not None:
            return measure
    if name.endswith("_contact_area"):
        return area_on(name.removesuffix("_contact_area"))
    if name.endswith("_force"):
        return force_on(name.removesuffix("_force"))
    if name.endswith("_moment"):
        return moment_on(name.removesuffix("_moment"))
    raise unknown("measure", name, MEASURES, MEANT)


def _of_cavity(name: str) -> Measure | None:
    """Return the volume of one cavity of a name such as ``cavity_1_volume``."""
    is_one = name.startswith("cavity_") and name.endswith("_volume")
    return volume_of(name.removesuffix("_volume")) if is_one else None


def _with_parts(chosen: Sequence[Measure], mesh: Mesh) -> tuple[Measure, ...]:
    """Add the volume of each cavity to that of all, and stress and stretch of each region, where there are several."""
    out, given = [], {each.name for each in chosen}
    for each in chosen:
        parts = in_each_region(each, mesh)
        if each is cavity_volume and len(mesh.cavities) > 1:
            parts = [volume_of(cavity) for cavity in mesh.cavities]
        out += [each, *(part for part in parts if part.name not in given)]
    return tuple(out)


def _drive(solution: Solution) -> tuple[Column, ...]:
    factors = np.array([state.load_factor for state in solution.states])
    columns = [Column("load_factor", "", factors), *stage_column(solution), *time_column(solution)]
    common = common_pressure(solution.model.loads)
    if not all(state.model is solution.model and stated_by_loads(state) for state in solution.states):
        pressures = [pressures_of(state) for state in solution.states]
        for face in pressures[0]:
            name = "pressure" if len(pressures[0]) == 1 else f"{as_column(face)}_pressure"
            columns.append(Column(name, "kPa", np.array([at[face] for at in pressures])))
    elif common is not None:
        columns.append(Column("pressure", "kPa", np.array([common.at(factor) for factor in factors])))
    elif solution.model.pressures:
        acting = [pressures_at(solution.model, factor) for factor in factors]
        for face in acting[0]:
            columns.append(Column(f"{as_column(face)}_pressure", "kPa", np.array([at[face] for at in acting])))
    for name in solution.states[0].driven:
        if any(name not in state.driven for state in solution.states):
            continue  # another stage prescribed something else
        unit = solution.procedure.parts()[0].drive_unit
        columns.append(Column(as_column(name), unit, np.array([state.driven[name] for state in solution.states])))
    return tuple(columns)


def _source(solution: Solution) -> Source:
    mesh = solution.model.mesh
    return Source(text="finite elements", detail=f"{mesh.name}, {len(mesh.cells)} cells, {len(mesh.points)} nodes")


#: Measures by the words that others use for them.
MEANT: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(("angle", "bend", "bending", "tip_angle"), "bending_angle"),
        **dict.fromkeys(("twist", "torsion"), "twist_angle"),
        **dict.fromkeys(("displacement", "deflection", "tip", "u"), "tip_displacement"),
        **dict.fromkeys(("volume", "v"), "cavity_volume"),
        **dict.fromkeys(("stress", "mises", "von_mises", "s"), "von_mises_p99"),
        **dict.fromkeys(("stretch", "strain", "principal_stretch"), "principal_stretch_p99"),
        **dict.fromkeys(("force", "reaction_force", "rf"), "reaction"),
    }
)

#: Every ready-made measure by name: those that the files of this folder define.
MEASURES: Registry[Measure] = Registry("turgor.core.results.measures", measures_of)

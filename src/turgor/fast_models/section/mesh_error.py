"""Mesh error of a section: a few of its states are solved again, with every cell cut in four.

The refined cells are exact pieces of the cells, so a state on them starts from the interpolated one. At sharp corners
the error falls with the first power of the size of the cells, elsewhere faster. The second cells then have half of it
at most, and twice the difference is the estimate.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.transfer import Transfer
from turgor.core.meshing.refining.refinement import Refinement
from turgor.core.meshing.refining.split_hexahedra import refine_hexahedra, sheets
from turgor.fast_models.section.columns import columns_of
from turgor.fast_models.section.equations import Equations, Question, Unknowns
from turgor.fast_models.section.path import Point, follow, newton
from turgor.fast_models.section.plane import near_nodes
from turgor.fast_models.section.stiffness import scales
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import MESH_ERROR, Column
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]

#: Places of the states that are solved again, as shares of the number of rows.
PLACES = (0.5, 1.0)

#: Estimate over the difference between both meshes.
REMAINDER = 2.0

#: Columns that are not zero at rest, besides the volume.
REST = {
    "stretch": 1.0,
    "cavity_ballooning": 1.0,
    "outside_ballooning": 1.0,
    "largest_stretch": 1.0,
    "principal_stretch_p99": 1.0,
}


def with_mesh_error(
    columns: Sequence[Column], equations: Equations, points: Sequence[Point]
) -> tuple[tuple[Column, ...], tuple[Finding, ...]]:
    """Put the mesh error of each column next to it.

    Parameters
    ----------
    columns : sequence of Column
        Of the points.
    equations : Equations
    points : sequence of Point
        States along a path.

    Returns
    -------
    columns : tuple of Column
    findings : tuple of Finding
        N03 where no state was found on the refined cells.
    """
    if not points:
        return tuple(columns), ()
    rows = sorted({max(1, round(share * len(points))) - 1 for share in PLACES})
    refined, refined_points = _again(equations, [points[row] for row in rows])
    rows = rows[: len(refined_points)]
    if not rows:
        return tuple(columns), (_not_estimated(),)
    again = columns_of(refined, refined_points)
    values = {column.name: column.values for column in again}
    rest = REST | {"cavity_volume_per_length": float(equations.volumes(equations.rest).sum()) * equations.area}
    out: list[Column] = []
    for column in columns:
        out.append(column)
        difference = abs(values.get(column.name, column.values[rows]) - column.values[rows])
        error = _along_path(column.values, rest.get(column.name, 0.0), rows, REMAINDER * difference)
        if error.max() > ROUND_OFF.same * _scale(column, equations):
            out.append(Column(column.name + MESH_ERROR, column.unit, error))
    return tuple(out), ()


@lru_cache(maxsize=1)
def _refined(equations: Equations) -> tuple[Equations, Transfer, Refinement]:
    """Equations on cells that are cut in four; the last ones are cached for the next path of the same section."""
    model = equations.model
    refinement = refine_hexahedra(model.mesh, np.unique(sheets(model.mesh)[:, :2]))
    refined = Equations(replace(model, mesh=refinement.mesh), closed=equations.closed)
    return refined, Transfer(model.mesh, refinement), refinement


def _again(equations: Equations, points: Sequence[Point]) -> tuple[Equations, list[Point]]:
    """States of points on the refined cells, each from its interpolated start, else all along a path from rest."""
    refined, transfer, refinement = _refined(equations)
    questions = [_scaled(point.question, equations, refined) for point in points]
    states: list[Point] = []
    for point, question in zip(points, questions, strict=True):
        state = newton(refined, _interpolated(point.unknowns, (equations, refined), transfer, refinement), question)
        if state is None:  # a stiff sheet makes a large residual of a small change of its shape
            return refined, list(follow(refined, questions).points)
        states.append(state)
    return refined, states


def _scaled(question: Question, equations: Equations, refined: Equations) -> Question:
    """A question to the refined equations, which have another unit of length."""
    (force, strain), (fine_force, fine_strain) = scales(equations), scales(refined)
    return Question(
        pressures=question.pressures,
        volumes=question.volumes * equations.area / refined.area,
        strains=question.strains * strain / fine_strain,
        forces=question.forces * force / fine_force,
    )


def _interpolated(
    at: Unknowns, both: tuple[Equations, Equations], transfer: Transfer, refinement: Refinement
) -> Unknowns:
    """A state on the refined cells."""
    equations, refined = both
    places = transfer.nodal(at.y[equations.plane.node_of])[near_nodes(refined.plane)]
    x, y = np.moveaxis(refinement.corners[:, :4, :2], 2, 0)
    bilinear = np.stack([(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y], axis=-1)
    p = np.empty(refined.rubber.mean_count)
    p[refined.rubber.mean] = np.einsum("cka,ca->ck", bilinear, at.p[equations.rubber.mean[refinement.parent]])
    return Unknowns(
        y=places * equations.plane.length / refined.plane.length,
        strains=at.strains * scales(equations)[1] / scales(refined)[1],
        p=p,
        multipliers=np.zeros(len(refined.numbers.conditions)),
        pressures=at.pressures,
    )


def _scale(column: Column, equations: Equations) -> float:
    """Scale of a column: that of a strain or a force, whose values may be zero, or its largest value."""
    force, strain = scales(equations)
    usual = {"1/m": strain[1], "N": force[0], "Nm": force[1]}
    return float(usual.get(column.unit, np.abs(column.values).max()))


def _along_path(values: Array, rest: float, rows: Sequence[int], errors: Array) -> Array:
    """Errors (n,) of all rows from those of some: between them as shares of the largest change from rest so far."""
    change = np.maximum.accumulate(np.abs(values - rest))
    if (change[rows] > ROUND_OFF.same * np.abs(values).max()).all():
        return np.asarray(np.interp(np.arange(len(values)), rows, errors / change[rows]) * change)
    return np.interp(np.arange(len(values)), rows, errors)


def _not_estimated() -> Finding:
    return Finding(
        code="N03",
        severity=Severity.NOTE,
        message="The mesh error was not estimated: no state was found on the refined cells.",
        advice="Compare two sizes of cells yourself.",
    )

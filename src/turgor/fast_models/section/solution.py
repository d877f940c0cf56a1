"""Solution of a section: the strains of the rod, the forces and the sizes along a path, as a `Response`."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.section.columns import columns_of
from turgor.fast_models.section.equations import Equations
from turgor.fast_models.section.mesh_error import with_mesh_error
from turgor.fast_models.section.path import Path, Point
from turgor.fast_models.section.stiffness import SectionStiffness, stiffness_of
from turgor.foundation.display import Shown
from turgor.foundation.errors import NotSolved, TurgorError
from turgor.foundation.finding import Finding
from turgor.foundation.response import Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]


class SectionError(NotSolved):
    """A section could not be followed to the end; ``solution`` holds the path so far."""

    def __init__(self, message: str, solution: "SectionSolution") -> None:
        super().__init__(message)
        self.solution = solution


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SectionSolution(Shown):
    """States of a section along a path.

    Parameters
    ----------
    response : Response
        One row for each state. ``curvature_y`` and ``curvature_z`` are rotations about y and z per reference length,
        ``curvature`` is their size, ``twist`` the rotation about the axis per reference length, ``stretch`` that of
        the line through the centroid of the solids. ``cavity_volume_per_length`` belongs to a reference length.
        ``outside_ballooning`` and ``cavity_ballooning`` are square roots of the ratio of the areas across the
        actuator, now and at rest: of a round tube, the ratio of its radii. ``axial_force``, ``torque``, ``moment_y``
        and ``moment_z`` act on the rod besides the pressures; they are zero unless given, or hold a strain.
        ``principal_stretch_p99`` is the principal stretch that 99 % of the rubber stay below, ``largest_stretch`` the
        largest at any point, which grows at sharp corners with every finer mesh. Each column is followed by its
        estimated mesh error, such as ``curvature_y_mesh_error``.
    stable : tuple of bool
        Whether each state is stable against changes of the section that are the same all along it.
    """

    response: Response
    stable: tuple[bool, ...]
    _equations: Equations
    _points: tuple[Point, ...]

    def __repr__(self) -> str:
        return f"SectionSolution({len(self._points)} states, {self.response.status}, {', '.join(self.response)})"

    def stiffness(self, row: int = -1) -> SectionStiffness:
        """Stiffness of the section at a state, the last one by default."""
        return stiffness_of(self._equations, self._point(row))

    def outline(self, row: int | None = -1) -> Array:
        """Boundary of the deformed section, (e, 3, 3) [m]: edges by both ends and the middle, in the rod's frame.

        That at rest where ``row`` is None.
        """
        equations = self._equations
        loops = [equations.outside, *equations.cavities.values()]
        edges = np.concatenate([loop.edges for loop in loops])
        return np.asarray(self.positions(row)[edges])

    def positions(self, row: int | None = -1) -> Array:
        """Nodes of the deformed section (n, 3) [m]: warping along x, and places y, z from the reference line.

        Those at rest where ``row`` is None.
        """
        plane = self._equations.plane
        return np.asarray((plane.points if row is None else self._point(row).unknowns.y) * plane.length)

    def _point(self, row: int) -> Point:
        count = len(self._points)
        if not -count <= row < count:
            raise TurgorError(f"row is {row}; the section has {count} states, 0 to {count - 1}.")
        return self._points[row]


def solution_of(
    equations: Equations, path: Path, outcome: tuple[str, str], source: Source, mesh_error: bool
) -> SectionSolution:
    """Read the columns of a path.

    Parameters
    ----------
    equations : Equations
    path : Path
    outcome : (Status, str)
    source : Source
    mesh_error : bool
        Whether the mesh error of the columns is estimated.
    """
    columns = tuple(columns_of(equations, path.points))
    findings: tuple[Finding, ...] = ()
    if mesh_error:
        columns, findings = with_mesh_error(columns, equations, path.points)
    return SectionSolution(
        response=Response(columns=columns, source=source, status=outcome[0], message=outcome[1], findings=findings),
        stable=tuple(_is_stable(equations, p) for p in path.points),
        _equations=equations,
        _points=path.points,
    )


def _is_stable(equations: Equations, point: Point) -> bool:
    """Whether the tangent has as many negative pivots as constraints; prescribed strains count as constraints."""
    S, _, _ = equations.condensed(point.equations)
    negative = equations.solver.negative_pivots(equations.numbers.constraints)
    free = np.setdiff1d(np.arange(len(S)), equations.numbers.strains[~np.isnan(point.question.strains)])
    S = S[np.ix_(free, free)]
    values = np.linalg.eigvalsh((S + S.T) / 2)
    return negative is None or negative + int((values < 0).sum()) == equations.numbers.constraints

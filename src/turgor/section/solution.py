"""Solution of a section: the strains of the rod, the forces and the sizes along a path, as a `Response`."""

from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from turgor.errors import NotSolved, TurgorError
from turgor.response import Column, Response
from turgor.section.equations import Equations
from turgor.section.path import Path, Point
from turgor.section.stiffness import FORCE_NAMES, STRAIN_NAMES, SectionStiffness, forces_of, scales, stiffness_of
from turgor.shown import Shown
from turgor.source import Source

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
        ``largest_stretch`` is the largest principal stretch of the rubber.
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


def solution_of(equations: Equations, path: Path, outcome: tuple[str, str], source: Source) -> SectionSolution:
    """Read the columns of a path.

    Parameters
    ----------
    equations : Equations
    path : Path
    outcome : (status, message)
    source : Source
    """
    columns = _pressures(equations, path.points)
    strains = np.array([p.unknowns.strains for p in path.points]).reshape(-1, 4) * scales(equations)[1]
    columns.append(Column("curvature", "1/m", np.hypot(strains[:, 2], strains[:, 3])))
    for name in ("curvature_y", "curvature_z", "twist", "stretch"):
        i = STRAIN_NAMES.index(name)
        columns.append(Column(name, "1/m" if i else "", strains[:, i]))
    columns += _sizes(equations, path.points)
    forces = np.array([forces_of(equations, p) for p in path.points]).reshape(-1, 4)
    columns += [Column(name, "N" if i == 0 else "Nm", forces[:, i]) for i, name in enumerate(FORCE_NAMES)]
    stretched = [equations.rubber.largest_stretch(p.unknowns.y, p.unknowns.strains) for p in path.points]
    columns.append(Column("largest_stretch", "", np.array(stretched)))
    return SectionSolution(
        response=Response(columns=tuple(columns), source=source, status=outcome[0], message=outcome[1]),
        stable=tuple(_is_stable(equations, p) for p in path.points),
        _equations=equations,
        _points=path.points,
    )


def _pressures(equations: Equations, points: tuple[Point, ...]) -> list[Column]:
    """One column if all cavities have the same pressure."""
    names = list(equations.cavities)
    table = np.array([p.unknowns.pressures for p in points]).reshape(len(points), len(names)) * equations.stress
    if not names:
        return []
    if (table == table[:, :1]).all():
        return [Column("pressure", "kPa", table[:, 0])]
    return [Column(f"{name}_pressure", "kPa", values) for name, values in zip(names, table.T, strict=True)]


def _sizes(equations: Equations, points: tuple[Point, ...]) -> list[Column]:
    """Volume of the cavities for each reference length, and how far cavities and outside balloon."""
    rest, columns = equations.rest, []
    area = equations.copies * equations.plane.length**2

    def enclosed(loops: list, at: Point | None) -> float:
        state = rest if at is None else at.unknowns
        return float(sum(loop.volume(state.y, state.strains) for loop in loops))

    loops = list(equations.cavities.values())
    if loops:
        volumes = np.array([enclosed(loops, p) for p in points])
        columns.append(Column("cavity_volume_per_length", "mm2", volumes * area))
    for name, chosen in (("cavity", loops), ("outside", [equations.outside])):
        if chosen:
            first = enclosed(chosen, None)
            ratio = [sqrt(max(enclosed(chosen, p) / p.unknowns.strains[0] / first, 0.0)) for p in points]
            columns.append(Column(f"{name}_ballooning", "", np.array(ratio)))
    return columns


def _is_stable(equations: Equations, point: Point) -> bool:
    """Whether the tangent has as many negative pivots as constraints; strains that are held count as constraints."""
    S, _, _ = equations.condensed(point.equations)
    negative = equations.solver.negative_pivots(equations.numbers.constraints)
    kept = np.setdiff1d(np.arange(len(S)), equations.numbers.strains[~np.isnan(point.question.held)])
    S = S[np.ix_(kept, kept)]
    values = np.linalg.eigvalsh((S + S.T) / 2)
    return negative is None or negative + int((values < 0).sum()) == equations.numbers.constraints

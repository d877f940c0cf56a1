"""Path: a section followed through pressures, forces and prescribed strains, with steps that grow and cut back."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.solvers.newton.iteration import CONVERGED, Stopped, iterate
from turgor.fast_models.rod.settings import AT_LOAD, PATH
from turgor.fast_models.section.equations import Equations, Linearized, Question, Unknowns

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SectionPathSettings:
    """How the path of a section is followed; all are without unit.

    Parameters
    ----------
    tolerance : float
        Scaled residual that is small enough.
    iterations, good_iterations : int
        Updates of Newton's method before a step is cut, as many as for rods, and how many a good step takes.
    shortest : float
        Shortest step, as a share of the way between two points of the path, as for rods.
    growth : float
        How steps grow. They shrink by its square.
    """

    tolerance: float = 1e-8
    iterations: int = AT_LOAD.iterations
    good_iterations: int = 8
    shortest: float = PATH.shortest
    growth: float = 2.0


SETTINGS = SectionPathSettings()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Point:
    """A state of equilibrium on a path.

    Parameters
    ----------
    question : Question
    unknowns : Unknowns
    equations : Linearized
        At that state.
    iterations : int
        Of Newton's method.
    """

    question: Question
    unknowns: Unknowns
    equations: Linearized
    iterations: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Path:
    """Points at the requested places, as far as the path goes.

    Parameters
    ----------
    points : tuple of Point
    reached : float
        Where it ended: 2.5 is halfway between the requested points 2 and 3, counted from 0.
    """

    points: tuple[Point, ...]
    reached: float


def follow(equations: Equations, questions: Sequence[Question], settings: SectionPathSettings = SETTINGS) -> Path:
    """Take a section from rest through the requested points, in order."""
    free = np.isnan(questions[0].volumes)
    start = Question(
        pressures=np.zeros_like(questions[0].pressures),
        volumes=np.where(free, np.nan, equations.volumes(equations.rest)),
        strains=np.where(np.isnan(questions[0].strains), np.nan, [1.0, 0.0, 0.0, 0.0]),
        forces=np.zeros(4),
    )
    points: list[Point] = []
    known: list[tuple[float, Unknowns]] = [(0.0, equations.rest)]
    step, at = 1.0, 0.0
    for number, question in enumerate(questions):
        point, at = None, 0.0
        while at < 1.0:
            to = min(1.0, at + step)
            target = start.towards(question, to) if to < 1.0 else question
            point = newton(equations, predicted(known, number + to), target, settings)
            if point is None:
                step = (to - at) / settings.growth**2
                if step < settings.shortest:
                    return Path(points=tuple(points), reached=number + at)
                continue
            if point.iterations <= settings.good_iterations:
                step = max(step, min(1.0, settings.growth * (to - at)))
            known, at = [*known[-2:], (number + to, point.unknowns)], to
        assert point is not None
        points.append(point)
        start = question
    return Path(points=tuple(points), reached=float(len(questions)))


def predicted(known: Sequence[tuple[float, Unknowns]], to: float) -> Unknowns:
    """Extrapolate the path along the parabola through its last three states."""
    (b, last) = known[-1]
    if len(known) == 1:
        return last
    (a, before) = known[-2]
    straight = before.towards(last, (to - a) / (b - a))
    if len(known) == 2:
        return straight
    (c, first) = known[-3]
    curved = first.towards(before, (to - c) / (a - c))
    return curved.towards(straight, (to - c) / (b - c))


@dataclass(frozen=True, slots=True, eq=False)
class _Iterate:
    """Unknowns, and the equations there."""

    unknowns: Unknowns
    equations: Linearized


@dataclass(frozen=True, slots=True, eq=False)
class _AtPoint:
    """The case of Newton's method for a section at a point of its path."""

    equations: Equations
    question: Question
    settings: SectionPathSettings

    @property
    def largest(self) -> float:
        """Largest update of a position that may come from a good start: the size of the section."""
        return float(np.ptp(self.equations.plane.points, axis=0).max())

    def evaluated(self, unknowns: Unknowns) -> _Iterate:
        """The equations at unknowns."""
        equations = self.equations.linearized(unknowns, self.question)
        if equations is None or not np.isfinite(equations.residual).all():
            raise Stopped("not finite")
        return _Iterate(unknowns, equations)

    def update(self, at: _Iterate) -> Unknowns:
        """The unknowns after an update."""
        try:
            new = self.equations.update(at.unknowns, at.equations, self.question.strains)
        except (SingularTangentError, np.linalg.LinAlgError):
            raise Stopped("singular") from None
        if not np.abs(new.y - at.unknowns.y).max() < self.largest:
            raise Stopped("too large")
        return new

    def advanced(self, at: _Iterate, update: Unknowns) -> _Iterate:
        """The whole update is taken."""
        return self.evaluated(update)

    def ended(self, at: _Iterate, iteration: int) -> str | None:
        """Converged once forces, volumes and prescribed strains are met."""
        prescribed = self.question.strains
        missed = np.abs(at.unknowns.strains - prescribed)[~np.isnan(prescribed)].max(initial=0.0)
        missed = max(missed, np.abs(at.equations.missed).max(initial=0.0))
        error = max(missed, self.equations.size_of(at.equations, prescribed))
        return CONVERGED if error < self.settings.tolerance else None


def newton(
    equations: Equations, start: Unknowns, question: Question, settings: SectionPathSettings = SETTINGS
) -> Point | None:
    """Solve the equations at a point; None where Newton's method does not converge."""
    given = np.where(np.isnan(question.volumes), question.pressures, start.pressures)
    case = _AtPoint(equations, question, settings)
    try:
        first = case.evaluated(replace(start, pressures=given))
    except Stopped:
        return None
    end = iterate(case, first, settings.iterations)
    if not end.converged:
        return None
    return Point(question=question, unknowns=end.at.unknowns, equations=end.at.equations, iterations=end.iterations)

"""Functions of cheap formulas, and studies of them, for the tests of surrogates and sensitivities."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.stats import qmc

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.study import Row, Study
from turgor.units import kPa, mm

WALL = Factor(name="wall", low=1 * mm, high=2 * mm, unit="mm")
C10 = Factor(name="C10", low=50 * kPa, high=100 * kPa, unit="kPa")
FIRST = Factor(name="first", low=0.0, high=40 * kPa, unit="kPa")
SECOND = Factor(name="second", low=0.0, high=40 * kPa, unit="kPa")


def finger(wall: float, C10: float, top: float = 50 * kPa) -> Response:
    """A finger that bends with p/C10, less with a thicker wall, along its path; fails where the wall is very thin."""
    if wall < 0.9 * mm:
        raise TurgorError(f"wall is {1e3 * wall:g} mm; allowed is 0.9 mm or more.")
    pressure = np.linspace(0.0, top, 11)
    angle = np.arctan(pressure / C10 * (1.5 * mm / wall) ** 1.2)
    columns = (
        Column("load_factor", "", pressure / top),
        Column("pressure", "kPa", pressure),
        Column("bending_angle", "deg", angle),
        Column("tip_displacement_z", "mm", -60 * mm * (1 - np.cos(angle))),
    )
    return Response(columns=columns, source=Source(text="an arc"), status="converged")


#: Rubbers by name, of which one is chosen.
RUBBERS = {"soft": 50 * kPa, "firm": 75 * kPa, "stiff": 120 * kPa}
RUBBER = Factor(name="rubber", levels=tuple(RUBBERS))


def finger_of(wall: float, rubber: str) -> Response:
    """The finger of one of the rubbers."""
    return finger(wall, RUBBERS[rubber])


def two_chambers(first: float, second: float, third: float = 0.0) -> Response:
    """Tip of an arc that two pressures (and a third, which helps the first) bend in two planes."""
    across, up = 2e-5 * (first + 0.5 * third), 2e-5 * (second - 0.1 * third)
    columns = (Column("tip_y", "mm", [80 * mm * np.sin(across)]), Column("tip_z", "mm", [80 * mm * np.sin(up)]))
    return Response(columns=columns, source=Source(text="an arc"))


def study_of(
    function: Callable[..., Response] | Computation,
    factors: Sequence[Factor],
    count: int = 0,
    designs: Sequence[dict[str, float]] = (),
) -> Study:
    """Compute a function at Sobol points of a design space, or at designs."""
    points = qmc.Sobol(len(factors), seed=1).random(count) if count else ()
    values = [{each.name: each.at(u) for each, u in zip(factors, point, strict=True)} for point in points]
    values = values or list(designs)
    computation = function if isinstance(function, Computation) else Computation(function=function)
    ended = Evaluations().of([computation.run(each) for each in values])
    rows = tuple(Row(values=one, ended=other) for one, other in zip(values, ended, strict=True))
    return Study(factors=tuple(factors), rows=rows, source=Source(text="a test"))


class Formula:
    """A function of many points at once, as sensitivities ask for it.

    Parameters
    ----------
    function : callable
        (q, k) to (q,).
    factors : sequence of Factor
    """

    measures = ("y",)
    units: dict[str, str] = {"y": ""}  # noqa: RUF012

    def __init__(self, function: Callable[[np.ndarray], np.ndarray], factors: Sequence[Factor]) -> None:
        self.function, self.factors = function, tuple(factors)

    def means(self, points: np.ndarray) -> np.ndarray:
        """Return the function at points, (q, 1)."""
        return self.function(points)[:, None]

    def error(self, name: str) -> None:
        """Return None: it is computed."""

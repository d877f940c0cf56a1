"""Linear equations in job files: ``[supports.NAME]`` with terms."""

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any

from pydantic import Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.supports import Equation, Support
from turgor.foundation.errors import TurgorError
from turgor.job.text.lines import Key
from turgor.job.text.place_table import PLACES, PlaceTable, lacks_faces
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Says, Table, read_table


class TermTable(PlaceTable):
    """A term of ``[supports.NAME]`` with terms: factor times displacement of nodes along a direction.

    Keys
    ----
    place : str
        A face or a node set; one of ``edge``, ``near``, ``box`` and ``node_set`` otherwise.
    direction : str or list of floats
        One of x, y and z, or three numbers, whose length is another factor.
    factor : float
        Factor of the displacement.
    """

    place: str | None = Field(default=None, examples=['"tip"'])
    direction: Annotated[str | list[float], Says("text or three numbers", '"x"')]
    factor: float = 1.0


class EquationTable(Table):
    """``[supports.NAME]`` with terms: a linear equation between displacements, whose terms add up to zero.

    There is one equation for each node of the first place. A place with one node has the same node in all of them; one
    with as many nodes is a copy of the first somewhere else, node by node. NAME is any name.

    Keys
    ----
    terms : list of tables
        At least two, such as the ends of a lever.
    """

    terms: list[TermTable] = Field(
        examples=['[{ place = "tip", direction = "x" }, { near = [0, 0, 0], direction = "x", factor = -0.5 }]']
    )


def read_equation(
    name: str, stated: Mapping[str, Any], geometry: Geometry | None, problems: Problems
) -> Support | None:
    """Read a linear equation between displacements."""
    key = ("supports", name)
    table: EquationTable | None = read_table(EquationTable, stated, key, problems)
    if table is None:
        return None
    terms = []
    for number, term in enumerate(table.terms):
        given = problems.attempt((*key, "terms"), partial(_term, f"{name}_{number + 1}", term, key, geometry, problems))
        if given is None:
            return None
        terms.append(given)
    return problems.attempt((*key, "terms"), partial(Equation, name, terms))


def _term(name: str, term: TermTable, key: Key, geometry: Geometry | None, problems: Problems) -> Any:
    stated = [each for each in PLACES if getattr(term, each) is not None]
    if bool(stated) == (term.place is not None):
        listed = ", ".join(["place"] * (term.place is not None) + stated) or "none"
        raise TurgorError(f"a term needs one of place, {', '.join(PLACES)}; it has {listed}.")
    face = term.face_of(term.place or name, geometry)
    return None if lacks_faces(face, (*key, "terms"), geometry, problems) else (face, term.direction, term.factor)

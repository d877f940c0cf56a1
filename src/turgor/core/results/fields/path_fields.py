"""Fields along a path: each state is evaluated once for measures, files, pictures and the viewer."""

from collections.abc import Callable, Hashable, Iterator
from typing import Any, TypeVar

from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.solvers.solution import Solution

Value = TypeVar("Value")

#: Nodes of all states whose fields are saved: 11 numbers each, so 180 MB at most.
MOST_CACHED = 2_000_000


class PathFields:
    """Fields of the states of a path, which several readers go through one after another.

    The fields at the nodes of a state are saved when a reader leaves it; those at the quadrature points, which are the
    largest by far, are not.

    Parameters
    ----------
    solution : Solution
    facts : MeshFacts, optional
        What states of the same mesh share; made here if it is not given.
    most : int
        Nodes of all states whose fields are saved; the other states are evaluated again by each reader. 0 keeps none,
        which is best where there is one reader.
    """

    def __init__(self, solution: Solution, facts: MeshFacts | None = None, most: int = MOST_CACHED) -> None:
        self.solution = solution
        self.facts = facts or MeshFacts(solution.model.mesh)
        self._room = most // len(solution.model.mesh.points)
        self._cached: dict[int, StateFields] = {}
        self._made: dict[Hashable, Any] = {}

    def once(self, key: Hashable, make: Callable[[], Value]) -> Value:
        """Return what was made of this path under a key, which is made when it is first requested."""
        if key not in self._made:
            self._made[key] = make()
        value: Value = self._made[key]
        return value

    def grown(self, solution: Solution) -> "PathFields":
        """The fields of a path that has grown; those that are saved of its states stay."""
        if solution.model.mesh is not self.facts.mesh:
            return PathFields(solution)
        out = PathFields(solution, self.facts)
        pairs = zip(self.solution.states, solution.states, strict=False)
        out._cached = {row: self._cached[row] for row, (a, b) in enumerate(pairs) if a is b and row in self._cached}
        return out

    def at(self, row: int) -> StateFields:
        """Return the fields of a state of the path by its number, which may be negative."""
        row %= len(self.solution.states)
        return self._cached.get(row) or StateFields(self.solution.states[row], self.facts)

    def leave(self, row: int, fields: StateFields) -> None:
        """Keep the fields of a state for the next reader, where there is room."""
        if row not in self._cached and len(self._cached) < self._room:
            fields.settle()
            self._cached[row] = fields

    def __iter__(self) -> Iterator[StateFields]:
        for row in range(len(self.solution.states)):
            fields = self.at(row)
            yield fields
            self.leave(row, fields)

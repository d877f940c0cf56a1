"""Equation: displacements of nodes whose weighted sum is zero, such as the ends of a lever or of a periodic cell."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias, cast

import numpy as np

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.loads.load import Deck
from turgor.core.model.places import NodesAt, checked_face, name_of
from turgor.core.model.supports.support import Array, Ints, Support
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import Quantities, name, number, shown, vector
from turgor.foundation.round_off import ROUND_OFF

#: Place, direction and factor of a term.
Term: TypeAlias = tuple[str | NodesAt, tuple[float, float, float], float]
Given: TypeAlias = tuple[str | NodesAt, str | Quantities, float]


@dataclass(frozen=True, slots=True)
class Equation(Support):
    """Tie displacements to each other: the sum of factor times displacement along a direction is zero.

    There is one equation for each node of the first place. A place with one node has the same node in all of them. A
    place with as many nodes as the first one is its copy somewhere else: the nodes at the same position relative to the
    middle of their place belong together, as on opposite faces of a periodic cell. The equations are linear also
    where displacements are large: directions do not turn.

    Parameters
    ----------
    name : str
        By which reports and job files call it.
    terms : sequence of tuples
        Place, direction and factor of each, at least two. The place is a face, a node set of the mesh file or a
        `NodesAt`; the direction ``"x"``, ``"y"``, ``"z"`` or three numbers, whose length is another factor.

    Raises
    ------
    TurgorError
        If a term has another form, or the nodes of two places do not match.

    Examples
    --------
    >>> Equation("lever", [("left", "z", 1), ("right", "z", 0.5)]).text()
    'lever: 1 left·(0, 0, 1) + 0.5 right·(0, 0, 1) = 0.'
    """

    name: str
    terms: tuple[Term, ...]

    jumps = False

    if TYPE_CHECKING:

        def __init__(self, name: str, terms: Sequence[Given]) -> None: ...

    def __post_init__(self) -> None:
        what = f"equation '{name(self.name, 'name of an equation', 'lever')}'"
        given: object = self.terms
        if isinstance(given, str) or not isinstance(given, Sequence) or len(given) < 2:
            raise TurgorError(f"{what}: terms is {shown(given)}; two or more (place, direction, factor) are needed.")
        object.__setattr__(self, "terms", tuple(_term(each, what) for each in given))

    @property
    def place(self) -> str:
        """Its name."""
        return self.name

    @property
    def named_faces(self) -> tuple[str, ...]:
        """None that must be a face: a node set will do."""
        return ()

    def text(self) -> str:
        """Return the sentence of a report."""
        said = [
            f"{factor:g} {name_of(face)}·({', '.join(f'{part:g}' for part in along)})"
            for face, along, factor in self.terms
        ]
        return f"{self.name}: {' + '.join(said)} = 0."

    def check(self, mesh: Mesh) -> None:
        """Refuse parts of a body of revolution and sectors, and places that do not match."""
        if mesh.revolved or mesh.wedge is not None:
            raise TurgorError(
                f"equation '{self.name}': a part of a body of revolution or a sector cannot have one; model the whole "
                'part (symmetry = "none").'
            )
        self.equations(mesh)

    def nodes(self, mesh: Mesh) -> Ints:
        """Return the nodes of all places."""
        return np.unique(self.equations(mesh)[0])

    def equations(self, mesh: Mesh) -> tuple[Ints, Array]:
        """Return the nodes of each equation and the vectors of its terms."""
        places = [_nodes(mesh, face, self.name) for face, _, _ in self.terms]
        first = places[0]
        columns = [first]
        for (face, _, _), nodes in zip(self.terms[1:], places[1:], strict=True):
            if len(nodes) not in (1, len(first)):
                raise TurgorError(
                    f"equation '{self.name}': '{name_of(face)}' has {len(nodes)} nodes, and "
                    f"'{name_of(self.terms[0][0])}' {len(first)}; 1 or as many are needed."
                )
            columns.append(np.repeat(nodes, len(first)) if len(nodes) == 1 else self._paired(mesh, first, nodes))
        vectors = np.array([factor * np.array(along) for _, along, factor in self.terms])
        return np.stack(columns, axis=1), np.broadcast_to(vectors, (len(first), *vectors.shape))

    def _paired(self, mesh: Mesh, first: Ints, nodes: Ints) -> Ints:
        """The node of another place for each node of the first one."""
        paired, away = matched(mesh.points[first], mesh.points[nodes])
        size = float(np.ptp(mesh.points, axis=0).max())
        if away > ROUND_OFF.mesh_digits * size or len(np.unique(paired)) < len(nodes):
            raise TurgorError(
                f"equation '{self.name}': the nodes of its places do not lie alike, one is off by {away / size:.2g} "
                "of the size of the part; mesh both faces alike, or name single nodes."
            )
        return np.asarray(nodes[paired])

    def boundary_rows(self, deck: Deck) -> tuple[str, ...]:
        """No row: it is an equation in the file."""
        return ()

    def job_text(self) -> dict[str, object]:
        """Return the table with its terms."""
        rows: list[dict[str, object]] = []
        for face, along, factor in self.terms:
            stated: dict[str, object] = {"place": face} if isinstance(face, str) else face.table()
            letter = {(1.0, 0.0, 0.0): "x", (0.0, 1.0, 0.0): "y", (0.0, 0.0, 1.0): "z"}.get(along)
            rows.append(stated | {"direction": letter or list(along), "factor": factor})
        return {"terms": rows}


def matched(first: Array, other: Array) -> tuple[Ints, float]:
    """Return which of other points belongs to each of the first ones, and how far the worst pair is off.

    Parameters
    ----------
    first, other : (n, 3) array
        Points, which belong together where they lie alike relative to the middle of their box.
    """
    from scipy.spatial import cKDTree  # a run without equations does not need it

    there = [points - 0.5 * (points.min(axis=0) + points.max(axis=0)) for points in (first, other)]
    away, paired = cKDTree(there[1]).query(there[0])
    return np.asarray(paired, dtype=np.int64), float(away.max())


def _term(given: object, what: str) -> Term:
    if isinstance(given, str) or not isinstance(given, Sequence) or len(given) != 3:
        raise TurgorError(f"{what}: the term {shown(given)} is no (place, direction, factor), such as ('tip', 'x', 1).")
    face, along, factor = given
    where = f"{what}: term of '{checked_face(face, f'{what}: place', 'tip')}'"
    if isinstance(along, str) and along not in ("x", "y", "z"):
        raise TurgorError(f"{where}: direction is {along!r}; 'x', 'y', 'z' or three numbers are needed.")
    parts = tuple(float(letter == along) for letter in "xyz") if isinstance(along, str) else vector(along, where)
    if not np.linalg.norm(parts) > 0:
        raise TurgorError(f"{where}: direction is a zero vector; give for example (1, 0, 0).")
    return face, cast("tuple[float, float, float]", parts), number(factor, f"{where}: factor")


def _nodes(mesh: Mesh, face: str | NodesAt, equation: str) -> Ints:
    if isinstance(face, NodesAt):
        return face.nodes(mesh)
    if face in mesh.node_sets:  # first: a face of the same name has those of its nodes that make whole sides
        return np.asarray(mesh.node_sets[face], dtype=np.int64)
    if face in mesh.faces:
        return mesh.face_nodes(face)
    raise unknown(f"place of the equation '{equation}'", face, (*mesh.faces, *mesh.node_sets))

"""Center line: where the cross-sections of an actuator are in a state, and how they turn from one to the next.

Between neighboring sections the motion of the section is a screw motion, so an actuator bent to an arc or wound to a
helix is followed exactly. What its angular velocity w and its velocity v are, seen from the section, gives curvature,
torsion, radius and pitch (Frenet).
"""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.results.measures.shape.screws import screw_between
from turgor.core.results.measures.shape.sections import Pieces, pieces_of, sections_of
from turgor.core.results.measures.shape.settings import SHAPE
from turgor.core.solvers.solution import State
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CenterLine:
    """Line through the centers of the cross-sections of an actuator along x, from the base to the tip.

    Parameters
    ----------
    rest : (p, 3) array [m]
        Centers of the sections at rest.
    position : (p, 3) array [m]
        Where the centers are now.
    rotation : (p, 3, 3) array
        Rotations of the sections.
    turns : (p - 1, 3) array [rad]
        Rotation from each section to the next, as axis times angle seen from the section.
    ways : (p - 1, 3) array [m]
        Way from each section to the next, along the screw motion and seen from the section.
    source : Source
        What was measured.
    """

    rest: Array
    position: Array
    rotation: Array
    turns: Array
    ways: Array
    source: Source

    __repr__ = brief

    @property
    def steps(self) -> Array:
        """Current length of the line between neighboring sections, (p - 1,) [m]."""
        return np.asarray(np.linalg.norm(self.ways, axis=1))

    @property
    def length(self) -> float:
        """Current length of the line, from the first section to the last [m]."""
        return float(self.steps.sum())

    @property
    def arc_length(self) -> Array:
        """Current arc length from the first section to the middle between neighboring ones, (p - 1,) [m]."""
        return np.asarray(np.cumsum(self.steps) - self.steps / 2)

    @property
    def curvature(self) -> Array:
        """Curvature of the line between neighboring sections, (p - 1,) [1/m], not negative."""
        return np.asarray(np.linalg.norm(np.cross(self.turns, self.ways), axis=1) / self.steps**2)

    @property
    def torsion(self) -> Array:
        """Turn of the sections about the line for each length of it, (p - 1,) [1/m], positive counterclockwise."""
        return np.asarray(np.einsum("ki,ki->k", self.turns, self.ways) / self.steps**2)

    @property
    def stretch(self) -> Array:
        """Current length over length at rest between neighboring sections, (p - 1,)."""
        return np.asarray(self.steps / np.linalg.norm(np.diff(self.rest, axis=0), axis=1))

    @property
    def mean(self) -> tuple[Array, Array]:
        """Rotation vector (3,) [rad] and way (3,) [m] of all pieces together, seen from the section."""
        return self.turns.sum(axis=0), self.ways.sum(axis=0)

    def response(self) -> Response:
        """Return curvature, torsion and stretch over the arc length, as columns."""
        return Response(
            columns=(
                Column("arc_length", "mm", self.arc_length),
                Column("curvature", "1/m", self.curvature),
                Column("torsion", "1/m", self.torsion),
                Column("stretch", "", self.stretch),
            ),
            source=self.source,
        )


def center_line(state: State | StateFields) -> CenterLine:
    """Find the center line of an actuator along x in a state, and how it bends along its length.

    The actuator is divided along x into at most 16 pieces. The center and the rotation of a piece are those of the map
    that is nearest to its displacement, weighted by volume; a half is mirrored. So chambers and walls count, with the
    gaps between them left out.

    Parameters
    ----------
    state : State or StateFields

    Returns
    -------
    CenterLine

    Raises
    ------
    TurgorError
        If the mesh has too few cells along x.

    Examples
    --------
    >>> import turgor as tg
    >>> def profile(state):
    ...     return tg.measures.center_line(state).response().plot("curvature", x="arc_length")
    """
    at = state if isinstance(state, StateFields) else StateFields(state)
    return at.once("center line", partial(_center_line_of, at))


def _center_line_of(at: StateFields) -> CenterLine:
    pieces = at.facts.once("center line", partial(_pieces, at.facts))
    rotations, centers, rest = sections_of(at, pieces)
    motions = [
        screw_between(a.T @ b, a.T @ (there - here))
        for a, b, here, there in zip(rotations[:-1], rotations[1:], centers[:-1], centers[1:], strict=True)
    ]
    return CenterLine(
        rest=rest,
        position=centers,
        rotation=rotations,
        turns=np.array([turn for turn, _ in motions]),
        ways=np.array([way for _, way in motions]),
        source=Source(text="finite elements", detail=at.mesh.name),
    )


def _pieces(facts: MeshFacts) -> Pieces:
    points = facts.mesh.points
    cells = float(np.ptp(points[:, 0]) / np.ptp(points[facts.mesh.cells, 0], axis=1).mean())
    fewest = SHAPE.center_line_pieces[-1]
    for count in SHAPE.center_line_pieces:
        # within a cell the sections say nothing of their own
        pieces = pieces_of(facts, 0.0, 1.0, count) if count <= cells or count == fewest else None
        if pieces is not None:
            return pieces
    raise TurgorError(
        f"the mesh has too few cells along x for a center line: {fewest} pieces of the length do not hold enough "
        "of them; take a finer mesh. The actuator must lie along x."
    )

"""Places in job files: where a support or a force acts that is no whole face."""

from pydantic import Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.places import NodesAt
from turgor.foundation.errors import unknown
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Coordinate, Table

#: Keys that say where the nodes are.
PLACES = ("edge", "near", "box")


class PlaceTable(Table):
    """Where a support or a force acts: one of ``edge``, ``near`` and ``box``, or the face with the name of the table.

    Keys
    ----
    edge : list of str
        Two faces: the nodes that both have.
    near : (3,) lengths
        The node nearest to this point.
    box : two points
        All nodes within the box between two corners.
    """

    edge: list[str] | None = Field(default=None, examples=['["fixed", "outside"]'])
    near: list[Coordinate] | None = Field(default=None, examples=['[0, 0, "5 mm"]'])
    box: list[list[Coordinate]] | None = Field(default=None, examples=['[[0, 0, 0], ["10 mm", "10 mm", "2 mm"]]'])

    def face_of(self, name: str) -> str | NodesAt:
        """Return the place that the keys state, else the name, which is that of a face."""
        if self.edge is None and self.near is None and self.box is None:
            return name
        edge, box = (None if each is None else tuple(each) for each in (self.edge, self.box))
        return NodesAt(name, edge=edge, near=self.near, box=box)  # type: ignore[arg-type]


def lacks_faces(face: str | NodesAt, key: Key, geometry: Geometry | None, problems: Problems) -> bool:
    """Report faces that the actuator lacks; return whether there are any.

    Parameters
    ----------
    face : str or NodesAt
    key : tuple of str
        Where it stands.
    geometry : Geometry or None
        The actuator; None where it could not be built.
    problems : Problems
        Takes what is wrong.
    """
    if geometry is None:
        return False
    named, where = ((face,), key) if isinstance(face, str) else (face.edge or (), (*key, "edge"))
    wrong = [each for each in named if each not in geometry.faces]
    for each in wrong:
        problems.add(where, str(unknown("face", each, geometry.faces)))
    return bool(wrong)

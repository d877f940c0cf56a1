"""Places in job files: where a support or a force acts that is no whole face."""

from pydantic import Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.places import PLACES as PLACES
from turgor.core.model.places import NodesAt
from turgor.foundation.errors import unknown
from turgor.job.text.body_names import unknown_part
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Coordinate, Table


class PlaceTable(Table):
    """Where a support or a force acts: one of the keys, or the face or node set with the name of the table.

    Keys
    ----
    edge : list of str
        Two faces: the nodes that both have.
    near : (3,) lengths
        The node nearest to this point.
    box : two points
        All nodes within the box between two corners.
    node_set : str
        The nodes of a set of the mesh file.
    """

    edge: list[str] | None = Field(default=None, examples=['["fixed", "outside"]'])
    near: list[Coordinate] | None = Field(default=None, examples=['[0, 0, "5 mm"]'])
    box: list[list[Coordinate]] | None = Field(default=None, examples=['[[0, 0, 0], ["10 mm", "10 mm", "2 mm"]]'])
    node_set: str | None = Field(default=None, examples=['"rim"'])

    def face_of(self, name: str, geometry: Geometry | None) -> str | NodesAt:
        """Return the place that the keys state, else that of the name: a face or a node set."""
        if all(getattr(self, key) is None for key in PLACES):
            return face_or_set(name, geometry)
        edge, box = (None if each is None else tuple(each) for each in (self.edge, self.box))
        return NodesAt(name, edge=edge, near=self.near, box=box, node_set=self.node_set)  # type: ignore[arg-type]


def face_or_set(name: str, geometry: Geometry | None) -> str | NodesAt:
    """Return a name, or the place where it is that of a node set of a mesh file."""
    is_set = geometry is not None and name in geometry.node_sets and name not in geometry.faces
    return NodesAt(name, node_set=name) if is_set else name


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
    if isinstance(face, str):
        wrong, where, known = [face], key, (*geometry.faces, *geometry.node_sets)
    elif face.node_set is not None:
        wrong, where, known = [face.node_set], (*key, "node_set"), geometry.node_sets
    else:
        wrong, where, known = list(face.edge or ()), (*key, "edge"), geometry.faces
    wrong = [each for each in wrong if each not in known]
    for each in wrong:
        whole = isinstance(face, str)
        kind = "node set" if where[-1] == "node_set" else "face"
        problems.add(where, str(unknown_part(kind, each, known, geometry) if whole else unknown(kind, each, known)))
    return bool(wrong)

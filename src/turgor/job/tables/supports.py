"""Supports of a job file: for each face or place the directions in which it is fixed, its move, or that it stays plane.

A file in `turgor.core.model.supports` whose class states ``job_texts`` is all that a new one needs.
"""

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any

from pydantic import Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.supports import Displacement, Fixed, NodesAt, Shift, Support
from turgor.foundation.errors import unknown
from turgor.foundation.registry import Registry, class_of_file
from turgor.job.tables.obstacles import Lengths
from turgor.job.text.lines import Key
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Coordinate, Table, read_table, shown


class SupportTable(Table):
    """``[supports.NAME]``: a face that is moved; or an edge, a node or the nodes in a box that are fixed or moved.

    One of ``edge``, ``near`` and ``box`` says where the nodes are, and NAME is any name. Without them it is that of a
    face.

    Keys
    ----
    displacement : list of lengths
        Where it is at the end, relative to where it was, in proportion to the load factor.
    directions : str
        Directions in which it is fixed or moved; it is free in the others.
    edge : list of str
        Two faces: the nodes that both have.
    near : (3,) lengths
        The node nearest to this point.
    box : two points
        All nodes within the box between two corners.
    """

    displacement: Lengths | None = Field(default=None, examples=['[0, 0, "5 mm"]'])
    directions: str = "xyz"
    edge: list[str] | None = Field(default=None, examples=['["fixed", "outside"]'])
    near: list[Coordinate] | None = Field(default=None, examples=['[0, 0, "5 mm"]'])
    box: list[list[Coordinate]] | None = Field(default=None, examples=['[[0, 0, 0], ["10 mm", "10 mm", "2 mm"]]'])

    def face_of(self, name: str) -> str | NodesAt:
        """Return the place that the keys state, else the name, which is that of a face."""
        if self.edge is None and self.near is None and self.box is None:
            return name
        edge, box = (None if each is None else tuple(each) for each in (self.edge, self.box))
        return NodesAt(name, edge=edge, near=self.near, box=box)  # type: ignore[arg-type]


#: Keys that say where the nodes of a support are.
PLACES = ("edge", "near", "box")

#: Supports by the name of their file: the classes in their folder.
SUPPORTS: Registry[type[Support]] = Registry(
    "turgor.core.model.supports", class_of_file(lambda kind: issubclass(kind, Support) and kind is not Support)
)


def stated_supports() -> dict[str, Callable[[str], Support]]:
    """Return what makes the support of a face by the text that states it.

    Examples
    --------
    >>> stated_supports()["radial about y"]("outside")
    Radial(face='outside', axis=(0.0, 1.0, 0.0))
    """
    kinds: list[Any] = list(SUPPORTS.values())
    return {text: partial(kind, **values) for kind in kinds for text, values in kind.job_texts.items()}


def read_supports(values: Any, geometry: Geometry | None, problems: Problems) -> tuple[Support, ...]:
    """Read ``[supports]``: for each face the directions in which it is fixed, ``"radial"``, or a table of its move."""
    if not isinstance(values, Mapping):
        problems.add(("supports",), f"{shown(values)} is not a table; write [supports] and faces below it.")
        return ()
    supports: list[Support] = []
    by_text = stated_supports()
    for face, stated in values.items():
        key = ("supports", face)
        if isinstance(stated, Mapping):
            support = _of_table(face, stated, geometry, problems)
            supports += [] if support is None else [support]
        elif geometry is not None and face not in geometry.faces:
            problems.add(key, str(unknown("face", face, geometry.faces)))
        elif isinstance(stated, str) and stated in by_text:
            supports.append(by_text[stated](face))
        elif not isinstance(stated, str) or not stated or not set(stated) <= set("xyz"):
            allowed = ", ".join(f"'{name}'" for name in by_text)
            problems.add(
                key,
                f"{shown(stated)} is not allowed; name the fixed directions, such as 'xyz' or 'z', or one "
                f'of {allowed}, or state a move, such as {{ displacement = [0, 0, "5 mm"] }}, or an edge, such as '
                '{ edge = ["fixed", "outside"], directions = "xyz" }.',
            )
        else:
            supports.append(Fixed(face, stated))
    return tuple(supports)


def _of_table(name: str, stated: Mapping[str, Any], geometry: Geometry | None, problems: Problems) -> Support | None:
    """Read the table of a face that is moved, or of a place that is fixed or moved."""
    key = ("supports", name)
    table: SupportTable | None = read_table(SupportTable, stated, key, problems)
    face = None if table is None else problems.attempt(key, partial(table.face_of, name), fields=PLACES)
    if table is None or face is None or _unknown_faces(face, key, geometry, problems):
        return None
    if table.displacement is None:
        if isinstance(face, str):
            problems.add(key, f'displacement is missing; to hold the face, write {name} = "{table.directions}".')
            return None
        return problems.attempt(key, partial(Fixed, face, table.directions))
    moved = problems.attempt(key, partial(Displacement, face, Shift(table.displacement), table.directions))
    free = [axis for axis, part in zip("xyz", table.displacement, strict=True) if part and axis not in table.directions]
    if moved is not None and free:
        along = ", ".join(free)
        problems.add((*key, "directions"), f"it moves along {along}, but is prescribed in {table.directions} only.")
    return moved


def _unknown_faces(face: str | NodesAt, key: Key, geometry: Geometry | None, problems: Problems) -> bool:
    """Report faces that the actuator lacks; return whether there are any."""
    if geometry is None:
        return False
    named, where = ((face,), key) if isinstance(face, str) else (face.edge or (), (*key, "edge"))
    wrong = [each for each in named if each not in geometry.faces]
    for each in wrong:
        problems.add(where, str(unknown("face", each, geometry.faces)))
    return bool(wrong)


def moves_a_face(supports: object) -> bool:
    """Return whether any support of a job file moves a face, which drives the actuator where no load does."""
    entries = supports.values() if isinstance(supports, Mapping) else ()
    return any(isinstance(entry, Mapping) and "displacement" in entry for entry in entries)


def supports_table(supports: Iterable[Support]) -> dict[str, Any]:
    """Write supports as a table of a job file; `read_supports` gives the same ones back.

    Examples
    --------
    >>> supports_table([Fixed("fixed", "xz"), Displacement("tip", (0, 0, 5e-3))])
    {'fixed': 'xz', 'tip': {'displacement': ['0 mm', '0 mm', '5 mm'], 'directions': 'xyz'}}
    """
    return {each.place: each.job_text() for each in supports}

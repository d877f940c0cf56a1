"""Supports of a job file: for each face or place the directions in which it is fixed, its move, or that it stays plane.

A file in `turgor.core.model.supports` whose class states ``job_texts`` is all that a new one needs.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import Annotated, Any

import numpy as np
from pydantic import BeforeValidator, Field

from turgor.core.geometry.geometry import Geometry
from turgor.core.model.history import RAMP
from turgor.core.model.places import NodesAt
from turgor.core.model.supports import Displacement, Fixed, Foundation, Roller, Shift, Slide, Support, Tied
from turgor.foundation.registry import Registry, class_of_file
from turgor.foundation.round_off import ROUND_OFF
from turgor.job.tables.obstacles import Lengths
from turgor.job.text.body_names import by_body
from turgor.job.text.equation_table import read_equation
from turgor.job.text.lines import Key
from turgor.job.text.load_values import Points
from turgor.job.text.place_table import PLACES, PlaceTable, face_or_set, lacks_faces
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import Says, read_table, shown
from turgor.units import mm, parse_quantity

Bedding = Annotated[float, BeforeValidator(partial(parse_quantity, dimension="contact stiffness"))]


class SupportTable(PlaceTable):
    """``[supports.NAME]``: a face that is moved; or an edge, a node or the nodes in a box that are fixed or moved.

    One of ``edge``, ``near``, ``box`` and ``node_set`` says where the nodes are, and NAME is any name. Without them it
    is that of a face or of a node set.

    Keys
    ----
    displacement : list of lengths
        Where it is at the end, relative to where it was, in proportion to the load factor.
    history : list or str, optional
        Share of the displacement over the load factor: points [load factor, share] with straight lines between them,
        or an expression in s. By default it rises with the load factor.
    directions : str or list of floats
        Directions in which it is fixed or moved, some of x, y and z; it is free in the others. Or three numbers: the
        one direction in which it is fixed, or along which its displacement points.
    normal_stiffness : float [Pa/m]
        Stiffness per area of springs on which the face is bedded, along its normal.
    tangential_stiffness : float [Pa/m]
        The same across the normal.
    tied_to : str
        Face on which it lies and which its nodes follow; the cells of both may be others.
    """

    displacement: Lengths | None = Field(default=None, examples=['[0, 0, "5 mm"]'])
    history: Points = None
    directions: Annotated[str | list[float], Says("text or three numbers", '"xz"')] = "xyz"
    normal_stiffness: Bedding | None = None
    tangential_stiffness: Bedding | None = None
    tied_to: str | None = Field(default=None, examples=['"block_top"'])


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
    values, problems = by_body("supports", values, geometry, problems)
    supports: list[Support] = []
    by_text = stated_supports()
    for face, stated in values.items():
        key = ("supports", face)
        if isinstance(stated, Mapping):
            reads = read_equation if "terms" in stated else _of_table
            support = reads(face, stated, geometry, problems)
            supports += [] if support is None else [support]
        elif lacks_faces(face_or_set(face, geometry), key, geometry, problems):
            continue
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
            supports.append(Fixed(face_or_set(face, geometry), stated))
    return tuple(supports)


def _of_table(name: str, stated: Mapping[str, Any], geometry: Geometry | None, problems: Problems) -> Support | None:
    """Read the table of a face that is moved, or of a place that is fixed or moved."""
    key = ("supports", name)
    table: SupportTable | None = read_table(SupportTable, stated, key, problems)
    face = None if table is None else problems.attempt(key, partial(table.face_of, name, geometry), fields=PLACES)
    if table is None or face is None or lacks_faces(face, key, geometry, problems):
        return None
    if table.tied_to is not None:
        return _tie(face, table, geometry, key, problems)
    if table.normal_stiffness is not None or table.tangential_stiffness is not None:
        return _foundation(face, table, key, problems)
    if not isinstance(table.directions, str):
        return _along(face, table, key, problems)
    if table.displacement is None:
        if table.history is not None:
            problems.add((*key, "history"), "it is that of a displacement, which is missing.")
            return None
        if isinstance(face, str):
            problems.add(key, f'displacement is missing; to hold the face, write {name} = "{table.directions}".')
            return None
        return problems.attempt(key, partial(Fixed, face, table.directions))
    shift = problems.attempt(
        (*key, "history"), partial(Shift, table.displacement, RAMP if table.history is None else table.history)
    )
    if shift is None:
        return None
    moved = problems.attempt(key, partial(Displacement, face, shift, table.directions))
    free = [axis for axis, part in zip("xyz", table.displacement, strict=True) if part and axis not in table.directions]
    if moved is not None and free:
        along = ", ".join(free)
        problems.add((*key, "directions"), f"it moves along {along}, but is prescribed in {table.directions} only.")
    return moved


def _along(face: str | NodesAt, table: SupportTable, key: Key, problems: Problems) -> Support | None:
    """Read a support along one direction that need not be x, y or z, or a move along it."""
    directions: Any = table.directions
    if table.displacement is None:
        return problems.attempt((*key, "directions"), partial(Roller, face, directions))
    slide = problems.attempt((*key, "directions"), partial(Slide, face, directions, 0.0))
    if slide is None:
        return None
    along, moved = np.array(slide.along) / np.linalg.norm(slide.along), np.array(table.displacement)
    distance = float(along @ moved)
    if np.linalg.norm(moved - distance * along) > ROUND_OFF.mesh_digits * np.linalg.norm(moved):
        listed = ", ".join(f"{part / mm:.6g} mm" for part in distance * along)
        problems.add(
            (*key, "displacement"),
            f"it does not point along directions, across which the face is free; its part along them is ({listed}).",
        )
        return None
    return replace(slide, distance=distance)


def _tie(
    face: str | NodesAt, table: SupportTable, geometry: Geometry | None, key: Key, problems: Problems
) -> Support | None:
    """Read a face that follows another one."""
    others = sorted(table.model_fields_set - {"tied_to"})
    if not isinstance(face, str) or others or table.tied_to is None:
        problems.add(
            key, f"a tie is one of a whole face; leave out {', '.join(others)}, or state them for other faces."
        )
        return None
    if lacks_faces(table.tied_to, (*key, "tied_to"), geometry, problems):
        return None
    return problems.attempt(key, partial(Tied, face, table.tied_to))


def _foundation(face: str | NodesAt, table: SupportTable, key: Key, problems: Problems) -> Support | None:
    """Read a face on springs."""
    others = sorted(table.model_fields_set - {"normal_stiffness", "tangential_stiffness"})
    if not isinstance(face, str) or others:
        problems.add(key, f"springs bed a whole face; leave out {', '.join(others)}, or state another support besides.")
        return None
    normal, tangential = table.normal_stiffness or 0.0, table.tangential_stiffness or 0.0
    return problems.attempt(key, partial(Foundation, face, normal, tangential))


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

"""Files for ParaView of discrete threads and obstacles, besides that of the body."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.contact import contact_force, drawn_obstacles, pose_of
from turgor.core.results.fields.fibers import fiber_results
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.vtu_xml import VtuArray, numbered, simple_grid


def threads_text(at: StateFields) -> str:
    """Write the discrete threads of a state as the text of a VTU file; empty where there are none.

    Every truss is a line between current positions, thread after thread. Cell data: ``tension`` [N], averaged over the
    sides of cells around it, ``stretch`` of each truss by itself, ``winding`` and ``thread``, counted from 0.

    Parameters
    ----------
    at : StateFields
        The modeled part, not mirrored.
    """
    windings = [
        (number, each, each.threads) for number, each in enumerate(fiber_results(at)) if each.threads is not None
    ]
    if not windings:
        return ""
    ends = [threads.ends(at.points) for _, _, threads in windings]
    points = np.concatenate([pair.reshape(-1, 3) for pair in ends])
    count = len(points) // 2
    cell_data = [
        VtuArray("tension", np.concatenate([each.tension for _, each, _ in windings]).astype("f4"), "N"),
        VtuArray("stretch", np.concatenate([each.stretch for _, each, _ in windings]).astype("f4")),
        VtuArray("winding", np.concatenate([np.full(len(t.thread), n, dtype="i4") for n, _, t in windings])),
        VtuArray("thread", np.concatenate([threads.thread.astype("i4") for _, _, threads in windings])),
    ]
    return simple_grid(points, np.arange(2 * count).reshape(count, 2), cell_data)


def obstacles_text(at: StateFields, extents: Mapping[str, NDArray[np.float64]]) -> str:
    """Write the obstacles of a state, where they are then, as the text of a VTU file; empty where there are none.

    Cell data: ``obstacle``, the number that the field data ``obstacle:NAME`` give its name, and the force of the
    actuator on it, ``force`` [N].

    Parameters
    ----------
    at : StateFields
    extents : mapping of str to (2, 3) array [m]
        The room that the actuator and its faces take, see `turgor.core.results.fields.contact.extents_of`; obstacles
        without an end are cut a little beyond it.
    """
    obstacles = drawn_obstacles(at.model)
    if not obstacles:
        return ""
    points, triangles, number, force, start = [], [], [], [], 0
    for k, obstacle in enumerate(obstacles):
        here, cells = obstacle.outline(pose_of(at, obstacle), extents[obstacle.face or ""])
        points.append(here)
        triangles.append(cells + start)
        number.append(np.full(len(cells), k, dtype="i4"))
        force.append(np.tile(contact_force(at, obstacle.name), (len(cells), 1)))
        start += len(here)
    cell_data = [
        VtuArray("obstacle", np.concatenate(number)),
        VtuArray("force", np.concatenate(force).astype("f4"), "N", ("X", "Y", "Z")),
    ]
    names = numbered("obstacle", [obstacle.name for obstacle in obstacles])
    return simple_grid(np.concatenate(points), np.concatenate(triangles), cell_data, names)

"""Scene: the parts of a solution that the viewer draws, small enough for one page."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.cables import cable_results
from turgor.core.results.fields.contact import extents_of
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.views.pictures.overlays.obstacle_skin import obstacle_skin
from turgor.views.pictures.picture import caption
from turgor.views.pictures.state_picture import picture_title
from turgor.views.viewer.between import places_between
from turgor.views.viewer.curves import Measured, curves_of
from turgor.views.viewer.inside import Inside, inside_of
from turgor.views.viewer.packing import pack_index, pack_steps
from turgor.views.viewer.settings import VIEWER
from turgor.views.viewer.shown_fields import FIELDS, shown_fields
from turgor.views.viewer.surface import SIDES, Surface, surface_of

Array = NDArray[np.float64]

#: Bytes of a position, and of a vertex in a step: its position, and a value of every field.
POINT = 3 * np.dtype(np.uint16).itemsize
BYTES = POINT + 2 * sum(field.of is not None for field in FIELDS)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Content of the viewer.

    Parameters
    ----------
    values : dict
        What the page reads, as JSON.
    steps : tuple of int
        The states of the solution that it shows.
    notes : tuple of str
        What was left out.
    letters : int
        Letters of its texts without the curves: what fewer states make smaller.
    """

    values: dict[str, Any]
    steps: tuple[int, ...]
    notes: tuple[str, ...]
    letters: int


def scene_of(
    solution: Solution,
    response: Response | None = None,
    measured: Sequence[Measured] = (),
    fields: PathFields | None = None,
    most_text: int = VIEWER.page_bytes,
) -> Scene:
    """Collect what the viewer draws: surface, fields, fibers, obstacles and curves at evenly spaced states.

    Parameters
    ----------
    solution : Solution
        With one state at least.
    response : Response, optional
        Measures at every state; gives the curves and the words of each step.
    measured : sequence of Measured
        Experiments, drawn with the curves.
    fields : PathFields, optional
        Fields of the solution that others read, too.
    most_text : int
        Letters of the scene as text beyond which every second step is left out.

    Returns
    -------
    Scene

    Raises
    ------
    TurgorError
        If the solution has no state, or the response has another number of rows than states.
    """
    if not solution.states:
        raise TurgorError("the viewer needs a solution with at least one state.")
    if response is not None and len(response) != len(solution.states):
        raise TurgorError(f"the response has {len(response)} rows, but the solution {len(solution.states)} states.")
    fields = fields or PathFields(solution, most=0)
    surface = surface_of(fields.at(0))
    steps = chosen_steps(len(solution.states), len(surface.node))
    values = _values(fields, response, surface, steps)
    while (letters := _letters(values)) > most_text and len(steps) > 2:
        steps = [*steps[:-1:2], steps[-1]]
        values = _values(fields, response, surface, steps)
    values["curves"] = None if response is None else curves_of(response, steps, measured)
    values["places"], error = places_between(solution, steps)
    notes = _notes(len(solution.states), steps, surface)
    if values["places"]:
        notes += (
            f"Between its {len(steps)} states the viewer draws cubics of the load through the nearest four; with every "
            f"other state left out these are within {100 * error:.2g} % of the largest displacement.",
        )
    return Scene(values=values, steps=tuple(steps), notes=notes, letters=letters)


def _values(path: PathFields, response: Response | None, surface: Surface, steps: Sequence[int]) -> dict[str, Any]:
    """What the page reads of some states of a solution."""
    labels = [{"state": k, "label": _label(path.solution, response, k)} for k in steps]
    return {"steps": labels, **path.once(("viewer", *steps), lambda: _drawn(path, surface, steps))}


def _drawn(path: PathFields, surface: Surface, steps: Sequence[int]) -> dict[str, Any]:
    """What the page draws of some states."""
    states = [path.at(k) for k in steps]
    inside = inside_of(states[0], len(states), BYTES)
    return {
        "surface": _surface(states, surface, path.facts),
        "images": [image.matrix for image in path.facts.images],
        "fields": shown_fields(states, surface, inside),
        "inside": None if inside is None else _inside(states, inside),
        "obstacles": _obstacles(states),
        "threads": _threads(states),
    }


def _letters(value: Any) -> int:
    """Number of letters of all texts in a value of lists and dictionaries."""
    if isinstance(value, dict):
        return sum(map(_letters, value.values()))
    if isinstance(value, list | tuple):
        return sum(map(_letters, value))
    return len(value) if isinstance(value, str) else 0


def chosen_steps(count: int, vertices: int) -> list[int]:
    """Choose the states that the viewer shows: all, or evenly spaced ones with the first and the last.

    Parameters
    ----------
    count : int
        States of the solution.
    vertices : int
        Vertices of the surface, each with a position and a value of every field.

    Examples
    --------
    >>> chosen_steps(4, 1000), len(chosen_steps(500, 1000)), len(chosen_steps(500, 100_000))
    ([0, 1, 2, 3], 40, 3)
    """
    most = max(2, min(VIEWER.steps, VIEWER.part_bytes // (BYTES * vertices)))
    if count <= most:
        return list(range(count))
    return [int(k) for k in np.unique(np.rint(np.linspace(0, count - 1, most)))]


def _notes(count: int, steps: Sequence[int], surface: Surface) -> tuple[str, ...]:
    notes = []
    if len(steps) < count:
        notes.append(f"The viewer shows {len(steps)} of {count} states, to keep the page small.")
    if surface.coarse:
        notes.append("The viewer draws the sides of cells straight, to keep the page small.")
    return tuple(notes)


def _label(solution: Solution, response: Response | None, k: int) -> str:
    """Words of a step: what acts, and the bending angle where it was measured."""
    if response is not None:
        return picture_title(response, k)
    return caption(solution.states[k]).removeprefix(f"{solution.model.mesh.name} · ")


def _surface(states: Sequence[StateFields], surface: Surface, facts: MeshFacts) -> dict[str, Any]:
    return {
        "triangles": pack_index(surface.triangles),
        "sides": SIDES,
        "cut": pack_index(surface.cut),
        "centers": pack_index(surface.centers),
        "mirrors": [plane.axis for plane in facts.mirrors],
        "positions": pack_steps(np.stack([at.points[surface.node] for at in states])),
    }


def _inside(states: Sequence[StateFields], inside: Inside) -> dict[str, Any]:
    return {
        "tetrahedra": pack_index(inside.tetrahedra),
        "positions": pack_steps(np.stack([at.points[inside.node] for at in states])),
    }


def _obstacles(states: Sequence[StateFields]) -> dict[str, Any] | None:
    """Obstacles at their places in each step, with their mirror images; None where there is none."""
    extents = extents_of(states)
    skins = [skin for skin in (obstacle_skin(at, extents) for at in states) if skin is not None]
    if not skins:
        return None
    if len({skin.points.shape for skin in skins}) > 1:
        skins = [skins[-1]] * len(skins)
    return {
        "triangles": pack_index(skins[-1].triangles),
        "positions": pack_steps(np.stack([skin.points for skin in skins])),
    }


def _threads(states: Sequence[StateFields]) -> dict[str, Any] | None:
    """Threads of the modeled part in each step, and the number of points of each; None where there are none."""
    cables = _cables(states)
    lines = [[*of_cables, *_fibers(at)] for of_cables, at in zip(cables, states, strict=True)]
    if not lines[0]:
        return None
    stride = -(-sum(map(len, lines[0])) * POINT * len(states) // VIEWER.part_bytes)
    thinned = [[np.concatenate([line[:-1:stride], line[-1:]]) for line in each] for each in lines]
    return {
        "lengths": pack_index(np.array([len(line) for line in thinned[0]])),
        "positions": pack_steps(np.stack([np.concatenate(each) for each in thinned])),
    }


def _cables(states: Sequence[StateFields]) -> list[list[Array]]:
    """Cables of the modeled part in each step as lines (k, 3) [m]; a point where a stage does not have one of them."""
    steps = [{(each.name, len(each.guides)): each.guides for each in cable_results(at)} for at in states]
    every = {key: line for step in steps for key, line in step.items()}
    absent = {key: np.repeat(line[:1], len(line), axis=0) for key, line in every.items()}
    return [list((absent | step).values()) for step in steps]


def _fibers(at: StateFields) -> list[Array]:
    """Threads of the modeled part as lines (k, 3) [m]; smeared fibers that cannot be laid have none."""
    lines: list[Array] = []
    for fibers in at.model.reinforcements:
        try:
            lines += at.facts.threads(fibers).polylines(at.points)
        except TurgorError:
            continue
    return lines

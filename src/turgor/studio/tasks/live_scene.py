"""Live scene: what the viewer needs of a reduced model once, so that afterwards a few numbers draw a state."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.fields.contact import extents_of
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.fields.state_fields import MeshFacts, StateFields
from turgor.foundation.errors import NotSolved
from turgor.reduced.path import solution_of
from turgor.reduced.states.answer import ReducedState
from turgor.reduced.states.reduced import Reduced
from turgor.studio.settings import LIVE
from turgor.units import mm
from turgor.views.pictures.overlays.obstacle_skin import obstacle_skin
from turgor.views.viewer.packing import pack_index
from turgor.views.viewer.scene import scene_of
from turgor.views.viewer.surface import surface_of

Array = NDArray[np.float64]
Small = NDArray[np.float32]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LiveScene:
    """A scene of the viewer and the numbers that move it.

    Parameters
    ----------
    values : dict
        Scene of the viewer; the page puts its own positions of the surface and of obstacles into it.
    surface : (1 + r, v, 3) float32 array [m]
        Vertices at rest, and what they move by with each coordinate.
    obstacles : (1 + n, w, 3) float32 array [m]
        Vertices of obstacles where all inputs are zero, and what they move by with each input [m/SI]; w may be 0.
    frames : (k, r) float32 array
        Coordinates of the states that the picture has room for.
    """

    values: dict[str, Any]
    surface: Small
    obstacles: Small
    frames: Small


def live_scene(reduced: Reduced) -> LiveScene:
    """Prepare a reduced model for the viewer."""
    states = _answers(reduced)
    solution = solution_of(states[:1])
    values = scene_of(solution).values
    rest = PathFields(solution, most=0).at(0)
    node, r = surface_of(rest).node, reduced.equations.sizes[0]
    modes = reduced.modes.reshape(-1, 3, r)[node].astype(np.float64) * reduced.scales[0]
    surface = np.concatenate([reduced.model.mesh.points[node][None], np.moveaxis(modes, 2, 0)])
    fields = [dict(field) for field in values["fields"] if field["key"] == "displacement"]
    farthest = max(float(np.linalg.norm(each.displacement, axis=1).max()) for each in states)
    for field in fields:
        field["high"] = max(farthest / mm, field["low"] + 1e-3)
    triangles, obstacles = _obstacles(reduced, states)
    values |= {"steps": [{"state": 0, "label": ""}], "fields": fields, "inside": None, "threads": None,
               "places": None, "curves": None, "obstacles": triangles}  # fmt: skip
    values["surface"]["positions"] = None
    frames = np.array([each.q for each in states[: LIVE.frames]])
    return LiveScene(
        values=values, surface=surface.astype(np.float32), obstacles=obstacles, frames=frames.astype(np.float32)
    )


def tip_at_rest(reduced: Reduced) -> Array | None:
    """Center (3,) [m] of the face ``tip`` of the whole actuator; None without one."""
    mesh = reduced.model.mesh
    if "tip" not in mesh.faces or not reduced.tip.any():
        return None
    center = MeshFacts(mesh).of_whole(mesh.points[mesh.face_nodes("tip")].mean(axis=0))
    for plane in MeshFacts(mesh).mirrors:
        center[plane.axis] = plane.position
    return center


def tip_plane(reduced: Reduced) -> Array | None:
    """Normal (3,) of the plane that the tip stays in at all training states; None where it leaves any."""
    moves = reduced.trained[:, : reduced.equations.sizes[0]] @ reduced.tip.T * reduced.scales[0]
    _, sizes, ways = np.linalg.svd(np.vstack([moves, np.zeros((3, 3))]), full_matrices=False)
    return np.asarray(ways[2]) if sizes[2] <= LIVE.flat * sizes[0] < sizes[1] else None


def _answers(reduced: Reduced) -> list[ReducedState]:
    """States at the ends of the ranges of the inputs, the largest first, as far as there are any."""
    box, answers = reduced.inputs, []
    ends = [box.high, box.low]
    for place in range(len(box.keys)):
        for one, other in ((box.low, box.high), (box.high, box.low)):
            end = one.copy()
            end[place] = other[place]
            ends.append(end)
    for end in [*ends, *reduced.held_out.inputs]:
        try:
            answers.append(reduced.at(end))
        except NotSolved:
            continue
        if len(answers) >= LIVE.frames:
            break
    if not answers:
        raise NotSolved("the reduced model finds no equilibrium at the ends of its ranges; train it more densely.")
    return answers


def _obstacles(reduced: Reduced, states: Sequence[ReducedState]) -> tuple[dict[str, Any] | None, Small]:
    """Triangles of the obstacles, and their places as a linear function of the inputs."""
    none = np.zeros((1 + len(reduced.inputs.keys), 0, 3), dtype=np.float32)
    if not reduced.model.contact.obstacles:
        return None, none
    fields = [StateFields(each.state()) for each in states]
    extents = extents_of(fields)
    skins = [obstacle_skin(at, extents) for at in fields]
    known = [(each.inputs, skin) for each, skin in zip(states, skins, strict=True) if skin is not None]
    if not known:
        return None, none
    shape = known[0][1].points.shape
    places = np.flatnonzero(reduced.inputs.places)
    alike = [(inputs, skin) for inputs, skin in known if skin.points.shape == shape]
    table = np.array([np.concatenate([[1.0], inputs[places]]) for inputs, _ in alike])
    scale = np.abs(table).max(axis=0) + (np.abs(table).max(axis=0) == 0)
    points = np.array([skin.points.ravel() for _, skin in alike])
    slopes = np.linalg.lstsq(table / scale, points, rcond=None)[0] / scale[:, None]
    out = np.zeros((1 + len(reduced.inputs.keys), *shape), dtype=np.float32)
    out[np.concatenate([[0], 1 + places])] = slopes.reshape(-1, *shape)
    return {"triangles": pack_index(alike[0][1].triangles), "positions": None}, out

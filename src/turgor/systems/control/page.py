"""Page: an actuator that follows a path, with its motion, pictures and limits, in one HTML file."""

import json
from base64 import b64encode
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.faces import surfaces
from turgor.core.results.fields.state_fields import MeshFacts
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import COLUMN_UNITS, Response
from turgor.reduced.path import solution_of
from turgor.systems.control.track import Track
from turgor.views.pictures.state_picture import bare_picture, shared_view
from turgor.views.plots.figures import svg_of
from turgor.views.plots.linked_plots import places_of_points
from turgor.views.plots.systems.track_plot import track_panels
from turgor.views.report.templating import rendered
from turgor.views.viewer.assets import viewer_scripts, viewer_style
from turgor.views.viewer.curves import curves_of
from turgor.views.viewer.scene import Scene, chosen_steps, scene_of
from turgor.views.viewer.viewer import viewer_markup
from turgor.views.viewer.wanted_path import wanted_path

Array = NDArray[np.float64]

#: Pictures that stand where a browser cannot turn the actuator.
STILLS = 4


def write_page(track: Track, file: str | Path, title: str = "") -> Path:
    """Write the page of a track: the actuator as it moves, its path, inputs, distances and limits.

    Parameters
    ----------
    track : Track
    file : str or Path
        Ends in ``.html``.
    title : str
        The name of the actuator by default.

    Returns
    -------
    Path
        A file that loads nothing.

    Raises
    ------
    TurgorError
        If the file has another ending.
    """
    path = Path(file)
    if path.suffix.lower() != ".html":
        raise TurgorError(f"page '{path}' ends in '{path.suffix}'; allowed is .html.")
    model = track.states[0].reduced.model
    response = _with_rest(track.response())
    scene = _scene(track, response)
    panels = [(svg_of(each), json.dumps(places_of_points(each, len(response))))
              for each in track_panels(response, track.active)]  # fmt: skip
    values = {
        "title": title or model.mesh.name,
        "verdict": _verdict(track),
        "numbers": _numbers(track),
        "viewer": viewer_markup(scene),
        "viewer_style": viewer_style(),
        "viewer_scripts": viewer_scripts(),
        "notes": list(scene.notes),
        "stills": _stills(track),
        "panels": panels,
        "limits": _limits(track),
    }
    source = files("turgor.views.report").joinpath("templates/track.html").read_text("utf-8")
    path.write_text(rendered(source, values), encoding="utf-8")
    return path


def _with_rest(response: Response) -> Response:
    """The table with a first row for rest, at which nothing is known."""
    columns = tuple(replace(each, values=np.concatenate([[np.nan], each.values])) for each in response.columns)
    return replace(response, columns=columns)


def _scene(track: Track, response: Response) -> Scene:
    """The motion from rest through some rows, with the wanted path where the tip follows one."""
    mesh = track.states[0].reduced.model.mesh
    rows = chosen_steps(len(track.states) + 1, 1)[1:]
    scene = scene_of(solution_of([track.states[row - 1] for row in rows]))
    shown = [0, *(rows[place - 1] for place in scene.steps[1:])]
    steps = [{"state": row, "label": _label(track, row)} for row in shown]
    notes = (
        (f"The motion shows {len(shown) - 1} of {len(track.states)} rows.",) if len(shown) <= len(track.states) else ()
    )
    values = scene.values | {"steps": steps, "curves": curves_of(response, shown)}
    places = _places(track)
    if places is not None:
        size = float(np.ptp(mesh.points, axis=0).max())
        values["path"] = wanted_path(places, places[[max(row - 1, 0) for row in shown]], size)
    return replace(scene, values=values, notes=notes)


def _places(track: Track) -> Array | None:
    """Wanted places (k, 3) [m] of the tip; axes that are free are where they were reached. None without a tip."""
    names = [f"tip_{axis}" for axis in "xyz"]
    if not set(track.output.names) <= set(names):
        return None
    mesh = track.states[0].reduced.model.mesh
    weights = surfaces.nodal_weights(mesh.points, mesh.face("tip"))
    rest = MeshFacts(mesh).of_whole(weights @ mesh.points / weights.sum())
    moves = np.array([state.tip for state in track.states])
    for column, name in enumerate(track.output.names):
        moves[:, names.index(name)] = track.target[:, column]
    return np.asarray(rest + moves)


def _label(track: Track, row: int) -> str:
    """Words of a step of the motion."""
    if not row:
        return "at rest"
    return f"{track.times[row - 1]:.4g} s · distance {_shown(track, track.distance[row - 1])}"


def _shown(track: Track, distance: float) -> str:
    """A distance with its unit; those that no plot could show are small."""
    unit = COLUMN_UNITS[track.output.unit]
    least = float(f"{1e-4 * np.ptp(track.target, axis=0).max() / unit:.1g}")
    value = f"{distance / unit:.2g}" if distance / unit >= least else f"< {least:g}"
    return f"{value} {track.output.unit}"


def _verdict(track: Track) -> str:
    box = track.states[0].reduced.inputs
    ends = [
        f"{key} from {box.shown(k, low)} to {box.shown(k, high)}" if high > low else f"{key} {box.shown(k, low)}"
        for k, (key, low, high) in enumerate(zip(box.keys, *_ends(track.inputs), strict=True))
    ]
    what = ", ".join(name.replace("_", " ") for name in track.output.names)
    return f"{what} in {len(track.times)} rows. Inputs: {'; '.join(ends)}."


def _ends(inputs: Array) -> tuple[list[float], list[float]]:
    """Least and largest inputs, with four digits."""
    ends = [[float(f"{value:.4g}") for value in row.tolist()] for row in (inputs.min(axis=0), inputs.max(axis=0))]
    return ends[0], ends[1]


def _numbers(track: Track) -> list[tuple[str, str]]:
    distance, limited = track.distance, sum(map(bool, track.active))
    return [
        (_shown(track, float(distance.mean())), "mean distance"),
        (_shown(track, float(distance.max())), f"largest distance, in row {int(distance.argmax()) + 1}"),
        (f"{limited} of {len(distance)}", "rows at a limit"),
        (
            f"{100 * max(state.estimate for state in track.states):.2g} %",
            "largest estimated error of the reduced model",
        ),
    ]


def _limits(track: Track) -> list[tuple[str, int, str]]:
    """Each limit that was reached: how many rows, and from when on."""
    out = []
    for name in sorted({name for names in track.active for name in names}):
        rows = [place for place, names in enumerate(track.active) if name in names]
        out.append((name, len(rows), f"{track.times[rows[0]]:.4g} s"))
    return out


def _stills(track: Track) -> list[tuple[str, str]]:
    """Pictures of some rows, with their times."""
    rows = np.unique(np.linspace(0, len(track.states) - 1, STILLS).round().astype(int))
    states = [track.states[row].state() for row in rows]
    view = shared_view(states, width=700)
    pictures = [b64encode(bare_picture(state, view)).decode() for state in states]
    return list(zip([f"{track.times[row]:.4g} s" for row in rows], pictures, strict=True))

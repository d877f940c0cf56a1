"""Scenes: what the viewer draws of a run, finished or not, as the text that the page reads."""

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.foundation.response import Response
    from turgor.views.viewer.curves import Measured

#: States of a run that is being solved: its shape is drawn again after each of them.
WHILE_SOLVING = 6


def scene(folder: Path, whole: bool) -> str:
    """Return the scene of a run as JSON; empty where it has no state yet.

    Parameters
    ----------
    folder : Path
        Of its results.
    whole : bool
        Whether all states are drawn; else a few, with the last.
    """
    from turgor.core.results.files.response_csv import read_response
    from turgor.core.solvers.load import load
    from turgor.job.compare import measured_points
    from turgor.views.viewer.scene import scene_of

    try:
        solution = load(folder)
    except (TurgorError, OSError):
        return ""  # a state is written at this moment, or none is there
    if not solution.states:
        return ""
    if not whole and len(solution.states) > WHILE_SOLVING:
        chosen = np.unique(np.rint(np.linspace(0, len(solution.states) - 1, WHILE_SOLVING)).astype(int))
        solution = replace(solution, states=tuple(solution.states[k] for k in chosen))
    response: Response | None = None
    measured: tuple[Measured, ...] = ()
    if whole:
        try:
            response = read_response(folder / "response.csv")
            measured = measured_points(folder, response)
        except TurgorError:
            response = None
        if response is not None and len(response) != len(solution.states):
            response, measured = None, ()
    shown = scene_of(solution, response, measured)
    return json.dumps({**shown.values, "notes": shown.notes}, separators=(",", ":"), ensure_ascii=False)

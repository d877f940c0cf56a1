"""Files of a folder of results that still show its path, and need not be written again."""

import re
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

import numpy as np

from turgor.core.engine.cells.internal_variables import bonds_of
from turgor.core.solvers.load import PATH_FOLDER
from turgor.job.output.folder import BONDS, CONTACT, DEFORMED, FIELDS, PLOT, UNDEFORMED
from turgor.job.output.outcome import RunOutcome
from turgor.views.plots.figures import note_in

#: File of each picture of the path.
PICTURES: Mapping[str, str] = {"undeformed": UNDEFORMED, "deformed": DEFORMED, "contact": CONTACT, "bonds": BONDS}

#: Name of the files of fields, and their patterns in the folder.
SERIES = "state"
FIELD_FILES = frozenset({f"{FIELDS}/*.vtu", f"{FIELDS}/*.pvd"})


def current_files(outcome: RunOutcome, note: str) -> frozenset[str]:
    """Return which of `turgor.job.output.folder.RESULTS` the folder holds as they would be written now.

    Parameters
    ----------
    outcome : RunOutcome
        The path in the folder, measured.
    note : str
        From `drawn_from`; pictures and the plot carry it.
    """
    drawn = {name for name in (PLOT, *PICTURES.values()) if note_in(outcome.folder / name) == note}
    fields = _has_fields(outcome.folder, len(outcome.solution.states))
    return frozenset(drawn | (FIELD_FILES if fields else frozenset()))


def drawn_from(outcome: RunOutcome) -> str:
    """Return a fingerprint of all that pictures and plot show: program, titles, the measures, first and last state.

    Mesh errors are left out: a path has the same ones, and pictures are drawn before they are known.
    """
    solution, shown = outcome.solution, sha256()
    mesh = solution.model.mesh
    # The last digits of a measure change with the number of threads.
    measures = [(column.name, [f"{value:.6g}" for value in column.values]) for column in outcome.response.quantities]
    texts = [outcome.written_by.get("turgor", ""), outcome.job.name, outcome.response.stages]
    shown.update(repr((texts, measures)).encode())
    ends = (solution.states[0], solution.states[-1])
    arrays = [mesh.points, mesh.cells, *(state.displacement for state in ends), *(state.mean_stress for state in ends)]
    arrays += bonds_of(ends[1].memory).values()
    arrays += [touch.pressure for touch in ends[1].touches.values()]
    for array in arrays:
        shown.update(np.ascontiguousarray(array).tobytes())
    return shown.hexdigest()


def _has_fields(folder: Path, states: int) -> bool:
    """Whether the folder holds the fields of as many states, written after the last file of the path."""
    series, path = folder / FIELDS / f"{SERIES}.pvd", list((folder / PATH_FOLDER).glob("*"))
    if not series.exists() or not path:
        return False
    written = series.stat().st_mtime_ns >= max(file.stat().st_mtime_ns for file in path)
    named = re.findall(r'file="(.+?)"', series.read_text(encoding="utf-8"))
    return written and len(named) == states and all((series.parent / name).exists() for name in named)

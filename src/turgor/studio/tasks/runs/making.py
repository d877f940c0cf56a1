"""Making: files of a run that a button requests, written into its folder and its manifest."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from turgor.foundation.errors import unknown

#: Names of what is made here.
MOTION, BODY, SHOWN = "motion.gif", "motion.glb", "state-{}.png"


def make(folder: Path, kind: str, state: int) -> str:
    """Write a file of a run; return its name, relative to its folder.

    Parameters
    ----------
    folder : Path
    kind : str
        One of ``"report"``, ``"gif"``, ``"glb"``, ``"vtu"`` and ``"picture"``.
    state : int
        Number of the state that a picture shows.
    """
    if kind not in MAKERS:
        raise unknown("kind of file", kind[:40], MAKERS)
    return MAKERS[kind](folder, state)


def _report(folder: Path, state: int) -> str:
    from turgor.job.output.folder import REPORT
    from turgor.job.output.write import write_results
    from turgor.job.postprocess import outcome_of_folder

    outcome, fields = outcome_of_folder(folder)
    job = replace(outcome.job, output=replace(outcome.job.output, report=True, pictures=True))
    write_results(replace(outcome, job=job), lambda text: None, fields)
    return REPORT


def _fields(folder: Path, state: int) -> str:
    from turgor.job.output.folder import FIELDS
    from turgor.job.output.path_files import SERIES
    from turgor.job.output.write import write_fields
    from turgor.job.postprocess import outcome_of_folder

    outcome, fields = outcome_of_folder(folder)
    write_fields(outcome, fields, lambda text: None, frozenset())
    return f"{FIELDS}/{SERIES}.pvd"


def _moving(name: str) -> Callable[[Path, int], str]:
    def moving(folder: Path, state: int) -> str:
        from turgor.core.solvers.load import load
        from turgor.job.output.manifest import list_files
        from turgor.views.pictures.series.motion import write_motion

        solution = load(folder)
        list_files(folder, (name,))
        write_motion(folder / name, solution)
        return name

    return moving


def _picture(folder: Path, state: int) -> str:
    from turgor.core.solvers.load import load
    from turgor.job.output.manifest import list_files
    from turgor.views.pictures.picture import picture

    solution = load(folder)
    number = min(max(state, 0), len(solution.states) - 1)
    name = SHOWN.format(number)
    list_files(folder, (name,))
    picture(solution, folder / name, state=number)
    return name


#: What makes each kind.
MAKERS: Mapping[str, Callable[[Path, int], str]] = {
    "report": _report,
    "vtu": _fields,
    "gif": _moving(MOTION),
    "glb": _moving(BODY),
    "picture": _picture,
}

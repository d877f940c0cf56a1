"""Reach: the workspace of several cavities, computed by a process of its own, and what it has reached so far."""

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

#: Folder of the runs, and the table at the end.
RUNS, TABLE = "runs", "workspace.csv"


def main(arguments: Sequence[str]) -> int:
    """Compute a workspace: ``JOB FOLDER PROCESSES cavity_1='0, 10, 20 kPa' …``; what has ended is read."""
    from turgor.foundation.errors import TurgorError
    from turgor.job.read import read_job
    from turgor.studies.runs.evaluations import saved_in
    from turgor.studies.runs.workspaces import workspace_of
    from turgor.studies.study_file.numbers import numbers_in

    job, folder, processes, *given = arguments
    try:
        parts = [each.partition("=") for each in given]
        pressures = {name: numbers_in(text, name, "pressure", "0, 10, 20 kPa") for name, _, text in parts}
        with saved_in(Path(folder) / RUNS, processes=int(processes)) as evaluations:
            computed = workspace_of(read_job(job), pressures, evaluations=evaluations)
        computed.write(Path(folder) / TABLE)
    except TurgorError as error:
        sys.stderr.write(f"{error.on_command_line}\n")
        return 1
    except KeyboardInterrupt:
        return 130
    return 0


def reached(folder: Path) -> dict[str, Any]:
    """Return the places of the tip in all runs that have ended [mm], and area and volume once two cavities moved it.

    Parameters
    ----------
    folder : Path
    """
    from turgor.core.results.measures.shape.workspaces import COLUMNS, workspace
    from turgor.foundation.errors import TurgorError
    from turgor.studies.runs.files.run_files import run_with_key
    from turgor.units import mL, mm

    responses, points = [], []
    for notes in sorted((folder / RUNS).glob("*.json")):
        computed = run_with_key(notes.stem, notes.parent)
        if computed is None or not set(COLUMNS) <= set(computed.response.names):
            continue
        responses.append(computed.response)
        name = str(json.loads(notes.read_text(encoding="utf-8")).get("name", notes.stem))
        ends = [float(computed.response[column][-1] / mm) for column in COLUMNS]
        points.append({"name": name, "tip": ends})
    try:
        whole = workspace(responses)
        size: dict[str, float | None] = {"area": whole.area / mm**2, "volume": whole.volume / mL}
    except (TurgorError, ValueError):
        size = {"area": None, "volume": None}
    return {"points": points, **size}


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

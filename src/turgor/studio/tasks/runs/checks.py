"""Checks: read, build, mesh and check a job as `turgor check` does, with what mends each finding."""

import tomllib
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turgor.foundation.errors import TurgorError
from turgor.studio.tasks.runs.fixes import fixes_of, problem_of

if TYPE_CHECKING:
    from turgor.job.job import Job


def check(file: Path, shown: str) -> dict[str, Any]:
    """Return problems of a job file, or its mesh, findings and expected costs.

    Parameters
    ----------
    file : Path
    shown : str
        The name of the job, for messages.
    """
    from turgor.job.read import read_job
    from turgor.job.text.problems import JobError

    content = _content(file)
    try:
        job = read_job(file)
    except JobError as error:
        problems = [problem_of(each.replace(str(file), shown), shown, content) for each in error.problems]
        return {"problems": problems, "loads": loads_of(content)}
    try:
        return _checked(job, content)
    except TurgorError as error:
        sentence = error.on_command_line.replace(str(file), shown)
        return {"problems": [{"line": None, "key": "", "sentence": sentence, "fixes": []}], "loads": loads_of(content)}


def _checked(job: "Job", content: dict[str, Any]) -> dict[str, Any]:
    from turgor.accuracy.adaptivity.findings import ONLY_WITH_ERROR
    from turgor.foundation.processors import processors
    from turgor.job.expected import expected_of
    from turgor.job.meshes import save_mesh_of
    from turgor.job.prepare import prepare
    from turgor.views.report.describe import contact

    model, findings = prepare(job)
    save_mesh_of(job)
    expected = expected_of(job, model, job.threads or processors())
    return {
        "problems": [],
        "mesh": f"{model.mesh.name}; {len(model.mesh.cells)} cells, {model.mesh.unknown_count} unknowns",
        "contact": contact(model),
        "findings": [
            {**asdict(each), "severity": str(each.severity), "fixes": fixes_of(each, content)}
            for each in findings
            if each.code != ONLY_WITH_ERROR or not job.output.mesh_error
        ],
        "expected": {**asdict(expected), "text": str(expected)},
        "coarse": coarse_changes(job, content),
        "loads": loads_of(content),
        "cavities": list(model.mesh.cavities),
        "measures": list(job.output.measures),
    }


def coarse_changes(job: "Job", content: dict[str, Any]) -> list[str]:
    """Return the changes of a job for a coarse answer, as ``--set`` takes them: fewer cells, and numbers alone.

    Where walls decide the size, tetrahedra need fewer unknowns than hexahedra, but for chambers in a row.
    """
    from turgor.core.meshing.sizing.default_size import default_size
    from turgor.core.meshing.sweeping.section import Fineness
    from turgor.core.meshing.sweeping.swept import is_grid_row
    from turgor.job.job import MESHED

    changes = [f"output.{key}=false" for key in ("pictures", "report", "fields", "mesh_error")]
    if isinstance(job.actuator, MESHED):
        return changes
    changes.append("mesh.quality=draft")
    if job.mesh.wall_cells != 1:
        changes.append("mesh.wall_cells=1")
    if job.mesh_target is not None:
        changes.append("mesh.most_unknowns=1")
    row = job.mesh.cells != "axisymmetric" and is_grid_row(job.geometry(), Fineness(size=job.mesh_size))
    kind = "axisymmetric" if job.mesh.cells == "axisymmetric" else "hexahedra" if row else "tetrahedra"
    changes.append(f"mesh.cells={kind}")
    mesh = content.get("mesh")
    if isinstance(mesh, dict) and "size" in mesh:
        with suppress(TurgorError):
            size = max(default_size(job.geometry(), kind, "draft"), job.mesh_size)
            changes.append(f"mesh.size={1e3 * size:.6g} mm")
    return changes


def coarse_of(file: Path) -> list[str]:
    """Return the changes of a job file for a coarse answer."""
    from turgor.job.read import read_job

    return coarse_changes(read_job(file), _content(file))


def loads_of(content: dict[str, Any]) -> list[dict[str, Any]]:
    """Return what changes along the path of a job: histories of loads, and the load factors of states.

    Each has a key, its points ``[place, share]``, what the place is, and whether it can be dragged.
    """
    loads, procedure = content.get("loads"), content.get("procedure")
    histories = []
    for name, table in loads.items() if isinstance(loads, dict) else ():
        if not isinstance(table, dict) or not {"pressure", "force", "hangs"} & set(table):
            continue
        key = "history_over_time" if "history_over_time" in table else "history"
        given = table.get(key, [[0, 0], [1, 1]])
        points = given if isinstance(given, list) else None
        full = str(table.get("pressure", table.get("hangs", table.get("force"))))
        histories.append({"key": f"loads.{name}.{key}", "name": name, "points": points, "text": given, "full": full})
    states = procedure.get("at", []) if isinstance(procedure, dict) else []
    numbers = [each for each in states if isinstance(each, int | float)] if isinstance(states, list) else []
    return [
        *histories,
        {"key": "procedure.at", "name": "states", "at": numbers, "fixed": len(numbers) != len(states or [])},
    ]


def _content(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}

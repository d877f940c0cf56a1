"""Workspace: the folder that the studio shows. A name from a page is looked up here; no path from a page is opened."""

import json
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.store.caches import private

#: Folder of the studio in the workspace: edits to undo, uploads, and logs of runs.
OWN = ".turgor-studio"

#: File in each folder that turgor wrote results into.
RESULTS_MARK = ".turgor-files.json"

#: Endings of parts that an actuator may come from.
PARTS = (".step", ".stp", ".brep", ".brp", ".stl", ".msh", ".inp", ".vtk", ".vtu")

#: Folders deeper than this below the workspace are not searched for runs.
DEPTH = 3


@dataclass(frozen=True, slots=True)
class Workspace:
    """A folder with job files, runs, studies and reduced models.

    Parameters
    ----------
    folder : Path
    """

    folder: Path

    def jobs(self) -> list[str]:
        """Return the names of the TOML files."""
        return self._files(".toml")

    def parts(self) -> list[str]:
        """Return the names of CAD and mesh files."""
        return self._files(*PARTS)

    def tables(self) -> list[str]:
        """Return the names of CSV files, such as tests of a material."""
        return self._files(".csv")

    def reduced(self) -> list[str]:
        """Return the names of files of reduced models."""
        return self._files(".reduced")

    def runs(self) -> list[str]:
        """Return the names of folders with results of runs, relative to the workspace, the newest first."""
        folders = {file.parent for file in self._marks() if (file.parent / "path").is_dir()}
        ordered = sorted(folders, key=lambda each: -each.stat().st_mtime)
        return [each.relative_to(self.folder).as_posix() for each in ordered]

    def job(self, name: str) -> Path:
        """Return the file of a job that is listed."""
        return self._known("job file", name, self.jobs())

    def run(self, name: str) -> Path:
        """Return the folder of a run that is listed."""
        return self._known("run", name, self.runs())

    def file(self, name: str) -> Path:
        """Return a part, a table or a reduced model that is listed."""
        return self._known("file", name, [*self.parts(), *self.tables(), *self.reduced()])

    def new(self, name: str, ending: str) -> Path:
        """Return the path of a file that does not exist yet.

        Raises
        ------
        TurgorError
            If the name is none of a file here, has another ending, or exists.
        """
        plain = Path(name).name == name and not name.startswith(".") and name.isprintable() and "\\" not in name
        if not plain or not name.endswith(ending) or len(name) > 120:
            raise TurgorError(f"'{name[:120]}' is no name of a file; allowed are names such as 'finger{ending}'.")
        if (self.folder / name).exists():
            raise TurgorError(f"'{name}' exists; choose another name.")
        return self.folder / name

    def own(self, part: str) -> Path:
        """Return a private folder of the studio in the workspace, such as that of edits to undo; it is made."""
        if not private(self.folder / OWN) or not private(self.folder / OWN / part):
            raise TurgorError(f"the folder '{self.folder / OWN}' is not writable for you alone; remove it.")
        ignored = self.folder / OWN / ".gitignore"
        if not ignored.exists():
            ignored.write_text("*\n", encoding="utf-8")
        return self.folder / OWN / part

    def content(self) -> dict[str, object]:
        """Return what the page lists."""
        return {
            "folder": str(self.folder),
            "jobs": [{"name": name, "kind": _kind(self.folder / name)} for name in self.jobs()],
            "runs": self.runs(),
            "parts": self.parts(),
            "tables": self.tables(),
            "reduced": self.reduced(),
        }

    def signature(self) -> dict[str, float]:
        """Return the time of the last change of each file that the page shows, by name."""
        names = [*self.jobs(), *self.parts(), *self.tables(), *self.reduced()]
        times = {name: _time(self.folder / name) for name in names}
        for name in self.runs():
            times[name] = max(_time(self.folder / name / each) for each in ("", "run.log", "response.csv", "path"))
        return times

    def _files(self, *endings: str) -> list[str]:
        names = (each.name for each in os.scandir(self.folder) if each.is_file() and not each.name.startswith("."))
        return sorted(name for name in names if name.lower().endswith(endings))

    def _known(self, kind: str, name: str, names: list[str]) -> Path:
        if name not in names:
            raise unknown(kind, name[:120], names)
        return self.folder / name

    def _marks(self, folder: Path | None = None, depth: int = 0) -> Iterator[Path]:
        with os.scandir(folder or self.folder) as entries:
            for each in entries:
                if each.name == RESULTS_MARK:
                    yield Path(each.path)
                elif depth < DEPTH and not each.name.startswith(".") and each.is_dir(follow_symlinks=False):
                    yield from self._marks(Path(each.path), depth + 1)


def _time(file: Path) -> float:
    try:
        return file.stat().st_mtime
    except OSError:
        return 0.0


#: A table that only files of this kind have.
_KINDS = {"sweep": "study", "optimize": "study", "calibrate": "study", "uncertainty": "study", "actuator": "job"}


def _kind(file: Path) -> str:
    """Kind of a TOML file by its tables, without reading it as a job: one with mistakes has a kind, too."""
    try:
        lines = file.read_text(encoding="utf-8", errors="replace")[:200_000].splitlines()
    except OSError:
        return "other"
    heads = {line.strip().strip("[]").split(".")[0].split("]")[0] for line in lines if line.startswith("[")}
    return next((kind for table, kind in _KINDS.items() if table in heads), "other")


def read_json(file: Path) -> dict[str, object]:
    """Return the table that a JSON file holds; an empty one where it is missing or damaged."""
    try:
        content = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}

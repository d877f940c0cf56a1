"""Cases of the kills: small commands, and what of their folders must be as if nothing had happened."""

import csv
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

PULL = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "6 mm"
cells = "hexahedra"

[materials]
body = { name = "rubber", law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "10 kPa"

[procedure]
type = "static"
first_step = 0.1
max_step = 0.1

[output]
measures = ["tip_displacement", "cavity_volume"]
fields = false
pictures = false
report = false
mesh_error = false
"""

TUBE = """
[actuator]
type = "extending_cylinder"
length = "20 mm"
cap = "3 mm"

[mesh]
cells = "axisymmetric"
size = "3 mm"
wall_cells = 1

[materials]
body = { law = "neo_hooke", C10 = "0.12 MPa" }

[loads]
pressure = "20 kPa"

[output]
measures = ["tip_displacement_x", "cavity_volume"]
"""

WALLS = """
job = "tube.toml"

[factors]
actuator.wall = ["2 mm", "2.5 mm"]
"materials.body.C10" = { low = "0.1 MPa", high = "0.14 MPa", levels = 2 }

[sweep]
measures = ["tip_displacement_x"]
at = { pressure = "10 kPa" }
"""

LEAN = """
job = "tube.toml"

[factors]
"actuator.wall" = { low = "1 mm", high = "4 mm" }
"actuator.inner_radius" = { low = "4 mm", high = "10 mm", start = "7 mm" }

[optimize]
precision = 0.05

[[optimize.targets]]
measure = "tip_displacement_x"
value = "0.8 mm"
at = { pressure = "15 kPa" }

[[optimize.objectives]]
minimize = "solid_volume"
"""

RIG = "pressure (kPa),tip_displacement_x (mm)\n2,0.05\n6,0.16\n10,0.28\n14,0.40\n18,0.53\n"

#: Files that all cases start from.
FILES: Mapping[str, str] = {
    "pull.toml": PULL,
    "softer.toml": PULL.replace("0.1 MPa", "0.05 MPa"),
    "tube.toml": TUBE,
    "walls.toml": WALLS,
    "lean.toml": LEAN,
    "rig.csv": RIG,
}

#: What differs from call to call: times, and how many runs were read.
TIMES = {"cpu_seconds", "seconds_s", "computed", "seconds", "created", "written_by", "timing"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A command that is killed.

    Parameters
    ----------
    command : tuple of str
        Without the folder of results.
    before : tuple of str
        The command whose results the first call replaces, if any; they must not be lost before.
    cold : bool
        Whether each chain begins with empty caches.
    workers : bool
        Whether it has processes, of which one may be killed.
    share : int
        Number of its chains in a round.
    """

    command: tuple[str, ...]
    before: tuple[str, ...] = ()
    cold: bool = False
    workers: bool = False
    share: int = 1

    @property
    def is_run(self) -> bool:
        """Whether it is one run, whose steps are not computed twice; else it is a study of whole runs."""
        return self.command[0] == "run"

    @property
    def first(self) -> tuple[str, ...]:
        """Options of the first call."""
        return ("--force",) if self.before else ()


ONE = ("--threads", "1")
CASES: Mapping[str, Case] = {
    "run": Case(command=("run", "pull.toml", *ONE), share=4),
    "run, pictures": Case(command=("run", "tube.toml", *ONE)),
    "run, cold caches": Case(command=("run", "pull.toml", *ONE), cold=True),
    "run --force": Case(command=("run", "pull.toml", *ONE), before=("run", "softer.toml", *ONE), share=3),
    "sweep": Case(command=("sweep", "walls.toml"), share=2),
    "sweep, 2 processes": Case(command=("sweep", "walls.toml", "--processes", "2"), workers=True, share=2),
    "optimize": Case(command=("optimize", "lean.toml")),
    "calibrate": Case(command=("calibrate", "tube.toml", "rig.csv", "--free", "materials.body.C10"), share=2),
}


def outcome(folder: Path) -> dict[str, object]:
    """Return what a folder of results holds, file by file, without times."""
    return {file.relative_to(folder).as_posix(): _content(file) for file in sorted(folder.rglob("*")) if file.is_file()}


def _content(file: Path) -> object:
    """Bytes of a file; of tables and JSON what is in them, without times; of a report and of archives no content."""
    if file.suffix in {".html", ".turgor", ".log", ".txt"} or file.parent.name == "path":
        return file.stat().st_size > 0
    if file.suffix == ".csv":
        rows = list(csv.reader(StringIO(file.read_text(encoding="utf-8"))))
        left = [place for place, name in enumerate(rows[0]) if name not in TIMES]
        return [[row[place] for place in left] for row in rows]
    if file.suffix == ".json":
        return _without(json.loads(file.read_text(encoding="utf-8")))
    return file.read_bytes()


def _without(value: object) -> object:
    if isinstance(value, dict):
        return {key: _without(each) for key, each in value.items() if key not in TIMES}
    return [_without(each) for each in value] if isinstance(value, list) else value


def going_on(case: Case, folder: Path) -> tuple[str, ...]:
    """Return the options with which a user goes on; ``--force`` until the new run is the one in the folder."""
    if not case.is_run:
        return ()
    return ("--resume",) if not case.before or is_new(folder) else ("--force",)


def is_new(folder: Path) -> bool:
    """Whether the run in a folder is that of the job, not the earlier one, which had another rubber."""
    lock = folder / "job.lock.toml"
    return lock.exists() and 'C10 = "0.1 MPa"' in lock.read_text(encoding="utf-8")


@dataclass(frozen=True, slots=True, kw_only=True)
class Kept:
    """What a folder holds before a call, which the call must not compute again.

    Parameters
    ----------
    folder : Path
    steps : int
        Of the run that goes on.
    runs : dict of str to int
        Runs of a study that have ended, and when they were written.
    """

    folder: Path
    steps: int
    runs: dict[str, int]

    @staticmethod
    def of(case: Case, folder: Path, options: tuple[str, ...]) -> "Kept":
        """Look at a folder before a call with some options."""
        return Kept(folder=folder, steps=kept_steps(folder) if "--resume" in options else 0, runs=kept_runs(folder))

    def check(self, said: str) -> None:
        """Check that a call computed nothing twice."""
        steps = [int(number) for number in re.findall(r"step (\d+): load", said)]
        assert all(each > self.steps for each in steps), f"steps {steps} after step {self.steps}"
        now = kept_runs(self.folder)
        again = [name for name, written in self.runs.items() if now.get(name) != written]
        assert not again, f"computed again: {again}"


def kept_steps(folder: Path) -> int:
    """Return the number of the last step that the log of a run names; its states are on disk."""
    log = folder / "run.log"
    result = re.findall(r"(?m)^step (\d+):", log.read_text(encoding="utf-8")) if log.exists() else []
    return int(result[-1]) if result else 0


def kept_runs(folder: Path) -> dict[str, int]:
    """Return when each run of a study that has ended was written."""
    return {file.name: file.stat().st_mtime_ns for file in (folder / "runs").glob("*.json")}

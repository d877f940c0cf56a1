"""Damaged job files, lock files, study files, tables of designs and files of materials."""

import random
import tomllib
from functools import cache
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import tomlkit
from fuzz_texts import DESIGNS, FULL, OPTIMIZATION, STAGED, STUDY, TABLE_STUDY
from mutants import changed_bytes, changed_table, changed_text
from trials import Case, apart

from turgor.core.materials.library.record_files import read_records
from turgor.job.job import Job
from turgor.job.output.folder import LOCK
from turgor.job.output.identity import check_same_job, read_lock
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.studies.runs.files.designs_csv import read_designs
from turgor.studies.runs.jobs.job_numbers import JobNumber, numbers_of
from turgor.studies.study_file.study_file import read_study_file

JUNK_CELLS = (
    "",
    "nan",
    "inf",
    "-1",
    "0",
    "1e400",
    "1e300",
    "x",
    "1,5",
    "9" * 400,
    "1 mm",
    "\0",
    "=1+1",
    '"',
    "٣",
    "1_0",
)


@cache
def base() -> Job:
    """The job that studies vary; read after a fork, because the CAD kernel builds its shape."""
    with TemporaryDirectory() as folder:
        return read_job(_written(Path(folder) / "job.toml", FULL))


@cache
def lock() -> str:
    """The lock file of that job."""
    return str(apart(lambda: lock_text(base(), {})))


@cache
def numbers() -> dict[str, JobNumber]:
    return dict(numbers_of(tomllib.loads(lock_text(base(), {}))))


@cache
def materials() -> tuple[str, ...]:
    """Files of the library."""
    data = files("turgor.core.materials.library").joinpath("data")
    return tuple(sorted(each.read_text("utf-8") for each in data.iterdir() if each.name.endswith(".toml")))


def _written(file: Path, text: str) -> Path:
    file.write_text(text, encoding="utf-8")
    return file


def damaged_toml(text: str, chance: random.Random) -> bytes:
    """Change values and keys of a TOML file, its characters, its bytes, or its encoding."""
    kind = chance.randrange(10)
    if kind < 6:
        table: dict[str, Any] = tomllib.loads(text)
        for _ in range(chance.choice((1, 1, 2, 3))):
            changed_table(table, chance)
        return tomlkit.dumps(table).encode("utf-8", "replace")
    if kind < 8:
        return changed_text(text, chance).encode("utf-8")
    if kind == 8:
        return changed_bytes(text.encode("utf-8"), chance)
    return text.encode(chance.choice(("utf-16", "utf-8-sig", "latin-1", "utf-32")), "replace")


def damaged_job(chance: random.Random, folder: Path) -> Path:
    (folder / "job.toml").write_bytes(damaged_toml(chance.choice((FULL, FULL, STAGED)), chance))
    return folder / "job.toml"


def read_again(file: Path) -> None:
    """Read a job, write it, and read what was written."""
    job = read_job(file)
    text = lock_text(job, {})
    file.write_text(text, encoding="utf-8")
    assert read_job(file) == job


def damaged_lock(chance: random.Random, folder: Path) -> Path:
    whole = lock().encode()
    cut = chance.random() < 0.3
    (folder / LOCK).write_bytes(whole[: chance.randrange(len(whole))] if cut else damaged_toml(lock(), chance))
    return folder / LOCK


def use_lock(file: Path) -> None:
    """Read a lock file as that of a run that goes on, and as a job."""
    read_lock(file)
    check_same_job(base(), file.parent)
    read_job(file)


def damaged_study(chance: random.Random, folder: Path) -> Path:
    _written(folder / "job.toml", FULL)
    _written(folder / "designs.csv", DESIGNS)
    kind = chance.choice(("study", "study", "table", "optimization"))
    text = {"study": STUDY, "table": TABLE_STUDY, "optimization": OPTIMIZATION}[kind]
    (folder / f"{kind}.toml").write_bytes(damaged_toml(text, chance))
    return folder / f"{kind}.toml"


def use_study(file: Path) -> None:
    study = read_study_file(file)
    assert study.sweep is None or 0 < len(study.sweep.designs.values) <= 100_000


def damaged_designs(chance: random.Random, folder: Path) -> Path:
    rows = [line.split(",") for line in DESIGNS.splitlines()]
    kind = chance.randrange(4)
    if kind == 0:
        content = changed_bytes(DESIGNS.encode(), chance)
    elif kind == 1:
        content = changed_text(DESIGNS, chance).encode()
    else:
        for _ in range(chance.choice((1, 1, 2, 5))):
            row = chance.choice(rows)
            if row:
                row[chance.randrange(len(row))] = chance.choice(JUNK_CELLS)
            if chance.random() < 0.2:
                rows.insert(chance.randrange(len(rows) + 1), list(chance.choice(rows)))
            if chance.random() < 0.1:
                del chance.choice(rows)[:1]
        content = "\n".join(",".join(row) for row in rows).encode(chance.choice(("utf-8", "utf-8", "utf-16")))
    (folder / "designs.csv").write_bytes(content)
    return folder / "designs.csv"


def use_designs(file: Path) -> None:
    """Read a table with the numbers of a job and by itself, and in half of the cases as the table of a study."""
    if len(file.read_bytes()) % 2:
        _written(file.parent / "job.toml", FULL)
        read_study_file(_written(file.parent / "study.toml", TABLE_STUDY))
    else:
        read_designs(file, numbers())
        read_designs(file)


def damaged_material(chance: random.Random, folder: Path) -> Path:
    (folder / "rubber.toml").write_bytes(damaged_toml(chance.choice(materials()), chance))
    return folder / "rubber.toml"


def use_material(file: Path) -> None:
    for record in read_records(file):
        assert record.law is not None
        repr(record)


CASES = (
    Case(name="jobs", share=1500, damage=damaged_job, read=read_again),
    Case(name="lock files", share=300, damage=damaged_lock, read=use_lock),
    Case(name="studies", share=1000, damage=damaged_study, read=use_study),
    Case(name="tables of designs", share=1000, damage=damaged_designs, read=use_designs),
    Case(name="materials", share=700, damage=damaged_material, read=use_material),
)

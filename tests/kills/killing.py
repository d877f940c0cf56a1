"""Kills: a command in a process group of its own, ended by SIGKILL at a moment, and what must hold after it."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from kill_cases import FILES, Case, Kept, going_on, outcome

STRUCK = Path(__file__).with_name("struck.py")

#: Time [s] in which all processes of a command that was killed have ended, and time after which a command hangs.
GONE, HANGS = 60.0, 300.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """When a command is killed, and what of it.

    Parameters
    ----------
    seconds : float
        After its start; infinite where an operation counts.
    operation : int
        Number of the operation on files before which it kills itself; 0 where the time counts.
    whom : str
        ``main``, ``group`` or ``worker``.
    """

    seconds: float = float("inf")
    operation: int = 0
    whom: str = "main"


@dataclass(slots=True)
class Bench:
    """A folder with the files of all cases, the caches, and the undisturbed outcome of each case.

    Parameters
    ----------
    folder : Path
    """

    folder: Path
    references: dict[str, tuple[dict[str, object], float, int]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, text in FILES.items():
            (self.folder / name).write_text(text, encoding="utf-8")

    def reference(self, name: str, case: Case) -> tuple[dict[str, object], float, int]:
        """Return what a case gives undisturbed, how long it takes [s], and how many operations on files it has."""
        if name not in self.references:
            results, count = self.folder / "results", self.folder / "count"
            caches = self.caches(cold=False)
            if not case.cold:  # fills the caches
                code, said = self.ended(case, results, caches)
                assert code == 0, said
                shutil.rmtree(results)
            self.prepare(case, results, caches)
            begun = time.monotonic()
            code, said = self.ended(case, results, self.caches(case.cold), more=case.first, count=count)
            assert code == 0, said
            taken = time.monotonic() - begun
            self.references[name] = outcome(results), taken, int(count.read_text(encoding="utf-8"))
            shutil.rmtree(results)
        return self.references[name]

    def caches(self, cold: bool) -> dict[str, str]:
        """Return the variables that name caches; cold ones are emptied, others have the loops that are compiled."""
        folder = self.folder / ("cold" if cold else "caches")
        if cold:
            shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(exist_ok=True)
        return {"TURGOR_CACHE": str(folder), **({"NUMBA_CACHE_DIR": str(folder / "numba")} if cold else {})}

    def prepare(self, case: Case, results: Path, caches: dict[str, str]) -> None:
        """Put the results of an earlier run into the folder, where a case has one."""
        if case.before:
            kept = self.folder / "before"
            if not kept.exists():
                code, said = self.ended(Case(command=case.before), kept, caches)
                assert code == 0, said
            shutil.copytree(kept, results)

    def started(
        self, case: Case, results: Path, caches: dict[str, str], *, more: tuple[str, ...] = (), operation: int = 0,
        count: Path | None = None,
    ) -> "subprocess.Popen[str]":  # fmt: skip
        """Start a command in a process group of its own."""
        own = [sys.executable, str(STRUCK), str(operation), str(results), str(count or self.folder / "count")]
        return subprocess.Popen(
            [*own, *case.command, *more, "--output", str(results)],
            cwd=self.folder, env={**os.environ, **caches}, start_new_session=True, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip

    def ended(
        self, case: Case, results: Path, caches: dict[str, str], *, more: tuple[str, ...] = (),
        count: Path | None = None,
    ) -> tuple[int, str]:  # fmt: skip
        """Run a command to its end; return its code and what it said."""
        process = self.started(case, results, caches, more=more, count=count)
        said, _ = process.communicate(timeout=HANGS)
        check_gone(process.pid)
        return process.returncode, said


def killed(bench: Bench, case: Case, results: Path, caches: dict[str, str], moment: Moment,
           more: tuple[str, ...]) -> tuple[bool, str]:  # fmt: skip
    """Start a command and kill it; return whether it was killed before it ended, and what it said."""
    process = bench.started(case, results, caches, more=more, operation=moment.operation)
    try:
        said, _ = process.communicate(timeout=min(moment.seconds, HANGS))
        struck = process.returncode == -signal.SIGKILL
        assert struck or process.returncode == 0, said
    except subprocess.TimeoutExpired:
        assert moment.seconds < HANGS, f"it hangs: {moment}"
        struck = strike(process, moment.whom)
        said, _ = process.communicate(timeout=HANGS)
    check_gone(process.pid)
    return struck, said


def strike(process: "subprocess.Popen[str]", whom: str) -> bool:
    """Kill a process, its group, or one of its workers; return whether there was one."""
    if whom == "group":
        os.killpg(process.pid, signal.SIGKILL)
        return True
    if whom == "main":
        process.kill()
        return True
    workers = [each for each in alive(process.pid) if each != process.pid]
    if workers:
        os.kill(max(workers), signal.SIGKILL)  # the first one tracks resources
    return bool(workers)


def alive(group: int) -> list[int]:
    """Return the processes of a group that have not ended."""
    results = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, of = stat.read_text(encoding="utf-8").rsplit(")", 1)[1].split()[:3]
        except OSError:
            continue
        if int(of) == group and state != "Z":
            results.append(int(stat.parent.name))
    return results


def check_gone(group: int) -> None:
    """Check that all processes of a command end soon after it."""
    end = time.monotonic() + GONE
    while left := alive(group):
        assert time.monotonic() < end, f"processes {left} are left"
        time.sleep(0.02)


def check_whole(results: Path, before: dict[str, object] | None) -> None:
    """Check what a killed process left: small files are whole, and the results of an earlier run are not lost."""
    for file in results.rglob("*.json"):
        json.loads(file.read_text(encoding="utf-8"))
    for file in results.rglob("*.toml"):
        assert tomllib.loads(file.read_text(encoding="utf-8")), f"'{file}' is empty"
    if before is not None and not (results / "path" / "solution.turgor").exists():
        result = [results / place / "response.csv" for place in ("", ".previous", "previous")]
        assert before["response.csv"] in [outcome(each.parent).get(each.name) for each in result if each.exists()]


def chain(bench: Bench, name: str, case: Case, chance: random.Random) -> list[tuple[Moment, float]]:
    """Kill a command, then what goes on with it, a few times; let it end, and check all that it leaves.

    Returns
    -------
    list of (Moment, float)
        Each kill that struck, and its moment as a share of the whole command.
    """
    reference, lasts, operations = bench.reference(name, case)
    results = bench.folder / "results"
    shutil.rmtree(results, ignore_errors=True)  # of a chain that failed
    caches = bench.caches(case.cold)
    bench.prepare(case, results, caches)
    before = outcome(results) if case.before else None
    kills: list[tuple[Moment, float]] = []
    options = case.first
    for _ in range(chance.choice([1, 2, 3, 5, 8])):
        moment = drawn(case, lasts, operations, chance)
        kept = Kept.of(case, results, options)
        struck, said = killed(bench, case, results, caches, moment, options)
        kept.check(said)
        if struck:
            kills.append((moment, moment.operation / operations if moment.operation else moment.seconds / lasts))
            check_whole(results, before)
        options = going_on(case, results)
    kept = Kept.of(case, results, options)
    code, said = bench.ended(case, results, caches, more=options)
    assert code == 0, f"{kills}: {said}"
    kept.check(said)
    result = outcome(results)
    assert sorted(result) == sorted(reference), f"{kills}: {sorted(set(result) ^ set(reference))}"
    differ = [file for file in reference if result[file] != reference[file]]
    assert not differ, f"{kills}: {differ}"
    shutil.rmtree(results)
    return kills


def drawn(case: Case, lasts: float, operations: int, chance: random.Random) -> Moment:
    """Draw a moment: a time after the start, or one of the operations on files."""
    whom = chance.choice(["main", "group", "worker"] if case.workers else ["main", "group"])
    if chance.random() < (0.2 if case.cold else 0.5) and whom != "worker":
        return Moment(operation=chance.randint(1, operations))
    return Moment(seconds=chance.uniform(0.02, 1.0) * lasts, whom=whom)

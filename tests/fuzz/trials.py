"""Tries damaged files in forked processes, each within its memory and time: none may end turgor or stop it.

A warm process forks one for a batch of files. If that one dies or does not end, the next goes on behind the file at
which it happened. The same number of a case makes the same file, so each failure can be repeated.
"""

import faulthandler
import os
import pickle
import random
import select
import shutil
import signal
import sys
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mutants import check_sentence

from turgor.foundation.errors import TurgorError

#: Most bytes that a process may hold, and most seconds for a file.
MEMORY, SECONDS = 2_000_000_000, 60.0

#: Files of a process.
BATCH = 250


@dataclass(frozen=True, kw_only=True)
class Case:
    """A kind of file.

    Parameters
    ----------
    name : str
    share : int
        How many of 10,000 files are of this kind.
    damage : callable
        Writes a damaged file into a folder and returns its path.
    read : callable
        Reads it and uses what was read.
    longest : callable, optional
        Of a file that turgor reads in a child process of its own, whose death it reports in a sentence: seconds after
        which it stops that process.
    """

    name: str
    share: int
    damage: Callable[[random.Random, Path], Path]
    read: Callable[[Path], None]
    longest: Callable[[Path], float] | None = None


@dataclass(kw_only=True)
class Tally:
    """What became of the files of a case."""

    name: str
    accepted: int = 0
    refused: int = 0
    died: int = 0
    slowest: float = 0.0
    slowest_number: int = 0
    memory: float = 0.0
    seconds: float = 0.0
    failures: list[str] = field(default_factory=list)

    @property
    def tried(self) -> int:
        return self.accepted + self.refused + self.died + len(self.failures)

    def row(self) -> str:
        return (
            f"| {self.name} | {self.tried} | {self.refused} | {self.accepted} | {self.died} | {len(self.failures)} "
            f"| {self.slowest:.1f} s (no. {self.slowest_number}) | {self.memory:.0f} MB | {self.seconds:.0f} s |"
        )


HEAD = (
    "| files | tried | refused | accepted | CAD process died or was stopped | failed | slowest | most memory | all |\n"
    "|---|---|---|---|---|---|---|---|---|"
)


def apart(make: Callable[[], Any]) -> Any:
    """Return what a function makes, in a process of its own: the threads of the CAD kernel do not survive a fork."""
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            with os.fdopen(theirs, "wb") as pipe:
                pickle.dump(make(), pipe)
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(0)
    os.close(theirs)
    with os.fdopen(ours, "rb") as pipe:
        made = pickle.load(pipe)
    os.waitpid(child, 0)
    return made


def try_all(case: Case, numbers: list[int], folder: Path) -> Tally:
    """Try the files of a case with these numbers."""
    tally, begin = Tally(name=case.name), time.perf_counter()
    with TemporaryDirectory() as spare:
        case.damage(random.Random(0), Path(spare))  # what all of them need is made before the forks
    while numbers:
        numbers = numbers[_batch(case, numbers[:BATCH], folder, tally) :]
    tally.seconds = time.perf_counter() - begin
    return tally


def _batch(case: Case, numbers: list[int], folder: Path, tally: Tally) -> int:
    """Try files in one process, and return how many were tried."""
    folder.mkdir(parents=True, exist_ok=True)
    ours, theirs = os.pipe()
    child = os.fork()
    if child == 0:
        _serve(case, numbers, folder, theirs)
    os.close(theirs)
    done, begun, limit = 0, time.perf_counter(), 0.0
    for line in _lines(ours, SECONDS + 5):
        what, _, rest = line.partition(" ")
        if what == "begun":
            begun, limit = time.perf_counter(), float(rest)
            continue
        _count(tally, what, rest, numbers[done], time.perf_counter() - begun)
        done += 1
    os.close(ours)
    os.kill(child, signal.SIGKILL)  # it has ended, or it hangs
    status = os.waitpid(child, 0)[1]
    if done < len(numbers):
        signaled = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
        spent = time.perf_counter() - begun
        if case.longest and (signaled not in (0, signal.SIGKILL) or limit <= SECONDS):
            _count(tally, "died", "", numbers[done], min(spent, limit))
        else:
            how = "does not end" if signaled == signal.SIGKILL else f"ends the process (status {status})"
            _count(tally, "failed", how, numbers[done], spent)
        done += 1
    shutil.rmtree(folder, ignore_errors=True)
    return done


def _count(tally: Tally, what: str, rest: str, number: int, spent: float) -> None:
    memory, _, text = rest.partition(" ") if what in ("accepted", "refused", "failed") and rest[:1].isdigit() else (
        "0", "", rest)  # fmt: skip
    tally.memory = max(tally.memory, float(memory))
    if spent > tally.slowest:
        tally.slowest, tally.slowest_number = spent, number
    if spent > SECONDS:
        what, text = "failed", f"took {spent:.0f} s"
    elif what != "failed" and float(memory) > MEMORY / 1e6:
        what, text = "failed", f"took {memory} MB"
    if what == "failed":
        tally.failures.append(f"{tally.name} {number}: {text}")
    else:
        setattr(tally, what, getattr(tally, what) + 1)


def _lines(pipe: int, longest: float) -> Iterator[str]:
    """Lines from a process, until it ends or is silent for too long."""
    rest = b""
    while select.select([pipe], [], [], longest)[0]:
        read = os.read(pipe, 1 << 16)
        if not read:
            return
        *lines, rest = (rest + read).split(b"\n")
        yield from (line.decode() for line in lines)


def _serve(case: Case, numbers: list[int], folder: Path, pipe: int) -> None:
    """Try files and write what became of each; this process ends here."""

    def say(text: str) -> None:
        os.write(pipe, (text.replace("\n", "\\n")[:50_000] + "\n").encode())

    _limit_memory()
    if case.longest:  # what it says when it dies is no matter
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
    try:
        for number in numbers:
            place = folder / str(number)
            place.mkdir()
            file = case.damage(random.Random(f"{case.name} {number}"), place)
            say(f"begun {case.longest(file) if case.longest else 0}")
            faulthandler.dump_traceback_later(SECONDS - 5)
            what = _tried(case, file)
            memory = f"{_held('VmHWM') / 1e6:.0f}"
            shutil.rmtree(place, ignore_errors=True)
            say(f"{what.partition(' ')[0]} {memory} {what.partition(' ')[2]}")
        os._exit(0)
    except BaseException:
        say(f"failed {traceback.format_exc()}")
    finally:
        os._exit(3)


def _tried(case: Case, file: Path) -> str:
    try:
        case.read(file)
    except TurgorError as error:
        try:
            check_sentence(error)
        except AssertionError:
            return f"failed no sentence: {str(error)[:300]} … {str(error)[-300:]}"
        return "refused"
    except Exception as error:
        if case.longest and not isinstance(error, AssertionError):
            return "refused"  # `in_child` makes it a sentence
        return f"failed {traceback.format_exc()[-3000:]}"
    return "accepted"


def _limit_memory() -> None:
    """Let this process take as much more memory as is left of `MEMORY`; addresses that are only reserved are free."""
    if sys.platform != "linux":
        return
    import resource

    most = MEMORY - _held("VmRSS") + _held("VmSize")
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _held(what: str) -> int:
    """Bytes of this process: ``VmRSS`` now, ``VmHWM`` at most, ``VmSize`` of addresses; 0 where nothing tells."""
    try:
        text = Path("/proc/self/status").read_text("ascii")
    except OSError:
        return 0
    return next((1024 * int(line.split()[1]) for line in text.splitlines() if line.startswith(f"{what}:")), 0)

"""Children: runs and studies that the studio has started, each with a small file from which a new server knows it."""

import json
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from threading import Thread
from typing import Any
from urllib.parse import quote

from filelock import FileLock

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import write_whole
from turgor.studio.children.process import begin, birth, end, interrupt
from turgor.studio.workspace import Workspace, read_json


@dataclass(frozen=True, slots=True, kw_only=True)
class Child:
    """A process that the studio has started.

    Parameters
    ----------
    name : str
        Its folder of results in the workspace.
    kind : str
        ``"run"``, ``"coarse"``, or a kind of study.
    job : str
        The file that it computes.
    arguments : tuple of str
        Of the command.
    module : str
        What Python runs.
    pid, born : int, str
        The process, and when it began.
    started : float [s]
        Time of day.
    code : int or None
        Exit code, where a server saw the end.
    after : tuple of dict
        What begins when it has ended by itself.
    """

    name: str
    kind: str
    job: str
    arguments: tuple[str, ...]
    module: str = "turgor"
    pid: int = 0
    born: str = ""
    started: float = 0.0
    code: int | None = None
    after: tuple[dict[str, Any], ...] = ()

    @property
    def alive(self) -> bool:
        """Whether its process still runs."""
        return bool(self.born) and birth(self.pid) == self.born


@dataclass(frozen=True, slots=True)
class Children:
    """The processes of a workspace.

    Parameters
    ----------
    workspace : Workspace
    """

    workspace: Workspace

    def log(self, name: str) -> Path:
        """File of what a process has printed."""
        return self.workspace.own("runs") / f"{quote(name, safe='')}.log"

    def get(self, name: str) -> Child | None:
        """Return what is known of a process by the name of its folder of results; None where none was started."""
        return _read(self._file(name))

    def all(self) -> list[Child]:
        """Return all processes that are known, the latest first; start what waited for one that has ended."""
        known = [child for file in self.workspace.own("runs").glob("*.json") if (child := _read(file))]
        for child in known:
            if child.after and not child.alive:
                self._follow(child.name)
        return sorted(known, key=lambda each: -each.started)

    def start(self, child: Child) -> Child:
        """Start a process, unless one writes into the same folder.

        Raises
        ------
        TurgorError
            If it runs already, so that nothing is computed twice.
        """
        with self._lock():
            return self._start(child)

    def interrupt(self, name: str) -> None:
        """Let a process write what it has and end; it can go on later."""
        child = self._running(name)
        self._save(replace(child, after=()))
        interrupt(child.pid)

    def stop(self, name: str) -> None:
        """End a process within a second."""
        child = self._running(name)
        self._save(replace(child, after=()))
        end(child.pid, child.born)

    def _start(self, child: Child) -> Child:
        before = self.get(child.name)
        if before is not None and before.alive:
            raise TurgorError(f"'{child.name}' is being computed already; nothing is started twice.")
        process = begin(child.module, child.arguments, self.workspace.folder, self.log(child.name))
        begun = replace(child, pid=process.pid, born=birth(process.pid), started=time.time(), code=None)
        self._save(begun)
        Thread(target=self._wait, args=(begun, process), daemon=True).start()
        return begun

    def _wait(self, child: Child, process: Any) -> None:
        """Note the exit code of a process, and start what comes after it."""
        code = process.wait()
        with self._lock():
            now = self.get(child.name)
            if now is not None and (now.pid, now.born) == (child.pid, child.born):
                self._save(replace(now, code=code))
        self._follow(child.name)

    def _follow(self, name: str) -> None:
        with self._lock():
            child = self.get(name)
            if child is None or not child.after or child.alive:
                return
            self._save(replace(child, after=()))
            for each in child.after:
                follower = Child(**{**each, "arguments": tuple(each["arguments"])})
                before = self.get(follower.name)
                if before is None or not before.alive:
                    self._start(follower)

    def _running(self, name: str) -> Child:
        child = self.get(name)
        if child is None or not child.alive:
            raise TurgorError(f"'{name[:120]}' is not being computed.")
        return child

    def _save(self, child: Child) -> None:
        write_whole(self._file(child.name), json.dumps(asdict(child), indent=1))

    def _file(self, name: str) -> Path:
        return self.workspace.own("runs") / f"{quote(name, safe='')}.json"

    def _lock(self) -> FileLock:
        return FileLock(self.workspace.own("runs") / ".lock")


def waiting(child: Child) -> Iterator[str]:
    """Names of what comes after a process."""
    return (str(each["name"]) for each in child.after)


def _read(file: Path) -> Child | None:
    content = read_json(file)
    try:
        return Child(
            **{**content, "arguments": tuple(content["arguments"]), "after": tuple(content["after"])}  # type: ignore[arg-type]
        )
    except (KeyError, TypeError):
        return None  # damaged, or of another version

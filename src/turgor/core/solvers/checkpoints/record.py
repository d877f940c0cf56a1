"""Run record: a folder in which a solve saves its question and every accepted state, and from which it can continue."""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.model.model import Model
from turgor.core.solvers.checkpoints.checkpoint_data import LoopSoFar, PathSoFar
from turgor.core.solvers.procedures.procedure import Procedure
from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding
from turgor.foundation.store.folder import Store, write_index
from turgor.foundation.store.saved_objects import ENDING

#: The file that names the present archives.
INDEX = "index.json"

#: Archives that stay: the question, that of each stage, and the solution.
QUESTION, STAGE_MODEL, SOLUTION = "question", "model", "solution"

#: Archives that later ones replace.
_GOES = re.compile(r"(model|state|path|loop)(-\d+)+")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Question:
    """Question of a run: the model and procedure, the similar run that guides it, and the findings before it begins.

    Parameters
    ----------
    model : Model
    procedure : Procedure
    options : EngineOptions
    findings : tuple of Finding or None
        Findings of the checks before the solve; None where these are still to run.
    guide : Solution or None
    """

    model: Model
    procedure: Procedure
    options: EngineOptions
    findings: tuple[Finding, ...] | None = None
    guide: Solution | None = None


@dataclass(slots=True, eq=False)
class RunRecord:
    """The record of a run.

    Parameters
    ----------
    store : Store
    stages : list of list of (str, str)
        Of each stage the archives of each of its loops: the path, and the loop.
    on_checkpoint : callable or None
        ``on_checkpoint()``, called after each checkpoint.
    """

    store: Store
    stages: list[list[list[str]]] = field(default_factory=list)
    on_checkpoint: Callable[[], None] | None = None
    _paths: list[PathSoFar] = field(default_factory=list)
    _question: Question | None = None
    _written: int = 0
    _next: int = 0

    @staticmethod
    def create(folder: Path, question: Question) -> "RunRecord":
        """Begin a record; the folder is made where it does not exist.

        Raises
        ------
        TurgorError
            If the folder holds a record already, or the question holds a function.
        OSError
            If it cannot be written.
        """
        if (folder / INDEX).exists():
            raise TurgorError(
                f"'{folder}' holds the path of a run; `turgor.resume` goes on with it, or name another folder."
            )
        folder.mkdir(parents=True, exist_ok=True)
        plain = replace(question, options=replace(question.options, notify=None))
        record = RunRecord(Store(folder), _question=plain)
        record.store.keep(QUESTION, plain, "Question")
        record._point()
        return record

    @staticmethod
    def open(folder: Path) -> "RunRecord":
        """Open the record of a run.

        Raises
        ------
        TurgorError
            If the folder holds none, or its index is damaged.
        """
        try:
            index = json.loads((folder / INDEX).read_text("utf-8"))
            stages, written = index["stages"], index["written"]
        except FileNotFoundError:
            raise TurgorError(f"'{folder}' holds no path of a run.") from None
        except (ValueError, LookupError, TypeError):
            raise TurgorError(f"'{folder / INDEX}' is damaged.") from None
        record = RunRecord(Store(folder), stages, _written=written)
        record.store.add_orphans(file.stem for file in folder.glob(f"*{ENDING}") if _GOES.fullmatch(file.stem))
        return record

    @property
    def question(self) -> Question:
        """The question of the run."""
        if self._question is None:
            self._question = self.store.read(QUESTION)
        return self._question

    def stage(self, model: Model) -> "tuple[StageRecord, Model]":
        """Begin the next stage; return its record and its model, the one that is on file where there is one."""
        number, self._next = self._next, self._next + 1
        name = f"{STAGE_MODEL}-{number}"
        if number == len(self.stages):
            self.stages.append([])
            if not self.store.knows(model):
                self.store.keep(name, model, "Model")
            self._point()
        elif self.store.has(name):
            model = self.store.read(name)
        return StageRecord(self, number), model

    @property
    def ended(self) -> bool:
        """Whether the whole solution is on file."""
        return self.store.has(SOLUTION)

    def finish(self, solution: Solution) -> None:
        """Save the whole solution, and remove all files that it does not need."""
        self.store.keep(SOLUTION, solution, "Solution")
        self.stages = []
        self._point()

    def solution(self) -> Solution | None:
        """Return the solution; None where the run has not ended."""
        return self.store.read(SOLUTION) if self.ended else None

    def finished(self) -> Solution | None:
        """Return the solution, if there is one, and remove the files of a process that was killed after it."""
        solution = self.solution()
        if self.stages and solution is not None:
            self.stages = []
            self._point()
        elif solution is not None:
            self.store.forget([QUESTION, SOLUTION])
        return solution

    def paths(self) -> list[PathSoFar]:
        """Return the saved path of each stage."""
        for number, loops in enumerate(self.stages[len(self._paths) :], start=len(self._paths)):
            if loops:
                self._paths[number:] = [self.store.read(loops[-1][0], noted=True)]
        return list(self._paths)

    def _point(self) -> None:
        """Name the present archives in the index, then remove the others."""
        write_index(self.store.folder / INDEX, {"stages": self.stages, "written": self._written})
        named = [name for loops in self.stages for loop in loops for name in loop]
        models = [f"{STAGE_MODEL}-{number}" for number in range(len(self.stages))]
        self.store.forget([QUESTION, SOLUTION, *models, *named])


@dataclass(slots=True, eq=False)
class StageRecord:
    """The record of one stage, or of a procedure that stands alone."""

    run: RunRecord
    number: int
    _loops: int = 0

    def of(self, system: System) -> "StageRecord":
        """Set the equations, which checkpoints name and do not contain."""
        self.run.store.named["system"] = system
        return self

    @property
    def goes_on(self) -> bool:
        """Whether the next loop has a checkpoint."""
        return self._loops < len(self.run.stages[self.number])

    def begun(self) -> tuple[PathSoFar, LoopSoFar] | None:
        """Count a loop, and return its last checkpoint; None where it has none."""
        number, self._loops = self._loops, self._loops + 1
        loops = self.run.stages[self.number]
        if number >= len(loops):
            return None
        path, loop = (self.run.store.read(name, noted=True) for name in loops[number])
        return path, loop

    def keep(self, path: PathSoFar, loop: LoopSoFar) -> None:
        """Save a checkpoint: new states first, each in a file of its own, then how far the loop has come."""
        store, loops = self.run.store, self.run.stages[self.number]
        before = self.run.paths()[: self.number]
        for state in path.states:
            if not store.knows(state):
                store.keep(self._name("state"), state, "State")
        names = [self._name("path"), self._name("loop")]
        store.note(names[0], path, "PathSoFar")
        store.note(names[1], loop, "LoopSoFar")
        del loops[self._loops - 1 :]
        loops.append(names)
        self.run._point()
        self.run._paths = [*before, path]
        if self.run.on_checkpoint is not None:
            self.run.on_checkpoint()

    def _name(self, kind: str) -> str:
        self.run._written += 1
        return f"{kind}-{self.number}-{self.run._written:06d}"

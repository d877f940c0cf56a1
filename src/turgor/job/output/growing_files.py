"""Growing files: the response, the steps and the log of a run while it runs, so that nothing is lost with it.

With several threads the states are measured on one of them, while the next step is solved.
"""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

from turgor.core.engine.compiled import THREADS
from turgor.core.results.fields.path_fields import PathFields
from turgor.core.results.measures.measures import Reader
from turgor.core.solvers.checkpoints.record import RunRecord
from turgor.core.solvers.load import PATH_FOLDER, saved_path
from turgor.core.solvers.solution import Solution
from turgor.foundation.response import Response
from turgor.foundation.store.atomic_files import write_whole
from turgor.job.job import Job
from turgor.job.output.folder import LOCK, LOG, RESPONSE, STEPS
from turgor.job.output.identity import digest_of, read_lock
from turgor.job.output.lock import lock_text
from turgor.job.output.manifest import list_files, note_job
from turgor.job.output.tables import write_steps
from turgor.job.output.versions import versions

#: Tables that take longer than this [s] to write wait until they are this small a share of the time.
AT_ONCE, SHARE = 0.05, 0.05


@dataclass(slots=True, eq=False)
class GrowingFiles:
    """Files of a run that grow with its path.

    Parameters
    ----------
    folder : Path
        Of the results.
    job : Job
        With the number of threads.
    notify : callable
        Where notices go besides the log.

    Attributes
    ----------
    notices : list of str
        Notices up to now.
    """

    folder: Path
    job: Job
    notify: Callable[[str], None]
    notices: list[str] = field(default_factory=list, init=False)
    _reader: Reader | None = None
    _fields: PathFields | None = None
    _worker: ThreadPoolExecutor | None = None
    _writing: Future[None] | None = None
    _took: float = 0.0
    _ended: float = 0.0
    _begun: bool = False

    def begin(self) -> None:
        """Write the lock file and the notices so far, before the solve."""
        list_files(self.folder, (RESPONSE, STEPS, LOG, LOCK, PATH_FOLDER))
        self.lock()
        note_job(self.folder, digest_of(self.job))
        write_whole(self.folder / LOG, "\n".join((f"job {self.job.name}", *self.notices, "")))
        self._begun = True

    def go_on(self) -> None:
        """Go on with the files of a run that was ended; a lock file that is damaged or missing is written again."""
        self._begun = True
        if (self.folder / LOG).is_symlink():  # lines are appended to it: they would follow the link
            (self.folder / LOG).unlink()
        if read_lock(self.folder / LOCK) is None:
            self.lock()
            self.say(f"'{LOCK}' was damaged or missing, and is written again")

    def lock(self) -> None:
        """Write the lock file."""
        write_whole(self.folder / LOCK, lock_text(self.job, versions()))

    def say(self, text: str) -> None:
        """Note an activity, in the log too if it has begun, and pass it on."""
        self.notices.append(text)
        self._log(text)
        self.notify(text)

    def _log(self, line: str) -> None:
        if self._begun:
            with (self.folder / LOG).open("a", encoding="utf-8") as log:
                log.write(f"{line}\n")

    def grow(self, record: RunRecord) -> None:
        """Write the response and the steps of the path so far, and the last step into the log.

        Tables of thousands of rows are not written after every short step; the states themselves are on disk. Nor are
        they where those of the step before are still being written.
        """
        path = record.paths()[-1]
        if path.steps:
            factor, iterations = path.states[-1].load_factor, path.steps[-1].iterations
            self._log(f"step {len(path.steps)}: load factor {factor:.6g}, {iterations} iterations")
        if self._writing is not None and not self._writing.done():
            return
        self.close()
        if self._took > AT_ONCE and self._took > SHARE * (perf_counter() - self._ended):
            return
        if self.job.threads == 1:
            self._write(saved_path(record))
            return
        # its loops stay on that thread, because the solve needs the others
        self._worker = self._worker or ThreadPoolExecutor(1, "turgor-tables", THREADS.set, (1,))
        self._writing = self._worker.submit(self._write, saved_path(record))

    def _write(self, solution: Solution) -> None:
        began = perf_counter()
        self._measured(solution).to_csv(self.folder / RESPONSE)
        write_steps(self.folder / STEPS, solution)
        self._ended = perf_counter()
        self._took = self._ended - began

    def close(self) -> None:
        """Wait until what was begun is written; an error of it is raised here."""
        writing, self._writing = self._writing, None
        if writing is not None:
            writing.result()

    def response(self, solution: Solution) -> Response:
        """Return what the job measures of a path; states that were measured before are not measured again."""
        self.close()
        return self._measured(solution)

    def fields(self, solution: Solution) -> PathFields:
        """Return the fields of a path, those of the states that were measured among them."""
        self._fields = PathFields(solution) if self._fields is None else self._fields.grown(solution)
        return self._fields

    def _measured(self, solution: Solution) -> Response:
        output = self.job.output
        self._reader = self._reader or Reader(output.chosen())
        shown = output.fields or output.report  # what is drawn of all states
        return self._reader.response(solution, self.fields(solution) if shown else None)

"""Checking: one check at a time; one of a newer text replaces one of an older text of the same file."""

import asyncio
import time
from dataclasses import dataclass, field
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.studio.settings import STUDIO
from turgor.studio.worker import Worker


@dataclass(slots=True, eq=False)
class Checking:
    """A worker for checks alone, because it may be killed while it meshes a part that has changed.

    Parameters
    ----------
    worker : Worker
    """

    worker: Worker
    _latest: dict[str, int] = field(default_factory=dict)
    _lock: asyncio.Lock = field(default_factory=asyncio.Lock)
    _now: str = ""
    _since: float = 0.0

    async def do(self, name: str, task: str, *values: Any) -> Any:
        """Run a task for a file; return None where a newer one has replaced it.

        Raises
        ------
        TurgorError
            That the task has raised.
        """
        own = self._latest[name] = self._latest.get(name, 0) + 1
        if self._now == name and time.monotonic() - self._since > STUDIO.impatient:
            self.worker.stop()
        async with self._lock:
            if self._latest[name] != own:
                return None
            self._now, self._since = name, time.monotonic()
            try:
                return await self.worker.do(task, *values)
            except TurgorError:
                if self._latest[name] != own:
                    return None
                raise
            finally:
                self._now = ""

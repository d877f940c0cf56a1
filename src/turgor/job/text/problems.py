"""Problems: all mistakes in one job file, collected and reported together."""

import re
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TypeVar

from turgor.foundation.errors import TurgorError, shortened
from turgor.job.text.lines import Key, Place

Value = TypeVar("Value")

#: What problems of a changed key begin with: the argument of `read_job` in Python, the option on the command line.
ARGUMENT, OPTION = "changes", "--set"

#: Line number of keys that are absent from the file; their problems come last.
_NOWHERE = sys.maxsize


class JobError(TurgorError):
    """Error about a job file, with one line for each problem.

    Parameters
    ----------
    problems : iterable of str
        Sentences that begin with file, line and key.
    """

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems = tuple(map(shortened, problems))
        beginning = f"{ARGUMENT}: "
        on_command_line = (
            f"{OPTION}: {each.removeprefix(beginning)}" if each.startswith(beginning) else each
            for each in self.problems
        )
        super().__init__(python="\n".join(self.problems), command="\n".join(on_command_line))


@dataclass(slots=True)
class Problems:
    """The problems of one file.

    Parameters
    ----------
    file : str
        Name of the file as the user gave it.
    lines : mapping of key to int or str
        Line of each key, from `key_lines`, or `ARGUMENT` if a change states it.
    entries : list of (int, str)
        Line and sentence of each problem.
    within : tuple of str
        Key of the table in which the keys of problems lie.
    """

    file: str
    lines: Mapping[Key, Place]
    entries: list[tuple[int, str]] = field(default_factory=list)
    within: Key = ()

    def below(self, key: Key) -> "Problems":
        """Return the problems of a table inside the file; its notes are noted here too."""
        return replace(self, within=(*self.within, *key))

    def head(self, key: Key) -> str:
        """Return the header of a table in the file: ``[loads]``, or ``[stages.loads]`` of a stage."""
        return f"[{'.'.join((*self.within[:1], *key))}]"

    @property
    def whole(self) -> "Problems":
        """The problems of the whole file."""
        return replace(self, within=())

    def add(self, key: Key, sentence: str) -> None:
        """Note a problem at a key; if the key is absent from the file, at the line of its table."""
        key = (*self.within, *key)
        place = next((self.lines[key[:n]] for n in range(len(key), 0, -1) if key[:n] in self.lines), None)
        line = place if isinstance(place, int) else _NOWHERE
        where = f"{self.file}:{place}" if isinstance(place, int) else place or self.file
        self.entries.append((line, f"{where}: {'.'.join(key)}: {sentence}"))

    def attempt(self, key: Key, make: Callable[[], Value], fields: Iterable[str] = ()) -> Value | None:
        """Make a value; note a `TurgorError` at the key, or at the field that its message begins with.

        Parameters
        ----------
        key : tuple of str
            Key of a table or value.
        make : callable
            Makes the value.
        fields : iterable of str
            Keys of the table that are fields of the value; the message names the one that is wrong.

        Returns
        -------
        The value, or None where it could not be made.
        """
        try:
            return make()
        except TurgorError as error:
            sentence = error.on_command_line
            match = re.match(r"(?:[^;]{0,80}?[.: ])?(\w+) (?:is|holds) ", sentence)
            if match is not None and match[1] in set(fields):
                key, sentence = (*key, match[1]), sentence[match.end() :]
            self.add(key, sentence)
            return None

    def raise_any(self) -> None:
        """Raise a `JobError` with all problems in the order of their lines, if there are any."""
        if self.entries:
            raise JobError(sentence for _, sentence in sorted(self.entries, key=lambda item: item[0]))

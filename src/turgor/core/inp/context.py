"""Context of an .inp file that is being written: its program, names, free numbers and account."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import count

from turgor.core.inp.account import APPROXIMATED, LEFT_OUT, WRITTEN, InpNote
from turgor.core.model.model import Model

#: The programs that have these files.
CALCULIX, ABAQUS = "calculix", "abaqus"

#: Numbers on a line of a set; the programs read up to 16.
PER_LINE = 12


@dataclass(frozen=True, slots=True)
class Context:
    """What all parts of a file share.

    Parameters
    ----------
    model : Model
    program : str
    elements, nodes : iterator of int
        Free numbers of cells and of nodes.
    notes : list of InpNote
        The account so far.
    """

    model: Model
    program: str
    elements: Iterator[int]
    nodes: Iterator[int]
    notes: list[InpNote] = field(default_factory=list)

    @staticmethod
    def of(model: Model, program: str) -> "Context":
        """Begin a file; each reference point of the model has two numbers of nodes after those of the mesh."""
        used = len(model.mesh.points) + 2 * len(model.points)
        return Context(model, program, count(len(model.mesh.cells) + 1), count(used + 1))

    @property
    def for_abaqus(self) -> bool:
        """Whether the file is for Abaqus."""
        return self.program == ABAQUS

    def written(self, what: str, text: str) -> None:
        """Note a part that is in the file."""
        self.notes.append(InpNote(what, WRITTEN, text))

    def approximated(self, what: str, text: str) -> None:
        """Note a part of which something like it is in the file."""
        self.notes.append(InpNote(what, APPROXIMATED, text))

    def left_out(self, what: str, text: str) -> None:
        """Note a part that the file lacks."""
        self.notes.append(InpNote(what, LEFT_OUT, text))


def plain(name: str) -> str:
    """Return a name as these programs take it: no blanks and commas.

    Examples
    --------
    >>> plain("soft, blue rubber")
    'soft__blue_rubber'
    """
    return "".join(letter if (letter.isalnum() and letter.isascii()) or letter in "_-" else "_" for letter in name)


def rows_of(numbers: Sequence[int], first: int = PER_LINE) -> list[str]:
    """Return numbers on as many lines as needed; all but the last end with a comma."""
    parts = [numbers[start : start + first] for start in range(0, len(numbers), first)]
    return [", ".join(map(str, part)) + ("," if i + 1 < len(parts) else "") for i, part in enumerate(parts)]

"""Account of an .inp file: what of a model was written as it is, what approximated, and what left out."""

from collections.abc import Iterable
from dataclasses import dataclass

#: What may become of a part of a model: it is in the file; something like it is; or the file lacks it.
WRITTEN, APPROXIMATED, LEFT_OUT = "written", "approximated", "left out"


@dataclass(frozen=True, slots=True)
class InpNote:
    """What became of one part of a model.

    Parameters
    ----------
    what : str
        The part, as a job file names it, such as ``"materials.body"``.
    verdict : str
        ``"written"``, ``"approximated"`` or ``"left out"``.
    text : str
        As what, or how it differs.

    Examples
    --------
    >>> print(InpNote("contact", "approximated", "penalty of 2 MPa/mm"))
    contact: approximated: penalty of 2 MPa/mm
    """

    what: str
    verdict: str
    text: str

    def __str__(self) -> str:
        return f"{self.what}: {self.verdict}: {self.text}"


def by_verdict(notes: Iterable[InpNote]) -> list[InpNote]:
    """Return notes on what differs first: what is left out, then what is approximated, then what is written."""
    order = (LEFT_OUT, APPROXIMATED, WRITTEN)
    return sorted(notes, key=lambda note: order.index(note.verdict))

"""Account of an import: what became of each keyword of a deck."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turgor.core.meshing.exchange.formats.abaqus import Keyword

#: What may become of a keyword: it is in the job; it changes no result; or the job lacks it.
TAKEN, NOT_NEEDED, MISSING = "taken", "not needed", "missing"


@dataclass(frozen=True, slots=True, kw_only=True)
class DeckRow:
    """What became of one keyword of a deck.

    Parameters
    ----------
    file : Path
        The deck, or a file that it includes.
    line : int
        Where the keyword stands.
    keyword : str
        In upper case, without its star; an element of a .feb file in its brackets.
    verdict : str
        ``"taken"``; ``"not needed"`` where it changes no result; ``"missing"`` where the job is another model
        without it.
    text : str
        As what it was understood, or why not.

    Examples
    --------
    >>> print(DeckRow(file=Path("a.inp"), line=7, keyword="TIE", verdict="missing", text="ties have no form"))
    a.inp:7 *TIE is missing: ties have no form
    """

    file: Path
    line: int
    keyword: str
    verdict: str
    text: str

    def __str__(self) -> str:
        what = "is missing" if self.verdict == MISSING else self.verdict
        return f"{self.file.name}:{self.line} {self.title} {what}: {self.text}"

    @property
    def title(self) -> str:
        """The keyword with its star, or the element."""
        return self.keyword if self.keyword.startswith("<") else f"*{self.keyword}"


@dataclass(slots=True)
class Account:
    """Rows of an import, in the order in which they are added."""

    rows: list[DeckRow] = field(default_factory=list)

    def taken(self, keyword: "Keyword", text: str) -> None:
        """Add a keyword that is in the job."""
        self._add(keyword, TAKEN, text)

    def not_needed(self, keyword: "Keyword", text: str) -> None:
        """Add a keyword that changes no result."""
        self._add(keyword, NOT_NEEDED, text)

    def missing(self, keyword: "Keyword", text: str) -> None:
        """Add a keyword without which the job is another model."""
        self._add(keyword, MISSING, text)

    def has(self, keyword: "Keyword") -> bool:
        """Whether a keyword has a row."""
        return any((row.file, row.line) == (keyword.path, keyword.line) for row in self.rows)

    def _add(self, keyword: "Keyword", verdict: str, text: str) -> None:
        row = DeckRow(file=keyword.path, line=keyword.line, keyword=shown(keyword), verdict=verdict, text=text)
        if row not in self.rows:
            self.rows.append(row)

    def sorted(self) -> tuple[DeckRow, ...]:
        """Rows in the order of the deck; those of included files in the order in which they were read."""
        files: dict[Path, int] = {}
        for row in self.rows:
            files.setdefault(row.file, len(files))
        return tuple(sorted(self.rows, key=lambda row: (files[row.file], row.line)))


def shown(keyword: "Keyword") -> str:
    """Return a keyword as a deck has it, with the parameters that say which one it is."""
    if keyword.label:
        return keyword.label
    telling = ("type", "name", "elset", "nset", "material", "time")
    parts = [f"{key.upper()}={value}" for key, value in keyword.given.items() if key in telling and value]
    parts += [key.upper() for key, value in keyword.given.items() if not value]
    return ", ".join([keyword.name.upper(), *parts])


def listed(words: Iterable[object], most: int = 4) -> str:
    """Return the first of some words, and how many more there are.

    Examples
    --------
    >>> listed([1, 2, 3, 4, 5, 6])
    '1, 2, 3, 4 and 2 more'
    """
    every = [str(word) for word in words]
    rest = len(every) - most
    return ", ".join(every[:most]) + (f" and {rest} more" if rest > 0 else "")

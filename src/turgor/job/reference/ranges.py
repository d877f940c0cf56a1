"""Ranges of keys: what the reader of a table answers to a value that no range holds."""

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from turgor.job.reference.kinds import Kind
from turgor.job.text.problems import Problems

#: Reads a table and notes what is wrong.
Reader = Callable[[Mapping[str, Any], Problems], object]

#: A magnitude that is out of every range.
_HUGE = 1e9

#: What a sentence about a wrong value says on the right ones, in the order in which to look.
_SENTENCES = tuple(
    re.compile(text)
    for text in (
        r"[Aa]llowed(?: is|:) (.+?)(?:; is the unit right\?)?\.?$",
        r"Known: (.+?)\.?$",
        r"; (?:it )?(?!did you mean)(.+?)\.?$",
        r", (?:but )?(.+?)\.?$",
    )
)


def range_of(name: str, kind: Kind, base: Mapping[str, Any], read: Reader) -> str:
    """Return the range of a key as the reader says it; empty where every value of the kind is allowed.

    Parameters
    ----------
    name : str
        The key.
    kind : Kind
        What it takes.
    base : mapping
        A table that the reader accepts.
    read : callable
        ``read(values, problems)``.

    Returns
    -------
    str
        Part of a sentence.
    """
    for value in _wrong(kind):
        problems = Problems("", {})
        read({**base, name: value}, problems)
        for _, sentence in problems.entries:
            head, _, rest = sentence.removeprefix(": ").partition(": ")
            if head.split(".")[-1] == name or re.search(rf"\b{name} (is|of) |'\?'", rest):
                return _allowed(rest)
    return ""


def _wrong(kind: Kind) -> Iterator[Any]:
    """Values of the right kind that are out of range."""
    if kind.words.startswith("text"):
        yield "?"
    elif kind.words.startswith("whole number"):
        yield from (-int(_HUGE), int(_HUGE))
    elif kind.words.startswith("number"):
        yield from (-_HUGE, _HUGE)
    elif kind.words.split(" or ")[0] == kind.dimension:
        yield from (f"{sign}{_HUGE:.0f} {kind.units[0]}" for sign in ("-", ""))


def _allowed(sentence: str) -> str:
    found = (pattern.search(sentence) for pattern in _SENTENCES)
    said = next((match[1] for match in found if match), sentence)
    return re.sub(r"^(?:must (?:be|lie)|Coulomb's coefficient lies|lies) ", "", said)

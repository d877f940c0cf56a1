"""Errors: facts as fields, one sentence of cause, one of advice."""

from collections.abc import Iterable
from difflib import get_close_matches


class TurgorError(ValueError):
    """Any mistake in what turgor was given; its text is meant to be read by the user."""


class NotSolved(TurgorError):
    """A computation that ended before it was complete; its ``solution`` holds the path so far."""

    #: Whether the user ended it.
    interrupted = False


class NotHere(TurgorError):
    """Something that this machine lacks, such as a package or a file: elsewhere or later the same call may work."""


def near_match(word: str, known: Iterable[str]) -> str:
    """Return ``"; did you mean 'x'?"`` for the nearest known word, or an empty string.

    Examples
    --------
    >>> near_match("cavty", ["cavity", "fixed"])
    "; did you mean 'cavity'?"
    >>> near_match("zzz", ["cavity", "fixed"])
    ''
    """
    matches = get_close_matches(word, list(known), n=1)
    return f"; did you mean '{matches[0]}'?" if matches else ""


def unknown(kind: str, word: str, known: Iterable[str]) -> TurgorError:
    """Build the error for an unknown name: the name, the near match, the known names.

    Examples
    --------
    >>> print(unknown("face", "cavty", ["cavity", "fixed"]))
    unknown face 'cavty'; did you mean 'cavity'? Known: cavity, fixed.
    """
    names = sorted(known)
    hint = near_match(word, names)
    end = "." if not hint else ""
    return TurgorError(f"unknown {kind} '{word}'{hint}{end} Known: {', '.join(names)}.")

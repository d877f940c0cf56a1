"""Errors: facts as fields, one sentence of cause, one of advice."""

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from pathlib import Path
from types import MappingProxyType

#: Most characters of a line of a message: more is a value that no reader needs in full.
LONGEST_LINE = 1500


def shortened(message: str) -> str:
    """Return a message without the middle of lines that are too long, such as those that repeat a damaged value.

    Examples
    --------
    >>> print(shortened(f"wall is '{'9' * 100_000}'; a number is needed.")[990:1046])
    9999999999 ... (98531 characters left out) ... 999999999
    """
    return "\n".join(map(_shortened_line, message.split("\n")))


def _shortened_line(line: str) -> str:
    if len(line) <= LONGEST_LINE:
        return line
    first, last = LONGEST_LINE * 2 // 3, LONGEST_LINE // 3
    return f"{line[:first]} ... ({len(line) - first - last} characters left out) ... {line[-last:]}"


class TurgorError(ValueError):
    """Any mistake in what turgor was given; its text is meant to be read by the user.

    Parameters
    ----------
    sentence : str
    python, command : str
        How to mend it in Python, and on the command line or in a job file, where these differ.

    Examples
    --------
    >>> error = TurgorError("The file has no header line.", python="Give columns=(...).", command="Add one.")
    >>> str(error), error.on_command_line
    ('The file has no header line. Give columns=(...).', 'The file has no header line. Add one.')
    """

    __module__ = "turgor"  # a traceback names the public class

    def __init__(self, sentence: str = "", *, python: str = "", command: str = "") -> None:
        super().__init__(shortened(f"{sentence} {python}".strip()))
        self.on_command_line = shortened(f"{sentence} {command}".strip())


class CheckError(TurgorError):
    """A check found an error for which no solve is begun, such as a model without supports."""


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


def near_file(file: Path, there: Iterable[str]) -> str:
    """Return ``"; did you mean 'finger.toml'?"`` for a file of nearly the same name, or a period.

    Endings do not count: files of one kind have the same.

    Examples
    --------
    >>> near_file(Path("fingr.toml"), ["finger.toml"]), near_file(Path("other.toml"), ["fine.toml"])
    ("; did you mean 'finger.toml'?", '.')
    """
    names = {Path(name).stem: name for name in there}
    matches = get_close_matches(file.stem, names, n=1)
    return f"; did you mean '{names[matches[0]]}'?" if matches else "."


def unknown(kind: str, word: str, known: Iterable[str], meant: Mapping[str, str] = MappingProxyType({})) -> TurgorError:
    """Build the error for an unknown name: the name, the near match, the known names.

    Parameters
    ----------
    kind : str
    word : str
        The name that is unknown.
    known : iterable of str
    meant : mapping of str to str
        Known names by the words that others use for them, in lower case.

    Examples
    --------
    >>> print(unknown("face", "cavty", ["cavity", "fixed"]))
    unknown face 'cavty'; did you mean 'cavity'? Known: cavity, fixed.
    >>> print(unknown("procedure", "Riks", ["arc_length", "static"], {"riks": "arc_length"}))
    unknown procedure 'Riks'; did you mean 'arc_length'? Known: arc_length, static.
    """
    names = sorted(known)
    other = meant.get(word.strip().lower().replace("-", "_").replace(" ", "_"))
    hint = f"; did you mean '{other}'?" if other in names else near_match(word, names)
    end = "." if not hint else ""
    return TurgorError(f"unknown {kind} '{word}'{hint}{end} Known: {', '.join(names)}.")

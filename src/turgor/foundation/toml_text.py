r"""TOML text: its content, or one sentence that says what is wrong in which line and how to mend it.

>>> read_toml('length = 36 mm', "finger.toml")
Traceback (most recent call last):
turgor.TurgorError: finger.toml:1: a text with a unit needs quotes; put quotes around it: "36 mm".
"""

import re
import sys
import tomllib
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError

#: Levels of tables and lists, and bytes of a file: a job has six, and some kB.
MOST_LEVELS, MOST_BYTES = 20, 50_000_000

#: A text in quotes, on one line.
_QUOTED = re.compile(r"\"(?:\\.|[^\"\\])*\"|'[^']*'")
#: A number and a unit, or a word, that stands where a value is needed.
_WITH_UNIT = re.compile(r"[=\[,]\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*[A-Za-z°µ%][^,\]}\s#]*)")
_WORD = re.compile(r"=\s*([A-Za-z_][^\"'\[\]{},#=]*?)\s*(?:[,}\]#]|$)")
_COMMA = re.compile(r"=\s*([+-]?\d+),(\d+)\s*(?:#|$)")
_KEY = re.compile(r"\s*((?:[\w\-]+|\"[^\"]*\"|'[^']*')(?:\s*\.\s*(?:[\w\-]+|\"[^\"]*\"|'[^']*'))*)\s*=")
_HEADER = re.compile(r"\s*\[\s*([^\[\]]+?)\s*\]")
_DRIVE = re.compile(r"\"([A-Za-z]:\\[^\"\\][^\"]*|\\\\[^\"\\][^\"]*)\"")


def read_toml(text: str, name: str) -> dict[str, Any]:
    r"""Read TOML.

    Parameters
    ----------
    text : str
    name : str
        Name of the file, for messages.

    Returns
    -------
    dict

    Raises
    ------
    TurgorError
        If it is no TOML: file, line, what is wrong, and how to mend it where the slip is a common one.

    Examples
    --------
    >>> read_toml('[mesh]\nsize = "3 mm"', "finger.toml")
    {'mesh': {'size': '3 mm'}}
    >>> read_toml('wall = "1 mm"\nwall = "2 mm"', "finger.toml")
    Traceback (most recent call last):
    turgor.TurgorError: finger.toml:2: 'wall' stands twice, in lines 1 and 2; leave one out.
    """
    nested = TurgorError(f"{name}: it is nested too deeply; allowed are {MOST_LEVELS} levels.")
    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _error(text, name, str(error)) from error
    except (RecursionError, ValueError) as error:  # brackets in brackets without end, a number of thousands of digits
        if isinstance(error, RecursionError):
            raise nested from None
        raise TurgorError(
            f"{name}: a number has too many digits; allowed are {sys.get_int_max_str_digits()}."
        ) from None
    if _depth(content) > MOST_LEVELS:
        raise nested
    for number, line in enumerate(text.splitlines(), start=1):
        path = _DRIVE.search(line)  # signs such as \n and \t are valid, but no part of a path
        if path is not None and _KEY.match(line):
            raise TurgorError(f"{name}:{number}: {_slashes(path[1])}")
    return content


def read_text(path: Path) -> str:
    """Return the text of a TOML file.

    Raises
    ------
    TurgorError
        If it is no file, larger than `MOST_BYTES`, cannot be read, or is no text in UTF-8.
    """
    try:
        if not path.is_file():
            raise TurgorError(f"'{path}' is no file.")
        if path.stat().st_size > MOST_BYTES:
            raise TurgorError(f"'{path}' has more than {MOST_BYTES // 1_000_000} MB, and is no TOML file of turgor.")
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError:
        raise TurgorError(f"'{path}' is not a text file in UTF-8; save it in UTF-8, as TOML is.") from None
    except OSError as error:
        raise TurgorError(f"'{path}' cannot be read: {error.strerror}.") from None


def _depth(value: Any) -> int:
    """Levels of tables and lists, counted up to one more than are allowed."""
    level, depth = [value], 0
    while level and depth <= MOST_LEVELS:
        inner = [
            list(each.values()) if isinstance(each, dict) else each for each in level if isinstance(each, dict | list)
        ]
        level, depth = [each for part in inner for each in part], depth + 1
    return depth


def _error(text: str, name: str, sentence: str) -> TurgorError:
    """Error for what the reader of Python says."""
    match = re.search(r" \(at (?:line (\d+), column (\d+)|end of document)\)$", sentence)
    what = sentence[: match.start()] if match else sentence
    lines = text.splitlines() or [""]
    number = int(match[1]) if match and match[1] else len(lines)
    mend = _twice(lines, number, what) or _mend(lines[min(number, len(lines)) - 1], what)
    if mend:
        return TurgorError(f"{name}:{number}: {mend}")
    column = f", at column {match[2]}" if match and match[2] else ""
    return TurgorError(f"{name}:{number}: this is not valid TOML: {what}{column}.")


def _mend(line: str, what: str) -> str:
    """Say how a line is mended; empty where the slip is none of the common ones."""
    path = re.search(r"\"([^\"]*\\[^\"]*)\"?", line)
    if path is not None and ("hex value" in what or "Unescaped '\\'" in what):
        return _slashes(path[1])
    plain = _QUOTED.sub("''", line)
    comma = _COMMA.search(plain)
    if comma is not None:
        return f"'{comma[1]},{comma[2]}' has a decimal comma; write a point and put quotes around it with its unit."
    with_unit = _WITH_UNIT.search(plain)
    if with_unit is not None:
        return f'a text with a unit needs quotes; put quotes around it: "{with_unit[1].strip()}".'
    word = _WORD.search(plain)
    if word is not None and word[1].lower() in ("true", "false"):
        return f"write {word[1].lower()} instead of {word[1]}."
    if word is not None and word[1] not in ("inf", "nan"):
        return f'a text needs quotes; put quotes around it: "{word[1]}".'
    if plain.count('"') % 2 or plain.count("'") % 2:
        return "a quote is missing; a text stands in two quotes on one line."
    key = re.match(r"\s*([\w.\-]+)\s*:\s*(.+)", line)
    if key is not None and "Expected '='" in what:
        return f"write an equals sign after the key: {key[1]} = {key[2].strip()}."
    return ""


def _slashes(path: str) -> str:
    r"""Say how a path is written: ``\`` begins a special sign in TOML."""
    with_slashes = path.replace("\\", "/")
    return f'write / instead of \\ in a path: "{with_slashes}".'


def _twice(lines: list[str], number: int, what: str) -> str:
    """Say which key or table stands in two lines; empty where none does."""
    if not ("overwrite" in what or "twice" in what or "mutate" in what or "Duplicate" in what):
        return ""
    inline = re.match(r"Duplicate inline table key '(.*)'", what)
    if inline is not None:
        return f"'{inline[1]}' stands twice in a table in braces; leave one out."
    table, first = "", dict[tuple[str, str], int]()
    for count, line in enumerate(lines[:number], start=1):
        header, key = _HEADER.match(line), _KEY.match(line)
        if header is not None:
            table = header[1]
        name = f"[{table}]" if header is not None else key[1] if key is not None else ""
        place = ("" if header is not None else table, name)
        if count == number and place in first and name:
            return f"'{name.strip('[]')}' stands twice, in lines {first[place]} and {number}; leave one out."
        first.setdefault(place, count)
    return ""

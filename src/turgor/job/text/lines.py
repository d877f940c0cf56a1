"""Line numbers of the keys of a TOML text, which `tomllib` does not report."""

import re
from collections.abc import Iterator

Key = tuple[str, ...]

#: Where a key stands: the number of its line, or the option of the command line that states it.
Place = int | str

_TOKEN = re.compile(
    r"""(?P<skip>[ \t\r]+|\#[^\n]*)
      | (?P<newline>\n)
      | (?P<string>\"\"\"(?:\\.|[^\\])*?\"{3,5}|'{3}.*?'{3,5}|"(?:\\.|[^"\\\n])*"|'[^'\n]*')
      | (?P<mark>[\[\]{}=,.])
      | (?P<bare>[^\s\[\]{}=,.\#"']+)""",
    re.VERBOSE | re.DOTALL,
)


class _Tokens:
    """Tokens of a text with their lines, and one token of look-ahead."""

    def __init__(self, text: str) -> None:
        self._stream = self._read(text)
        self.kind, self.text, self.line = next(self._stream)

    def advance(self) -> None:
        self.kind, self.text, self.line = next(self._stream)

    @staticmethod
    def _read(text: str) -> Iterator[tuple[str, str, int]]:
        line = 1
        for match in _TOKEN.finditer(text):
            if match.lastgroup != "skip":
                yield match.lastgroup or "", match[0], line
            line += match[0].count("\n")
        while True:
            yield "end", "", line


def key_lines(text: str) -> dict[Key, int]:
    r"""Map every key of a valid TOML text, tables included, to the line where it first stands.

    Tables of an array, ``[[stages]]`` or in braces, have the number of the table as the next part, counted from 1.

    Parameters
    ----------
    text : str
        A text that `tomllib` accepts; nothing is checked here.

    Returns
    -------
    dict of tuple of str to int
        Line numbers, from 1, by the path of the key.

    Examples
    --------
    >>> key_lines('[mesh]\nsize = "3 mm"\n')
    {('mesh',): 1, ('mesh', 'size'): 2}
    >>> key_lines('[[stages]]\nname = "fill"\n')
    {('stages',): 1, ('stages', '1'): 1, ('stages', '1', 'name'): 2}
    """
    tokens, lines, table = _Tokens(text), dict[Key, int](), Key()
    counts: dict[Key, int] = {}
    while tokens.kind != "end":
        if tokens.kind == "newline":
            tokens.advance()
        elif tokens.text == "[":
            another = _brackets(tokens) > 1
            line = tokens.line
            table = _numbered(_key(tokens, (), lines, counts), counts, another)
            lines.setdefault(table, line)
            while tokens.text == "]":
                tokens.advance()
        else:
            _pair(tokens, table, lines)
    return lines


def dotted_key(text: str) -> Key | None:
    """Read a dotted key as TOML has it; None where the text is none.

    Examples
    --------
    >>> dotted_key("loads.pressure"), dotted_key("loads..pressure")
    (('loads', 'pressure'), None)
    """
    tokens, parts = _Tokens(text), list[str]()
    while tokens.kind in ("bare", "string"):
        parts.append(tokens.text.strip("\"'"))
        tokens.advance()
        if tokens.kind == "end":
            return tuple(parts)
        if tokens.text != ".":
            return None
        tokens.advance()
    return None


def _brackets(tokens: _Tokens) -> int:
    """Skip the opening brackets of a table header, and count them."""
    count = 0
    while tokens.text == "[":
        tokens.advance()
        count += 1
    return count


def _numbered(table: Key, counts: dict[Key, int], another: bool) -> Key:
    """Key of a table; a table of an array has its number as the last part."""
    if another:
        counts[table] = counts.get(table, 0) + 1
    return (*table, str(counts[table])) if table in counts else table


def _key(tokens: _Tokens, parent: Key, lines: dict[Key, int], counts: dict[Key, int] | None = None) -> Key:
    """Read a dotted key and note the line of each of its parts; below an array of tables it is that of the last one."""
    path = parent
    while tokens.kind in ("bare", "string") or tokens.text == ".":
        if tokens.text != ".":
            path = (*_numbered(path, counts or {}, False), tokens.text.strip("\"'"))
            lines.setdefault(path, tokens.line)
        tokens.advance()
    return path


def _pair(tokens: _Tokens, parent: Key, lines: dict[Key, int]) -> None:
    path = _key(tokens, parent, lines)
    tokens.advance()  # the equals sign
    _value(tokens, path, lines)


def _value(tokens: _Tokens, path: Key, lines: dict[Key, int]) -> None:
    if tokens.text == "{" and tokens.kind == "mark":
        tokens.advance()
        while tokens.text != "}" and tokens.kind != "end":
            if tokens.kind == "newline" or tokens.text == ",":
                tokens.advance()
            else:
                _pair(tokens, path, lines)
        tokens.advance()
    elif tokens.text == "[" and tokens.kind == "mark":
        tokens.advance()
        number = 0
        while tokens.text != "]" and tokens.kind != "end":
            if tokens.kind == "newline" or tokens.text == ",":
                tokens.advance()
            elif tokens.text == "{":
                number += 1
                lines.setdefault((*path, str(number)), tokens.line)
                _value(tokens, (*path, str(number)), lines)
            else:
                _value(tokens, path, lines)
        tokens.advance()
    else:
        tokens.advance()
        while tokens.kind in ("bare", "string") or tokens.text == ".":
            tokens.advance()

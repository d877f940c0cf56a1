"""Lines: where each key of a TOML text stands, because `tomllib` does not tell."""

import re
from collections.abc import Iterator

Key = tuple[str, ...]

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
    """
    tokens, lines, table = _Tokens(text), dict[Key, int](), Key()
    while tokens.kind != "end":
        if tokens.kind == "newline":
            tokens.advance()
        elif tokens.text == "[":
            while tokens.text == "[":
                tokens.advance()
            table = _key(tokens, (), lines)
            while tokens.text == "]":
                tokens.advance()
        else:
            _pair(tokens, table, lines)
    return lines


def _key(tokens: _Tokens, parent: Key, lines: dict[Key, int]) -> Key:
    """Read a dotted key and note the line of each of its parts."""
    path = parent
    while tokens.kind in ("bare", "string") or tokens.text == ".":
        if tokens.text != ".":
            path += (tokens.text.strip("\"'"),)
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
        while tokens.text != "]" and tokens.kind != "end":
            if tokens.kind == "newline" or tokens.text == ",":
                tokens.advance()
            else:
                _value(tokens, path, lines)
        tokens.advance()
    else:
        tokens.advance()
        while tokens.kind in ("bare", "string") or tokens.text == ".":
            tokens.advance()

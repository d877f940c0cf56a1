"""Elements of an XML file, each with its line: the parser of the standard library without entities."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn, TypeVar
from xml.parsers import expat

from turgor.core.meshing.exchange.formats.abaqus import Keyword
from turgor.foundation.errors import TurgorError

T = TypeVar("T", int, str)

#: Attributes that say which element it is.
_TELLING = ("id", "name", "type", "mat", "node_set", "surface", "surface_pair")


@dataclass(slots=True)
class Element:
    """An element of an XML file.

    Parameters
    ----------
    tag : str
    given : dict of str to str
        Its attributes.
    path : Path
        The file.
    line : int
        Where it begins.
    text : str
        What stands between its children.
    children : list of Element
    """

    tag: str
    given: dict[str, str]
    path: Path
    line: int
    text: str = ""
    children: list["Element"] = field(default_factory=list)

    def all(self, *tags: str) -> Iterator["Element"]:
        """Children with one of these tags."""
        return (child for child in self.children if child.tag in tags)

    def first(self, *tags: str) -> "Element | None":
        """The first child with one of these tags."""
        return next(self.all(*tags), None)

    def word(self, tag: str, default: str = "") -> str:
        """Text of the first child with a tag, without spaces around it."""
        child = self.first(tag)
        return default if child is None else child.text.strip()

    @property
    def label(self) -> str:
        """The element as a message names it, with the attributes that say which one it is."""
        given = [f' {key}="{self.given[key]}"' for key in _TELLING if self.given.get(key)]
        return f"<{self.tag}{''.join(given)}>"

    def fail(self, why: str) -> NoReturn:
        """Raise an error that names the element and its line."""
        raise TurgorError(f"'{self.path}', line {self.line}, {self.label}: {why}")

    def numbers(self) -> list[float]:
        """Numbers of its text, between commas or spaces."""
        try:
            return [float(word) for word in re.split(r"[,\s]+", self.text.strip()) if word]
        except ValueError:
            self.fail(f"'{self.text.strip()[:40]}' are no numbers.")

    def whole_numbers(self) -> list[int]:
        """Whole numbers of its text; those of its children's ``id`` where it has some, as FEBio 3 writes sets."""
        words = [child.given.get("id", "") for child in self.children] or re.split(r"[,\s]+", self.text.strip())
        try:
            return [int(word) for word in words if word]
        except ValueError:
            self.fail(f"'{' '.join(words)[:40]}' are no whole numbers.")

    def number(self, tag: str, default: float | None = None) -> float:
        """The number of a child, which must not vary over time or place."""
        children = list(self.all(tag))
        if not children:
            if default is None:
                self.fail(f"it has no <{tag}>.")
            return default
        child = children[-1]
        if len(children) > 1:
            child.fail(f"it is the second <{tag}> of {self.label}; one is needed.")
        if "lc" in child.given or child.given.get("type", "const") != "const":
            child.fail("a value that varies over time or place has no form here.")
        values = child.numbers()
        if len(values) != 1:
            child.fail(f"it has {len(values)} numbers; one is needed.")
        return values[0]

    def first_of_its_name(self, table: Mapping[T, object], name: T) -> T:
        """The name under which it is defined; an error where the table has another one of that name."""
        if name in table:
            self.fail(f"another one before it is '{name}', too; names and numbers must differ.")
        return name

    def keyword(self, kind: str, lines: Sequence[str] = (), given: Mapping[str, str] | None = None) -> Keyword:
        """A keyword of a deck that stands for it."""
        return Keyword(kind, dict(given or {}), self.path, self.line, list(lines), self.label)

    def missing(self, why: str) -> Keyword:
        """A keyword that says why a job cannot express it."""
        return self.keyword("missing", [why])

    def unneeded(self, why: str) -> Keyword:
        """A keyword that says why it changes no result."""
        return self.keyword("not needed", [why])


def read_elements(path: Path) -> Element:
    """Read an XML file; return its outermost element.

    Raises
    ------
    TurgorError
        If it is no XML, or defines entities, which could name other files or grow without bounds.
    """
    parser = expat.ParserCreate()
    parser.buffer_text = True
    top = Element("", {}, path, 0)
    open_ones = [top]

    def start(tag: str, given: dict[str, str]) -> None:
        element = Element(tag, given, path, parser.CurrentLineNumber)
        open_ones[-1].children.append(element)
        open_ones.append(element)

    def end(tag: str) -> None:
        open_ones.pop()

    def text(words: str) -> None:
        open_ones[-1].text += words

    def refuse(*_: object) -> None:
        raise TurgorError(f"'{path}', line {parser.CurrentLineNumber}: a document type (<!DOCTYPE …>) is not read.")

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler, parser.StartDoctypeDeclHandler = text, refuse
    try:
        parser.Parse(path.read_bytes(), True)
    except expat.ExpatError as error:
        raise TurgorError(f"'{path}', line {error.lineno}: {expat.ErrorString(error.code)}; this is no XML.") from None
    return top.children[0]

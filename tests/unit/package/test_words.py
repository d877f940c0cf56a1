"""Words of our own do not come back: docs/glossary.md names them and what the field says instead."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "src" / "turgor"

#: Private verbs. A word that is also a term of the field stays: held-out data, a held lock.
PRIVATE = re.compile(r"(?<![a-z])(held(?![- _]?out)|told|asked|sought|beside(?!s)|anew|astray)(?![a-z])", re.IGNORECASE)

#: A file that reads the column headers of others.
PUBLIC = {"core/materials/experiments/columns.py"}

#: Names of variables, arguments and attributes that do not say what the value is.
VARIABLES = frozenset({"found", "kept", "carried", "told", "asked", "sought"})

#: Folders without such names, and a file whose field is a key of the command line's JSON document.
CLEAN = ("src/turgor", "guidelines/src")
KEYS = {"src/turgor/cli/answers/sweeps.py"}


def private_words(text: str) -> list[str]:
    return [match[0] for match in PRIVATE.finditer(text)]


def identifiers(text: str) -> Iterator[str]:
    """Give the names, arguments and attributes that a source defines or uses; not the keywords of calls to others."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.arg):
            yield node.arg
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name


def test_private_words_stay_out():
    files = [path for path in SOURCE.rglob("*.py") if "vendor" not in path.parts]
    used = {path.relative_to(SOURCE).as_posix(): private_words(path.read_text("utf-8")) for path in files}
    assert {path for path, words in used.items() if words} == PUBLIC


def test_a_private_word_is_noticed():
    assert private_words("The face is held; _told(asked)") == ["held", "told", "asked"]
    assert private_words("held_out, held-out rows, besides, withheld, threshold") == []


def test_variables_are_named_after_what_they_are():
    files = [path for folder in CLEAN for path in (ROOT / folder).rglob("*.py") if "vendor" not in path.parts]
    used = {path.relative_to(ROOT).as_posix(): VARIABLES & {*identifiers(path.read_text("utf-8"))} for path in files}
    assert {path for path, names in used.items() if names} == KEYS


def test_a_variable_that_does_not_say_what_it_is_is_noticed():
    text = "def kept(told, *, asked=1):\n    found = told.carried\n    return f'{found}', call(sought=asked)"
    assert VARIABLES & {*identifiers(text)} == {"kept", "told", "asked", "found", "carried"}
    assert not VARIABLES & {*identifiers("'found'  # found\nfounded = not_found")}


def test_the_glossary_names_the_words():
    page = (ROOT / "docs" / "glossary.md").read_text("utf-8")
    assert all(f"*{word}*" in page for word in ("held", "asked", "told", "sought", "beside", "anew"))

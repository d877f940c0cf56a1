"""Words of our own do not come back: docs/glossary.md names them and what the field says instead."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "src" / "turgor"

#: Private verbs. A word that is also a term of the field stays: held-out data, a held lock.
PRIVATE = re.compile(r"(?<![a-z])(held(?![- _]?out)|told|asked|sought|beside(?!s)|anew|astray)(?![a-z])", re.IGNORECASE)

#: A file that reads the column headers of others.
PUBLIC = {"core/materials/experiments/columns.py"}


def private_words(text: str) -> list[str]:
    return [match[0] for match in PRIVATE.finditer(text)]


def test_private_words_stay_out():
    files = [path for path in SOURCE.rglob("*.py") if "vendor" not in path.parts]
    used = {path.relative_to(SOURCE).as_posix(): private_words(path.read_text("utf-8")) for path in files}
    assert {path for path, words in used.items() if words} == PUBLIC


def test_a_private_word_is_noticed():
    assert private_words("The face is held; _told(asked)") == ["held", "told", "asked"]
    assert private_words("held_out, held-out rows, besides, withheld, threshold") == []


def test_the_glossary_names_the_words():
    page = (ROOT / "docs" / "glossary.md").read_text("utf-8")
    assert all(f"*{word}*" in page for word in ("held", "asked", "told", "sought", "beside", "anew"))

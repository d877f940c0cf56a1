"""Every public name stands on one page, with its first sentence, and leads to the reference."""

import sys
from functools import cache
from pathlib import Path

DOCS = Path(__file__).parents[3] / "docs"
sys.path.insert(0, str(DOCS))
import names_page  # noqa: E402  the script stands beside the page that it writes

page = cache(names_page.page)


def test_page_is_what_the_code_says():
    written = (DOCS / "reference" / "names.md").read_text(encoding="utf-8")
    assert written == page(), "run `make reference`"


def test_every_name_has_a_sentence():
    rows = [line for line in page().splitlines() if line.startswith("| ") and "turgor" in line]
    assert len(rows) > 300
    assert [row for row in rows if row.endswith("|  |")] == []


def test_the_reference_shows_every_module_with_a_public_name():
    modules = {line.split("<")[1].split(">")[0].rsplit(".", 1)[0] for line in page().splitlines() if "<turgor." in line}
    assert modules - names_page.shown() == set()

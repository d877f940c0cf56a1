"""The verification page shows what was recorded, and nothing that changes from run to run."""

import ast
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from verification_page import (
    COUNT,
    NUMBERED,
    ROW,
    TITLES,
    Renewal,
    Row,
    Section,
    headline,
    page,
    reading,
    scalars,
    table_line,
    written,
)

FOLDER = Path(__file__).parents[2] / "verification"
PAGE = Path(__file__).parents[3] / "docs" / "verification.md"
FILES = sorted(path.relative_to(FOLDER).as_posix() for path in FOLDER.rglob("test_*.py"))


def row(**change):
    values = {
        "claim": "claim",
        "source": "exact",
        "expected": 1.0,
        "got": 1.0000001,
        "tolerance": "1 %",
    }
    return Row(**(values | change))


def test_line_shows_every_cell():
    line = table_line(row(expected=[0.0, 2.5], got=np.array([[3e-13, 2.500001]]), claim="|a| = b"))
    assert line == "| \\|a\\| = b | exact | 0, 2.5 | below 1e-12, 2.5 | 1 % |"


@pytest.mark.parametrize(
    ("expected", "got", "text"),
    [
        (0.0, 2e-13, "below 1e-12"),
        (0.0, -2.34e-3, "0.0023"),
        (0.0, 0.0, "0"),
        (0.0, float("nan"), "nan"),
        (1.0, 1.00004, "1"),
        (1.0, 1.0004, "1.0004"),
        ("closed", "open", "open"),
        (True, False, "no"),
    ],
)
def test_reading(expected, got, text):
    assert reading(expected, got) == text


def test_round_off_does_not_change_a_row():
    assert table_line(row(got=1.23456789)) == table_line(row(got=1.23456789 * (1 + 1e-12)))
    assert table_line(row(got=1.2345)) != table_line(row(got=1.2346))


def test_files_stand_in_the_order_of_their_numbers_and_can_be_read_back():
    names = (
        "procedures/test_stages.py",
        "equations/test_tangent.py",
        "beams/test_flexure.py",
        "equations/test_newton.py",
    )
    sections = {name: Section(date="2026-01-31", lines=(table_line(row(claim=name)),)) for name in names}
    text = page(sections | {"beams/test_gone.py": sections[names[0]]}, FOLDER)
    assert written(text) == sections
    assert "4 comparisons in 4 files" in text
    order = [
        "## V08",
        f"### {names[2]}",
        "## V24",
        f"### {names[3]}",
        f"### {names[1]}",
        "## Without",
        f"### {names[0]}",
    ]
    places = [text.index(name) for name in order]
    assert places == sorted(places)
    assert "\n\nRivlin's flexure of a block" in text  # what the file says of itself, without its number


def test_a_file_is_renewed_when_all_of_it_has_passed(tmp_path):
    def report(file, passed, line, text):
        properties = [(COUNT, 2), (ROW, (line, text))]
        return SimpleNamespace(
            nodeid=f"tests/verification/{file}::t", when="call", passed=passed, user_properties=properties
        )

    kept = {"inflation/test_tube.py": Section(date="2026-01-31", lines=("| old |",))}
    path = tmp_path / "page.md"
    path.write_text(page(kept, FOLDER), encoding="utf-8")
    renewal = Renewal(path, FOLDER)
    for file, passed, line in (("beams/test_flexure.py", True, 9), ("inflation/test_tube.py", True, 9)):
        renewal.pytest_runtest_logreport(report(file, passed, line, "| second |"))
    renewal.pytest_runtest_logreport(report("beams/test_flexure.py", True, 3, "| first |"))
    renewal.pytest_runtest_logreport(report("inflation/test_tube.py", False, 3, "| wrong |"))
    renewal.pytest_sessionfinish()
    result = written(path.read_text(encoding="utf-8"))
    assert result["beams/test_flexure.py"].lines == ("| first |", "| second |")
    assert result["inflation/test_tube.py"] == kept["inflation/test_tube.py"]


@pytest.mark.parametrize("file", FILES)
def test_every_file_records_and_is_on_the_page(file):
    tree = ast.parse((FOLDER / file).read_text(encoding="utf-8"))
    tests = [node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")]
    assert any("record_verification" in [argument.arg for argument in test.args.args] for test in tests), (
        "no test of this file records a row: give one the fixture record_verification, and call it beside its assertion"
    )
    renew = f"pytest -m 'slow or not slow' tests/verification/{file} --write-verification"
    assert file in written(PAGE.read_text(encoding="utf-8")), f"docs/verification.md lacks this file: {renew}"


@pytest.mark.parametrize("file", FILES)
def test_every_file_has_a_titled_number_or_none_and_a_row_in_the_readme(file):
    number = NUMBERED.match(headline(FOLDER / file))
    assert number is None or number[0] in TITLES, f"TITLES in tests/verification_page.py lacks {number[0]}"
    readme = (FOLDER / "README.md").read_text(encoding="utf-8")
    folder, name = file.removesuffix(".py").split("/")
    assert f"`{folder}/`, all" in readme or re.search(rf"\b{name}`", readme), "tests/verification/README.md lacks it"


def test_the_page_is_what_its_rows_and_the_files_give():
    text = PAGE.read_text(encoding="utf-8")
    renew = "pytest tests/verification/elements/test_verification_meshes.py --write-verification"
    assert page(written(text), FOLDER) == text, f"the head, a title or a docstring has changed: {renew}"


def test_scalars_of_anything():
    assert scalars([1, (2.0, np.arange(2))]) == [1, 2.0, 0, 1]
    assert scalars("text") == ["text"]

"""The verification page: rows that tests record, and the text they become. Formatting hides round-off, nothing else.

A run renews the sections of the files of which it passed every test; the others stay as they are on the page, with the
date of their own run. What the page says of a file besides its rows comes from the file itself.
"""

import ast
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import date
from math import ceil, isfinite, log10
from pathlib import Path

import pytest

HEAD = """\
# Verification

What the tests in `tests/verification` compare with closed forms, converged references and other programs. V01 to {last}
are fixed problems, numbered once and for all so that a test, a sentence and a result can name the same one. (V03,
the stability of laws, is not here: it needs no finite elements, and `tests/unit/core/materials/laws/test_stability.py`
has it.) Every file is one claim about one of them, and states its problem, where the expected values come from, and
why its tolerance is what it is. The folders sort the files by topic; the number stands in a file's docstring. What has
no number is at the end.

Written by `make verification`; `pytest tests/verification/beams/test_flexure.py --write-verification` renews one file
alone. The rows of a file are renewed only when all of its tests have passed; it says on which day. Every number under
*got* is what a test computed, to five digits; where zero is expected, to two, or the power of ten that round-off stays
below.

{count}
"""
TITLES = {
    "V00": "The meshes of these tests",
    "V01": "Patch tests and rigid motions",
    "V02": "Homogeneous deformations",
    "V04": "Thick sphere under pressure",
    "V05": "Thick tube held at its length",
    "V06": "Thick tube with closed ends",
    "V07": "Tube of which the radius is held",
    "V08": "Flexure of a block",
    "V09": "Torsion of a bar",
    "V10": "Nearly incompressible rubber",
    "V11": "Cook's membrane",
    "V12": "Elastica",
    "V13": "Strip under follower pressure",
    "V14": "Weight",
    "V15": "Vibration",
    "V16": "Contact",
    "V17": "Rubber that relaxes and softens",
    "V18": "Sealed gas",
    "V19": "McKibben muscle",
    "V20": "Tube wound with fibers",
    "V21": "Semicircular bender",
    "V22": "Invariance",
    "V23": "Balance",
    "V24": "Tangents and rates of convergence",
    "V25": "Default meshes",
    "V26": "Resumed runs",
}
OTHERS = "Without a number"
COLUMNS = ("| claim | source | expected | got | tolerance |", "|---|---|---|---|---|")
#: The number with which the docstring of a file begins; of several, the first.
NUMBERED = re.compile(r"V\d\d")
#: Where zero is expected, a smaller number may change from machine to machine.
ROUND_OFF = 1e-7
#: What a test tells the plugin: a row with its place in the file, and how many tests its file has.
ROW, COUNT = "verification row", "tests of the file"
PREFIX = re.compile(r"V\d\d[-.\d]*(, V\d\d)*: ")
WRITTEN = re.compile(r"^### ([\w/]+\.py)\n\n.*?Run on ([\d-]+)\.\n\n\|.*?\n\|.*?\n((?:\|.*\n)+)", re.MULTILINE)


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One line of the page: what is claimed, where the expected value comes from, and what came out."""

    claim: str
    source: str
    expected: object
    got: object
    tolerance: object


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """What a run of a file left: its date and the lines of its table."""

    date: str
    lines: tuple[str, ...]


def page(sections: Mapping[str, Section], folder: Path) -> str:
    """Write the whole page: the files of the folder of which a run is known, in the order of the V-numbers.

    A file is named by its path in the folder, such as ``beams/test_flexure.py``.
    """
    result = {file: NUMBERED.match(headline(folder / file)) for file in sections if (folder / file).exists()}
    groups: dict[str, list[str]] = {}
    for file, match in sorted(result.items(), key=lambda item: (item[1] is None, item[1] and item[1][0], item[0])):
        groups.setdefault(match[0] if match else OTHERS, []).append(file)
    rows = sum(len(sections[file].lines) for file in result)
    lines = [HEAD.rstrip().format(last=max(TITLES), count=f"Now: {rows} comparisons in {len(result)} files.")]
    for group, files in groups.items():
        lines += ["", f"## {group} {TITLES[group]}" if group in TITLES else f"## {group}"]
        for file in files:
            lines += ["", f"### {file}", "", f"{about(folder / file)} Run on {sections[file].date}.", ""]
            lines += [*COLUMNS, *sections[file].lines]
    return "\n".join(lines) + "\n"


def written(text: str) -> dict[str, Section]:
    """Read back the sections of a page."""
    return {file: Section(date=date, lines=tuple(lines.splitlines())) for file, date, lines in WRITTEN.findall(text)}


def about(file: Path) -> str:
    """What a file says it verifies: the first line of its docstring, without the number."""
    text = PREFIX.sub("", headline(file))
    return text[:1].upper() + text[1:]


def headline(file: Path) -> str:
    """First line of the docstring of a file."""
    return (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").partition("\n")[0]


def table_line(row: Row) -> str:
    """Write one row of a table; a vertical bar in a text must not end its cell."""
    expected, got = scalars(row.expected), scalars(row.got)
    wanted = expected if len(expected) == len(got) else expected[:1] * len(got)
    texts = (
        row.claim,
        row.source,
        ", ".join(map(number, expected)),
        ", ".join(map(reading, wanted, got)),
        number(row.tolerance),
    )
    return "| " + " | ".join(text.replace("|", "\\|").replace("\n", " ") for text in texts) + " |"


def scalars(value: object) -> list[object]:
    """List the scalars of whatever a test gave: a number, a text, a sequence, an array of any shape."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, str) or not isinstance(value, Iterable):
        return [value]
    return [scalar for entry in value for scalar in scalars(entry)]


def number(value: object) -> str:
    """Write a number to five digits, so that round-off never changes the page; a text stays as it is."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else f"{float(value):.5g}"


def reading(expected: object, got: object) -> str:
    """Write what came out; where zero was expected, two digits, or the power of ten that round-off stays below."""
    if isinstance(got, str | bool) or isinstance(expected, str | bool) or float(expected) != 0:
        return number(got)
    if float(got) == 0 or not isfinite(float(got)):
        return number(got)
    size = abs(float(got))
    return f"{size:.2g}" if size > ROUND_OFF else f"below 1e{ceil(log10(size)):+03d}"


class Renewal:
    """Gathers what tests report, in this process or in others, and renews the page: a plugin of pytest."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.page, self.folder = page, folder
        self.root = folder.parents[1]
        self.missing: dict[str, int] = {}
        self.rows: dict[str, list[tuple[int, str]]] = {}

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        path = self.root / report.nodeid.partition("::")[0]
        count = dict(report.user_properties).get(COUNT)
        if report.when != "call" or not path.is_relative_to(self.folder) or count is None:
            return
        file = path.relative_to(self.folder).as_posix()
        self.missing.setdefault(file, count)
        self.missing[file] -= report.passed
        self.rows.setdefault(file, []).extend(value for key, value in report.user_properties if key == ROW)

    def done(self) -> list[str]:
        """List the files of which every test has passed, and that have rows."""
        return [file for file, missing in self.missing.items() if not missing and self.rows[file]]

    def pytest_sessionfinish(self) -> None:
        today = date.today().isoformat()
        known = written(self.page.read_text(encoding="utf-8")) if self.page.exists() else {}
        for file in self.done():
            lines = tuple(text for _, text in sorted(self.rows[file], key=lambda row: row[0]))
            known[file] = Section(date=today, lines=lines)
        self.page.write_text(page(known, self.folder), encoding="utf-8")

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        done = self.done()
        terminalreporter.write_line(f"{self.page}: {sum(len(self.rows[f]) for f in done)} rows of {len(done)} files")
        for file in sorted(set(self.missing) - set(done)):
            terminalreporter.write_line(f"not renewed, because not all of it was run and passed with rows: {file}")

"""The verification page: rows that tests record, and the text they become. Formatting hides round-off, nothing else."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil, isfinite, log10

HEAD = """\
# Verification

Written by `make verification` from the rows that the tests in `tests/verification` record, and only when all of them
pass. Each file there states its problem, where the expected values come from, and why its tolerance is what it is.
Numbers are shown to five digits; where zero is expected, the power of ten that is not exceeded.
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One line of the page: what is claimed, where the expected value comes from, and what came out."""

    file: str
    line: int
    claim: str
    source: str
    expected: object
    got: object
    tolerance: object


def page(rows: Iterable[Row]) -> str:
    """Write the whole page: one table for each file, in the order of the files and of the tests in them."""
    lines = [HEAD.rstrip()]
    file = None
    for row in sorted(rows, key=lambda row: (row.file, row.line)):
        if row.file != file:
            file = row.file
            lines += ["", f"## {file}", "", "| claim | source | expected | got | tolerance |", "|---|---|---|---|---|"]
        lines.append(table_line(row))
    return "\n".join(lines) + "\n"


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
    """Write what came out; where zero was expected, the power of ten it stays below."""
    if isinstance(got, str | bool) or isinstance(expected, str | bool) or float(expected) != 0:
        return number(got)
    if float(got) == 0 or not isfinite(float(got)):
        return number(got)
    return f"below 1e{ceil(log10(abs(float(got)))):+03d}"

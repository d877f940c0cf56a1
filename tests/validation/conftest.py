"""What the targets share: `record_validation`, which makes docs/validation.md.

A target calls ``record_validation(claim=..., source=..., expected=..., got=..., tolerance=...)`` beside its own
assertions. ``pytest tests/validation/targets -m "slow or not slow" --write-validation`` writes the rows to the page, if
every target ran and passed; every other run leaves the working tree alone.
"""

from collections.abc import Callable
from pathlib import Path

import pytest

from verification_page import COLUMNS, Row, table_line

TESTS = Path(__file__).parent
PAGE = TESTS.parents[1] / "docs" / "validation.md"
#: File, line and text of each row.
ROWS = pytest.StashKey[list[tuple[str, int, str]]]()
OUTCOME = pytest.StashKey[str]()

TITLE = """\
# Validation

This page compares turgor with claims in the literature on soft fluidic actuators: reinforcement, chambers and load
steps. The claims are those of the review by Xavier, Fleming and Yong (2021), [doi
10.1002/aisy.202000187](https://doi.org/10.1002/aisy.202000187), sections 6.2, 7.2, 7.4 and 8.1 and its appendix;
"review" in the tables means this paper. V20 and V21 are cases of the [verification](verification.md). The expected
numbers for section 7.2 were computed for this project by independent semi-analytic or converged solvers. Each file
says what it models and why its tolerance is what it is. Real actuators that were measured, with the distance of a blind
prediction from them, are on [their own page](measured-actuators.md).

The page is written by `pytest tests/validation/targets -m "slow or not slow" --write-validation`, and only when all
targets pass. To repeat one, run `pytest tests/validation/<file> -m "slow or not slow"`.
"""


@pytest.fixture
def record_validation(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Return the function that records one row of the validation page; it asserts nothing."""
    file, line = request.node.path.relative_to(TESTS).as_posix(), request.node.location[1] or 0
    rows = request.config.stash.setdefault(ROWS, [])

    def record(*, claim: str, source: str, expected: object, got: object, tolerance: object) -> None:
        row = Row(claim=claim, source=source, expected=expected, got=got, tolerance=tolerance)
        rows.append((file, line, table_line(row)))

    return record


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--write-validation", action="store_true", help="write docs/validation.md from the targets")


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    if not session.config.getoption("--write-validation", default=False):
        return
    rows = session.config.stash.get(ROWS, [])
    targets = {path.relative_to(TESTS).as_posix() for path in (TESTS / "targets").glob("test_*.py")}
    not_run = targets - {file for file, _, _ in rows}
    if exitstatus != 0 or not_run or "slow or not slow" not in session.config.getoption("markexpr"):
        outcome = "not written: every target must run, slow ones too, and pass"
    else:
        PAGE.write_text(_page(rows), encoding="utf-8")
        outcome = f"written to {PAGE}: {len(rows)} rows"
    session.config.stash[OUTCOME] = outcome


def _page(rows: list[tuple[str, int, str]]) -> str:
    """The whole page: one table for each file, in the order of the files and of the tests in them."""
    parts = [TITLE.rstrip()]
    for name in sorted({file for file, _, _ in rows}):
        lines = [text for file, _, text in sorted(rows, key=lambda row: row[:2]) if file == name]
        parts.append("\n".join((f"## {name}", "", *COLUMNS, *lines)))
    return "\n\n".join(parts) + "\n"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    if OUTCOME in config.stash:
        terminalreporter.write_line(f"validation page {config.stash[OUTCOME]}")

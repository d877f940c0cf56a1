"""What all tests share: the fixture `record_verification`, and the option that writes `docs/verification.md`.

A verification test calls ``record_verification(claim=..., source=..., expected=..., got=..., tolerance=...)`` beside
its own assertions; the fixture asserts nothing. ``pytest --write-verification`` (``make verification``) writes the rows
to the page; every other run leaves the working tree alone.
"""

from collections.abc import Callable
from pathlib import Path

import pytest

from verification_page import Row, page

PAGE = Path(__file__).parent.parent / "docs" / "verification.md"
FOLDER = Path(__file__).parent / "verification"
ROWS = pytest.StashKey[list[Row]]()
LEFT_OUT = pytest.StashKey[bool]()
OUTCOME = pytest.StashKey[str]()


@pytest.fixture
def record_verification(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Return the function that records one row of the verification page; it asserts nothing."""
    file, line, _ = request.node.location
    rows = request.config.stash.setdefault(ROWS, [])

    def record(*, claim: str, source: str, expected: object, got: object, tolerance: object) -> None:
        rows.append(
            Row(
                file=Path(file).name,
                line=line or 0,
                claim=claim,
                source=source,
                expected=expected,
                got=got,
                tolerance=tolerance,
            )
        )

    return record


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--write-verification",
        action="store_true",
        help="write docs/verification.md from the rows that the tests in tests/verification record",
    )


def pytest_deselected(items: list[pytest.Item]) -> None:
    if items:
        items[0].config.stash[LEFT_OUT] = True


def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    if not session.config.getoption("--write-verification"):
        return
    rows = session.config.stash.get(ROWS, [])
    not_run = set(FOLDER.glob("test_*.py")) - {item.path for item in session.items}
    if exitstatus != 0:
        outcome = "not written: not every test passed"
    elif not_run or LEFT_OUT in session.config.stash:
        outcome = "not written: a part of tests/verification was not run; use make verification"
    else:
        PAGE.write_text(page(rows), encoding="utf-8")
        outcome = f"written to {PAGE}: {len(rows)} rows"
    session.config.stash[OUTCOME] = outcome


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    if OUTCOME in config.stash:
        terminalreporter.write_line(f"verification page {config.stash[OUTCOME]}")


#: Scripts that made fixtures, with libraries that the tests do not need.
collect_ignore_glob = ["unit/data/*"]

"""What all tests share: the fixture `record_verification`, and the option that writes `docs/verification.md`.

A verification test calls ``record_verification(claim, source, expected, got, tolerance)`` beside
its own assertions; the fixture asserts nothing. ``pytest --write-verification`` (``make verification``) renews the rows
of the files that were run as a whole and passed; every other run leaves the working tree alone.
"""

import gc
import os
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from turgor.foundation.startup.garbage import search_rarely
from verification_page import COUNT, ROW, Renewal, Row, table_line

# Compiled loops of all processes of the tests lie together, while `_own_cache` moves all other caches.
os.environ.setdefault("NUMBA_CACHE_DIR", str(Path(__file__).parent.parent / ".pytest_cache" / "compiled"))

# Each of the many commands that tests start would else parse the whole package again: half a second to a second.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

search_rarely()  # pytest makes a million objects that stay

PAGE = Path(__file__).parent.parent / "docs" / "verification.md"
FOLDER = Path(__file__).parent / "verification"


#: Modules of `turgor.core` that start a process for a CAD file.
READERS = ("geometry.cad.read", "geometry.cad.inspection", "meshing.generate", "meshing.exchange.formats.write_stl")


@pytest.fixture(autouse=True, scope="session")
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep meshes in a folder of the test run, so that no test depends on what an earlier run left."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TURGOR_CACHE", str(tmp_path_factory.mktemp("cache")))
        patch.setenv("TURGOR_CACHE_MB", "0")  # a test that counts or replaces what makes meshes finds none
        yield


@pytest.fixture(scope="module")
def read_here() -> Iterator[None]:
    """Read and mesh CAD files in this process: another one takes a second to start, and has tests of its own."""
    with pytest.MonkeyPatch.context() as patch:
        for place in READERS:
            patch.setattr(f"turgor.core.{place}.in_child", lambda _, task, *given: task(*given))
        yield


@pytest.fixture
def record_verification(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Return the function that records one row of the verification page; it asserts nothing."""
    line = request.node.location[1] or 0

    def record(claim: str, source: str, expected: object, got: object, tolerance: object) -> None:
        row = Row(claim=claim, source=source, expected=expected, got=got, tolerance=tolerance)
        request.node.user_properties.append((ROW, (line, table_line(row))))

    return record


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--write-verification",
        action="store_true",
        help="renew docs/verification.md with the rows of every file in tests/verification that passes as a whole",
    )


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("--write-verification") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Renewal(PAGE, FOLDER), "renewal of the verification page")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Say with every test how many there are in its file, before any is left out; rows travel with the reports."""
    counts = Counter(item.path for item in items)
    chosen = config.getoption("--write-verification") and not any("::" in argument for argument in config.args)
    for item in items if chosen else ():
        item.user_properties.append((COUNT, counts[item.path]))


def pytest_collection_finish() -> None:
    """Let no search for garbage look at the tests themselves."""
    gc.freeze()


#: Scripts that made fixtures, with libraries that the tests do not need.
collect_ignore_glob = ["unit/data/*"]

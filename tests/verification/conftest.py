"""One thread for every verification test: the problems are so small that a second thread costs more than it saves."""

from collections.abc import Iterator

import pytest

from turgor.core.engine.runtime import use_threads


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    with use_threads(1):
        yield

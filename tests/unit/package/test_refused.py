"""Errors are checked by the facts that they state; see `tests/refused.py`."""

import re
from pathlib import Path

import pytest

from refused import refused, states
from turgor import TurgorError

ROOT = Path(__file__).parents[3]


def test_facts_stand_in_a_message_as_a_whole():
    message = "wall of 'base' is 30 mm; it must be 0.5 to 3 mm."
    assert states(message, "wall")
    assert states(message, "'base'")
    assert states(message, "0.5 to 3 mm")
    assert not states(message, "0")
    assert not states(message, "5 to 3 mm")
    assert not states(message, "wal")


def test_a_missing_fact_and_a_sentence_are_noticed():
    with pytest.raises(AssertionError), refused("base"):
        raise TurgorError("wall is 3.")
    with pytest.raises(AssertionError), refused("it must be more"):
        raise TurgorError("wall is 3; it must be more than 4.")
    with pytest.raises(AssertionError), refused():
        raise TurgorError("wall is 3.")


def test_no_test_pins_a_sentence_of_an_error():
    files = [path for folder in ("tests", "guidelines/tests") for path in sorted((ROOT / folder).rglob("*.py"))]
    pinned = [
        f"{path.relative_to(ROOT)}: {result.group()}"
        for path in files
        for result in re.finditer(r"\braises\([^()]*\bmatch=", path.read_text(encoding="utf-8"))
    ]
    assert not pinned, "expect the facts with `refused`, for sentences are free to improve"

"""Errors are checked by the facts that they state; see `tests/refused.py`."""

import pytest

from refused import refused, states
from turgor import TurgorError


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

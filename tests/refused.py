"""Expect an error by its facts, such as names, values and ranges: its sentences are free to improve."""

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

import pytest

from turgor import TurgorError

#: Plain words in a row that make a sentence, which no test pins.
SENTENCE = re.compile(r"[a-z]{2,}(?:,? [a-z]{2,}){2,}")


@contextmanager
def refused(*facts: object, error: type[Exception] = TurgorError) -> Iterator[pytest.ExceptionInfo[Exception]]:
    """Expect an error whose message states every fact.

    Parameters
    ----------
    *facts
        At least one, in any order: what is wrong (a name, a key, a file, a value) and what would be right (a range, a
        unit, a near match). Each must stand there as a whole, so that 3 is not found in 30.
    error : exception class

    Examples
    --------
    >>> with refused("wall", -1, "0.5 to 3 mm"):
    ...     raise TurgorError("wall is -1; it must be 0.5 to 3 mm.")
    """
    texts = [str(fact) for fact in facts]
    assert texts, "give at least one fact that the message has to state"
    sentences = [text for text in texts if SENTENCE.search(text)]
    assert not sentences, f"a sentence is no fact: {sentences}"
    with pytest.raises(error) as caught:
        yield caught
    missing = [text for text in texts if not states(str(caught.value), text)]
    assert not missing, f"the message does not state {missing}: {caught.value}"


def states(message: str, *facts: str) -> bool:
    """Whether each fact stands in a message as a whole: no letter or digit goes on before or after it."""
    for fact in facts:
        before = r"(?<![\w.])" if fact[:1].isalnum() else ""
        after = r"(?![\w]|\.\d)" if fact[-1:].isalnum() else ""
        if re.search(before + re.escape(fact) + after, message) is None:
            return False
    return True


def any_states(messages: Iterable[str], facts: Sequence[str]) -> bool:
    """Whether one of several messages states every fact."""
    return any(states(message, *facts) for message in messages)

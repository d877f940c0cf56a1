"""An interrupt ends a command also where it comes in a function that compiled code calls, as while LLVM compiles."""

import signal
import time
from collections.abc import Callable
from ctypes import CFUNCTYPE

import pytest

from refused import refused
from turgor.cli.exits import _code_and_sentence
from turgor.cli.start.signals import RUN, STUDY, ends_at_once
from turgor.foundation.errors import TurgorError


def interrupted_inside() -> None:
    """Receive SIGTERM in a function that compiled code calls, which drops whatever exception it raises."""
    CFUNCTYPE(None)(lambda: signal.raise_signal(signal.SIGTERM))()


def fails_for_want_of_a_result() -> None:
    raise RuntimeError("no compiled object yet for <Library 'residual'>")


def refuses() -> None:
    raise TurgorError("there is no file")


def ended(then: Callable[[], None]) -> None:
    """A command that is interrupted inside compiled code, and then goes on."""
    with ends_at_once():
        interrupted_inside()
        then()


@pytest.mark.parametrize("then", [fails_for_want_of_a_result, lambda: time.sleep(1.5)])
def test_an_interrupt_inside_compiled_code_ends_the_command(
    then: Callable[[], None], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(KeyboardInterrupt):
        ended(then)
    assert capsys.readouterr().err == ""


def test_other_ends_stay_what_they_are() -> None:
    with refused("file"):
        ended(refuses)
    with pytest.raises(RuntimeError), ends_at_once():
        fails_for_want_of_a_result()


@pytest.mark.parametrize(("arguments", "said"), [((), STUDY), ((RUN,), RUN)])
def test_a_command_names_no_option_that_it_lacks(arguments: tuple[str, ...], said: str) -> None:
    with pytest.raises(KeyboardInterrupt) as raised, ends_at_once(*arguments):
        signal.raise_signal(signal.SIGINT)
    assert _code_and_sentence(raised.value) == (130, said)
    assert _code_and_sentence(KeyboardInterrupt()) == (130, "interrupted.")

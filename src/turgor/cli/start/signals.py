"""Signals: Ctrl-C and SIGTERM end a command soon, whatever it is doing."""

import os
import signal
import socket
import sys
from _thread import interrupt_main
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread, Timer, current_thread, main_thread
from types import FrameType

import typer

from turgor.cli.exits import ENDED
from turgor.foundation.errors import TurgorError

#: Time [s] that a command has to write its files; a factorization of a large matrix may last longer.
PATIENCE = 2.0

#: Time [s] after which a lost interrupt is raised again.
RETRY_AFTER = 0.05

#: Message of a command that Ctrl-C or SIGTERM ends: of a study, and of a run.
STUDY = "interrupted; the same command continues from the saved results."
RUN = "interrupted; with --resume, a run continues from its last state."

ENDING = (signal.SIGINT, signal.SIGTERM)


class Ended(KeyboardInterrupt):
    """Exception that Ctrl-C and SIGTERM raise.

    Parameters
    ----------
    number : int
        Of the signal.
    sentence : str
        What the command says; empty for the usual one.
    """

    def __init__(self, number: int, sentence: str = "") -> None:
        super().__init__(*([sentence] if sentence else []))
        self.number = number


@contextmanager
def ends_at_once(sentence: str = STUDY) -> Iterator[list[int]]:
    """Turn SIGTERM into what Ctrl-C does, and end the process if either has not ended it within `PATIENCE`.

    States of a run are on disk as soon as they are accepted, so that nothing is lost. Compiled code does not notice a
    signal, but lets other threads run: one of them waits for it.

    Parameters
    ----------
    sentence : str
        What the command says then.

    Yields
    ------
    list of int
        The signals that were received.
    """
    received: list[int] = []
    if current_thread() is not main_thread():
        yield received
        return

    def interrupt(number: int, frame: FrameType | None) -> None:
        received.append(number)
        raise Ended(number, sentence)

    here, there = socket.socketpair()
    there.setblocking(False)
    before = signal.set_wakeup_fd(there.fileno(), warn_on_full_buffer=False)
    handlers = {number: signal.signal(number, interrupt) for number in ENDING}
    Thread(target=_watch, args=(here, sentence), daemon=True).start()
    try:
        with _lost_interrupts_raised_again(sentence):
            yield received
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(before)
        there.close()


@contextmanager
def _lost_interrupts_raised_again(sentence: str) -> Iterator[None]:
    """Interrupt again if an interrupt was lost, as it is in a function that compiled code calls.

    While LLVM compiles, Python runs in such a function only, so that most interrupts of a compilation come there. What
    fails for want of the result of that function has been interrupted, too.
    """
    again: list[Timer] = []
    before = sys.unraisablehook

    def noticed(lost: "sys.UnraisableHookArgs") -> None:
        if not issubclass(lost.exc_type, KeyboardInterrupt):
            before(lost)
            return
        again.append(Timer(RETRY_AFTER, interrupt_main))
        again[-1].daemon = True
        again[-1].start()

    sys.unraisablehook = noticed
    try:
        yield
    except (TurgorError, OSError, typer.Exit):
        raise
    except Exception as error:
        if again:
            raise Ended(signal.SIGINT, sentence) from error
        raise
    finally:
        sys.unraisablehook = before
        for timer in again:
            timer.cancel()


@contextmanager
def saved_in_folder(folder: Path) -> Iterator[None]:
    """Report where the runs are saved that Ctrl-C leaves, and how to continue.

    Parameters
    ----------
    folder : Path
        That of the study.
    """
    try:
        yield
    except KeyboardInterrupt as ended:
        raise Ended(
            getattr(ended, "number", signal.SIGINT),
            f"interrupted; finished runs are saved in {folder}, and the same command continues from there.",
        ) from None


def _watch(here: socket.socket, sentence: str) -> None:
    """Wait for a signal, then for the end of the command, and end the process where that does not come."""
    while number := here.recv(1):
        if number[0] in ENDING:
            here.settimeout(PATIENCE)
            try:
                while here.recv(1):
                    pass
            except TimeoutError:
                os.write(2, f"{sentence}\n".encode())
                os._exit(ENDED + number[0])
            return

"""Exit codes of the command line, and the output of a command: sentences for people, or one JSON document."""

import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout, suppress
from dataclasses import dataclass, field
from io import StringIO
from typing import TYPE_CHECKING

import typer

from turgor.cli.answers.json_document import document
from turgor.foundation.errors import CheckError, NotSolved, TurgorError

if TYPE_CHECKING:
    from turgor.foundation.finding import Finding

#: Exit code: all went well.
DONE = 0
#: Exit code: something given was wrong, and nothing was computed.
BAD_INPUT = 1
#: Exit code: a check found an error.
FOUND_ERROR = 2
#: Exit code: a computation ended before it was complete.
NOT_CONVERGED = 3

#: Shells report a program that a signal ended as this number and that of the signal: 130 for Ctrl-C, 143 for SIGTERM.
ENDED = 128

#: The same for a program whose reader went away, as in ``turgor actuators | head``: SIGPIPE, which Windows lacks.
BROKEN_PIPE = ENDED + 13


def warn(findings: "Sequence[Finding]") -> None:
    """Print each finding as one line on standard error."""
    for each in findings:
        typer.echo(str(each), err=True)


@dataclass(slots=True)
class Answer:
    """Result and findings of a command, besides its printed text.

    Parameters
    ----------
    as_json : bool
        Whether the answer is one JSON document; what the command prints is not shown then.
    result : dataclass
        What the document holds.
    findings : list of Finding
    """

    as_json: bool = False
    result: object = None
    findings: "list[Finding]" = field(default_factory=list)

    def give(self, make: Callable[[], object]) -> None:
        """Take the result, which is built for a document only."""
        if self.as_json:
            self.result = make()

    def warn(self, findings: "Sequence[Finding]", shown: "Sequence[Finding] | None" = None) -> None:
        """Take findings, and print them, or those of them to be ``shown``, where there is no document."""
        self.findings.extend(findings)
        if not self.as_json:
            warn(findings if shown is None else shown)


@contextmanager
def errors_as_sentences(debug: bool, as_json: bool = False) -> Iterator[Answer]:
    """Turn exceptions into sentences and exit codes; show the traceback only with --debug.

    Parameters
    ----------
    debug : bool
        Whether to show tracebacks.
    as_json : bool
        Whether standard output is one JSON document, errors included.
    """
    answer = Answer(as_json)
    code, error = DONE, ""
    try:
        with redirect_stdout(StringIO()) if as_json else nullcontext():
            yield answer
    except typer.Exit as ended:
        code = ended.exit_code
    except BrokenPipeError:
        write_nowhere()
        raise typer.Exit(BROKEN_PIPE) from None
    except BaseException as raised:
        code, error = _code_and_sentence(raised)
        if debug:
            traceback.print_exc()
    if as_json:
        typer.echo(document(code, answer.result, answer.findings, error))
    elif error:
        typer.echo(error, err=True)
    if code or error:
        raise typer.Exit(code)


def write_nowhere() -> None:
    """Send what is still written to standard output nowhere, because its reader went away."""
    with suppress(OSError, ValueError, AttributeError):  # no descriptor, as in tests
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def _code_and_sentence(raised: BaseException) -> tuple[int, str]:
    """Return the exit code and the sentence for an exception."""
    if isinstance(raised, CheckError):
        return FOUND_ERROR, raised.on_command_line
    if isinstance(raised, TurgorError):
        code = NOT_CONVERGED if isinstance(raised, NotSolved) else BAD_INPUT
        return code, " ".join([raised.on_command_line, *getattr(raised, "__notes__", [])])
    if isinstance(raised, OSError):
        return BAD_INPUT, f"'{raised.filename or 'a file'}' cannot be read or written: {raised.strerror}."
    if isinstance(raised, KeyboardInterrupt):
        sentence = str(raised) or "interrupted."
        return ENDED + getattr(raised, "number", signal.SIGINT), sentence
    if not isinstance(raised, Exception):
        raise raised
    what = f"{type(raised).__name__}: {raised}"
    return BAD_INPUT, f"turgor failed unexpectedly, {what}. Please report it with the output of --debug."

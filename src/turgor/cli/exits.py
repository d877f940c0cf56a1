"""Exit codes of the command line, and output of findings and errors on standard error."""

import os
import sys
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

import typer

from turgor.errors import TurgorError

if TYPE_CHECKING:
    from turgor.finding import Finding

DONE, BAD_INPUT, FOUND_ERROR, NOT_CONVERGED = 0, 1, 2, 3

#: What shells report for a program whose reader went away, as in ``turgor actuators | head``: 128 + SIGPIPE.
BROKEN_PIPE = 141


def warn(findings: "Sequence[Finding]") -> None:
    """Print each finding as one line on standard error."""
    for found in findings:
        typer.echo(str(found), err=True)


@contextmanager
def errors_as_sentences(debug: bool) -> Iterator[None]:
    """Turn exceptions into sentences and exit codes; show the traceback only with --debug."""
    try:
        yield
    except typer.Exit:
        raise
    except BrokenPipeError:
        write_nowhere()
        raise typer.Exit(BROKEN_PIPE) from None
    except TurgorError as error:
        _complain(str(error), debug)
    except OSError as error:
        _complain(f"'{error.filename or 'a file'}' cannot be read or written: {error.strerror}.", debug)
    except KeyboardInterrupt:
        _complain("interrupted; with --resume, a run goes on from its last state.", debug, NOT_CONVERGED)
    except Exception as error:
        what = f"{type(error).__name__}: {error}"
        _complain(f"turgor failed unexpectedly, {what}. Please report it with the output of --debug.", debug)


def write_nowhere() -> None:
    """Send what is still written to standard output nowhere, because its reader went away."""
    with suppress(OSError, ValueError, AttributeError):  # no descriptor, as in tests
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def _complain(sentence: str, debug: bool, code: int = BAD_INPUT) -> None:
    if debug:
        traceback.print_exc()
    typer.echo(sentence, err=True)
    raise typer.Exit(code)

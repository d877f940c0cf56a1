"""Exit codes of the command line, and output of findings and errors on standard error."""

import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

from turgor.errors import TurgorError

if TYPE_CHECKING:
    from turgor.finding import Finding

DONE, BAD_INPUT, FOUND_ERROR, NOT_CONVERGED = 0, 1, 2, 3


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
    except TurgorError as error:
        _complain(str(error), debug)
    except OSError as error:
        _complain(f"'{error.filename or 'a file'}' cannot be read or written: {error.strerror}.", debug)
    except KeyboardInterrupt:
        _complain("interrupted; with --resume, a run goes on from its last state.", debug, NOT_CONVERGED)
    except Exception as error:
        what = f"{type(error).__name__}: {error}"
        _complain(f"turgor failed unexpectedly, {what}. Please report it with the output of --debug.", debug)


def _complain(sentence: str, debug: bool, code: int = BAD_INPUT) -> None:
    if debug:
        traceback.print_exc()
    typer.echo(sentence, err=True)
    raise typer.Exit(code)

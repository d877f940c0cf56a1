"""Command line: each command is a thin call of a public function.

Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged (the path so far is written),
130 and 143 ended by Ctrl-C and SIGTERM.
Heavy imports stand inside the commands, so that help and error messages appear at once.
"""

import gc
import os
import signal
import sys
import warnings
from collections.abc import Sequence
from io import TextIOWrapper
from typing import NoReturn

import typer

from turgor.cli.answers.json_document import document
from turgor.cli.exits import BAD_INPUT, DONE, ENDED
from turgor.cli.options import JSON
from turgor.cli.start.commands import app_of
from turgor.cli.start.fast_exit import leave
from turgor.cli.start.lazy_imports import load_late
from turgor.foundation.finding import FindingWarning

#: How many new objects start a search for garbage, and how many searches a wider one. Loading libraries, compiling and
#: drawing make millions of objects that stay; with Python's own numbers the searches take a tenth of the time.
PATIENT = (100_000, 20, 50)

#: Variables that say how many threads OpenBLAS has, the linear algebra of NumPy and SciPy.
BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS")

#: The variable by which pydantic looks for no plugins, among all packages that are installed: job files need none.
NO_PLUGINS = ("PYDANTIC_DISABLE_PLUGINS", "__all__")


def command() -> NoReturn:
    """Run the command line in a process of its own, and end the process."""
    leave(main())


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return the exit code."""
    if arguments is not None:
        return _run(list(arguments))
    settle()
    try:
        return _run(sys.argv[1:])
    finally:
        gc.freeze()  # no search for garbage as Python ends: up to half a second, for memory that goes anyway


def settle() -> None:
    """Set what a process of our own needs before it loads anything heavy.

    That is: few searches for garbage, one thread of OpenBLAS, no plugins, no warnings for findings, no code that
    nobody uses, and a question mark for a letter that the output cannot hold.

    The engine and what fits surrogates limit OpenBLAS to one thread; other products are small. Further threads would
    only spin as they start. What the user has set stays; MKL, which factors tangents, has variables of its own.
    """
    warnings.simplefilter("ignore", FindingWarning)  # commands print findings themselves
    warnings.formatwarning = _as_sentence
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # none where there is no console
            stream.reconfigure(errors="replace")
    gc.set_threshold(*PATIENT)
    load_late()
    os.environ.setdefault(*NO_PLUGINS)
    if not any(name in os.environ for name in BLAS_THREADS):
        os.environ[BLAS_THREADS[0]] = "1"


def _as_sentence(
    message: Warning | str, category: type[Warning], filename: str, lineno: int, line: str | None = None
) -> str:
    """Write a warning of turgor as its sentence, and one of a library with its class."""
    return f"turgor: {message}\n" if category is UserWarning else f"{category.__name__}: {message}\n"


#: Words that are typed for options.
WORDS = {"help": "--help", "version": "--version"}


def _run(given: list[str]) -> int:
    """Run a command and return the exit code."""
    if given and given[0] in WORDS:
        given = [*given[1:], WORDS[given[0]]]
    try:
        code = app_of(*given)(given or ["--help"], prog_name="turgor", standalone_mode=False)
    except typer.Abort:
        return ENDED + signal.SIGINT
    except Exception as error:
        # mistakes in the arguments are exceptions of typer with a message
        if not hasattr(error, "format_message"):
            raise
        sentence = f"{_sentence(error.format_message())} See '{_path(error)} --help'."
        if JSON in given:
            typer.echo(document(BAD_INPUT, None, (), sentence))
        else:
            typer.echo(f"turgor: {sentence}", err=True)
        return BAD_INPUT
    if not given:
        return BAD_INPUT
    return code if isinstance(code, int) else DONE


def _path(error: Exception) -> str:
    """Words of the command in whose arguments a mistake is."""
    return str(getattr(getattr(error, "ctx", None), "command_path", "turgor"))


def _sentence(text: str) -> str:
    """End a text with a period."""
    return text if text.endswith((".", "?", "!", ")")) else f"{text}."

"""Command line: each command is a thin call of a public function.

Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged (the path so far is written),
130 and 143 ended by Ctrl-C and SIGTERM.
Heavy imports stand inside the commands, so that help and error messages appear at once.
"""

import os
import signal
import sys
import warnings
from collections.abc import Sequence
from io import TextIOWrapper

import typer

from turgor.cli.answers.json_document import document
from turgor.cli.exits import BAD_INPUT, DONE, ENDED
from turgor.cli.options import JSON
from turgor.cli.start.commands import command_line
from turgor.foundation.finding import FindingWarning
from turgor.foundation.startup.garbage import search_rarely

#: Variables with the number of threads of OpenBLAS, the linear algebra of NumPy and SciPy.
BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS")


def command() -> int:
    """Run the command line in a process of its own, and return the exit code."""
    prepare_output()
    search_rarely()
    if not any(name in os.environ for name in BLAS_THREADS):
        os.environ[BLAS_THREADS[0]] = "1"  # its products are small here: further threads would only spin
    return main(sys.argv[1:])


def prepare_output() -> None:
    """Write warnings as sentences, and a question mark for a letter that the output lacks."""
    warnings.simplefilter("ignore", FindingWarning)  # commands print findings themselves
    warnings.formatwarning = _as_sentence
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # none where there is no console
            stream.reconfigure(errors="replace")


def _as_sentence(
    message: Warning | str, category: type[Warning], filename: str, lineno: int, line: str | None = None
) -> str:
    """Write a warning of turgor as its sentence, and one of a library with its class."""
    return f"turgor: {message}\n" if category is UserWarning else f"{category.__name__}: {message}\n"


#: Words that users type for options.
WORDS = {"help": "--help", "version": "--version"}


def main(arguments: Sequence[str]) -> int:
    """Run a command and return the exit code.

    Parameters
    ----------
    arguments : sequence of str
        Without the name of the program.

    Returns
    -------
    int
    """
    given = list(arguments)
    if given and given[0] in WORDS:
        given = [*given[1:], WORDS[given[0]]]
    try:
        code = command_line(*given[:1])(given or ["--help"], prog_name="turgor", standalone_mode=False)
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

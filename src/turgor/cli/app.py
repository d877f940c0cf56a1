"""Command line: each command is a thin call of a public function.

Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged (the path so far is written).
Heavy imports stand inside the commands, so that help and error messages appear at once.
"""

import gc
import os
import sys
from collections.abc import Sequence
from typing import Annotated

import typer

from turgor import __version__
from turgor.cli.again import compare_command, measure_command, report_command
from turgor.cli.analyses.calibrate import calibrate_command
from turgor.cli.analyses.gradient import gradient_command
from turgor.cli.analyses.guidelines import guidelines_app
from turgor.cli.analyses.optimize import optimize_command
from turgor.cli.analyses.section import section_command
from turgor.cli.analyses.sensitivity import sensitivity_command
from turgor.cli.analyses.surrogate import predict_command, surrogate_command
from turgor.cli.analyses.sweep import sweep_command
from turgor.cli.analyses.uncertainty import uncertainty_command
from turgor.cli.answers.document import document
from turgor.cli.check import check_command
from turgor.cli.convergence import convergence_command
from turgor.cli.exits import BAD_INPUT, DONE, NOT_CONVERGED
from turgor.cli.export import export_command
from turgor.cli.families.actuators import actuators_command
from turgor.cli.families.init import init_command
from turgor.cli.fitting.fit import fit_command
from turgor.cli.inspect import inspect_command
from turgor.cli.materials import materials_app
from turgor.cli.mesh import mesh_command
from turgor.cli.modes import modes_command
from turgor.cli.options import JSON
from turgor.cli.run import run_command

#: How many new objects start a search for garbage, and how many searches a wider one. Loading libraries, compiling and
#: drawing make millions of objects that stay; with Python's own numbers the searches take a tenth of the time.
PATIENT = (100_000, 20, 50)

#: Variables that say how many threads OpenBLAS has, the linear algebra of NumPy and SciPy.
BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS")

app = typer.Typer(
    add_completion=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    help="Finite element modeling of soft fluidic actuators.",
    epilog="Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged.",
)


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
    """Set what a process of our own needs before it loads anything heavy: few searches for garbage, one BLAS thread.

    The engine and what fits surrogates limit OpenBLAS to one thread; other products are small. Further threads would
    only spin as they start. What the user has set stays; MKL, which factors tangents, has variables of its own.
    """
    gc.set_threshold(*PATIENT)
    if not any(name in os.environ for name in BLAS_THREADS):
        os.environ[BLAS_THREADS[0]] = "1"


def _run(given: list[str]) -> int:
    """Run a command and return the exit code."""
    try:
        code = app(given or ["--help"], prog_name="turgor", standalone_mode=False)
    except typer.Abort:
        return NOT_CONVERGED
    except Exception as error:
        # mistakes in the arguments are exceptions of typer with a message
        if not hasattr(error, "format_message"):
            raise
        sentence = f"{_sentence(error.format_message())} See 'turgor --help'."
        if JSON in given:
            typer.echo(document(BAD_INPUT, None, (), sentence))
        else:
            typer.echo(f"turgor: {sentence}", err=True)
        return BAD_INPUT
    if not given:
        return BAD_INPUT
    return code if isinstance(code, int) else DONE


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"turgor {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Read the options before the command."""


app.command("run")(run_command)
app.add_typer(materials_app, name="materials")
app.command("actuators")(actuators_command)
app.command("check")(check_command)
app.command("init")(init_command)
app.command("report")(report_command)
app.command("measure")(measure_command)
app.command("compare")(compare_command)
app.command("calibrate")(calibrate_command)
app.command("sweep")(sweep_command)
app.command("uncertainty")(uncertainty_command)
app.command("optimize")(optimize_command)
app.command("gradient")(gradient_command)
app.command("sensitivity")(sensitivity_command)
app.command("surrogate")(surrogate_command)
app.command("predict")(predict_command)
app.command("inspect")(inspect_command)
app.command("fit")(fit_command)
app.command("export")(export_command)
app.command("mesh")(mesh_command)
app.command("modes")(modes_command)
app.command("convergence")(convergence_command)
app.command("section")(section_command)
app.add_typer(guidelines_app, name="guidelines")


def _sentence(text: str) -> str:
    """End a text with a period."""
    return text if text.endswith((".", "?", "!", ")")) else f"{text}."

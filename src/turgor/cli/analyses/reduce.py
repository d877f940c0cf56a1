"""Command ``turgor reduce``: a model of an actuator that answers in milliseconds, and what it says."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.analyses.calibrate import often
from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, check_new, command_of, output_option, requested_job

if TYPE_CHECKING:
    from turgor.cli.exits import Answer
    from turgor.reduced.states.inputs import Inputs


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    job: JobFile
    along: Annotated[
        list[str] | None,
        often(
            "--along", "KEY=FROM..TO", "A load and its range, such as loads.pressure='0..20 kPa'; as often as needed."
        ),
    ] = None
    output: Annotated[Path, output_option("The file; its ending is .reduced.")] = Path("actuator.reduced")
    error: Annotated[float, typer.Option(help="Wanted error of displacements, over the largest.")] = 0.005
    paths: Annotated[int, typer.Option(help="Training paths at most.", min=1)] = 24
    held_out: Annotated[int, typer.Option("--held-out", help="Paths of full solves kept from training.", min=0)] = 2
    folder: Annotated[
        Path | None, typer.Option(help="Where training paths are saved; the same call goes on.", show_default=False)
    ] = None
    processes: Annotated[int, typer.Option(help="Processes at once; more than one needs --folder.", min=1)] = 1
    force: Annotated[bool, typer.Option("--force", help="Replace the file.")] = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Train a reduced model of a job: it answers in milliseconds, with its error."""
    with errors_as_sentences(options.debug, options.as_json) as answer:
        from turgor.cli.answers.reduced import reduced_result
        from turgor.foundation.errors import TurgorError
        from turgor.job.prepare import prepare
        from turgor.reduced.reduce import Budget, reduce
        from turgor.reduced.training.path_runs import PathRuns

        check_new(options.output, options.force, "--output")
        ranges = dict(_range(text) for text in options.along or ())
        model, findings = prepare(requested_job(options.job, options.changes))
        answer.warn(findings)
        budget = Budget(error=options.error, paths=options.paths, held_out=options.held_out)
        if options.folder is None and options.processes > 1:
            raise TurgorError(f"--processes is {options.processes}, and more than one needs --folder.")
        runs = None if options.folder is None else PathRuns(options.folder, options.processes)
        reduced = reduce(model, ranges, budget=budget, runs=runs, say=typer.echo)
        file = reduced.save(options.output)
        errors = reduced.held_out
        if len(errors.inputs):
            shares = f"displacement {errors.worst:.2g} of the largest, tip {errors.tip.max():.2g} of its travel"
            typer.echo(
                f"{len(errors.inputs)} held-out states. Largest errors: {shares}, volume {errors.volume.max():.2g}."
            )
        typer.echo(f"Written to {file}.")
        answer.give(lambda: reduced_result(reduced, file))
        raise typer.Exit(DONE)


reduce_command = command_of(_Options, _run)


def _range(text: str) -> tuple[str, tuple[float, float]]:
    """Read what ``--along`` states, such as ``loads.pressure=0..20 kPa``."""
    from turgor.foundation.errors import TurgorError

    key, sign, values = (part.strip() for part in text.partition("="))
    first, dots, last = (part.strip() for part in values.partition(".."))
    if not (sign and key and dots and first and last):
        raise TurgorError(f"--along is '{text}'; write KEY=FROM..TO, such as --along loads.pressure='0..20 kPa'.")
    return key, (_number(first, _unit(last), key), _number(last, "", key))


def _unit(text: str) -> str:
    """Unit at the end of a quantity; empty where there is none."""
    return text.lstrip("+-0123456789.eE ").strip()


def _number(text: str, unit: str, key: str) -> float:
    """Read a quantity [SI]; a number without a unit takes the one of the other end, or is in SI units."""
    from turgor.foundation.errors import TurgorError
    from turgor.foundation.response import COLUMN_UNITS

    own = _unit(text) or unit
    try:
        value = float(text.removesuffix(own)) if text.endswith(own) and own else float(text)
    except ValueError:
        raise TurgorError(f"--along {key}: '{text}' is no number with a unit.") from None
    if own not in COLUMN_UNITS:
        raise TurgorError(
            f"--along {key}: unknown unit '{own}'; known: {', '.join(each for each in COLUMN_UNITS if each)}."
        )
    return value * COLUMN_UNITS[own]


def say_prediction(file: Path, given: Sequence[str], answer: "Answer") -> None:
    """Print what a reduced model answers at inputs such as ``pressure=10 kPa``."""
    from turgor.cli.answers.reduced import answer_result
    from turgor.reduced.states.reduced import Reduced

    reduced = Reduced.load(file)
    values = dict(_value(text, reduced.inputs) for text in given)
    result = reduced.solve(values)
    for face, volume in result.volumes.items():
        typer.echo(f"volume of {face} {volume * 1e6:.5g} mL")
    if reduced.tip.any():
        typer.echo(f"displacement of the tip ({', '.join(f'{x * 1e3:.5g}' for x in result.tip)}) mm")
    typer.echo(f"largest displacement {abs(result.displacement).max() * 1e3:.5g} mm")
    typer.echo(
        f"largest held-out error {reduced.held_out.worst:.2g} of the largest displacement; {result.iterations} updates"
    )
    answer.give(lambda: answer_result(result))
    raise typer.Exit(DONE)


def _value(text: str, inputs: "Inputs") -> tuple[str, float]:
    from turgor.foundation.errors import TurgorError

    name, sign, value = (part.strip() for part in text.partition("="))
    if not (sign and name and value):
        raise TurgorError(f"--at is '{text}'; write NAME=VALUE, such as --at pressure='10 kPa'.")
    key = inputs.keys[inputs.place(name)]
    return key, _number(value, "", key)

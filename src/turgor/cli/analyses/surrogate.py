"""Commands ``turgor surrogate`` and ``turgor predict``: a fast function fitted to a study, and what it says."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.analyses.calibrate import often
from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, Retry, command_of, output_option
from turgor.cli.start.signals import ends_at_once

if TYPE_CHECKING:
    from turgor.cli.exits import Answer
    from turgor.studies.runs.factor import Value
    from turgor.studies.surrogates.surrogate import Surrogate

StudyPath = Annotated[
    Path,
    typer.Argument(
        metavar="STUDY", help="Folder or table of 'turgor sweep', or a study file, which is computed.",
        show_default=False,
    ),
]  # fmt: skip
Measures = Annotated[
    list[str] | None, often("--measure", "NAME", "A measure; as often as needed, all that vary by default.")
]
At = Annotated[str, typer.Option("--at", metavar="NAME=VALUE", help="Where measures are read: pressure='40 kPa'.")]
Processes = Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)]
Scheduler = Annotated[
    str | None,
    typer.Option(
        metavar="ADDRESS", help="Compute on the workers of a Dask scheduler: tcp://host:8786.", show_default=False
    ),
]
Output = Annotated[Path | None, output_option("Folder of results; by default that of the study.")]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    study: StudyPath
    measures: Measures = None
    at: At = ""
    along: Annotated[
        str, typer.Option(metavar="NAME", help="A column that becomes an input, such as pressure: whole curves.")
    ] = ""
    processes: Processes = 1
    scheduler: Scheduler = None
    output: Output = None
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _fit(options: _Options) -> None:
    """Fit a fast function to a study: it predicts measures with their errors, and is inverted by 'turgor predict'."""
    with errors_as_sentences(options.debug, options.as_json) as answer, ends_at_once():
        from turgor.cli.analyses.given_study import given_study, read_at
        from turgor.cli.answers.surrogates import surrogate_result
        from turgor.studies.study_file.analysis_tables import SurrogateTable
        from turgor.studies.surrogates.figure import surrogate_figure
        from turgor.studies.surrogates.fit import surrogate
        from turgor.views.plots.figures import write_figure

        given = given_study(options.study, options, "surrogate")
        stated = SurrogateTable() if given.file is None else given.file.surrogate
        along = options.along or stated.along
        at = None if along else read_at(options.at or stated.at, given.study) or given.at
        measures = options.measures or stated.measures or given.measures or None
        fitted = surrogate(given.study, measures, at=at, along=along)
        folder = options.output if options.output is not None else given.folder
        folder.mkdir(parents=True, exist_ok=True)
        files = [fitted.save(folder / "surrogate"), folder / "surrogate.png", folder / "surrogate.txt"]
        write_figure(files[1], surrogate_figure(fitted))
        files[2].write_text(fitted.summary() + "\n", encoding="utf-8")
        typer.echo(fitted.summary())
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: surrogate_result(fitted, files))
        raise typer.Exit(DONE)


surrogate_command = command_of(_Options, _fit)


@dataclass(frozen=True, slots=True, kw_only=True)
class PredictOptions:
    """Options of ``turgor predict``."""

    file: Annotated[
        Path,
        typer.Argument(metavar="SURROGATE", help="File of 'turgor surrogate' or 'turgor reduce'.", show_default=False),
    ]
    at: Annotated[
        list[str] | None,
        often("--at", "NAME=VALUE", "Value of a factor, such as pressure='30 kPa'; as often as needed."),
    ] = None
    want: Annotated[
        list[str] | None,
        often("--want", "NAME=VALUE", "A wanted measure, such as bending_angle='60 deg': inputs are searched that give "
              "it, those of --at are fixed."),
    ] = None  # fmt: skip
    prefer: Annotated[
        list[str] | None, often("--prefer", "NAME=VALUE", "A preferred input where many give what is wanted.")
    ] = None
    extrapolate: Annotated[
        bool, typer.Option("--extrapolate", help="Take values beyond the range, with a warning.")
    ] = False
    history: Annotated[
        list[str] | None,
        often("--history", "NAME=SHARES", "Of a reduced model: shares of the value of --at over time in s, such as "
              "pressure='[[0, 0], [0.02, 1], [0.5, 1]]', or an expression of t."),
    ] = None  # fmt: skip
    duration: Annotated[str, typer.Option(metavar="TIME", help="End of a history; that of its points by default.")] = ""
    step: Annotated[str, typer.Option(metavar="TIME", help="Step along a history: '4 ms'.")] = ""
    motion: Annotated[bool, typer.Option("--motion", help="Follow a history with inertia.")] = False
    damping: Annotated[
        str, typer.Option(metavar="TIME", help="Damping of a motion in proportion to the rate of strain: '5 ms'.")
    ] = ""
    output: Annotated[Path | None, output_option("Table of a history; by default next to the file.")] = None
    as_json: Json = False
    debug: Debug = False


def _predict(options: PredictOptions) -> None:
    """Print what a surrogate or a reduced model predicts, or which values give the target measures."""
    with errors_as_sentences(options.debug, options.as_json) as answer:
        from turgor.cli.analyses.given_study import values_given
        from turgor.cli.analyses.reduced_answers import say_prediction
        from turgor.foundation.errors import TurgorError
        from turgor.studies.surrogates.surrogate import Surrogate

        if options.file.suffix == ".reduced":
            if options.want or options.prefer or options.extrapolate:
                raise TurgorError(
                    "a reduced model takes --at alone; --want, --prefer and --extrapolate are for surrogates."
                )
            say_prediction(options, answer)
        if options.history:
            raise TurgorError("--history is for reduced models, files of 'turgor reduce'.")
        fitted = Surrogate.load(options.file)
        at = values_given(options.at, fitted.factors, "--at")
        if options.want:
            if options.extrapolate:
                raise TurgorError("--extrapolate does not go with --want: inputs are searched within their ranges.")
            _invert(fitted, at, options, answer)
        if options.prefer:
            raise TurgorError("--prefer goes with --want.")
        _say(fitted, at, options, answer)


predict_command = command_of(PredictOptions, _predict)


def _say(fitted: "Surrogate", at: "dict[str, Value]", options: PredictOptions, answer: "Answer") -> None:
    from turgor.cli.answers.surrogates import prediction_result

    prediction = fitted.predict(at, extrapolate=options.extrapolate)
    answer.warn(prediction.findings)
    for name in fitted.measures:
        typer.echo(f"{name.replace('_', ' ')} {prediction.text(name)}")
    answer.give(lambda: prediction_result(prediction, at))
    raise typer.Exit(DONE)


def _invert(fitted: "Surrogate", fixed: "dict[str, Value]", options: PredictOptions, answer: "Answer") -> None:
    from turgor.cli.analyses.given_study import numbers_given, values_given
    from turgor.cli.answers.surrogates import inverse_result
    from turgor.studies.surrogates.invert import invert

    prefer = values_given(options.prefer, fitted.factors, "--prefer")
    target = numbers_given(options.want, fitted.units, "--want")
    inverse = invert(fitted, target, fixed=fixed, prefer=prefer)
    typer.echo(inverse.sentence())
    for each in fitted.factors:
        if each.name in inverse.deviations:
            deviation = inverse.deviations[each.name]
            typer.echo(f"{each.name} {each.shown(inverse.values[each.name])} ± {each.shown(float(f'{deviation:.2g}'))}")
    answer.give(lambda: inverse_result(inverse))
    raise typer.Exit(DONE if inverse.reached else NOT_CONVERGED)

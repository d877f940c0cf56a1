"""Command ``turgor sensitivity``: which factors of a study matter, and how much."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.analyses.calibrate import often
from turgor.cli.analyses.surrogate import At, Measures, Output, Processes, Scheduler, StudyPath
from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, Retry, command_of
from turgor.cli.start.signals import ends_at_once

if TYPE_CHECKING:
    from collections.abc import Sequence

    from turgor.studies.runs.study import Study
    from turgor.studies.study_file.analysis_tables import SensitivityTable
    from turgor.studies.study_file.study_file import StudyFile
    from turgor.views.plots.figures import PlotFigure

#: Ways to analyze a study: the first chooses by its design.
METHODS = ("auto", "anova", "sobol")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    study: StudyPath
    method: Annotated[
        str,
        typer.Option(
            help="anova for a factorial, sobol for samples (by a surrogate), or auto, the default.", show_default=False
        ),
    ] = ""
    measures: Measures = None
    at: At = ""
    hold: Annotated[list[str] | None, often("--hold", "NAME=VALUE", "A factor that does not vary, for sobol.")] = None
    spread: Annotated[
        list[str] | None,
        often("--spread", "NAME=MEAN+-DEVIATION", "A factor that is normal within its range instead of uniform, for "
              "sobol; without a mean around the middle of the range."),
    ] = None  # fmt: skip
    samples: Annotated[
        int | None, typer.Option(help="Points of sobol, a power of two; 1024 by default.", show_default=False)
    ] = None
    processes: Processes = 1
    scheduler: Scheduler = None
    output: Output = None
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Report which factors of a study matter: shares of the variance, with a picture.

    A full factorial gets an analysis of variance. Samples get Sobol indices of a surrogate, whose error is reported.
    """
    with errors_as_sentences(options.debug, options.as_json) as answer, ends_at_once():
        from turgor.cli.analyses.given_study import given_study, read_at
        from turgor.cli.answers.surrogates import SensitivityResult
        from turgor.foundation.errors import TurgorError, unknown
        from turgor.studies.sensitivity.anova import is_factorial
        from turgor.views.plots.figures import write_figure

        given = given_study(options.study, options, "sensitivity")
        settings = _settings(options, given.file)
        if settings.method not in METHODS:
            raise unknown("method", settings.method, METHODS)
        study, at = given.study, read_at(settings.at, given.study) or given.at
        method = settings.method if settings.method != "auto" else "anova" if is_factorial(study) else "sobol"
        if method == "anova" and (settings.fixed or settings.spread):
            raise TurgorError(f"{'--hold' if settings.fixed else '--spread'} goes with the method sobol.")
        names = settings.measures or list(given.measures) or None
        text, terms, figure = _anova(study, names, at) if method == "anova" else _sobol(study, names, at, settings)
        folder = options.output if options.output is not None else given.folder
        folder.mkdir(parents=True, exist_ok=True)
        files = [folder / "sensitivity.png", folder / "sensitivity.txt"]
        write_figure(files[0], figure)
        files[1].write_text(text + "\n", encoding="utf-8")
        typer.echo(text)
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: SensitivityResult(method=method, terms=terms, files=files))
        raise typer.Exit(DONE)


sensitivity_command = command_of(_Options, _run)

Analysis = tuple[str, list[dict[str, object]], "PlotFigure"]


def _settings(options: _Options, file: "StudyFile | None") -> "SensitivityTable":
    """Return what the study file states, with what the options state in its place."""
    from turgor.studies.study_file.analysis_tables import SensitivityTable

    stated = SensitivityTable() if file is None else file.sensitivity
    given = {
        "method": options.method, "measures": options.measures, "at": options.at, "samples": options.samples,
        "fixed": _by_name(options.hold, "--hold"), "spread": _by_name(options.spread, "--spread"),
    }  # fmt: skip
    return stated.model_copy(update={key: value for key, value in given.items() if value})


def _by_name(texts: "Sequence[str] | None", option: str) -> dict[str, str]:
    from turgor.foundation.errors import TurgorError

    example = "NAME=MEAN+-DEVIATION, such as wall='1.2 mm+-0.1 mm'" if option == "--spread" else "NAME=VALUE"
    by_name = {}
    for text in texts or ():
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and name and value):
            raise TurgorError(f"{option} is '{text}'; write {example}.")
        by_name[name] = value
    return by_name


def _anova(study: "Study", names: "Sequence[str] | None", at: tuple[str, float] | None) -> Analysis:
    from turgor.cli.answers.surrogates import anova_terms
    from turgor.studies.sensitivity.anova import anova
    from turgor.studies.sensitivity.figure import anova_figure
    from turgor.studies.surrogates.training import measures_that_vary

    chosen = names or measures_that_vary(study, at)
    analyses = [anova(study, name, at=at) for name in chosen]
    text = "\n\n".join(f"{each.sentence()}\n{each.table()}" for each in analyses)
    figure = anova_figure([(each.measure.replace("_", " "), each) for each in analyses])
    return text, [term for each in analyses for term in anova_terms(each)], figure


def _sobol(
    study: "Study", names: "Sequence[str] | None", at: tuple[str, float] | None, settings: "SensitivityTable"
) -> Analysis:
    from turgor.cli.analyses.given_study import spreads_given, values_given
    from turgor.cli.answers.surrogates import index_terms
    from turgor.studies.sensitivity.figure import indices_figure
    from turgor.studies.sensitivity.indices import sobol_indices
    from turgor.studies.surrogates.fit import surrogate

    fitted = surrogate(study, names, at=at)
    fixed = values_given([f"{name}={text}" for name, text in settings.fixed.items()], fitted.factors, "--hold")
    spreads = spreads_given([f"{name}={text}" for name, text in settings.spread.items()], fitted.factors)
    indices = sobol_indices(fitted, spreads=spreads, fixed=fixed, samples=settings.samples)
    text = "\n".join([*(each.sentence() for each in indices), *fitted.notes])
    return text, [term for each in indices for term in index_terms(each)], indices_figure(indices)

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
    from turgor.views.plots.figures import PlotFigure

#: Ways to analyze a study: the first chooses by its design.
METHODS = ("auto", "anova", "sobol")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    study: StudyPath
    method: Annotated[str, typer.Option(help="anova for a factorial, sobol for samples (by a surrogate), or auto.")] = (
        "auto"
    )
    measures: Measures = None
    at: At = ""
    hold: Annotated[list[str] | None, often("--hold", "NAME=VALUE", "A factor that does not vary, for sobol.")] = None
    spread: Annotated[
        list[str] | None,
        often("--spread", "NAME=MEAN+-DEVIATION", "A factor that is normal within its range instead of uniform, for "
              "sobol; without a mean around the middle of the range."),
    ] = None  # fmt: skip
    samples: Annotated[int, typer.Option(help="Points of sobol, a power of two.")] = 1024
    processes: Processes = 1
    scheduler: Scheduler = None
    output: Output = None
    retry: Retry = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def _run(asked: _Options) -> None:
    """Say which factors of a study matter: shares of the variance, with a picture.

    A full factorial gets an analysis of variance. Samples get Sobol indices of a surrogate, whose error is told.
    """
    with errors_as_sentences(asked.debug, asked.as_json) as answer, ends_at_once():
        from turgor.cli.analyses.given_study import given_study, read_at
        from turgor.cli.answers.surrogates import SensitivityResult
        from turgor.foundation.errors import TurgorError, unknown
        from turgor.studies.sensitivity.anova import is_factorial
        from turgor.views.plots.figures import write_figure

        if asked.method not in METHODS:
            raise unknown("method", asked.method, METHODS)
        study, place, at, measures = given_study(asked.study, asked)
        at = read_at(asked.at, study) or at
        method = asked.method if asked.method != "auto" else "anova" if is_factorial(study) else "sobol"
        if method == "anova" and (asked.hold or asked.spread):
            raise TurgorError(f"{'--hold' if asked.hold else '--spread'} goes with the method sobol.")
        names = asked.measures or list(measures) or None
        text, terms, figure = _anova(study, names, at) if method == "anova" else _sobol(study, names, at, asked)
        folder = asked.output if asked.output is not None else place
        folder.mkdir(parents=True, exist_ok=True)
        files = [folder / "sensitivity.png", folder / "sensitivity.txt"]
        write_figure(files[0], figure)
        files[1].write_text(text + "\n", encoding="utf-8")
        typer.echo(text)
        typer.echo(f"Written in {folder}: {', '.join(file.name for file in files)}.")
        answer.give(lambda: SensitivityResult(method=method, terms=terms, files=files))
        raise typer.Exit(DONE)


sensitivity_command = command_of(_Options, _run)

Found = tuple[str, list[dict[str, object]], "PlotFigure"]


def _anova(study: "Study", names: "Sequence[str] | None", at: tuple[str, float] | None) -> Found:
    from turgor.cli.answers.surrogates import anova_terms
    from turgor.studies.sensitivity.anova import anova
    from turgor.studies.sensitivity.figure import anova_figure
    from turgor.studies.surrogates.training import measures_that_vary

    chosen = names or measures_that_vary(study, at)
    found = [anova(study, name, at=at) for name in chosen]
    text = "\n\n".join(f"{each.sentence()}\n{each.table()}" for each in found)
    figure = anova_figure([(each.measure.replace("_", " "), each) for each in found])
    return text, [term for each in found for term in anova_terms(each)], figure


def _sobol(study: "Study", names: "Sequence[str] | None", at: tuple[str, float] | None, asked: _Options) -> Found:
    from turgor.cli.analyses.given_study import spreads_given, values_given
    from turgor.cli.answers.surrogates import index_terms
    from turgor.studies.sensitivity.figure import indices_figure
    from turgor.studies.sensitivity.indices import sobol_indices
    from turgor.studies.surrogates.fit import surrogate

    fitted = surrogate(study, names, at=at)
    held = values_given(asked.hold, fitted.factors, "--hold")
    spreads = spreads_given(asked.spread or (), fitted.factors)
    found = sobol_indices(fitted, spreads=spreads, held=held, samples=asked.samples)
    text = "\n".join([*(each.sentence() for each in found), *fitted.notes])
    return text, [term for each in found for term in index_terms(each)], indices_figure(found)

"""Commands ``turgor guidelines list | run | report``: the design rules of the review, run and judged."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, NOT_CONVERGED, errors_as_sentences
from turgor.cli.options import Debug, Json, Retry, output_option

if TYPE_CHECKING:
    from turgor.guidelines.guideline import Guideline, Setting
    from turgor.guidelines.judge import Judged
    from turgor.studies.runs.executors.run_outcome import Ended

guidelines_app = typer.Typer(
    rich_markup_mode=None, help="List, run and report the design guidelines of Xavier, Fleming and Yong (2021)."
)

Keys = Annotated[
    list[str] | None,
    typer.Argument(metavar="[GUIDELINE]...", help="Such as 7.4-5, or 7.4 for a whole section; all by default."),
]
Folder = Annotated[Path, output_option("Folder of runs and page.")]
Full = Annotated[bool, typer.Option("--full", help="Default meshes and all values, instead of few and coarse ones.")]


@guidelines_app.callback(invoke_without_command=True)
def _guidelines(context: typer.Context) -> None:
    """List the guidelines where no other command is given."""
    if context.invoked_subcommand is None:
        _list()


@guidelines_app.command("list")
def _list(keys: Keys = None, as_json: Json = False, debug: Debug = False) -> None:
    """List the guidelines with what they claim."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.guidelines import listed_result

        asked = _chosen(keys)
        for each in asked:
            studies = "" if len(each.studies) == 1 else f" ({len(each.studies)} studies)"
            typer.echo(f"{each.key:7}{each.rule}{studies}")
        answer.give(lambda: listed_result(asked))


@guidelines_app.command("run")
def _run(
    keys: Keys = None,
    output: Folder = Path("guidelines"),
    full: Full = False,
    processes: Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)] = 1,
    retry: Retry = False,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Run guidelines and judge them; what has ended before, also in a run that was killed, is not computed again."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.guidelines import judged_result
        from turgor.guidelines.judge import run_guidelines
        from turgor.guidelines.page import write_page

        asked, setting = _chosen(keys), _setting(full)
        judged = run_guidelines(
            asked, output / "runs", setting, processes=processes, progress=_progress, retry=retry
        )  # fmt: skip
        _tell(judged)
        page = write_page(judged, output)
        typer.echo(f"Page with figures: {page}.")
        answer.give(lambda: judged_result(judged, page))
        raise typer.Exit(NOT_CONVERGED if any(each.verdict == "not judged" for each in judged) else DONE)


@guidelines_app.command("report")
def _report(
    keys: Keys = None,
    output: Folder = Path("guidelines"),
    full: Full = False,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Judge what was run so far, and write the page."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.guidelines import judged_result
        from turgor.foundation.errors import TurgorError
        from turgor.guidelines.judge import judged
        from turgor.guidelines.page import write_page

        if not (output / "runs").is_dir():
            raise TurgorError(f"--output is '{output}', which has no runs; 'turgor guidelines run' makes them.")
        found = tuple(judged(each, output / "runs", _setting(full)) for each in _chosen(keys))
        _tell(found)
        page = write_page(found, output)
        typer.echo(f"Page with figures: {page}.")
        answer.give(lambda: judged_result(found, page))


def _chosen(keys: list[str] | None) -> "tuple[Guideline, ...]":
    from turgor.guidelines.catalog import chosen

    return chosen(keys or ())


def _setting(full: bool) -> "Setting":
    return "full" if full else "quick"


def _progress(ended: "Ended") -> None:
    seconds = "" if ended.found is None else f", {ended.found.seconds:.1f} CPU s"
    what = "failed" if ended.problem else "read" if ended.again else "done"
    typer.echo(f"  {ended.run.name}: {what}{seconds}{ended.problem and f': {ended.problem}'}", err=True)


def _tell(judged: "tuple[Judged, ...]") -> None:
    for each in judged:
        typer.echo(f"{each.guideline.key}  {each.verdict.upper()}: {each.guideline.rule}")
        for study in each.studies:
            typer.echo(f"  {study.study.title}: {study.judgement.verdict}. {study.judgement.found}")
            if study.judgement.conditions:
                typer.echo(f"    {study.judgement.conditions}")

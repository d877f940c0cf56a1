"""Commands ``turgor guidelines list | run | report``: the design rules of the review, run and judged."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import turgor as tg

if TYPE_CHECKING:
    from turgor.studies import Ended
    from turgor_guidelines.guideline import Guideline, Setting
    from turgor_guidelines.judge import Judged

guidelines_app = typer.Typer(
    rich_markup_mode=None, help="List, run and report the design guidelines of Xavier, Fleming and Yong (2021)."
)

Keys = Annotated[
    list[str] | None,
    typer.Argument(metavar="[GUIDELINE]...", help="Such as 7.4-5, or 7.4 for a whole section; all by default."),
]
Folder = Annotated[Path, tg.commands.output_option("Folder of runs and page.")]
Full = Annotated[bool, typer.Option("--full", help="Default meshes and all values, instead of few and coarse ones.")]


@guidelines_app.callback(invoke_without_command=True)
def _guidelines(context: typer.Context) -> None:
    """List the guidelines where no other command is given."""
    if context.invoked_subcommand is None:
        _list()


@guidelines_app.command("list")
def _list(keys: Keys = None, as_json: tg.commands.Json = False, debug: tg.commands.Debug = False) -> None:
    """List the guidelines with what they claim."""
    with tg.commands.errors_as_sentences(debug, as_json) as answer:
        from turgor_guidelines.answers import listed_result

        requested = _chosen(keys)
        for each in requested:
            studies = "" if len(each.studies) == 1 else f" ({len(each.studies)} studies)"
            typer.echo(f"{each.key:7}{each.rule}{studies}")
        answer.give(lambda: listed_result(requested))


@guidelines_app.command("run")
def _run(
    keys: Keys = None,
    output: Folder = Path("guidelines"),
    full: Full = False,
    processes: Annotated[int, typer.Option(help="Processes at once, each with one thread.", min=1)] = 1,
    retry: tg.commands.Retry = False,
    as_json: tg.commands.Json = False,
    debug: tg.commands.Debug = False,
) -> None:
    """Run guidelines and judge them; what has ended before, also in a run that was killed, is not computed again."""
    with tg.commands.errors_as_sentences(debug, as_json) as answer:
        from turgor_guidelines.answers import judged_result
        from turgor_guidelines.judge import run_guidelines
        from turgor_guidelines.page import write_page

        requested, setting = _chosen(keys), _setting(full)
        judged = run_guidelines(
            requested, output / "runs", setting, processes=processes, progress=_progress, retry=retry
        )
        _report_verdicts(judged)
        page = write_page(judged, output)
        typer.echo(f"Page with figures: {page}.")
        answer.give(lambda: judged_result(judged, page))
        complete = all(each.verdict != "not judged" for each in judged)
        raise typer.Exit(tg.commands.DONE if complete else tg.commands.NOT_CONVERGED)


@guidelines_app.command("report")
def _report(
    keys: Keys = None,
    output: Folder = Path("guidelines"),
    full: Full = False,
    as_json: tg.commands.Json = False,
    debug: tg.commands.Debug = False,
) -> None:
    """Judge the runs that have ended, and write the page."""
    with tg.commands.errors_as_sentences(debug, as_json) as answer:
        from turgor_guidelines.answers import judged_result
        from turgor_guidelines.judge import judged
        from turgor_guidelines.page import write_page

        if not (output / "runs").is_dir():
            raise tg.TurgorError(f"--output is '{output}', which has no runs; 'turgor guidelines run' makes them.")
        results = tuple(judged(each, output / "runs", _setting(full)) for each in _chosen(keys))
        _report_verdicts(results)
        page = write_page(results, output)
        typer.echo(f"Page with figures: {page}.")
        answer.give(lambda: judged_result(results, page))


def _chosen(keys: list[str] | None) -> "tuple[Guideline, ...]":
    from turgor_guidelines.catalog import chosen

    return chosen(keys or ())


def _setting(full: bool) -> "Setting":
    return "full" if full else "quick"


def _progress(ended: "Ended") -> None:
    seconds = "" if ended.result is None else f", {ended.result.seconds:.1f} CPU s"
    what = "failed" if ended.problem else "read" if ended.again else "done"
    typer.echo(f"  {ended.run.name}: {what}{seconds}{ended.problem and f': {ended.problem}'}", err=True)


def _report_verdicts(judged: "tuple[Judged, ...]") -> None:
    for each in judged:
        typer.echo(f"{each.guideline.key}  {each.verdict.upper()}: {each.guideline.rule}")
        for study in each.studies:
            typer.echo(f"  {study.study.title}: {study.judgement.verdict}. {study.judgement.finding}")
            if study.judgement.conditions:
                typer.echo(f"    {study.judgement.conditions}")

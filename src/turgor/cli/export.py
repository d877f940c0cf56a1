"""Command ``turgor export``: files of the actuator of a job for other programs and for manufacturing."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, asked_job, command_of
from turgor.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """Arguments and options of ``turgor export``."""

    job: JobFile
    inp: Annotated[bool, typer.Option("--inp", help="The model for CalculiX or Abaqus.")] = False
    step: Annotated[bool, typer.Option("--step", help="The geometry as STEP.")] = False
    stl: Annotated[bool, typer.Option("--stl", help="The whole body and each cavity as STL.")] = False
    mold: Annotated[bool, typer.Option("--mold", help="A casting mold of a PneuNet as STEP and STL.")] = False
    output: Annotated[Path | None, typer.Option(help="Folder; by default NAME-export here.", show_default=False)] = None
    program: Annotated[str, typer.Option(help="Reader of the .inp file: calculix or abaqus.")] = "calculix"
    poisson: Annotated[
        float | None,
        typer.Option(help="Poisson's ratio of incompressible materials; CalculiX needs one.", show_default=False),
    ] = None
    force: Annotated[bool, typer.Option("--force", help="Replace files that are there already.")] = False
    changes: Changes = None
    as_json: Json = False
    debug: Debug = False


def export_files(chosen: ExportOptions) -> None:
    """Export the actuator of a job: model (.inp), geometry (.step, .stl), casting mold."""
    with errors_as_sentences(chosen.debug, chosen.as_json) as answer:
        kinds = [kind for kind in ("inp", "step", "stl", "mold") if getattr(chosen, kind)]
        if not kinds:
            raise TurgorError("nothing is to be exported; name at least one of --inp, --step, --stl, --mold.")
        from turgor.cli.answers.results import ExportResult
        from turgor.job.export import InpOptions, export_job

        question = asked_job(chosen.job, chosen.changes)
        folder = chosen.output if chosen.output is not None else Path(f"{question.name}-export")
        options = InpOptions(program=chosen.program, poisson=chosen.poisson)
        files = export_job(question, folder, kinds, inp=options, force=chosen.force)
        answer.give(lambda: ExportResult(files=files))
        for file in files:
            typer.echo(f"{file} ({file.stat().st_size:,} bytes)")


#: The command.
export_command = command_of(ExportOptions, export_files)

"""Command ``turgor export``: files of the actuator of a job for other programs and for manufacturing."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, command_of, output_option, requested_job
from turgor.foundation.errors import TurgorError


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """Arguments and options of ``turgor export``."""

    job: Annotated[
        Path, typer.Argument(metavar="JOB", help="Job file in TOML, or folder of a run.", show_default=False)
    ]
    inp: Annotated[bool, typer.Option("--inp", help="The model for CalculiX or Abaqus.")] = False
    step: Annotated[bool, typer.Option("--step", help="The geometry as STEP.")] = False
    stl: Annotated[bool, typer.Option("--stl", help="The whole body and each cavity as STL.")] = False
    mold: Annotated[bool, typer.Option("--mold", help="A casting mold of a PneuNet as STEP and STL.")] = False
    to: Annotated[
        list[Path] | None,
        typer.Option(
            help="The motion of a run: a .gif, .webp, .mp4 or .glb file; as often as needed.", show_default=False
        ),
    ] = None
    color_by: Annotated[str, typer.Option(help="Field that the motion is colored by.")] = "von_mises"
    width: Annotated[int, typer.Option(help="Width of the animation in pixels.")] = 640
    seconds: Annotated[float, typer.Option(help="Time from rest to the last state.")] = 2.0
    output: Annotated[Path | None, output_option("Folder; by default NAME-export here.")] = None
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
    """Export the actuator of a job: model (.inp), geometry (.step, .stl), casting mold; or the motion of a run."""
    with errors_as_sentences(chosen.debug, chosen.as_json) as answer:
        kinds = [kind for kind in ("inp", "step", "stl", "mold") if getattr(chosen, kind)]
        if not kinds and not chosen.to:
            raise TurgorError(
                "nothing is to be exported; name at least one of --inp, --step, --stl, --mold, --to FILE."
            )
        from turgor.cli.answers.results import ExportResult

        files = (*_files_of_job(chosen, kinds), *_motions(chosen))
        answer.give(lambda: ExportResult(files=files))
        for file in files:
            typer.echo(f"{file} ({file.stat().st_size:,} bytes)")


def _files_of_job(chosen: ExportOptions, kinds: list[str]) -> tuple[Path, ...]:
    """Write what comes from the job itself."""
    from turgor.job.export import InpOptions, export_job

    if not kinds:
        return ()
    question = requested_job(chosen.job, chosen.changes)
    folder = chosen.output if chosen.output is not None else Path(f"{question.name}-export")
    options = InpOptions(program=chosen.program, poisson=chosen.poisson)
    return export_job(question, folder, kinds, inp=options, force=chosen.force)


def _motions(chosen: ExportOptions) -> tuple[Path, ...]:
    """Write the motion of a run into the requested files."""
    if not chosen.to:
        return ()
    if not chosen.job.is_dir():
        raise TurgorError(f"--to writes the motion of a run; '{chosen.job}' is no folder of results of `turgor run`.")
    taken = [file for file in chosen.to if file.exists()]
    if taken and not chosen.force:
        raise TurgorError(f"'{taken[0]}' is there already; choose another name, or --force to replace it.")
    import turgor as tg

    motion = tg.pictures.Motion(width=chosen.width, seconds=chosen.seconds)
    solution = tg.load(chosen.job)
    return tuple(
        tg.pictures.write_motion(file, solution, color_by=chosen.color_by, motion=motion) for file in chosen.to
    )


#: The command.
export_command = command_of(ExportOptions, export_files)

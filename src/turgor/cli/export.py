"""Command ``turgor export``: files of the actuator of a job for other programs and for manufacturing."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Changes, Debug, Json, command_of, option_quantity, output_option, requested_job
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.cli.exits import Answer
    from turgor.foundation.finding import Finding


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportOptions:
    """Arguments and options of ``turgor export``."""

    job: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Job file in TOML, folder of a run, or reduced model from turgor reduce.",
            show_default=False,
        ),
    ]
    inp: Annotated[bool, typer.Option("--inp", help="The model for CalculiX or Abaqus.")] = False
    step: Annotated[bool, typer.Option("--step", help="The geometry as STEP.")] = False
    stl: Annotated[bool, typer.Option("--stl", help="The whole body and each cavity as STL.")] = False
    mold: Annotated[bool, typer.Option("--mold", help="A casting mold as STEP and STL, and how it opens.")] = False
    draft: Annotated[
        str,
        typer.Option(help="Draft to which a mold tapers walls along its pull, up to 10 deg; 0 deg leaves the part."),
    ] = "0 deg"
    to: Annotated[
        list[str] | None,
        typer.Option(
            metavar="FILE|FORMAT",
            help="The motion of a run: a .gif, .webp, .mp4 or .glb file. Of a reduced model: table, mujoco, urdf, "
            "soromox, fmu or sofa. As often as needed.",
            show_default=False,
        ),
    ] = None
    links: Annotated[
        int | None,
        typer.Option(help="Links of a chain for mujoco and urdf, segments for soromox.", show_default=False),
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
    """Export the actuator of a job: model, geometry, casting mold; the motion of a run; a reduced model."""
    with errors_as_sentences(chosen.debug, chosen.as_json) as answer:
        if chosen.job.suffix == ".reduced":
            return _reduced(chosen, answer)
        kinds = [kind for kind in ("inp", "step", "stl", "mold") if getattr(chosen, kind)]
        if not kinds and not chosen.to:
            raise TurgorError(
                "nothing is to be exported; name at least one of --inp, --step, --stl, --mold, --to FILE."
            )
        from turgor.cli.answers.results import ExportResult

        job_files, notes, findings = _files_of_job(chosen, kinds)
        files = (*job_files, *_motions(chosen))
        answer.give(lambda: ExportResult(files=files, notes=notes))
        answer.warn(findings)
        for note in notes:
            typer.echo(note)
        for file in files:
            typer.echo(f"{file}{_size(file)}")


def _size(file: Path) -> str:
    return f" ({file.stat().st_size:,} bytes)" if file.is_file() else ""


def _files_of_job(
    chosen: ExportOptions, kinds: list[str]
) -> "tuple[tuple[Path, ...], tuple[str, ...], tuple[Finding, ...]]":
    """Write what comes from the job itself; return the files, what differs in the model, and findings of the mold."""
    from turgor.core.geometry.molds.mold import MoldSettings
    from turgor.core.inp.account import by_verdict
    from turgor.job.export import InpOptions, export_job

    if not kinds:
        return (), (), ()
    question = requested_job(chosen.job, chosen.changes)
    folder = chosen.output if chosen.output is not None else Path(f"{question.name}-export")
    options = InpOptions(program=chosen.program, poisson=chosen.poisson)
    mold = MoldSettings(draft=option_quantity("--draft", chosen.draft, "angle"))
    done = export_job(question, folder, kinds, inp=options, mold=mold, force=chosen.force)
    return done.files, tuple(map(str, by_verdict(done.notes))), done.findings


def _reduced(chosen: ExportOptions, answer: "Answer") -> None:
    """Write a reduced model for other programs."""
    from turgor.cli.answers.results import ExportResult
    from turgor.reduced.states.reduced import Reduced
    from turgor.systems.exports.formats import FORMATS, export_reduced

    formats = chosen.to or []
    if not formats or chosen.inp or chosen.step or chosen.stl or chosen.mold:
        raise TurgorError(f"a reduced model is exported --to {', '.join(FORMATS)}; write one, such as --to mujoco.")
    name = chosen.job.stem
    folder = chosen.output if chosen.output is not None else Path(f"{name}-export")
    reduced = Reduced.load(chosen.job)
    written = export_reduced(reduced, folder, formats, name=name, links=chosen.links, force=chosen.force)
    answer.give(lambda: ExportResult(files=tuple(written), errors=tuple(written.values())))
    for file, error in written.items():
        typer.echo(f"{file}{_size(file)}: {error}.")


def _motions(chosen: ExportOptions) -> tuple[Path, ...]:
    """Write the motion of a run into the requested files."""
    if not chosen.to:
        return ()
    if not chosen.job.is_dir():
        raise TurgorError(
            f"--to writes the motion of a run, or a reduced model for other programs; '{chosen.job}' is "
            "neither a folder of results of `turgor run` nor a file of `turgor reduce`."
        )
    files = [Path(text) for text in chosen.to]
    taken = [file for file in files if file.exists()]
    if taken and not chosen.force:
        raise TurgorError(f"'{taken[0]}' is there already; choose another name, or --force to replace it.")
    import turgor as tg

    motion = tg.pictures.Motion(width=chosen.width, seconds=chosen.seconds)
    solution = tg.load(chosen.job)
    return tuple(tg.pictures.write_motion(file, solution, color_by=chosen.color_by, motion=motion) for file in files)


#: The command.
export_command = command_of(ExportOptions, export_files)

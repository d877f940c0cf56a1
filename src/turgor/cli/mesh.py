"""Command ``turgor mesh``: mesh the actuator of a job, describe, write and draw the mesh."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, FOUND_ERROR, errors_as_sentences
from turgor.cli.options import Changes, Debug, JobFile, Json, option_quantity, output_option, requested_job
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.meshing.mesh import Mesh
    from turgor.job.job import Job


def mesh_command(
    job: JobFile,
    size: Annotated[
        str | None, typer.Option(help="Another mesh size, such as '2 mm'.", metavar="LENGTH", show_default=False)
    ] = None,
    output: Annotated[
        Path | None,
        output_option("Write the mesh to this file, .vtu for ParaView."),
    ] = None,
    picture: Annotated[Path | None, typer.Option(help="Draw the cells into this PNG.", show_default=False)] = None,
    changes: Changes = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """Mesh a job: counts, sizes and shapes of the cells, findings, and a picture."""
    with errors_as_sentences(debug, as_json) as answer:
        from turgor.cli.answers.results import mesh_result

        _check_ending("--output", output, ".vtu")
        _check_ending("--picture", picture, ".png")
        from turgor.core.meshing.quality.checks import check_mesh
        from turgor.foundation.finding import Severity
        from turgor.job.meshes import mesh_of, save_mesh_of
        from turgor.views.report.mesh_text import describe_mesh

        parsed = _with_size(requested_job(job, changes), size)
        geometry = parsed.geometry()
        mesh = mesh_of(parsed, geometry)
        save_mesh_of(parsed)
        findings = (*geometry.findings, *check_mesh(mesh))
        typer.echo(describe_mesh(mesh))
        answer.give(lambda: mesh_result(mesh))
        if not any(each.code == "G01" for each in findings):
            typer.echo("  walls: two cells or more through every wall")
        if output is not None:
            from turgor.core.results.files.mesh_vtu import write_mesh_vtu

            write_mesh_vtu(output, mesh)
            typer.echo(f"Mesh in {output}.")
        if picture is not None:
            _draw(picture, parsed.name, mesh)
        answer.warn(findings)
        raise typer.Exit(FOUND_ERROR if any(each.severity is Severity.ERROR for each in findings) else DONE)


def _draw(picture: Path, name: str, mesh: "Mesh") -> None:
    from turgor.views.pictures.mesh_picture import write_mesh_picture

    write_mesh_picture(picture, mesh, title=f"{name} · {mesh.unknown_count:,} unknowns")
    typer.echo(f"Picture in {picture}.")


def _check_ending(option: str, path: Path | None, ending: str) -> None:
    if path is not None and path.suffix.lower() != ending:
        raise TurgorError(f"{option} is '{path}'; the name must end in {ending}.")


def _with_size(job: "Job", text: str | None) -> "Job":
    from dataclasses import replace

    from turgor.core.meshing.exchange.mesh_file import MeshFile
    from turgor.job.job import MESHED

    if text is None:
        return job
    if isinstance(job.actuator, MESHED):
        what = f"is the mesh file '{job.actuator.file}'" if isinstance(job.actuator, MeshFile) else "has several bodies"
        raise TurgorError(f"--size is '{text}', but the actuator {what}, which has a mesh of its own size.")
    size = option_quantity("--size", text, "length")
    faces = {name: min(length, size) for name, length in job.mesh.face_sizes.items()}
    return replace(job, mesh=replace(job.mesh_settings, size=size, face_sizes=faces))

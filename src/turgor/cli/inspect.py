"""Command ``turgor inspect``: bodies, faces and cavities of a CAD file, and a picture."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Debug, Json
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.core.geometry.cad.inspection import Inspection

Vector = tuple[float, float, float]


def inspect_command(
    part: Annotated[
        Path,
        typer.Argument(metavar="PART", help="STEP, BREP or STL file, or a script that draws one.", show_default=False),
    ],
    unit: Annotated[
        str | None, typer.Option(help="Unit of the numbers in the file, such as mm.", show_default=False)
    ] = None,
    dimensions: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="DIMENSION=VALUE",
            help="Dimension of a script, such as wall='2 mm'; as often as needed.",
            show_default=False,
        ),
    ] = None,
    function: Annotated[str, typer.Option(help="Function of the script that draws the part.")] = "build",
    picture: Annotated[Path | None, typer.Option(help="Draw the part into this PNG.", show_default=False)] = None,
    as_json: Json = False,
    debug: Debug = False,
) -> None:
    """List the bodies, faces and cavities of a CAD file, with the names that a job can use."""
    with errors_as_sentences(debug, as_json) as answer:
        if picture is not None and picture.suffix.lower() != ".png":
            raise TurgorError(f"--picture is '{picture}'; the name must end in .png.")
        from turgor.cli.answers.file_results import inspect_result
        from turgor.core.geometry.cad.inspection import inspect_cad
        from turgor.core.geometry.cad.parametric.drawn import part_file
        from turgor.job.text.overrides import parse_changes

        with part_file(part, function, parse_changes(dimensions or ()), unit) as file:
            inspection = inspect_cad(file, unit=unit)
        _show(inspection)
        answer.give(lambda: inspect_result(inspection))
        if picture is not None:
            from turgor.views.pictures.cad_picture import write_cad_picture

            write_cad_picture(picture, inspection)
            typer.echo(f"Picture in {picture}.")
        answer.warn(inspection.findings)
        raise typer.Exit(DONE)


def _show(inspection: "Inspection") -> None:
    size = " x ".join(f"{side * 1e3:.4g}" for side in inspection.size)
    typer.echo(
        f"{inspection.name}: {size} mm (unit {inspection.unit}); "
        f"thinnest wall {inspection.smallest_wall * 1e3:.3g} mm, "
        f"{_count(inspection.bodies, 'body', 'bodies')}, {_count(inspection.faces, 'face', 'faces')}, "
        f"{_count(inspection.cavities, 'cavity', 'cavities')}."
    )
    if inspection.symmetry:
        typer.echo(f"Symmetry: {inspection.symmetry}.")
    _table(
        "Bodies",
        ("region", "color", "volume [mm³]", "from [mm]", "to [mm]"),
        [(b.region, b.color, f"{b.volume * 1e9:.5g}", _place(b.low), _place(b.high)) for b in inspection.bodies],
    )
    _table(
        "Cavities",
        ("name", "kind", "volume [mm³]", "opening"),
        [
            (
                cavity.name,
                "closed" if cavity.closed else "open",
                f"{cavity.volume * 1e9:.5g}",
                "; ".join(f"{area * 1e6:.4g} mm² at {_place(center)} mm" for area, center in cavity.openings),
            )
            for cavity in inspection.cavities
        ],
    )
    _table(
        "Faces",
        ("name", "in the file", "color", "area [mm²]", "center [mm]", "normal"),
        [
            (
                face.name,
                face.name_in_file,
                face.color,
                f"{face.area * 1e6:.4g}",
                _place(face.center),
                "curved" if face.normal is None else _direction(face.normal),
            )
            for face in inspection.faces
        ],
    )


def _table(title: str, header: tuple[str, ...], rows: list[tuple[str, ...]]) -> None:
    """Print columns of text, without empty columns."""
    if not rows:
        return
    columns = [i for i in range(len(header)) if any(row[i] for row in rows)]
    width = {i: max(len(header[i]), *(len(row[i]) for row in rows)) for i in columns}
    typer.echo(f"\n{title}")
    for row in (header, *rows):
        typer.echo("  " + "  ".join(row[i].ljust(width[i]) for i in columns).rstrip())


def _count(things: Sequence[object], one: str, several: str) -> str:
    return f"{len(things)} {one if len(things) == 1 else several}"


def _place(point: Vector) -> str:
    return f"({', '.join(f'{round(value * 1e3, 3) + 0.0:g}' for value in point)})"


def _direction(normal: Vector) -> str:
    largest = max(range(3), key=lambda i: abs(normal[i]))
    if abs(normal[largest]) > 1 - 1e-6:
        return f"{'+' if normal[largest] > 0 else '-'}{'xyz'[largest]}"
    return f"({', '.join(f'{round(value, 3) + 0.0:g}' for value in normal)})"

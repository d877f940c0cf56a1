"""Command ``turgor track``: pressures that make an actuator follow a path."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from turgor.cli.exits import DONE, errors_as_sentences
from turgor.cli.options import Debug, Json, command_of, output_option
from turgor.foundation.errors import TurgorError

if TYPE_CHECKING:
    from turgor.reduced.states.inputs import Inputs
    from turgor.systems.control.limits import Limits
    from turgor.systems.control.track import Track

#: What it writes.
FILES = ("track.csv", "track.png", "track.html")


@dataclass(frozen=True, slots=True, kw_only=True)
class _Options:
    model: Annotated[
        Path, typer.Argument(metavar="FILE", help="Reduced model, from turgor reduce.", show_default=False)
    ]
    path: Annotated[
        Path,
        typer.Argument(
            metavar="PATH",
            help="CSV with time_s, and tip_x_mm, tip_y_mm, tip_z_mm (displacements), bending_angle_deg, or "
            "force_N on an obstacle (force_plate_N where there are several).",
            show_default=False,
        ),
    ]
    limit: Annotated[
        list[str] | None,
        typer.Option(
            "--limit",
            metavar="NAME=FROM..TO",
            help="Range of an input, such as pressure='0..20 kPa', or of the volume of a cavity, such as "
            "cavity='0..12 mL'; as often as needed.",
            show_default=False,
        ),
    ] = None
    rate: Annotated[
        list[str] | None,
        typer.Option(
            "--rate",
            metavar="NAME=RATE",
            help="Largest change of an input in a second, such as pressure='30 kPa'; as often as needed.",
            show_default=False,
        ),
    ] = None
    output: Annotated[Path | None, output_option("Folder of table, picture and page; by default NAME-track.")] = None
    force: Annotated[bool, typer.Option("--force", help="Replace what the folder holds.")] = False
    as_json: Json = False
    debug: Debug = False


def _run(options: _Options) -> None:
    """Find pressures with which the tip, bending angle or contact force of a reduced model follows a path."""
    with errors_as_sentences(options.debug, options.as_json) as answer:
        from turgor.cli.answers.systems import track_result
        from turgor.job.output.folder import claimed
        from turgor.reduced.history_table import further_columns
        from turgor.reduced.states.reduced import Reduced
        from turgor.systems.control.path_file import read_path
        from turgor.systems.control.track import track

        reduced = Reduced.load(options.model)
        wanted = read_path(options.path, further_columns(reduced))
        limits = _limits(options, reduced.inputs, reduced.faces)
        folder = options.output if options.output is not None else Path(f"{options.model.stem}-track")
        with claimed(folder, options.force, files=FILES) as place:
            result = track(reduced, wanted.rows, times=wanted.times, output=wanted.output, limits=limits)
            _write(place, result, options.path.stem)
        _say(result)
        answer.give(lambda: track_result(result, folder))
        typer.echo(f"Table, picture and page with the motion in {folder}.")
        raise typer.Exit(DONE)


track_command = command_of(_Options, _run)


def _limits(options: _Options, box: "Inputs", cavities: Sequence[str]) -> "Limits":
    from turgor.systems.control.limits import Limits

    low, high, volumes, rates = {}, {}, {}, {}
    for text in options.limit or ():
        name, value = _named(text, "--limit", "NAME=FROM..TO", "pressure='0..20 kPa'")
        first, dots, last = (part.strip() for part in value.partition(".."))
        if not (dots and first and last):
            raise TurgorError(f"--limit is '{text}'; write NAME=FROM..TO, such as --limit pressure='0..20 kPa'.")
        if name in cavities:
            volumes[name] = _ends(first, last, "mL", f"--limit {name}")
        else:
            place = box.place(name)
            low[name], high[name] = _ends(first, last, box.units[place], f"--limit {name}")
    for text in options.rate or ():
        name, value = _named(text, "--rate", "NAME=RATE", "pressure='30 kPa'")
        rates[name] = _number(value.removesuffix("/s"), box.units[box.place(name)], f"--rate {name}")
    return Limits(low=low, high=high, rate=rates, volume=volumes)


def _named(text: str, option: str, form: str, example: str) -> tuple[str, str]:
    name, sign, value = (part.strip() for part in text.partition("="))
    if not (sign and name and value):
        raise TurgorError(f"{option} is '{text}'; write {form}, such as {option} {example}.")
    return name, value


def _ends(first: str, last: str, unit: str, where: str) -> tuple[float, float]:
    """Read both ends of a range; the first may have the other's unit."""
    from turgor.units import split_quantity

    given = split_quantity(last)
    if unit and given is not None and first.removeprefix("-").replace(".", "", 1).isdigit():
        first = f"{first} {given[1]}"
    return _number(first, unit, where), _number(last, unit, where)


def _number(text: str, unit: str, where: str) -> float:
    from turgor.studies.runs.jobs.job_numbers import JobNumber, read_number

    return read_number(text, JobNumber(key=where, value=0.0, unit=unit), where)


def _write(folder: Path, result: "Track", title: str) -> None:
    from turgor.job.output.manifest import list_files
    from turgor.systems.control.page import write_page
    from turgor.views.plots.systems.track_plot import write_track_plot

    list_files(folder, FILES)
    response = result.response()
    response.to_csv(folder / FILES[0])
    write_track_plot(folder / FILES[1], response, title=title)
    write_page(result, folder / FILES[2], title)


def _say(result: "Track") -> None:
    from turgor.foundation.response import COLUMN_UNITS

    unit = result.output.unit
    distance = result.distance / COLUMN_UNITS[unit]
    worst = int(distance.argmax())
    typer.echo(
        f"{len(distance)} rows; distance to the path {distance.mean():.3g} {unit} in the mean, {distance[worst]:.3g} "
        f"{unit} at most, in row {worst + 1}."
    )
    limits = sorted({name for names in result.active for name in names})
    for name in limits:
        rows = [place + 1 for place, names in enumerate(result.active) if name in names]
        typer.echo(f"At the limit '{name}': {len(rows)} rows, the first is row {rows[0]}.")

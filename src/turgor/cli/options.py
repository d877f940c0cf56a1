"""Arguments and options that several commands have, and commands whose options are the fields of a dataclass."""

from collections.abc import Callable, Sequence
from dataclasses import MISSING, fields
from inspect import Parameter, Signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

if TYPE_CHECKING:
    from turgor.job.job import Job

JobFile = Annotated[Path, typer.Argument(metavar="JOB", help="Job file in TOML.", show_default=False)]
JobOrStudy = Annotated[
    Path,
    typer.Argument(
        metavar="FILE", help="Job file in TOML, or a study file, whose tables state the options.", show_default=False
    ),
]
Changes = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Change a value of the job, such as loads.pressure='30 kPa'; as often as needed.",
        show_default=False,
    ),
]
Compliance = Annotated[
    str,
    typer.Option(
        help="How far the machine or rig gives way, such as '0.02 mm/N'; or the file of a pull on a stiff specimen, "
        "which shows it."
    ),
]
Retry = Annotated[bool, typer.Option("--retry", help="Compute runs that failed or ended early before again.")]
#: The option for one JSON document.
JSON = "--json"

Json = Annotated[bool, typer.Option(JSON, help="Print one JSON document, for programs.")]
Debug = Annotated[bool, typer.Option("--debug", help="Show where an error was raised.")]

Options = TypeVar("Options")


def output_option(text: str) -> Any:
    """Return the option that names where results go.

    Parameters
    ----------
    text : str
        Its help.
    """
    return typer.Option("--output", "-o", help=text, show_default=False)


def requested_job(job: Path, changes: Sequence[str] | None) -> "Job":
    """Read a job file with the changes that ``--set`` states.

    Parameters
    ----------
    job : Path
        The file.
    changes : sequence of str or None
        Keys and values, such as ``loads.pressure=30 kPa``.

    Returns
    -------
    Job
    """
    from turgor.job.read import read_job
    from turgor.job.text.overrides import parse_changes

    return read_job(job, parse_changes(changes or ()))


def job_without_stages(job: Path, changes: Sequence[str] | None, what: str) -> "Job":
    """Read a job as `requested_job`; refuse one with stages, of whose loads a command would see the first ones only.

    Parameters
    ----------
    job, changes
        As for `requested_job`.
    what : str
        What the command makes, for the message.
    """
    from turgor.foundation.errors import TurgorError

    read = requested_job(job, changes)
    if read.procedure.stages:
        raise TurgorError(
            f"stages: {what} follows from [loads] alone, and this job has stages; leave [[stages]] out, and state what "
            "acts in [loads]."
        )
    return read


def check_new(file: Path, force: bool, option: str) -> None:
    """Raise an error if a file exists that an option names, unless ``--force`` says that it may be replaced."""
    from turgor.foundation.errors import TurgorError

    if file.exists() and not force:
        raise TurgorError(f"{option} is '{file}', which exists; name another file, or replace it with --force.")


def name_and_unit(text: str) -> tuple[str, str]:
    """Split what ``--unit`` states, such as ``pressure=kPa``.

    Parameters
    ----------
    text : str

    Returns
    -------
    (str, str)
    """
    from turgor.foundation.errors import TurgorError

    name, sign, unit = (part.strip() for part in text.partition("="))
    if not sign or not name or not unit:
        raise TurgorError(f"--unit is '{text}'; write the name of a column and its unit, such as --unit pressure=kPa.")
    return name, unit


def option_quantity(option: str, text: str, dimension: str) -> float:
    """Return the quantity that an option states, in SI units; what is wrong with it names the option.

    Parameters
    ----------
    option : str
        Such as ``"--size"``.
    text : str
        What was written there.
    dimension : str
        One of the keys of `turgor.units.UNITS`.

    Raises
    ------
    TurgorError
        If the text is no quantity of this dimension.

    Examples
    --------
    >>> option_quantity("--size", "2", "length")
    Traceback (most recent call last):
    turgor.TurgorError: --size: '2' needs a unit, for example '1.5 mm'. Known length units: m, cm, mm, um, µm, in, inch.
    """
    from turgor.foundation.errors import TurgorError
    from turgor.units import parse_quantity

    try:
        return parse_quantity(text.strip(), dimension)
    except TurgorError as error:
        raise TurgorError(f"{option}: {error}") from None


def command_of(options: Callable[..., Options], run: Callable[[Options], None]) -> Callable[..., None]:
    """Make a command of typer from a dataclass: each field is an argument or an option, according to its annotation.

    Parameters
    ----------
    options : type
        A dataclass whose fields are annotated with ``typer.Argument`` or ``typer.Option``.
    run : callable
        ``run(options)`` carries out the command; its docstring is the help text.

    Returns
    -------
    callable
    """

    def command(**given: Any) -> None:
        run(options(**given))

    items = fields(options)  # type: ignore[arg-type]
    defaults = [Parameter.empty if item.default is MISSING else item.default for item in items]
    command.__signature__ = Signature(  # type: ignore[attr-defined]
        [
            Parameter(item.name, Parameter.KEYWORD_ONLY, default=default, annotation=item.type)
            for item, default in zip(items, defaults, strict=True)
        ]
    )
    command.__annotations__ = {item.name: item.type for item in items}
    command.__doc__ = run.__doc__
    return command

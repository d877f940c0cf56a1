"""Commands ``turgor studio`` and ``turgor live``: the page in a browser."""

from pathlib import Path
from typing import Annotated
from urllib.parse import quote

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import Debug
from turgor.foundation.errors import NotHere, TurgorError, near_file


def studio_command(
    folder: Annotated[
        Path, typer.Argument(metavar="FOLDER", help="With job files; by default this one.", show_default=False)
    ] = Path(),
    port: Annotated[
        int | None, typer.Option(min=0, max=65535, help="Port; by default 8765 or a free one.", show_default=False)
    ] = None,
    host: Annotated[
        str, typer.Option(help="Address to bind; any other than the default lets other machines in.")
    ] = "127.0.0.1",
    allow_host: Annotated[
        list[str] | None,
        typer.Option(help="Further name under which browsers reach it; as often as needed.", show_default=False),
    ] = None,
    browser: Annotated[bool, typer.Option(help="Open a browser.")] = True,
    debug: Debug = False,
) -> None:
    """Work with job files and runs in a browser: a local page, until Ctrl-C."""
    with errors_as_sentences(debug):
        serve_studio(folder, port, host, tuple(allow_host or ()), browser=browser)


def live_command(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="Reduced model, from turgor reduce.", show_default=False)
    ],
    port: Annotated[
        int | None, typer.Option(min=0, max=65535, help="Port; by default 8765 or a free one.", show_default=False)
    ] = None,
    browser: Annotated[bool, typer.Option(help="Open a browser.")] = True,
    debug: Debug = False,
) -> None:
    """Move a reduced model in a browser, by sliders or by its tip: one window of the studio, until Ctrl-C."""
    with errors_as_sentences(debug):
        if not file.is_file() or file.suffix != ".reduced":
            there = [each.name for each in file.parent.glob("*.reduced")] if file.parent.is_dir() else []
            raise TurgorError(
                f"'{file}' is no file of a reduced model{near_file(file, there)}",
                command="Train one with: turgor reduce JOB --along loads.pressure='0..20 kPa' -o finger.reduced",
            )
        start = f"#/live/{quote(file.name)}/alone"
        serve_studio(file.resolve().parent, port, "127.0.0.1", (), start=start, browser=browser)


def serve_studio(
    folder: Path, port: int | None, host: str, names: tuple[str, ...], *, start: str = "", browser: bool = True
) -> None:
    """Serve the studio of a folder, or say what to install."""
    try:
        from turgor.studio.serve import Address, serve
    except ModuleNotFoundError as error:
        raise NotHere(
            f"the studio needs the package {error.name}.", command="Install it with: pip install 'turgor[studio]'"
        ) from error
    address = Address(host=host, names=names) if port is None else Address(host=host, port=port, names=names)
    serve(folder, lambda text: typer.echo(text, err=False), address, start=start, browser=browser)

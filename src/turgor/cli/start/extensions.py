"""Commands of other packages: they are entry points of the group ``turgor.commands``.

The list of what is installed is read only where the arguments begin with no command of turgor: reading it takes longer
than many commands do.
"""

from collections.abc import Callable
from importlib.metadata import EntryPoint, entry_points
from typing import Any

import typer

from turgor.cli.exits import errors_as_sentences
from turgor.cli.options import JSON
from turgor.foundation.errors import TurgorError

#: Group of the entry points.
GROUP = "turgor.commands"

#: Commands that turgor's own documents describe, by the package that adds them.
KNOWN = {"guidelines": "turgor-guidelines"}


def add_extensions(app: typer.Typer, taken: set[str]) -> None:
    """Add the commands of installed packages, and for known packages that are missing a command that says so.

    Parameters
    ----------
    app : typer.Typer
        The command line.
    taken : set of str
        Names of commands that it has; no package replaces one of them.
    """
    installed = {point.name: point for point in entry_points(group=GROUP) if point.name not in taken}
    for name, point in installed.items():
        _add(app, name, point)
    for name, package in KNOWN.items():
        if name not in installed:
            _refuse(app, name, f"turgor {name} needs the package {package}: pip install {package}")


def _add(app: typer.Typer, name: str, point: EntryPoint) -> None:
    try:
        command = point.load()
    except Exception as error:  # the other commands work, whatever is wrong with this one
        _refuse(app, name, f"turgor {name} of '{point.value}' cannot be imported: {type(error).__name__}: {error}")
        return
    if isinstance(command, typer.Typer):
        app.add_typer(command, name=name)
    else:
        app.command(name)(command)


def _refuse(app: typer.Typer, name: str, sentence: str) -> None:
    """Add a command that takes any arguments and ends with a sentence; the help text does not list it."""
    anything = {"allow_extra_args": True, "ignore_unknown_options": True, "help_option_names": []}
    app.command(name, hidden=True, context_settings=anything)(_refusing(sentence))


def _refusing(sentence: str) -> Callable[..., Any]:
    def command(context: typer.Context) -> None:
        with errors_as_sentences(False, JSON in context.args):
            raise TurgorError(sentence)

    return command

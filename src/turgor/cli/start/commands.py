"""Commands by their names, each in a file of its own."""

from collections.abc import Mapping
from importlib import import_module
from typing import Annotated

import typer

from turgor import __version__
from turgor.cli.start.extensions import add_extensions

#: Where each command is defined, in the order of the help text. A name that ends in ``_app`` is a group of commands.
COMMANDS: Mapping[str, str] = {
    "run": "run.run_command",
    "studio": "start.studio.studio_command",
    "live": "start.studio.live_command",
    "materials": "materials.materials_app",
    "actuators": "families.actuators.actuators_command",
    "check": "check.check_command",
    "init": "families.init.init_command",
    "report": "postprocess.report_command",
    "cache": "start.cache.cache_command",
    "measure": "postprocess.measure_command",
    "compare": "postprocess.compare_command",
    "calibrate": "analyses.calibrate.calibrate_command",
    "sweep": "analyses.sweep.sweep_command",
    "uncertainty": "analyses.uncertainty.uncertainty_command",
    "optimize": "analyses.optimize.optimize_command",
    "gradient": "analyses.gradient.gradient_command",
    "sensitivity": "analyses.sensitivity.sensitivity_command",
    "surrogate": "analyses.surrogate.surrogate_command",
    "predict": "analyses.surrogate.predict_command",
    "reduce": "analyses.reduce.reduce_command",
    "inspect": "inspect.inspect_command",
    "fit": "fitting.fit.fit_command",
    "export": "export.export_command",
    "import": "families.import_deck.import_command",
    "mesh": "mesh.mesh_command",
    "modes": "modes.modes_command",
    "buckling": "modes.buckling_command",
    "convergence": "convergence.convergence_command",
    "section": "analyses.section.section_command",
    "air": "systems.air.air_command",
    "track": "systems.track.track_command",
    "robot": "systems.robot.robot_command",
}


def command_line(first: str = "") -> typer.Typer:
    """Make the command line with all commands of turgor.

    Parameters
    ----------
    first : str
        First argument. Where it is no command of turgor, the commands of installed packages are added, see
        `turgor.cli.start.extensions`.

    Returns
    -------
    typer.Typer
    """
    app = typer.Typer(
        add_completion=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        help="Finite element modeling of soft fluidic actuators.",
        epilog="Exit codes: 0 done, 1 usage or bad input, 2 a check found an error, 3 not converged, 130 Ctrl-C.",
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(_options)
    for name, place in COMMANDS.items():
        module, _, function = place.rpartition(".")
        command = getattr(import_module(f"turgor.cli.{module}"), function)
        if function.endswith("_app"):
            app.add_typer(command, name=name)
        else:
            app.command(name)(command)
    if first not in COMMANDS:
        add_extensions(app, set(COMMANDS))
    return app


def _print_version(requested: bool) -> None:
    if requested:
        typer.echo(f"turgor {__version__}")
        raise typer.Exit


def _options(
    version: Annotated[
        bool,
        typer.Option("--version", "-V", callback=_print_version, is_eager=True, help="Print the version and stop."),
    ] = False,
) -> None:
    """Read the options before the command."""

"""Command ``turgor actuators``: the families and their keys."""

import typer


def actuators_command() -> None:
    """List the actuator families and their keys with defaults."""
    from dataclasses import fields

    from turgor.job.job import ACTUATORS
    from turgor.job.output.lock import dimensions
    from turgor.job.text.quantities import shown

    for name, family in ACTUATORS.items():
        typer.echo(f"{name}: {(family.__doc__ or '').splitlines()[0]}")
        values = dimensions(family())
        for item in fields(family):  # type: ignore[arg-type]
            typer.echo(f"  {item.name} = {shown(values[item.name])}")
    typer.echo("cad_file: An actuator from a CAD file; `turgor inspect` shows what it holds.")
    typer.echo("  file, unit, faces, regions, split")

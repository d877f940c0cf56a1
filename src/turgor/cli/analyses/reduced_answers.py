"""Answers of reduced models for ``turgor predict``: at some inputs, and along histories of them."""

from typing import TYPE_CHECKING, Any

import typer

from turgor.cli.exits import DONE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turgor.cli.exits import Answer
    from turgor.core.model.history import History
    from turgor.reduced.states.answer import ReducedState
    from turgor.reduced.states.following import Moving
    from turgor.reduced.states.inputs import Inputs
    from turgor.reduced.states.reduced import Reduced

#: Rows of a table along a history where no step is stated.
ROWS = 50


def say_prediction(chosen: Any, answer: "Answer") -> None:
    """Print what a reduced model answers at inputs such as ``pressure=10 kPa``, or along histories of them."""
    from turgor.cli.analyses.given_cavities import answer_with, given_cavities
    from turgor.cli.answers.reduced import answer_result
    from turgor.foundation.errors import TurgorError
    from turgor.reduced.measures import readings
    from turgor.reduced.states.reduced import Reduced

    reduced = Reduced.load(chosen.file)
    given, texts = given_cavities(chosen.at or (), reduced)
    values = dict(pair for text in texts for pair in _values(text, reduced.inputs))
    if chosen.history:
        if given:
            raise TurgorError(f"--at {next(iter(given))} is a state at rest and does not go with --history.")
        _say_history(reduced, values, chosen, answer)
    for name in ("duration", "step", "damping", "motion", "output"):
        if getattr(chosen, name):
            raise TurgorError(f"--{name} goes with --history.")
    result = answer_with(reduced, values, given)
    read = readings(result)
    if given:
        typer.echo(f"at {reduced.inputs.text(result.inputs)}")
    for each in read:
        typer.echo(f"{each.words} {each.text}")
    if read:
        typer.echo("The first ± is the error of the mesh; that of the reduction is the largest known along the ranges.")
    _say(result)
    answer.give(lambda: answer_result(result, read))
    raise typer.Exit(DONE)


def _say(result: "ReducedState") -> None:
    """Print volumes, tip and forces of an answer, and its estimated error."""
    for face, volume in result.volumes.items():
        typer.echo(f"volume of {face} {volume * 1e6:.5g} mL")
    if result.reduced.tip.any():
        typer.echo(f"displacement of the tip ({', '.join(f'{x * 1e3:.5g}' for x in result.tip)}) mm")
    for obstacle, force in result.obstacle_forces.items():
        typer.echo(f"force on {obstacle} ({', '.join(f'{x:.5g}' for x in force)}) N")
    typer.echo(f"largest displacement {abs(result.displacement).max() * 1e3:.5g} mm")
    typer.echo(f"estimated error of the displacement {result.estimate:.2g} of the largest in training")
    if result.doubtful:
        typer.echo("This answer is doubtful: its error may be more than 2 %; train more densely.")
    typer.echo(
        f"largest held-out error {result.reduced.held_out.worst:.2g} of the largest displacement; "
        f"{result.iterations} updates"
    )


def _say_history(reduced: "Reduced", values: dict[str, float], chosen: Any, answer: "Answer") -> None:
    """Follow histories of the inputs and write the table."""
    from turgor.cli.answers.reduced import followed_result
    from turgor.reduced.history_table import history_table

    histories = dict(_history(text, reduced.inputs) for text in chosen.history or ())
    times, table = _table(reduced, values, histories, chosen)
    followed = reduced.follow(times, dict(zip(reduced.inputs.keys, table.T, strict=True)), _moving(chosen))
    file = chosen.output or chosen.file.with_suffix(".csv")
    history_table(reduced, followed).to_csv(file)
    worst = max(each.estimate for each in followed.answers)
    typer.echo(f"{len(times)} states over {times[-1]:g} s, written to {file}.")
    typer.echo(f"largest estimated error {worst:.2g} of the largest displacement in training")
    doubtful = sum(each.doubtful for each in followed.answers)
    if doubtful:
        typer.echo(f"{doubtful} of the states are doubtful: their error may be more than 2 %.")
    answer.give(lambda: followed_result(followed, file))
    raise typer.Exit(DONE)


def _table(
    reduced: "Reduced",
    values: dict[str, float],
    histories: "dict[str, str | list[tuple[float, float]]]",
    chosen: Any,
) -> "tuple[NDArray, NDArray]":
    """Times (k,) and inputs (k, n)."""
    import numpy as np

    from turgor.core.model.history import checked, over_time, share_at
    from turgor.foundation.errors import TurgorError

    ends = [float(each[-1][0]) for each in histories.values() if not isinstance(each, str)]
    if not ends and not chosen.duration:
        raise TurgorError("a history that is an expression needs --duration, such as --duration '2 s'.")
    duration = _time(chosen.duration, "--duration") if chosen.duration else max(ends)
    step = _time(chosen.step, "--step") if chosen.step else duration / ROWS
    times = np.unique(np.append(np.arange(0.0, duration, step), duration))
    shares: dict[str, History] = {}
    for key, each in histories.items():
        points = each if isinstance(each, str) else _extended(each, duration)
        shares[key] = checked(over_time(points, duration), f"--history {key}")
    columns = []
    for key in reduced.inputs.keys:
        if key not in values:
            reduced.inputs.vector(values)  # says which value is missing
        history = shares.get(key)
        acting = [1.0 if history is None else share_at(history, float(time / duration)) for time in times]
        columns.append(values[key] * np.array(acting))
    return times, np.array(columns).T


def _extended(points: "list[tuple[float, float]]", duration: float) -> "list[tuple[float, float]]":
    """Points up to the duration, the last share going on."""
    return points if points[-1][0] >= duration else [*points, (duration, points[-1][1])]


def _history(text: str, inputs: "Inputs") -> "tuple[str, str | list[tuple[float, float]]]":
    """Read a history such as ``pressure=[[0, 0], [0.02, 1]]`` or ``pressure=sin(pi * t)``."""
    from ast import literal_eval

    from turgor.foundation.errors import TurgorError

    name, sign, given = (part.strip() for part in text.partition("="))
    if not (sign and name and given):
        raise TurgorError(
            f"--history is '{text}'; write NAME=SHARES, such as --history pressure='[[0, 0], [0.02, 1], [0.5, 1]]'."
        )
    key = inputs.keys[inputs.place(name)]
    if not given.startswith("["):
        return key, given
    try:
        points = [(float(time), float(share)) for time, share in literal_eval(given)]
    except (ValueError, TypeError, SyntaxError):
        points = []
    if not points:
        raise TurgorError(f"--history {name} is '{given}'; points (time in s, share) are needed: [[0, 0], [0.02, 1]].")
    return key, points


def _moving(chosen: Any) -> "Moving | None":
    from turgor.foundation.errors import TurgorError
    from turgor.reduced.states.following import Moving

    if not chosen.motion:
        if chosen.damping:
            raise TurgorError("--damping goes with --motion.")
        return None
    damping = _time(chosen.damping, "--damping") if chosen.damping else 0.0
    return Moving(step=_time(chosen.step, "--step"), stiffness_damping=damping) if chosen.step else Moving(
        stiffness_damping=damping
    )  # fmt: skip


def _time(text: str, option: str) -> float:
    from turgor.studies.runs.jobs.job_numbers import JobNumber, read_number

    return read_number(text, JobNumber(key=option, value=0.0, unit="s"), option)


def _values(text: str, inputs: "Inputs") -> list[tuple[str, float]]:
    """Read ``NAME=VALUE``, or values of all components of a vector with commas between them."""
    from turgor.cli.analyses.reduce import number_of
    from turgor.foundation.errors import TurgorError

    name, sign, value = (part.strip() for part in text.partition("="))
    if not (sign and name and value):
        raise TurgorError(f"--at is '{text}'; write NAME=VALUE, such as --at pressure='10 kPa'.")
    places, parts = inputs.components(name), [part.strip() for part in value.split(",")]
    if len(places) != len(parts):
        raise TurgorError(f"--at {name} has {len(parts)} values; {len(places)} are needed, with commas between them.")
    return [
        (inputs.keys[place], number_of(part, inputs.keys[place], inputs.units[place], "--at"))
        for place, part in zip(places, parts, strict=True)
    ]

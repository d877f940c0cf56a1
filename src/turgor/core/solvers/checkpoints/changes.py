"""Changes: the values of a loop that its steps have changed, which are all that a checkpoint holds.

Everything else is made again in the same way when the run goes on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from turgor.core.engine.cells.cell_materials import Isochoric
from turgor.core.engine.system import Evaluation, System

#: What was there at the beginning of the loop: the fields of each of its parts.
Baseline = Sequence[Mapping[str, Any]]


def baseline(parts: Sequence[Any]) -> Baseline:
    """The fields of the parts of a loop, dataclasses, as they are now.

    Parameters
    ----------
    parts : sequence of dataclass
        What the steps of the loop change.

    Returns
    -------
    sequence of dict
    """
    return [{item.name: getattr(part, item.name) for item in fields(part)} for part in parts if is_dataclass(part)]


def changes(parts: Sequence[Any], before: Baseline) -> tuple[dict[str, Any], ...]:
    """The fields that are another object now than at the beginning, and all lists, which change in place.

    Parameters
    ----------
    parts : sequence of dataclass
    before : sequence of dict
        From `baseline`.

    Returns
    -------
    tuple of dict
    """
    differences = []
    for part, old in zip(parts, before, strict=True):
        now = {name: getattr(part, name) for name in old}
        differences.append(
            {
                name: _bare(list(value) if isinstance(value, list) else value)
                for name, value in now.items()
                if isinstance(value, list) or value is not old[name]
            }
        )
    return tuple(differences)


def restore(parts: Sequence[Any], values: Sequence[Mapping[str, Any]], system: System) -> None:
    """Give the parts of a loop the values of a checkpoint.

    Parameters
    ----------
    parts : sequence of dataclass
    values : sequence of dict
        From `changes`.
    system : System
        Finds again what a checkpoint leaves out of an evaluation.
    """
    for part, changed in zip(parts, values, strict=True):
        for name, value in changed.items():
            if isinstance(value, list):
                getattr(part, name)[:] = value
            else:
                setattr(part, name, _whole(value, system))


def _bare(value: Any) -> Any:
    """An evaluation without the stresses at every point, which are large, and without forces of the step."""
    if not isinstance(value, Evaluation):
        return value
    empty = Isochoric(np.empty(0), np.empty(0), np.empty(0))
    return replace(value, isochoric=empty, addition=None)


def _whole(value: Any, system: System) -> Any:
    if not isinstance(value, Evaluation):
        return value
    laws = system.rubber.at(value.load_factor).laws(system.split(value.unknowns)[0], value.history)
    assert laws is not None
    return replace(value, isochoric=laws)

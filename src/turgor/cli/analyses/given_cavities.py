"""What ``--at`` states of cavities of a reduced model instead of pressures: an injected volume, an amount of gas."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from turgor.reduced.states.answer import ReducedState
    from turgor.reduced.states.reduced import Reduced

#: What a cavity may be given, with the words of job files and the unit.
UNITS = {"volume": "mL", "mass_ratio": ""}


def given_cavities(texts: Sequence[str], reduced: "Reduced") -> tuple[dict[str, dict[str, float]], list[str]]:
    """Split ``cavity.volume=5 mL`` and ``cavity.mass_ratio=1.3`` from values of inputs.

    Parameters
    ----------
    texts : sequence of str
        Of ``--at``.
    reduced : Reduced

    Returns
    -------
    (dict, list of str)
        Values [SI] by cavity for ``"volume"`` and for ``"mass_ratio"``, and the other texts.
    """
    from turgor.foundation.errors import TurgorError, unknown
    from turgor.studies.runs.jobs.job_numbers import JobNumber, read_number

    given: dict[str, dict[str, float]] = {}
    others = []
    for text in texts:
        name, _, value = (part.strip() for part in text.partition("="))
        cavity, _, kind = name.rpartition(".")
        if kind not in UNITS:
            others.append(text)
            continue
        if not cavity and len(reduced.faces) > 1:
            raise TurgorError(f"--at {name} needs a cavity; write one of {_names(reduced, kind)}.")
        if cavity and cavity not in reduced.faces:
            raise unknown("cavity", cavity, reduced.faces)
        number = read_number(value, JobNumber(key=name, value=0.0, unit=UNITS[kind]), f"--at {name}")
        given.setdefault(kind, {})[cavity or reduced.faces[0]] = number
    if len(given) > 1:
        raise TurgorError("--at takes volumes of cavities or their mass ratios, not both at once.")
    return given, others


def answer_with(
    reduced: "Reduced", values: Mapping[str, float], given: Mapping[str, dict[str, float]]
) -> "ReducedState":
    """Find the equilibrium at values of inputs, and at volumes or amounts of gas of cavities."""
    from turgor.reduced.states.controlled import at_gas, at_volumes

    if "volume" in given:
        return at_volumes(reduced, given["volume"], values)
    if "mass_ratio" in given:
        return at_gas(reduced, given["mass_ratio"], values)
    return reduced.solve(values)


def _names(reduced: "Reduced", kind: str) -> str:
    return ", ".join(f"{face}.{kind}" for face in reduced.faces)

"""Question: the model to solve, and its magnitudes."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from turgor.core.model.model import Model
from turgor.core.solvers.procedures.procedure import Procedure


@dataclass(frozen=True, slots=True, kw_only=True)
class Question:
    """A model and the procedure that follows its path.

    Parameters
    ----------
    model : Model
    procedure : Static, VolumeControl, …
        One procedure; a sequence is a question for each stage.
    """

    model: Model
    procedure: Procedure


@dataclass(frozen=True, slots=True)
class Magnitude:
    """A number of a question.

    Parameters
    ----------
    where : str
        What has it, as the subject of a sentence, such as ``"Material 'rubber'"``.
    value : float
        In SI units.
    """

    where: str
    value: float


#: Larger and smaller units of an SI unit, from large to small.
SCALES = {
    "Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")),
    "m": ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")),
}


def shown(value: float, unit: str) -> str:
    """Write a value with three digits in a unit that suits it.

    Examples
    --------
    >>> shown(48e9, "Pa"), shown(2e-4, "m"), shown(1.07, "kg/m³"), shown(3000.0, ""), shown(1e6, "")
    ('48 GPa', '200 µm', '1.07 kg/m³', '3000', '1e+06')
    """
    scales = SCALES.get(unit, ((1.0, unit),))
    factor, name = next((each for each in scales if abs(value) >= each[0]), scales[-1])
    number = value / factor
    digits = 4 if 1000 <= abs(number) < 10_000 else 3
    return f"{number:.{digits}g} {name}".strip()


#: Reads the magnitudes of one quantity from a question.
Reader = Callable[[Question], Iterator[Magnitude]]

"""Inputs of a propagation of uncertainty: numbers with a spread, and whole sets of numbers such as replicates."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite

import numpy as np

from turgor.foundation.errors import TurgorError, unknown


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """A number that is not known exactly.

    Parameters
    ----------
    name : str
        Keyword of the function that computes the response, or the column that drives, such as ``"pressure"``.
    mean : float or None [SI]
        Its value; that of the replicates by default. A column that drives has none.
    deviation : float or None [SI]
        Its standard deviation; that of the replicates by default. A tolerance ± t within which all values are equally
        likely has t/√3.
    replicates : tuple of float [SI]
        Measured values, at least two, instead of mean and deviation.
    label : str
        Name in sentences and pictures, such as ``"rubber"``; by default the name. Spreads of one label count as one.

    Examples
    --------
    >>> Spread(name="wall", replicates=(1.4e-3, 1.5e-3, 1.6e-3)).standard
    (0.0015, 0.0001)
    """

    name: str
    mean: float | None = None
    deviation: float | None = None
    replicates: tuple[float, ...] = ()
    label: str = ""

    def __post_init__(self) -> None:
        if not self.label:
            object.__setattr__(self, "label", self.name)
        if self.replicates and (self.deviation is not None or len(self.replicates) < 2):
            raise TurgorError(f"spread '{self.name}': give two replicates or more, or a deviation, not both.")
        if not self.replicates and (self.deviation is None or not (isfinite(self.deviation) and self.deviation > 0)):
            raise TurgorError(f"spread '{self.name}' has the deviation {self.deviation}; allowed is above 0.")

    @property
    def standard(self) -> tuple[float, float]:
        """Mean and standard deviation [SI]; the mean is nan where there is none."""
        values = np.array(self.replicates) if self.replicates else np.array([np.nan])
        mean = self.mean if self.mean is not None else float(values.mean())
        deviation = self.deviation if self.deviation is not None else float(values.std(ddof=1))
        return round(mean, 15), float(f"{deviation:.12g}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Alternatives:
    """Whole sets of numbers, one of which holds: constants fitted to each specimen, batch or published record.

    Constants of one fit belong together, so each set is computed as it is, and no constant is varied alone.

    Parameters
    ----------
    sets : tuple of mapping of str to float [SI]
        Two or more, all with the same names; the first one is the nominal one. Names of records are text.
    label : str
        Name in sentences and pictures, such as ``"rubber"``.
    names : tuple of str
        Name of each set, such as that of a record. Sets with names are reported one by one.
    doubts : tuple of tuple of str
        Codes of what is doubtful about each set that has a name.
    note : str
        What the result says about them.
    """

    sets: tuple[Mapping[str, float | str], ...]
    label: str
    names: tuple[str, ...] = ()
    doubts: tuple[tuple[str, ...], ...] = ()
    note: str = ""

    def __post_init__(self) -> None:
        if len(self.sets) < 2:
            raise TurgorError(f"'{self.label}' has {len(self.sets)} sets of numbers; two or more are needed.")
        for given in (self.names, self.doubts):
            if given and len(given) != len(self.sets):
                raise TurgorError(
                    f"'{self.label}' has {len(self.sets)} sets, but {len(given)} names or doubts of them."
                )
        for each in self.sets:
            if set(each) != set(self.sets[0]):
                raise TurgorError(
                    f"the sets of '{self.label}' have different names: {', '.join(self.sets[0])}; {', '.join(each)}."
                )


Input = Spread | Alternatives


def nominal_values(inputs: Sequence[Input], drives: Sequence[str]) -> dict[str, float | str]:
    """Return the nominal value of every number [SI], without those of columns that drive.

    Parameters
    ----------
    inputs : sequence of Spread or Alternatives
    drives : sequence of str
        Names that may be columns instead of numbers of the function.

    Returns
    -------
    dict of str to float or str

    Raises
    ------
    TurgorError
        If there is no input, one name occurs twice, or a spread of a number has no mean.
    """
    if not inputs:
        raise TurgorError("nothing has a spread; name one number or more.")
    values: dict[str, float | str] = {}
    for each in inputs:
        nominal: Mapping[str, float | str] = (
            each.sets[0] if isinstance(each, Alternatives) else {each.name: each.standard[0]}
        )
        for name, value in nominal.items():
            if name in values:
                raise TurgorError(f"'{name}' has two spreads; give it one.")
            if not _is_known(value) and name not in drives:
                raise TurgorError(f"spread '{name}' has no mean; give it one.")
            values[name] = value
    return {name: value for name, value in values.items() if _is_known(value)}


def _is_known(value: float | str) -> bool:
    return isinstance(value, str) or isfinite(value)


def check_inputs(names: Sequence[str], taken: Sequence[str]) -> None:
    """Raise an error if a function does not take a name.

    Parameters
    ----------
    names : sequence of str
    taken : sequence of str
        Those that it takes.
    """
    for name in names:
        if name not in taken:
            raise unknown("number with a spread", name, taken)

"""Designs: the points of a design space at which a study computes, chosen by a rule."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from itertools import product
from math import prod
from typing import Any

import numpy as np

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.limits import MOST_DESIGNS, most_designs
from turgor.studies.runs.factor import Array, Factor, Value, inputs_of
from turgor.studies.runs.files.tables import Cells, header
from turgor.studies.runs.rounding import rounded
from turgor.units import unit_value


@dataclass(frozen=True, slots=True, kw_only=True)
class Designs:
    """Points of a design space.

    Parameters
    ----------
    factors : tuple of Factor
        What varies.
    values : tuple of dict of str to float, int or str [SI]
        Value of each factor, for each design.
    rule : str
        How they were chosen, in words.
    """

    factors: tuple[Factor, ...]
    values: tuple[dict[str, Value], ...]
    rule: str = ""

    def __len__(self) -> int:
        """Count the designs."""
        return len(self.values)

    @property
    def inputs(self) -> Array:
        """Values of the factors, (designs, factors) [SI]; a choice is NaN."""
        return inputs_of(self.factors, list(self.values))


def design_table(factors: Sequence[Factor], values: Sequence[Mapping[str, Value]]) -> dict[str, Cells]:
    """Return a table of designs, whose headers have the units of the numbers below them.

    Parameters
    ----------
    factors : sequence of Factor
    values : sequence of mapping [SI]

    Returns
    -------
    dict of str to list

    Examples
    --------
    >>> wall = Factor(name="wall", levels=(1e-3, 2e-3), unit="mm")
    >>> design_table([wall], factorial([wall]).values)
    {'wall (mm)': [1.0, 2.0]}
    """
    table: dict[str, Cells] = {}
    for each in factors:
        given = [row[each.name] for row in values]
        unit = unit_value(each.unit)
        table[header(each.name, each.unit)] = [x if isinstance(x, str | int) else rounded(x / unit) for x in given]
    return table


def factorial(factors: Sequence[Factor]) -> Designs:
    """Return all combinations of the levels of factors; the last factor changes first.

    Parameters
    ----------
    factors : sequence of Factor
        A factor with a range and no levels has three.

    Returns
    -------
    Designs

    Raises
    ------
    TurgorError
        If there are more than 100 000 combinations.

    Examples
    --------
    >>> wall = Factor(name="wall", levels=(1e-3, 2e-3), unit="mm")
    >>> designs = factorial([wall, Factor(name="chambers", levels=(4, 6, 8), whole=True)])
    >>> len(designs), designs.values[1]
    (6, {'wall': 0.001, 'chambers': 6})
    """
    levels = [each.spaced() for each in factors]
    count = prod(len(each) for each in levels)
    if count > most_designs():
        raise TurgorError(
            f"a full factorial of {' × '.join(str(len(each)) for each in levels)} levels has {count} designs; allowed "
            f"are {most_designs()}; the environment variable {MOST_DESIGNS} states another limit. Give fewer levels, "
            "or take a Latin hypercube or Sobol points."
        )
    names = [each.name for each in factors]
    values = tuple(_design(factors, dict(zip(names, each, strict=True))) for each in product(*levels))
    return Designs(factors=tuple(factors), values=values, rule="full factorial")


def latin_hypercube(factors: Sequence[Factor], samples: int, seed: int = 0) -> Designs:
    """Return a Latin hypercube: each factor is cut into as many slices as there are samples, with one sample in each.

    Parameters
    ----------
    factors : sequence of Factor
        Whole numbers and choices have slices of equal size.
    samples : int
        Number of designs.
    seed : int
        Equal seeds give equal designs.

    Returns
    -------
    Designs

    Raises
    ------
    TurgorError
        If ``samples`` or ``seed`` is out of range.

    Examples
    --------
    >>> designs = latin_hypercube([Factor(name="wall", low=1e-3, high=2e-3)], 4, seed=1)
    >>> sorted(int(each["wall"] * 4000) for each in designs.values)
    [4, 5, 6, 7]
    """
    rule = f"Latin hypercube of {samples}"
    return _sampled(factors, samples, seed, rule, lambda qmc, k: qmc.LatinHypercube(k, rng=seed).random(samples))


def sobol(factors: Sequence[Factor], samples: int, seed: int = 0) -> Designs:
    """Return scrambled Sobol points, which fill the space more evenly than random ones.

    Parameters
    ----------
    factors : sequence of Factor
    samples : int
        Number of designs; powers of two are balanced: 16, 32, 64 …
    seed : int
        Of the scrambling; equal seeds give equal designs, and more samples begin with the same ones.

    Returns
    -------
    Designs

    Raises
    ------
    TurgorError
        If ``samples`` or ``seed`` is out of range.

    Examples
    --------
    >>> wall = Factor(name="wall", low=1e-3, high=2e-3)
    >>> sobol([wall], 8).values[:4] == sobol([wall], 4).values
    True
    """

    def drawn(qmc: Any, k: int) -> Any:
        # drawn in powers of two, because SciPy warns of others
        return qmc.Sobol(k, scramble=True, rng=seed).random_base2(max(samples - 1, 0).bit_length())[:samples]

    return _sampled(factors, samples, seed, f"{samples} Sobol points", drawn)


def _sampled(
    factors: Sequence[Factor], samples: int, seed: int, name: str, drawn: Callable[[Any, int], Any]
) -> Designs:
    if not 1 <= samples <= most_designs():
        raise TurgorError(
            f"samples is {samples}; allowed is 1 to {most_designs()}; the environment variable {MOST_DESIGNS} states "
            "another limit."
        )
    if seed < 0:
        raise TurgorError(f"seed is {seed}; allowed is 0 or more.")
    if not factors:
        raise TurgorError("a study needs a factor: something that varies.")
    shares = np.asarray(drawn(import_module("scipy.stats.qmc"), len(factors)))
    values = tuple(
        _design(factors, {each.name: each.at(float(share)) for each, share in zip(factors, row, strict=True)})
        for row in shares
    )
    return Designs(factors=tuple(factors), values=values, rule=f"{name}, seed {seed}")


def _design(factors: Sequence[Factor], given: dict[str, Value]) -> dict[str, Value]:
    """Return values as functions get them: whole numbers as such, others with nine digits."""
    values: dict[str, Value] = {}
    for each in factors:
        value = given[each.name]
        values[each.name] = value if isinstance(value, str) else int(value) if each.whole else rounded(float(value))
    return values

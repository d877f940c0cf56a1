"""Coding: values of factors as inputs of a model: shares of ranges, and 0 or 1 for each level of a choice."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.settings import RUNS

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Coding:
    """How points of factors, (q, k), become inputs of a model, (q, w), and back.

    A point has the value of a number [SI], and of a choice the place among its levels, from 0.

    Parameters
    ----------
    factors : tuple of Factor

    Examples
    --------
    >>> wall = Factor(name="wall", low=1.0, high=2.0)
    >>> coding = Coding(factors=(wall, Factor(name="rubber", levels=("soft", "firm", "stiff"))))
    >>> coding.inputs(np.array([[1.5, 2.0]]))
    array([[0.5, 0. , 0. , 1. ]])
    >>> coding.points(np.array([0.5, 0.0, 0.0, 1.0]))
    array([1.5, 2. ])
    """

    factors: tuple[Factor, ...]

    @property
    def width(self) -> int:
        """Number of inputs."""
        return sum(len(each.levels) if each.is_choice else 1 for each in self.factors)

    def columns(self, n: int) -> slice:
        """Return which inputs are those of a factor."""
        before = Coding(factors=self.factors[:n]).width
        return slice(before, before + Coding(factors=self.factors[n : n + 1]).width)

    def inputs(self, points: Array) -> Array:
        """Return the inputs at points, (..., k) to (..., w)."""
        table = np.empty((*points.shape[:-1], self.width))
        for n, each in enumerate(self.factors):
            values = points[..., n, None]
            if each.is_choice:
                table[..., self.columns(n)] = values == np.arange(len(each.levels))
            else:
                low, high = each.bounds
                table[..., self.columns(n)] = (values - low) / (high - low if high > low else 1.0)
        return table

    def points(self, inputs: Array) -> Array:
        """Return the points of inputs, (..., w) to (..., k)."""
        table = np.empty((*inputs.shape[:-1], len(self.factors)))
        for n, each in enumerate(self.factors):
            given = inputs[..., self.columns(n)]
            if each.is_choice:
                table[..., n] = given.argmax(axis=-1)
            else:
                low, high = each.bounds
                table[..., n] = low + given[..., 0] * (high - low)
        return table


def check_levels(factors: Sequence[Factor]) -> None:
    """Raise an error for a choice with too many levels.

    Parameters
    ----------
    factors : sequence of Factor
    """
    for each in factors:
        if each.is_choice and len(each.levels) > RUNS.most_levels:
            raise TurgorError(
                f"the factor '{each.name}' is a choice of {len(each.levels)}; a surrogate takes up to "
                f"{RUNS.most_levels}. Fit one surrogate to the rows of each choice."
            )

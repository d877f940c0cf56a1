"""Surrogate: a fast function in place of runs, with its error, that refuses inputs beyond its range."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.round_off import ROUND_OFF
from turgor.foundation.source import Source
from turgor.foundation.store.saved_objects import Saved
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.surrogates.coding import Coding
from turgor.studies.surrogates.gaussian_process import GaussianProcess
from turgor.studies.surrogates.held_out import HeldOut

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Prediction:
    """What a surrogate predicts for one design.

    Parameters
    ----------
    values, deviations : mapping of str to float [SI]
        Mean and calibrated standard deviation of each measure.
    units : mapping of str to str
        Unit in which each is shown.
    findings : tuple of Finding
        Where it was evaluated beyond its range.
    """

    values: Mapping[str, float]
    deviations: Mapping[str, float]
    units: Mapping[str, str]
    findings: tuple[Finding, ...] = ()

    def __getitem__(self, name: str) -> float:
        """Return the value of a measure [SI]; an unknown name fails with the near match."""
        if name not in self.values:
            raise unknown("measure of the surrogate", name, self.values)
        return self.values[name]

    def text(self, name: str) -> str:
        """Return value and standard deviation of a measure as text with its unit."""
        column = Column(name, self.units[name], np.array([self[name], self.deviations[name]]))
        value, deviation = column.in_unit
        return f"{value:.5g} ± {deviation:.2g} {column.unit}".rstrip()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surrogate(Saved):
    """A fast function fitted to a study: factors in, measures with their standard deviations out.

    `turgor.studies.surrogate` trains it. `save` and `load` write and read plain numbers; its study is not needed then.

    Parameters
    ----------
    factors : tuple of Factor
        Inputs with their ranges; the drive comes last where it is one.
    held_out : tuple of HeldOut
        Each measure with its error in rows that were held out.
    model : GaussianProcess
        Inputs as `Coding` makes them, outputs in SI units.
    along : str
        Name of the drive among the inputs; empty where there is none.
    rows : int
        Rows of the study that it was fitted to.
    notes : tuple of str
        What was left out.
    source : Source
        Where the study came from.
    """

    factors: tuple[Factor, ...]
    held_out: tuple[HeldOut, ...]
    model: GaussianProcess
    along: str
    rows: int
    notes: tuple[str, ...]
    source: Source

    def __repr__(self) -> str:
        ranges = ", ".join(f"{each.name} {each.range_text}" for each in self.factors)
        errors = ", ".join(f"{each.name} ± {100 * each.share:.2g} %" for each in self.held_out)
        return f"Surrogate(Gaussian process of {self.rows} rows: {ranges}; {errors} of the range)"

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the measures."""
        return tuple(each.name for each in self.held_out)

    @property
    def units(self) -> dict[str, str]:
        """Unit in which each measure is shown."""
        return {each.name: each.unit for each in self.held_out}

    def error(self, name: str) -> HeldOut:
        """Return how a measure is predicted in held-out rows; an unknown name fails with the near match."""
        for each in self.held_out:
            if each.name == name:
                return each
        raise unknown("measure of the surrogate", name, self.measures)

    def summary(self) -> str:
        """Return the fitted study and the errors in sentences."""
        return "\n".join([repr(self), *(each.sentence for each in self.held_out), *self.notes])

    def predict(self, values: Mapping[str, Value], *, extrapolate: bool = False) -> Prediction:
        """Return the measures of one design.

        Parameters
        ----------
        values : mapping of str to float or str [SI]
            Value of each factor, the name of a choice.
        extrapolate : bool
            Whether values beyond the ranges are taken, with a finding that says so.

        Returns
        -------
        Prediction

        Raises
        ------
        TurgorError
            If a factor is missing or unknown, a value lies beyond its range, or a choice is none of its study.
        """
        point = self.point(values)
        findings = self._beyond(point[None], extrapolate)
        mean, deviation = self.model.spread(self.shares(point)[None])
        scaled = deviation[0] * self._factors()
        return Prediction(
            values=dict(zip(self.measures, mean[0].tolist(), strict=True)),
            deviations=dict(zip(self.measures, scaled.tolist(), strict=True)),
            units=self.units,
            findings=findings,
        )

    def means(self, points: Array, *, extrapolate: bool = False) -> Array:
        """Return the measures of many designs, (q, m) [SI], without their deviations.

        Parameters
        ----------
        points : (q, k) array [SI]
            Values of the factors in their order; of a choice the place among its levels, from 0.
        extrapolate : bool
            Whether values beyond the ranges are taken.

        Raises
        ------
        TurgorError
            If a value lies beyond its range.
        """
        given = self._points(points)
        self._beyond(given, extrapolate)
        return self.model.mean(self.shares(given))

    def spreads(self, points: Array, *, extrapolate: bool = False) -> tuple[Array, Array]:
        """Return measures of many designs and their calibrated standard deviations, (q, m) each [SI].

        Parameters and errors are those of `means`.
        """
        given = self._points(points)
        self._beyond(given, extrapolate)
        mean, deviation = self.model.spread(self.shares(given))
        return mean, deviation * self._factors()

    def slopes(self, values: Mapping[str, Value]) -> dict[str, dict[str, float]]:
        """Return the derivative of each measure with respect to each number [SI], exact for the surrogate."""
        point = self.point(values)
        self._beyond(point[None], False)
        table = self.model.slope(self.shares(point))
        by_measure: dict[str, dict[str, float]] = {name: {} for name in self.measures}
        for n, each in enumerate(self.factors):
            if not each.is_choice:
                low, high = each.bounds
                slopes = table[:, self.coding.columns(n)][:, 0] / (high - low)
                for name, slope in zip(self.measures, slopes.tolist(), strict=True):
                    by_measure[name][each.name] = slope
        return by_measure

    def response(self, values: Mapping[str, Value], *, points: int = 21, extrapolate: bool = False) -> Response:
        """Return the path of one design: its measures against the drive, as a run gives them.

        Parameters
        ----------
        values : mapping of str to float or str [SI]
            Value of each factor but the drive. Without a drive among the inputs the response has one row.
        points : int
            Number of states.
        extrapolate : bool
            Whether values beyond the ranges are taken, with a finding.

        Returns
        -------
        Response
            Drive, measures, and the standard deviation of each as ``NAME_deviation``.
        """
        rest = [each.name for each in self.factors if each.name != self.along]
        drives = np.linspace(*self.factors[-1].bounds, points) if self.along else np.zeros(1)
        known = {name: value for name, value in values.items() if name != self.along}
        table = np.tile(self.point(known, rest), (len(drives), 1))
        if self.along:
            table = np.column_stack([table, drives])
        findings = self._beyond(table, extrapolate)
        mean, deviation = self.model.spread(self.shares(table))
        deviation = deviation * self._factors()
        columns = [Column(self.along, self.factors[-1].unit, drives)] if self.along else []
        for n, each in enumerate(self.held_out):
            columns.append(Column(each.name, each.unit, mean[:, n]))
        for n, each in enumerate(self.held_out):
            columns.append(Column(f"{each.name}_deviation", each.unit, deviation[:, n]))
        source = Source(text="a surrogate", detail=f"Gaussian process of {self.rows} rows; {self.source}")
        return Response(columns=tuple(columns), source=source, status="converged", findings=findings)

    def point(self, values: Mapping[str, Value], names: list[str] | None = None) -> Array:
        """Return values of the factors in their order, (k,) [SI], of a choice its place; unknown names are refused."""
        expected = names if names is not None else [each.name for each in self.factors]
        for name in values:
            if name not in expected:
                raise unknown("factor of the surrogate", name, expected)
        missing = [name for name in expected if name not in values]
        if missing:
            raise TurgorError(f"the surrogate needs a value of {', '.join(missing)} too.")
        numbers = np.array([each.number(values[each.name]) for each in self.factors if each.name in expected])
        if not np.isfinite(numbers).all():
            wrong = next(name for name in expected if not np.isfinite(values[name]))
            raise TurgorError(f"'{wrong}' is {values[wrong]}; a finite number is needed.")
        return numbers

    @property
    def coding(self) -> Coding:
        """How values of the factors become inputs of the model."""
        return Coding(factors=self.factors)

    def shares(self, points: Array) -> Array:
        """Return the inputs of the model at points: shares of ranges, and 0 or 1 for each level of a choice."""
        return self.coding.inputs(points)

    def values_at(self, shares: Array) -> dict[str, Value]:
        """Return the value of each factor [SI], the name of a choice, at inputs of the model, (w,)."""
        point = self.coding.points(shares)
        return {each.name: each.value(number) for each, number in zip(self.factors, point.tolist(), strict=True)}

    def _bounds(self) -> tuple[Array, Array]:
        """Lowest and highest values in points."""
        ends = [(0.0, len(each.levels) - 1.0) if each.is_choice else each.bounds for each in self.factors]
        return np.array(ends)[:, 0], np.array(ends)[:, 1]

    def _factors(self) -> Array:
        return np.array([each.factor for each in self.held_out])

    def _points(self, points: Array) -> Array:
        given = np.atleast_2d(np.asarray(points, dtype=np.float64))
        if given.shape[1] != len(self.factors):
            names = ", ".join(each.name for each in self.factors)
            raise TurgorError(f"points has {given.shape[1]} columns; {len(self.factors)} are needed: {names}.")
        return given

    def _beyond(self, points: Array, extrapolate: bool) -> tuple[Finding, ...]:
        """Refuse points beyond the ranges, or say which factors are; between choices lies nothing."""
        low, high = self._bounds()
        for place, each in enumerate(self.factors):
            if each.is_choice and not np.isin(points[:, place], np.arange(len(each.levels))).all():
                raise TurgorError(f"'{each.name}' is a choice: points have its place, 0 to {len(each.levels) - 1}.")
        off = np.maximum(low - points, points - high) / (high - low)
        if not (off > ROUND_OFF.same).any():
            return ()
        row, n = np.unravel_index(np.argmax(off), off.shape)
        factor = self.factors[n]
        value = float(points[row, n])
        position = f"{factor.name} is {factor.shown(value)}; the surrogate knows {factor.range_text}"
        if not extrapolate:
            raise TurgorError(f"{position}. Compute more rows there, or ask with extrapolate=True at your own risk.")
        message = f"{position}: {100 * off[row, n]:.3g} % of the range beyond."
        advice = "Compute the design itself; neither the value nor its standard deviation was tested there."
        return (Finding(code="U01", severity=Severity.WARNING, message=message, advice=advice),)

"""Bands: the spread of each column of a response, and where it comes from."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.results.error_text import is_zero
from turgor.core.results.measures.headlines import headlines
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import MESH_ERROR, Column, Response
from turgor.foundation.source import Source
from turgor.studies.uncertainty.cases import Case, case_texts

Array = NDArray[np.float64]

#: Parts that are left out of a sentence: below this share of the variance.
LEAST_SHARE = 0.005


#: A surface that misses held-out runs by more standard deviations than this is not good.
MOST_MISSED = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Band:
    """Spread of one column along the path.

    Parameters
    ----------
    name, unit : str
        Of the column.
    nominal : (n,) array [SI]
        Its values where every input has its nominal value.
    mean : (n,) array [SI]
        Mean over the inputs; it differs from the nominal value where the response bends.
    deviation : (n,) array [SI]
        Standard deviation.
    low, high : (n,) array [SI]
        95 % of the values lie between them.
    parts : mapping of str to (n,) array [SI]
        Standard deviation that each input brings, by label; their squares and those of ``together`` add up.
    together : (n,) array [SI]
        What inputs bring only together; zero unless interactions are computed.
    mesh : (n,) array or None [SI]
        Mesh error of the nominal values.
    """

    name: str
    unit: str
    nominal: Array
    mean: Array
    deviation: Array
    low: Array
    high: Array
    parts: Mapping[str, Array]
    together: Array
    mesh: Array | None = None

    @property
    def is_zero(self) -> bool:
        """Whether values and their spread are zero throughout."""
        return all(is_zero(Column(self.name, self.unit, each)) for each in (self.nominal, self.deviation))

    def shares(self, row: int = -1) -> dict[str, float]:
        """Return the share of the variance that each input brings at one row, by label."""
        whole = float(self.deviation[row]) ** 2
        return {label: float(part[row]) ** 2 / whole if whole else 0.0 for label, part in self.parts.items()}

    def shown(self, value: float) -> str:
        """Return a value in the unit of the column, with as many digits as its spread has."""
        number = Column("y", self.unit, np.array([value])).in_unit[0]
        unit = "°" if self.unit == "deg" else f" {self.unit}"
        return f"{number:.3g}{unit}".rstrip()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Uncertainty:
    """The spread of inputs propagated to a response.

    Parameters
    ----------
    drive : Column
        What drives, at the rows of the bands.
    bands : mapping of str to Band
        By column.
    method : str
        How it was computed, in a sentence with the number of runs.
    runs : int
        Number of runs.
    residual : mapping of str to float [-]
        Largest difference between runs that were held out and what the surface says for them, by column, over the
        largest standard deviation of the column.
    notes : tuple of str
        What was left out, and runs that failed.
    cases : tuple of Case
        How each record ran, where alternatives are records.
    """

    drive: Column
    bands: Mapping[str, Band]
    method: str
    runs: int
    residual: Mapping[str, float]
    notes: tuple[str, ...] = ()
    cases: tuple[Case, ...] = ()

    def __repr__(self) -> str:
        return f"Uncertainty({self.sentence()})"

    @property
    def headline(self) -> str:
        """The column that a reader looks for first."""
        return next(iter(headlines(list(self.bands))), next(iter(self.bands)))

    def band(self, name: str) -> Band:
        """Return the band of a column; an unknown name fails with the near match."""
        if name not in self.bands:
            raise unknown("column with a band", name, self.bands)
        return self.bands[name]

    def sentence(self, name: str | None = None, at: float | None = None) -> str:
        """Return the value of a column with the standard deviations that the mesh and each input bring.

        Parameters
        ----------
        name : str, optional
            By default the column that a reader looks for first.
        at : float [SI], optional
            Value of what drives; the last one by default.

        Returns
        -------
        str
            Such as ``"bending angle at 50 kPa: 92.8° ± 0.9° (mesh) ± 7° (rubber) ± 2° (wall)"``.
        """
        band = self.band(name or self.headline)
        where = float(self.drive.values[-1]) if at is None else at
        low, high = float(self.drive.values[0]), float(self.drive.values[-1])
        if not low <= where <= high:
            raise TurgorError(f"at is {where:g}; the bands go from {low:g} to {high:g} (SI).")
        value, *spreads = (
            float(np.interp(where, self.drive.values, each)) for each in (band.nominal, *band.parts.values())
        )
        parts = []
        if band.mesh is not None and np.isfinite(band.mesh).any():
            parts.append(
                f"± {_short(band, float(np.interp(where, self.drive.values, np.nan_to_num(band.mesh))))} (mesh)"
            )
        whole = float(np.interp(where, self.drive.values, band.deviation))
        order = sorted(zip(band.parts, spreads, strict=True), key=lambda item: -item[1])
        parts += [f"± {_short(band, part)} ({label})" for label, part in order if part**2 > LEAST_SHARE * whole**2]
        here = Column(self.drive.name, self.drive.unit, np.array([where])).in_unit[0]
        x = f"{here:.4g} {self.drive.unit}".rstrip()
        return f"{band.name.replace('_', ' ')} at {x}: {band.shown(value)} {' '.join(parts)}"

    def sentences(self, at: float | None = None) -> list[str]:
        """Return the sentence of each column, without those that are zero throughout, such as what a support bears.

        Parameters
        ----------
        at : float [SI], optional
            Value of what drives; the last one by default.
        """
        here = [band.name for band in self.bands.values() if not band.is_zero]
        return [self.sentence(name, at) for name in here or self.bands]

    def case_sentences(self, at: float | None = None) -> list[str]:
        """Return the lowest and the highest record of each column, with and without the doubtful ones.

        Parameters
        ----------
        at : float [SI], optional
            Value of what drives; the last one by default.

        Returns
        -------
        list of str
            Empty where no alternatives are records.
        """
        where = float(self.drive.values[-1]) if at is None else at
        values = {
            name: [float(np.interp(where, self.drive.values, each.curves[name])) if each.curves else np.nan
                   for each in self.cases]
            for name in self.bands
        }  # fmt: skip
        return case_texts(self.cases, values, lambda name, value: self.bands[name].shown(value))

    def summary(self) -> str:
        """Return the sentence of every column, and how they were computed."""
        return "\n".join([*self.sentences(), self.checked(), *self.case_sentences(), *self.notes])

    def checked(self) -> str:
        """Return how the bands were computed, and how well held-out runs agree."""
        far = max(self.residual.values(), default=0.0)
        if not far:
            return self.method
        text = f"{self.method} Held-out runs differ from the surface by at most {far:.2g} standard deviations."
        if far > MOST_MISSED:
            text += " The response bends more than the surface: take a method with more terms, or smaller spreads."
        return text

    def to_response(self) -> Response:
        """Return the bands as a table: for each column mean, standard deviation, 95 % range, mesh error and parts."""
        columns = [self.drive]
        for name, band in self.bands.items():
            table = {
                "": band.nominal,
                "_mean": band.mean,
                "_spread": band.deviation,
                "_low": band.low,
                "_high": band.high,
            }
            if band.mesh is not None:
                table[MESH_ERROR] = band.mesh
            table |= {f"_spread_from_{_word(label)}": part for label, part in band.parts.items()}
            columns += [Column(name + end, band.unit, values) for end, values in table.items()]
        return Response(columns=tuple(columns), source=Source(text="propagation of uncertainty", detail=self.method))


def _short(band: Band, value: float) -> str:
    number = Column("y", band.unit, np.array([value])).in_unit[0]
    unit = "°" if band.unit == "deg" else f" {band.unit}"
    return f"{number:.2g}{unit}".rstrip()


def _word(label: str) -> str:
    return "".join(letter if letter.isalnum() else "_" for letter in label)

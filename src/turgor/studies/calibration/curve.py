"""Curve: a computed column against its drive, smooth between the states of the path, and its derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from turgor.accuracy.laboratory.compare import first_branch
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.studies.calibration.settings import CALIBRATION
from turgor.studies.runs.slopes import slope_name

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class PathCurve:
    """Points of a computed curve: smooth between them (PCHIP), and straight beyond its ends.

    Parameters
    ----------
    drive, values : (n,) array [SI]
        The drive rises.
    rows : (n,) array
        Rows of the part of the response before the drive turns.
    """

    drive: Array
    values: Array
    rows: NDArray[np.int64]

    @classmethod
    def of(cls, response: Response, x: str, y: str) -> Self:
        """Take the part of a response before the drive turns.

        Parameters
        ----------
        response : Response
        x, y : str
            Columns.

        Returns
        -------
        PathCurve

        Raises
        ------
        TurgorError
            If the curve has fewer than two points.
        """
        part, _ = first_branch(response, x)
        known = np.flatnonzero(np.isfinite(part.column(x)) & np.isfinite(part.column(y)))
        drive, places = np.unique(part.column(x)[known], return_index=True)
        if len(drive) < 2:
            raise TurgorError(
                f"the path has {len(drive)} states with '{x}' and '{y}'; two are needed. {response.message}"
            )
        return cls(drive, part.column(y)[known][places], known[places])

    def at(self, drive: Array) -> Array:
        """Return the values (m,) [SI] at values of the drive."""
        inside = np.clip(drive, self.drive[0], self.drive[-1])
        values = np.asarray(PchipInterpolator(self.drive, self.values)(inside))
        return np.asarray(values + self._beyond(drive) * (drive - inside))

    def rise(self, drive: Array) -> Array:
        """Return the derivatives (m,) by the drive [SI]."""
        inside = np.asarray(PchipInterpolator(self.drive, self.values).derivative()(drive, extrapolate=False))
        return np.where(np.isnan(inside), self._beyond(drive), inside)

    def slopes(self, drive: Array, response: Response, names: tuple[str, str], parameters: Sequence[str]) -> Array:
        """Return the derivatives (m, k) [SI] by parameters whose slopes are columns of the response; else nan.

        Parameters
        ----------
        drive : (m,) array [SI]
        response : Response
            That the curve is of.
        names : (str, str)
            Columns of drive and values. A drive without slopes does not depend on the parameters.
        parameters : sequence of str

        Returns
        -------
        (m, k) array
        """
        part, used = first_branch(response, names[0])[0], self._used(drive)
        table = np.full((len(drive), len(parameters)), np.nan)
        for k, parameter in enumerate(parameters):
            x, y = (slope_name(name, parameter) for name in names)
            if y not in part:
                continue
            rates = part.column(y)[self.rows]
            moves = part.column(x)[self.rows] if x in part else np.zeros(len(self.rows))
            if np.isfinite(rates[used]).all() and np.isfinite(moves[used]).all():
                table[:, k] = self._moved(drive, np.where(used, moves, 0.0), np.where(used, rates, 0.0))
        return table

    def _moved(self, drive: Array, moves: Array, rates: Array) -> Array:
        """Return the derivative of the interpolation when its points move at rates, by a small central difference."""
        far = float(np.ptp(self.values)) or 1.0
        steps = [CALIBRATION.nudge * far / max(float(np.abs(rates).max()), 1e-300)]
        if moves.any():
            steps.append(CALIBRATION.nudge * float(np.diff(self.drive).min()) / float(np.abs(moves).max()))
        step = min(steps)
        ends = [PathCurve(self.drive + s * moves, self.values + s * rates, self.rows).at(drive) for s in (step, -step)]
        return (ends[0] - ends[1]) / (2 * step)

    def _used(self, drive: Array) -> NDArray[np.bool_]:
        """Points on which the interpolation at values of the drive depends: two on both sides of each."""
        used = np.zeros(len(self.drive), dtype=bool)
        for place in np.unique(np.searchsorted(self.drive, drive)):
            used[max(min(place, len(used) - 1) - 2, 0) : max(place, 1) + 2] = True
        return used

    def _beyond(self, drive: Array) -> Array:
        """Slope of the straight part beyond the nearer end."""
        first, last = np.diff(self.values[[0, 1, -2, -1]])[[0, 2]] / np.diff(self.drive[[0, 1, -2, -1]])[[0, 2]]
        return np.where(drive < self.drive[0], first, last)

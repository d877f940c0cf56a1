"""Load curves of a .feb file as amplitudes: points of time and value up to the end of the last step."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from turgor.foundation.errors import TurgorError
from turgor.job.decks.febio.elements import Element

#: Lines that stand for a curved piece between two points of a smooth curve.
PIECES = 10

Points = list[tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """A load curve.

    Parameters
    ----------
    points : list of (float, float)
        Time [s] and value.
    shape : str
        ``"LINEAR"``, ``"STEP"`` (the value of the next point) or ``"SMOOTH"`` (parabolas).
    extend : str
        What follows the last point: ``"CONSTANT"``, ``"EXTRAPOLATE"`` or ``"REPEAT"``.
    """

    points: Points
    shape: str = "LINEAR"
    extend: str = "CONSTANT"

    def over(self, end: float) -> Points:
        """Points from 0 to a time [s], with straight lines between them.

        Examples
        --------
        >>> Curve(points=[(0, 0), (2, 4)]).over(1.0)
        [(0.0, 0.0), (1.0, 2.0)]
        >>> Curve(points=[(0, 0), (1, 4)], extend="REPEAT").over(3.0)
        Traceback (most recent call last):
        turgor.TurgorError: a load curve that repeats has no form here; write all of its points.
        """
        first, last = self.points[0][0], self.points[-1][0]
        if self.extend == "REPEAT" and (last < end or first > 0):
            raise TurgorError("a load curve that repeats has no form here; write all of its points.")
        if self.shape == "STEP":
            return self._steps(end)
        times = {0.0, end, *(t for t, _ in self.points if 0 < t < end)}
        if self.shape == "SMOOTH" and len(self.points) > 2:
            knots = sorted({*times, *(t for t in (first, last) if 0 < t < end)})
            times |= {t for a, b in pairwise(knots) for t in np.linspace(a, b, PIECES + 1).tolist()}
        return [(time, self._at(time)) for time in sorted(times)]

    def _steps(self, end: float) -> Points:
        """Steps at the points: the first one is there from the start, and a jump later has no form."""
        starts = [0.0, *(time for time, _ in self.points if time > 0)]
        values = [value for time, value in self.points if time > 0] or [self.points[-1][1]]
        used = [value for start, value in zip(starts, values, strict=False) if start < end]
        if any(value != values[0] for value in used):
            raise TurgorError("a load curve that jumps has no form here; let it ramp.")
        return [(0.0, values[0]), (end, values[0])]

    def _at(self, time: float) -> float:
        times, values = (np.array(each, dtype=np.float64) for each in zip(*self.points, strict=True))
        if len(times) == 1:
            return float(values[0])
        if not times[0] <= time <= times[-1]:
            if self.extend != "EXTRAPOLATE":
                return float(values[0] if time < times[0] else values[-1])
            near, next_one = (0, 1) if time < times[0] else (-1, -2)
            slope = (values[near] - values[next_one]) / (times[near] - times[next_one])
            return float(values[near] + slope * (time - times[near]))
        if self.shape == "LINEAR" or len(times) == 2:
            return float(np.interp(time, times, values))
        n = max(1, int(np.searchsorted(times, time)))
        lower, upper = max(0, n - 2), min(n - 1, len(times) - 3)
        # the two are one in the first and in the last piece
        one, other = (_parabola(time, times[k : k + 3], values[k : k + 3]) for k in (lower, upper))
        share = (time - times[n - 1]) / (times[n] - times[n - 1])
        return float(one + (other - one) * share)


def _parabola(time: float, t: np.ndarray, f: np.ndarray) -> float:
    """Value of the parabola through three points."""
    return float(
        f[0] * (t[2] - time) * (t[1] - time) / ((t[2] - t[0]) * (t[1] - t[0]))
        + f[1] * (t[2] - time) * (time - t[0]) / ((t[2] - t[1]) * (t[1] - t[0]))
        + f[2] * (time - t[1]) * (time - t[0]) / ((t[2] - t[1]) * (t[2] - t[0]))
    )


def curves_of(root: Element) -> Mapping[str, Curve | Element]:
    """Return the load curves by their ``id``; those of another type as their element."""
    curves: dict[str, Curve | Element] = {}
    for data in root.all("LoadData"):
        for each in data.all("load_controller", "loadcurve"):
            old = each.tag == "loadcurve"  # of FEBio 2
            name = each.first_of_its_name(curves, each.given.get("id", ""))
            if not old and each.given.get("type") != "loadcurve":
                curves[name] = each
                continue
            shape = (each.given.get("type", "linear") if old else each.word("interpolate", "LINEAR")).upper()
            extend = (each.given.get("extend", "constant") if old else each.word("extend", "CONSTANT")).upper()
            points = [_pair(point) for point in (each.first("points") or each).all("pt", "point", "loadpoint")]
            known = shape in ("LINEAR", "STEP", "SMOOTH") and extend in ("CONSTANT", "EXTRAPOLATE", "REPEAT")
            if not points or not known or _backward(points):
                curves[name] = each
                continue
            curves[name] = Curve(points=points, shape=shape, extend=extend)
    return curves


def _pair(point: Element) -> tuple[float, float]:
    values = point.numbers()
    if len(values) != 2:
        point.fail(f"it has {len(values)} numbers; a time and a value are needed.")
    return values[0], values[1]


def _backward(points: Sequence[tuple[float, float]]) -> bool:
    return any(b[0] <= a[0] for a, b in pairwise(points))

"""Lines: where the threads of a winding run on their unrolled face."""

from dataclasses import dataclass
from math import cos, isfinite, pi, sin

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.settings import FIBERS
from turgor.core.engine.fibers.smeared import Course
from turgor.core.engine.fibers.surface_unrolling import UnrolledSurface
from turgor.core.model.fibers import Fibers
from turgor.foundation.errors import TurgorError
from turgor.units import mm

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Lines:
    """Straight lines on the unrolled face, or in space.

    Parameters
    ----------
    begin : (k, 2) or (k, 3) array [m]
        Contour length and axial coordinate of their first points; of lines in space the points.
    direction : (k, 2) or (k, 3) array
        Unit vectors.
    length : (k,) array [m]
        Lengths.
    fold : float [m]
        Contour length after which the whole winding repeats; beyond the modeled part there is no face.
        Infinite for lines in space.
    """

    begin: Array
    direction: Array
    length: Array
    fold: float

    def at(self, line: Ints, t: Array) -> Array:
        """Points (m, 2) or (m, 3) at lengths (m,) along lines (m,)."""
        points = self.begin[line] + t[:, None] * self.direction[line]
        if isfinite(self.fold):
            points[:, 0] %= self.fold
        return np.asarray(points)


def thread_lines(course: Course, face: UnrolledSurface, fibers: Fibers) -> Lines:
    """Find where the threads of a winding run.

    Helices begin at the start of the face, evenly around its perimeter. Where the winding is given by its spacing, as
    many begin as come nearest to it. Mirror planes ask for an even number where there are two of them.
    """
    around = face.contour.length * course.copies
    length = face.end - face.start
    if course.angle > pi / 2 - 1e-9:
        count = _hoops(length, course)
        begin = np.c_[np.zeros(count), face.start + (np.arange(count) + 0.5) * length / count]
        direction, reach = np.tile([1.0, 0.0], (count, 1)), face.contour.length
    else:
        count = _starts(course, fibers, around)
        offset = 0.5 if course.angle < 1e-9 else 0.0  # axial threads keep off the mirror planes
        places = (np.arange(count) + offset) / count * around
        places += FIBERS.nudge * around
        begin = np.concatenate([np.c_[turn * places, np.full(count, face.start)] for turn in course.turning])
        slopes = [[turn * sin(course.angle), cos(course.angle)] for turn in course.turning]
        direction, reach = np.repeat(np.array(slopes), count, axis=0), length / cos(course.angle)
    begin[:, 1] += FIBERS.nudge * length
    return Lines(begin, direction, np.full(len(begin), reach), around)


def laid_spacing(course: Course) -> float:
    """Return the distance between neighboring discrete threads [m], whose number is whole."""
    if course.angle > pi / 2 - 1e-9:
        return course.length / _hoops(course.length, course)
    return course.perimeter * cos(course.angle) / max(1, _nearest(course))


def _hoops(length: float, course: Course) -> int:
    return max(1, round(length / course.spacing))


def _nearest(course: Course) -> int:
    """Number of threads of one hand whose distance is nearest to the requested one."""
    step = max(1, course.copies // 2)
    return int(step * round(course.perimeter * cos(course.angle) / course.spacing / step))


def _starts(course: Course, fibers: Fibers, around: float) -> int:
    """Number of threads of one hand that begin at the start of the face."""
    count = _nearest(course)
    if fibers.wound.starts is not None and count != fibers.wound.starts:
        raise TurgorError(
            f"fibers on '{fibers.place}': a quarter model needs an even number of starts, not {fibers.wound.starts}; "
            "model the half or the whole."
        )
    if count == 0:
        raise TurgorError(
            f"fibers on '{fibers.place}': a spacing of {course.spacing / mm:.4g} mm at this angle gives no whole "
            f"thread around a perimeter of {around / mm:.4g} mm; give the pitch and starts = 1."
        )
    return count

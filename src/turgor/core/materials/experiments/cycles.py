"""Cycles of a test: reversals of the stretch, and selection of one curve."""

from itertools import pairwise

import numpy as np

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.settings import EXPERIMENTS
from turgor.foundation.errors import TurgorError, unknown


def half_cycles(test: MaterialTest) -> tuple[slice, ...]:
    """Split a test where the stretch reverses: loading, unloading, loading and so on.

    Parameters
    ----------
    test : MaterialTest
        Points in the order of time.

    Examples
    --------
    >>> stretch = [1.0, 1.5, 2.0, 1.5, 1.0, 1.6, 2.2]
    >>> half_cycles(MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch, name="cycles"))
    (slice(0, 3, None), slice(3, 5, None), slice(5, 7, None))
    """
    stretch = test.stretch
    least = EXPERIMENTS.half_cycle * float(np.ptp(stretch))
    turns, extreme, rising = [], 0, 0
    for i in range(1, len(stretch)):
        if rising == 0:
            if abs(stretch[i] - stretch[0]) >= least:
                rising, extreme = (1 if stretch[i] > stretch[0] else -1), i
        elif rising * (stretch[i] - stretch[extreme]) >= 0:
            extreme = i
        elif rising * (stretch[extreme] - stretch[i]) >= least:
            turns.append(extreme)
            rising, extreme = -rising, i
    edges = [0, *(turn + 1 for turn in turns), len(stretch)]
    return tuple(slice(a, b) for a, b in pairwise(edges))


def select_cycle(test: MaterialTest, cycle: int = -1, *, part: str = "loading") -> MaterialTest:
    """Keep one loading (or unloading) curve of a cyclic test.

    Rubber softens in its first cycles (Mullins effect). The last cycle shows the preconditioned rubber of an actuator
    that has moved before; the first cycle shows the virgin rubber.

    Parameters
    ----------
    test : MaterialTest
        Points in the order of time.
    cycle : int
        Number of the curve, as on the command line: 1 is the first, -1 the last.
    part : str
        ``"loading"``, away from the undeformed state, or ``"unloading"``.

    Examples
    --------
    >>> stretch = [1.0, 1.5, 2.0, 1.5, 1.0, 1.6, 2.2]
    >>> test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch, name="cycles")
    >>> select_cycle(test, 1).range
    (1.0, 2.0)
    """
    if part not in ("loading", "unloading"):
        raise unknown("part of a cycle", part, ("loading", "unloading"))
    if cycle == 0:
        raise TurgorError(f"cycle is 0; 1 is the first {part} curve of test '{test.name}' and -1 the last.")
    parts = half_cycles(test)
    loading = [s for s in parts if _loads(test, s)]
    chosen = loading if part == "loading" else [s for s in parts if s not in loading]
    if abs(cycle) > len(chosen):
        curves = f"one {part} curve" if len(chosen) == 1 else f"{len(chosen)} {part} curves"
        raise TurgorError(f"test '{test.name}' has {curves}; there is no number {cycle}.")
    points = chosen[cycle - 1 if cycle > 0 else cycle]
    stretch = test.stretch[points]
    keep = np.zeros(len(test.stretch), dtype=bool)
    # keep only points where the stretch is at a new extreme, because small steps back are noise of the crosshead
    onward = stretch if stretch[-1] >= stretch[0] else -stretch
    keep[points] = onward >= np.maximum.accumulate(onward)
    place = chosen.index(points) + 1
    return test.keeping(keep, f"All but the {part} curve of cycle {place} of {len(chosen)}")


def without_way_back(test: MaterialTest) -> MaterialTest:
    """Return a single pull without the way back of the machine; every other test as it is.

    Parameters
    ----------
    test : MaterialTest
        Points in the order of time.

    Examples
    --------
    >>> stretch = [1.0, 1.5, 2.0, 1.5, 1.0]
    >>> pull = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch, name="a pull")
    >>> without_way_back(pull).edits[-1].text
    'On the way back of the machine: 2 points of 5 removed.'
    """
    if test.mode in ("biaxial", "simple_shear"):
        return test
    pulled = np.log(test.stretch).max() > -np.log(test.stretch).min()
    away = test.stretch if pulled else -test.stretch
    last = int(np.argmax(away))
    step = EXPERIMENTS.precision * float(np.ptp(away))
    there, back = away[: last + 1], away[last:]
    once = (np.maximum.accumulate(there) - there <= step).all() and (back - np.minimum.accumulate(back) <= step).all()
    if not once or back[0] - back[-1] <= step or last < 2:
        return test
    return test.keeping(np.arange(len(away)) <= last, "On the way back of the machine")


def _loads(test: MaterialTest, half: slice) -> bool:
    """Whether a half cycle ends further from the undeformed state than it begins, in tension or in compression."""
    ends = test.stretch[half][[0, -1]]
    begin, end = np.abs(ends) if test.mode == "simple_shear" else np.abs(np.log(ends))
    return bool(end >= begin)

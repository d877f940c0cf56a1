"""Cut lines into parts that lie in one side of a cell each, or in one cell."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.fibers.lines import Lines
from turgor.core.engine.fibers.settings import FIBERS
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class Where(Protocol):
    """Finds sides or cells under points."""

    def sides(self, points: Array) -> Ints:
        """Numbers of the sides or cells that hold points; −1 where none does."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Cuts:
    """Parts of lines, each in one side or cell: line, where it begins and ends along it, side; sorted."""

    line: Ints
    begin: Array
    end: Array
    side: Ints


def cut(lines: Lines, fineness: float, where: Where) -> Cuts:
    """Cut lines where they pass from side to side, or from cell to cell: coarse look-up first, then halving.

    Parameters
    ----------
    lines : Lines
    fineness : float [m]
        Extent of the smaller sides or cells.
    where : Where
    """
    parts = np.maximum(2, np.ceil(FIBERS.trusses_of_side * lines.length / fineness).astype(np.int64))
    line = np.repeat(np.arange(len(parts)), parts + 1)
    number = np.arange(len(line)) - np.repeat(np.cumsum(parts + 1) - parts - 1, parts + 1)
    t = number / parts[line] * lines.length[line]
    side = where.sides(lines.at(line, t))
    differ = np.flatnonzero((line[1:] == line[:-1]) & (side[1:] != side[:-1]))
    at, low, high = line[differ], t[differ], t[differ + 1]
    before, after = side[differ], side[differ + 1]
    while (high - low).max(initial=0.0) > ROUND_OFF.mesh_digits * fineness:
        middle = (low + high) / 2
        between = where.sides(lines.at(at, middle))
        left, right = before != between, between != after
        at = np.concatenate([at[left], at[right]])
        low, high = np.concatenate([low[left], middle[right]]), np.concatenate([middle[left], high[right]])
        before, after = (
            np.concatenate([before[left], between[right]]),
            np.concatenate([between[left], after[right]]),
        )
    first = number == 0
    line = np.concatenate([line[first], at])
    begin = np.concatenate([t[first], (low + high) / 2])
    side = np.concatenate([side[first], after])
    order = np.lexsort((begin, line))
    line, begin, side = line[order], begin[order], side[order]
    last = np.append(line[1:] != line[:-1], True)
    end = np.where(last, lines.length[line], np.append(begin[1:], 0.0))
    long = (side >= 0) & (end - begin > FIBERS.shortest_truss * fineness)
    return Cuts(line[long], begin[long], end[long], side[long])

"""Layout: the sparsity pattern of the tangent, which changes as contact couples degrees of freedom of distant cells."""

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.multipoint import UNTIED, MultiPoint, Places
from turgor.core.engine.algebra.pattern import Pattern

Array = NDArray[np.float64]
Ints = NDArray[np.int64]


class Layout:
    """The sparsity of the tangent: that of the cells, and what contact adds to it.

    Parameters
    ----------
    base : Pattern
        Of the cells and everything else that stays.
    prescribed : (size,) bool array
        Prescribed unknowns.
    tied : MultiPoint, optional
        Unknowns that are equal to others; the base pattern has room for their stiffness.

    Attributes
    ----------
    pattern : Pattern
        The present one. It is another object after every change.
    ties : (keys, list of unknowns) or None
        What the last change took, as `renew` wants it; None before the first one.
    """

    def __init__(self, base: Pattern, prescribed: NDArray[np.bool_], tied: MultiPoint = UNTIED) -> None:
        self.base = self.pattern = base
        self._prescribed, self._tied = prescribed, tied
        self._known = np.zeros(0, dtype=np.int64)
        self.ties: tuple[Ints, list[Ints]] | None = None
        self._place: NDArray[np.int32] | None = None
        self._base_followers: Places | None = None
        self._find_prescribed()

    def _find_prescribed(self) -> None:
        pattern = self.pattern
        column_of = np.repeat(np.arange(pattern.size, dtype=np.int32), np.diff(pattern.indptr))
        self.dropped = np.flatnonzero(self._prescribed[pattern.indices] | self._prescribed[column_of])
        self.prescribed_diagonal = pattern.diagonal[self._prescribed]
        self._followers: Places | None = None  # places take long, and few patterns of a run need them

    def covers(self, keys: Ints) -> bool:
        """Whether all ties, given by a key each, are in the present pattern."""
        return bool(np.isin(keys, self._known).all())

    def renew(self, keys: Ints, unknowns: list[Ints]) -> None:
        """Take a new set of ties: their keys, and the unknowns of each in rows, −1 for none."""
        self._known, self.ties = np.sort(keys), (keys, unknowns)
        size = self.base.size
        graph = sp.csc_matrix((size, size), dtype=np.int32)
        for rows in unknowns:
            graph = graph + _graph(rows, size)
            if len(self._tied.followers):
                graph = graph + _graph(self._tied.extended(rows), size)
        base = sp.csc_matrix(
            (np.ones(len(self.base.indices), np.int32), self.base.indices, self.base.indptr), shape=(size, size)
        )
        both = (base + 2 * graph).tocsc()
        both.sort_indices()
        self.pattern = Pattern(size, both.indptr.astype(np.int64), both.indices.astype(np.int32))
        self._place = np.flatnonzero(both.data % 2).astype(np.int32)  # odd: an entry of the base, whose order stays
        self._find_prescribed()

    def spread(self, data: Array) -> Array:
        """Values of the base pattern in the present one."""
        if self._place is None:
            return data
        out = np.zeros(len(self.pattern.indices))
        out[self._place] = data
        return out

    def reduce(self, data: Array) -> None:
        """Add the stiffness of tied unknowns to that of the unknowns they follow, in place."""
        if len(self._tied.followers):
            self._followers = self._followers or self._tied.places(self.pattern)
            self._followers.add(data)

    def reduce_base(self, data: Array) -> None:
        """Do the same in the base pattern."""
        if len(self._tied.followers):
            self._base_followers = self._base_followers or self._tied.places(self.base)
            self._base_followers.add(data)

    def apply_supports(self, data: Array) -> None:
        """Replace the equations of prescribed unknowns by identities, in place."""
        data[self.dropped] = 0.0
        data[self.prescribed_diagonal] = 1.0


def _graph(unknowns: Ints, size: int) -> sp.csc_matrix:
    """Lower triangle of the pattern that ties the unknowns of each row."""
    rows, columns = np.nonzero(unknowns >= 0)
    entries = np.ones(len(rows), dtype=np.int32)
    incidence = sp.csr_matrix((entries, (rows, unknowns[rows, columns])), shape=(len(unknowns), size))
    return sp.tril(incidence.T @ incidence, format="csc")

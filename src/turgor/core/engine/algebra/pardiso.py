"""Pardiso of Intel's MKL, called through ctypes where the package mkl is installed."""

import ctypes
import sys
import weakref
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern
from turgor.core.engine.algebra.singular import SingularTangentError
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]

#: Phases of Pardiso.
ANALYZE, FACTOR, SOLVE, RELEASE = 11, 22, 33, -1

#: Real, symmetric, indefinite.
MATRIX_TYPE = -2


@dataclass(slots=True, eq=False)
class _Arrays:
    """Memory of Pardiso between calls: its handle and settings, the matrix in its one-based form."""

    handle: NDArray[np.int64]
    settings: NDArray[np.int32]
    data: NDArray
    indptr: NDArray[np.int32]
    indices: NDArray[np.int32]


class Pardiso:
    """LDLᵀ by MKL Pardiso, type −2 without matching; faster, proprietary, used where turgor[fast] installed it.

    Pardiso analyzes for one precision. The first factors of the other one analyze again.
    """

    name = "mkl-pardiso"

    def __init__(self, pattern: Pattern, threads: int) -> None:
        mkl = load_mkl()
        if mkl is None:
            raise TurgorError("linear solver 'mkl-pardiso' needs the package mkl; install it with turgor[fast].")
        mkl.MKL_Set_Num_Threads(ctypes.c_int(threads))
        self._mkl, self._pattern = mkl, pattern
        self._arrays: _Arrays | None = None
        self._release: weakref.finalize | None = None

    def factor(self, data: Array, single: bool) -> None:
        """Factor new values, analyzed before if they are the first of their precision."""
        precision = np.dtype(np.float32 if single else np.float64)
        if self._arrays is None or self._arrays.data.dtype != precision:
            self._analyze(precision)
        assert self._arrays is not None
        self._arrays.data = np.ascontiguousarray(data, dtype=precision)
        _call(self._mkl, self._arrays, FACTOR, None)

    def _analyze(self, precision: np.dtype) -> None:
        if self._release is not None:
            self._release()
        # the lower triangle by columns is the upper triangle by rows, which is what Pardiso reads
        arrays = _Arrays(
            handle=np.zeros(64, dtype=np.int64),
            settings=np.zeros(64, dtype=np.int32),
            data=np.ones(len(self._pattern.indices), dtype=precision),
            indptr=(self._pattern.indptr + 1).astype(np.int32),
            indices=self._pattern.indices + 1,
        )
        # 1: own settings; 2: parallel nested dissection; 8: no refinement; 10: pivot 1e-8; 11, 13: no scaling, no
        # matching (they depend on values and would force a new analysis); 21: 1 × 1 and 2 × 2 pivots; 24: two-level;
        # 28: single precision
        single = int(precision == np.float32)
        for number, value in ((1, 1), (2, 3), (8, 0), (10, 8), (11, 0), (13, 0), (21, 1), (24, 1), (28, single)):
            arrays.settings[number - 1] = value
        _call(self._mkl, arrays, ANALYZE, None)
        self._arrays, self._release = arrays, weakref.finalize(self, _call, self._mkl, arrays, RELEASE, None)
        # at interpreter exit the operating system takes the memory back, and NumPy may be unloaded by then
        self._release.atexit = False

    def solve(self, right: Array) -> Array:
        """Solve with the last factors."""
        assert self._arrays is not None
        return _call(self._mkl, self._arrays, SOLVE, right)

    def negative_pivots(self) -> int:
        """Negative pivots, iparm(23)."""
        assert self._arrays is not None
        return int(self._arrays.settings[22])


def _call(mkl: ctypes.CDLL, arrays: _Arrays, phase: int, right: Array | None) -> Array:
    size, precision = len(arrays.indptr) - 1, arrays.data.dtype
    solves = size if phase == SOLVE else 1  # the other phases read neither right side nor solution
    vector = np.zeros(solves, precision) if right is None else np.ascontiguousarray(right, dtype=precision)
    result = np.zeros(solves, precision)
    permutation = np.zeros(1, dtype=np.int32)
    error = ctypes.c_int(0)

    def integer(value: int) -> object:
        return ctypes.byref(ctypes.c_int(value))

    def pointer(array: NDArray) -> ctypes.c_void_p:
        return array.ctypes.data_as(ctypes.c_void_p)

    mkl.pardiso(
        pointer(arrays.handle),
        integer(1),
        integer(1),
        integer(MATRIX_TYPE),
        integer(phase),
        integer(size),
        pointer(arrays.data),
        pointer(arrays.indptr),
        pointer(arrays.indices),
        pointer(permutation),
        integer(1),
        pointer(arrays.settings),
        integer(0),
        pointer(vector),
        pointer(result),
        ctypes.byref(error),
    )
    if error.value:
        raise SingularTangentError(f"Pardiso returned {error.value} in phase {phase}")
    return result.astype(np.float64, copy=False)


def load_mkl() -> ctypes.CDLL | None:
    """The MKL runtime of the current environment, None where it is not installed."""
    folders = [Path(sys.prefix) / "lib", Path(sys.prefix) / "Library" / "bin"]
    for folder in folders:
        for pattern in ("libmkl_rt.so*", "mkl_rt*.dll"):
            for path in sorted(folder.glob(pattern)):
                try:
                    return ctypes.CDLL(str(path))
                except OSError:
                    continue
    return None

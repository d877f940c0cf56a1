"""Packing: arrays as short text that a browser unpacks.

An array of numbers is quantized to 16 bits of its range, each step is written as the difference to the step before, the
low bytes come first and the high bytes after them, and deflate shrinks the result. Nearby steps differ little, so that
most of the high bytes are zero.
"""

import zlib
from base64 import b64decode, b64encode
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: Largest number of 16 bits.
MOST = int(np.iinfo(np.uint16).max)


class Packed(TypedDict):
    """An array as text.

    ``kind`` is ``"steps"`` for numbers along a path and ``"index"`` for whole numbers.
    """

    kind: str
    shape: list[int]
    low: list[float]
    span: list[float]
    data: str


def pack_steps(values: Array) -> Packed:
    """Pack numbers along a path.

    Parameters
    ----------
    values : (s, n, k) array
        ``k`` numbers at each of ``n`` points in each of ``s`` steps, all finite.

    Returns
    -------
    Packed
        ``low`` and ``span`` hold the least value and the range of each of the ``k`` numbers.

    Examples
    --------
    >>> import numpy as np
    >>> line = np.linspace(0, 1, 5).reshape(1, 5, 1)
    >>> bool(np.abs(unpack(pack_steps(line)) - line).max() < 1e-5)
    True
    """
    low, high = values.min(axis=(0, 1)), values.max(axis=(0, 1))
    span = np.where(high > low, high - low, 1.0)
    whole = np.rint((values - low) / span * MOST).astype(np.int32)
    whole[1:] -= whole[:-1].copy()
    whole[0, 1:] -= whole[0, :-1].copy()
    return Packed(kind="steps", shape=list(values.shape), low=low.tolist(), span=span.tolist(),
                  data=_shrunk(_unsigned(whole).astype("<u2"), 2))  # fmt: skip


def pack_index(numbers: Ints) -> Packed:
    """Pack whole numbers of 31 bits, such as the corners of triangles."""
    flat = numbers.ravel().astype(np.int64)
    flat = np.diff(flat, prepend=0)
    packed = _shrunk(_unsigned(flat).astype("<u4"), 4)
    return Packed(kind="index", shape=list(numbers.shape), low=[], span=[], data=packed)


def unpack(packed: Packed) -> NDArray:
    """Return the array of a text, as the viewer does; numbers along a path to within their quantization."""
    size = 2 if packed["kind"] == "steps" else 4
    raw = np.frombuffer(zlib.decompress(b64decode(packed["data"])), dtype=np.uint8)
    coded = np.ascontiguousarray(raw.reshape(size, -1).T).view(f"<u{size}").ravel().astype(np.int64)
    signed = (coded >> 1) ^ -(coded & 1)
    if packed["kind"] == "index":
        return np.cumsum(signed).reshape(packed["shape"])
    whole = signed.reshape(packed["shape"])
    whole[0] = np.cumsum(whole[0], axis=0)
    whole = np.cumsum(whole, axis=0) & MOST
    return np.asarray(packed["low"] + whole / MOST * packed["span"])


def _unsigned(signed: NDArray) -> NDArray:
    """Fold negative numbers between the positive ones: 0, -1, 1, -2 … become 0, 1, 2, 3 …; 16 bits wrap around."""
    if signed.dtype == np.int32:
        signed = signed.astype(np.int16).astype(np.int32)
    return np.asarray(np.where(signed < 0, -2 * signed - 1, 2 * signed))


def _shrunk(words: NDArray, size: int) -> str:
    """Deflate the bytes of words, all first bytes before all second ones."""
    planes = words.ravel().view(np.uint8).reshape(-1, size).T
    return b64encode(zlib.compress(np.ascontiguousarray(planes).tobytes(), 6)).decode()

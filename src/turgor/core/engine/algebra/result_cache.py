"""Results of the last calls of a pure function of arrays, found by the content of the arguments.

Runs of a calibration or a sweep build equal arrays from one mesh. What is slow to compute from them is computed once.
"""

from collections import OrderedDict
from collections.abc import Callable
from functools import wraps
from hashlib import blake2b
from threading import Lock
from typing import ParamSpec, TypeVar

import numpy as np

P = ParamSpec("P")
Result = TypeVar("Result")


def last_results(count: int) -> Callable[[Callable[P, Result]], Callable[P, Result]]:
    """Decorate a function of arrays and plain values: the results of its last ``count`` calls are computed once.

    Results are handed out again, not copied: neither the function nor its callers may change them.
    """

    def decorated(function: Callable[P, Result]) -> Callable[P, Result]:
        results: OrderedDict[bytes, Result] = OrderedDict()
        lock = Lock()

        @wraps(function)
        def cached(*arguments: P.args, **named: P.kwargs) -> Result:
            key = _digest((arguments, sorted(named.items())))
            with lock:
                if key in results:
                    results.move_to_end(key)
                    return results[key]
            result = function(*arguments, **named)
            with lock:
                results[key] = result
                while len(results) > count:
                    results.popitem(last=False)
            return result

        return cached

    return decorated


def _digest(value: object) -> bytes:
    """Hash of arrays by type, shape and content, of sequences item by item, and of plain values by their text."""
    if isinstance(value, np.ndarray):
        about = blake2b(f"{value.dtype.str}{value.shape}".encode(), digest_size=16)
        about.update(np.ascontiguousarray(value).data)
        return about.digest()
    if isinstance(value, tuple | list):
        return blake2b(b"".join(map(_digest, value)), digest_size=16, person=b"several").digest()
    return blake2b(repr((type(value).__name__, value)).encode(), digest_size=16).digest()

"""Compiled loops in several files: what keeps numba's cache on disk true when one of them changes."""

from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from types import ModuleType
from typing import TypeVar

Loop = TypeVar("Loop", bound=Callable)


def calls(*modules: ModuleType) -> Callable[[Loop], Loop]:
    """Name a function after the text of the modules that it calls, below ``numba.njit(cache=True)``.

    numba keeps compiled code beside the file of a function, under the function's qualified name, and renews it when
    that file changes. It does not notice a change in another file, whose functions it compiled along. With this
    decorator such a change gives the function another name on disk, so that it is compiled anew. Name every module
    of turgor that the function calls, and those that these call.
    """
    text = b"".join(_text(module) for module in modules)
    key = sha256(text).hexdigest()[:12]

    def named(function: Loop) -> Loop:
        function.__qualname__ = f"{function.__qualname__}_{key}"
        return function

    return named


def _text(module: ModuleType) -> bytes:
    try:
        return Path(str(module.__file__)).read_bytes()
    except OSError:  # a frozen program has no sources, and none of them changes
        return b""

"""Code that SymPy has derived, kept on disk: deriving it takes most of a second in every process that solves.

A file holds the text of one function. Its name is a hash of what was derived from what: the files of all laws, the law,
and what was asked. So a change of any law derives anew. Laws from outside of the package are derived every time, since
their files may call others that are not known here.
"""

import hashlib
import inspect
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from platformdirs import user_cache_path

from turgor.store.whole import whole

#: Name that SymPy gives to functions.
GENERATED = "_lambdifygenerated"

_HERE = Path(__file__).parent


def kept_code(law_type: type, asked: object, derive: Callable[[], Callable[..., Any]]) -> Callable[..., Any]:
    """Return the function that ``derive`` makes, from disk where it was made before.

    Parameters
    ----------
    law_type : type
        The law.
    asked : object
        What else decides the function; its text is compared.
    derive : callable
        Makes the function with ``sympy.lambdify``, for NumPy.

    Returns
    -------
    callable
    """
    if not law_type.__module__.startswith(f"{__package__}."):
        return derive()
    key = hashlib.sha256(f"{_laws()} {law_type.__module__} {law_type.__qualname__} {asked!r}".encode()).hexdigest()
    file = user_cache_path("turgor") / "laws" / f"{key[:24]}.py"
    try:
        return _loaded(file.read_text("utf-8"))
    except (OSError, SyntaxError, KeyError, UnicodeDecodeError):  # not there, or not readable as what it should be
        function = derive()
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with whole(file) as part:
            part.write_text(inspect.getsource(function), "utf-8")
    except OSError:  # nothing can be kept, and the function serves all the same
        pass
    return function


def _loaded(text: str) -> Callable[..., Any]:
    """Make the function of a text as SymPy does: with all names of NumPy."""
    names = dict(vars(np))
    exec(compile(text, "<derived from a law>", "exec"), names)
    function: Callable[..., Any] = names[GENERATED]
    return function


@cache
def _laws() -> str:
    """Hash of the files of all laws."""
    files = sorted(_HERE.rglob("*.py"))
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()

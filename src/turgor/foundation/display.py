"""Shown: how values present themselves on a console and in a notebook.

`brief` is the representation of values that hold arrays: one line, however large they are. `Shown` gives tables and
pictures to notebooks. What draws them lives in the room of results, which no value may import; ``turgor/__init__``,
which stands outside the row of rooms, says where to find it.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    import numpy as np

#: Letters of a text, and entries of a list of values, or columns, that a representation, a message or a table shows.
LONGEST_TEXT, MOST_ENTRIES = 60, 6

#: Rows of a list on a terminal, in a comment or on a page; the others are counted.
MOST_ROWS = 20


class Shown:
    """Base of values that notebooks show as tables and pictures.

    ``drawing(name)`` returns the function of the room of results that draws; ``turgor/__init__`` sets it once.
    """

    __slots__ = ()

    drawing: ClassVar[Callable[[str], Callable[..., Any]] | None] = None

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows instead of the text, as HTML."""
        return str(drawn_by("html_of")(self))


def drawn_by(name: str) -> Callable[..., Any]:
    """Return a function that draws, by its name in ``turgor.views.notebook.drawing``.

    Parameters
    ----------
    name : str

    Returns
    -------
    callable
    """
    assert Shown.drawing is not None  # set when the package is imported
    return Shown.drawing(name)


def brief(value: Any) -> str:
    """Represent a dataclass in one line: arrays by shape and range, long texts and lists cut.

    Parameters
    ----------
    value : dataclass instance

    Returns
    -------
    str

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> import numpy as np
    >>> @dataclass
    ... class Strain:
    ...     name: str
    ...     points: np.ndarray
    >>> brief(Strain("a strip", np.linspace(0, 0.5, 1000)))
    "Strain(name='a strip', points=<1000 values, 0 to 0.5>)"
    """
    listed = ", ".join(f"{each.name}={_short(getattr(value, each.name))}" for each in fields(value) if each.repr)
    return f"{type(value).__name__}({listed})"


def listed(names: Iterable[str], most: int = 8) -> str:
    """List names, the first of them if there are many.

    Parameters
    ----------
    names : iterable of str
    most : int
        How many.

    Examples
    --------
    >>> listed(["body", "base"]), listed("abcdef", most=2)
    ('body, base', 'a, b … (6)')
    """
    every = list(names)
    return ", ".join(every) if len(every) <= most else f"{', '.join(every[:most])} … ({len(every)})"


def counted(number: int, noun: str) -> str:
    """Write a number of things, with the noun in the plural unless there is one.

    Parameters
    ----------
    number : int
    noun : str
        Singular of a noun whose plural ends in s.

    Examples
    --------
    >>> counted(1, "mode"), counted(2, "mode")
    ('1 mode', '2 modes')
    """
    return f"{number} {noun}{'' if number == 1 else 's'}"


def _short(value: Any) -> str:
    """One value of a dataclass, cut where it is long."""
    import numpy as np  # here, so that the command line answers mistakes without it

    match value:
        case np.ndarray():
            return _array(value)
        case str() if len(value) > LONGEST_TEXT:
            return f"{value[: LONGEST_TEXT - 1]!r}…"
        case tuple() | list() if len(value) > MOST_ENTRIES:
            return f"<{len(value)} × {type(value[0]).__name__}>"
        case tuple():
            return f"({', '.join(map(_short, value))}{',' if len(value) == 1 else ''})"
        case Mapping() if len(value) > MOST_ENTRIES:
            return f"<{len(value)} entries: {', '.join(map(str, list(value)[:MOST_ENTRIES]))} …>"
        case Mapping():
            return "{" + ", ".join(f"{key!r}: {_short(each)}" for key, each in value.items()) + "}"
        case float():
            return f"{value:.6g}"
        case _:
            return repr(value)


def _array(values: "np.ndarray") -> str:
    """Shape of an array, and the range of its numbers."""
    import numpy as np

    shape = f"{values.size} values" if values.ndim == 1 else f"{' × '.join(map(str, values.shape))} array"
    if values.size == 0 or values.dtype.kind not in "fiu" or not np.isfinite(values).any():
        return f"<{shape}>"
    return f"<{shape}, {np.nanmin(values):.4g} to {np.nanmax(values):.4g}>"

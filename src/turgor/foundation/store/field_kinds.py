"""Kinds of values in saved files: a text where an object belongs would fail only when it is used."""

import types
from collections.abc import Collection, Mapping
from dataclasses import is_dataclass
from enum import Enum
from functools import cache
from pathlib import Path
from typing import Any, Union, get_args, get_origin, get_type_hints

import numpy as np

#: Kinds that a value of a file may have. Numbers and arrays count as alike, and so do lists and tuples.
_KINDS: Mapping[type, str] = types.MappingProxyType(
    {
        str: "text", Path: "text", int: "number", float: "number", bool: "number", np.ndarray: "numbers",
        list: "list", tuple: "list", set: "list", frozenset: "list", dict: "mapping", types.MappingProxyType: "mapping",
    }
)  # fmt: skip


def wrong_fields(kind: Any, values: Mapping[str, Any]) -> list[str]:
    """Return the names of fields of a dataclass whose values cannot be of their types.

    Types that say nothing of the kind of a value, such as protocols, take any.

    Parameters
    ----------
    kind : class
    values : mapping of str to value

    Examples
    --------
    >>> from turgor.foundation.response import Column
    >>> wrong_fields(Column, {"name": "pressure", "unit": ["kPa"], "values": np.zeros(2)})
    ['unit']
    """
    hints = _hints(kind)
    return [name for name, value in values.items() if not _fits(value, hints.get(name, Any))]


@cache
def _hints(kind: Any) -> Mapping[str, Any]:
    try:
        return get_type_hints(kind)
    except (NameError, TypeError):  # types that are imported for checkers only
        return {}


def _fits(value: Any, hint: Any) -> bool:
    origin, inner = get_origin(hint) or hint, get_args(hint)
    if origin in (Union, types.UnionType):
        return any(_fits(value, each) for each in inner)
    if value is None:
        return hint is None or hint is type(None) or not _is_plain(origin)
    if not isinstance(origin, type):
        return True
    if issubclass(origin, Mapping):
        return isinstance(value, Mapping) and (
            len(inner) != 2 or all(_fits(k, inner[0]) and _fits(v, inner[1]) for k, v in value.items())
        )
    if origin in (list, tuple, set, frozenset) or (
        issubclass(origin, Collection) and origin.__module__ == "collections.abc"
    ):
        return isinstance(value, list | tuple | set | frozenset | np.ndarray) and (
            isinstance(value, np.ndarray) or _items_fit(value, origin, inner)
        )
    if origin is np.ndarray:
        return isinstance(value, np.ndarray | int | float | list | tuple)
    if is_dataclass(origin) or issubclass(origin, Enum):
        return isinstance(value, origin)
    return origin not in _KINDS or _KINDS.get(type(value)) in (_KINDS[origin], None)


def _items_fit(value: Any, origin: type, inner: tuple[Any, ...]) -> bool:
    if origin is tuple and inner and inner[-1] is not Ellipsis:
        return len(value) == len(inner) and all(map(_fits, value, inner))
    return not inner or all(_fits(each, inner[0]) for each in value)


def _is_plain(origin: Any) -> bool:
    return origin in _KINDS or is_dataclass(origin)

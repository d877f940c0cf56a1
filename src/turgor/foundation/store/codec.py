"""Codec: turn values of this package into JSON and arrays, and back.

Dataclasses are written field by field with the name of their class, so that a new field or class needs no line here.
Nothing is executed on reading: only dataclasses and enumerations of this package, or of modules that the program has
imported already, are made again. A class that cannot be written field by field has ``stored()`` and ``restored()``.
"""

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from enum import Enum
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.field_kinds import wrong_fields

Json = Any

#: Metadata of a field whose array is saved with seven digits, in half of the space, and computes with all digits.
SEVEN_DIGITS: Mapping[str, bool] = MappingProxyType({"seven digits": True})

#: The same with six digits of the largest number at each place of the first or the last axis, whichever has fewer
#: places, in whole numbers of 24 bits.
SIX_DIGITS: Mapping[str, bool] = MappingProxyType({"six digits": True})

#: The same with four digits, in whole numbers of 16 bits.
FOUR_DIGITS: Mapping[str, bool] = MappingProxyType({"four digits": True})

#: Names under which a reader finds objects and arrays that are written elsewhere; None where they are not.
Known = Callable[[object], str | None]


def unknown_to_all(value: object) -> None:
    """Return no name for any object, so that all are written."""


@dataclass(slots=True, eq=False)
class Encoder:
    """Writes values as JSON; arrays are collected separately.

    Parameters
    ----------
    known : callable
        ``known(value) -> name`` of an object or array that is written elsewhere, or None.

    Attributes
    ----------
    arrays : dict of str to array
        The arrays by their names in the JSON.
    objects : list of object
        The dataclasses in the order of their numbers.
    """

    known: Known = unknown_to_all
    arrays: dict[str, NDArray[Any]] = field(default_factory=dict, init=False)
    objects: list[object] = field(default_factory=list, init=False)
    _known: dict[int, Json] = field(default_factory=dict)
    _alive: list[object] = field(default_factory=list)

    def encode(self, value: Any, where: str = "value") -> Json:
        """Return the JSON of a value.

        Parameters
        ----------
        value : object
        where : str
            What it is, for messages.

        Raises
        ------
        TurgorError
            If it holds a function or something else that no file can hold.
        """
        if value is None or type(value) in (bool, int, str):
            return value
        if isinstance(value, Enum):
            return {"enum": _class_name(type(value)), "is": value.name}
        if isinstance(value, float | np.floating):
            return float(value) if math.isfinite(value) else {"float": str(float(value))}
        if isinstance(value, np.generic):
            return self.encode(value.item(), where)
        if isinstance(value, Path):
            return {"path": str(value)}
        if id(value) in self._known:
            return self._known[id(value)]
        name = self.known(value)
        if name is not None:
            return {"known": name}
        return self._composed(value, where)

    def _composed(self, value: Any, where: str) -> Json:
        if isinstance(value, np.ndarray):
            name = f"a{len(self.arrays)}"
            self.arrays[name] = value
            return self._noted(value, {"array": name}, {"array": name})
        if isinstance(value, Mapping):
            pairs = [[self.encode(key, where), self.encode(item, f"{where}[{key!r}]")] for key, item in value.items()]
            return {"frozen" if isinstance(value, MappingProxyType) else "dict": pairs}
        if isinstance(value, list | tuple | set | frozenset) and type(value).__module__ == "builtins":
            items = [self.encode(item, f"{where}[{k}]") for k, item in enumerate(value)]
            return items if type(value) is list else {type(value).__name__: items}
        if hasattr(value, "stored"):
            content = {"class": _class_name(type(value)), "stored": self.encode(value.stored(), where)}
        elif is_dataclass(value) and not isinstance(value, type):
            content = {"class": _class_name(type(value)), "fields": self._fields(value, where)}
        else:
            raise TurgorError(
                f"{where} is {_described(value)}, which no file can hold; only numbers, text, arrays and the objects "
                "of turgor can be saved."
            )
        number = len(self.objects)
        self.objects.append(value)
        return self._noted(value, content | {"id": number}, {"same": number})

    def _fields(self, value: Any, where: str) -> dict[str, Json]:
        kind = type(value).__name__
        values = {item.name: getattr(value, item.name) for item in fields(value)}
        shorter = {name: values[name].astype(np.float32) for name in _marked(type(value), SEVEN_DIGITS)}
        rounded = {
            name: self._rounded(values.pop(name), size)
            for digits, size in ((FOUR_DIGITS, 2), (SIX_DIGITS, 3))
            for name in _marked(type(value), digits)
        }
        encoded = {name: self.encode(each, f"{where}, {kind}.{name}") for name, each in (values | shorter).items()}
        return encoded | rounded

    def _rounded(self, value: NDArray[Any], size: int) -> Json:
        """Whole numbers of some bytes, byte by byte, their unit at each place of an axis, and the type of the array."""
        axes = tuple(range(value.ndim - 1)) if value.shape[-1] <= value.shape[0] else tuple(range(1, value.ndim))
        largest = np.abs(value).max(axis=axes, initial=np.finfo(np.float32).tiny, keepdims=True)
        unit = (largest / (2 ** (8 * size - 1) - 1)).astype(np.float64)
        whole = np.rint(value / unit).astype("<i4")[..., None].view(np.uint8)[..., :size]
        return {"rounded": [self.encode(np.ascontiguousarray(whole)), self.encode(unit), value.dtype.name]}

    def _noted(self, value: object, first: Json, again: Json) -> Json:
        """Remember the name of a value from now on. The reference to it stays, so that no other value gets its id."""
        self._known[id(value)] = again
        self._alive.append(value)
        return first


@dataclass(slots=True, eq=False)
class Decoder:
    """Makes values again from JSON and arrays.

    Parameters
    ----------
    arrays : mapping of str to array
    known : callable
        ``known(name) -> value`` of what is written elsewhere.

    Attributes
    ----------
    objects : dict of int to object
        Objects by their numbers.
    """

    arrays: Mapping[str, NDArray[Any]]
    known: Callable[[str], Any]
    objects: dict[int, object] = field(default_factory=dict, init=False)

    def decode(self, tree: Json) -> Any:
        """Return the value of JSON that `Encoder.encode` wrote.

        Raises
        ------
        TurgorError
            If a class is not known, or has other fields than the file.
        """
        if isinstance(tree, list):
            return [self.decode(item) for item in tree]
        if not isinstance(tree, dict):
            return tree
        if "class" in tree:
            value = self._instance(tree)
            self.objects[tree["id"]] = value
            return value
        if "enum" in tree:
            return _enumeration(tree["enum"])[tree["is"]]
        ((what, content),) = tree.items()
        return self._plain(what, content)

    def _plain(self, what: str, content: Json) -> Any:
        match what:
            case "same":
                return self.objects[content]
            case "array":
                return self.arrays[content]
            case "known":
                return self.known(content)
            case "float":
                return float(content)
            case "path":
                return Path(content)
            case "rounded":
                whole, unit, name = (self.decode(item) for item in content)
                full = np.zeros((*whole.shape[:-1], 4), dtype=np.uint8)
                full[..., 4 - whole.shape[-1] :] = whole  # so that the sign is right
                return ((full.view("<i4")[..., 0] >> 8 * (4 - whole.shape[-1])) * unit).astype(name)
            case "tuple" | "set" | "frozenset":
                kind = {"tuple": tuple, "set": set, "frozenset": frozenset}[what]
                return kind(self.decode(item) for item in content)
            case "dict" | "frozen":
                mapping = {self.decode(key): self.decode(item) for key, item in content}
                return mapping if what == "dict" else MappingProxyType(mapping)
        raise TurgorError(f"'{what}' is no kind of value in a turgor file.")

    def _instance(self, tree: Mapping[str, Json]) -> Any:
        kind: Any = _class(tree["class"])
        if "stored" in tree:
            return kind.restored(self.decode(tree["stored"]))
        if not is_dataclass(kind):
            raise TurgorError(f"{tree['class']} is no class that a turgor file can hold.")
        values = {name: self.decode(item) for name, item in tree["fields"].items()}
        expected = [item.name for item in fields(kind)]
        if set(values) != set(expected):
            other = ", ".join(sorted(set(values) ^ set(expected)))
            raise TurgorError(f"{tree['class']} has other fields in this version of turgor than in the file: {other}.")
        wrong = wrong_fields(kind, values)
        if wrong:
            raise TurgorError(f"{tree['class']} has values of another kind than they can have: {', '.join(wrong)}.")
        instance = _blank(kind)
        values |= {name: values[name].astype(np.float64) for name in _marked(kind, SEVEN_DIGITS)}
        for name, value in values.items():
            object.__setattr__(instance, name, value)
        return instance


def _marked(kind: Any, digits: Mapping[str, bool]) -> list[str]:
    """Fields of a dataclass whose arrays are saved with fewer digits."""
    return [item.name for item in fields(kind) if item.metadata == digits]


def _blank(kind: Any) -> Any:
    """An object of a class whose fields are not set yet."""
    return object.__new__(kind)


def _class_name(kind: type) -> str:
    return f"{kind.__module__}:{kind.__qualname__}"


def _class(name: str) -> Any:
    """The class of a name; modules of others count only where the program has imported them."""
    module, _, qualified = name.partition(":")
    if module.partition(".")[0] != "turgor" and module not in sys.modules:
        raise TurgorError(f"the file holds a {qualified} of the module '{module}'; import this module first.")
    try:
        member: Any = import_module(module)
        for part in qualified.split("."):
            member = getattr(member, part)
    except (ImportError, AttributeError):
        raise TurgorError(f"this version of turgor has no {qualified} in {module}, which the file holds.") from None
    if not isinstance(member, type):
        raise TurgorError(f"{name} is no class.")
    return member


def _enumeration(name: str) -> type[Enum]:
    kind = _class(name)
    if not issubclass(kind, Enum):
        raise TurgorError(f"{name} is no enumeration.")
    return kind


def _described(value: Any) -> str:
    if callable(value):
        return f"the function {getattr(value, '__qualname__', value)!r}"
    return f"an object of the class {type(value).__name__}"

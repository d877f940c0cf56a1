"""Tables of a job file and their keys, as the reader has them."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from math import isinf
from types import MappingProxyType
from typing import Any

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from turgor.job.job import ACTUATORS
from turgor.job.reference.kinds import Kind, kind_of
from turgor.job.reference.meanings import markdown, meaning_of
from turgor.job.reference.ranges import Reader, range_of
from turgor.job.text.problems import Problems
from turgor.job.text.quantities import dataclass_table
from turgor.units import UNITS, format_quantity

#: Units in which defaults are written.
_SHOWN = {"length": "mm", "angle": "deg", "pressure": "kPa", "density": "kg/m³"}


@dataclass(frozen=True, slots=True, kw_only=True)
class JobKey:
    """One key of a job file.

    Parameters
    ----------
    name : str
        As it is written.
    kind : str
        What it takes, such as ``"length"``.
    units : tuple of str
        Units that the value may have; empty where it has none.
    default : str
        In TOML; empty where the key has none.
    needed : bool
        Whether the key must be given.
    allowed : str
        Range or choices, part of a sentence; empty where every value of the kind is allowed.
    meaning : str
        What it does, in the notation of Markdown.
    example : str
        A value in TOML.
    """

    name: str
    kind: str
    units: tuple[str, ...] = ()
    default: str = ""
    needed: bool = False
    allowed: str = ""
    meaning: str
    example: str


@dataclass(frozen=True, slots=True, kw_only=True)
class JobTable:
    """A table of a job file.

    Parameters
    ----------
    header : str
        As it is written, such as ``"[mesh]"``; with a name in capitals where the user chooses it.
    words : str
        One sentence on it.
    keys : tuple of JobKey
    """

    header: str
    words: str
    keys: tuple[JobKey, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where the keys of a table are defined, described and checked.

    Parameters
    ----------
    model : type
        What validates the table.
    described : tuple of classes and functions
        Docstrings that say what the keys mean; that of the model comes first.
    read : callable or None
        ``read(values, problems)``, called for ranges.
    base : mapping
        A table that it accepts.
    without : iterable of str
        Keys that another table has.
    unasked : tuple of str
        Keys whose range depends on another key.
    """

    model: type[BaseModel]
    described: tuple[Any, ...] = ()
    read: Reader | None = None
    base: Mapping[str, Any] = field(default_factory=dict)
    without: Iterable[str] = ("type",)
    unasked: tuple[str, ...] = ()

    def table(self, header: str, words: str) -> JobTable:
        """Make the table."""
        omitted = set(self.without)
        keys = [self._key(name, item) for name, item in self.model.model_fields.items() if name not in omitted]
        return JobTable(header=header, words=markdown(words), keys=tuple(keys))

    def _key(self, name: str, item: FieldInfo) -> JobKey:
        kind = kind_of(item)
        reader = None if name in self.unasked else self.read
        allowed = range_of(name, kind, self.base, reader) if reader is not None else ""
        default = toml(None if item.is_required() else item.get_default(call_default_factory=True), kind)
        given = toml(self.base[name], kind) if name in self.base else ""
        return JobKey(
            name=name,
            kind=kind.words,
            units=kind.units,
            default=default,
            needed=item.is_required(),
            allowed=allowed,
            meaning=meaning_of(name, (self.model, *self.described)),
            example=(item.examples or [""])[0] or given or default or _example(kind, allowed),
        )


def family_table(name: str, given: Mapping[str, Any] = MappingProxyType({})) -> JobTable:
    """Return the keys of an actuator family, with the range of each where the other dimensions stay.

    Parameters
    ----------
    name : str
        One of `ACTUATORS`.
    given : mapping
        Dimensions that the family accepts, as a job file has them; the others have their defaults.

    Examples
    --------
    >>> next(key.allowed for key in family_table("fast_pneunet").keys if key.name == "chambers")
    'a whole number from 1 to 100'
    """
    kind: Any = ACTUATORS[name]
    names = [item.name for item in fields(kind)]
    model = dataclass_table(kind)

    def read(values: Mapping[str, Any], problems: Problems) -> None:
        given = model.model_validate({"type": name, **values})
        problems.attempt((), lambda: kind(**{each: getattr(given, each) for each in names}), fields=names)

    words = (kind.__doc__ or "").splitlines()[0]
    return Source(model=model, described=(kind,), read=read, base=given).table("[actuator]", words)


def toml(value: Any, kind: Kind) -> str:
    """Write a value in TOML; nothing for one that cannot be stated.

    Examples
    --------
    >>> toml(0.002, Kind(words="length", dimension="length")), toml(True, Kind(words="true or false"))
    ('"2 mm"', 'true')
    """
    if value is None or (isinstance(value, float) and isinf(value) and not kind.words.startswith("pressure or")):
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, float) and isinf(value):
        return kind.example
    if isinstance(value, float) and kind.dimension:
        return f'"{format_quantity(value, _SHOWN.get(kind.dimension, next(iter(UNITS[kind.dimension]))))}"'
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{name} = {toml(each, kind)}' for name, each in value.items())} }}" if value else "{ }"
    if isinstance(value, list | tuple):
        return f"[{', '.join(toml(each, kind) for each in value)}]"
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _example(kind: Kind, allowed: str) -> str:
    """Example of a key without a default: the first of its choices, or one of its kind."""
    choices = allowed.split(", ") if kind.words.startswith("text") and ", " in allowed else []
    return f'"{choices[0]}"' if choices else kind.example

"""Values of a file: quantities, signals and passages, by the fields of dataclasses."""

from collections.abc import Mapping, Sequence
from dataclasses import MISSING, Field, dataclass, fields
from typing import Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import shown
from turgor.systems.air.parts.passages import Leakage, Orifice, Passage, Restriction, Tubing
from turgor.systems.air.signals import AnySignal, Pwm, Signal, Sine
from turgor.units import EXAMPLES, parse_quantity

#: Keys of fields that have another name in files.
KEYS: Mapping[str, str] = {"start": "from", "end": "to"}

#: Passages by the type of a part that is nothing else.
PASSAGES: Mapping[str, type[Passage]] = {
    "restriction": Restriction, "orifice": Orifice, "tube": Tubing, "leak": Leakage,
}  # fmt: skip

#: Passages of a valve, by the key that only they have.
OF_VALVES: Mapping[str, type[Passage]] = {"conductance": Restriction, "diameter": Orifice}

#: Fields that are no keys: a part sets them itself.
HIDDEN = ("sign",)


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a table.

    Parameters
    ----------
    name : str
    item : Field
        The field of a dataclass that it states.
    owner : type
        The dataclass.
    """

    name: str
    item: Field[Any]
    owner: type

    @property
    def needed(self) -> bool:
        """Whether it has no default."""
        return self.item.default is MISSING

    @property
    def dimension(self) -> str:
        """Dimension of its value."""
        return str(self.item.metadata.get("dimension", ""))

    @property
    def kind(self) -> str:
        """What its value is, in words."""
        what = self.dimension or ("number" if self.item.type in (float, float | None, AnySignal) else "")
        if self.item.type == AnySignal:
            return f"{what or 'number'}, or a signal"
        if self.item.type == Sequence[float]:
            return f"list: {what}"
        if self.item.type in (Passage, Passage | None):
            return "table: passage"
        words: Mapping[Any, str] = {int: "whole number", bool: "true or false", str | float: "text or number"}
        return what or words.get(self.item.type, "text")

    def read(self, value: Any) -> Any:
        """Read its value."""
        if self.item.type == AnySignal:
            return read_signal(value, self.dimension, lines=self.item.metadata.get("signal", "lines") == "lines")
        if self.item.type == Sequence[float]:
            return tuple(quantity(each, self.dimension) for each in listed(value))
        if self.item.type in (Passage, Passage | None):
            return read_valve_passage(table(value))
        if self.item.type in (float, float | None) or self.dimension:
            return quantity(value, self.dimension)
        if self.item.type in (bool, int) and type(value) is not self.item.type:
            raise TurgorError(f"{shown(value)} is no {self.kind}.")
        texts: Mapping[Any, Any] = {str: str, str | None: str, str | float: str | int | float}
        if self.item.type in texts and not isinstance(value, texts[self.item.type]):
            raise TurgorError(f"{shown(value)} is no text.")
        return value


def keys_of(kind: type, without: Sequence[str] = ()) -> dict[str, Key]:
    """Return the keys of a dataclass by name, without some fields."""
    items = [item for item in fields(kind) if item.init and item.name not in (*without, *HIDDEN)]
    return {name: Key(name, item, kind) for item in items for name in [KEYS.get(item.name, item.name)]}


def passage_keys() -> dict[str, Key]:
    """Return the keys of the passage of a valve."""
    return {key: each for kind in OF_VALVES.values() for key, each in keys_of(kind).items()}


def made(kind: Any, content: Mapping[str, Any], without: Sequence[str] = ()) -> dict[str, Any]:
    """Read the keys of a dataclass from a table: values by the names of fields.

    Raises
    ------
    TurgorError
        If a key is missing, or a value is wrong: the sentence begins with the key.
    """
    values = {}
    for name, key in keys_of(kind, without).items():
        if name in content:
            try:
                values[key.item.name] = key.read(content[name])
            except TurgorError as error:
                raise Wrong(name, str(error)) from None
        elif key.needed:
            raise Wrong(name, f"it is missing; a {key.kind} is needed{_example(key)}.")
    return values


class Wrong(TurgorError):
    """An error of a key."""

    def __init__(self, key: str, sentence: str) -> None:
        super().__init__(sentence)
        self.key = key


def _example(key: Key) -> str:
    return f", such as '{EXAMPLES[key.dimension]}'" if key.dimension in EXAMPLES else ""


def read_valve_passage(content: Mapping[str, Any]) -> Passage:
    """Read the passage of a valve: a restriction by its conductance, or an orifice by its diameter."""
    stated = [key for key in OF_VALVES if key in content]
    if len(stated) != 1:
        raise Wrong(
            "conductance",
            "state how wide the valve is: 'conductance' (ISO 6358), such as '0.5 dm³/(s bar)', or 'diameter' of an "
            f"orifice; {'both are' if stated else 'neither is'} there.",
        )
    kind: Any = OF_VALVES[stated[0]]
    others = set(passage_keys()) - set(keys_of(kind))
    for key in content:
        if key in others:
            raise Wrong(key, f"it does not belong to '{stated[0]}'.")
    passage: Passage = kind(**made(kind, content))
    return passage


def quantity(value: Any, dimension: str) -> float:
    """Read a number, with its unit where it has a dimension."""
    if dimension:
        return parse_quantity(value, dimension)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TurgorError(f"{shown(value)} is no number.")
    return float(value)


def listed(value: Any) -> Sequence[Any]:
    """Return a list."""
    if not isinstance(value, list):
        raise TurgorError(f"{shown(value)} is no list.")
    return value


def table(value: Any) -> Mapping[str, Any]:
    """Return a table."""
    if not isinstance(value, Mapping):
        raise TurgorError(f"{shown(value)} is no table.")
    return value


def read_signal(value: Any, dimension: str, *, lines: bool) -> AnySignal:
    """Read a signal: a value, points in time, pulses, or a sine.

    Parameters
    ----------
    value : number, text, list or table
    dimension : str
    lines : bool
        Whether values change along straight lines between points.

    Examples
    --------
    >>> read_signal([["0 s", 1], ["0.5 s", -1]], "", lines=False).values
    (1.0, -1.0)
    >>> read_signal({"frequency": "10 Hz", "duty": 0.3}, "", lines=False)
    Pwm(frequency=10.0, duty=0.3)
    """
    if isinstance(value, list):
        return _points(value, dimension, lines, None)
    if not isinstance(value, Mapping):
        return quantity(value, dimension)
    forms = {"points": ("points", "period"), "duty": ("frequency", "duty"), "mean": ("mean", "amplitude", "frequency")}
    form = next((key for key in forms if key in value), None)
    if form is None:
        raise TurgorError("the signal has none of the keys points, duty, mean; one of them is needed.")
    for key in value:
        if key not in forms[form]:
            raise unknown("key of the signal", key, forms[form])
    missing = [key for key in forms[form] if key not in value and key != "period"]
    if missing:
        raise TurgorError(f"the signal needs the key '{missing[0]}', too.")
    if form == "points":
        period = quantity(value["period"], "time") if "period" in value else None
        return _points(listed(value["points"]), dimension, lines, period)
    frequency = quantity(value["frequency"], "frequency")
    if form == "duty":
        duty = read_signal(value["duty"], "", lines=True)
        assert isinstance(duty, float | Signal)
        return Pwm(frequency, duty)
    return Sine(quantity(value["mean"], dimension), quantity(value["amplitude"], dimension), frequency)


def _points(value: Sequence[Any], dimension: str, lines: bool, period: float | None) -> Signal:
    for point in value:
        if not isinstance(point, list) or len(point) != 2:
            raise TurgorError(f'{shown(point)} is no point [time, value], such as ["0.5 s", 1].')
    times = [0.0 if point[0] == 0 else quantity(point[0], "time") for point in value]
    return Signal(tuple(times), tuple(quantity(point[1], dimension) for point in value), lines, period)

"""Keys: the numbers of a model by dotted names, as in a job file, and the model with other ones."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from functools import reduce
from math import hypot, isfinite
from typing import Any

from turgor.accuracy.gradients.variation import Variation
from turgor.core.materials.material import Material
from turgor.core.model.drive import common_pressure
from turgor.core.model.loads import Gravity, Pressure
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plate
from turgor.core.model.sheets import Membrane, Shell
from turgor.foundation.errors import TurgorError, unknown

#: Parts of a model that hold numbers, by the name that they have in job files.
_PARTS = {"materials": "materials", "loads": "loads", "fibers": "reinforcements", "supports": "supports"}

#: Key of the acceleration of gravity as a vector.
FALLING = "falling"

#: The key of the pressure where all pressed faces share one.
COMMON = "loads.pressure"

#: What is no quantity that could change by little: ranges of validity, histories, counts.
_EXCLUDED = ("source", "stretch_range", "history", "starts", "viscoelasticity", "stress_softening", "permanent_set")

#: Fields whose content counts as that of the whole: constants of the law of a material, of the material of a sheet, the
#: shape of an obstacle.
_THROUGH = {
    Material: ("law",), Shell: ("material",), Membrane: ("material",), Obstacle: ("shape",), Plate: ("shape",)
}  # fmt: skip

#: Units in which numbers are shown, by the last part of their key.
_UNITS = (
    (r"pressure", "kPa"),
    (r"thickness|diameter|spacing|pitch", "mm"),
    (r"angle_from_\w+", "deg"),
    (r"bulk_modulus|E|C\d\d|mu", "MPa"),
)


def model_numbers(model: Model) -> dict[str, float]:
    """Find the numbers of a model by their keys, as those of a job file: ``"materials.body.C10"``.

    Parameters
    ----------
    model : Model

    Returns
    -------
    dict of str to float [SI]
        Constants of materials, thickness of layers, fibers, loads, and what supports state.
    """
    numbers: dict[str, float] = {}
    common = common_pressure(model.loads)
    if common is not None:
        numbers[COMMON] = common.pressure
    for name, attribute in _PARTS.items():
        numbers |= dict(_numbers(name, getattr(model, attribute)))
    return numbers


def input_numbers(model: Model) -> dict[str, float]:
    """Find further numbers of a model that inputs of reduced models may be: ``"obstacles.floor.point.3"``.

    Parameters
    ----------
    model : Model

    Returns
    -------
    dict of str to float [SI]
        Coordinates of the point of a plane, of the center of other shapes; components of gravity, as an acceleration.
    """
    every = dict(_numbers("obstacles", model.contact.obstacles))
    places = {key: value for key, value in every.items() if re.fullmatch(r".+\.(point|center)\.[123]", key)}
    weights = {
        f"loads.{name}.{FALLING}.{axis}": value
        for name, load in zip(_names(model.loads), model.loads, strict=True)
        if isinstance(load, Gravity)
        for axis, value in enumerate(load.falling, start=1)
    }
    return places | weights


def with_number(model: Model, key: str, value: float) -> Model:
    """Return a model with another number.

    Parameters
    ----------
    model : Model
    key : str
        One of `model_numbers` or `input_numbers`, or several with commas between them, which have one number.
    value : float [SI]

    Returns
    -------
    Model
    """
    return reduce(lambda changed, single: _with_one(changed, single, value), key.split(","), model)


def model_variation(model: Model, keys: Sequence[str], inputs: bool = False) -> Variation:
    """Return a model as a function of some of its numbers.

    Parameters
    ----------
    model : Model
    keys : sequence of str
        Of `model_numbers`; several with commas between them are one number.
    inputs : bool
        Whether those of `input_numbers` are allowed, too.

    Returns
    -------
    Variation

    Raises
    ------
    TurgorError
        If the model has no such number, with the near match, or keys that stand for one have different numbers.
    """
    known = model_numbers(model) | (input_numbers(model) if inputs else {})
    values: dict[str, float] = {}
    for key in keys:
        equal = [_number_of(known, single) for single in key.split(",")]
        if len(set(equal)) > 1:
            raise TurgorError(f"'{key}' has the numbers {' and '.join(f'{each:g}' for each in equal)}; one is needed.")
        values[key] = equal[0]
    units = {key: unit for key in keys if (unit := _unit_of(key))}

    def model_of(numbers: Mapping[str, float]) -> Model:
        return reduce(lambda changed, key: with_number(changed, key, numbers[key]), numbers, model)

    scales = {key: 1.0 for key, value in values.items() if inputs and not value}  # their steps follow from ranges
    return Variation(model_of, values, units, scales)


def _number_of(known: Mapping[str, float], key: str) -> float:
    if key not in known:
        same = [each for each in known if each.split(".")[0] == key.split(".")[0]]
        raise unknown("number of the model", key, same or known)
    return known[key]


def _unit_of(key: str) -> str:
    """Unit in which a number is shown; empty for SI."""
    if key.startswith("obstacles."):
        return "mm"
    parts = [part for part in key.split(",")[0].split(".") if not part.isdigit()]
    return next((unit for pattern, unit in _UNITS if re.fullmatch(pattern, parts[-1])), "")


def _with_one(model: Model, key: str, value: float) -> Model:
    if key == COMMON:
        pressed = (replace(each, pressure=value) if isinstance(each, Pressure) else each for each in model.loads)
        return replace(model, loads=tuple(pressed))
    head, *rest = key.split(".")
    if head == "obstacles":
        moved = _put(model.contact.obstacles, rest, value)
        return replace(model, contact=model.contact.with_obstacles(moved))
    attribute = _PARTS[head]
    return replace(model, **{attribute: _put(getattr(model, attribute), rest, value)})


def _numbers(key: str, value: Any) -> Iterator[tuple[str, float]]:
    """Keys and values of all numbers in a value."""
    if isinstance(value, bool | str) or value is None:
        return
    if isinstance(value, int | float):
        if isfinite(value):
            yield key, float(value)
        return
    for name, child in _children(value).items():
        yield from _numbers(f"{key}.{name}", child)


def _children(value: Any) -> dict[str, Any]:
    """Members of a value, by the parts of keys."""
    if isinstance(value, Mapping):
        return {str(name): each for name, each in value.items()}
    if isinstance(value, tuple | list):
        return dict(zip(_names(value), value, strict=True))
    if not is_dataclass(value):
        return {}
    children: dict[str, Any] = {}
    for each in fields(value):
        if each.name in _EXCLUDED:
            continue
        child = getattr(value, each.name)
        if each.name in _THROUGH.get(type(value), ()):
            children |= _children(child)
        else:
            children[each.name] = child
    return children


def _names(values: Sequence[Any]) -> list[str]:
    """Keys of the members of a list: their name or face, where no two share one; else their number, from 1."""
    names = [_own_name(each) for each in values]
    return [name if name and names.count(name) == 1 else str(place) for place, name in enumerate(names, start=1)]


def _own_name(value: Any) -> str:
    """Name or face of what a model holds, or its kind; empty for a plain number."""
    name = getattr(value, "name", None) or getattr(value, "face", None)
    if isinstance(name, str):
        return name
    return type(value).__name__.lower() if is_dataclass(value) else ""


def _falling(gravity: Gravity, axis: int, number: float) -> Gravity:
    """Gravity with another component of its acceleration; without any, its direction stays for the next component."""
    x, y, z = (number if place == axis else part for place, part in enumerate(gravity.falling))
    size = hypot(x, y, z)
    return replace(gravity, direction=(x, y, z) if size else gravity.direction, acceleration=size)


def _put(value: Any, parts: Sequence[str], number: float) -> Any:
    """Return a value in which a number is another one."""
    if not parts:
        return number
    first, rest = parts[0], parts[1:]
    if isinstance(value, Gravity) and first == FALLING:
        return _falling(value, int(rest[0]) - 1, number)
    if isinstance(value, Mapping):
        return {name: _put(each, rest, number) if str(name) == first else each for name, each in value.items()}
    if isinstance(value, tuple | list):
        return tuple(
            _put(each, rest, number) if name == first else each for name, each in zip(_names(value), value, strict=True)
        )
    own = {each.name for each in fields(value)}
    through = _THROUGH.get(type(value), ())
    holder = next((name for name in through if first in _children(getattr(value, name))), None)
    if holder is not None and (first not in own or first in _children(getattr(value, holder))):
        return replace(value, **{holder: _put(getattr(value, holder), parts, number)})
    return replace(value, **{first: _put(getattr(value, first), rest, number)})

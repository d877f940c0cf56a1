"""Dimensions of a part: what a script or a table says of them, and how stated values become arguments."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite

from turgor.foundation.errors import TurgorError, near_match
from turgor.units import UNITS, length_unit, parse_quantity, split_quantity, unit_value

#: A dimension as a job states it: text with a unit, a number, or a choice.
Stated = float | int | str | bool

#: Kinds of dimensions by the types that annotate them.
KINDS = {"float": "number", "int": "whole number", "str": "text", "bool": "true or false"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """A dimension of a part.

    Parameters
    ----------
    name : str
    kind : str
        One of the values of `KINDS`.
    default : float, int, str, bool or None
        None where there is none, or where it is not written as a plain value.
    needed : bool
        Whether a value has to be stated.
    unit : str
        Unit of the numbers; empty where the stated text says what they measure.
    low, high : float
        Allowed range, in this unit.
    """

    name: str
    kind: str = "number"
    default: Stated | None = None
    needed: bool = True
    unit: str = ""
    low: float = -inf
    high: float = inf

    @property
    def with_unit(self) -> Stated | None:
        """The default as a job states it."""
        named = self.unit and self.kind == "number" and self.default is not None
        return f"{self.default} {self.unit}" if named else self.default


def arguments(
    parameters: Sequence[Parameter], stated: Mapping[str, Stated], unit: str | float | None, owner: str
) -> dict[str, Stated]:
    """Return the arguments that dimensions are.

    Parameters
    ----------
    parameters : sequence of Parameter
    stated : mapping of str to float, int, str or bool
        Dimensions of a job.
    unit : str or float, optional
        Unit of lengths, or its length in meters; millimeters by default. Angles are in degrees.
    owner : str
        What has the dimensions, for messages.

    Returns
    -------
    dict of str to float, int, str or bool

    Raises
    ------
    TurgorError
        If a dimension is unknown, missing, or not allowed.

    Examples
    --------
    >>> arguments([Parameter(name="wall"), Parameter(name="tilt")], {"wall": "0.15 cm", "tilt": "10 deg"}, None, "draw")
    {'wall': 1.5, 'tilt': 10.0}
    """
    known = [each.name for each in parameters]
    for name in stated:
        if name not in known:
            listed = f"Known: {', '.join(known)}." if known else "It takes none."
            raise TurgorError(f"{name} is no dimension of {owner}{near_match(name, known) or '.'} {listed}")
    missing = [each.name for each in parameters if each.needed and each.name not in stated]
    if missing:
        raise TurgorError(f"{owner} needs {', '.join(missing)}; state {missing[0]} below [actuator.dimensions].")
    return {each.name: _argument(each, stated[each.name], unit) for each in parameters if each.name in stated}


def _argument(parameter: Parameter, stated: Stated, unit: str | float | None) -> Stated:
    kind, name = parameter.kind, parameter.name
    if kind in ("text", "true or false", "whole number"):
        fits = {"text": str, "true or false": bool, "whole number": int}[kind]
        if not isinstance(stated, fits) or (fits is int and isinstance(stated, bool)):
            raise TurgorError(
                f"{name} is {stated!r}; {kind if kind != 'whole number' else 'a whole number'} is needed."
            )
        if fits is int:
            _check_range(parameter, float(stated), stated)
        return stated
    if isinstance(stated, bool):
        raise TurgorError(f"{name} is {str(stated).lower()}; a number is needed.")
    value = _number_of_text(parameter, stated, unit) if isinstance(stated, str) else stated
    if not isinstance(stated, str) and parameter.unit:
        raise TurgorError(f"{name} is {stated}, which needs a unit, such as '{stated} {parameter.unit}'.")
    if not isfinite(value):
        raise TurgorError(f"{name} is {stated}; a finite number is needed.")
    _check_range(parameter, value, stated)
    return value


def _number_of_text(parameter: Parameter, text: str, unit: str | float | None) -> float:
    """Read a length or an angle; the number is in the unit of the parameter, else that of the part or degrees."""
    split = split_quantity(text)
    stated = split[1] if split is not None else ""
    dimension = next((each for each in ("length", "angle") if (parameter.unit or stated) in UNITS[each]), "length")
    try:
        value = parse_quantity(text, dimension)
    except TurgorError as error:
        raise TurgorError(f"{parameter.name} is '{text}'; {error}") from None
    if dimension == "length" and value < 0 and parameter.low == -inf and not _may_be_negative(parameter):
        raise TurgorError(
            f"{parameter.name} is '{text}'; a length is positive, unless the script states a range that says "
            f'otherwise, such as {parameter.name}: Annotated[float, "mm", (-5, 5)].'
        )
    if parameter.unit:
        factor = unit_value(parameter.unit)
    else:
        factor = unit_value("deg") if dimension == "angle" else length_unit("mm" if unit is None else unit)
    return float(
        f"{value / factor:.15g}"
    )  # without the last digit that a change of units leaves: 7, not 7.000000000000001


def _may_be_negative(parameter: Parameter) -> bool:
    return isinstance(parameter.default, float | int) and parameter.default <= 0


def _check_range(parameter: Parameter, value: float, stated: Stated) -> None:
    if parameter.low <= value <= parameter.high:
        return
    unit = f" {parameter.unit}" if parameter.unit else ""
    allowed = f"{parameter.low:g}{unit} to {parameter.high:g}{unit}"
    raise TurgorError(f"{parameter.name} is {stated!r}; allowed is {allowed}, as the script states.")


def shown_dimensions(stated: Mapping[str, Stated]) -> str:
    """Write dimensions for a message.

    Examples
    --------
    >>> shown_dimensions({"wall": "1.5 mm", "chambers": 3}), shown_dimensions({})
    ('wall = 1.5 mm, chambers = 3', 'its default dimensions')
    """
    return ", ".join(f"{name} = {value}" for name, value in stated.items()) or "its default dimensions"

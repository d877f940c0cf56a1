"""Units: SI floats inside; multiply by a unit on the way in, divide on the way out; read text with a unit.

>>> from turgor.units import mm, kPa, deg
>>> 1.5 * mm
0.0015
>>> 50 * kPa
50000.0
>>> parse_quantity("60 kPa", "pressure")
60000.0
"""

import re
from collections.abc import Mapping
from difflib import get_close_matches
from math import isfinite, nan, pi
from types import MappingProxyType

from turgor.foundation.errors import TurgorError

__all__ = [
    *("m", "cm", "mm", "um", "inch", "rad", "deg", "Pa", "kPa", "MPa", "GPa", "bar", "mbar", "psi", "mmHg", "cmH2O"),
    *("N", "mN", "gf", "lbf", "kg", "g", "s", "ms", "mL", "uL", "L", "UNITS", "format_quantity", "parse_quantity"),
]

m = 1.0
cm = 1e-2
mm = 1e-3
um = 1e-6
inch = 25.4e-3

rad = 1.0
deg = pi / 180.0

Pa = 1.0
kPa = 1e3
MPa = 1e6
GPa = 1e9
bar = 1e5
mbar = 100.0
psi = 6894.757293168361
mmHg = 133.322387415
cmH2O = 98.0665

N = 1.0
mN = 1e-3
gf = 9.80665e-3
lbf = 4.4482216152605

kg = 1.0
g = 1e-3

s = 1.0
ms = 1e-3

mL = 1e-6
uL = 1e-9
L = 1e-3

#: Units of each dimension as they are written in files; the SI unit of a dimension comes first.
UNITS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "length": MappingProxyType({"m": m, "cm": cm, "mm": mm, "um": um, "µm": um, "in": inch, "inch": inch}),
        "angle": MappingProxyType({"rad": rad, "deg": deg, "°": deg}),
        "pressure": MappingProxyType(
            {
                **{"Pa": Pa, "kPa": kPa, "MPa": MPa, "GPa": GPa, "bar": bar, "mbar": mbar, "hPa": mbar, "psi": psi},
                **{"mmHg": mmHg, "inHg": 25.4 * mmHg, "cmH2O": cmH2O, "mmH2O": 0.1 * cmH2O, "inH2O": 2.54 * cmH2O},
                **{"atm": 101325.0, "kgf/cm2": 98066.5, "N/mm2": MPa, "N/mm²": MPa, "N/cm2": 1e4, "N/m2": Pa},
            }
        ),
        "time": MappingProxyType({"s": s, "ms": ms, "min": 60.0, "h": 3600.0}),
        "area": MappingProxyType({"m²": 1.0, "m2": 1.0, "cm²": cm**2, "cm2": cm**2, "mm²": mm**2, "mm2": mm**2}),
        "volume": MappingProxyType(
            {
                **{"m³": 1.0, "m3": 1.0, "L": L, "mL": mL, "uL": uL, "µL": uL},
                **{"cm³": mL, "cm3": mL, "cc": mL, "mm³": mm**3, "mm3": mm**3, "in3": inch**3},
            }
        ),
        "flow rate": MappingProxyType(
            {
                "m³/s": 1.0,
                "m3/s": 1.0,
                "mL/s": mL,
                "mL/min": mL / 60,
                "uL/min": uL / 60,
                "L/min": L / 60,
                "L/h": L / 3600,
            }
        ),
        "rate": MappingProxyType({"1/s": 1.0, "1/ms": 1e3}),
        "speed": MappingProxyType({"m/s": 1.0, "mm/s": mm}),
        "angular speed": MappingProxyType({"rad/s": 1.0, "rpm": 2 * pi / 60, "1/min": 2 * pi / 60, "deg/s": deg}),
        "acceleration": MappingProxyType({"m/s²": 1.0, "m/s2": 1.0}),
        "force": MappingProxyType({"N": N, "mN": mN, "kN": 1e3, "gf": gf, "kgf": 1e3 * gf, "lbf": lbf}),
        "mass": MappingProxyType({"kg": kg, "g": g, "mg": 1e-6, "lb": 0.45359237, "oz": 0.45359237 / 16}),
        "density": MappingProxyType({"kg/m³": 1.0, "kg/m3": 1.0, "g/cm³": 1e3, "g/cm3": 1e3}),
        "spring stiffness": MappingProxyType({"N/m": 1.0, "N/mm": 1e3, "mN/mm": 1.0}),
        "compliance": MappingProxyType({"m/N": 1.0, "mm/N": 1e-3, "µm/N": 1e-6, "um/N": 1e-6, "mm/kN": 1e-6}),
        "force per length": MappingProxyType(
            {"N/m": 1.0, "N/mm": 1e3, "mN/mm": 1.0, "kN/m": 1e3, "lbf/in": lbf / inch, "pli": lbf / inch}
        ),
        "fracture energy": MappingProxyType(
            {"J/m²": 1.0, "J/m2": 1.0, "kJ/m²": 1e3, "kJ/m2": 1e3, "N/m": 1.0, "N/mm": 1e3}
        ),
        "moment": MappingProxyType({"N m": 1.0, "Nm": 1.0, "N mm": 1e-3, "mN m": 1e-3, "mNm": 1e-3}),
        "bending stiffness": MappingProxyType(
            {"N m": 1.0, "N mm": 1e-3, "mN m": 1e-3, "mN mm": 1e-6, "µN m": 1e-6, "uN m": 1e-6}
        ),
        "rotational stiffness": MappingProxyType(
            {"N m/rad": 1.0, "Nm/rad": 1.0, "N mm/rad": 1e-3, "N mm/deg": 1e-3 / deg}
        ),
        "inertia": MappingProxyType({"kg m²": 1.0, "kg m2": 1.0, "kg mm²": mm**2, "kg mm2": mm**2, "g mm²": g * mm**2}),
        "contact stiffness": MappingProxyType({"Pa/m": 1.0, "kPa/mm": 1e6, "MPa/mm": 1e9, "N/m³": 1.0, "N/mm³": 1e9}),
        "conductance": MappingProxyType(
            {
                **{"m³/(s Pa)": 1.0, "m3/(s Pa)": 1.0, "dm³/(s bar)": 1e-8, "dm3/(s bar)": 1e-8},
                **{"L/(s bar)": 1e-8, "L/(min bar)": 1e-8 / 60},
            }
        ),
        "flow resistance": MappingProxyType(
            {
                **{"Pa s/m³": 1.0, "Pa s/m3": 1.0, "Pa·s/m³": 1.0, "Pa s/mL": 1e6, "kPa s/mL": 1e9},
                **{"kPa min/mL": 6e10, "kPa s/L": 1e6, "mbar s/mL": 1e8, "bar s/L": 1e8},
            }
        ),
        "frequency": MappingProxyType({"Hz": 1.0, "kHz": 1e3}),
        "temperature": MappingProxyType({"K": 1.0, "°C": 1.0, "degC": 1.0}),
        "share": MappingProxyType({"1": 1.0, "%": 0.01}),
        "expansion": MappingProxyType({"1/K": 1.0, "1/°C": 1.0, "ppm/K": 1e-6}),
        "heat conductance": MappingProxyType({"W/K": 1.0, "mW/K": 1e-3}),
        "stress per temperature": MappingProxyType({"Pa/K": 1.0, "MPa/K": MPa, "MPa/°C": MPa}),
    }
)

#: A quantity of each dimension as it is written in files.
EXAMPLES: Mapping[str, str] = MappingProxyType(
    {
        "length": "1.5 mm",
        "angle": "90 deg",
        "pressure": "60 kPa",
        "time": "2 s",
        "rate": "1 1/s",
        "speed": "0.5 m/s",
        "angular speed": "300 rpm",
        "acceleration": "9.81 m/s²",
        "force": "0.5 N",
        "mass": "50 g",
        "area": "80 mm²",
        "volume": "12 mL",
        "flow rate": "30 mL/min",
        "density": "1130 kg/m³",
        "spring stiffness": "50 N/m",
        "compliance": "0.02 mm/N",
        "force per length": "2 N/m",
        "fracture energy": "200 J/m²",
        "moment": "20 N mm",
        "bending stiffness": "10 µN m",
        "rotational stiffness": "0.5 N m/rad",
        "inertia": "2 kg mm²",
        "contact stiffness": "10 MPa/mm",
        "conductance": "0.5 dm³/(s bar)",
        "flow resistance": "2 kPa s/mL",
        "frequency": "20 Hz",
        "temperature": "20 °C",
        "share": "0.3 %",
        "expansion": "3e-4 1/K",
        "heat conductance": "5 mW/K",
        "stress per temperature": "8 MPa/K",
    }
)

#: Value in kelvin of the zero of a unit.
_ZERO: Mapping[str, float] = MappingProxyType({"°C": 273.15, "degC": 273.15})

#: Signs that look alike or are typed for convenience, and the one that is understood.
_SAME_SIGN = str.maketrans({"\N{GREEK SMALL LETTER MU}": "µ", "\N{MINUS SIGN}": "-", "\N{NO-BREAK SPACE}": " "})
_NUMBER_AND_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)


def length_unit(unit: str | float) -> float:
    """Return the length of one unit of a file, by its name or as a number of meters.

    Parameters
    ----------
    unit : str or float
        A key of the lengths in `UNITS`, or meters for each unit of the file, such as 0.0254 for inches.

    Returns
    -------
    float [m]

    Raises
    ------
    TurgorError
        If it is neither.

    Examples
    --------
    >>> length_unit("cm"), length_unit(0.0254), length_unit("1e-6")
    (0.01, 0.0254, 1e-06)
    >>> length_unit("milli")
    Traceback (most recent call last):
    turgor.TurgorError: unit is 'milli'; allowed is one of m, cm, mm, um, µm, in, inch, or the meters in one \
unit of the file, such as 0.0254.
    """
    known = UNITS["length"]
    if isinstance(unit, str) and unit in known:
        return known[unit]
    try:
        meters = nan if isinstance(unit, bool) else float(unit)
    except (TypeError, ValueError):
        meters = nan
    if not (isfinite(meters) and meters > 0):
        hint = get_close_matches(unit, known, n=1) if isinstance(unit, str) else []
        raise TurgorError(
            f"unit is {unit!r}{f'; did you mean {hint[0]!r}? Allowed' if hint else '; allowed'} is one of "
            f"{', '.join(known)}, or the meters in one unit of the file, such as 0.0254."
        )
    return meters


def unit_value(unit: str) -> float:
    """Return the value of a unit in SI; 1 for a pure number.

    Parameters
    ----------
    unit : str

    Returns
    -------
    float

    Examples
    --------
    >>> unit_value("kPa"), unit_value("")
    (1000.0, 1.0)
    """
    return next((units[unit] for units in UNITS.values() if unit in units), 1.0)


def plain_number(value: object) -> float:
    """Return a number as a float; a truth value is none.

    Raises
    ------
    TypeError, ValueError
        If it is no number.

    Examples
    --------
    >>> plain_number(2)
    2.0
    >>> plain_number(False)
    Traceback (most recent call last):
    TypeError: False is a truth value, not a number.
    """
    if type(value).__name__ in ("bool", "bool_"):  # NumPy has one of its own
        raise TypeError(f"{value} is a truth value, not a number.")
    return float(value)  # type: ignore[arg-type]


def parse_quantity(text: object, dimension: str) -> float:
    """Read a number with its unit, such as ``"1.5 mm"``, and return it in SI units.

    Parameters
    ----------
    text : str
        Number and unit; anything else is refused with a sentence that says what is needed.
    dimension : str
        What is needed: one of the keys of `UNITS`, such as ``"length"`` or ``"pressure"``.

    Returns
    -------
    float
        The value in the SI unit of the dimension.

    Raises
    ------
    TurgorError
        If the text is no finite number followed by a unit of this dimension.

    Examples
    --------
    >>> parse_quantity("60 kPa", "pressure")
    60000.0
    >>> parse_quantity("20 °C", "temperature")
    293.15
    >>> parse_quantity("60 kP", "pressure")
    Traceback (most recent call last):
    turgor.TurgorError: unknown unit 'kP' in '60 kP'; did you mean 'kPa'? Known pressure units: Pa, kPa, ...
    """
    units = UNITS[dimension]
    if isinstance(text, bool) or not isinstance(text, str | int | float):
        raise TurgorError(
            f"{_shown(text)} is not {_one(dimension)}; write a number with its unit, {_example(dimension)}."
        )
    if not isinstance(text, str):
        raise TurgorError(f"{text} needs a unit, {_example(dimension)}. {_known(dimension)}")
    match = _NUMBER_AND_UNIT.fullmatch(text.translate(_SAME_SIGN).strip())
    if match is None:
        raise TurgorError(f"'{text}' is not {_one(dimension)}; write a number with its unit, {_example(dimension)}.")
    number, unit = float(match[1]), match[2]
    if re.match(r",\d", unit):
        raise TurgorError(f"'{text}' has a decimal comma; write a point, {_example(dimension)}.")
    if not unit:
        raise TurgorError(f"'{text}' needs a unit, {_example(dimension)}. {_known(dimension)}")
    if unit not in units:
        raise _wrong_unit(text, unit, dimension)
    value = number * units[unit] + _ZERO.get(unit, 0.0)
    if not isfinite(value):
        raise TurgorError(f"'{text}' is too large; a finite {dimension} is needed.")
    return value


def format_quantity(value: float, unit: str) -> str:
    """Write an SI value in a unit, so that `parse_quantity` returns exactly the same float.

    Where no decimal number in this unit gives the same float, the SI unit of the dimension is used instead.

    Parameters
    ----------
    value : float
        The value in SI units.
    unit : str
        A unit from `UNITS`, such as ``"mm"``.

    Returns
    -------
    str
        The shortest number that reads back exactly, and the unit.

    Examples
    --------
    >>> format_quantity(0.0015, "mm")
    '1.5 mm'
    """
    units, zero = next(units for units in UNITS.values() if unit in units), _ZERO.get(unit, 0.0)
    for digits in range(1, 18):
        number = float(f"{(value - zero) / units[unit]:.{digits}g}")
        if number * units[unit] + zero == value:
            return f"{number!r}".removesuffix(".0") + f" {unit}"
    return f"{value!r} {next(iter(units))}"


def split_quantity(text: str) -> tuple[float, str] | None:
    """Split a number and its unit, whatever it measures.

    Parameters
    ----------
    text : str

    Returns
    -------
    (float, str) or None
        The number as it stands there, and its unit; None where the text is no number with a known unit.

    Examples
    --------
    >>> split_quantity("0.12 MPa"), split_quantity("cavity")
    ((0.12, 'MPa'), None)
    """
    match = _NUMBER_AND_UNIT.fullmatch(text.translate(_SAME_SIGN).strip())
    if match is None or not any(match[2] in units for units in UNITS.values()):
        return None
    return float(match[1]), match[2]


def _wrong_unit(text: str, unit: str, dimension: str) -> TurgorError:
    for other, units in UNITS.items():
        if unit in units:
            return TurgorError(f"'{text}' is {_one(other)}, but {_one(dimension)} is needed. {_known(dimension)}")
    units = UNITS[dimension]
    same = [known for known in units if known.lower() == unit.lower()]
    near = same or get_close_matches(unit, units, n=1)
    hint = f"; did you mean '{near[0]}'?" if near else "."
    return TurgorError(f"unknown unit '{unit}' in '{text}'{hint} {_known(dimension)}")


def _one(dimension: str) -> str:
    return f"{'an' if dimension[0] in 'aeiou' else 'a'} {dimension}"


def _known(dimension: str) -> str:
    return f"Known {dimension} units: {', '.join(UNITS[dimension])}."


def _example(dimension: str) -> str:
    return f"for example '{EXAMPLES[dimension]}'"


def _shown(value: object) -> str:
    return {True: "true", False: "false"}[value] if isinstance(value, bool) else repr(value)

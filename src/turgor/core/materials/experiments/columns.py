"""Columns of a table from a testing machine: role, unit and stress measure."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from turgor.foundation.errors import TurgorError, unknown
from turgor.units import UNITS

#: Factor to SI of each unit, as testing machines write the unit, by dimension.
FACTORS: Mapping[str, Mapping[str, float]] = {
    "force": UNITS["force"],
    "length": UNITS["length"],
    "stress": {**UNITS["pressure"], "N/mm^2": 1e6, "N/m²": 1.0, "kgf/cm²": 98066.5},
    "time": {"s": 1.0, "sec": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
    "ratio": {"-": 1.0, "": 1.0, "1": 1.0, "%": 0.01, "mm/mm": 1.0, "m/m": 1.0},
}

#: Unit of each dimension that messages give as an example.
_EXAMPLES: Mapping[str, str] = {"force": "N", "length": "mm", "stress": "MPa", "time": "s"}

#: Dimension of each role.
DIMENSIONS: Mapping[str, str] = {
    "time": "time",
    "stretch": "ratio",
    "stretch_2": "ratio",
    "nominal_strain": "ratio",
    "true_strain": "ratio",
    "shear": "ratio",
    "length": "length",
    "extension": "length",
    "force": "force",
    "nominal_stress": "stress",
    "nominal_stress_2": "stress",
    "cauchy_stress": "stress",
    "cauchy_stress_2": "stress",
    "cauchy_difference": "stress",
    "stress": "stress",
    "stress_2": "stress",
}

#: Roles of columns that hold words: batch, name of a specimen, and the axis along which the stress of a row acts.
WORDS = ("batch", "specimen", "component")

#: Patterns and roles. The first pattern that matches the name, in lower case and without its unit, gives the role.
_PATTERNS: tuple[tuple[str, str], ...] = (
    (r"^(test |elapsed |total )?time$|^t$|^(prüf|mess|versuchs)?zeit$", "time"),
    (r"time|cycle|resistance|temperatur|width|thickness|area|speed|load factor", ""),
    (r"zeit|zyklus|breite|dicke|fläche|geschwindigkeit", ""),
    (r"batch|\blot\b", "batch"),
    (r"specimen|sample|replicate|^id$|probe", "specimen"),
    (r"^(stress )?(component|direction|axis)$", "component"),
    (r"cauchy.*difference|difference.*cauchy|stress difference", "cauchy_difference"),
    (r"(engineering|nominal|^eng\.?|piola|pk1).*stress.*(?<!\d)2$", "nominal_stress_2"),
    (r"(engineering|nominal|^eng\.?|piola|pk1).*stress", "nominal_stress"),
    (r"(nenn|technische |ingenieur).*spannung", "nominal_stress"),
    (r"(true|cauchy).*stress.*(?<!\d)2$", "cauchy_stress_2"),
    (r"(true|cauchy).*stress|wahre.*spannung", "cauchy_stress"),
    (r"(stress|spannung|sigma|σ).*(?<!\d)2$", "stress_2"),
    (r"stress|spannung|sigma|σ", "stress"),
    (r"(true|log\w*|hencky).*strain", "true_strain"),
    (r"shear.*(strain|amount)|amount.*shear|gamma|γ", "shear"),
    (r"strain|dehnung|elongation at", "nominal_strain"),
    (r"(stretch|lambda|λ).*(?<!\d)2( \(?(fixed|held|constant)\)?)?$", "stretch_2"),
    (r"^(fixed|held|constant|transverse|lateral) (stretch|lambda|λ)$", "stretch_2"),
    (r"stretch|lambda|λ", "stretch"),
    (r"extension|displacement|elongation|crosshead|travel|weg", "extension"),
    (r"length|grip|distance", "length"),
    (r"force|load|kraft", "force"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """A column of a table, with its role and unit.

    Parameters
    ----------
    index : int
        Index in the table, from 0.
    name : str
        Name as written in the file.
    role : str
        A key of `DIMENSIONS`, or one of `WORDS`.
    factor : float
        Factor from its numbers to SI.
    """

    index: int
    name: str
    role: str
    factor: float


def find_columns(names: Sequence[str], roles: Mapping[str, str], file: str) -> tuple[Column, ...]:
    """Return the role and unit of every column that is needed.

    Parameters
    ----------
    names : sequence of str
        Names of the columns with their units, such as ``"Force (N)"`` or ``"grip_length_mm"``.
    roles : mapping of str to str
        Roles that the user stated, with the name of their column; they take precedence.
    file : str
        Name of the file, for messages.

    Examples
    --------
    >>> [(c.role, c.factor) for c in find_columns(["Time (s)", "True Strain", "grip_length_mm"], {}, "a.csv")]
    [('time', 1.0), ('true_strain', 1.0), ('length', 0.001)]
    """
    stated = {}
    for role, name in roles.items():
        if role not in (*DIMENSIONS, *WORDS):
            raise unknown("role of a column", role, (*DIMENSIONS, *WORDS))
        if name not in names:
            raise TurgorError(f"'{file}': {unknown('column', name, [each for each in names if each])}")
        stated[names.index(name)] = role
    columns = []
    for index, name in enumerate(names):
        text, unit = split_unit(name)
        role = stated.get(index, role_of(text))
        if role == "batch" and role in roles and index not in stated:
            role = "specimen"  # another column tells the batches; this one still tells specimens apart
        if role in WORDS:
            columns.append(Column(index=index, name=name, role=role, factor=1.0))
        elif role == "time" and unit not in FACTORS["time"] and index not in stated:
            continue  # a clock or a counter; what needs a time raises its own error
        elif role:
            columns.append(
                Column(index=index, name=name, role=role, factor=_factor(name, unit, DIMENSIONS[role], file))
            )
    return tuple(columns)


def split_unit(name: str) -> tuple[str, str | None]:
    """Split the name of a column into its words and its unit; the unit is None where the name states none.

    Examples
    --------
    >>> split_unit("Engineering Stress (MPa)"), split_unit("force_N"), split_unit("stretch_-"), split_unit("Strain")
    (('Engineering Stress', 'MPa'), ('force', 'N'), ('stretch', '-'), ('Strain', None))
    """
    bracket = re.fullmatch(r"(.*?)\s*[(\[]([^)\]]*)[)\]]\s*", name)
    if bracket and bracket[2].strip().lower() in ("fixed", "held", "constant"):
        return name, None
    if bracket:
        return bracket[1], bracket[2].strip()
    last = re.search(r"[_ ,]([^_ ,]+)$", name)
    if last and any(last[1] in units for units in FACTORS.values()) and last[1] != "1":
        return name[: last.start()].rstrip("_ ,"), last[1]
    return name, None


def role_of(name: str) -> str:
    """Return the role that the words of a column's name give, without its unit; empty where they give none.

    Examples
    --------
    >>> role_of("Engineering Stress"), role_of("sample"), role_of("humidity")
    ('nominal_stress', 'specimen', '')
    """
    words = re.sub(r"[_\s]+", " ", name).strip().lower()
    return next((role for pattern, role in _PATTERNS if re.search(pattern, words)), "")


def _factor(name: str, unit: str | None, dimension: str, file: str) -> float:
    units = FACTORS[dimension]
    if unit is None and dimension != "ratio":
        known = ", ".join(each for each in units if each)
        raise TurgorError(
            f"'{file}': column '{name}' states no unit; write it into the header, for example "
            f"'{name} ({_EXAMPLES[dimension]})'. Known: {known}."
        )
    if unit is not None and unit not in units:
        raise TurgorError(f"'{file}', column '{name}': {unknown(f'unit of a {dimension}', unit, filter(None, units))}")
    return units[unit or ""]

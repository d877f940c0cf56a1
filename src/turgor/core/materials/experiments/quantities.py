"""Quantities of a table: which columns give stretch and nominal stress, and how they are converted."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.experiments.columns import Column, split_unit
from turgor.core.materials.experiments.header_sizes import Sizes
from turgor.core.materials.experiments.settings import EXPERIMENTS
from turgor.foundation.errors import TurgorError

Array: TypeAlias = NDArray[np.float64]
Columns: TypeAlias = Mapping[str, Column]


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """A stretch or a stress of a table.

    Parameters
    ----------
    role : str
        Role of the column that gives it.
    text : str
        Description of the conversion.
    convert : callable
        ``convert(values, stretch)`` makes a stretch or a nominal stress from the values of the column in SI; the
        argument ``stretch`` is None if the result is a stretch.
    """

    role: str
    text: str
    convert: Callable[[Array, Array | None], Array]


def stretch_quantity(file: str, columns: Columns, mode: str, sizes: Callable[[], Sizes]) -> Quantity:
    """Find the column that gives the stretch or the amount of shear, and its conversion.

    Parameters
    ----------
    file : str
        Name of the file, for messages.
    columns : mapping of str to Column
        Columns by role.
    mode : str
        Mode of the test.
    sizes : callable
        ``sizes()`` gives the dimensions of the specimen; it is called only where they are needed.
    """
    if mode == "simple_shear":
        for role in ("shear", "nominal_strain", "true_strain"):
            if role in columns:
                return Quantity(role=role, text=f"amount of shear from '{columns[role].name}'", convert=_as_it_is)
        raise TurgorError(f"'{file}' has no column of the amount of shear; name it with columns={{'shear': ...}}.")
    if "stretch" in columns:
        return Quantity(role="stretch", text=f"stretch from '{columns['stretch'].name}'", convert=_as_it_is)
    if "nominal_strain" in columns:
        text = f"stretch = 1 + '{columns['nominal_strain'].name}'"
        return Quantity(
            role="nominal_strain", text=text, convert=partial(_from_strain, file, columns["nominal_strain"])
        )
    if "true_strain" in columns:
        text = f"stretch = exp('{columns['true_strain'].name}')"
        return Quantity(role="true_strain", text=text, convert=_exponential)
    return _from_length(file, columns, sizes)


def stress_quantity(
    file: str, columns: Columns, mode: str, sizes: Callable[[], Sizes], measure: str | None
) -> Quantity:
    """Find the column that gives the nominal stress, for a biaxial test along the first axis, and its conversion.

    Parameters
    ----------
    file, columns, mode, sizes
        See `stretch_quantity`.
    measure : str or None
        ``"nominal"`` or ``"cauchy"``, where the file does not say.
    """
    if "cauchy_difference" in columns:
        if mode != "biaxial":
            raise TurgorError(f"'{file}' holds a difference of Cauchy stresses, which belongs to mode 'biaxial' only.")
        text = "difference of Cauchy stresses over the stretch"
        return Quantity(role="cauchy_difference", text=text, convert=_over_stretch)
    for role in (f"{measure}_stress",) if measure else ("nominal_stress", "cauchy_stress"):
        if role in columns:
            return _of_measure(role, role.removesuffix("_stress"), columns, mode)
    if "force" in columns and "stress" not in columns:
        return _from_force(file, columns, sizes)
    if "stress" not in columns:
        names = ", ".join(f"'{column.name}'" for column in columns.values())
        raise TurgorError(f"'{file}' has no such column of stress or force (found: {names}); name it in the header.")
    if measure is None:
        raise TurgorError(
            f"'{file}': is '{columns['stress'].name}' force per initial area or force per current area?",
            python='Answer with stress_measure="nominal" or stress_measure="cauchy".',
            command="Answer with --stress nominal or --stress cauchy.",
        )
    return _of_measure("stress", measure, columns, mode)


def second_stress(file: str, columns: Columns, measure: str | None, first: Quantity) -> Quantity | None:
    """Find the stress along the second axis of a biaxial test, of the same measure as the first; None if there is none.

    Parameters
    ----------
    file, columns, measure
        See `stress_quantity`.
    first : Quantity
        Stress along the first axis.
    """
    role = f"{first.role}_2"
    if role in columns:
        of_second = {first.role: columns[role]}
        other = _of_measure(first.role, measure or first.role.removesuffix("_stress"), of_second, "biaxial")
        return Quantity(role=role, text=other.text, convert=other.convert)
    others = [column.name for key, column in columns.items() if key.endswith("stress_2")]
    if others and first.role != "cauchy_difference":
        raise TurgorError(
            f"'{file}': '{columns[first.role].name}' and '{others[0]}' do not say that they are the same measure of "
            "stress; name both alike, for example 'nominal stress 1 (MPa)' and 'nominal stress 2 (MPa)'."
        )
    return None


def crosshead_quantity(columns: Columns, along: str, length: float) -> Quantity | None:
    """Return the stretch by the crosshead of a table whose stretch comes from another column; None if there is none.

    Parameters
    ----------
    columns : mapping of str to Column
        Columns by role.
    along : str
        Role of the column that gives the stretch.
    length : float [m]
        Initial length of the specimen.
    """
    role = next((each for each in ("extension", "length") if each in columns and each != along), None)
    if role is None or along in ("extension", "length"):
        return None
    ahead = length if role == "extension" else 0.0
    return Quantity(role=role, text="", convert=lambda values, _: (values + ahead) / length)


def _from_length(file: str, columns: Columns, sizes: Callable[[], Sizes]) -> Quantity:
    role = "length" if "length" in columns else "extension"
    if role not in columns:
        names = ", ".join(f"'{column.name}'" for column in columns.values()) or "none that is known"
        raise TurgorError(
            f"'{file}' has no column of stretch, strain, length or extension (found: {names}).",
            python="Name it with columns={'stretch': ...}.",
            command="Name it so in the header, such as 'stretch'.",
        )
    stated = sizes()
    initial = stated.length
    if initial is None:
        raise TurgorError(
            f"'{file}' holds {role}s{_known(stated)}, and their initial length is not stated.",
            **_given("# Length = 33 mm"),
        )
    ahead = initial if role == "extension" else 0.0
    text = f"'{columns[role].name}' with an initial length of {initial * 1e3:g} mm{_origin(stated, 'length')}"
    return Quantity(role=role, text=text, convert=lambda values, _: (values + ahead) / initial)


def _from_force(file: str, columns: Columns, sizes: Callable[[], Sizes]) -> Quantity:
    stated = sizes()
    section = stated.section
    if section is None:
        raise TurgorError(
            f"'{file}' holds forces{_known(stated)}, and the section of the specimen is not stated.",
            **_given("# Cross-section = 18 mm²"),
        )
    text = f"force over an area of {section * 1e6:g} mm²{_origin(stated, 'area', 'width', 'thickness')}"
    return Quantity(role="force", text=text, convert=lambda values, _: values / section)


def _known(stated: Sizes) -> str:
    words = _words(stated.header.values())
    return f", and its header states only {words}" if words else ""


def _origin(stated: Sizes, *dimensions: str) -> str:
    words = _words(stated.header[name] for name in dimensions if name in stated.header)
    return f" (header: {words})" if words else ""


def _words(texts: Iterable[str]) -> str:
    return ", ".join(f"'{text}'" for text in texts)


def _of_measure(role: str, measure: str, columns: Columns, mode: str) -> Quantity:
    name = columns[role].name
    if measure == "nominal":
        return Quantity(role=role, text=f"nominal stress from '{name}'", convert=_as_it_is)
    convert = _as_it_is if mode == "simple_shear" else _over_stretch
    return Quantity(role=role, text=f"nominal stress = Cauchy stress '{name}' / stretch", convert=convert)


def _from_strain(file: str, column: Column, strain: Array, _: Array | None) -> Array:
    """Stretch of a nominal strain, which may be percent where its column says nothing."""
    most = float(np.abs(strain).max())
    if split_unit(column.name)[1] is None and most > EXPERIMENTS.plain_strain:
        raise TurgorError(
            f"'{file}': column '{column.name}' states no unit and goes to {most:g}, which would be a stretch of "
            f"{1 + most:g}; if it is percent, write '{column.name} (%)' into the header, else '{column.name} (-)'."
        )
    return np.asarray(1 + strain)


def _as_it_is(values: Array, stretch: Array | None) -> Array:
    return values


def _over_stretch(values: Array, stretch: Array | None) -> Array:
    assert stretch is not None
    if not (stretch > 0).all():
        return values  # MaterialTest raises an error that names the point
    return np.asarray(values / stretch)


def _exponential(strain: Array, stretch: Array | None) -> Array:
    with np.errstate(over="ignore"):
        return np.asarray(np.exp(strain))  # MaterialTest raises an error for infinity


def _given(line: str) -> dict[str, str]:
    """How the dimensions of a specimen are given, in Python and on the command line."""
    give, or_write = "Give the dimensions of the specimen,", f"or write '{line}' above the names of the columns."
    return {
        "python": f"{give} such as specimen=Specimen(length=33*mm, width=6*mm, thickness=3*mm), {or_write}",
        "command": f'{give} such as --specimen "33 mm, 6 mm, 3 mm", {or_write}',
    }

"""Files of fitted materials: records in the form of the library, for jobs and scripts."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from types import MappingProxyType
from typing import Any

import tomlkit

from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.fitting.uncertainty import scatter
from turgor.core.materials.laws.conventions import has_no_unit, law_from_printed, saved_convention
from turgor.core.materials.laws.laws import LAWS
from turgor.core.materials.library.fit_spread import FitSpread
from turgor.core.materials.library.record_history import history_tables
from turgor.core.materials.material import Material
from turgor.core.materials.orientation import orientation_table
from turgor.foundation.errors import TurgorError
from turgor.foundation.registry import name_in
from turgor.units import format_quantity

#: Law and convention in files for a law with coefficients Cij but without a form of its own, such as Yeoh of 4 terms.
_POLYNOMIAL = ("generalized_rivlin", "two_index")


def can_be_saved(fit: Fit) -> bool:
    """Return whether files of records have a form for the law of a fit.

    Parameters
    ----------
    fit : Fit
        The fit.
    """
    return _form(fit) is not None


def records_toml(name: str, fits: Sequence[Fit], spreads: Mapping[str, FitSpread] = MappingProxyType({})) -> str:
    """Write fits as the text of a file of records; reading it returns exactly the same laws.

    Parameters
    ----------
    name : str
        Name of the material.
    fits : sequence of Fit
        One or more, each of another law.
    spreads : mapping of str to FitSpread
        Spread of the constants by law, where it is not the scatter about the curves; see `spread_between`.
    """
    document = tomlkit.document()
    document.add(tomlkit.comment("Fitted by turgor; moduli with their units, exponents without."))
    document["name"] = name
    document["kind"] = "rubber"
    records = tomlkit.table(is_super_table=True)
    for fit in fits:
        records[fit.spec.name] = _record(fit, spreads.get(fit.spec.name) or scatter(fit))
    document["records"] = records
    return tomlkit.dumps(document)


def save_fits(
    path: str | Path, name: str, fits: Sequence[Fit], spreads: Mapping[str, FitSpread] = MappingProxyType({})
) -> None:
    """Write fits into a file of records; ``from_library`` reads a record by the path and the name of the law.

    Parameters
    ----------
    path : str or Path
        A file ending in ``.toml``.
    name : str
        Name of the material.
    fits : sequence of Fit
        One or more, each of another law.
    spreads : mapping of str to FitSpread
        Spread of the constants by law, where it is not the scatter about the curves; see `spread_between`.
    """
    if Path(path).suffix != ".toml":
        raise TurgorError(f"'{path}' does not end in .toml, the form in which materials are saved.")
    Path(path).write_text(records_toml(name, fits, spreads), encoding="utf-8")


def save_material(path: str | Path, material: Material, record: str = "fitted") -> None:
    """Write a material with viscoelasticity and softening into a file of records; ``from_library`` reads it back.

    Parameters
    ----------
    path : str or Path
        A file ending in ``.toml``.
    material : Material
        A rubber, such as the material of a `HistoryFit`.
    record : str
        Name of its record.

    Raises
    ------
    TurgorError
        If the file has another suffix, or files of records have no form for the law.
    """
    if Path(path).suffix != ".toml":
        raise TurgorError(f"'{path}' does not end in .toml, the form in which materials are saved.")
    Path(path).write_text(material_toml(material, record), encoding="utf-8")


def material_toml(material: Material, record: str = "fitted") -> str:
    """Write a material as the text of a file of records; reading it returns the same law, series and softening.

    Parameters
    ----------
    material : Material
        A rubber.
    record : str
        Name of its record.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> from turgor.foundation.source import Source
    >>> rubber = Material(name="ours", law=NeoHooke(C10=1.2e5), source=Source(text="our tests"))
    >>> print(material_toml(rubber).split("[records.fitted]")[1].strip())
    law = "neo_hooke"
    parameters = {C10 = "120 kPa"}
    convention = "two_index"
    source = "our tests"
    """
    records = tomlkit.table(is_super_table=True)
    records[record] = _entry(material)
    document = tomlkit.document()
    document["name"] = material.name
    if material.density is not None:
        document["density"] = format_quantity(material.density, "kg/m³")
    document["records"] = records
    return tomlkit.dumps(document)


def job_table(material: Material) -> dict[str, Any]:
    """Return the table of a job that states a material with directions, which files of records have no form for.

    Parameters
    ----------
    material : Material
        With a law of plain constants and an orientation.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Orthotropic
    >>> from turgor.core.materials.orientation import Orientation
    >>> lies = Orientation(along=(1, 0, 0), across=(0, 1, 0))
    >>> job_table(Material(name="a print", law=Orthotropic(C10=1e6, a1=4e5), orientation=lies))["a1"]
    '400 kPa'
    """
    values: dict[str, Any] = {"law": name_in(LAWS, material.law)}
    for symbol, value in _symbols(material.law):
        values[symbol] = value if has_no_unit(symbol) else format_quantity(float(f"{value:.6g}"), "kPa")
    if material.orientation is not None:
        values["orientation"] = orientation_table(material.orientation)
    return values


def _entry(material: Material) -> tomlkit.items.Table:
    """Record of a material, as a table."""
    name = name_in(LAWS, material.law)
    convention = None if name in (None, "hooke", "woven") else saved_convention(name)
    if name is None or convention is None:
        raise TurgorError(f"files of records have no form for the law {type(material.law).__name__}.")
    entry = tomlkit.table()
    entry["law"] = name
    parameters = tomlkit.inline_table()
    for symbol, value in _symbols(material.law):
        parameters[symbol] = value if has_no_unit(symbol) else format_quantity(value, "kPa")
    entry["parameters"] = parameters
    entry["convention"] = convention
    if not material.incompressible and not material.is_foam:
        entry["compressibility"] = {"bulk_modulus": format_quantity(material.bulk_modulus, "MPa")}
    if material.stretch_range is not None:
        entry["stretch_range"] = [round(edge, 6) for edge in material.stretch_range]
    entry["source"] = str(material.source)
    if material.source.doubts:
        entry["doubts"] = list(material.source.doubts)
    for key, table in history_tables(material).items():
        entry[key] = table
    return entry


def _symbols(law: Any) -> Iterator[tuple[str, float]]:
    """Coefficients of a law by their symbols in files."""
    for item in fields(law):
        value = getattr(law, item.name)
        if not isinstance(value, tuple):
            yield item.name, value
        elif isinstance(value[0], tuple):
            yield from ((f"C{i}{j}", number) for i, j, number in value)
        else:
            yield from ((f"{item.name}_{n}", number) for n, number in enumerate(value, 1))


def _record(fit: Fit, spread: FitSpread | None) -> tomlkit.items.Table:
    form = _form(fit)
    if form is None:
        raise TurgorError(f"files of records have no form for the law {fit.spec.name}; use its material directly.")
    law, convention = form
    entry = tomlkit.table()
    entry["law"] = law
    parameters = tomlkit.inline_table()
    for symbol, value in _printed(fit).items():
        parameters[symbol] = value if has_no_unit(symbol) else format_quantity(value, "kPa")
    entry["parameters"] = parameters
    entry["convention"] = convention
    entry["stretch_range"] = [round(edge, 6) for edge in fit.stretch_range]
    source = fit.material.source
    entry["source"] = str(source)
    if source.doubts:
        entry["doubts"] = list(source.doubts)
    if spread is not None:
        entry["spread"] = _spread_table(fit, spread)
    return entry


def _spread_table(fit: Fit, spread: FitSpread) -> tomlkit.items.Table:
    """Spread of the constants of a fit, with the symbols of its record."""
    # what a fit was given, such as the ratio of a foam, is printed last, and has no spread
    symbols = dict(zip(fit.values, _printed(fit), strict=False))
    deviations = tomlkit.inline_table()
    for key, value in spread.deviations.items():
        deviations[symbols[key]] = value if key in fit.spec.shapes else format_quantity(value, "kPa")
    entry = tomlkit.table()
    entry["of"] = spread.of
    entry["deviations"] = deviations
    entry["correlation"] = [list(row) for row in spread.correlation]
    return entry


def _printed(fit: Fit) -> dict[str, float]:
    """Parameters by their symbols in files."""
    return dict(_symbols(fit.law)) if hasattr(fit.law, "to_abaqus") else dict(fit.values)


def _form(fit: Fit) -> tuple[str, str] | None:
    """Name of the law of a fit in files and the convention of its symbols; None where it cannot be written."""
    name = name_in(LAWS, fit.law)
    own = (name or "", saved_convention(name or "") or "")
    for law, convention in (own, _POLYNOMIAL):
        try:
            law_from_printed(law, convention, _printed(fit))
        except (TurgorError, TypeError):
            continue
        return law, convention
    return None

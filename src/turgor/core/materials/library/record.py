"""Record: one published set of constants as printed, and how it is read from the table of a file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf, isfinite
from typing import Any

from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.conventions import describe, has_no_unit, law_from_printed
from turgor.core.materials.laws.laws import LAWS, Hooke, Law
from turgor.core.materials.laws.names import spelled
from turgor.core.materials.library.fit_spread import FitSpread, read_fit_spread
from turgor.core.materials.library.fitted_tests import FittedTests, read_fitted
from turgor.core.materials.library.record_history import read_stress_softening, read_viscoelasticity
from turgor.core.materials.library.supplier import Supplier
from turgor.core.materials.library.table_keys import table
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import parse_quantity

REVIEW = (
    "M. S. Xavier, A. J. Fleming, Y. K. Yong, Finite Element Modeling of Soft Fluidic Actuators: "
    "Overview and Recent Developments, Adv. Intell. Syst. 2021, 3, 2000187"
)

#: What a library file describes: a rubber is checked as one, the others are stiff parts.
KINDS = ("rubber", "fiber", "sheet", "composite")

#: What a sheet is modeled as; "combined" constants are those of the rubber below it and the sheet together.
FORMS = ("shell", "membrane", "combined")

FILE_KEYS = ("name", "kind", "shore_hardness", "density", "supplier", "recommended", "records")
RECORD_KEYS = (
    *("law", "parameters", "convention", "convention_reason", "assumed", "compressibility", "stretch_range"),
    *("viscoelasticity", "stress_softening", "form", "bending_stiffness", "fitted", "spread"),
    *("density", "diameter", "software", "source", "cited_by", "references", "quoted_in", "printed_name", "doubts"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One published set of constants of a library material, as printed.

    Parameters
    ----------
    library : str
        Name of the material in the library, or the path of the file.
    name : str
        Name of the record within its material.
    material_name : str
        What the material is called.
    kind : str
        One of `KINDS`.
    law, convention : str
        Law, and what its printed symbols mean; see `turgor.core.materials.laws.conventions`.
    printed : str
        The constants as printed in the source, such as ``"C1 = 0.11 MPa, C2 = 0.02 MPa"``.
    constants : mapping of str to float
        The same by symbol, in SI units.
    source : str
        Full reference of the publication.
    assumed : mapping of str to float
        Constants that the source leaves out and the library adds.
    convention_reason : str
        Why this convention, where the source does not state it.
    bulk_modulus : float [Pa]
        Initial bulk modulus, 2 / D1 where D1 is printed; infinite otherwise.
    stretch_range : (float, float) or None [-]
        Smallest and largest stretch of the tests behind the fit, when known.
    density : float or None [kg/m³]
        Mass per reference volume.
    diameter : float or None [m]
        Diameter of a fiber.
    shore_hardness : str
        Hardness with its scale, such as ``"28 A"`` or ``"00-30"``.
    software : str or None
        Program that the source used the constants in, when stated.
    cited_by : tuple of str
        Further publications that use the same constants.
    references : tuple of int
        Numbers of source and further publications in the reference list of Xavier, Fleming and Yong 2021.
    quoted_in : str
        Table of that paper that prints the record.
    supplier : Supplier or None
        What the maker states about the material.
    stated_doubts : tuple of str
        Doubts about the constants written in the file, besides those that `turgor.core.materials.library.doubts`
        computes.
    density_doubts : tuple of str
        Doubts about the density written in the file.
    viscoelasticity : Prony or None
        How the rubber relaxes, when known.
    stress_softening : Mullins or None
        How it softens, when known.
    form : str
        One of `FORMS`, what jobs model a sheet of it as by default; empty where it is no sheet.
    bending_stiffness : float or None [N m]
        Of a sheet that bends more easily than a plate of its thickness, such as a woven fabric.
    fitted : FittedTests or None
        Tests of the library that turgor has fitted it to; None for a published set of constants.
    spread : FitSpread or None
        How far the constants are off, where the fit says so.
    recommended : str
        Why it is the one of its material to take; empty for the others.
    """

    library: str
    name: str
    material_name: str
    kind: str
    law: str
    convention: str
    printed: str
    constants: Mapping[str, float]
    source: str
    assumed: Mapping[str, float] = field(default_factory=dict)
    convention_reason: str = ""
    bulk_modulus: float = inf
    stretch_range: tuple[float, float] | None = None
    density: float | None = None
    diameter: float | None = None
    shore_hardness: str = ""
    software: str | None = None
    cited_by: tuple[str, ...] = ()
    references: tuple[int, ...] = ()
    quoted_in: str = ""
    supplier: Supplier | None = None
    stated_doubts: tuple[str, ...] = ()
    density_doubts: tuple[str, ...] = ()
    viscoelasticity: Prony | None = None
    stress_softening: Mullins | None = None
    form: str = ""
    bending_stiffness: float | None = None
    fitted: FittedTests | None = None
    spread: FitSpread | None = None
    recommended: str = ""

    def build_law(self) -> Law | Hooke:
        """Return the law in canonical coefficients; raises TurgorError where none can exist."""
        return law_from_printed(self.law, self.convention, {**self.constants, **self.assumed})

    @property
    def canonical(self) -> str:
        """The constants in the form that turgor computes with, such as ``"C10 = 0.11 MPa, C20 = 0.02 MPa"``."""
        return describe(self.build_law())


def read_record(content: Mapping[str, Any], library: str, name: str, references: Mapping[int, str]) -> Record:
    """Read one record from the content of a library file.

    Parameters
    ----------
    content : mapping
        The parsed TOML.
    library : str
        Name of the material or path of its file, for messages.
    name : str
        Key of the record below ``[records]``.
    references : mapping of int to str
        Texts of numbered references.

    Returns
    -------
    Record

    Raises
    ------
    TurgorError
        If a key is unknown, missing or holds what it cannot hold; the message names file and key.
    """
    where = f"{library}: records.{name}"
    entry = table(content["records"][name], where, RECORD_KEYS, ("law", "parameters", "convention"))
    numbers = _reference_numbers(entry, where, references)
    texts = (*(references[n] for n in numbers), *_texts(entry, "cited_by", where))
    if "source" in entry:
        texts = (_text(entry, "source", where), *texts)
    if not texts:
        raise TurgorError(f"{where}: 'source' is missing; say where the constants came from.")
    parameters = table(entry["parameters"], f"{where}.parameters")
    density = _density(entry.get("density", content.get("density")), where)
    return Record(
        library=library,
        name=name,
        material_name=_text(content, "name", library),
        kind=_kind(content, library),
        law=spelled(_text(entry, "law", where), LAWS) or entry["law"],
        convention=_text(entry, "convention", where),
        printed=", ".join(f"{symbol} = {value}" for symbol, value in parameters.items()),
        constants={symbol: _constant(value, symbol, where) for symbol, value in parameters.items()},
        source=texts[0],
        assumed={symbol: _constant(value, symbol, where) for symbol, value in entry.get("assumed", {}).items()},
        convention_reason=_text(entry, "convention_reason", where) if "convention_reason" in entry else "",
        bulk_modulus=_bulk_modulus(entry.get("compressibility"), where),
        stretch_range=_stretch_range(entry.get("stretch_range"), where),
        density=density[0],
        diameter=_optional(entry, "diameter", "length", where),
        shore_hardness=_text(content, "shore_hardness", library) if "shore_hardness" in content else "",
        software=entry.get("software"),
        cited_by=texts[1:],
        references=numbers,
        quoted_in=entry.get("quoted_in", ""),
        supplier=_supplier(content.get("supplier"), f"{library}: supplier", references),
        stated_doubts=_texts(entry, "doubts", where),
        density_doubts=density[1],
        viscoelasticity=_part(entry, "viscoelasticity", where, read_viscoelasticity),
        stress_softening=_part(entry, "stress_softening", where, read_stress_softening),
        form=_form(entry, where),
        bending_stiffness=_optional(entry, "bending_stiffness", "bending stiffness", where),
        fitted=_part(entry, "fitted", where, read_fitted),
        spread=_part(entry, "spread", where, read_fit_spread),
        recommended=_recommended(content, name, library),
    )


def _reference_numbers(entry: Mapping[str, Any], where: str, known: Mapping[int, str]) -> tuple[int, ...]:
    numbers = entry.get("references", [])
    if not isinstance(numbers, list) or not all(type(each) is int and each in known for each in numbers):
        raise TurgorError(
            f"{where}: 'references' is {numbers!r}; a list of numbers of references is needed, such as [{min(known)}]; "
            "state other sources as 'source'."
        )
    return tuple(numbers)


def _part(entry: Mapping[str, Any], key: str, where: str, read: Any) -> Any:
    return read(entry[key], f"{where}.{key}") if key in entry else None


def _text(entry: Mapping[str, Any], key: str, where: str) -> str:
    value = entry.get(key)
    if not isinstance(value, str) or not value.strip():
        raise TurgorError(f"{where}: '{key}' is {value!r}; a text in quotes is needed.")
    return value


def _texts(entry: Mapping[str, Any], key: str, where: str) -> tuple[str, ...]:
    values = entry.get(key, [])
    if not isinstance(values, list) or not all(isinstance(value, str) for value in values):
        raise TurgorError(f"{where}: '{key}' is {values!r}; a list of texts is needed.")
    return tuple(values)


def _kind(content: Mapping[str, Any], library: str) -> str:
    kind = content.get("kind", "rubber")
    if kind not in KINDS:
        raise TurgorError(f"{library}: kind is {kind!r}; allowed is {', '.join(KINDS)}.")
    return str(kind)


def _recommended(content: Mapping[str, Any], name: str, library: str) -> str:
    """Why a record is the recommended one of its file; empty for another."""
    if "recommended" not in content:
        return ""
    given = table(content["recommended"], f"{library}: recommended", ("record", "why"), ("record", "why"))
    if given["record"] not in content["records"]:
        raise unknown(f"record in {library}: recommended", str(given["record"]), content["records"])
    return _text(given, "why", f"{library}: recommended") if given["record"] == name else ""


def _form(entry: Mapping[str, Any], where: str) -> str:
    form = entry.get("form", "")
    if form and form not in FORMS:
        raise TurgorError(f"{where}: form is {form!r}; allowed is {', '.join(FORMS)}.")
    return str(form)


def _optional(entry: Mapping[str, Any], key: str, dimension: str, where: str) -> float | None:
    return _quantity(entry[key], dimension, f"{where}.{key}") if key in entry else None


def _constant(value: object, symbol: str, where: str) -> float:
    """A modulus with its unit, or a plain number for an exponent and Poisson's ratio."""
    place = f"{where}.parameters.{symbol}"
    if not has_no_unit(symbol):
        return _quantity(value, "pressure", place)
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise TurgorError(f"{place}: {value!r} is not a number without a unit.")
    return float(value)


def _quantity(value: object, dimension: str, place: str) -> float:
    try:
        return parse_quantity(value, dimension)
    except TurgorError as error:
        raise TurgorError(f"{place}: {error}") from None


def _bulk_modulus(values: Any, where: str) -> float:
    """Abaqus's D1 [1/Pa] comes in as κ = 2 / D1; terms with D2 and D3 are zero in every record, so they add nothing."""
    if values is None:
        return inf
    place = f"{where}.compressibility"
    given = table(values, place, ("D1", "D2", "D3", "bulk_modulus"))
    if "bulk_modulus" in given:
        return _quantity(given["bulk_modulus"], "pressure", f"{place}.bulk_modulus")
    inverse = {key: _inverse_pressure(value, f"{place}.{key}") for key, value in given.items()}
    if inverse.get("D2") or inverse.get("D3"):
        raise TurgorError(f"{place}: D2 and D3 are not zero; only the term with D1 is known here.")
    if not inverse.get("D1", 0.0) > 0:
        raise TurgorError(f"{place}: D1 must be positive; leave compressibility out for an incompressible rubber.")
    return 2.0 / inverse["D1"]


def _inverse_pressure(value: object, place: str) -> float:
    number, _, unit = str(value).partition(" ")
    if not unit.endswith("^-1"):
        raise TurgorError(f"{place}: '{value}' needs a unit, for example '2.93 MPa^-1'.")
    one = _quantity(f"1 {unit.removesuffix('^-1')}", "pressure", place)
    try:
        return float(number) / one
    except ValueError:
        raise TurgorError(f"{place}: '{value}' is not a number with a unit.") from None


def _stretch_range(values: Any, where: str) -> tuple[float, float] | None:
    if values is None:
        return None
    fits = isinstance(values, list) and len(values) == 2 and all(isinstance(value, int | float) for value in values)
    if not fits or not 0 < values[0] <= 1 <= values[1]:
        raise TurgorError(f"{where}: stretch_range is {values!r}; [smallest, largest] with 1 between them is needed.")
    return float(values[0]), float(values[1])


def _density(values: Any, where: str) -> tuple[float | None, tuple[str, ...]]:
    if values is None:
        return None, ()
    if isinstance(values, str):
        values = {"value": values}
    place = f"{where}.density"
    given = table(values, place, ("value", "source", "doubts"), ("value",))
    return _quantity(given["value"], "density", place), _texts(given, "doubts", place)


def _supplier(values: Any, where: str, references: Mapping[int, str]) -> Supplier | None:
    if values is None:
        return None
    known = ("stress_at_stretch_2", "modulus", "source", "reference", "doubts")
    given = table(values, where, known)
    numbers = _reference_numbers(
        {"references": [given["reference"]] if "reference" in given else []}, where, references
    )
    source = references[numbers[0]] if numbers else _text(given, "source", where)
    stated = {
        key: _quantity(given[key], "pressure", f"{where}.{key}")
        for key in ("stress_at_stretch_2", "modulus")
        if key in given
    }
    return Supplier(source=source, doubts=_texts(given, "doubts", where), **stated)

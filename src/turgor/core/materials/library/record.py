"""Record: one published set of constants as printed, and how it is read from the table of a file."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from typing import Any

from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.conventions import describe, law_from_printed
from turgor.core.materials.laws.laws import LAWS, Hooke, Law
from turgor.core.materials.laws.names import spelled
from turgor.core.materials.library import record_values as read
from turgor.core.materials.library.fit_spread import FitSpread, read_fit_spread
from turgor.core.materials.library.fitted_tests import FittedTests, read_fitted
from turgor.core.materials.library.record_history import (
    read_permanent_set,
    read_stress_softening,
    read_viscoelasticity,
)
from turgor.core.materials.strength import Strength
from turgor.core.materials.table_keys import table
from turgor.foundation.errors import TurgorError, unknown

REVIEW = (
    "M. S. Xavier, A. J. Fleming, Y. K. Yong, Finite Element Modeling of Soft Fluidic Actuators: "
    "Overview and Recent Developments, Adv. Intell. Syst. 2021, 3, 2000187"
)

#: What a library file describes: a rubber is checked as one, the others are stiff parts.
KINDS = ("rubber", "fiber", "sheet", "composite")

#: What a sheet is modeled as; "combined" constants are those of the rubber below it and the sheet together.
FORMS = ("shell", "membrane", "combined")

FILE_KEYS = ("name", "kind", "shore_hardness", "density", "expansion", "supplier", "strength", "recommended", "records")
RECORD_KEYS = (
    *("law", "parameters", "convention", "convention_reason", "assumed", "compressibility", "stretch_range"),
    *("viscoelasticity", "stress_softening", "permanent_set", "form", "bending_stiffness", "fitted", "spread"),
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
    expansion : float or None [1/K]
        Linear thermal expansion.
    expansion_source : str
        Where it is stated.
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
    viscoelasticity : Prony, BergstromBoyce or None
        How the rubber relaxes, when known.
    stress_softening : Mullins or None
        How it softens, when known.
    permanent_set : PermanentSet or None
        How much longer the rubber stays after it was stretched.
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
    strength : Strength or None
        What the material bears until it breaks, when known.
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
    expansion: float | None = None
    expansion_source: str = ""
    diameter: float | None = None
    shore_hardness: str = ""
    software: str | None = None
    cited_by: tuple[str, ...] = ()
    references: tuple[int, ...] = ()
    quoted_in: str = ""
    supplier: read.Supplier | None = None
    stated_doubts: tuple[str, ...] = ()
    density_doubts: tuple[str, ...] = ()
    viscoelasticity: Prony | BergstromBoyce | None = None
    stress_softening: Mullins | None = None
    permanent_set: PermanentSet | None = None
    form: str = ""
    bending_stiffness: float | None = None
    fitted: FittedTests | None = None
    spread: FitSpread | None = None
    recommended: str = ""
    strength: Strength | None = None

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
    sources = (*(references[n] for n in numbers), *read.texts(entry, "cited_by", where))
    if "source" in entry:
        sources = (read.text(entry, "source", where), *sources)
    if not sources:
        raise TurgorError(f"{where}: 'source' is missing; say where the constants came from.")
    parameters = table(entry["parameters"], f"{where}.parameters")
    density = read.density(entry.get("density", content.get("density")), where)
    expansion = read.expansion(content.get("expansion"), library)
    return Record(
        library=library,
        name=name,
        material_name=read.text(content, "name", library),
        kind=_kind(content, library),
        law=spelled(read.text(entry, "law", where), LAWS) or entry["law"],
        convention=read.text(entry, "convention", where),
        printed=", ".join(f"{symbol} = {value}" for symbol, value in parameters.items()),
        constants={symbol: read.constant(value, symbol, where) for symbol, value in parameters.items()},
        source=sources[0],
        assumed={symbol: read.constant(value, symbol, where) for symbol, value in entry.get("assumed", {}).items()},
        convention_reason=read.text(entry, "convention_reason", where) if "convention_reason" in entry else "",
        bulk_modulus=read.bulk_modulus(entry.get("compressibility"), where),
        stretch_range=read.stretch_range(entry.get("stretch_range"), where),
        density=density[0],
        expansion=expansion[0],
        expansion_source=expansion[1],
        diameter=_optional(entry, "diameter", "length", where),
        shore_hardness=read.text(content, "shore_hardness", library) if "shore_hardness" in content else "",
        software=entry.get("software"),
        cited_by=sources[1:],
        references=numbers,
        quoted_in=entry.get("quoted_in", ""),
        supplier=_supplier(content.get("supplier"), f"{library}: supplier", references),
        stated_doubts=read.texts(entry, "doubts", where),
        density_doubts=density[1],
        viscoelasticity=_part(entry, "viscoelasticity", where, read_viscoelasticity),
        stress_softening=_part(entry, "stress_softening", where, read_stress_softening),
        permanent_set=_part(entry, "permanent_set", where, read_permanent_set),
        form=_form(entry, where),
        bending_stiffness=_optional(entry, "bending_stiffness", "bending stiffness", where),
        fitted=_part(entry, "fitted", where, read_fitted),
        spread=_part(entry, "spread", where, read_fit_spread),
        recommended=_recommended(content, name, library),
        strength=read.strength(content.get("strength"), f"{library}: strength"),
    )


def _reference_numbers(entry: Mapping[str, Any], where: str, known: Mapping[int, str]) -> tuple[int, ...]:
    numbers = entry.get("references", [])
    if not isinstance(numbers, list) or not all(type(each) is int and each in known for each in numbers):
        raise TurgorError(
            f"{where}: 'references' is {numbers!r}; a list of numbers of references is needed, such as [{min(known)}]; "
            "state other sources as 'source'."
        )
    return tuple(numbers)


def _part(entry: Mapping[str, Any], key: str, where: str, reader: Any) -> Any:
    return reader(entry[key], f"{where}.{key}") if key in entry else None


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
    if str(given["record"]) not in content["records"]:  # what is no text may be a list, which is no key
        raise unknown(f"record in {library}: recommended", str(given["record"]), content["records"])
    return read.text(given, "why", f"{library}: recommended") if given["record"] == name else ""


def _form(entry: Mapping[str, Any], where: str) -> str:
    form = entry.get("form", "")
    if form and form not in FORMS:
        raise TurgorError(f"{where}: form is {form!r}; allowed is {', '.join(FORMS)}.")
    return str(form)


def _optional(entry: Mapping[str, Any], key: str, dimension: str, where: str) -> float | None:
    return read.quantity(entry[key], dimension, f"{where}.{key}") if key in entry else None


def _supplier(values: Any, where: str, references: Mapping[int, str]) -> read.Supplier | None:
    if values is None:
        return None
    known = ("stress_at_stretch_2", "modulus", "mixing", "cure", "source", "reference", "doubts")
    given = table(values, where, known)
    numbers = _reference_numbers(
        {"references": [given["reference"]] if "reference" in given else []}, where, references
    )
    source = references[numbers[0]] if numbers else read.text(given, "source", where)
    stated = {
        key: read.quantity(given[key], "pressure", f"{where}.{key}")
        for key in ("stress_at_stretch_2", "modulus")
        if key in given
    }
    return read.Supplier(
        source=source,
        doubts=read.texts(given, "doubts", where),
        mixing=read.text(given, "mixing", where) if "mixing" in given else "",
        cure=read.text(given, "cure", where) if "cure" in given else "",
        **stated,
    )

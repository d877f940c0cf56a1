"""Library records: published constants as printed, read into materials in one canonical form.

Each file ``library/<name>.toml`` holds one rubber or sheet and every published set of constants for it, a *record*.
A record keeps the numbers as they were printed, with the convention that says what the printed symbols mean; the
conversion to the coefficients of `turgor.materials.laws` happens here, on load.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from importlib.resources import files
from typing import Any

from turgor.errors import TurgorError, near_match, unknown
from turgor.materials.laws import Hooke, Law, MooneyRivlin, NeoHooke, Yeoh
from turgor.materials.material import Material
from turgor.source import Source
from turgor.units import format_quantity, parse_quantity

#: Laws by the name that files use.
LAWS: Mapping[str, type[Any]] = {
    "neo_hooke": NeoHooke,
    "mooney_rivlin": MooneyRivlin,
    "yeoh": Yeoh,
    "hooke": Hooke,
}

#: Parameters that carry no unit; all others are pressures.
DIMENSIONLESS = frozenset({"nu"})

#: What printed symbols mean: for each convention and law, canonical coefficient = factor × printed symbol.
#: "C2" is the second coefficient of I₁ in Yeoh's law and the one of I₂ in Mooney and Rivlin's.
CONVENTIONS: Mapping[str, Mapping[str, Mapping[str, tuple[str, float]]]] = {
    "single_index": {
        "neo_hooke": {"C1": ("C10", 1.0)},
        "mooney_rivlin": {"C1": ("C10", 1.0), "C2": ("C01", 1.0)},
        "yeoh": {"C1": ("C10", 1.0), "C2": ("C20", 1.0), "C3": ("C30", 1.0)},
    },
    "shear_modulus": {"neo_hooke": {"mu": ("C10", 0.5)}},
    "elastic": {"hooke": {"E": ("E", 1.0), "nu": ("nu", 1.0)}},
}

REVIEW = (
    "M. S. Xavier, A. J. Fleming, Y. K. Yong, Finite Element Modeling of Soft Fluidic Actuators: "
    "Overview and Recent Developments, Adv. Intell. Syst. 2021, 3, 2000187"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """One published set of constants of a library material.

    Parameters
    ----------
    name : str
        Name of the record within its material.
    law : str
        Name of the law, a key of `LAWS`.
    printed : str
        The constants as printed in the source, such as ``"C1 = 0.11 MPa, C2 = 0.02 MPa"``.
    software : str or None
        Program that the source used them in, when stated.
    also_in : tuple of str
        Further publications that use the same constants.
    material : Material
        The same in canonical form, with its source.
    """

    name: str
    law: str
    printed: str
    software: str | None
    also_in: tuple[str, ...]
    material: Material


def library() -> tuple[str, ...]:
    """Return the names of all materials in the library.

    Examples
    --------
    >>> library()
    ('elastosil-m4601', 'paper')
    """
    folder = files("turgor.materials").joinpath("library")
    return tuple(sorted(file.name.removesuffix(".toml") for file in folder.iterdir() if file.name.endswith(".toml")))


def records(name: str) -> tuple[Record, ...]:
    """Return every record of a library material, in the order of its file.

    Examples
    --------
    >>> [record.name for record in records("paper")]
    ['hooke-polygerinos-2020', 'hooke-yang-2020']
    """
    names = library()
    if name not in names:
        near = [known for known in names if known.replace("-", "") == name.lower().translate(_NO_SEPARATORS)]
        hint = f"; did you mean '{near[0]}'?" if near else near_match(name, names) or "."
        raise TurgorError(f"unknown library material '{name}'{hint} Known: {', '.join(names)}.")
    text = files("turgor.materials").joinpath("library", f"{name}.toml").read_text(encoding="utf-8")
    content = tomllib.loads(text)
    return tuple(_record(content, key) for key in content["records"])


def from_library(name: str, record: str | None = None) -> Material:
    """Return a material of the library; where several records exist, one must be chosen by name.

    Parameters
    ----------
    name : str
        Name of the material, one of `library()`.
    record : str, optional
        Name of the record. May be left out only where there is a single one.

    Returns
    -------
    Material
        Law in canonical coefficients [Pa], density where known, and the source.

    Raises
    ------
    TurgorError
        If the name or the record is unknown, or several records exist and none was chosen.

    Examples
    --------
    >>> from_library("elastosil-m4601", record="yeoh-mosadegh-2014").law
    Yeoh(C10=110000.0, C20=20000.0, C30=0.0)
    """
    known = {entry.name: entry for entry in records(name)}
    if record is None:
        if len(known) > 1:
            listed = "; ".join(f"{entry.name} ({entry.law}: {entry.printed})" for entry in known.values())
            raise TurgorError(f"'{name}' has {len(known)} records; choose one with record: {listed}.")
        record = next(iter(known))
    if record not in known:
        hint = near_match(record, known) or "."
        raise TurgorError(f"unknown record '{record}' of '{name}'{hint} Known: {', '.join(known)}.")
    return known[record].material


def law_from_printed(law: str, convention: str, printed: Mapping[str, float]) -> Law | Hooke:
    """Turn printed constants into a law in canonical coefficients.

    Parameters
    ----------
    law : str
        A key of `LAWS`.
    convention : str
        A key of `CONVENTIONS`: what the printed symbols mean.
    printed : mapping of str to float [Pa], Poisson's ratio [-]
        The printed constants in SI units.

    Examples
    --------
    >>> law_from_printed("neo_hooke", "shear_modulus", {"mu": 240e3})
    NeoHooke(C10=120000.0)
    """
    if convention not in CONVENTIONS:
        raise unknown("convention", convention, CONVENTIONS)
    if law not in CONVENTIONS[convention]:
        raise unknown(f"law for the convention {convention}", law, CONVENTIONS[convention])
    symbols = CONVENTIONS[convention][law]
    coefficients = {}
    for symbol, value in printed.items():
        if symbol not in symbols:
            raise unknown(f"constant of {law} in the convention {convention}", symbol, symbols)
        name, factor = symbols[symbol]
        coefficients[name] = factor * value
    made: Law | Hooke = LAWS[law](**coefficients)
    return made


_NO_SEPARATORS = str.maketrans("", "", "-_ ")


def _record(content: Mapping[str, Any], name: str) -> Record:
    entry = content["records"][name]
    texts: dict[str, Any] = entry["parameters"]
    printed = ", ".join(f"{symbol} = {value}" for symbol, value in texts.items())
    values = {
        key: float(v) if isinstance(v, int | float) else parse_quantity(v, "pressure") for key, v in texts.items()
    }
    law = law_from_printed(entry["law"], entry["convention"], values)
    density = entry.get("density", content.get("density", {}))
    stated = printed if printed == describe(law) else f"printed as {printed}, here {describe(law)}"
    source = Source(
        text=entry["source"],
        detail=f"{stated}; quoted in {REVIEW}, {entry['quoted_in']}",
        doubts=(*entry.get("doubts", ()), *density.get("doubts", ())),
    )
    material = Material(
        name=content["name"],
        law=law,
        density=parse_quantity(density["value"], "density") if density else None,
        source=source,
    )
    return Record(
        name=name,
        law=entry["law"],
        printed=printed,
        software=entry.get("software"),
        also_in=tuple(entry.get("also_in", ())),
        material=material,
    )


def describe(law: Law | Hooke) -> str:
    """Write the coefficients of a law with their units, zeros left out.

    Examples
    --------
    >>> describe(Yeoh(C10=0.11e6, C20=0.02e6))
    'C10 = 0.11 MPa, C20 = 0.02 MPa'
    """
    unit = "GPa" if isinstance(law, Hooke) else "MPa"
    values = {field.name: getattr(law, field.name) for field in fields(law)}  # type: ignore[arg-type]
    return ", ".join(
        f"{key} = {value:g}" if key in DIMENSIONLESS else f"{key} = {format_quantity(value, unit)}"
        for key, value in values.items()
        if value != 0
    )

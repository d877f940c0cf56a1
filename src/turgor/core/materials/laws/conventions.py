"""Conventions of the literature for printed constants, and how they become laws in canonical coefficients."""

import re
from collections.abc import Mapping
from dataclasses import MISSING, fields, replace
from typing import Any

from turgor.core.materials.laws.law_spec import is_dimensionless
from turgor.core.materials.laws.laws import LAWS, GeneralizedRivlin, Hooke, Law
from turgor.foundation.errors import TurgorError, unknown
from turgor.units import UNITS

#: What printed symbols mean: for each convention and law, canonical coefficient = factor × printed symbol.
#: "C2" is the second coefficient of I₁ in Yeoh's law and the one of I₂ in Mooney and Rivlin's. An empty table stands
#: for symbols that are numbered. `saved_convention` takes the first in which the symbols of a law are canonical.
CONVENTIONS: Mapping[str, Mapping[str, Mapping[str, tuple[str, float]]]] = {
    "single_index": {
        "neo_hooke": {"C1": ("C10", 1.0)},
        "mooney_rivlin": {"C1": ("C10", 1.0), "C2": ("C01", 1.0)},
        "yeoh": {"C1": ("C10", 1.0), "C2": ("C20", 1.0), "C3": ("C30", 1.0)},
    },
    "two_index": {
        "neo_hooke": {"C10": ("C10", 1.0)},
        "mooney_rivlin": {"C10": ("C10", 1.0), "C01": ("C01", 1.0)},
        "yeoh": {"C10": ("C10", 1.0), "C20": ("C20", 1.0), "C30": ("C30", 1.0)},
        "generalized_rivlin": {},
    },
    "shear_modulus": {"neo_hooke": {"mu": ("C10", 0.5)}},
    "combined": {"yeoh": {"C_combined": ("C10", 1.0)}},
    "elastic": {
        "hooke": {"E": ("E", 1.0), "nu": ("nu", 1.0)},
        "woven": {name: (name, 1.0) for name in ("E", "nu", "E_weft", "G")},
    },
    "canonical": {
        "gent": {"mu": ("mu", 1.0), "Jm": ("Jm", 1.0)},
        "arruda_boyce": {"mu": ("mu", 1.0), "locking_stretch": ("locking_stretch", 1.0)},
        "extended_tube": {"Gc": ("Gc", 1.0), "Ge": ("Ge", 1.0), "delta": ("delta", 1.0), "beta": ("beta", 1.0)},
        "blatz_ko": {"mu": ("mu", 1.0)},
    },
    "mu/alpha": {"ogden": {}, "hyperfoam": {}},
    "abaqus": {"ogden": {}, "hyperfoam": {}},
}

#: Coefficients that a convention leaves out because they are zero in it.
_IMPLIED: Mapping[str, Mapping[str, float]] = {"combined": {"C20": 0.0}}


def law_from_printed(law: str, convention: str, printed: Mapping[str, float]) -> Law | Hooke:
    """Turn printed constants into a law in canonical coefficients.

    Parameters
    ----------
    law : str
        Name of the law as files write it.
    convention : str
        A key of `CONVENTIONS`: what the printed symbols mean.
    printed : mapping of str to float [Pa], exponents and Poisson's ratio [-]
        The printed constants in SI units.

    Returns
    -------
    Law or Hooke

    Raises
    ------
    TurgorError
        If the convention, the law or a symbol is unknown, a constant is missing, or no such law can exist.

    Examples
    --------
    >>> law_from_printed("neo_hooke", "shear_modulus", {"mu": 240e3})
    NeoHooke(C10=120000.0)
    """
    if convention not in CONVENTIONS:
        raise unknown("convention", convention, CONVENTIONS)
    if law not in CONVENTIONS[convention]:
        raise unknown(f"law for the convention {convention}", law, CONVENTIONS[convention])
    if law in ("ogden", "hyperfoam"):
        return _of_terms(law, convention, printed)
    if law == "generalized_rivlin":
        return GeneralizedRivlin.from_names(printed)
    symbols = CONVENTIONS[convention][law]
    coefficients = dict(_IMPLIED.get(convention, {}))
    for symbol, value in printed.items():
        if symbol not in symbols:
            raise unknown(f"constant of {law} in the convention {convention}", symbol, symbols)
        name, factor = symbols[symbol]
        coefficients[name] = factor * value
    for item in fields(LAWS[law]):
        if item.name not in coefficients and item.default is MISSING:
            symbol = next(symbol for symbol, (name, _) in symbols.items() if name == item.name)
            raise TurgorError(f"the constant '{symbol}' of {law} is missing; a law has no default constants.")
    canonical: Law | Hooke = LAWS[law](**coefficients)
    return canonical


def saved_convention(law: str) -> str | None:
    """Return the convention in which files state a law by its own coefficients; None where there is none.

    Examples
    --------
    >>> saved_convention("yeoh"), saved_convention("ogden"), saved_convention("demiray")
    ('two_index', 'mu/alpha', None)
    """
    for convention, laws in CONVENTIONS.items():
        if law in laws and all(stands_for == (symbol, 1.0) for symbol, stands_for in laws[law].items()):
            return convention
    return None


def has_no_unit(symbol: str) -> bool:
    """Return whether a printed symbol such as ``alpha_1`` or ``nu`` is a number without a unit; others are pressures.

    Examples
    --------
    >>> has_no_unit("alpha_1"), has_no_unit("mu_1")
    (True, False)
    """
    name = re.sub(r"_\d+$", "", symbol)
    return any(item.name == name and is_dimensionless(item) for law in LAWS.values() for item in fields(law))


def ogden_terms(printed: Mapping[str, float]) -> tuple[tuple[float, float], ...]:
    """Return the pairs μᵢ [Pa], αᵢ [-] of printed Ogden constants ``mu_1``, ``alpha_1``, ``mu_2`` and so on.

    Examples
    --------
    >>> ogden_terms({"mu_1": 22e3, "alpha_1": 1.3})
    ((22000.0, 1.3),)
    """
    return tuple((mu, alpha) for mu, alpha in _terms("ogden", ("mu", "alpha"), printed))


def _terms(law: str, symbols: tuple[str, ...], printed: Mapping[str, float]) -> tuple[tuple[float, ...], ...]:
    """Printed constants of each term of a law, in the order of its symbols."""
    count = len(printed) // len(symbols)
    expected = [f"{symbol}_{i}" for i in range(1, count + 1) for symbol in symbols]
    if not count or set(expected) != set(printed):
        shown = ", ".join(printed) or "none"
        needed = ", ".join(f"{symbol}_{i}" for i in (1, 2) for symbol in symbols)
        raise TurgorError(f"the constants of the law {LAWS[law].__name__} are {needed} and so on, not {shown}.")
    return tuple(tuple(printed[f"{symbol}_{i}"] for symbol in symbols) for i in range(1, count + 1))


def ogden_moduli(printed: Mapping[str, float]) -> dict[str, float]:
    """Initial shear modulus [Pa] of printed Ogden constants in either convention: Σ μᵢ, and ½ Σ μᵢ αᵢ.

    Examples
    --------
    >>> {name: round(value) for name, value in ogden_moduli({"mu_1": 75.5e3, "alpha_1": 5.84}).items()}
    {'abaqus': 75500, 'mu/alpha': 220460}
    """
    terms = ogden_terms(printed)
    return {"abaqus": sum(mu for mu, _ in terms), "mu/alpha": 0.5 * sum(mu * alpha for mu, alpha in terms)}


def describe(law: Law | Hooke) -> str:
    """Write the coefficients of a law with their units, zeros left out.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> describe(Yeoh(C10=0.11e6, C20=0.02e6))
    'C10 = 0.11 MPa, C20 = 0.02 MPa'
    """
    unit = "GPa" if isinstance(law, Hooke) and law.E >= 1e8 else "MPa"
    plain = {item.name for item in fields(law) if is_dimensionless(item)}  # type: ignore[arg-type]
    return ", ".join(
        f"{key} = {value:g}" if re.sub(r"_\d+$", "", key) in plain else f"{key} = {_rounded(value, unit)}"
        for key, value in _coefficients(law).items()
        if value != 0
    )


def scaled_law(law: Law, factor: float) -> Law:
    """Return a law whose energy is multiplied by a factor, its exponents and limits as they are.

    Parameters
    ----------
    law : Law
        Any law of a rubber.
    factor : float [-]
        What its moduli are multiplied by.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Ogden
    >>> scaled_law(Ogden(mu=(2e4,), alpha=(1.5,)), 1.5)
    Ogden(mu=(30000.0,), alpha=(1.5,))
    """

    def times(value: Any) -> Any:
        if not isinstance(value, tuple):
            return factor * value
        if isinstance(value[0], tuple):
            return tuple((*exponents, factor * number) for *exponents, number in value)
        return tuple(factor * number for number in value)

    moduli = [item.name for item in fields(law) if not is_dimensionless(item)]  # type: ignore[arg-type]
    return replace(law, **{name: times(getattr(law, name)) for name in moduli})  # type: ignore[type-var]


def _coefficients(law: Any) -> dict[str, float]:
    """Every coefficient of a law by its name."""
    constants: dict[str, float] = {}
    for field in fields(law):
        value = getattr(law, field.name)
        if isinstance(value, int | float):
            constants[field.name] = float(value)
        elif isinstance(value, Mapping):
            constants |= {str(name): float(number) for name, number in value.items()}
        elif value and isinstance(value[0], tuple):
            constants |= {f"C{i}{j}": float(number) for i, j, number in value}
        else:
            constants |= {f"{field.name}_{i}": float(number) for i, number in enumerate(value, 1)}
    return constants


def _rounded(value: float, unit: str) -> str:
    """A quantity for reading: seven digits, without those that a conversion leaves behind."""
    return f"{value / UNITS['pressure'][unit]:.7g} {unit}"


def _of_terms(law: str, convention: str, printed: Mapping[str, float]) -> Law:
    kind: Any = LAWS[law]
    symbols = tuple(item.name for item in fields(kind))
    terms = dict(zip(symbols, zip(*_terms(law, symbols, printed), strict=True), strict=True))
    made: Law = kind.from_abaqus(**terms) if convention == "abaqus" else kind(**terms)
    return made

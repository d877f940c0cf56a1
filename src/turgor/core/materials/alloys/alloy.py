"""ShapeMemoryAlloy: the constants of a shape-memory alloy in a wire, after Brinson (1993)."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from importlib.resources import files
from math import isfinite
from typing import TYPE_CHECKING, Any

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.given import Quantity, number
from turgor.units import UNITS, format_quantity

#: Dimension of each constant.
_DIMENSIONS: Mapping[str, str] = {
    "martensite_modulus": "pressure", "austenite_modulus": "pressure",
    "martensite_finish": "temperature", "martensite_start": "temperature",
    "austenite_start": "temperature", "austenite_finish": "temperature",
    "martensite_slope": "stress per temperature", "austenite_slope": "stress per temperature",
    "detwinning_start": "pressure", "detwinning_finish": "pressure", "transformation_strain": "share",
    "expansion": "expansion",
}  # fmt: skip

#: Constants that must rise in this order, with what they are.
_RISING = (
    ("martensite_finish", "martensite_start"),
    ("austenite_start", "austenite_finish"),
    ("martensite_start", "austenite_finish"),
    ("detwinning_start", "detwinning_finish"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShapeMemoryAlloy:
    """Constants of a shape-memory alloy: at which stress and temperature it changes, and by how much.

    Parameters
    ----------
    martensite_modulus, austenite_modulus : float [Pa]
        Young's moduli of both phases.
    martensite_finish, martensite_start, austenite_start, austenite_finish : float [K]
        Temperatures between which each phase forms without stress; ``"18.4 °C"`` is understood, too.
    martensite_slope, austenite_slope : float [Pa/K]
        By how much stress raises these temperatures, C_M and C_A.
    detwinning_start, detwinning_finish : float [Pa]
        Stresses between which twinned martensite becomes detwinned below ``martensite_start``.
    transformation_strain : float
        Largest strain of detwinned martensite, ε_L.
    expansion : float [1/K]
        Linear thermal expansion, the same of both phases; small against the transformation strain.
    source : str
        Where the constants are published.

    Examples
    --------
    >>> alloy = ShapeMemoryAlloy.named("nitinol-brinson-1993")
    >>> alloy.austenite_modulus, alloy.transformation_strain
    (67000000000.0, 0.067)
    """

    martensite_modulus: float
    austenite_modulus: float
    martensite_finish: float
    martensite_start: float
    austenite_start: float
    austenite_finish: float
    martensite_slope: float
    austenite_slope: float
    detwinning_start: float
    detwinning_finish: float
    transformation_strain: float
    expansion: float = 0.0
    source: str = field(default="", compare=False)

    if TYPE_CHECKING:

        def __init__(
            self, *, martensite_modulus: Quantity, austenite_modulus: Quantity, martensite_finish: Quantity,
            martensite_start: Quantity, austenite_start: Quantity, austenite_finish: Quantity,
            martensite_slope: Quantity, austenite_slope: Quantity, detwinning_start: Quantity,
            detwinning_finish: Quantity, transformation_strain: Quantity, expansion: Quantity = 0.0, source: str = "",
        ) -> None: ...  # fmt: skip

    def __post_init__(self) -> None:
        for key, dimension in _DIMENSIONS.items():
            value = number(getattr(self, key), f"shape-memory alloy: {key}", dimension)
            object.__setattr__(self, key, value)
            if not (isfinite(value) and (value > 0 or key == "expansion")):
                raise TurgorError(f"shape-memory alloy: {key} is {value:g} in SI units; it must be above 0.")
        for low, high in _RISING:
            if not getattr(self, low) < getattr(self, high):
                raise TurgorError(
                    f"shape-memory alloy: {low} is {getattr(self, low):g} and {high} {getattr(self, high):g} in SI "
                    f"units; {low} must be less."
                )
        if self.transformation_strain > 0.2:
            raise TurgorError(
                f"shape-memory alloy: transformation_strain is {self.transformation_strain:g}; it must be below 0.2. "
                "Nitinol has 0.04 to 0.08."
            )

    @staticmethod
    def named(name: str) -> "ShapeMemoryAlloy":
        """Return a published alloy by its name.

        Raises
        ------
        TurgorError
            If there is none of this name.
        """
        known = alloys()
        if name not in known:
            raise unknown("shape-memory alloy", name, known)
        return known[name]

    def table(self) -> str | dict[str, str | float]:
        """Return its name if it is published, or else its constants as text with units, as a job file states them."""
        name = next((name for name, each in alloys().items() if each == self), None)
        units = {key: next(iter(UNITS[each])) for key, each in _DIMENSIONS.items()}
        return name or {key: format_quantity(getattr(self, key), unit) for key, unit in units.items()}

    def modulus(self, martensite: float) -> float:
        """Return Young's modulus at a fraction of martensite, by the rule of mixtures [Pa]."""
        return self.austenite_modulus + martensite * (self.martensite_modulus - self.austenite_modulus)


@cache
def alloys() -> Mapping[str, ShapeMemoryAlloy]:
    """Return the published alloys by their names.

    Examples
    --------
    >>> sorted(alloys())
    ['nitinol-brinson-1993']
    """
    text = files(__package__).joinpath("alloys.toml").read_text(encoding="utf-8")
    return {name: ShapeMemoryAlloy(**values) for name, values in tomllib.loads(text).items()}


def given_alloy(given: Any) -> ShapeMemoryAlloy:
    """Return an alloy that is stated by its name, as a table of its constants, or as itself.

    Raises
    ------
    TurgorError
        If it is none of these, or a constant is missing or unknown.
    """
    if isinstance(given, ShapeMemoryAlloy):
        return given
    if isinstance(given, str):
        return ShapeMemoryAlloy.named(given)
    if not isinstance(given, Mapping):
        raise TurgorError(f"alloy is {given!r}; the name of one or a ShapeMemoryAlloy is needed.")
    keys = [item.name for item in fields(ShapeMemoryAlloy)]
    for key in given:
        if key not in keys:
            raise unknown("key of alloy", str(key), keys)
    missing = [key for key in keys if key not in (*given, "expansion", "source")]
    if missing:
        raise TurgorError(f"alloy: {', '.join(missing)} missing; all constants are needed, or the name of an alloy.")
    return ShapeMemoryAlloy(**given)

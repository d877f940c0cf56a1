"""Common parts of all laws: their interface and their checks."""

from collections.abc import Iterable
from dataclasses import fields
from math import isfinite
from typing import Any, Protocol, TypeAlias, runtime_checkable

from turgor.core.materials.laws.fiber_family import Family
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import number, shown


@runtime_checkable
class InvariantLaw(Protocol):
    """An isotropic rubber whose energy is written in the invariants Ī₁, Ī₂."""

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density W(Ī₁, Ī₂) [Pa]."""

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""


@runtime_checkable
class StretchLaw(Protocol):
    """An isotropic rubber whose energy is written in the isochoric principal stretches, symmetric in them."""

    def energy_of_stretches(self, l1: Any, l2: Any, l3: Any) -> Any:
        """Strain energy density W(λ̄₁, λ̄₂, λ̄₃) [Pa]; of a `FoamLaw`, W(λ₁, λ₂, λ₃)."""

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""


@runtime_checkable
class FoamLaw(StretchLaw, Protocol):
    """An isotropic foam: a law in the principal stretches themselves, so that its energy has the change of volume."""

    @property
    def bulk_modulus(self) -> float:
        """Initial bulk modulus κ [Pa]."""


@runtime_checkable
class FiberLaw(Protocol):
    """A body with fibers: an isotropic rubber, and families of fibers whose directions the material states."""

    @property
    def matrix(self) -> InvariantLaw:
        """The rubber between the fibers."""

    def families(self, angle: float) -> tuple[Family, ...]:
        """Families of fibers at an angle [rad] to the first direction of the material."""

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ of the rubber between the fibers [Pa]."""


#: Any isotropic law of a rubber or a foam, in either form; works with ``isinstance``.
Law: TypeAlias = InvariantLaw | StretchLaw


def make_floats(law: Any) -> None:
    """Make floats of the coefficients of a law, which may be given as texts with a unit.

    Parameters
    ----------
    law : dataclass
        A law whose fields are numbers [Pa], or without a unit where their metadata say so.
    """
    for item in fields(law):
        plain = item.metadata.get("dimension") == "number"
        value = number(
            getattr(law, item.name), f"{type(law).__name__}: {item.name}", "" if plain else "pressure", finite=False
        )
        object.__setattr__(law, item.name, value)


def require_finite(law: object, values: Iterable[tuple[str, float]]) -> None:
    """Raise an error for coefficients that are not numbers."""
    for name, value in values:
        if not isfinite(value):
            raise TurgorError(f"{type(law).__name__}: {name} is {value:g}; it must be a finite number.")


def require_positive_shear_modulus(law: Law | FiberLaw) -> None:
    """Raise an error for a law that is not stiff at rest."""
    if not law.shear_modulus > 0:
        raise TurgorError(
            f"{type(law).__name__} has an initial shear modulus of {law.shear_modulus:g} Pa; it must be positive. "
            "Check the sign and the unit of the first coefficients."
        )


def numbers(law: object, name: str, values: Any, dimension: str = "") -> tuple[float, ...]:
    """A non-empty tuple of floats, so that the law can be hashed and its terms counted."""
    what = f"{type(law).__name__}: {name}"
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TurgorError(f"{what} is {shown(values)}; give a sequence with one number for each term.")
    checked = tuple(number(each, f"{what} {k}", dimension, finite=False) for k, each in enumerate(values, 1))
    if not checked:
        raise TurgorError(f"{type(law).__name__}: {name} is empty; give at least one number.")
    return checked

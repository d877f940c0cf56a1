"""What every law offers, and the checks that every law makes."""

from collections.abc import Iterable, Sequence
from math import isfinite
from typing import Any, Protocol, TypeAlias, runtime_checkable

from turgor.errors import TurgorError


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
        """Strain energy density W(λ̄₁, λ̄₂, λ̄₃) [Pa]."""

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ [Pa]."""


#: Any law of a rubber, in either form; works with ``isinstance``.
Law: TypeAlias = InvariantLaw | StretchLaw


def require_finite(law: object, values: Iterable[tuple[str, float]]) -> None:
    """Raise an error for coefficients that are not numbers."""
    for name, value in values:
        if not isfinite(value):
            raise TurgorError(f"{type(law).__name__}: {name} is {value:g}; it must be a finite number.")


def require_positive_shear_modulus(law: Law) -> None:
    """Raise an error for a law that is not stiff at rest."""
    if not law.shear_modulus > 0:
        raise TurgorError(
            f"{type(law).__name__} has an initial shear modulus of {law.shear_modulus:g} Pa; it must be positive. "
            "Check the sign and the unit of the first coefficients."
        )


def numbers(law: object, name: str, values: Any) -> tuple[float, ...]:
    """A non-empty tuple of floats, so that the law can be hashed and its terms counted."""
    if isinstance(values, str) or (not isinstance(values, Sequence) and not hasattr(values, "__iter__")):
        raise TurgorError(f"{type(law).__name__}: {name} is {values!r}; give a sequence with one number for each term.")
    try:
        found = tuple(float(value) for value in values)
    except (TypeError, ValueError):
        raise TurgorError(f"{type(law).__name__}: {name} is {values!r}; each entry must be a number.") from None
    if not found:
        raise TurgorError(f"{type(law).__name__}: {name} is empty; give at least one number.")
    return found

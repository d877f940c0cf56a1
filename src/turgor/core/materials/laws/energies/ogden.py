"""Ogden's law, in the principal stretches."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import numbers, require_finite, require_positive_shear_modulus
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class Ogden:
    """Ogden law W = Σ (μᵢ/αᵢ) (λ̄₁^αᵢ + λ̄₂^αᵢ + λ̄₃^αᵢ − 3), good to strains of 700 %.

    Parameters
    ----------
    mu : tuple of float [Pa]
        Coefficients μᵢ, one for each term, in the convention above; the initial shear modulus is ½ Σ μᵢαᵢ. For
        constants from Abaqus and many papers, W = Σ (2μᵢ/αᵢ²) (…), use `from_abaqus`.
    alpha : tuple of float [-]
        Exponents αᵢ, any but 0.

    Examples
    --------
    >>> Ogden(mu=(0.1e6, -0.02e6), alpha=(2.0, -2.0)).shear_modulus
    120000.0
    """

    mu: tuple[float, ...]
    alpha: tuple[float, ...] = field(metadata={"dimension": "number"})

    series = "ogden"  # a fit asks for "ogden-3"

    if TYPE_CHECKING:

        def __init__(self, *, mu: Iterable[Quantity], alpha: Iterable[float]) -> None: ...

    def __post_init__(self) -> None:
        check_terms(self)
        require_positive_shear_modulus(self)

    @classmethod
    def from_abaqus(cls, mu: Sequence[float], alpha: Sequence[float]) -> "Ogden":
        """Make the law from constants of Abaqus's convention W = Σ (2μᵢ/αᵢ²) (…), in which μ = Σ μᵢ.

        Examples
        --------
        >>> Ogden.from_abaqus(mu=(75.5e3,), alpha=(5.0,))
        Ogden(mu=(30200.0,), alpha=(5.0,))
        """
        require_same_length("Ogden", mu, alpha)
        require_exponents("Ogden", alpha)
        return cls(mu=tuple(2 * m / a for m, a in zip(mu, alpha, strict=True)), alpha=tuple(alpha))

    @classmethod
    def fit_spec(cls, terms: int) -> LawSpec:
        """Return how a fit makes the law with so many terms."""

        def make(mu: Sequence[float], alpha: Sequence[float]) -> "Ogden":
            return cls(mu=tuple(map(float, mu)), alpha=tuple(map(float, alpha)))

        return LawSpec(
            name=f"{cls.series}-{terms}",
            coefficients=tuple(f"mu{i}" for i in range(1, terms + 1)),
            shapes=tuple(f"alpha{i}" for i in range(1, terms + 1)),
            make=make,
            sign="shape",
            bounds=(-12.0, 18.0),
        )

    def to_abaqus(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the constants μᵢ [Pa] and αᵢ in Abaqus's convention.

        Examples
        --------
        >>> Ogden(mu=(30200.0,), alpha=(5.0,)).to_abaqus()
        ((75500.0,), (5.0,))
        """
        return tuple(m * a / 2 for m, a in zip(self.mu, self.alpha, strict=True)), self.alpha

    def energy_of_stretches(self, l1: Any, l2: Any, l3: Any) -> Any:
        """Strain energy density [Pa]: Xavier, Fleming and Yong 2021, Eq. 13."""
        return sum(m / a * (l1**a + l2**a + l3**a - 3) for m, a in zip(self.mu, self.alpha, strict=True))

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = ½ Σ μᵢαᵢ [Pa]."""
        return 0.5 * sum(m * a for m, a in zip(self.mu, self.alpha, strict=True))


def check_terms(law: Any) -> None:
    """Make tuples of the coefficients ``mu`` and exponents ``alpha`` of a law, and check them."""
    object.__setattr__(law, "mu", numbers(law, "mu", law.mu, "pressure"))
    object.__setattr__(law, "alpha", numbers(law, "alpha", law.alpha))
    name = type(law).__name__
    require_same_length(name, law.mu, law.alpha)
    require_exponents(name, law.alpha)
    require_finite(law, ((f"mu {i}", value) for i, value in enumerate(law.mu, 1)))
    require_finite(law, ((f"alpha {i}", value) for i, value in enumerate(law.alpha, 1)))


def require_same_length(name: str, mu: Sequence[float], alpha: Sequence[float]) -> None:
    """Raise an error where a law of some name has not as many exponents as coefficients."""
    if len(mu) != len(alpha):
        raise TurgorError(
            f"{name}: {len(mu)} coefficients mu but {len(alpha)} exponents alpha; give one of each a term."
        )


def require_exponents(name: str, alpha: Sequence[float]) -> None:
    """Raise an error for an exponent of zero."""
    for i, exponent in enumerate(alpha, 1):
        if exponent == 0:
            raise TurgorError(f"{name}: alpha {i} is 0; an exponent may have any value but 0.")

"""Storåkers's law of foams, which finite element programs call hyperfoam."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from turgor.core.materials.laws.common import numbers, require_positive_shear_modulus
from turgor.core.materials.laws.energies.ogden import check_terms, require_exponents, require_same_length
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity

#: Poisson's ratios that a term may have: below −1 nothing is stable, at ½ the volume would be constant.
RATIOS = (-1.0, 0.5)


@dataclass(frozen=True, slots=True, kw_only=True)
class Hyperfoam:
    """Law of foams W = Σ (μᵢ/αᵢ) (λ₁^αᵢ + λ₂^αᵢ + λ₃^αᵢ − 3 + (J^(−αᵢβᵢ) − 1)/βᵢ) with βᵢ = νᵢ/(1 − 2νᵢ).

    Storåkers, J. Mech. Phys. Solids 34 (1986) 125, doi 10.1016/0022-5096(86)90033-5. Its energy has the change of
    volume; a material of it has no bulk modulus besides.

    Parameters
    ----------
    mu : tuple of float [Pa]
        Coefficients μᵢ, one for each term, in the convention of `Ogden`; the initial shear modulus is ½ Σ μᵢαᵢ. For
        constants from Abaqus, CalculiX and most papers, W = Σ (2μᵢ/αᵢ²) (…), use `from_abaqus`.
    alpha : tuple of float [-]
        Exponents αᵢ, any but 0.
    nu : tuple of float [-]
        Poisson's ratios νᵢ, more than −1 and less than 0.5; 0 for a foam that is squeezed without growing wider.

    Examples
    --------
    >>> foam = Hyperfoam.from_abaqus(mu=(20e3,), alpha=(8.0,), nu=(0.0,))
    >>> foam.shear_modulus, round(foam.bulk_modulus)
    (20000.0, 13333)
    """

    mu: tuple[float, ...]
    alpha: tuple[float, ...] = field(metadata={"dimension": "number"})
    nu: tuple[float, ...] = field(metadata={"dimension": "number"})

    series = "hyperfoam"  # a fit asks for "hyperfoam-2"

    if TYPE_CHECKING:

        def __init__(self, *, mu: Iterable[Quantity], alpha: Iterable[float], nu: Iterable[float]) -> None: ...

    def __post_init__(self) -> None:
        check_terms(self)
        ratios = numbers(self, "nu", self.nu)
        if len(ratios) != len(self.mu):
            raise TurgorError(f"Hyperfoam: {len(self.mu)} coefficients mu but {len(ratios)} ratios nu; give one each.")
        for i, ratio in enumerate(ratios, 1):
            if not RATIOS[0] < ratio < RATIOS[1]:
                raise TurgorError(
                    f"Hyperfoam: nu {i} is {ratio:g}; a Poisson's ratio is more than {RATIOS[0]:g} and less than "
                    f"{RATIOS[1]:g}. For a rubber that keeps its volume take Ogden."
                )
        # a whole number stays in derived formulas as it is, so that β = 0 has a formula of its own
        object.__setattr__(self, "nu", tuple(0 if ratio == 0 else ratio for ratio in ratios))
        require_positive_shear_modulus(self)
        if not self.bulk_modulus > 0:
            raise TurgorError(
                f"Hyperfoam has an initial bulk modulus of {self.bulk_modulus:g} Pa; it must be positive."
            )

    @classmethod
    def from_abaqus(cls, mu: Sequence[float], alpha: Sequence[float], nu: Sequence[float]) -> "Hyperfoam":
        """Make the law from constants of Abaqus's convention W = Σ (2μᵢ/αᵢ²) (…), in which μ = Σ μᵢ.

        Examples
        --------
        >>> Hyperfoam.from_abaqus(mu=(75.5e3,), alpha=(5.0,), nu=(0.1,))
        Hyperfoam(mu=(30200.0,), alpha=(5.0,), nu=(0.1,))
        """
        require_same_length("Hyperfoam", mu, alpha)
        require_exponents("Hyperfoam", alpha)
        return cls(mu=tuple(2 * m / a for m, a in zip(mu, alpha, strict=True)), alpha=tuple(alpha), nu=tuple(nu))

    @classmethod
    def fit_spec(cls, terms: int, nu: float = 0.0) -> LawSpec:
        """Return how a fit makes the law with so many terms, all of one Poisson's ratio that is known.

        A tension or compression test alone does not say how wide the specimen gets, so the ratio is measured apart; a
        foam of open cells that is squeezed has nearly 0.

        Examples
        --------
        >>> Hyperfoam.fit_spec(2, nu=0.1).names
        ('mu1', 'mu2', 'alpha1', 'alpha2')
        """

        def make(mu: Sequence[float], alpha: Sequence[float]) -> "Hyperfoam":
            return cls(mu=tuple(map(float, mu)), alpha=tuple(map(float, alpha)), nu=(nu,) * len(mu))

        return LawSpec(
            name=f"{cls.series}-{terms}",
            coefficients=tuple(f"mu{i}" for i in range(1, terms + 1)),
            shapes=tuple(f"alpha{i}" for i in range(1, terms + 1)),
            make=make,
            sign="shape",
            bounds=(-25.0, 25.0),
        )

    def to_abaqus(self) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
        """Return the constants μᵢ [Pa], αᵢ and νᵢ in Abaqus's convention.

        Examples
        --------
        >>> Hyperfoam(mu=(30200.0,), alpha=(5.0,), nu=(0.1,)).to_abaqus()
        ((75500.0,), (5.0,), (0.1,))
        """
        return tuple(m * a / 2 for m, a in zip(self.mu, self.alpha, strict=True)), self.alpha, self.nu

    def energy_of_stretches(self, l1: Any, l2: Any, l3: Any, log: Callable[[Any], Any] = np.log) -> Any:
        """Strain energy density [Pa] of stretches that change the volume, too; ``log`` is NumPy's or SymPy's."""
        J = l1 * l2 * l3
        total = 0.0
        for m, a, n in zip(self.mu, self.alpha, self.nu, strict=True):
            b = n / (1 - 2 * n)
            volume = -a * log(J) if n == 0 else (J ** (-a * b) - 1) / b
            total = total + m / a * (l1**a + l2**a + l3**a - 3 + volume)
        return total

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = ½ Σ μᵢαᵢ [Pa]."""
        return 0.5 * sum(m * a for m, a in zip(self.mu, self.alpha, strict=True))

    @property
    def bulk_modulus(self) -> float:
        """Initial bulk modulus κ = Σ μᵢαᵢ (⅓ + βᵢ) [Pa]."""
        return sum(m * a * (1 / 3 + n / (1 - 2 * n)) for m, a, n in zip(self.mu, self.alpha, self.nu, strict=True))

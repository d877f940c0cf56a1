"""Yeoh's law with any number of terms."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from turgor.core.materials.laws.common import numbers, require_finite, require_positive_shear_modulus
from turgor.core.materials.laws.energies.yeoh import Yeoh
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.foundation.given import Quantity


@dataclass(frozen=True, slots=True, kw_only=True)
class YeohN:
    """Yeoh law W = Σ Cᵢ₀ (Ī₁ − 3)ⁱ, with any number of terms.

    Parameters
    ----------
    coefficients : tuple of float [Pa]
        C10, C20, C30 and so on; μ = 2 C10.

    Examples
    --------
    >>> YeohN(coefficients=(12.7e3, 423.0, -1.46, 0.02)).shear_modulus
    25400.0
    """

    coefficients: tuple[float, ...]

    series = "yeoh"  # a fit asks for "yeoh-4"

    if TYPE_CHECKING:

        def __init__(self, *, coefficients: Iterable[Quantity]) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficients", numbers(self, "coefficients", self.coefficients, "pressure"))
        require_positive_shear_modulus(self)
        require_finite(self, ((f"C{i}0", value) for i, value in enumerate(self.coefficients, 1)))

    @classmethod
    def fit_spec(cls, order: int) -> LawSpec:
        """Return how a fit makes the law with so many terms; up to three it is `Yeoh`."""
        names = tuple(f"C{i}0" for i in range(1, order + 1))

        def make(coefficients: Sequence[float], _: Sequence[float]) -> "Yeoh | YeohN":
            values = tuple(map(float, coefficients))
            if order > 3:
                return cls(coefficients=values)
            return Yeoh(**({"C20": 0.0} | dict(zip(names, values, strict=True))))

        return LawSpec(name="yeoh" if order == 3 else f"{cls.series}-{order}", coefficients=names, make=make)

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa]: Xavier, Fleming and Yong 2021, Eq. 14."""
        x = I1 - 3
        return sum(C * x**i for i, C in enumerate(self.coefficients, 1))

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 C10 [Pa]."""
        return 2 * self.coefficients[0]

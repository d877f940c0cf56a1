"""The generalized Rivlin law, a polynomial of any order."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from turgor.core.materials.laws.common import require_finite, require_positive_shear_modulus
from turgor.core.materials.laws.law_spec import LawSpec
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import number

_NAME = re.compile(r"C(\d)(\d)")


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneralizedRivlin:
    """Generalized Rivlin (polynomial) law W = Σ Cij (Ī₁ − 3)ⁱ (Ī₂ − 3)ʲ, of any order.

    Parameters
    ----------
    coefficients : tuple of (int, int, float [Pa])
        Exponents i and j and the coefficient Cij of each term, kept in order; `from_names` takes names.
        μ = 2 (C10 + C01).

    Examples
    --------
    >>> law = GeneralizedRivlin.from_names({"C10": 279.3e3, "C01": 10.5e3, "C20": 59.1e3})
    >>> law.shear_modulus, law.coefficients[0]
    (579600.0, (1, 0, 279300.0))
    """

    coefficients: tuple[tuple[int, int, float], ...]

    series = "rivlin"  # a fit asks for "rivlin-2"

    def __post_init__(self) -> None:
        terms = [_term(term) for term in self.coefficients]
        if not terms:
            raise TurgorError("GeneralizedRivlin: coefficients is empty; give at least C10 or C01.")
        terms.sort(key=lambda term: (term[0] + term[1], term[1]))
        for (i, j, _), following in pairwise(terms):
            if (i, j) == following[:2]:
                raise TurgorError(f"GeneralizedRivlin: coefficients gives C{i}{j} twice; give each Cij once.")
        object.__setattr__(self, "coefficients", tuple(terms))
        require_positive_shear_modulus(self)
        require_finite(self, ((f"C{i}{j}", value) for i, j, value in terms))

    @classmethod
    def from_names(cls, coefficients: Mapping[str, float]) -> "GeneralizedRivlin":
        """Make a law of any order from coefficients by name [Pa], exponents of one digit.

        Examples
        --------
        >>> GeneralizedRivlin.from_names({"C10": 1e5, "C50": 2.0}).coefficients
        ((1, 0, 100000.0), (5, 0, 2.0))
        """
        return cls(coefficients=tuple(_named(name, value) for name, value in coefficients.items()))

    @classmethod
    def fit_spec(cls, order: int) -> LawSpec:
        """Return how a fit makes the law with all terms up to an order."""
        names = tuple(f"C{total - j}{j}" for total in range(1, order + 1) for j in range(total + 1))

        def make(coefficients: Sequence[float], _: Sequence[float]) -> "GeneralizedRivlin":
            return cls.from_names(dict(zip(names, map(float, coefficients), strict=True)))

        return LawSpec(name=f"{cls.series}-{order}", coefficients=names, make=make)

    def energy(self, I1: Any, I2: Any) -> Any:
        """Strain energy density [Pa]: Xavier, Fleming and Yong 2021, Eq. 11."""
        return sum(C * (I1 - 3) ** i * (I2 - 3) ** j for i, j, C in self.coefficients)

    @property
    def shear_modulus(self) -> float:
        """Initial shear modulus μ = 2 (C10 + C01) [Pa]."""
        return 2 * sum(C for i, j, C in self.coefficients if i + j == 1)


def _named(name: str, value: float) -> tuple[int, int, float]:
    match = _NAME.fullmatch(name)
    if match is None:
        raise TurgorError(f"GeneralizedRivlin: unknown coefficient '{name}'; write Cij with two digits, such as C10.")
    return _term((int(match[1]), int(match[2]), value))


def _term(term: Any) -> tuple[int, int, float]:
    try:
        i, j, value = term
        checked = (int(i), int(j), number(value, f"GeneralizedRivlin: C{i}{j}", "pressure", finite=False))
    except TurgorError:
        raise
    except (TypeError, ValueError):
        raise TurgorError(f"GeneralizedRivlin: {term!r} is no term; give (i, j, Cij) with a number Cij.") from None
    if checked[:2] != (i, j) or min(checked[:2]) < 0 or sum(checked[:2]) < 1:
        raise TurgorError(f"GeneralizedRivlin: exponents {i}, {j}; they must be whole, at least 0, and not both 0.")
    return checked

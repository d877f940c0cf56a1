"""Laws as fitting sees them: stress is linear in the coefficients of a law once its few shape parameters are set."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from turgor.errors import TurgorError, near_match
from turgor.materials.laws import laws

#: Largest order that a name may ask for; more terms than that describe noise.
LARGEST_ORDER = 6

#: Names that are understood, with N a number.
KNOWN = ("neo-hooke", "mooney-rivlin", "yeoh", "yeoh-N", "rivlin-N", "ogden-N", "gent", "arruda-boyce")


@dataclass(frozen=True, slots=True, kw_only=True)
class LawSpec:
    """How a law is made from a vector of numbers, and what these may be.

    Parameters
    ----------
    name : str
        As users write it, such as ``"ogden-3"``.
    coefficients : tuple of str
        Parameters in which the stress is linear [Pa].
    shapes : tuple of str
        The other parameters [-].
    make : callable
        ``make(coefficients, shapes)`` returns the law.
    sign : str
        What keeps the law stable: ``"slope"`` (rising stress), ``"positive"`` or ``"shape"`` (the sign of the shape).
    bounds : tuple of float
        Smallest and largest value of a shape.
    """

    name: str
    coefficients: tuple[str, ...]
    shapes: tuple[str, ...] = ()
    make: Callable[[Sequence[float], Sequence[float]], Any]
    sign: str = "slope"
    bounds: tuple[float, float] = (0.0, 0.0)

    @property
    def names(self) -> tuple[str, ...]:
        """All parameters, coefficients first."""
        return (*self.coefficients, *self.shapes)


def law_spec(law: str | type | LawSpec) -> LawSpec:
    """Find a law by its name or its class.

    Parameters
    ----------
    law : str, type or LawSpec
        A name such as ``"yeoh"`` or ``"ogden-3"``, or a class such as ``Yeoh``; Ogden and the generalized Rivlin law
        need their number of terms or order, so they are asked for by name.

    Examples
    --------
    >>> law_spec("ogden-2").names
    ('mu1', 'mu2', 'alpha1', 'alpha2')
    >>> law_spec("rivlin-2").names
    ('C10', 'C01', 'C20', 'C11', 'C02')
    """
    if isinstance(law, LawSpec):
        return law
    name = law if isinstance(law, str) else re.sub(r"(?<!^)(?=[A-Z])", "-", law.__name__)
    plain = re.sub(r"[\s_]+", "-", name.strip().lower())
    kind, _, count = plain.rpartition("-") if plain[-1:].isdigit() else (plain, "", "")
    order = int(count) if count.isdigit() else 0
    if kind in ("ogden", "rivlin", "generalized-rivlin") and not count:
        raise TurgorError(f"'{name}' comes with any number of terms; say how many, for example '{kind}-3'.")
    if count and not 1 <= order <= LARGEST_ORDER:
        raise TurgorError(f"'{name}' asks for order {order}; allowed is 1 to {LARGEST_ORDER}.")
    if kind == "ogden":
        return _ogden(order)
    if kind in ("rivlin", "generalized-rivlin"):
        return _rivlin(order)
    if kind == "yeoh":
        return _yeoh(order or 3)
    if plain not in _FIXED:
        hint = near_match(plain, [*_FIXED, "yeoh", "ogden-3", "rivlin-2"]) or "."
        raise TurgorError(f"unknown law '{name}'{hint} Known: {', '.join(KNOWN)}.")
    return _FIXED[plain]()


def shape_bounds(spec: LawSpec, largest_invariant: float) -> tuple[tuple[float, float], ...]:
    """Bounds of the shape parameters.

    Parameters
    ----------
    spec : LawSpec
        The law.
    largest_invariant : float [-]
        Largest I₁ that the law must bear; Gent's law ends at I₁ − 3 = Jm.
    """
    low, high = spec.bounds
    if spec.name == "gent":
        low = 1.001 * (largest_invariant - 3.0)
        high = max(high, 100 * low)
    return ((low, high),) * len(spec.shapes)


def _neo_hooke() -> LawSpec:
    return LawSpec(name="neo-hooke", coefficients=("C10",), make=lambda c, _: laws.NeoHooke(C10=float(c[0])))


def _mooney_rivlin() -> LawSpec:
    def make(c: Sequence[float], _: Sequence[float]) -> Any:
        return laws.MooneyRivlin(C10=float(c[0]), C01=float(c[1]))

    return LawSpec(name="mooney-rivlin", coefficients=("C10", "C01"), make=make)


def _yeoh(order: int) -> LawSpec:
    names = tuple(f"C{i}0" for i in range(1, order + 1))

    def make(c: Sequence[float], _: Sequence[float]) -> Any:
        values = [float(value) for value in c]
        if order <= 3:
            return laws.Yeoh(**dict(zip(names, values, strict=True)) | ({"C20": 0.0} if order == 1 else {}))
        return laws.YeohN(coefficients=tuple(values))

    return LawSpec(name="yeoh" if order == 3 else f"yeoh-{order}", coefficients=names, make=make)


def _rivlin(order: int) -> LawSpec:
    pairs = [(total - j, j) for total in range(1, order + 1) for j in range(total + 1)]
    names = tuple(f"C{i}{j}" for i, j in pairs)

    def make(c: Sequence[float], _: Sequence[float]) -> Any:
        values = dict(zip(names, map(float, c), strict=True))
        return laws.GeneralizedRivlin.from_names(values)

    return LawSpec(name=f"rivlin-{order}", coefficients=names, make=make)


def _ogden(terms: int) -> LawSpec:
    def make(c: Sequence[float], shapes: Sequence[float]) -> Any:
        mu, alpha = tuple(map(float, c)), tuple(map(float, shapes))
        return laws.Ogden(mu=mu, alpha=alpha)

    numbers = range(1, terms + 1)
    return LawSpec(
        name=f"ogden-{terms}",
        coefficients=tuple(f"mu{i}" for i in numbers),
        shapes=tuple(f"alpha{i}" for i in numbers),
        make=make,
        sign="shape",
        bounds=(-12.0, 18.0),
    )


def _with_limit(kind: str, shape: str, bounds: tuple[float, float], name: str) -> LawSpec:
    def make(c: Sequence[float], shapes: Sequence[float]) -> Any:
        return getattr(laws, kind)(**{"mu": float(c[0]), shape: float(shapes[0])})

    return LawSpec(name=name, coefficients=("mu",), shapes=(shape,), make=make, sign="positive", bounds=bounds)


_FIXED: dict[str, Callable[[], LawSpec]] = {
    "neo-hooke": _neo_hooke,
    "mooney-rivlin": _mooney_rivlin,
    "gent": partial(_with_limit, "Gent", "Jm", (0.1, 1000.0), "gent"),
    "arruda-boyce": partial(_with_limit, "ArrudaBoyce", "locking_stretch", (1.05, 50.0), "arruda-boyce"),
}

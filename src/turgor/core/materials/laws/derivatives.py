"""First and second derivatives of a law's energy, derived from the one place where it is written."""

import inspect
from collections.abc import Callable, Iterator
from dataclasses import fields
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.core.materials.laws.derived_formulas import cached_formulas
from turgor.core.materials.laws.laws import InvariantLaw, Law
from turgor.foundation.errors import TurgorError
from turgor.foundation.symmetric import PAIRS

Array = NDArray[np.float64]

#: Pairs of stretches by which the second derivatives are taken, in this order everywhere.
STRETCH_PAIRS = PAIRS


def energy_and_derivatives(law: InvariantLaw, I1: Array, I2: Array) -> tuple[Array, ...]:
    """Return W, ∂W/∂Ī₁, ∂W/∂Ī₂, ∂²W/∂Ī₁², ∂²W/∂Ī₁∂Ī₂, ∂²W/∂Ī₂² as arrays of the shape of ``I1``.

    Parameters
    ----------
    law : InvariantLaw
        Any law with an ``energy(I1, I2)``.
    I1, I2 : array [-]
        Isochoric invariants.

    Returns
    -------
    tuple of six arrays [Pa]
        Not numbers where the energy is none, as beyond the locking stretch of `Gent`.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> W = energy_and_derivatives(Yeoh(C10=2.0, C20=0.5), np.array([4.0]), np.array([4.0]))
    >>> [float(w[0]) for w in W]
    [2.5, 3.0, 0.0, 1.0, 0.0, 0.0]
    """
    return _evaluate(_invariant_derivatives, law, (I1, I2))


def energy_derivatives(law: InvariantLaw, I1: Array, I2: Array) -> tuple[Array, ...]:
    """Return ∂W/∂Ī₁, ∂W/∂Ī₂, ∂²W/∂Ī₁², ∂²W/∂Ī₁∂Ī₂, ∂²W/∂Ī₂² [Pa]; see `energy_and_derivatives`."""
    return energy_and_derivatives(law, I1, I2)[1:]


def stretch_derivatives(law: Law, l1: Array, l2: Array, l3: Array) -> tuple[Array, ...]:
    """Return W, its three first derivatives by the stretches, and the second ones in the order of `STRETCH_PAIRS`.

    The stretches count as independent: their product is not prescribed here. Invariants of a law written in
    these are I₁ = Σ λᵢ² and I₂ = Σ λᵢ²λⱼ².

    Parameters
    ----------
    law : Law
        Any law, in invariants or in stretches.
    l1, l2, l3 : array [-]
        Isochoric principal stretches.

    Returns
    -------
    tuple of ten arrays [Pa]
        Not numbers where the energy is none.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Ogden
    >>> one = np.ones(1)
    >>> W = stretch_derivatives(Ogden(mu=(3.0,), alpha=(2.0,)), 2 * one, one, one / 2)
    >>> [float(w[0]) for w in W[:5]]
    [3.375, 6.0, 3.0, 1.5, 3.0]
    """
    return _evaluate(_stretch_derivatives, law, (l1, l2, l3))


def _evaluate(compiled: Callable[..., Any], law: Law, at: tuple[Array, ...]) -> tuple[Array, ...]:
    stored = [getattr(law, field.name) for field in fields(law)]  # type: ignore[arg-type]
    function = compiled(type(law), tuple(_pattern(value) for value in stored))
    parameters = [number for value in stored for number in _numbers(value)]
    shape = np.shape(at[0])
    if not _takes_log(type(law)):
        return tuple(_shaped(w, shape) for w in function(*at, *parameters))
    with np.errstate(invalid="ignore", divide="ignore"):
        values = [np.asarray(w, dtype=np.float64) for w in function(*at, *parameters)]
    defined = np.isfinite(values[0])  # beyond its domain the energy has no derivative, though the formula may have one
    return tuple(np.where(defined, np.broadcast_to(w, shape), np.nan) for w in values)


def _shaped(w: Any, shape: tuple[int, ...]) -> Array:
    """A value as an array of a shape; most have it already."""
    if isinstance(w, np.ndarray) and w.shape == shape and w.dtype == np.float64:
        return w
    return np.broadcast_to(np.asarray(w, dtype=np.float64), shape)


@cache
def _invariant_derivatives(law_type: type, pattern: tuple[Any, ...]) -> Callable[..., tuple[Any, ...]]:
    """Derivatives of the energy of a law type by the invariants, its parameters being arguments."""
    return cached_formulas(law_type, ("invariants", pattern), lambda: _derived_by_invariants(law_type, pattern))


def _derived_by_invariants(law_type: type, pattern: tuple[Any, ...]) -> Callable[..., tuple[Any, ...]]:
    """Differentiate with SymPy, the parameters as symbols."""
    import sympy  # slow to load, and not needed where all was derived before

    require_isotropic(law_type)
    I = sympy.symbols("I1 I2", positive=True)
    law, symbols = _symbolic(law_type, pattern)
    energy = law.energy(*I, **_functions(law_type))
    orders = ((0,), (1,), (0, 0), (0, 1), (1, 1))
    derivatives = [energy, *(sympy.diff(energy, *(I[k] for k in order)) for order in orders)]
    return sympy.lambdify([*I, *symbols], derivatives, modules="numpy", cse=True)


@cache
def _stretch_derivatives(law_type: type, pattern: tuple[Any, ...]) -> Callable[..., tuple[Any, ...]]:
    """Derivatives of the energy of a law type by the three stretches, its parameters being arguments."""
    return cached_formulas(law_type, ("stretches", pattern), lambda: _derived_by_stretches(law_type, pattern))


def _derived_by_stretches(law_type: type, pattern: tuple[Any, ...]) -> Callable[..., tuple[Any, ...]]:
    """Differentiate with SymPy, the parameters as symbols."""
    import sympy

    require_isotropic(law_type)
    l = sympy.symbols("l1 l2 l3", positive=True)
    law, symbols = _symbolic(law_type, pattern)
    if hasattr(law_type, "energy_of_stretches"):
        energy = law.energy_of_stretches(*l, **_functions(law_type))
    else:
        squares = [stretch**2 for stretch in l]
        I2 = squares[0] * squares[1] + squares[1] * squares[2] + squares[0] * squares[2]
        energy = law.energy(sum(squares), I2, **_functions(law_type))
    orders = [(0,), (1,), (2,), *STRETCH_PAIRS]
    derivatives = [energy, *(sympy.diff(energy, *(l[k] for k in order)) for order in orders)]
    return sympy.lambdify([*l, *symbols], derivatives, modules="numpy", cse=True)


def require_isotropic(law_type: type) -> None:
    """Refuse laws with directions: all that is derived here is isotropic."""
    if hasattr(law_type, "families"):
        raise TurgorError(
            f"{law_type.__name__} has directions, so its stress is no function of stretches alone; finite elements "
            "take it, this does not."
        )


def _symbolic(law_type: type, pattern: tuple[Any, ...]) -> tuple[Any, list[Any]]:
    """A law whose numbers are symbols, and these in order; its exponents, which are whole, stay."""
    import sympy

    law: Any = object.__new__(law_type)  # symbols have no sign to check, so the checks of the constructor are skipped
    symbols: list[Any] = []

    def build(part: Any) -> Any:
        if isinstance(part, tuple):
            return tuple(build(each) for each in part)
        if part is None:
            symbols.append(sympy.Symbol(f"c{len(symbols)}", real=True))
            return symbols[-1]
        return part

    for field, part in zip(fields(law_type), pattern, strict=True):
        object.__setattr__(law, field.name, build(part))
    return law, symbols


def _pattern(value: Any, inside: bool = False) -> Any:
    """The form of a parameter: None for a number, a tuple for several; a whole number in a tuple is an exponent."""
    if isinstance(value, tuple):
        return tuple(_pattern(each, inside=True) for each in value)
    return value if inside and isinstance(value, int) else None


def _numbers(value: Any, inside: bool = False) -> Iterator[float]:
    """The numbers of a parameter in the order of the symbols."""
    if isinstance(value, tuple):
        for each in value:
            yield from _numbers(each, inside=True)
    elif not (inside and isinstance(value, int)):
        yield value


@cache
def _takes_log(law_type: Any) -> bool:
    written = law_type.energy_of_stretches if hasattr(law_type, "energy_of_stretches") else law_type.energy
    return "log" in inspect.signature(written).parameters


def _functions(law_type: type) -> dict[str, Any]:
    import sympy

    return {"log": sympy.log} if _takes_log(law_type) else {}

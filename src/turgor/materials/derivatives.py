"""First and second derivatives of a law's energy, derived from the one place where it is written."""

from collections.abc import Callable
from dataclasses import fields
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor.materials.laws import Law

Array = NDArray[np.float64]


@cache
def _compiled_derivatives(law_type: type) -> Callable[..., tuple[Any, ...]]:
    """Differentiate the energy of a law type with SymPy, its parameters kept as symbols."""
    import sympy  # 0.4 s: only paid by those who solve

    I1, I2 = sympy.symbols("I1 I2", positive=True)
    names = [field.name for field in fields(law_type)]
    symbols = sympy.symbols(names)
    law: Any = object.__new__(law_type)  # symbols have no sign to check, so the checks of the constructor are skipped
    for name, symbol in zip(names, symbols, strict=True):
        object.__setattr__(law, name, symbol)
    energy = law.energy(I1, I2)
    wanted = [energy, *(sympy.diff(energy, *by) for by in ((I1,), (I2,), (I1, I1), (I1, I2), (I2, I2)))]
    return sympy.lambdify([I1, I2, *symbols], wanted, modules="numpy", cse=True)


def energy_and_derivatives(law: Law, I1: Array, I2: Array) -> tuple[Array, ...]:
    """Return W, ∂W/∂Ī₁, ∂W/∂Ī₂, ∂²W/∂Ī₁², ∂²W/∂Ī₁∂Ī₂, ∂²W/∂Ī₂² as arrays of the shape of ``I1``.

    Parameters
    ----------
    law : Law
        Any law with an ``energy(I1, I2)``.
    I1, I2 : array [-]
        Isochoric invariants.

    Returns
    -------
    tuple of six arrays [Pa]

    Examples
    --------
    >>> from turgor.materials.laws import Yeoh
    >>> W = energy_and_derivatives(Yeoh(C10=2.0, C20=0.5), np.array([4.0]), np.array([4.0]))
    >>> [float(w[0]) for w in W]
    [2.5, 3.0, 0.0, 1.0, 0.0, 0.0]
    """
    function = _compiled_derivatives(type(law))
    values = function(I1, I2, *(getattr(law, field.name) for field in fields(law)))  # type: ignore[arg-type]
    return tuple(np.broadcast_to(np.asarray(value, dtype=np.float64), I1.shape) for value in values)


def energy_derivatives(law: Law, I1: Array, I2: Array) -> tuple[Array, ...]:
    """Return ∂W/∂Ī₁, ∂W/∂Ī₂, ∂²W/∂Ī₁², ∂²W/∂Ī₁∂Ī₂, ∂²W/∂Ī₂² [Pa]; see `energy_and_derivatives`."""
    return energy_and_derivatives(law, I1, I2)[1:]

"""LawSpec: how a fit makes a law from numbers, derived from the fields of its class."""

from collections.abc import Callable, Sequence
from dataclasses import Field, dataclass, fields
from typing import Any, TypeAlias

from turgor.foundation.errors import TurgorError

#: Smallest and largest value of a shape parameter, or a function that gives both from the largest I₁ to be borne.
Bounds: TypeAlias = tuple[float, float] | Callable[[float], tuple[float, float]]


@dataclass(frozen=True, slots=True, kw_only=True)
class LawSpec:
    """How a law is made from a vector of numbers, and which values these may have.

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
        Constraint that keeps the law stable: ``"slope"`` (the stress rises), ``"positive"`` (coefficients are
        positive) or ``"shape"`` (coefficients have the sign of their shape).
    bounds : (float, float) or callable, or a tuple of them
        Smallest and largest value of a shape; ``bounds(I1)`` where they depend on the largest invariant I₁. A tuple
        has those of each shape.
    """

    name: str
    coefficients: tuple[str, ...]
    shapes: tuple[str, ...] = ()
    make: Callable[[Sequence[float], Sequence[float]], Any]
    sign: str = "slope"
    bounds: Bounds | tuple[Bounds, ...] = (0.0, 0.0)

    @property
    def names(self) -> tuple[str, ...]:
        """All parameters, coefficients first."""
        return (*self.coefficients, *self.shapes)


def is_dimensionless(parameter: Field[Any]) -> bool:
    """Return whether a field of a law carries no unit: ``field(metadata={"dimension": "number"})``."""
    return parameter.metadata.get("dimension") == "number"


def spec_of_fields(kind: type[Any], name: str) -> LawSpec:
    """Derive the spec of a law from its fields.

    Fields with a unit are coefficients. A field without one is a shape parameter and states its bounds:
    ``field(metadata={"dimension": "number", "bounds": (0.1, 10.0)})``. Coefficients of a law with shapes are positive.

    Parameters
    ----------
    kind : type
        A law, linear in its coefficients.
    name : str
        Name of the spec.

    Returns
    -------
    LawSpec

    Raises
    ------
    TurgorError
        If the fields do not say how to fit the law.

    Examples
    --------
    >>> from turgor.core.materials.laws.energies.gent import Gent
    >>> spec = spec_of_fields(Gent, "gent")
    >>> spec.coefficients, spec.shapes, spec.sign
    (('mu',), ('Jm',), 'positive')
    """
    coefficients = tuple(item.name for item in fields(kind) if not is_dimensionless(item))
    shapes = [item for item in fields(kind) if is_dimensionless(item)]
    if not coefficients:
        raise TurgorError(f"{kind.__name__} cannot be fitted: it needs coefficients in Pa.")
    for item in shapes:
        if "bounds" not in item.metadata:
            raise TurgorError(
                f"{kind.__name__}: {item.name} states no bounds; a fit needs them in the field's metadata."
            )

    def make(c: Sequence[float], s: Sequence[float]) -> Any:
        return kind(**dict(zip((*coefficients, *(item.name for item in shapes)), map(float, (*c, *s)), strict=True)))

    if not shapes:
        return LawSpec(name=name, coefficients=coefficients, make=make)
    bounds = tuple(item.metadata["bounds"] for item in shapes)
    names = tuple(item.name for item in shapes)
    return LawSpec(name=name, coefficients=coefficients, shapes=names, make=make, sign="positive", bounds=bounds)

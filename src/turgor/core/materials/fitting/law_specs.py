"""Laws that can be fitted, found by name or by class."""

import re
from dataclasses import replace
from typing import Any

from turgor.core.materials.fitting.settings import FIT
from turgor.core.materials.laws.law_spec import LawSpec, spec_of_fields
from turgor.core.materials.laws.laws import LAWS, Hyperfoam
from turgor.core.materials.laws.names import spelled
from turgor.foundation.errors import TurgorError, near_match


def law_spec(law: str | type[Any] | LawSpec) -> LawSpec:
    """Find the spec of a law by its name or its class.

    Parameters
    ----------
    law : str, type or LawSpec
        A name such as ``"yeoh"`` or ``"ogden-3"``, or a class such as ``Yeoh``. Ogden's law and the generalized Rivlin
        law need their number of terms or order, so ask for them by name; ``"hyperfoam-2 nu=0.1"`` states Poisson's
        ratio, too, which is 0 without.

    Examples
    --------
    >>> law_spec("ogden-2").names
    ('mu1', 'mu2', 'alpha1', 'alpha2')
    >>> law_spec("rivlin-2").names
    ('C10', 'C01', 'C20', 'C11', 'C02')
    """
    if isinstance(law, LawSpec):
        return law
    if isinstance(law, type):
        name = re.sub(r"(?<!^)(?=[A-Z])", "-", law.__name__).lower()
        return _of_series(law, name, "") if hasattr(law, "series") else spec_of_fields(law, name)
    single, series = _fitted_laws()
    one = spelled(law, single)
    if one is not None:
        return spec_of_fields(single[one], one)
    before, _, ratio = law.strip().partition(" nu=")
    words, order = re.fullmatch(r"(.*?)([0-9]*)", before.strip(), re.DOTALL).groups()  # type: ignore[union-attr]
    kind = spelled(words, series)
    if kind is not None:
        return _with_ratio(series[kind], _of_series(series[kind], before, order), ratio)
    oriented = spelled(law, [name for name, each in LAWS.items() if hasattr(each, "families")])
    if oriented is not None:
        raise TurgorError(
            f"{LAWS[oriented].__name__} has directions and needs specimens that were cut along them: fit it with "
            "fit_directions in Python, --directions on the command line, without relaxation."
        )
    if spelled(law, ["woven"]) is not None:
        raise TurgorError(
            "a woven fabric needs strips along warp, weft and bias: fit it with fit_woven in Python, --directions "
            "warp,weft,bias on the command line."
        )
    known = [*single, *(f"{each.series}-N" for each in dict.fromkeys(series.values()))]
    hint = near_match(re.sub(r"[\s_]+", "-", law.strip().lower()), [*single, *(f"{name}-3" for name in series)]) or "."
    raise TurgorError(f"unknown law '{law}'{hint} Known: {', '.join(sorted(known))}.")


def shape_bounds(spec: LawSpec, largest_invariant: float) -> tuple[tuple[float, float], ...]:
    """Return the bounds of each shape parameter.

    Parameters
    ----------
    spec : LawSpec
        The law.
    largest_invariant : float [-]
        Largest I₁ at which the law must have a stress; Gent's law ends at I₁ − 3 = Jm.
    """
    each: Any = spec.bounds if isinstance(spec.bounds, tuple) and not _is_pair(spec.bounds) else (spec.bounds,)
    pairs = tuple(bounds(largest_invariant) if callable(bounds) else bounds for bounds in each)
    return pairs if len(pairs) == len(spec.shapes) else pairs * len(spec.shapes)


def _is_pair(bounds: tuple[Any, ...]) -> bool:
    return len(bounds) == 2 and all(isinstance(edge, int | float) for edge in bounds)


def _fitted_laws() -> tuple[dict[str, type[Any]], dict[str, type[Any]]]:
    """Laws that can be fitted, by name: those with fixed parameters, and those with any number of terms."""
    single: dict[str, type[Any]] = {}
    series: dict[str, type[Any]] = {}
    for name, kind in LAWS.items():
        if not hasattr(kind, "energy") and not hasattr(kind, "energy_of_stretches"):
            continue  # Hooke's law of stiff parts
        if hasattr(kind, "series"):
            series |= {kind.series: kind, name.replace("_", "-"): kind}
        else:
            single[name.replace("_", "-")] = kind
    return single, series


def _with_ratio(kind: Any, spec: LawSpec, ratio: str) -> LawSpec:
    """Spec of a law of foams with a stated Poisson's ratio; any other law has none to state."""
    if not ratio:
        return spec
    if kind is not Hyperfoam:
        raise TurgorError(f"'{spec.name} nu={ratio}': only hyperfoam has a Poisson's ratio nu that a fit is given.")
    try:
        stated = kind.fit_spec(len(spec.coefficients), nu=float(ratio))
    except ValueError:
        raise TurgorError(f"'{spec.name} nu={ratio}': nu is {ratio!r}; a number is needed.") from None
    return replace(stated, name=f"{spec.name} nu={ratio}")


def _of_series(kind: Any, name: str, order: str) -> LawSpec:
    """Spec of a law with a stated number of terms, made by the class of the law."""
    if not order:
        example = f"{kind.series}-3"
        raise TurgorError(f"'{name}' comes with any number of terms; say how many, for example '{example}'.")
    if not 1 <= int(order) <= FIT.largest_order:
        raise TurgorError(f"'{name}' has order {int(order)}; allowed is 1 to {FIT.largest_order}.")
    spec: LawSpec = kind.fit_spec(int(order))
    return spec

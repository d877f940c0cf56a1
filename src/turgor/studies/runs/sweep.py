"""sweep: a function computed at many designs, one after another or in many processes."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.foundation.source import Source
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.designs import Designs, factorial
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.run import Computed, with_values
from turgor.studies.runs.study import Row, Study, values_text

Function = Callable[..., Response | Computed]

#: Units in which dimensions of designs are shown, by what they measure.
SHOWN_IN = {"length": "mm", "angle": "deg", "pressure": "kPa", "density": "kg/m³"}


def sweep(
    function: Function,
    design: Any = None,
    designs: Designs | None = None,
    *,
    evaluations: Evaluations | None = None,
    **levels: Sequence[Value],
) -> Study:
    """Compute a function at many designs.

    Parameters
    ----------
    function : callable
        Function of a module that takes a design, such as an actuator, and returns a `Response`; without a design it
        takes the factors as keywords.
    design : dataclass or dict, optional
        What does not vary: a dataclass whose fields are the factors, or further arguments by name.
    designs : Designs, optional
        Points to compute at, from `turgor.studies.latin_hypercube`, `sobol`, `factorial` or `read_designs`.
    evaluations : Evaluations, optional
        Where runs are computed and saved, such as ``turgor.studies.saved_in("folder", processes=4)``; by default in
        this process, without files. With a folder, a sweep that was killed goes on where it was.
    **levels : sequence of float, int or str [SI]
        Levels of each factor, by its name, for a full factorial; instead of ``designs``. A dictionary gives names with
        points: ``**{"law.C10": [0.1e6, 0.2e6]}``.

    Returns
    -------
    Study
        A row for each design; one that failed has the sentence that says why.

    Raises
    ------
    TurgorError
        If there is nothing to vary, or the design has no such field.

    Examples
    --------
    A thick-walled sphere whose wall and pressure vary:

    >>> import numpy as np
    >>> import turgor as tg
    >>> from turgor.units import kPa, mm
    >>> def inflated(sphere):
    ...     rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6))
    ...     return tg.formulas.thick_sphere(sphere, rubber, np.linspace(1 * kPa, 20 * kPa, 20))
    >>> sphere = tg.formulas.HollowSphere(inner_radius=10 * mm, wall=2 * mm)
    >>> study = tg.sweep(inflated, sphere, wall=[1 * mm, 2 * mm, 4 * mm])
    >>> study.column("inner_stretch", at=("pressure", 20 * kPa)).round(3)
    array([1.195, 1.076, 1.044])
    """
    requested = _designs(design, designs, levels)
    computation = _computation(function, design, requested)
    return study_of(computation, requested, evaluations or Evaluations(), Source(text=_source_text(function)))


def study_of(computation: Computation, designs: Designs, evaluations: Evaluations, source: Source) -> Study:
    """Compute designs and return them as a study.

    Parameters
    ----------
    computation : Computation
    designs : Designs
    evaluations : Evaluations
    source : Source

    Returns
    -------
    Study
    """
    ended = evaluations.of([computation.run(each, name=values_text(designs.factors, each)) for each in designs.values])
    rows = tuple(Row(values=values, ended=each) for values, each in zip(designs.values, ended, strict=True))
    return Study(factors=designs.factors, rows=rows, source=source)


def _designs(design: Any, designs: Designs | None, levels: Mapping[str, Sequence[Value]]) -> Designs:
    if (designs is None) != bool(levels):
        raise TurgorError("a sweep needs either levels, such as wall=[1e-3, 2e-3], or designs.")
    if designs is not None:
        return designs
    return factorial([factor_of(name, values, design) for name, values in levels.items()])


def factor_of(name: str, levels: Sequence[Value], design: Any = None) -> Factor:
    """Return the factor of a field of a design, with the unit in which the field is shown.

    Parameters
    ----------
    name : str
        With points for fields of a dataclass within the design.
    levels : sequence of float, int or str [SI]
    design : dataclass, optional

    Returns
    -------
    Factor

    Raises
    ------
    TurgorError
        If there is no level.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> factor_of("wall", [1e-3, 2e-3], FastPneuNet()).unit
    'mm'
    """
    if isinstance(levels, str) or not hasattr(levels, "__iter__"):
        raise TurgorError(f"levels of '{name}' are {levels!r}; give a list, such as [{levels!r}].")
    plain: list[Value] = [each.item() if hasattr(each, "item") else each for each in levels]  # of NumPy
    whole = all(isinstance(each, int) for each in plain) and _holds_whole(design, name)
    if not plain:
        raise TurgorError(f"levels of '{name}' are empty; give a list of values.")
    return Factor(name=name, levels=tuple(plain), unit="" if whole else _unit(design, name), whole=whole)


def _holds_whole(design: Any, name: str) -> bool:
    """Whether a field holds whole numbers; without a design, whole levels are taken as they are."""
    owner, last = _owner(design, name)
    if owner is None:
        return True
    return isinstance(getattr(owner, last, 0), int)


def _unit(design: Any, name: str) -> str:
    owner, last = _owner(design, name)
    if owner is None:
        return ""
    for item in fields(owner):
        if item.name == last and item.type in (float, float | None):
            # lengths of actuators are fields without a note; those of other dataclasses may be anything
            default = "length" if hasattr(owner, "build") else ""
            return SHOWN_IN.get(item.metadata.get("dimension", default), "")
    return ""


def _owner(design: Any, name: str) -> tuple[Any, str]:
    """The dataclass that has a field, and the name there; None where there is no dataclass."""
    *path, last = name.split(".")
    for part in path:
        design = getattr(design, part, None)
    return (design, last) if is_dataclass(design) and not isinstance(design, type) else (None, last)


def _computation(function: Function, design: Any, designs: Designs) -> Computation:
    if design is None or isinstance(design, Mapping):
        return Computation(function=function, values=dict(design or {}))
    first = {name: _field(design, name) for name in designs.values[0]} if designs.values else {}
    with_values(design, first)  # an unknown field is a mistake of all designs, not a failed run of each
    return Computation(function=function, design=design)


def _field(design: Any, name: str) -> Any:
    for part in name.split("."):
        design = getattr(design, part, None)
    return design


def _source_text(function: Function) -> str:
    return f"sweep of {function.__module__}.{function.__qualname__}"

"""Full factorials of guidelines that rank dimensions: each dimension smaller and larger, analyzed by `anova`."""

from collections.abc import Mapping, Sequence
from itertools import product

import turgor as tg
from turgor.studies import Anova, Computed, Ended, Factor, Row, Run, Study, anova
from turgor.units import kPa
from turgor_guidelines.guideline import Runs
from turgor_guidelines.judging import line_of
from turgor_guidelines.values import Value

#: Factors by which each dimension is multiplied.
LEVELS = (0.9, 1.1)


def corners(names: Sequence[str]) -> tuple[dict[str, float], ...]:
    """Return all combinations of dimensions a tenth smaller and larger.

    Parameters
    ----------
    names : sequence of str

    Returns
    -------
    tuple of dict of str to float

    Examples
    --------
    >>> corners(["wall", "gap"])[1], len(corners(["wall", "gap"]))
    ({'wall': 0.9, 'gap': 1.1}, 4)
    """
    return tuple(dict(zip(names, each, strict=True)) for each in product(LEVELS, repeat=len(names)))


def corner_name(scales: Mapping[str, float]) -> str:
    """Return the name of the run of a corner."""
    return ", ".join(f"{name} x {scale:g}" for name, scale in scales.items())


def analyses(runs: Runs, names: Sequence[str], pressures: Sequence[float]) -> dict[float, Anova]:
    """Return the analysis of variance of the bending angle at each pressure [kPa]."""
    factors = tuple(Factor(name=name, levels=LEVELS) for name in names)
    rows = []
    for scales in corners(names):
        name = corner_name(scales)
        ended = Ended(run=Run(name=name, function=Computed, values=scales), result=runs[name])
        rows.append(Row(values=scales, ended=ended))
    study = Study(factors=factors, rows=tuple(rows), source=tg.laws.Source(text="runs of a guideline"))
    return {each: anova(study, "bending_angle", at=("pressure", each * kPa)) for each in pressures}


def shares_text(tables: Mapping[float, Anova]) -> str:
    """Return the shares of the variance at each pressure, in words."""
    return "; ".join(f"{pressure:g} kPa: {each.sentence().rstrip('.')}" for pressure, each in tables.items())


def share_lines(tables: Mapping[float, Anova]) -> list[tg.pictures.Line]:
    """Return bars of the shares [%] of dimensions and pairs at each pressure."""
    return [
        line_of(
            [term.name for term in each.terms], [Value(100 * term.share) for term in each.terms], f"{pressure:g} kPa"
        )
        for pressure, each in tables.items()
    ]

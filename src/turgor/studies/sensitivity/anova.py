"""anova: the variance of a factorial study divided among its factors and pairs of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import prod

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2, f

from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column
from turgor.studies.runs.factor import Factor, Value
from turgor.studies.runs.rounding import percent
from turgor.studies.runs.settings import RUNS
from turgor.studies.runs.study import Study

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Term:
    """A line of an analysis of variance.

    Parameters
    ----------
    factors : tuple of str
        One name of a main effect, two of an interaction.
    squares : float
        Sum of squares that it explains.
    freedom : int
        Degrees of freedom.
    share : float
        Sum of squares over the total.
    F, p : float
        Mean square over that of the error, and the probability of so large an F where the term has no effect; NaN
        where there is no error term.
    """

    factors: tuple[str, ...]
    squares: float
    freedom: int
    share: float
    F: float
    p: float

    @property
    def name(self) -> str:
        """Names of the factors with a cross between them."""
        return " × ".join(self.factors)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Anova:
    """An analysis of variance.

    Parameters
    ----------
    measure, unit : str
        What was analyzed.
    terms : tuple of Term
        Main effects in the order of the factors, then interactions of two.
    means : mapping of str to dict
        Mean of the measure [SI] at each level of each factor.
    remainder : Term
        What the terms leave: interactions of three and more, and scatter.
    total : float
        Sum of squares about the mean [SI²].
    error : str
        What F compares with, in words; empty where there is nothing.
    rows, left_out : int
        Rows that were analyzed, and those without a value.
    """

    measure: str
    unit: str
    terms: tuple[Term, ...]
    means: Mapping[str, Mapping[Value, float]]
    remainder: Term
    total: float
    error: str
    rows: int
    left_out: int

    @property
    def ranking(self) -> tuple[str, ...]:
        """Names of the factors, the one with the largest share first."""
        main = [each for each in self.terms if len(each.factors) == 1]
        return tuple(each.name for each in sorted(main, key=lambda each: -each.share))

    def term(self, *factors: str) -> Term:
        """Return the line of a factor, or of two."""
        for each in self.terms:
            if set(each.factors) == set(factors):
                return each
        raise TurgorError(
            f"the analysis has no term {' × '.join(factors)}; it has {', '.join(t.name for t in self.terms)}."
        )

    def effect(self, factor: str) -> float:
        """Return the mean at the last level of a factor less that at the first [SI]."""
        means = list(self.means[self.term(factor).name].values())
        return means[-1] - means[0]

    def sentence(self) -> str:
        """Return the ranking with shares in a sentence."""
        shares = ", ".join(f"{name} {percent(self.term(name).share)} %" for name in self.ranking)
        pairs = sum(each.share for each in self.terms if len(each.factors) == 2)
        rest = f", pairs {percent(pairs)} %" if any(len(each.factors) == 2 for each in self.terms) else ""
        return f"{Column(self.measure, '', np.zeros(1)).words}: {shares}{rest}, rest {percent(self.remainder.share)} %."

    def table(self) -> str:
        """Return the lines as text."""
        every = (*self.terms, self.remainder)
        width = max(len(each.name) for each in every)
        lines = [f"{'':{width}}  sum of squares  df    share          F         p"]
        for each in every:
            tested = "" if np.isnan(each.F) else f"{each.F:11.3g}{each.p:10.2g}"
            share = f"{100 * each.share:7.2f} %"
            lines.append(f"{each.name:{width}}{each.squares:16.4g}{each.freedom:4d}{share}{tested}")
        if self.error:
            lines.append(f"F compares with {self.error}.")
        if self.left_out:
            lines.append(f"{self.left_out} rows have no value and were left out.")
        return "\n".join(lines)


def anova(study: Study, measure: str, *, at: tuple[str, float] | None = None, interactions: bool = True) -> Anova:
    """Divide the variance of a measure among the factors of a factorial study, and pairs of them.

    Each factor is a category, whatever the distance between its levels. A term is what it explains beyond all terms
    that do not contain it (type II, Langsrud 2003, Stat. Comput. 13, 163); in a complete factorial this is the
    classical sum of squares. The error term of F is the scatter of replicates where designs were computed or measured
    more than once, else the mesh error where the study has one, else what the terms leave.

    Parameters
    ----------
    study : Study
        A factorial; rows without a value are left out.
    measure : str
    at : (str, float), optional
        Column and value [SI] at which it is read; by default the last state.
    interactions : bool
        Whether pairs of factors have terms; without, they are in the remainder.

    Returns
    -------
    Anova

    Raises
    ------
    TurgorError
        If a factor has one level or too many, or the rows cannot tell terms apart.

    Examples
    --------
    >>> from turgor.foundation.response import Response
    >>> from turgor.foundation.source import Source
    >>> from turgor.studies.runs.sweep import sweep
    >>> def angle(wall, gap):
    ...     return Response(columns=(Column("angle", "", [10 - 2 * wall - gap]),), source=Source(text="a formula"))
    >>> result = anova(sweep(angle, wall=[1.0, 2.0], gap=[1.0, 2.0]), "angle")
    >>> result.ranking, round(result.term("wall").share, 3), result.effect("wall")
    (('wall', 'gap'), 0.8, -2.0)
    """
    values = study.column(measure, at)
    known = np.isfinite(values)
    rows = [row.values for row, good in zip(study.rows, known, strict=True) if good]
    y = values[known]
    factors = [each for each in study.factors if len({row[each.name] for row in rows}) > 1]
    codes = {each.name: _codes(each, rows) for each in factors}
    if not factors:
        fixed = ", ".join(each.name for each in study.factors)
        raise TurgorError(f"every factor of the study ({fixed}) has one level only; there is nothing to compare.")
    names = [(each.name,) for each in factors]
    pairs = list(combinations([each.name for each in factors], 2)) if interactions and len(factors) > 1 else []
    squares, freedom, rest = _divided([*names, *pairs], codes, y)
    total = float(((y - y.mean()) ** 2).sum())
    rest = rest if rest > 1e-20 * total else 0.0  # round-off
    rest_freedom = len(y) - 1 - sum(freedom)
    error = _error_term(study.mesh_error(measure, at)[known], rows, [each.name for each in factors], y)
    if error is None:
        error = _Error(rest / rest_freedom, rest_freedom, "what the terms leave") if rest_freedom > 0 else None
    terms = tuple(_term(*each, total, error) for each in zip([*names, *pairs], squares, freedom, strict=True))
    words = ("remainder",)
    remainder = Term(
        factors=words, squares=rest, freedom=rest_freedom, share=rest / total if total else 0.0, F=np.nan, p=np.nan
    )
    means = {each.name: _means(codes[each.name], each, rows, y) for each in factors}
    return Anova(
        measure=measure, unit=study.unit(measure), terms=terms, means=means, remainder=remainder, total=total,
        error="" if error is None else error.words, rows=len(y), left_out=int((~known).sum()),
    )  # fmt: skip


def is_factorial(study: Study) -> bool:
    """Return whether a study has all combinations of few levels, failed rows counted."""
    rows = [row.values for row in study.rows]
    counts = [len({row[each.name] for row in rows}) for each in study.factors]
    designs = {tuple(row[each.name] for each in study.factors) for row in rows}
    return max(counts) <= RUNS.most_levels and len(designs) == prod(counts)


@dataclass(frozen=True, slots=True)
class _Error:
    """Mean square that F compares with, its degrees of freedom (0: known), and its name."""

    square: float
    freedom: int
    words: str


def _codes(factor: Factor, rows: Sequence[Mapping[str, Value]]) -> Array:
    """Deviations from the mean of the levels, (rows, levels - 1)."""
    levels = _levels(factor, rows)
    if len(levels) > RUNS.most_levels:
        raise TurgorError(
            f"'{factor.name}' has {len(levels)} values; an analysis of variance takes a factorial of up to "
            f"{RUNS.most_levels} levels. For samples fit a surrogate and ask for its Sobol indices."
        )
    table = np.zeros((len(rows), len(levels) - 1))
    for number, row in enumerate(rows):
        place = levels.index(row[factor.name])
        table[number] = -1.0 if place == len(levels) - 1 else np.eye(len(levels) - 1)[place]
    return table


def _levels(factor: Factor, rows: Sequence[Mapping[str, Value]]) -> list[Value]:
    values = {row[factor.name] for row in rows}
    if factor.is_choice:
        return [level for level in factor.levels if level in values]
    return sorted(values, key=float)


def _divided(
    terms: Sequence[tuple[str, ...]], codes: Mapping[str, Array], y: Array
) -> tuple[list[float], list[int], float]:
    """Sums of squares and degrees of freedom of terms (type II), and the residual sum of squares."""
    columns = {term: _columns(term, codes) for term in terms}
    full = _matrix([columns[term] for term in terms], len(y))
    if np.linalg.matrix_rank(full) < full.shape[1]:
        raise TurgorError(
            f"{len(y)} rows cannot tell {full.shape[1] - 1} effects apart; compute the missing designs of the "
            "factorial, or leave out interactions."
        )
    squares = []
    for term in terms:
        others = [columns[each] for each in terms if not set(term) <= set(each)]
        squares.append(
            _residual_squares(_matrix(others, len(y)), y)
            - _residual_squares(_matrix([*others, columns[term]], len(y)), y)
        )
    return squares, [columns[term].shape[1] for term in terms], _residual_squares(full, y)


def _columns(term: tuple[str, ...], codes: Mapping[str, Array]) -> Array:
    first = codes[term[0]]
    if len(term) == 1:
        return first
    return np.asarray((first[:, :, None] * codes[term[1]][:, None, :]).reshape(len(first), -1))


def _matrix(parts: Sequence[Array], rows: int) -> Array:
    return np.column_stack([np.ones(rows), *parts])


def _residual_squares(matrix: Array, y: Array) -> float:
    """Sum of squares that a linear model leaves."""
    coefficients = np.linalg.lstsq(matrix, y, rcond=None)[0]
    return float(((y - matrix @ coefficients) ** 2).sum())


def _error_term(mesh: Array, rows: Sequence[Mapping[str, Value]], names: Sequence[str], y: Array) -> "_Error | None":
    """Scatter of replicates, or mean square of the mesh error."""
    designs: dict[tuple[Value, ...], list[float]] = {}
    for row, value in zip(rows, y, strict=True):
        designs.setdefault(tuple(row[name] for name in names), []).append(float(value))
    freedom = len(y) - len(designs)
    if freedom:
        square = sum(float(((np.array(each) - np.mean(each)) ** 2).sum()) for each in designs.values()) / freedom
        return _Error(square, freedom, f"the scatter of replicates, {freedom} degrees of freedom")
    if np.isfinite(mesh).any():
        return _Error(float(np.nanmean(mesh**2)), 0, "the mean square of the mesh error")
    return None


def _term(names: tuple[str, ...], squares: float, freedom: int, total: float, error: _Error | None) -> Term:
    F = p = float("nan")
    if error is not None and error.square > 0:
        F = squares / freedom / error.square
        p = float(f.sf(F, freedom, error.freedom) if error.freedom else chi2.sf(F * freedom, freedom))
    return Term(factors=names, squares=squares, freedom=freedom, share=squares / total if total else 0.0, F=F, p=p)


def _means(codes: Array, factor: Factor, rows: Sequence[Mapping[str, Value]], y: Array) -> dict[Value, float]:
    means = {}
    for level in _levels(factor, rows):
        means[level] = float(np.mean([value for row, value in zip(rows, y, strict=True) if row[factor.name] == level]))
    return means

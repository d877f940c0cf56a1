"""Results of ``turgor surrogate``, ``turgor predict`` and ``turgor sensitivity`` for programs."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.studies.sensitivity.anova import Anova
    from turgor.studies.sensitivity.indices import Indices
    from turgor.studies.surrogates.invert import Inverse
    from turgor.studies.surrogates.surrogate import Prediction, Surrogate


@dataclass(frozen=True, slots=True, kw_only=True)
class SurrogateResult:
    """``turgor surrogate``: what was fitted, in SI units.

    Parameters
    ----------
    rows : int
        Rows of the study that were used.
    factors : list of tables
        ``name``, ``unit``, ``low`` and ``high`` of each input, or ``levels`` of a choice.
    measures : list of tables
        ``name``, ``unit``, and in held-out rows ``rms``, ``worst``, ``share`` of the range, ``r_squared``,
        ``coverage_68`` and ``coverage_95``, ``factor`` of the standard deviations.
    notes : list of str
        What was left out.
    files : list of str
        Files that were written.
    """

    rows: int
    factors: list[dict[str, Any]]
    measures: list[dict[str, Any]]
    notes: Sequence[str]
    files: Sequence[Path]


def surrogate_result(surrogate: "Surrogate", files: Sequence[Path]) -> SurrogateResult:
    """Make the result of a fit."""
    return SurrogateResult(
        rows=surrogate.rows,
        factors=[
            {"name": each.name, "unit": each.unit, "levels": list(each.levels)}
            if each.is_choice
            else {"name": each.name, "unit": each.unit, "low": each.bounds[0], "high": each.bounds[1]}
            for each in surrogate.factors
        ],
        measures=[
            {
                "name": each.name, "unit": each.unit, "rms": each.rms, "worst": each.worst, "share": each.share,
                "r_squared": each.r_squared, "coverage_68": each.coverage[0], "coverage_95": each.coverage[1],
                "factor": each.factor,
            }
            for each in surrogate.held_out
        ],
        notes=surrogate.notes,
        files=files,
    )  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class PredictionResult:
    """``turgor predict``: values with their standard deviations, in SI units.

    Parameters
    ----------
    at : table
        Value of each factor, the unknown ones too.
    values, deviations : table
        Of each measure.
    reached : bool or None
        Whether the target measures are reached; null without a target.
    factor_deviations : table
        Standard deviation of each unknown factor; null where a measure does not depend on it.
    others : list of tables
        Further solutions.
    sentence : str
        The answer in words.
    """

    at: Mapping[str, float | int | str]
    values: Mapping[str, float]
    deviations: Mapping[str, float]
    reached: bool | None
    factor_deviations: Mapping[str, float | None]
    others: Sequence[Mapping[str, float | int | str]]
    sentence: str


def prediction_result(prediction: "Prediction", at: Mapping[str, float | int | str]) -> PredictionResult:
    """Make the result of a prediction."""
    sentence = ", ".join(f"{name.replace('_', ' ')} {prediction.text(name)}" for name in prediction.values)
    return PredictionResult(
        at=at,
        values=prediction.values,
        deviations=prediction.deviations,
        reached=None,
        others=[],
        sentence=sentence,
        factor_deviations={},
    )


def inverse_result(inverse: "Inverse") -> PredictionResult:
    """Make the result of an inverse."""
    unknown = {name: value if value < float("inf") else None for name, value in inverse.deviations.items()}
    return PredictionResult(
        at=inverse.values,
        values=inverse.prediction.values,
        deviations=inverse.prediction.deviations,
        reached=inverse.reached,
        factor_deviations=unknown,
        others=inverse.others,
        sentence=inverse.sentence(),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class SensitivityResult:
    """``turgor sensitivity``: shares of the variance.

    Parameters
    ----------
    method : str
        ``"anova"`` or ``"sobol"``.
    terms : list of tables
        For an analysis of variance ``measure``, ``factors``, ``squares``, ``freedom``, ``share``, ``F`` and ``p``; for
        Sobol indices ``measure``, ``factor``, ``first``, ``total``, the ends of their intervals and ``unexplained``.
    files : list of str
        Files that were written.
    """

    method: str
    terms: list[dict[str, Any]]
    files: Sequence[Path]


def anova_terms(anova: "Anova") -> list[dict[str, Any]]:
    """Return the lines of an analysis of variance."""
    terms = []
    for each in (*anova.terms, anova.remainder):
        line = asdict(each)
        terms.append(
            {"measure": anova.measure} | {key: None if value != value else value for key, value in line.items()}
        )
    return terms


def index_terms(indices: "Indices") -> list[dict[str, Any]]:
    """Return the Sobol indices of each factor."""
    (first_low, first_high), (total_low, total_high) = indices.interval("first"), indices.interval("total")
    return [
        {
            "measure": indices.measure, "factor": name, "first": float(indices.first[n]),
            "first_low": float(first_low[n]), "first_high": float(first_high[n]), "total": float(indices.total[n]),
            "total_low": float(total_low[n]), "total_high": float(total_high[n]), "unexplained": indices.unexplained,
        }
        for n, name in enumerate(indices.factors)
    ]  # fmt: skip

"""Analysis of variance: a table computed by hand, replicates, mesh errors, missing rows, and what is refused."""

import numpy as np
import pytest
from scipy.stats import f_oneway

from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.executors.run_outcome import Ended
from turgor.studies.runs.factor import Factor
from turgor.studies.runs.run import Computed, Run
from turgor.studies.runs.study import Row, Study
from turgor.studies.sensitivity.anova import anova
from turgor.studies.sensitivity.figure import anova_figure

A = Factor(name="a", levels=(1.0, 2.0))
B = Factor(name="b", levels=("x", "y", "z"))

#: Two replicates of a 2 × 3 factorial.
TABLE = {
    (1.0, "x"): (4, 6), (1.0, "y"): (8, 8), (1.0, "z"): (10, 12),
    (2.0, "x"): (6, 8), (2.0, "y"): (14, 14), (2.0, "z"): (10, 8),
}  # fmt: skip


def study_of(values, factors=(A, B), mesh=None):
    """A study of values by design; None is a run that failed."""
    rows = []
    for design, value in values:
        columns = [Column("angle", "deg", [0.0 if value is None else value])]
        if mesh is not None:
            columns.append(Column("angle_mesh_error", "deg", [mesh]))
        result = None if value is None else Computed(response=Response(columns=tuple(columns), source=Source(text="t")))
        named = dict(zip([each.name for each in factors], design, strict=True))
        rows.append(Row(values=named, ended=Ended(run=Run(name="", function=Computed), found=result, problem="no")))
    return Study(factors=tuple(factors), rows=tuple(rows), source=Source(text="t"))


def every(table=TABLE):
    return [(design, value) for design, values in table.items() for value in values]


def test_a_balanced_table_by_hand():
    """Means: a 8, 10; b 6, 11, 10; cells 5 8 11 / 7 14 9. Grand mean 9.

    SS a = 6 (1 + 1) = 12; SS b = 4 (9 + 4 + 1) = 56; SS cells = 2 (16 + 1 + 4 + 4 + 25 + 0) = 100, so a × b is 32;
    SS of replicates = 2 + 0 + 2 + 2 + 0 + 2 = 8, 6 degrees of freedom; total 108.
    """
    result = anova(study_of(every()), "angle")
    assert [(each.name, each.freedom) for each in result.terms] == [("a", 1), ("b", 2), ("a × b", 2)]
    assert [each.squares for each in result.terms] == pytest.approx([12, 56, 32])
    assert (result.remainder.squares, result.remainder.freedom, result.total) == pytest.approx((8, 6, 108))
    assert [each.share for each in result.terms] == pytest.approx([12 / 108, 56 / 108, 32 / 108])
    assert [each.F for each in result.terms] == pytest.approx([12 / (8 / 6), 28 / (8 / 6), 16 / (8 / 6)])
    assert result.error == "the scatter of replicates, 6 degrees of freedom"
    assert result.ranking == ("b", "a")
    assert result.effect("a") == pytest.approx(2)
    assert result.means["b"] == pytest.approx({"x": 6, "y": 11, "z": 10})
    assert "a × b" in result.table()


def test_one_factor_is_that_of_scipy():
    groups = {"x": (4.0, 6.5, 5.0), "y": (8.0, 8.5, 9.0), "z": (7.0, 5.5, 6.0, 6.2)}
    values = [((name,), value) for name, group in groups.items() for value in group]
    result = anova(study_of(values, (B,)), "angle").term("b")
    expected = f_oneway(*groups.values())
    assert (result.F, result.p) == pytest.approx((expected.statistic, expected.pvalue))


def test_missing_rows_make_no_term_larger():
    """Type II of an additive table without scatter: a balanced one and one with a hole say the same effects."""
    values = [((a, b), 3 * a + {"x": 0, "y": 1, "z": 5}[b]) for a in (1.0, 2.0) for b in ("x", "y", "z")]
    holed = [*values[:-1], (values[-1][0], None)]
    result = anova(study_of(holed), "angle", interactions=False)
    assert result.left_out == 1
    assert result.remainder.squares == pytest.approx(0, abs=1e-12)
    # a alone: the two levels differ by 3 at x and y, 4 rows; z has one row
    assert result.term("a").squares == pytest.approx(9)
    with refused("5 rows", "5 effects"):
        anova(study_of(holed), "angle")


def test_without_replicates_the_mesh_error_is_the_error_term():
    values = [(design, both[0]) for design, both in TABLE.items()]
    rough = anova(study_of(values, mesh=2.0), "angle")
    assert rough.error == "the mean square of the mesh error"
    assert rough.term("a").squares / 4 == pytest.approx(rough.term("a").F)
    bare = anova(study_of(values), "angle")
    assert (bare.error, np.isnan(bare.term("a").F)) == ("", True)
    additive = anova(study_of(values), "angle", interactions=False)
    assert additive.error == "what the terms leave"
    assert additive.remainder.freedom == 2


def test_what_cannot_be_analyzed_is_a_sentence():
    c = Factor(name="c", low=0.0, high=1.0)
    with refused("'c'", "20 values", "10 levels"):
        anova(study_of([((n / 20,), n) for n in range(20)], (c,)), "angle")
    with refused("a, b", "level"):
        anova(study_of([((1.0, "x"), 1), ((1.0, "x"), 2)]), "angle")
    with refused("a × c", "a, b, a × b"):
        anova(study_of(every()), "angle").term("a", "c")
    with refused("'angl'", "'angle'"):
        anova(study_of(every()), "angl")


def test_its_figure_names_every_term():
    result = anova(study_of(every()), "angle")
    axes = anova_figure([("4 kPa", result), ("14 kPa", result)]).axes[0]
    assert [each.get_text() for each in axes.get_yticklabels()] == ["a", "b", "a × b", "remainder"]


def test_without_a_replicate_main_effects_are_those_beside_the_other_factor():
    """Type II: of a, with two levels, (Σ w d)² / Σ w, with d its differences within b and w = n₁ n₂/(n₁ + n₂)."""
    values = every()[1:]  # one replicate of (1, x) is missing
    result = anova(study_of(values), "angle")
    differences, weights = np.array([7 - 6, 14 - 8, 9 - 11]), np.array([2 / 3, 1, 1])
    assert result.term("a").squares == pytest.approx((weights @ differences) ** 2 / weights.sum())
    assert result.term("a").squares != pytest.approx(12)

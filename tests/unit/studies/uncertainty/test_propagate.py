"""Propagation of uncertainty: bands, sentences, runs, and what is refused."""

import numpy as np
import pytest

import calibration_cases as cases
from refused import refused
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.studies.runs.computation import Computation
from turgor.studies.runs.evaluations import Evaluations
from turgor.studies.uncertainty.figure import uncertainty_figure
from turgor.studies.uncertainty.propagate import propagate
from turgor.studies.uncertainty.spread import Alternatives, Spread
from turgor.units import kPa, mm

RUBBER = Spread(name="C10", mean=0.12e6, deviation=6e3, label="rubber")
WALL = Spread(name="wall", mean=5 * mm, deviation=0.1 * mm)


def product(a: float, b: float = 1.0, error: float = 0.0) -> Response:
    """y = a b x, with a mesh error."""
    if a < 0.5:
        raise TurgorError("a is below 0.5.")
    x = np.array([0.0, 1e3, 2e3])
    columns = [Column("pressure", "kPa", x), Column("force", "N", a * b * x / 1e3)]
    if error:
        columns.append(Column("force_mesh_error", "N", error * x / 1e3))
    return Response(columns=tuple(columns), source=Source(text="a product"))


def square(a: float) -> Response:
    """y = a² x."""
    x = np.array([0.0, 1e3])
    return Response(
        columns=(Column("pressure", "kPa", x), Column("force", "N", a**2 * x / 1e3)), source=Source(text="a²")
    )


def two_lengths(top: float) -> Response:
    """A path that goes as far as it is told."""
    x = np.linspace(0.0, top, 5)
    return Response(columns=(Column("pressure", "kPa", x), Column("force", "N", x)), source=Source(text="a path"))


A, B = Spread(name="a", mean=2.0, deviation=0.1), Spread(name="b", mean=3.0, deviation=0.3)


def test_a_product_of_two_numbers():
    """Variance of a product: b² sa² + a² sb² + sa² sb²."""
    linear = propagate(product, [A, B]).band("force")
    assert linear.nominal == pytest.approx([0, 6, 12])
    assert linear.parts["a"][-1] == pytest.approx(2 * 3 * 0.1)
    assert linear.parts["b"][-1] == pytest.approx(2 * 2 * 0.3)
    assert linear.deviation[-1] == pytest.approx(2 * np.hypot(0.3, 0.6))
    assert linear.shares()["b"] == pytest.approx(0.8)
    assert linear.high[-1] - linear.mean[-1] == pytest.approx(1.96 * linear.deviation[-1], rel=1e-4)
    full = propagate(product, [A, B], method="interactions")
    assert full.band("force").together[-1] == pytest.approx(2 * 0.1 * 0.3)
    assert full.band("force").deviation[-1] == pytest.approx(2 * np.sqrt(0.09 + 0.36 + 0.0009))
    assert full.residual["force"] == pytest.approx(0, abs=1e-7)  # arguments have nine digits
    assert propagate(product, [A, B]).residual["force"] > 0.01


def test_the_square_of_a_number():
    """Mean μ² + σ², variance 4 μ² σ² + 2 σ⁴; 95 % of a² lie between the squares where a does not change its sign."""
    band = propagate(square, [Spread(name="a", mean=1.0, deviation=0.3)], method="quadratic").band("force")
    assert band.mean[-1] == pytest.approx(1.09)
    assert band.deviation[-1] == pytest.approx(np.sqrt(4 * 0.09 + 2 * 0.0081))
    assert band.high[-1] == pytest.approx((1 + 1.96 * 0.3) ** 2, rel=0.03)
    assert band.low[-1] == pytest.approx((1 - 1.96 * 0.3) ** 2, rel=0.1)


def test_numbers_of_runs_are_told():
    for method, runs in (("linear", 6), ("quadratic", 7), ("interactions", 8)):
        result = propagate(product, [A, B], method=method)
        assert result.runs == runs
        assert f"{runs} runs." in result.checked()
    runs = Evaluations()
    propagate(product, [A, B], evaluations=runs)
    assert propagate(product, [A, B], evaluations=runs).runs == 0


def test_the_sentence_tells_mesh_and_inputs():
    asked = Computation(function=product, nominal={"error": 0.05})
    result = propagate(asked, [Spread(name="a", mean=2.0, deviation=0.1, label="rubber"), B])
    assert result.sentence() == "force at 2 kPa: 12 N ± 0.1 N (mesh) ± 1.2 N (b) ± 0.6 N (rubber)"
    assert result.sentence(at=1e3) == "force at 1 kPa: 6 N ± 0.05 N (mesh) ± 0.6 N (b) ± 0.3 N (rubber)"
    table = result.to_response()
    assert table["force_spread"][-1] == pytest.approx(np.hypot(0.6, 1.2))
    assert table["force_spread_from_rubber"][-1] == pytest.approx(0.6)
    assert table["force_mesh_error"][-1] == pytest.approx(0.1)
    assert len(uncertainty_figure(result).axes) == 2


def with_round_off(a: float) -> Response:
    """y = a x, and a reaction of round-off."""
    x = np.array([0.0, 1e3, 2e3])
    columns = Column("pressure", "kPa", x), Column("reaction", "N", a * 1e-13 * x), Column("force", "N", a * x / 1e3)
    return Response(columns=columns, source=Source(text="round-off"))


def test_columns_of_round_off_have_no_sentence():
    found = propagate(with_round_off, [A])
    assert [text.partition(" at ")[0] for text in found.sentences()] == ["force"]
    assert "reaction" not in found.summary() and "reaction" in found.bands
    assert found.sentences(at=1e3) == [found.sentence("force", 1e3)]


def test_a_spread_of_the_pressure_takes_no_run():
    asked = Computation(function=product, values={"a": 2.0})
    result = propagate(asked, [Spread(name="pressure", deviation=100.0)])
    assert result.runs == 1
    assert result.band("force").deviation == pytest.approx(np.full(3, 0.2))  # 2 N/kPa of 0.1 kPa


def test_sets_of_constants_stay_together():
    """Constants of one fit are anti-correlated: varied alone, they would give a far wider band."""
    sets = ({"a": 2.0, "b": 3.0}, {"a": 1.5, "b": 4.0}, {"a": 3.0, "b": 2.1})
    result = propagate(product, [Alternatives(sets=sets, label="fits")])
    ends = 2 * np.array([6.0, 6.0, 6.3])
    assert result.runs == 3
    assert result.band("force").deviation[-1] == pytest.approx(ends.std(ddof=1))
    assert result.band("force").mean[-1] == pytest.approx(ends.mean())
    both = propagate(product, [Alternatives(sets=({"a": 2.0}, {"a": 2.2}), label="fits"), B], method="quadratic")
    assert both.band("force").parts["fits"][-1] == pytest.approx(2 * 3 * 0.2 / np.sqrt(2))
    assert both.band("force").low[-1] < both.band("force").mean[-1] < both.band("force").high[-1]


def test_replicates_give_mean_and_deviation():
    values = (1.9, 2.0, 2.1, 2.4)
    spread = Spread(name="a", replicates=values)
    assert spread.standard == pytest.approx((np.mean(values), np.std(values, ddof=1)))


def test_spreads_of_one_label_are_told_as_one():
    result = propagate(
        product,
        [Spread(name="a", mean=2, deviation=0.1, label="x"), Spread(name="b", mean=3, deviation=0.3, label="x")],
    )
    assert list(result.band("force").parts) == ["x"]
    assert result.band("force").parts["x"][-1] == pytest.approx(np.hypot(0.6, 1.2))


def test_a_run_that_fails_leaves_the_other_side():
    result = propagate(product, [Spread(name="a", mean=0.55, deviation=0.1)])
    assert result.band("force").deviation[-1] == pytest.approx(0.2)
    assert any("a run failed (a 0.45): a is below 0.5." in note for note in result.notes)
    with refused("nominal", "a 0.3", 0.5):
        propagate(product, [Spread(name="a", mean=0.3, deviation=0.1)])


def test_bands_end_where_the_first_run_ends():
    result = propagate(two_lengths, [Spread(name="top", mean=10 * kPa, deviation=1 * kPa)])
    assert result.drive.values[-1] == pytest.approx(9 * kPa)
    assert any("The bands end at 9 kPa" in note for note in result.notes)


def test_a_curve_that_bends_is_said():
    result = propagate(cases.thick_sphere, [Spread(name="C10", mean=0.12e6, deviation=0.03e6)])
    assert "take a method with more terms" in result.summary() or result.residual["inner_stretch"] > 0.1


def test_mistakes_are_answered():
    with refused("'wal'", "'wall'"):
        propagate(cases.thick_sphere, [Spread(name="wal", mean=1.0, deviation=0.1)])
    with refused("'quadatic'", "'quadratic'"):
        propagate(product, [A], method="quadatic")
    with refused("'a'", "two spreads"):
        propagate(product, [A, A])
    with refused("spread", "number"):
        propagate(product, [])
    with refused("'a'", "mean"):
        propagate(product, [Spread(name="a", deviation=1.0)])
    with refused("'a'", "deviation", 0, "above 0"):
        Spread(name="a", mean=1.0, deviation=0)
    with refused("'a'", "two replicates"):
        Spread(name="a", replicates=(1.0,))
    with refused("'fits'", "1 sets", "two"):
        Alternatives(sets=({"a": 1.0},), label="fits")
    with refused("'fits'", "a; b"):
        Alternatives(sets=({"a": 1.0}, {"b": 1.0}), label="fits")
    result = propagate(product, [A])
    with refused("'forse'", "'force'"):
        result.sentence("forse")
    with refused("at", 5000, "0 to 2000"):
        result.sentence(at=5e3)

"""Fitting: what is constrained, what is reported, and what is refused."""

from dataclasses import dataclass, field, replace

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.checks import check_modes, check_order, check_stretch_range
from turgor.core.materials.fitting.constrained import solve_constrained
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.law_specs import law_spec
from turgor.core.materials.fitting.ranking import rank
from turgor.core.materials.fitting.result import FitResidual
from turgor.core.materials.fitting.save import can_be_saved, records_toml, save_fits
from turgor.core.materials.laws.laws import MooneyRivlin, NeoHooke, Ogden, Yeoh
from turgor.core.materials.laws.stability import first_instability
from turgor.core.materials.library.record_files import read_records
from turgor.core.materials.material import Material
from turgor.foundation.finding import Severity
from turgor.foundation.source import Source


def made(law, mode="uniaxial", upto=3.0, points=30, **values):
    stretch = np.linspace(1.05, upto, points)
    blank = MaterialTest(mode=mode, stretch=stretch, nominal_stress=stretch, name=mode, **values)
    return MaterialTest(mode=mode, stretch=stretch, nominal_stress=blank.predicted(law), name=mode, **values)


@dataclass(frozen=True, kw_only=True)
class Linear:
    """A law of one's own, W = A (Ī₁ − 3) + B (Ī₁ − 3)²."""

    A: float
    B: float

    def energy(self, I1, I2):
        return self.A * (I1 - 3) + self.B * (I1 - 3) ** 2

    @property
    def shear_modulus(self):
        return 2 * self.A


@dataclass(frozen=True, kw_only=True)
class Limited:
    """A law of one's own with a shape parameter, W = μ/(2b) (exp(b (Ī₁ − 3)) − 1)."""

    mu: float
    b: float = field(metadata={"dimension": "number", "bounds": (0.01, 5.0)})

    def energy(self, I1, I2):
        return self.mu / (2 * self.b) * (sympy.exp(self.b * (I1 - 3)) - 1)

    @property
    def shear_modulus(self):
        return self.mu


YEOH = Yeoh(C10=20e3, C20=-300.0, C30=8.0)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_constrained_least_squares_is_a_minimum(seed):
    """At the solution no constraint is broken, and the gradient is a sum of the active rows with positive weights."""
    random = np.random.default_rng(seed)
    A, b, G = random.normal(size=(12, 3)), random.normal(size=12), random.normal(size=(8, 3))
    h = G @ random.normal(size=3) - random.random(8)  # some point satisfies all of them
    x, active = solve_constrained(A, b, G, h)
    assert (G @ x - h).min() > -1e-7
    gradient = A.T @ (A @ x - b)
    if active.any():
        weights = np.linalg.lstsq(G[active].T, gradient, rcond=None)[0]
        assert G[active].T @ weights == pytest.approx(gradient, abs=1e-6)
        assert weights.min() > -1e-7
    else:
        assert gradient == pytest.approx(np.zeros(3), abs=1e-9)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("Neo Hooke", "neo-hooke"),
        ("mooney_rivlin", "mooney-rivlin"),
        (NeoHooke, "neo-hooke"),
        (MooneyRivlin, "mooney-rivlin"),
        (Yeoh, "yeoh"),
        ("yeoh-3", "yeoh"),
        ("YEOH-5", "yeoh-5"),
        ("generalized-rivlin-2", "rivlin-2"),
        ("generalized_rivlin_2", "rivlin-2"),
        ("neo_hooke", "neo-hooke"),
        ("Mooney–Rivlin", "mooney-rivlin"),
        ("ogden_3", "ogden-3"),
        ("yeoh2", "yeoh-2"),
    ],
)
def test_laws_have_many_spellings(name, expected):
    assert law_spec(name).name == expected


@pytest.mark.parametrize(
    ("name", "facts"),
    [
        ("yeo", ("'yeo'", "'yeoh'")),
        ("ogden", ("'ogden'", "'ogden-3'")),
        (Ogden, ("'ogden'", "'ogden-3'")),
        ("ogden-0", ("'ogden-0'", "order 0", "1 to 6")),
        ("ogden-30", ("'ogden-30'", "order 30", "1 to 6")),
        ("gent-2", ("'gent-2'", "'gent'")),
    ],
)
def test_unknown_laws_are_answered(name, facts):
    with refused(*facts):
        law_spec(name)


def test_own_laws_are_fitted_from_their_fields_alone():
    result = fit(Linear, made(Yeoh(C10=2e4, C20=3e3)))
    assert result.values == pytest.approx({"A": 2e4, "B": 3e3}, rel=1e-6)
    assert result.spec.name == "linear"
    limited = fit(Limited, made(Limited(mu=5e4, b=0.3)), starts=5)
    assert limited.values == pytest.approx({"mu": 5e4, "b": 0.3}, rel=1e-4)
    assert limited.findings == ()


def test_laws_that_cannot_be_fitted_are_refused():
    @dataclass(frozen=True, kw_only=True)
    class Boundless(Limited):
        b: float = field(metadata={"dimension": "number"})

    @dataclass(frozen=True, kw_only=True)
    class Shapeless:
        c: float = field(metadata={"dimension": "number", "bounds": (0.0, 1.0)})

    @dataclass(frozen=True, kw_only=True)
    class Quadratic(Linear):
        def energy(self, I1, I2):
            return self.A * (I1 - 3) + self.B**2 * (I1 - 3) ** 2

    with refused("Boundless", "b", "bounds"):
        law_spec(Boundless)
    with refused("Shapeless", "coefficients in Pa"):
        law_spec(Shapeless)
    with refused("quadratic", "coefficients", "linear"):
        fit(Quadratic, made(YEOH))


@pytest.mark.parametrize(
    ("change", "facts"),
    [
        ({"stretch": (2.0, 3.0)}, ("stretch", "2 to 3", "undeformed 1")),
        ({"stretch": (1.0, 1.01)}, ("two points", "1 and 1.01")),
        ({"weights": "both"}, ("weights 'both'", "absolute", "even", "relative")),
        ({"starts": 0}, ("starts", 0, "at least 1")),
        ({"law": "rivlin-6"}, ("rivlin-6", "28 different stretches", "have 20")),
        ({"tests": []}, ("test", "least one")),
    ],
)
def test_wrong_arguments_are_refused(change, facts):
    arguments = {"law": "yeoh", "tests": [made(YEOH, points=20)]} | change
    with refused(*facts):
        fit(arguments.pop("law"), arguments.pop("tests"), **arguments)


@pytest.mark.parametrize("law", ["neo-hooke", "ogden-2", "gent"])
def test_a_force_of_the_wrong_sign_is_noticed(law):
    stretch = np.linspace(1.1, 2.0, 20)
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=-1e5 * (stretch - 1), name="pushed")
    with refused(f"'{test.name}'", "wrong sign", "force"):
        fit(law, test)


def test_a_constant_stress_has_no_r2():
    stretch = np.linspace(1.1, 2.0, 20)
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=np.full(20, 1e5), name="flat")
    assert np.isnan(fit("neo-hooke", test).quality[0].r2)
    none = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=np.zeros(20), name="nothing")
    with refused(f"'{none.name}'", "no stress"):
        fit("neo-hooke", none)


def test_a_constant_stress_whose_mean_is_rounded_has_no_r2():
    held = MaterialTest(mode="uniaxial", stretch=np.full(10, 1.5), nominal_stress=np.full(10, 83333.3), name="held")
    assert held.measured.mean() != 83333.3
    assert np.isnan(FitResidual.of(held, held.measured + 1e3).r2)


@pytest.mark.parametrize("law", ["neo-hooke", "mooney-rivlin", "ogden-3"])
def test_many_points_at_one_stretch_determine_nothing(law):
    stretch = 1.5 + 1e-5 * np.linspace(-1, 1, 50)
    held = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=np.full(50, 2e5), name="held")
    with refused(law, "different stretches", "have 1"):
        fit(law, held)


def test_cycles_must_be_chosen_first():
    stretch = np.array([1.0, 2.0, 3.0, 2.0, 1.0])
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch - 1, name="a saw")
    with refused("a saw", "point 4", "stretch 2", "select_cycle"):
        fit("neo-hooke", test)


def test_a_softening_curve_gives_a_stable_law_when_wanted():
    """A curve that flattens pulls Yeoh's C30 below zero; the law would fall in equibiaxial tension."""
    stretch = np.linspace(1.05, 3.0, 40)
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=1e5 * np.tanh(stretch - 1), name="soft")
    free, stable = (fit("yeoh", test, stretch=(1.0, 3.0), stable=wish) for wish in (False, True))
    modes = ("uniaxial", "equibiaxial", "planar")
    assert any(first_instability(free.law, mode, 3.0, 1.0) for mode in modes)
    assert free.instability
    assert not any(first_instability(stable.law, mode, 3.0, 1.0) for mode in modes)
    assert stable.bounds_hit == ("stability over the range limits the coefficients",)
    assert stable.relative > free.relative


def test_ogden_keeps_its_signs_and_an_idle_term_is_named():
    result = fit("ogden-2", made(NeoHooke(C10=1e5)), starts=5)
    assert all(mu * alpha >= 0 for mu, alpha in zip(result.law.mu, result.law.alpha, strict=True))
    assert result.relative < 1e-6


def test_gent_ends_beyond_the_range_wanted():
    """Jm must leave room for equibiaxial tension to the end of the range: I₁ − 3 = 2·16 + 4⁻⁴ − 3."""
    result = fit("gent", made(Yeoh(C10=2e4, C20=3e3, C30=0.0)), stretch=(1.0, 4.0))
    assert result.values["Jm"] > 2 * 16 + 4**-4 - 3


def test_the_same_seed_gives_the_same_fit_and_more_starts_no_worse_one():
    tests = [made(YEOH), made(YEOH, "equibiaxial", 2.5)]
    first, again = (fit("ogden-3", tests, starts=4, seed=3) for _ in range(2))
    assert first.values == again.values
    assert fit("ogden-3", tests, starts=12, seed=3).aic <= first.aic + 0.1
    assert first.starts[1] == 4


def test_weights_decide_between_small_and_large_stretches():
    """Two laws joined at stretch 2: relative weights follow the first, absolute weights the second."""
    stretch = np.linspace(1.05, 4.0, 60)
    stress = np.where(stretch < 2, 1.0, 3.0) * 1e5 * (stretch - stretch**-2)
    test = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stress, name="kinked")
    relative, absolute = (
        fit("neo-hooke", test, weights=weights).law.shear_modulus for weights in ("relative", "absolute")
    )
    assert 1e5 < relative < absolute < 3e5


def test_range_is_what_the_tests_cover_and_m01_says_what_is_missing():
    result = fit("yeoh", made(YEOH, upto=3.0), stretch=(1.0, 5.0))
    assert result.stretch_range == (1.0, 3.0)
    assert result.material.stretch_range == (1.0, 3.0)
    assert [finding.code for finding in result.findings] == ["M01"]
    inside = fit("yeoh", made(YEOH, upto=3.0), stretch=(1.0, 2.0))
    assert inside.stretch_range == (1.0, 2.0)
    assert inside.findings == ()
    assert max(test.range[1] for test in inside.tests) <= 2.0


def test_material_carries_law_source_and_doubt():
    result = fit("ogden-2", made(YEOH), starts=5)
    material = result.named("my rubber", density=1100.0)
    assert material.law is result.law
    assert material.density == 1100.0
    assert "uniaxial" in str(material.source)
    assert [doubt[:3] for doubt in material.source.doubts] == ["M02"]


def test_what_several_tests_share_is_said_once():
    """Specimens of one file have its name and columns in common."""
    shared = Source(text="a file", detail="all.csv: stretch from 'stretch'")
    tests = [replace(made(YEOH), name=name, source=shared) for name in ("first", "second")]
    source = fit("yeoh", tests, starts=2).material.source
    assert source.detail.count("all.csv") == 1 and "first, second" in source.text


@pytest.mark.parametrize(
    "name", ["neo-hooke", "mooney-rivlin", "yeoh-2", "yeoh", "yeoh-4", "rivlin-2", "ogden-2", "gent", "arruda-boyce"]
)
def test_a_saved_fit_reads_back_to_the_same_stress(tmp_path, name):
    tests = [made(YEOH), made(YEOH, "equibiaxial", 2.5)]
    result = fit(name, tests, starts=5)
    path = tmp_path / "rubber.toml"
    save_fits(path, "my 'rubber'", [result])
    (record,) = read_records(path)
    assert record.name == name
    assert record.stretch_range == pytest.approx(result.stretch_range, rel=1e-6)
    for test in tests:
        assert test.predicted(record.build_law()) == pytest.approx(test.predicted(result.law), rel=1e-12)


def test_what_cannot_be_saved_says_so(tmp_path):
    result = fit("yeoh", made(YEOH))
    with refused(tmp_path / "rubber.txt", ".toml"):
        save_fits(tmp_path / "rubber.txt", "rubber", [result])
    own = fit(Linear, made(YEOH))
    assert can_be_saved(result)
    assert not can_be_saved(own)
    with refused("law linear"):
        records_toml("rubber", [own])


def test_prediction_of_another_test_is_no_fit():
    result = fit("neo-hooke", made(YEOH))
    (quality,) = result.predict([made(YEOH, "planar")])
    assert quality.mode == "planar"
    assert quality.relative > 0.01
    assert quality.r2 < 1


def test_biaxial_shear_and_tension_go_together():
    law = MooneyRivlin(C10=0.2e6, C01=0.03e6)
    stretch = np.linspace(1.1, 2.5, 20)
    blank = MaterialTest(
        mode="biaxial",
        stretch=stretch,
        nominal_stress=stretch,
        name="field",
        stretch_2=np.full(20, 1.3),
        nominal_stress_2=stretch,
    )
    first, second = np.split(blank.predicted(law), 2)
    field = blank.changed(
        blank.keeping(stretch < 9, "x").edits[0], {"nominal_stress": first, "nominal_stress_2": second}
    )
    amount = np.linspace(-1.0, 1.0, 21)
    shear = MaterialTest(mode="simple_shear", stretch=amount, nominal_stress=2 * 0.23e6 * amount, name="shear")
    result = fit("mooney-rivlin", [field, shear, made(law)])
    assert pytest.approx(0.2e6, rel=1e-9) == result.law.C10
    assert pytest.approx(0.03e6, rel=1e-9) == result.law.C01


def test_ranking_orders_and_explains():
    ranking = rank(["neo-hooke", "yeoh", "ogden-2", "rivlin-6"], made(YEOH, upto=5.0, points=20), starts=5)
    assert ranking.best.spec.name == "yeoh"
    assert ranking.fits[-1].spec.name == "neo-hooke"
    stable = [each.aic for each in ranking.fits if "M06" not in [finding.code for finding in each.findings]]
    assert stable == sorted(stable) == [each.aic for each in ranking.fits[: len(stable)]]
    assert len(ranking.failed) == 1 and "rivlin-6 needs stresses at 28 different" in ranking.failed[0]
    words = " ".join(ranking.words)
    assert "neo-hooke suits strains up to 50 %; over the 400 % wanted" in words
    assert "ogden-2: Uniaxial tests alone do not determine Ogden constants" in words
    assert "Use these constants only from stretch 1 to 5" in words
    with refused("no law", "'yeoh'"):
        rank([], made(YEOH))
    with refused("yeo", "yeoh"):
        rank(["yeo"], made(YEOH))


def test_findings_of_use():
    rubber = Material(name="rubber", law=YEOH, stretch_range=(0.8, 3.0))
    assert check_stretch_range(rubber, (0.8, 3.05)) == (), "digitized ends are not sharp"
    (finding,) = check_stretch_range(rubber, (0.5, 4.0))
    assert "up to stretch 4" in finding.message and "down to stretch 0.5" in finding.message
    assert check_stretch_range(Material(name="rubber", law=YEOH), (0.1, 9.0)) == ()
    assert check_modes(Ogden(mu=(1e5,), alpha=(2.0,)), ["uniaxial", "planar"]) == ()
    assert [finding.code for finding in check_modes(Ogden(mu=(1e5,), alpha=(2.0,)), ["uniaxial", "uniaxial"])] == [
        "M02"
    ]
    law = MooneyRivlin(C10=1e5, C01=1e4)
    assert check_order(law, 3.0) == ()
    assert check_order(law, 3.5)[0].severity is Severity.WARNING
    assert check_order(law, 3.5, reinforced=True)[0].severity is Severity.NOTE
    assert check_order(YEOH, 9.0) == ()


def test_a_law_whose_shape_ends_at_the_bound_of_a_fit_has_errors_there():
    """The uncertainty takes differences beyond the bound, where the extended tube would not exist."""
    stretch = np.linspace(1.05, 3.0, 15)
    stiffening = MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=1e5 * (stretch - stretch**-4), name="s")
    result = fit("extended-tube", stiffening, starts=4)
    assert result.values["beta"] == pytest.approx(0.999)
    assert any("beta is at its bound" in each for each in result.bounds_hit)

"""Laws of foams: constants in both conventions, tests with a free width, stability, fits, files, and refusals."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.inp.materials import material_lines
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.law_specs import law_spec
from turgor.core.materials.fitting.save import material_toml, save_fits
from turgor.core.materials.laws.conventions import describe, law_from_printed
from turgor.core.materials.laws.curves import curve
from turgor.core.materials.laws.homogeneous import DEFORMATIONS, nominal_stress, uniaxial
from turgor.core.materials.laws.laws import BlatzKo, Hyperfoam
from turgor.core.materials.laws.pull import pull
from turgor.core.materials.laws.released import initial_poisson, released
from turgor.core.materials.laws.stability import first_instability
from turgor.fast_models.formulas.formula import law_of
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.systems.exports.sofa_law import sofa_law

FOAM = Hyperfoam.from_abaqus(mu=(20e3, 5e3), alpha=(8.0, -2.0), nu=(0.0, 0.2))
JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials]
body = { law = "hyperfoam", mu = ["5 kPa"], alpha = [8.0], nu = [0.0] }
base = { law = "blatz_ko", mu = "30 kPa" }

[loads]
pressure = "2 kPa"
"""


def test_one_term_is_the_law_of_blatz_and_ko():
    same, stretch = Hyperfoam.from_abaqus(mu=(3e4,), alpha=(-2.0,), nu=(0.25,)), np.array([0.5, 1.0, 1.9])
    for mode, deformation in DEFORMATIONS.items():
        first, second = (nominal_stress(law, deformation(stretch)) for law in (BlatzKo(mu=3e4), same))
        assert first == pytest.approx(second, rel=1e-9, abs=1e-6), mode
    assert same.bulk_modulus == pytest.approx(BlatzKo(mu=3e4).bulk_modulus)


def test_the_formula_without_a_ratio_is_the_limit_of_small_ratios():
    F = uniaxial(np.array([0.4, 0.9, 1.5]))
    limit = nominal_stress(Hyperfoam(mu=(1e4,), alpha=(5.0,), nu=(1e-7,)), F)
    assert nominal_stress(Hyperfoam(mu=(1e4,), alpha=(5.0,), nu=(0.0,)), F) == pytest.approx(limit, rel=1e-5, abs=1e-3)


def test_directions_across_bear_nothing():
    stretch = np.array([0.3, 0.7, 1.4, 2.0])
    for mode, free in (("uniaxial", (1, 2)), ("equibiaxial", (2,)), ("planar", (2,)), ("simple_shear", (2,))):
        P = nominal_stress(FOAM, DEFORMATIONS[mode](stretch))
        assert np.abs(P[:, free, free]).max() < 1e-9 * np.abs(P).max(), mode
    assert released(FOAM, uniaxial(0.5))[1, 1] < 1.1  # a rubber would be 1.41 times as wide


def test_the_slope_of_a_curve_is_that_of_its_points():
    """What the search for instability calls a slope of zero is the largest stress of the curve."""
    at = first_instability(BlatzKo(mu=1.0), "uniaxial", lower=1.0)
    assert at == pytest.approx(6**0.4, rel=1e-9)
    stretch = at + np.array([-1e-3, 0, 1e-3])
    low, top, high = curve(BlatzKo(mu=1.0), "uniaxial", stretch).nominal_stress
    assert low < top > high
    cauchy = [first_instability(FOAM, mode, criterion="cauchy") for mode in ("uniaxial", "equibiaxial", "planar")]
    assert cauchy == [None] * 3
    # σ = μ (J − λ⁻² …): the Cauchy stress μ (1 − λ^(−5/2)) of Blatz and Ko's foam rises for ever
    assert first_instability(BlatzKo(mu=1.0), "uniaxial", criterion="cauchy") is None
    assert first_instability(BlatzKo(mu=1.0), "uniaxial", criterion="drucker") is None


def test_pull_of_records_is_that_of_the_law():
    stretch = np.array([0.6, 1.3])
    assert pull(FOAM, "planar", stretch) == pytest.approx(
        nominal_stress(FOAM, DEFORMATIONS["planar"](stretch))[:, 0, 0]
    )


@pytest.mark.parametrize("nu", [0.0, 0.15])
def test_a_fit_returns_the_constants(nu):
    known = Hyperfoam(mu=(2e3, 8e3), alpha=(3.0, 14.0), nu=(nu, nu))
    tests = [
        MaterialTest(mode=mode, stretch=x, nominal_stress=x, name=mode)
        for mode, x in (("uniaxial", np.linspace(0.3, 1.2, 40)), ("simple_shear", np.linspace(0.05, 0.6, 20)))
    ]
    exact = [
        MaterialTest(mode=t.mode, stretch=t.stretch, nominal_stress=t.predicted(known), name=t.name) for t in tests
    ]
    result = fit(f"hyperfoam-2 nu={nu}", exact, starts=6)
    assert list(result.values.values()) == pytest.approx([2e3, 8e3, 3.0, 14.0], rel=1e-6)
    assert result.law.nu == (nu, nu)
    assert result.relative < 1e-7


def test_a_ratio_is_stated_by_name():
    assert law_spec("hyperfoam-2 nu=0.1").make((1e3, 1e3), (2.0, 4.0)).nu == (0.1, 0.1)
    assert law_spec("hyperfoam-1").make((1e3,), (2.0,)).nu == (0,)
    with refused("ogden-2 nu=0.1", "only hyperfoam"):
        law_spec("ogden-2 nu=0.1")


def test_saved_fits_read_back(tmp_path):
    x = np.linspace(0.4, 1.1, 20)
    blank = MaterialTest(mode="uniaxial", stretch=x, nominal_stress=x, name="foam")
    test = MaterialTest(mode="uniaxial", stretch=x, nominal_stress=blank.predicted(FOAM), name="foam")
    result = fit("hyperfoam-1 nu=0.1", test, starts=4)
    save_fits(tmp_path / "foam.toml", "foam", [result])
    again = tg.from_library(str(tmp_path / "foam.toml"))
    assert test.predicted(again.law) == pytest.approx(test.predicted(result.law), rel=1e-5)
    (tmp_path / "own.toml").write_text(material_toml(tg.Material(name="own", law=FOAM)), encoding="utf-8")
    assert test.predicted(tg.from_library(str(tmp_path / "own.toml")).law) == pytest.approx(test.predicted(FOAM))


def test_printed_constants():
    printed = {"mu_1": 20e3, "alpha_1": 8.0, "nu_1": 0.0, "mu_2": 5e3, "alpha_2": -2.0, "nu_2": 0.2}
    assert law_from_printed("hyperfoam", "abaqus", printed) == FOAM
    assert law_from_printed("blatz_ko", "canonical", {"mu": 3e4}) == BlatzKo(mu=3e4)
    assert describe(FOAM) == "mu_1 = 0.005 MPa, mu_2 = -0.005 MPa, alpha_1 = 8, alpha_2 = -2, nu_2 = 0.2"
    with refused("nu_1", "alpha_1", "mu_1"):
        law_from_printed("hyperfoam", "abaqus", {"mu_1": 20e3, "alpha_1": 8.0})


@pytest.mark.parametrize(
    ("constants", "facts"),
    [
        ({"mu": (1e3,), "alpha": (2.0,), "nu": (0.5,)}, ("nu 1 is 0.5", "less than 0.5", "Ogden")),
        ({"mu": (1e3,), "alpha": (2.0,), "nu": (0.1, 0.2)}, ("1 coefficients", "2 ratios")),
        ({"mu": (1e3,), "alpha": (0.0,), "nu": (0.1,)}, ("Hyperfoam", "alpha 1 is 0")),
        ({"mu": (-1e3,), "alpha": (2.0,), "nu": (0.1,)}, ("Hyperfoam", "shear modulus", "positive")),
        ({"mu": (1e3,), "alpha": (2.0,), "nu": (-0.9,)}, ()),
    ],
)
def test_wrong_constants_are_refused(constants, facts):
    if not facts:  # auxetic foams are real
        assert initial_poisson(Hyperfoam(**constants)) == pytest.approx(-0.9)
        return
    with refused(*facts):
        Hyperfoam(**constants)


def test_a_foam_has_its_own_bulk_modulus_and_no_history():
    foam = tg.Material(name="pad", law=FOAM)
    assert foam.bulk_modulus == FOAM.bulk_modulus
    assert not foam.incompressible
    with refused("pad", "foam", "viscoelasticity"):
        tg.Material(name="pad", law=FOAM, viscoelasticity=tg.laws.Prony(g=(0.2,), tau=(1.0,), moduli="long_term"))


def test_who_has_no_foams_says_so():
    foam = tg.Material(name="pad", law=FOAM)
    with refused("pad", "Hyperfoam", "SOFA"):
        sofa_law(foam, 2.0, 0.49)
    with refused("pad", "Hyperfoam", "finite elements"):
        law_of(foam)
    with refused("materials.b", "*HYPERFOAM", "Abaqus"):
        material_lines("b", foam, "calculix")
    with refused("pad", "foam", "no history"):
        tg.laws.stress_history(foam, "uniaxial", [0.0, 1.0], [1.0, 1.1])


def test_abaqus_has_them():
    foam = tg.Material(name="pad", law=FOAM, density=120.0)
    assert material_lines("b", foam, "abaqus")[1:] == [
        "*HYPERFOAM, N=2", "0.02, 8, 0.005, -2, 0, 0.2", "*DENSITY", "1.2e-10",
    ]  # fmt: skip
    blatz_ko = tg.Material(name="pad", law=BlatzKo(mu=3e4))
    assert material_lines("b", blatz_ko, "abaqus")[1:] == ["*HYPERFOAM, N=1", "0.03, -2, 0.25"]


def test_a_job_states_them_and_its_lock_repeats_them(tmp_path):
    (tmp_path / "pad.toml").write_text(JOB, encoding="utf-8")
    job = read_job(tmp_path / "pad.toml")
    assert job.materials["body"].law == Hyperfoam(mu=(5e3,), alpha=(8.0,), nu=(0.0,))
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(tmp_path / "lock.toml")
    assert {name: each.law for name, each in again.materials.items()} == {
        name: each.law for name, each in job.materials.items()
    }
    (tmp_path / "pad.toml").write_text(JOB.replace('mu = "30 kPa"', 'mu = "30 kPa", bulk_modulus = "1 MPa"'))
    with refused("bulk_modulus"):
        read_job(tmp_path / "pad.toml")

"""Fits for the stretches of an actuator: even weights, preload, slip, batches, missing modes, and the library."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test, read_tests
from turgor.core.materials.experiments.slack import check_preload, check_slip, count_from_zero, zero_stretch
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.library_check import check_library
from turgor.core.materials.fitting.points import even_shares
from turgor.core.materials.fitting.ranking import rank
from turgor.core.materials.fitting.save import save_fits
from turgor.core.materials.fitting.uncertainty import scatter, spread_between
from turgor.core.materials.laws.laws import NeoHooke, Yeoh
from turgor.core.materials.library.records import find_record

LAW = Yeoh(C10=8e3, C20=200.0)


def pull(law=LAW, stretch=None, *, mode="uniaxial", name="pull", batch=""):
    stretch = np.linspace(1.0, 2.5, 40) if stretch is None else np.array(stretch)
    blank = MaterialTest(mode=mode, stretch=stretch, nominal_stress=stretch, name=name)
    return MaterialTest(mode=mode, stretch=stretch, nominal_stress=blank.predicted(law), name=name, batch=batch)


def test_even_weights_do_not_depend_on_the_density_of_points():
    """A Yeoh rubber fitted by neo-Hooke: where its points lie decides, unless intervals of stretch count."""
    even = np.linspace(1.02, 2.5, 60)
    crowded = np.concatenate([np.linspace(1.02, 1.2, 200), np.linspace(1.21, 2.5, 40)])
    fits = {
        weights: [fit("neo-hooke", pull(stretch=each), weights=weights).values["C10"] for each in (even, crowded)]
        for weights in ("relative", "even")
    }
    assert fits["even"][1] == pytest.approx(fits["even"][0], rel=0.005)
    assert fits["relative"][1] < 0.97 * fits["relative"][0]


def test_even_weights_give_all_modes_one_vote():
    tests = [pull(stretch=np.linspace(1.0, 2.0, 90)), pull(mode="equibiaxial", stretch=np.linspace(1.0, 2.0, 10))]
    shares = even_shares(tests)
    assert shares[:90].sum() == pytest.approx(50) and shares[90:].sum() == pytest.approx(50)


def test_a_preload_is_reported_and_taken_out():
    """The machine counts from where 3 % of strain are in the specimen already."""
    taut = pull(stretch=np.linspace(1.03, 2.0, 60))
    loaded = MaterialTest(
        mode="uniaxial", stretch=taut.stretch / 1.03, nominal_stress=taut.nominal_stress, name="loaded"
    )
    (finding,) = check_preload([loaded])
    assert finding.code == "P12" and "loaded" in finding.message and "preloaded" in finding.message
    assert fit("neo-hooke", loaded, stretch=(1, 1.4)).values["C10"] > 1.1 * LAW.C10
    corrected = fit("yeoh", count_from_zero(loaded), stretch=(1, 2))
    assert corrected.values["C10"] == pytest.approx(LAW.C10, rel=0.05)
    assert "P12" in [each.code for each in fit("yeoh", loaded).findings]


def test_a_rubber_that_is_stiff_at_first_was_not_preloaded():
    """Its curve meets zero below 1 as well, but at stretch 1 there is no stress."""
    x = np.linspace(1.0, 2.0, 60)
    stiff = MaterialTest(mode="uniaxial", stretch=x, nominal_stress=20e3 * (x - 1) ** 0.6, name="stiff")
    assert zero_stretch(stiff) < 0.98
    assert not check_preload([stiff]) and not check_preload([pull()])


def test_the_zero_is_estimated_or_refused():
    loose = pull(stretch=np.linspace(1.0, 2.0, 60))
    loose = MaterialTest(
        mode="uniaxial",
        stretch=np.concatenate([[1.0, 1.02], 1.04 * loose.stretch]),
        nominal_stress=np.concatenate([[0.0, 0.0], loose.nominal_stress]),
        name="loose",
    )
    counted = count_from_zero(loose)
    assert counted.range[1] == pytest.approx(2.0, rel=0.01)
    assert counted.stretch.min() >= 1.0 and "removed" in counted.edits[-1].text
    assert count_from_zero(loose, 1.04).range[1] == pytest.approx(2.0)
    with refused("loose", "zero"):
        count_from_zero(MaterialTest(mode="uniaxial", stretch=[0.8, 1.0], nominal_stress=[-1.0, 0.0], name="loose"))


def test_slip_is_a_fall_that_rises_again():
    """A step of 8 % in the stress at stretch 1.6, as where the grips let the specimen through."""
    smooth = pull(stretch=np.linspace(1.0, 2.5, 200))
    stress = np.where(smooth.stretch > 1.6, 0.92, 1.0) * smooth.nominal_stress
    slipped = MaterialTest(mode="uniaxial", stretch=smooth.stretch, nominal_stress=stress, name="slipped")
    (finding,) = check_slip([slipped])
    assert finding.code == "P13" and "1.6" in finding.message and "slipped" in finding.message
    assert not check_slip([smooth])
    broken = np.where(smooth.stretch > 2.4, 0.1, 1.0) * smooth.nominal_stress
    assert not check_slip([MaterialTest(mode="uniaxial", stretch=smooth.stretch, nominal_stress=broken, name="broken")])
    noisy = smooth.nominal_stress * (1 + 0.01 * np.random.default_rng(1).standard_normal(200))
    assert not check_slip([MaterialTest(mode="uniaxial", stretch=smooth.stretch, nominal_stress=noisy, name="noisy")])


def test_batches_of_a_table_are_read_by_their_column(tmp_path):
    rows = ["cured in,specimen,stretch,nominal stress (kPa)"]
    for batch, factor in (("May", 100), ("June", 120)):
        for specimen in (1, 2):
            rows += [f"{batch},{specimen},{x},{factor * (x - 1)}" for x in (1.0, 1.5, 2.0)]
    file = tmp_path / "uniaxial.csv"
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    tests = read_tests(file, columns={"batch": "cured in"})
    assert [(test.batch, test.name.removeprefix("uniaxial ")) for test in tests] == [
        ("May", "May 1"), ("May", "May 2"), ("June", "June 1"), ("June", "June 2"),
    ]  # fmt: skip
    file.write_text("\n".join(rows).replace("cured in", "batch"), encoding="utf-8")
    assert [test.batch for test in read_tests(file)] == ["May", "May", "June", "June"]
    with refused("uniaxial.csv", 4):
        read_test(file)


def test_the_file_of_a_fit_carries_its_spread(tmp_path):
    law = Yeoh(C10=8e3, C20=200.0)
    fits = [
        fit("yeoh-2", pull(Yeoh(C10=scale * law.C10, C20=scale * law.C20), stretch=np.linspace(1.05, 2.5, 30)))
        for scale in (0.9, 1.0, 1.1)
    ]
    spread = spread_between(fits, "batches")
    assert spread.of == "3 batches"
    assert spread.deviations["C10"] == pytest.approx(0.1 * law.C10, rel=1e-6)
    assert spread.correlation[0][1] == pytest.approx(1.0)
    file = tmp_path / "ours.toml"
    save_fits(file, "ours", [fits[1]], {"yeoh-2": spread})
    record = find_record(str(file))
    first, *others = record.spread.sets(record.constants)
    assert first == dict(record.constants) and len(others) == 2  # both constants move together
    assert sorted(round(each["C10"] / law.C10, 3) for each in others) == [0.9, 1.1]
    assert sorted(round(each["C20"] / law.C20, 3) for each in others) == [0.9, 1.1]
    with refused("batches", "yeoh-2"):
        spread_between(fits[:1], "batches")


def test_sets_have_the_covariance_of_the_fit():
    noise = 1 + 0.02 * np.random.default_rng(0).standard_normal(40)
    clean = pull(stretch=np.linspace(1.05, 2.5, 40))
    scattered = MaterialTest(
        mode="uniaxial", stretch=clean.stretch, nominal_stress=noise * clean.nominal_stress, name="noisy"
    )
    fitted = fit("yeoh", scattered)
    spread = scatter(fitted)
    table = np.array([list(each.values()) for each in spread.sets(fitted.values)])
    away = table - table[0]
    errors = np.array(list(fitted.errors.values()))
    covariance = away.T @ away / (len(table) - 1)
    assert covariance == pytest.approx(fitted.correlation * np.outer(errors, errors), rel=1e-6)


def test_open_constants_have_no_spread():
    assert scatter(fit("mooney-rivlin", pull(NeoHooke(C10=8e3), mode="planar"))) is None


def test_missing_modes_are_named_with_what_the_laws_say_there():
    (words,) = [
        each for each in rank(["neo-hooke", "mooney-rivlin"], pull(NeoHooke(C10=8e3))).words if "Missing" in each
    ]
    assert "1 uniaxial" in words and "equibiaxial and planar" in words
    assert "differ by" in words
    alike = [each for each in rank(["neo-hooke", "yeoh"], pull(NeoHooke(C10=8e3))).words if "Missing" in each]
    assert "first invariant alone" in alike[0] and "differ by" not in alike[0]
    both = [pull(NeoHooke(C10=8e3)), pull(NeoHooke(C10=8e3), mode="equibiaxial", stretch=np.linspace(1.0, 1.6, 20))]
    assert not any("Missing" in each for each in rank(["neo-hooke", "mooney-rivlin"], both).words)


def test_a_fit_is_compared_with_the_library():
    """Median of the sets of Ecoflex 00-30; a neo-Hookean rubber of 12.7 kPa is its recommended set without the rest."""
    (near,) = check_library(NeoHooke(C10=12.7e3), "ecoflex-00-30", 2.5)
    (far,) = check_library(NeoHooke(C10=4e3), "ecoflex-00-30", 2.5)
    assert near.code == far.code == "M20"
    assert near.severity == "note" and far.severity == "warning"
    (within,) = check_library(NeoHooke(C10=40e3), "ecoflex-00-30", 2.5)  # no softer than all sets, no stiffer
    assert within.severity == "warning"
    assert "E = 76.2 kPa" in near.message and "stretch 2 = " in near.message
    assert "E = 24 kPa is 1/" in far.message
    with refused("ecoflex-00-31", "ecoflex-00-30"):
        check_library(NeoHooke(C10=4e3), "ecoflex-00-31", 2.0)

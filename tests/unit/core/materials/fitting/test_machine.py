"""The compliance of a testing machine is recovered, corrected, and told apart from slip."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.machine import Machine, check_machine, read_machine, remove_compliance
from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.experiments.slack import zero_stretch
from turgor.core.materials.experiments.test_edits import set_zero_length
from turgor.core.materials.fitting.fit_laws import fit

LENGTH, AREA, C10, COMPLIANCE = 25e-3, 12e-6, 5e6, 0.04e-3  # a strip of printed TPU in screw grips; m/N
HEADER = "# Length = 25 mm\n# Cross-section = 12 mm2\n"


def steel(tmp_path, *, noise=0.0, slip=0.0):
    """A reference run: the grips settle by 0.15 mm, then the machine gives way in proportion to the force."""
    random, force = np.random.default_rng(1), np.linspace(0.0, 200.0, 101)
    way = COMPLIANCE * force + 0.15e-3 * (1 - np.exp(-force / 4)) + noise * random.normal(size=len(force))
    way = way + slip * (force > 120)
    rows = "".join(f"{f:.4f};{1e3 * u:.6f}\n" for f, u in zip(force, way, strict=True)).replace(".", ",")
    path = tmp_path / "steel.csv"
    path.write_text("Kraft (N);Weg (mm)\n" + rows)
    return path


def strip(tmp_path, *, strain=False, slip=0.0):
    """A pull on a neo-Hookean strip in that machine, with or without a strain that was measured on it."""
    stretch = np.linspace(1.0, 1.6, 121)
    force = 2 * C10 * AREA * (stretch - stretch**-2)
    way = LENGTH * (stretch - 1) + COMPLIANCE * force + slip * (stretch > 1.3)
    table = {"force (N)": force, "extension (mm)": 1e3 * way} | ({"strain (-)": stretch - 1} if strain else {})
    rows = "".join(",".join(f"{each:.7g}" for each in row) + "\n" for row in zip(*table.values(), strict=True))
    path = tmp_path / "strip_uniaxial.csv"
    path.write_text(HEADER + ",".join(table) + "\n" + rows)
    return path


def test_a_known_compliance_is_recovered_from_a_run_on_steel(tmp_path):
    machine = read_machine(steel(tmp_path, noise=1e-6))
    assert machine.compliance == pytest.approx(COMPLIANCE, rel=0.02)
    assert 0 < machine.error < 0.01 * COMPLIANCE
    assert machine.forces == pytest.approx((22.0, 200.0))


def test_the_modulus_is_that_of_the_rubber_once_the_machine_is_taken_away(tmp_path):
    test = read_test(strip(tmp_path))
    assert fit("neo-hooke", test).values["C10"] < 0.93 * C10
    machine = read_machine(steel(tmp_path))
    corrected = remove_compliance(test, machine)
    assert fit("neo-hooke", corrected).values["C10"] == pytest.approx(C10, rel=0.002)
    assert zero_stretch(corrected) == pytest.approx(1.0, abs=1e-3)
    text = corrected.edits[-1].text
    assert "0.04" in text and "mm/N" in text and "steel.csv" in text and "% of the extension" in text


def test_a_length_that_was_counted_anew_goes_with_the_specimen(tmp_path):
    test = read_test(strip(tmp_path))
    later = set_zero_length(test, 1.05)
    assert later.specimen.length == pytest.approx(1.05 * LENGTH)
    moved = remove_compliance(later, Machine(compliance=COMPLIANCE))
    first = set_zero_length(remove_compliance(test, Machine(compliance=COMPLIANCE)), 1.05)
    assert moved.stretch == pytest.approx(first.stretch, rel=1e-12)


def test_a_strain_on_the_specimen_shows_the_compliance_and_needs_no_correction(tmp_path):
    test = read_test(strip(tmp_path, strain=True))
    assert fit("neo-hooke", test).values["C10"] == pytest.approx(C10, rel=1e-4)
    (finding,) = check_machine([test])
    assert (finding.code, finding.severity.name) == ("P14", "NOTE")
    assert "0.04 mm/N" in finding.message and "0.04 mm/N" in finding.advice
    with refused("strip_uniaxial", "strain", "crosshead"):
        remove_compliance(test, Machine(compliance="0.04 mm/N"))


def test_slip_is_told_from_compliance(tmp_path):
    (finding,) = check_machine([read_test(strip(tmp_path, strain=True, slip=2e-3))])
    assert finding.severity.name == "WARNING"
    assert "slipped" in finding.message and "stretch 1.3" in finding.message
    assert any(each.code == "P14" for each in fit("yeoh", read_test(strip(tmp_path, strain=True, slip=2e-3))).findings)
    assert not check_machine([read_test(strip(tmp_path))])


def test_what_is_no_reference_run_is_refused(tmp_path):
    with refused("steel.csv", "proportion", "5 %"):
        read_machine(steel(tmp_path, slip=5e-3))
    path = tmp_path / "short.csv"
    path.write_text("force (N),extension (mm)\n1,0.1\n2,0.2\n3,0.3\n")
    with refused("short.csv", "3 points", "5"):
        read_machine(path)
    path.write_text("force (N),time (s)\n1,0.1\n2,0.2\n3,0.3\n")
    with refused("extension", "length", "short.csv"):
        read_machine(path)


def test_a_compliance_that_cannot_be_is_refused(tmp_path):
    test = read_test(strip(tmp_path))
    with refused("0.16 mm/N", "strip_uniaxial", "N"):
        remove_compliance(test, Machine(compliance="0.16 mm/N"))
    with refused("compliance", "0 mm/N"):
        Machine(compliance=0.0)
    plain = tmp_path / "plain_uniaxial.csv"
    plain.write_text("stretch,nominal stress (kPa)\n1,0\n1.5,80\n2,140\n")
    with refused("plain_uniaxial", "mm/N", "Specimen"):
        remove_compliance(read_test(plain), Machine(compliance="0.02 mm/N"))

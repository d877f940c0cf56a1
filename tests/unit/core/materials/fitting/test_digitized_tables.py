"""Tables as people digitize them: one stress in a row and the axis it acts along; and series that are copies."""

import numpy as np
import pytest

from refused import refused
from turgor.core.materials.experiments.copies import check_copies
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.ranking import rank

FIELD = [(0.9, 1.2), (1.2, 1.2), (1.5, 1.2), (1.0, 1.6), (1.3, 1.6), (1.9, 1.6)]


def stress(along, across):
    """Nominal stress of a neo-Hookean rubber with C10 = 0.2 MPa [MPa]."""
    return 0.4 * (along - 1 / (along**3 * across**2))


def table(header, words=("1", "2")):
    lines = [header]
    for one, two in FIELD:
        lines += [
            f"{one},{two},{words[0]},{stress(one, two):.12g}",
            f"{one},{two},{words[1]},{stress(two, one):.12g}",
        ]
    return "\n".join(lines)


@pytest.mark.parametrize(
    ("header", "words"),
    [
        ("stretch_1,stretch_2_fixed,component,nominal_stress_MPa", ("1", "2")),
        ("lambda 1,fixed stretch,component,engineering stress (MPa)", ("P11", "P22")),
        ("stretch 1,stretch 2 (fixed),direction,nominal stress (MPa)", ("x", "y")),
    ],
)
def test_a_row_for_each_component_is_read_and_fitted(tmp_path, header, words):
    file = tmp_path / "kawabata.csv"  # whose name says nothing of the mode
    file.write_text(table(header, words))
    test = read_test(file)
    assert test.mode == "biaxial" and len(test.stretch) == 2 * len(FIELD)
    assert pytest.approx(0.2e6, rel=1e-6) == fit("neo-hooke", test).law.C10


def test_an_axis_that_is_none_is_named(tmp_path):
    file = tmp_path / "b.csv"
    file.write_text(table("stretch_1,stretch_2_fixed,component,nominal_stress_MPa", ("1", "radial")))
    with refused("b.csv", "line 3", "radial", "component", "1 or 2"):
        read_test(file)


def test_copies_are_noticed():
    free = np.linspace(1.0, 2.0, 6)
    one = MaterialTest(mode="uniaxial", stretch=free, nominal_stress=stress(free, free**-0.5) * 1e6, name="one")
    two = MaterialTest(mode="planar", stretch=free, nominal_stress=one.nominal_stress, name="two")
    assert [finding.code for finding in check_copies([one, two])] == ["P08"]
    assert "one and two hold the same numbers to the last digit." in " ".join(rank(["neo-hooke"], [one, two]).words)
    assert check_copies([one]) == ()
    pulled = np.tile(stress(free, 1.5) * 1e6, 2)
    field = MaterialTest(
        mode="biaxial",
        stretch=np.tile(free, 2),
        stretch_2=np.repeat([1.5, 1.8], 6),
        nominal_stress=pulled,
        name="field",
    )
    (finding,) = check_copies([field])
    assert finding.message.startswith("field at stretch 2 = 1.5 and field at stretch 2 = 1.8 hold the same numbers")

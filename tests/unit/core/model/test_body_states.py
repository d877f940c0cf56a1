"""States of bodies: what their loads refuse, how they add up and fade, what job files and stages make of them."""

import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from turgor.core.engine.cells.body_states import rest_of, stiffness_of
from turgor.core.model.continued_model import continued
from turgor.core.model.loads import Hardening, Pressure, PreStretch, Shrinkage, Stiffness, Swelling, Temperature
from turgor.core.model.model import Model
from turgor.core.solvers.checks.early_findings import early_findings
from turgor.core.solvers.procedures.stages import Stage, Stages
from turgor.core.solvers.procedures.static import Static
from turgor.foundation.errors import TurgorError

MESH, HALF = cases.body(), cases.body(half=True)
PLACES = np.zeros((len(MESH.cells), 1, 3))


def model(*loads, mesh=MESH):
    return Model(mesh, {"body": cases.RUBBER, "base": cases.RUBBER}, "fixed", list(loads))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Shrinkage("body", "3 mm"), "shrinkage of 'body': linear: '3 mm' is a length, but a share is needed."),
        (lambda: Shrinkage("body", 0.95), "shrinkage of 'body': linear is 95 %; allowed is -100 % to below 90 %."),
        (lambda: Swelling("body", -1), "swelling of 'body': volume_ratio is -1; allowed is 0.1 to 100."),
        (lambda: PreStretch("body", 0), "pre-stretch of 'body': stretch is 0; allowed is 0.1 to 10, and 1 is none."),
        (lambda: PreStretch("body", 1.2, form="acros"), "did you mean 'across'?"),
        (lambda: PreStretch("body", 1.2, (0, 0, 0)), "direction is a zero vector"),
        (lambda: Temperature("body", -3), "temperature of 'body': temperature is -3 K; it must be more than 0 K."),
        (lambda: Temperature("body", "60 °C", expansion="0.1 1/K"), "which makes a strain of 4"),
        (lambda: Temperature("body", 330, modulus="soft"), "'constant', 'rubber' or points (temperature, factor)"),
        (lambda: Temperature("body", 330, modulus=[(300, 1), (290, 2)]), "rising temperatures and factors above 0"),
        (lambda: Temperature("body", 330, modulus=[(290, 1), (320, 2)]), "56.85 °C lies outside the points of modulus"),
        (lambda: Stiffness("body", 0), "stiffness of 'body': factor is 0; allowed is 1e-6 to 1e6, and 1 is no change."),
        (lambda: Hardening("body", -1), "hardening of 'body': factor is -1; allowed is 0 to 1e6."),
        (lambda: model(Shrinkage("bodi", 0.01)), "did you mean 'body'?"),
        (lambda: model(Shrinkage("tip", 0.01)), "'tip' is a face, and sheets have no such state; give a body: base"),
        (lambda: model(PreStretch("body", 2, (1, 1, 0)), mesh=HALF), "it is not the same on both sides of the mirror"),
        (lambda: model(PreStretch("body", 1.1, (1, 0, 0), "around", (0, 1, 0)), mesh=HALF), "a center 1 m off along y"),
    ],
)  # fmt: skip
def test_wrong_states_are_refused(make, message):
    with pytest.raises(TurgorError) as caught:
        make()
    assert message in str(caught.value)


def test_states_of_one_body_multiply_whatever_their_order():
    loads = (Shrinkage("body", 0.1), PreStretch("body", 1.5, (0, 0, 1)), Swelling("body", 1.2), Stiffness("body", 0.5))
    for order in (loads, loads[::-1]):
        there = model(*order)
        rest, factors = rest_of(there, PLACES, 1.0), stiffness_of(there, 1.0)
        body, base = MESH.regions["body"], MESH.regions["base"]
        assert rest.volume[body] == pytest.approx(0.9**3 * 1.2, rel=1e-12)
        assert rest.inverse[body][:, 0, 2, 2] == pytest.approx(1.5 / 0.9 / 1.2 ** (1 / 3), rel=1e-12)
        assert (factors[body] == 0.5).all() and (factors[base] == 1).all()
        assert rest.volume[base] == pytest.approx(1.0)


def test_a_stage_goes_from_the_old_state_to_the_new_one():
    first = model(Shrinkage("body", 0.1), Stiffness("body", 0.01))
    second = continued(first, (1.0, {}), [Shrinkage("body", 0.0), Pressure("cavity", 1e3)])
    body = MESH.regions["body"]
    volumes = [rest_of(second, PLACES, factor).volume[body][0, 0] for factor in (0.0, 0.5, 1.0)]
    assert volumes == pytest.approx([0.9**3, 0.9**1.5, 1.0], rel=1e-12)
    assert stiffness_of(second, 0.5)[body] == pytest.approx(0.01)


def test_findings_say_what_comes_together_or_without_a_stage():
    def codes(*loads):
        return {each.code for each in early_findings(model(*loads), Static())}

    pressure = Pressure("cavity", 1e3)
    assert "L11" in codes(Shrinkage("body", 0.01), pressure)
    assert "L11" not in codes(Shrinkage("body", 0.01)) | codes(pressure)
    early = Shrinkage("body", 0.01, history=[(0, 0), (0.2, 1), (1, 1)])
    assert "L11" not in codes(early, pressure)
    assert "L12" in codes(Hardening("body", 1.0))
    stages = Stages([Stage("fill", loads=[pressure]), Stage("freeze", loads=[Hardening("body", 1.0)])])
    assert not {"L11", "L12"} & {each.code for each in early_findings(model(), stages)}


def test_models_with_states_are_saved_and_loaded(tmp_path):
    loads = [Temperature("body", "60 °C", modulus=[("20 °C", 1.0), ("60 °C", 0.8)]), Hardening("base", 2.0)]
    loads[1] = loads[1].begun(np.full_like(MESH.points, 1e-3))
    model(*loads).save(tmp_path / "model.turgor")
    back = tg.load(tmp_path / "model.turgor")
    assert back.loads == tuple(loads)
    assert (back.loads[1].shape == loads[1].shape).all()


def test_states_have_no_form_in_inp_files(tmp_path):
    with pytest.raises(TurgorError, match="a load of kind Hardening has no form"):
        tg.files.write_inp(model(Hardening("body", 1.0)), tmp_path / "model.inp", program="abaqus")


def test_states_that_grow_are_one_temperature_of_an_inp_file(tmp_path):
    file = tmp_path / "model.inp"
    tg.files.write_inp(model(Shrinkage("body", 0.01), Swelling("base", 1.331)), file, program="abaqus")
    lines = file.read_text().splitlines()
    values = [lines[k + 1] for k, line in enumerate(lines) if line == "*EXPANSION, ZERO=0."]
    assert sorted(map(float, values)) == pytest.approx([-0.01, 0.1])
    assert sum(line.startswith("*TEMPERATURE") for line in lines) == 1
    early = Swelling("base", 1.2, history=[(0, 0), (0.2, 1), (1, 1)])
    with pytest.raises(TurgorError, match=r"Shrinkage\(body\) and Swelling\(base\) have different histories"):
        tg.files.write_inp(model(Shrinkage("body", 0.01), early), file, program="abaqus")


def test_reduced_models_refuse_states():
    with pytest.raises(TurgorError, match=r"reduced models have no states of bodies, and Shrinkage\(body\) is one"):
        tg.reduce(model(Shrinkage("body", 0.01), Pressure("cavity", 1e3)), {"loads.pressure": (0, 1e3)})

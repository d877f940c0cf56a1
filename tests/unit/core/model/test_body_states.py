"""States of bodies: what their loads refuse, how they add up and fade, what job files and stages make of them."""

from types import SimpleNamespace

import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from refused import refused
from turgor.core.engine.cells.mean_stress_jumps import mean_stress_numbers
from turgor.core.engine.cells.states.body_states import rest_of, stiffness_of
from turgor.core.engine.system import System
from turgor.core.model.continued_model import continued
from turgor.core.model.loads import Hardening, Pressure, PreStretch, Shrinkage, Stiffness, Swelling, Temperature
from turgor.core.model.model import Model
from turgor.core.solvers.checks.early_findings import early_findings
from turgor.core.solvers.constraints.load_factor import LoadFactor
from turgor.core.solvers.procedures.stages import Stage, Stages
from turgor.core.solvers.procedures.static import Static
from turgor.job.section import solve_section

MESH, HALF = cases.body(), cases.body(half=True)
PLACES = np.zeros((len(MESH.cells), 1, 3))


def model(*loads, mesh=MESH):
    return Model(mesh, {"body": cases.RUBBER, "base": cases.RUBBER}, "fixed", list(loads))


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: Shrinkage("body", "3 mm"), ("'body'", "linear", "'3 mm'", "share", "%")),
        (lambda: Shrinkage("body", 0.95), ("'body'", "linear", "95 %", "-100 %", "90 %")),
        (lambda: Swelling("body", -1), ("'body'", "volume_ratio", -1, 0.1, 100)),
        (lambda: PreStretch("body", 0), ("'body'", "stretch", 0, 0.1, 10)),
        (lambda: PreStretch("body", 1.2, form="acros"), ("'acros'", "'across'")),
        (lambda: PreStretch("body", 1.2, (0, 0, 0)), ("'body'", "direction", "(1, 0, 0)")),
        (lambda: Temperature("body", -3), ("'body'", "temperature", "-3 K", "0 K")),
        (lambda: Temperature("body", "60 °C", expansion="0.1 1/K"), ("expansion", "0.1 1/K", 4, -0.5)),
        (lambda: Temperature("body", 330, modulus="soft"), ("modulus", "'soft'", "'constant'", "'rubber'")),
        (lambda: Temperature("body", 330, modulus=[(300, 1), (290, 2)]), ("modulus", "(300, 1)", "rising")),
        (lambda: Temperature("body", 330, modulus=[(290, 1), (320, 2)]), ("56.85 °C", "modulus", "46.85 °C")),
        (lambda: Stiffness("body", 0), ("'body'", "factor", 0, "1e-6", "1e6")),
        (lambda: Hardening("body", -1), ("'body'", "factor", -1, "1e6")),
        (lambda: model(Shrinkage("bodi", 0.01)), ("'bodi'", "'body'")),
        (lambda: model(Shrinkage("tip", 0.01)), ("'tip'", "base", "body", "without a sheet")),
        (lambda: model(PreStretch("body", 2, (1, 1, 0)), mesh=HALF), ("symmetric", "normal to y")),
        (lambda: model(PreStretch("body", 2, (1, 0, 0), "around", (0, 1, 0)), mesh=HALF), ("center", "1 m")),
    ],
)
def test_wrong_states_are_refused(make, facts):
    with refused(*facts):
        make()


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
    with refused("Hardening", ".inp"):
        tg.files.write_inp(model(Hardening("body", 1.0)), tmp_path / "model.inp", program="abaqus")


def test_states_that_grow_are_one_temperature_of_an_inp_file(tmp_path):
    file = tmp_path / "model.inp"
    tg.files.write_inp(model(Shrinkage("body", 0.01), Swelling("base", 1.331)), file, program="abaqus")
    lines = file.read_text().splitlines()
    values = [lines[k + 1] for k, line in enumerate(lines) if line == "*EXPANSION, ZERO=0."]
    assert sorted(map(float, values)) == pytest.approx([-0.01, 0.1])
    assert sum(line.startswith("*TEMPERATURE") for line in lines) == 1
    early = Swelling("base", 1.2, history=[(0, 0), (0.2, 1), (1, 1)])
    with refused("Shrinkage(body)", "Swelling(base)", "histories"):
        tg.files.write_inp(model(Shrinkage("body", 0.01), early), file, program="abaqus")


def test_reduced_models_refuse_states():
    with refused("Shrinkage(body)", "reduced"):
        tg.reduce(model(Shrinkage("body", 0.01), Pressure("cavity", 1e3)), {"loads.pressure": (0, 1e3)})


def test_mean_stress_jumps_between_bodies_of_different_states():
    assert mean_stress_numbers(model(Shrinkage("body", 0.01)))[1] > mean_stress_numbers(model())[1]


def test_forces_of_a_load_factor_are_the_derivative_of_the_residual():
    system = System(model(Shrinkage("body", 0.1), Stiffness("base", 0.2), Pressure("cavity", 1e3)))
    rng = np.random.default_rng(3)
    unknowns = np.where(system.prescribed, 0.0, 0.02 * rng.standard_normal(system.size))
    at, h = system.evaluate(unknowns, 0.6), 1e-5
    change = (system.residual(unknowns, 0.6 + h) - system.residual(unknowns, 0.6 - h)) / (2 * h)
    displacements = np.arange(3 * system.node_count)
    column = LoadFactor(system).columns(at)[0]
    assert column[displacements] == pytest.approx(change[displacements], abs=1e-6 * np.abs(change).max())


def test_sections_refuse_states():
    job = SimpleNamespace(loads=(Shrinkage("body", 0.01),))
    with refused("Shrinkage(body)", "section"):
        solve_section(job, None, 3)


def test_a_foam_keeps_its_stiffness() -> None:
    foam = tg.Material(name="sponge", law=tg.laws.BlatzKo(mu=30e3))
    mesh = tg.mesh(tg.actuators.RectangularBender().build(), size=8e-3)
    for load in (tg.loads.Stiffness("body", 0.5), tg.loads.Hardening("body", 2.0)):
        with refused("materials.body", "foam", load.label):
            tg.Model(mesh, foam, ["fixed"], [load])
    shrunk = tg.Model(mesh, foam, ["fixed"], [tg.loads.Shrinkage("body", 0.01)])
    assert shrunk.states_of("body")

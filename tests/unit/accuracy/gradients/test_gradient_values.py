"""Gradients: keys of a model, what is refused and why, and how the value shows and writes itself."""

import csv
from dataclasses import replace

import numpy as np
import pytest
import solver_cases
from solver_cases import RUBBER, bar

import turgor as tg
from refused import refused
from turgor.accuracy.gradients import moved_mesh
from turgor.accuracy.gradients.equilibrium import equilibrium_of
from turgor.accuracy.gradients.neighbor_models import CENTRAL, neighbors_of
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.meshing import generate
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.units import kPa, mm

OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)

FINGER = tg.FastPneuNet(chambers=1, length=20 * mm).build()


def _rise(at):
    return float(at.displacement[:, 2].max())


RISE = tg.measures.Measure(name="rise", unit="mm", function=_rise, definition="largest displacement along z")


@pytest.fixture(scope="module")
def solution():
    return tg.solve(solver_cases.model(), options=OPTIONS)


@pytest.fixture(scope="module")
def gradient(solution):
    return tg.gradient(solution, RISE, ["materials.body.C10", "loads.top.vector.3"], options=OPTIONS)


def test_numbers_of_a_model_are_keys_and_values():
    sheet = tg.Membrane(tg.Material(name="sheet", law=tg.laws.Hooke(E=1e6, nu=0.3)), 1e-4)
    model = replace(solver_cases.model(), materials={"body": RUBBER, "top": sheet})
    result = tg.studies.model_numbers(model)
    assert result["materials.body.C10"] == 0.1e6
    assert result["materials.top.thickness"] == 1e-4
    assert result["loads.top.vector.3"] == 1e3
    for key, value in result.items():
        again = tg.studies.model_numbers(tg.studies.with_number(model, key, value * 0.8))
        assert again == {**result, key: pytest.approx(value * 0.8)}


def test_one_key_for_all_pressures():
    loads = [tg.Pressure("fixed", 2 * kPa), tg.Pressure("top", 2 * kPa)]
    model = tg.studies.with_number(replace(solver_cases.model(), loads=tuple(loads)), "loads.pressure", 3 * kPa)
    assert [load.pressure for load in model.loads] == [3 * kPa, 3 * kPa]


def test_gradient_is_read_by_name(gradient):
    assert gradient["rise", "materials.body.C10"] == gradient.by("rise")["materials.body.C10"] < 0
    assert gradient["rise"].shape == (2,)
    assert gradient.relative("rise")["loads.top.vector.3"] == pytest.approx(10 * gradient["rise", "loads.top.vector.3"])
    # nearly linear: twice the stiffness halves the motion, twice the load doubles it
    relative = gradient.relative("rise")
    assert relative["materials.body.C10"] == pytest.approx(-relative["loads.top.vector.3"], rel=1e-6)
    assert relative["loads.top.vector.3"] == pytest.approx(0.01 * gradient.value("rise"), rel=0.05)


def test_gradient_shows_itself_as_a_table(gradient):
    lines = repr(gradient).splitlines()
    assert lines[1].split("  ")[0] == "number"
    assert lines[2].startswith("materials.body.C10") and "0.1 MPa" in lines[2] and lines[2].endswith("mm")


def test_gradient_is_written_in_units(gradient, tmp_path):
    with gradient.to_csv(tmp_path / "gradient.csv").open(encoding="utf-8", newline="") as file:
        first, *rows = csv.reader(file)
    assert first == ["number", "value", "unit", "d_rise_mm"]
    assert rows[0][:3] == ["materials.body.C10", "0.1", "MPa"]
    assert float(rows[0][3]) == pytest.approx(gradient["rise", "materials.body.C10"] * 1e6 / 1e-3)


@pytest.mark.parametrize(
    ("measures", "wrt", "facts"),
    [
        ([], ["materials.body.C10"], ["measure", "'bending_angle'"]),
        (RISE, [], ["gradient", "number"]),
        (RISE, ["materials.body.C01"], ["'materials.body.C01'", "'materials.body.C10'"]),
        (RISE, ["loads.top.vector.1"], ["'loads.top.vector.1'", 0, "scales"]),
        (RISE, ["materials.body.C10,loads.top.vector.3"], ["materials.body.C10,loads.top.vector.3", 100000, 1000]),
        ("bending", ["materials.body.C10"], ["measure 'bending'", "'bending_angle'"]),
        ("outside_work", ["materials.body.C10"], ["'outside_work'", "sum"]),
        ([RISE, RISE], ["materials.body.C10"], ["'rise'", "twice"]),
    ],
)
def test_what_is_asked_for_must_exist(solution, measures, wrt, facts):
    with refused(*facts):
        tg.gradient(solution, measures, wrt, options=OPTIONS)


def test_states_are_numbered(solution):
    with refused("state", 99, "0 to 6"):
        tg.gradient(solution, RISE, ["materials.body.C10"], state=99, options=OPTIONS)


def _with(solution, **more):
    """A path whose last state has another model."""
    model = replace(solution.model, **more)
    return replace(solution, model=model, states=(*solution.states[:-1], replace(solution.states[-1], model=model)))


def test_states_that_depend_on_all_before_are_refused(solution):
    relaxing = replace(RUBBER, viscoelasticity=Prony(g=(0.2,), tau=(1.0,), moduli="instantaneous"))
    floor = Obstacle(name="floor", shape=Plane(point=(0, 0, -1), normal=(0, 0, 1)), friction=0.3)
    cases = {
        ("relaxes", "duration"): replace(
            _with(solution, materials={"body": relaxing}), procedure=tg.Static(duration=1.0)
        ),
        ("friction", 0): _with(solution, contact=tg.Contact(obstacles=[floor])),
        ("moves", "Static"): replace(solution, procedure=tg.Dynamic(duration=1.0)),
        ("artificial viscosity", "Stabilized"): replace(solution, procedure=tg.Stabilized()),
    }
    for facts, path in cases.items():
        with refused("gradient", *facts):
            tg.gradient(path, RISE, ["materials.body.C10"], options=OPTIONS)


def test_other_cells_are_refused(solution):
    def model_of(values):
        mesh = bar()
        return replace(solution.model, mesh=replace(mesh, cells=mesh.cells[::-1].copy()))

    with refused("'length'", "hexahedra"):
        tg.gradient(solution, RISE, tg.studies.Variation(model_of, {"length": 0.01}), options=OPTIONS)


def _moved(solution, motion):
    """A model whose upper vertex moves with a number, by some function of its change."""

    def model_of(values):
        points = solution.model.mesh.points.copy()
        points[:, 2] += motion(values["height"] - 0.01) * (points[:, 2] > 0.009)
        return replace(solution.model, mesh=replace(solution.model.mesh, points=points))

    return tg.studies.Variation(model_of, {"height": 0.01})


def test_one_side_is_taken_where_the_mesh_turns(solution):
    """Nodes that move twice as fast when a number grows: the derivative is that of the growing number."""
    kink = _moved(solution, lambda change: 2 * change if change > 0 else change)
    smooth = _moved(solution, lambda change: 2 * change)
    one, other = (tg.gradient(solution, RISE, each, options=OPTIONS)["rise", "height"] for each in (kink, smooth))
    assert one == pytest.approx(other, rel=1e-6)
    base = equilibrium_of(solution.states[-1], solution.procedure, OPTIONS)
    assert [each.steps for each in neighbors_of(base, smooth, "height").each] == [steps for steps, _ in CENTRAL]


def test_the_other_side_is_taken_where_one_is_not_allowed(solution):
    smooth = _moved(solution, lambda change: change)

    def limited(values):
        if values["height"] > 0.01:
            raise tg.TurgorError("height is too large.")
        return smooth.model(values)

    one, other = (
        tg.gradient(solution, RISE, tg.studies.Variation(each, {"height": 0.01}), options=OPTIONS)["rise", "height"]
        for each in (limited, smooth.model)
    )
    assert one == pytest.approx(other, rel=1e-5)
    assert np.isfinite(one) and one != 0


def _generating(shape):
    """A function from its length and stiffness to a block of tetrahedra that it generates each time."""

    def model_of(values):
        mesh = tg.mesh(shape(values["length"]), size=5 * mm, cells="tetrahedra")
        rubber = replace(RUBBER, law=tg.laws.NeoHooke(C10=values["C10"]))
        return tg.Model(mesh, {"body": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1 * kPa)])

    return tg.studies.Variation(model_of, {"length": 20 * mm, "C10": 0.1e6})


def _immovable(mesh, geometry):
    raise tg.TurgorError("it has no CAD faces.")


def _tube(length):
    return tg.actuators.ExtendingCylinder(length=length).build()


def test_nothing_is_generated_for_tetrahedra_that_are_carried_along(monkeypatch):
    variation = _generating(_tube)
    path = tg.solve(variation.model(variation.values), options=OPTIONS)
    monkeypatch.setattr(generate, "chosen_settings", pytest.fail)
    assert tg.gradient(path, "cavity_volume", variation, options=OPTIONS)["cavity_volume", "length"] > 0


def test_tetrahedra_that_cannot_follow_have_other_gradients(monkeypatch):
    """Of a part without CAD faces, by a material; the shape is refused with the reason."""
    monkeypatch.setattr(moved_mesh, "movable", _immovable)
    variation = _generating(_tube)
    path = tg.solve(variation.model(variation.values), options=OPTIONS)
    material = replace(variation, values={"C10": 0.1e6}, model=lambda v: variation.model({"length": 20 * mm, **v}))
    assert tg.gradient(path, "cavity_volume", material, options=OPTIONS)["cavity_volume", "C10"] < 0
    with refused("'length'", "CAD faces"):
        tg.gradient(path, "cavity_volume", variation, options=OPTIONS)


def test_a_shape_of_other_faces_is_refused():
    variation = _generating(lambda length: _tube(length) if length == 20 * mm else FINGER)
    path = tg.solve(variation.model(variation.values), options=OPTIONS)
    with refused("'length'", "'fast PneuNet, 1 chamber, half'"):
        tg.gradient(path, "cavity_volume", variation, options=OPTIONS)


def test_a_mesh_that_is_changed_after_it_was_made_is_refused():
    plain = _generating(_tube)

    def changed(values):
        model = plain.model(values)
        mesh = replace(model.mesh, points=1.1 * model.mesh.points)
        return replace(model, mesh=mesh)

    variation = replace(plain, model=changed)
    path = tg.solve(variation.model(variation.values), options=OPTIONS)
    with refused("'length'", "hexahedra"):
        tg.gradient(path, "cavity_volume", variation, options=OPTIONS)

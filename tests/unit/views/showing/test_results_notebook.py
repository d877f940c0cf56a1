"""What values show on a console and in a notebook: one short line, and a page of HTML with pictures."""

import re
from base64 import b64decode
from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases
from matplotlib.figure import Figure

import turgor as tg
from refused import refused
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.measures import measure
from turgor.core.solvers.solution import LimitPoint, Status, Touch
from turgor.foundation.display import brief, listed
from turgor.foundation.finding import Finding, Severity
from turgor.units import kPa, mm
from turgor.views.notebook.markup import card, facts, numbers
from turgor.views.notebook.pages import state_rows

#: Letters of the longest line that a console shows of any value, and bytes of the largest picture.
LONGEST, LARGEST = 400, 150_000


@pytest.fixture(scope="module")
def path():
    question = cases.model(cases.body())
    rest = cases.state(question, None, 0)
    bent = replace(cases.state(question, cases.bent(1.0)), pressures={"cavity": 50 * kPa}, unstable_modes=0)
    result = Finding(code="G01", severity=Severity.WARNING, message="Thin <walls>.", advice="Refine.")
    return replace(cases.solution([rest, bent]), findings=(result,), advice="Go on.")


@pytest.fixture(scope="module")
def values(path):
    test = tg.experiments.MaterialTest(
        mode="uniaxial", stretch=np.linspace(1, 2, 500), nominal_stress=np.linspace(0, 1e5, 500), name="a strip"
    )
    return {
        "material": tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020"),
        "stiff": tg.Material(name="paper", law=tg.laws.Hooke(E=6.5e9, nu=0.2)),
        "geometry": tg.FastPneuNet(chambers=2, length=20 * mm).build(),
        "mesh": path.model.mesh,
        "model": path.model,
        "state": path.states[-1],
        "solution": path,
        "response": measure(path),
        "test": test,
        "fit": tg.fit("yeoh", [test]),
    }


def pictures(html):
    return [b64decode(data) for data in re.findall(r'src="data:image/png;base64,([^"]+)"', html)]


KINDS = ("material", "stiff", "geometry", "mesh", "model", "state", "solution", "response", "test", "fit")


@pytest.mark.parametrize("kind", KINDS)
def test_representation_is_one_short_line(values, kind):
    said = repr(values[kind])
    assert len(said) < LONGEST
    assert "\n" not in said
    assert "array(" not in said


@pytest.mark.parametrize("kind", KINDS)
def test_page_has_small_pictures_and_escaped_text(values, kind):
    html = values[kind]._repr_html_()
    drawn = pictures(html)
    assert len(drawn) == (0 if kind in ("stiff", "model") else 1)
    assert all(png.startswith(b"\x89PNG") and len(png) < LARGEST for png in drawn)
    text = re.sub(r'src="[^"]*"', "", html)
    assert text.count("<div") == text.count("</div>")
    assert text.count("<table") == text.count("</table>")
    assert "<walls>" not in text


def test_what_the_lines_say(values):
    assert (
        repr(values["material"])
        == "Material('Elastosil M4601', NeoHooke(C10=120000.0) [SI], incompressible, 1130 kg/m³)"
    )
    assert repr(values["state"]) == ("State(load factor 1, cavity 50 kPa, largest displacement 21.19 mm, 558 nodes)")
    assert repr(values["solution"]) == (
        "Solution(converged, 2 states of 'box': Reached 50 kPa; G01 warning: Thin <walls>. Refine.)"
    )
    assert repr(values["mesh"]).startswith(
        "Mesh('box', 264 ten-node tetrahedra, 558 nodes, regions: base, body, faces: "
    )
    assert "Fixed(fixed), Pressure(cavity, 50 kPa)" in repr(values["model"])
    assert repr(values["response"]).startswith(
        "Response(2 rows: load_factor 0 to 1, pressure 0 to 50 kPa, bending_angle"
    )
    assert repr(values["response"]).endswith(" more; converged, from finite elements)")


def test_what_the_pages_say(values):
    assert "C10 = 0.12 MPa" in values["material"]._repr_html_()
    assert "20 × 10 × 15 mm" in values["geometry"]._repr_html_()
    model = values["model"]._repr_html_()
    for said in ("fixed does not move in x, y, z.", "Gauge pressure 50 kPa on cavity", "C10 = 0.12 MPa"):
        assert said in model
    solution = values["solution"]._repr_html_()
    for said in (
        "Reached 50 kPa.",
        "Go on.",
        "G01 warning: Thin &lt;walls&gt;. Refine.",
        "bending angle [°]",
        "57.30",
    ):
        assert said in solution
    assert "pressure [kPa]" in values["response"]._repr_html_()


@pytest.mark.parametrize(("modes", "said"), [(0, "stable"), (1, "unstable, 1 mode"), (2, "unstable, 2 modes")])
def test_unstable_modes_of_a_state_are_counted(values, modes, said):
    assert ("equilibrium", said) in state_rows(replace(values["state"], unstable_modes=modes))


def test_a_solution_without_a_tip_or_a_converged_state_has_a_page(path):
    mesh = path.model.mesh
    faces = {name: sides for name, sides in mesh.faces.items() if name != "tip"}
    bare = cases.model(replace(mesh, faces=faces))
    stopped = replace(
        cases.solution([cases.state(bare)], Status.LIMIT_POINT),
        limit_points=(LimitPoint(kind="maximum", load_factor=0.5, pressure=2e4, face="cavity", state=0),),
    )
    assert "limit point" in stopped._repr_html_()
    assert "maximum at load factor 0.5" in stopped._repr_html_()


def test_a_geometry_that_was_read_as_a_mesh_shows_its_cells():
    mesh = cases.body(half=True)
    part = Geometry(
        name="a scan", smallest_wall=1e-3, cavity_volumes={}, solid_volume=1e-6, regions=tuple(mesh.regions),
        faces=tuple(mesh.faces), length_scale=1.0, shape=MeshedShape(mesh),
    )  # fmt: skip
    assert len(pictures(part._repr_html_())) == 1
    assert len(repr(part)) < LONGEST


def test_values_with_arrays_say_their_shape_and_range():
    touch = Touch(
        force=np.zeros((500, 3)), pressure=np.linspace(0, 5, 500), area=1.0, penetration=0.0, place=np.zeros(3)
    )
    assert brief(touch) == repr(touch)
    assert repr(touch).startswith("Touch(force=<500 × 3 array, 0 to 0>, pressure=<500 values, 0 to 5>, area=1, ")
    memory = Memory(stress={"body": np.zeros((2, 900, 14, 6))}, largest={})
    array = "{'body': <2 × 900 × 14 × 6 array, 0 to 0>}"
    assert repr(memory) == f"Memory(stress={array}, largest={{}}, friction=(), flow={{}}, bonds={{}})"
    view = tg.pictures.shared_view([cases.state(cases.model(cases.body()))], width=400)
    assert len(repr(view)) < LONGEST
    assert listed([f"face_{n}" for n in range(100)]).endswith("face_7 … (100)")


def test_representations_of_what_is_read_off_a_state(path):
    assert len(repr(StateFields(path.states[-1]).cells)) < LONGEST


def test_pieces_of_markup_are_escaped():
    assert "&lt;b&gt;" in card("<b>")
    assert "&lt;b&gt;" in facts([("<b>", "<b>")])
    assert "<td" not in facts([("empty", "")])
    assert "&lt;b&gt;" in numbers(["<b>"], [["<b>"]], note="<b>")


def test_a_response_plots_itself(values):
    response = values["response"]
    panels = response.plot().axes
    assert [axes.get_ylabel() for axes in panels][:2] == ["bending angle [°]", "cavity volume [mL]"]
    figure = response.plot("bending_angle", x="cavity_volume")
    assert figure.axes[0].get_xlabel() == "cavity volume [mL]"
    assert figure._repr_png_().startswith(b"\x89PNG")
    shared = Figure().add_subplot()
    assert response.plot("bending_angle", axes=shared) is shared.figure
    assert shared.lines[0].get_ydata()[-1] == pytest.approx(57.2958)
    with refused("x and axes", "plot('bending_angle')"):
        response.plot(axes=shared)
    with refused("'bending_angel'", "'bending_angle'"):
        response.plot("bending_angel")

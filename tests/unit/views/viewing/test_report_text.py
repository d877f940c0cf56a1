"""Text of the report: title, units, digits, zeros, sources, and what repeats the run."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

import turgor as tg
from turgor.core.materials.laws.laws import LAWS, Hooke
from turgor.foundation.display import MOST_ENTRIES
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import deg, kPa
from turgor.views.plots.linked_plots import places_of_points
from turgor.views.plots.response_plots import response_figure
from turgor.views.report.headline import headline, modeled_part
from turgor.views.report.page import Report, write_report
from turgor.views.report.references import LAW_SOURCES
from turgor.views.report.response_table import parted, response_table
from turgor.views.viewer.curves import Measured
from turgor.views.viewer.scene import scene_of
from turgor.views.viewer.settings import VIEWER


@pytest.fixture(scope="module")
def path():
    model = cases.model(cases.body(half=True))
    return cases.solution([cases.state(model, cases.bent(f), f) for f in (0.0, 1.0)])


def response(**columns):
    made = [Column(name, unit, values) for name, (unit, values) in columns.items()]
    return Response(columns=tuple(made), source=Source(text="a test"))


def written(tmp_path, **values):
    write_report(tmp_path / "r.html", Report(**values))
    text = (tmp_path / "r.html").read_text(encoding="utf-8")
    return re.sub(r"<(style|script)[^>]*>.*?</\1>", "", text, flags=re.DOTALL)


def test_a_title_names_the_whole_actuator_and_a_half_is_explained(path):
    named = replace(path.states[-1], pressures={"cavity": 22.5 * kPa})
    mesh = replace(path.model.mesh, name="fast PneuNet, 11 chambers, half")
    question = replace(path.model, mesh=mesh)
    assert headline(replace(path, model=question, states=(named,))) == "Fast PneuNet, 11 chambers, up to 22.5 kPa"
    assert headline(path) == "Box"
    assert modeled_part(path.model.mesh) == (
        "One half of the actuator was computed; the mirror plane y = 0 gives the rest. Numbers, curves and pictures "
        "are those of the whole actuator."
    )
    assert "y = 3 mm gives" in modeled_part(cases.body(half=True, shift=3e-3))
    assert modeled_part(cases.body()) == ""


def test_columns_of_zeros_are_named_and_the_load_factor_is_left_out():
    shown = response_table(
        response(load_factor=("", [0, 1]), pressure=("kPa", [0, 5e3]), reaction=("N", [0, 4e-12]), rise=("mm", [0, 1]))
    )
    assert shown["labels"] == ["pressure [kPa]", "rise [mm]"]
    assert shown["zeros"] == ["reaction"]
    assert shown["rows"] == [["0", "0"], ["5.000", "1000"]]


def test_numbers_have_four_digits_and_a_minus_sign():
    shown = response_table(response(load_factor=("", [0, 1]), turn=("deg", [-12.34567 * deg, 123.4567 * deg])))
    assert [row[1] for row in shown["rows"]] == ["−12.3", "123.5"]


def test_a_wide_table_is_parted_so_that_it_fits_a_page():
    wide = response(load_factor=("", [0, 1]), **{f"way_{k}_along": ("mm", [0, k]) for k in range(1, 21)})
    parts = parted(response_table(wide))
    assert all(len(part["labels"]) <= MOST_ENTRIES for part in parts)
    assert all(part["labels"][0] == "load factor" for part in parts)
    assert [label for part in parts for label in part["labels"][1:]] == [c.label for c in wide.columns[1:]]
    assert all(len(row) == len(part["labels"]) for part in parts for row in part["rows"])


def test_units_are_those_of_a_printed_page():
    units = {"deg": "°", "um": "µm", "mm2": "mm²", "m3": "m³", "Nm": "N m", "kPa": "kPa"}
    assert {unit: Column("size", unit, [1.0]).label for unit in units} == {
        unit: f"size [{sign}]" for unit, sign in units.items()
    }


def test_every_law_of_rubber_has_a_source():
    assert {kind.__name__ for kind in LAWS.values() if not issubclass(kind, Hooke)} == set(LAW_SOURCES)


def test_a_page_says_what_to_cite_and_holds_the_job(tmp_path, path):
    job = '[actuator]\ntype = "<box>"'
    text = written(
        tmp_path, title="T", solution=path, response=response(load_factor=("", [0, 1]), rise=("mm", [0, 1])), job=job,
        repeat="turgor run job.lock.toml", dimensions={"side_wall": "0.30000000000000004 mm"},
    )  # fmt: skip
    assert "[actuator]\ntype = &#34;&lt;box&gt;&#34;" in text
    assert "L. R. G. Treloar, Trans. Faraday Soc. 1943, 39, 241; Xavier, Fleming and Yong (2021), Eq. 15" in text
    cited = re.search(r"<ol>(.*?)</ol>", text, re.DOTALL)[1]
    for said in (
        "turgor: finite element modeling",
        "Adv. Intell. Syst. 2021, 3, 2000187",
        "rubber: stated in the script",
    ):
        assert said in cited
    assert '<th scope="row">side wall</th><td>0.3 mm</td>' in text
    assert "review Eq" not in text


def test_measured_points_stand_beside_the_curve(path):
    computed = response(pressure=("kPa", [0, 5e3]), bending_angle=("deg", [0, 1.0]))
    rig = Measured(name="rig", x="pressure", y="bending_angle", across=np.array([1e3, np.nan]),
                   upward=np.array([10 * deg, 20 * deg]))  # fmt: skip
    other = Measured(name="other", x="pressure", y="rise", across=np.zeros(1), upward=np.zeros(1))
    (angle,) = scene_of(path, computed, (rig, other)).values["curves"]["y"]
    assert angle["measured"] == [{"name": "rig", "x": [1.0, None], "y": [10.0, 20.0]}]


def test_the_page_knows_where_the_points_of_a_plot_lie():
    figure = response_figure(response(pressure=("kPa", [0, 2e3, 4e3]), rise=("mm", [0, 3e-3, np.nan])))
    figure.draw_without_rendering()
    (line,) = places_of_points(figure, 3)
    axes = figure.axes[0].get_position()
    assert axes.x0 < line[0][0] < line[1][0] < axes.x1
    assert line[0][1] > line[1][1]  # a larger value lies higher, counted from the top
    assert line[2] is None


def test_a_page_that_is_too_large_shows_fewer_states(tmp_path, monkeypatch):
    model = cases.model(cases.body(half=True))
    path = cases.solution([cases.state(model, cases.bent(f), f) for f in (0.0, 0.3, 0.6, 0.8, 1.0)])
    file = tmp_path / "r.html"
    tg.report(path, file)
    whole = file.stat().st_size
    fewer = "of 5 states, to keep the page small."
    assert fewer not in file.read_text(encoding="utf-8")
    letters = len(json.dumps(scene_of(path).values))
    monkeypatch.setattr("turgor.views.report.page.VIEWER", replace(VIEWER, page_bytes=whole - letters // 4))
    tg.report(path, file)
    assert file.stat().st_size < whole - letters // 4
    assert fewer in file.read_text(encoding="utf-8")
